// Derivations: against hand-written matrices for the two reference mechanisms, against differences for random ones.
#include "corank/symbolic/sets/singularity_system.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <tuple>

#include "corank/symbolic/model/model_file.h"
#include "corank/tests/symbolic/evaluate.h"
#include "corank/tests/symbolic/reference.h"

namespace corank::symbolic {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr unsigned kVelocitySeed = 271828;
using Rows = std::vector<std::vector<std::string>>;

Rows texts(const ExpressionMatrix& matrix) {
  Rows rows;
  for (const auto& row : matrix.rows) {
    rows.emplace_back();
    for (const Expression& entry : row) rows.back().push_back(entry.text());
  }
  return rows;
}

std::vector<std::string> texts(const std::vector<TrigonometricSystem::Equation>& equations) {
  std::vector<std::string> out;
  for (const auto& equation : equations) out.push_back(equation.relation.text());
  return out;
}

/// The message of the ModelError that `call` throws, with the line it names.
template <typename Call>
std::pair<int, std::string> error_of(Call&& call) {
  try {
    call();
  } catch (const ModelError& error) {
    return {error.where().line, error.what()};
  }
  return {-1, "no error"};
}

// Lines: 2 constants, 3 onwards as the callers count.
Mechanism model(const std::string& vars, const std::string& equations, const std::string& rest = "") {
  return parse_model("[SYSTEM VARS]\n" + vars + "\n[SYSTEM EQS]\n" + equations + "\n" + rest, "m.cuik");
}

ExpressionMatrix without(const Derivation& d, auto... roles) { return d.velocity.without(std::array{roles...}); }
std::vector<std::size_t> dependencies(const Derivation& d, Role role) { return d.velocity.dependencies(std::array{role}); }

TEST(Derivation, GivesDextarsJacobianAndItsBlocks) {
  const Derivation d = derive(reference("dextar"));
  EXPECT_THAT(d.velocity.matrix.columns, ElementsAre("J3x", "J3y", "theta2", "theta3", "theta4", "theta5"));
  EXPECT_THAT(without(d, Role::input).columns, ElementsAre("J3x", "J3y", "theta3", "theta4"));
  EXPECT_THAT(without(d, Role::output).columns, ElementsAre("theta2", "theta3", "theta4", "theta5"));
  EXPECT_THAT(without(d, Role::input, Role::output).columns, ElementsAre("theta3", "theta4"));
  EXPECT_EQ(texts(without(d, Role::input)), (Rows{{"0", "0", "-l3*sin(theta3)", "-l4*sin(theta4)"},
                                                  {"0", "0", "l3*cos(theta3)", "l4*cos(theta4)"},
                                                  {"1", "0", "l3*sin(theta3)", "0"},
                                                  {"0", "1", "-l3*cos(theta3)", "0"}}));
  EXPECT_EQ(texts(without(d, Role::output)),
            (Rows{{"-l2*sin(theta2)", "-l3*sin(theta3)", "-l4*sin(theta4)", "l5*sin(theta5)"},
                  {"l2*cos(theta2)", "l3*cos(theta3)", "l4*cos(theta4)", "-l5*cos(theta5)"},
                  {"l2*sin(theta2)", "l3*sin(theta3)", "0", "0"},
                  {"-l2*cos(theta2)", "-l3*cos(theta3)", "0", "0"}}));
}

TEST(Derivation, KnowsTheRolesOfColumnsAndThePlacesOfRows) {
  const Derivation d =
      derive(model("x : [-1, 1]\ny : [-1, 1]\nz : [-1, 1]", "x^2 + y^2 = 1;\nx = z;", "[INPUTS] y\n[OUTPUTS] x"));
  EXPECT_THAT(d.velocity.matrix.roles, ElementsAre(Role::output, Role::input, Role::passive));
  ASSERT_EQ(d.velocity.where.size(), 2u);
  EXPECT_EQ(d.velocity.where[1].line, d.velocity.where[0].line + 1);
}

TEST(SingularitySystem, SaysWhichEquationsAreOfTheKernel) {
  for (const KernelSide side : {KernelSide::right, KernelSide::left}) {
    const TrigonometricSystem s = singularity_system(reference("three_slider"), SingularitySet::forward, side, {}, 2);
    for (const auto* list : {&s.equations, &s.inequalities})
      for (const auto& e : *list)
        EXPECT_EQ(e.of_kernel, e.relation.text().find("xi") != std::string::npos) << e.relation.text();
  }
}

TEST(Derivation, GivesTheThreeSlidersJacobianAndItsBlocks) {
  const Derivation d = derive(reference("three_slider"));
  EXPECT_EQ(texts(d.velocity.matrix), (Rows{{"2*y_A", "0", "2*x_C"}, {"0", "2*y_B", "2*x_C"}}));
  EXPECT_EQ(texts(without(d, Role::input)), (Rows{{"0", "2*x_C"}, {"2*y_B", "2*x_C"}}));
  EXPECT_EQ(texts(without(d, Role::output)), (Rows{{"2*y_A", "2*x_C"}, {"0", "2*x_C"}}));
  EXPECT_EQ(texts(without(d, Role::input, Role::output)), (Rows{{"2*x_C"}, {"2*x_C"}}));
  EXPECT_EQ(d.phi[1].text(), "y_B^2 + x_C^2 - L2^2");
}

TEST(Derivation, OrdersTermsAndFactorsByDeclaration) {
  Mechanism mechanism;
  const Expression b = mechanism.constant("b", 2), a = mechanism.constant("a", 3);
  const Expression y = mechanism.length("y", -1, 1), x = mechanism.length("x", -1, 1), t = mechanism.angle("t");
  mechanism.constrain(x * x * y * a * b + sin(t + pi() / 3) * a * x + x / b + Expression("0.25") * x == Expression(0));
  EXPECT_EQ(texts(derive(mechanism).velocity.matrix),
            (Rows{{"b*a*x^2", "0.25 + 2*b*a*y*x + 1/b + a*sin(1/3*pi + t)", "a*x*cos(1/3*pi + t)"}}));
}

TEST(Derivation, AgreesWithCentralDifferencesOnRandomMechanisms) {
  RandomMechanism generator(kVelocitySeed);
  constexpr long double kStep = 1e-5L;
  std::vector<Mechanism> mechanisms = {reference("dextar"), reference("three_slider")};
  for (int i = 0; i < 40; ++i) mechanisms.push_back(generator.make(3));
  for (const Mechanism& mechanism : mechanisms) {
    const Derivation d = derive(mechanism);
    for (int k = 0; k < 5; ++k) {
      const Values q = generator.point(mechanism);
      for (std::size_t i = 0; i < d.phi.size(); ++i) {
        for (std::size_t j = 0; j < d.velocity.matrix.columns.size(); ++j) {
          Values ahead = q, behind = q;
          ahead[d.velocity.matrix.columns[j]] += kStep;
          behind[d.velocity.matrix.columns[j]] -= kStep;
          const Relation& relation = mechanism.constraints()[i].relation;
          const long double difference = (residual(relation, ahead) - residual(relation, behind)) / (2 * kStep);
          const long double exact = evaluate(d.velocity.matrix.rows[i][j], q);
          // Error: h²/6·f''' plus rounding 1e-19/h; derivatives reach 10^4 here.
          ASSERT_NEAR(static_cast<double>(difference), static_cast<double>(exact),
                      1e-5 + 1e-7 * std::fabs(static_cast<double>(exact)))
              << "seed " << kVelocitySeed << ": " << relation << " by " << d.velocity.matrix.columns[j];
        }
      }
    }
  }
}

TEST(Derivation, IsTheSameWheneverItIsMade) {
  const Rows first = texts(derive(reference("dextar")).velocity.matrix);
  RandomMechanism generator(kVelocitySeed);
  const Mechanism random = generator.make(3);
  const Rows random_first = texts(derive(random).velocity.matrix);
  for (int i = 0; i < 5; ++i) {
    derive(generator.make(2));  // GiNaC's serial numbers, and with them its order of terms, move on
    EXPECT_EQ(texts(derive(random).velocity.matrix), random_first);
  }
  EXPECT_EQ(texts(derive(reference("dextar")).velocity.matrix), first);
}

TEST(SingularitySystem, GivesTheKernelEquationsOfDextarsForwardSingularities) {
  const TrigonometricSystem s = singularity_system(reference("dextar"), SingularitySet::forward);
  EXPECT_EQ(s.name, "dextar forward");
  EXPECT_THAT(s.kernel_unknowns, ElementsAre("xi1", "xi2", "xi3", "xi4"));
  EXPECT_THAT(texts(s.equations), ElementsAre("d + l2*cos(theta2) + l3*cos(theta3) + l4*cos(theta4) - l5*cos(theta5) = 0",
                                              "l2*sin(theta2) + l3*sin(theta3) + l4*sin(theta4) - l5*sin(theta5) = 0",
                                              "J3x = d + l2*cos(theta2) + l3*cos(theta3)",  //
                                              "J3y = l2*sin(theta2) + l3*sin(theta3)",
                                              "-l3*sin(theta3)*xi3 - l4*sin(theta4)*xi4 = 0",  //
                                              "l3*cos(theta3)*xi3 + l4*cos(theta4)*xi4 = 0",
                                              "xi1 + l3*sin(theta3)*xi3 = 0",  //
                                              "xi2 - l3*cos(theta3)*xi3 = 0",  //
                                              "xi1^2 + xi2^2 + xi3^2 + xi4^2 = 1"));
  EXPECT_THAT(texts(s.inequalities), ElementsAre("0.7326*xi1 + 0.4652*xi2 + 0.8978*xi3 + 0.6304*xi4 >= 0"));
  EXPECT_EQ(s.equations[0].source, "dextar.cuik:27");
  EXPECT_EQ(s.equations[6].source, "row 3 of L_y xi = 0");
  EXPECT_EQ(s.equations[8].source, "norm of xi");
}

TEST(SingularitySystem, GivesTheLeftKernelOfTheThreeSlider) {
  const TrigonometricSystem s = singularity_system(reference("three_slider"), SingularitySet::inverse, KernelSide::left);
  EXPECT_THAT(texts(s.equations), ElementsAre("y_A^2 + x_C^2 = L1^2", "y_B^2 + x_C^2 = L2^2",  //
                                              "2*y_A*xi1 = 0", "2*x_C*xi1 + 2*x_C*xi2 = 0", "xi1^2 + xi2^2 = 1"));
  EXPECT_EQ(s.equations[3].source, "row 2 of L_z^T xi = 0");
}

TEST(SingularitySystem, TakesTheLeftKernelOfTheWideJacobian) {
  const TrigonometricSystem s = singularity_system(reference("three_slider"), SingularitySet::cspace_singular);
  EXPECT_THAT(texts(s.equations),
              ElementsAre("y_A^2 + x_C^2 = L1^2", "y_B^2 + x_C^2 = L2^2",  //
                          "2*y_A*xi1 = 0", "2*y_B*xi2 = 0", "2*x_C*xi1 + 2*x_C*xi2 = 0", "xi1^2 + xi2^2 = 1"));
  const auto [line, message] =
      error_of([] { singularity_system(reference("three_slider"), SingularitySet::cspace_singular, KernelSide::right); });
  EXPECT_THAT(message, HasSubstr("Phi_q has 2 rows and 3 columns"));
  EXPECT_THAT(message, HasSubstr("expected the left kernel"));
}

TEST(SingularitySystem, AsksOfCorankTwoForTwoOrthonormalVectorsAndOneChoiceOfThem) {
  const TrigonometricSystem s =
      singularity_system(reference("three_slider"), SingularitySet::inverse, KernelSide::left, {"2", "1"}, 2);
  EXPECT_EQ(s.name, "three_slider inverse corank 2");
  EXPECT_EQ(s.corank, 2);
  EXPECT_THAT(s.kernel_unknowns, ElementsAre("xi1_1", "xi1_2", "xi2_1", "xi2_2"));
  EXPECT_THAT(texts(s.equations),
              ElementsAre("y_A^2 + x_C^2 = L1^2", "y_B^2 + x_C^2 = L2^2",                                       //
                          "2*y_A*(2*xi1_1) = 0", "2*x_C*(2*xi1_1) + 2*x_C*xi1_2 = 0",                           //
                          "2*y_A*(2*xi2_1) = 0", "2*x_C*(2*xi2_1) + 2*x_C*xi2_2 = 0", "xi1_1^2 + xi1_2^2 = 1",  //
                          "xi1_1*xi2_1 + xi1_2*xi2_2 = 0", "0.04*xi2_1 + 0.52*xi2_2 = 0", "xi2_1^2 + xi2_2^2 = 1"));
  EXPECT_THAT(texts(s.inequalities), ElementsAre("0.04*xi1_1 + 0.52*xi1_2 >= 0", "0.58*xi2_1 + 0.75*xi2_2 >= 0"));
  EXPECT_EQ(s.equations[4].source, "row 1 of L_z^T xi2 = 0");
  EXPECT_EQ(s.equations[8].source, "choice of xi2");
}

TEST(SingularitySystem, RefusesACorankThatNoKernelHas) {
  const auto of = [](SingularitySet set, int corank) {
    return error_of([=] { singularity_system(reference("three_slider"), set, std::nullopt, {}, corank); }).second;
  };
  EXPECT_THAT(of(SingularitySet::inverse, 3), HasSubstr("expected a corank from 1 to 2"));
  EXPECT_THAT(of(SingularitySet::inverse, 0), HasSubstr("expected a corank from 1 to 2"));
  EXPECT_THAT(of(SingularitySet::cspace, 2), HasSubstr("no corank"));
}

TEST(SingularitySystem, LeavesTheConfigurationSpaceAsItIs) {
  const TrigonometricSystem s = singularity_system(reference("three_slider"), SingularitySet::cspace);
  EXPECT_THAT(texts(s.equations), ElementsAre("y_A^2 + x_C^2 = L1^2", "y_B^2 + x_C^2 = L2^2"));
  EXPECT_TRUE(s.kernel_unknowns.empty());
  EXPECT_TRUE(s.inequalities.empty());
}

TEST(SingularitySystem, KeepsTheModelsInequalitiesApart) {
  const Mechanism m = model("x : [-1, 1]\ny : [-1, 1]", "x^2 + y^2 = 1;\nx >= 0;\ny <= 1/2;", "[INPUTS] x\n[OUTPUTS] y");
  const TrigonometricSystem s = singularity_system(m, SingularitySet::forward);
  EXPECT_THAT(texts(s.inequalities), ElementsAre("x >= 0", "y <= 1/2", "0.7326*xi1 >= 0"));
  EXPECT_THAT(texts(s.equations), ElementsAre("x^2 + y^2 = 1", "2*y*xi1 = 0", "xi1^2 = 1"));
  EXPECT_EQ(derive(m).phi.size(), 1u);
}

TEST(SingularitySystem, RenamesTheKernelVectorWhereTheModelUsesItsName) {
  const Mechanism m = model("xi1 : [-1, 1]\nxi_1 : [-1, 1]", "xi1^2 + xi_1^2 = 1;", "[INPUTS] xi1\n[OUTPUTS] xi_1");
  EXPECT_THAT(singularity_system(m, SingularitySet::forward).kernel_unknowns, ElementsAre("xi__1"));
}

TEST(SingularitySystem, ChoosesGenericWeightsForAnyLength) {
  std::string vars, equation = "t = 0";
  for (int i = 0; i < 40; ++i)
    vars += "x" + std::to_string(i) + " : [-1, 1]\n", equation += " + x" + std::to_string(i) + "^2";
  const Mechanism m = model(vars + "t : [-1, 1]", equation + ";", "");
  const TrigonometricSystem s = singularity_system(m, SingularitySet::cspace_singular);
  EXPECT_EQ(s.kernel_unknowns.size(), 1u);
  Mechanism many;
  std::vector<Expression> coordinates;
  for (int i = 0; i < 40; ++i) coordinates.push_back(many.length("x" + std::to_string(i), -1, 1));
  for (int i = 0; i < 40; ++i) many.constrain(coordinates[static_cast<std::size_t>(i)] == Expression(0));
  const TrigonometricSystem big = singularity_system(many, SingularitySet::cspace_singular);
  std::set<std::string> weights;
  for (const Expression& term : big.inequalities[0].relation.lhs.operands()) {
    const std::string weight = term.operands()[0].name();
    EXPECT_GE(std::stod(weight), 0.3);
    EXPECT_LE(std::stod(weight), 1.0);
    EXPECT_TRUE(weights.insert(weight).second) << weight;
  }
  EXPECT_EQ(weights.size(), 40u);
}

TEST(SingularitySystem, LeavesOutKernelRowsThatAreZero) {
  // The second equation binds the input alone: its row of L_y is zero.
  const Mechanism m = model("x : [-1, 1]\ny : [-1, 1]\nz : [-1, 1]", "x^2 + y^2 = 1;\nx = z;", "[INPUTS] x\n[OUTPUTS] y");
  const TrigonometricSystem s = singularity_system(m, SingularitySet::inverse);
  EXPECT_THAT(texts(s.equations),
              ElementsAre("x^2 + y^2 = 1", "x = z", "2*x*xi1 = 0", "xi1 - xi2 = 0", "xi1^2 + xi2^2 = 1"));
}

constexpr const char* kSphere = "t ~ [-pi, pi]\np ~ [-pi, pi]\nw @ unit";
constexpr const char* kLegs = "w_x*cos(t) + w_y*sin(t) = 1/3;\nw_y*cos(p) + w_z*sin(p) = 1/3;";
constexpr const char* kSphereChosen = "[INPUTS] t, p\n[OUTPUTS] w";

TEST(Ties, AreEquationsInOutputsOrInputsAlone) {
  const Derivation d = derive(model(kSphere, kLegs, kSphereChosen));
  EXPECT_TRUE(dependencies(d, Role::input).empty());
  EXPECT_THAT(dependencies(d, Role::output), ElementsAre(0u));
  EXPECT_THAT(without(d, Role::output).rows[0][0].text(), "0");
  const Derivation turned = derive(model(kSphere, kLegs, "[INPUTS] w\n[OUTPUTS] t, p"));
  EXPECT_THAT(dependencies(turned, Role::input), ElementsAre(0u));
  EXPECT_TRUE(dependencies(turned, Role::output).empty());
}

TEST(Ties, LetAsManyMoreOutputsOrInputsBeNamed) {
  for (const char* chosen : {kSphereChosen, "[INPUTS] w\n[OUTPUTS] t, p"}) {
    const Mechanism m = model(kSphere, kLegs, chosen);
    for (const SingularitySet set : {SingularitySet::forward, SingularitySet::inverse}) {
      for (const KernelSide side : {KernelSide::right, KernelSide::left}) {
        const TrigonometricSystem s = singularity_system(m, set, side);
        // Φ, a kernel row for each row (column) that counts, the norm: one more than the unknowns have beyond q.
        const bool tied = (set == SingularitySet::inverse) == (m.outputs().size() == 3);
        EXPECT_EQ(s.kernel_unknowns.size(), tied ? 2u : 3u);
        EXPECT_EQ(s.equations.size(), 3 + s.kernel_unknowns.size() + 1);
      }
    }
  }
}

TEST(Ties, LeaveTheKernelEquationsOfTheOtherRows) {
  const TrigonometricSystem s = singularity_system(model(kSphere, kLegs, kSphereChosen), SingularitySet::inverse);
  EXPECT_THAT(texts(s.equations),
              ElementsAre("w_x^2 + w_y^2 + w_z^2 = 1", "w_x*cos(t) + w_y*sin(t) = 1/3", "w_y*cos(p) + w_z*sin(p) = 1/3",
                          HasSubstr("*xi1 = 0"), HasSubstr("*xi2 = 0"), "xi1^2 + xi2^2 = 1"));
  EXPECT_EQ(s.equations[0].source, "m.cuik:4 (w @ unit)");
  EXPECT_EQ(s.equations[3].source, "row 2 of L_z xi = 0");
}

TEST(Ties, ThatDoNotMatchTheMobilityAreCounted) {
  auto [line, message] = error_of(
      [&] { singularity_system(model(kSphere, kLegs, "[INPUTS] t\n[OUTPUTS] w_x, w_y, w_z, p"), SingularitySet::inverse); });
  EXPECT_EQ(line, 8);
  EXPECT_THAT(message, HasSubstr("so mobility 2, but 1 input; expected 2 inputs"));
  std::tie(line, message) = error_of([&] {
    singularity_system(model(std::string(kSphere) + "\nx : [-1, 1]", std::string(kLegs) + "\nx = cos(t);", "[OUTPUTS] w, x"),
                       SingularitySet::inverse);
  });
  EXPECT_EQ(line, 10);
  EXPECT_THAT(message,
              HasSubstr("6 coordinates and 4 equations, so mobility 2, but 4 outputs tied by 1 equation, so 3 free: "
                        "they are not independent; expected 2 outputs, or 1 more equation in outputs only that ties them"));
  const Mechanism bound = model("x : [-1, 1]\ny : [-1, 1]", "x^2 = 1;", "[INPUTS] x\n[OUTPUTS] y");
  std::tie(line, message) = error_of([&] { singularity_system(bound, SingularitySet::forward); });
  EXPECT_THAT(message, HasSubstr("1 input tied by 1 equation, so 0 free; expected 2 inputs with these dependencies"));
}

TEST(Ties, ThatNeedPassiveCoordinatesAreAskedFor) {
  // |u| = 1 follows only together with p and r.
  const Mechanism m = model("u : [-1, 1]\nv : [-1, 1]\np : [-1, 1]\nr : [-1, 1]", "u = p;\nv = r;\np^2 + r^2 = 1;",
                            "[INPUTS] p\n[OUTPUTS] u, v");
  const auto [line, message] = error_of([&] { singularity_system(m, SingularitySet::inverse); });
  EXPECT_EQ(line, 11);
  EXPECT_THAT(message,
              HasSubstr("so mobility 1, but 2 outputs: they are not independent; expected 1 output, or 1 equation in "
                        "outputs only that ties them"));
}

TEST(SingularitySystem, RefusesOutputsThatLeaveNothingToMove) {
  const Mechanism m = model("w @ unit", "w_x = w_y;", "[OUTPUTS] w");
  const auto [line, message] = error_of([&] { singularity_system(m, SingularitySet::inverse); });
  EXPECT_EQ(line, 5);
  EXPECT_THAT(message, HasSubstr("every coordinate is an output"));
}

TEST(SingularitySystem, KnowsItsWords) {
  for (const char* word : {"cspace", "forward", "inverse", "cspace-singular"}) {
    ASSERT_TRUE(singularity_set_from_string(word));
    EXPECT_STREQ(to_string(*singularity_set_from_string(word)), word);
  }
  for (const char* word : {"right", "left"}) EXPECT_STREQ(to_string(*kernel_side_from_string(word)), word);
  EXPECT_FALSE(singularity_set_from_string("Forward"));
  EXPECT_FALSE(kernel_side_from_string(""));
}

// ---- errors
// -----------------------------------------------------------------------------------------------------------------------

const char* const kCircle = "x^2 + y^2 = 1;";
const char* const kVars = "x : [-1, 1]\ny : [-1, 1]";  // lines 2 and 3; the first equation is in line 5

TEST(SingularitySystem, ReportsMissingInputsOrOutputs) {
  const Mechanism plain = model(kVars, kCircle);
  auto [line, message] = error_of([&] { singularity_system(plain, SingularitySet::forward); });
  EXPECT_THAT(message, HasSubstr("m.cuik: the model names no inputs"));
  EXPECT_THAT(message, HasSubstr("expected a line [INPUTS], or `actuated` behind a joint"));
  std::tie(line, message) = error_of([&] { singularity_system(plain, SingularitySet::inverse); });
  EXPECT_THAT(message, HasSubstr("the model names no outputs"));
  EXPECT_NO_THROW(singularity_system(plain, SingularitySet::cspace));
}

TEST(SingularitySystem, ReportsInputsThatDoNotMatchTheMobility) {
  const Mechanism m = model("x : [-1, 1]\ny : [-1, 1]\nz : [-1, 1]", "x^2 + y^2 + z^2 = 1;", "[INPUTS] x\n[OUTPUTS] y, z");
  const auto [line, message] = error_of([&] { singularity_system(m, SingularitySet::forward); });
  EXPECT_EQ(line, 7);
  EXPECT_THAT(message, HasSubstr("3 coordinates and 1 equation, so mobility 2, but 1 input; expected 2 inputs"));
}

TEST(SingularitySystem, ReportsMoreOutputsThanTheMobility) {
  const Mechanism m =
      model("x : [-1, 1]\ny : [-1, 1]\nz : [-1, 1]", "x^2 + y^2 = 1;\nx = z;", "[INPUTS] x\n[OUTPUTS]\ny, z");
  const auto [line, message] = error_of([&] { singularity_system(m, SingularitySet::inverse); });
  EXPECT_GE(line, 9);
  EXPECT_THAT(message, HasSubstr("so mobility 1, but 2 outputs: they are not independent; expected 1 output"));
}

TEST(SingularitySystem, ReportsMoreEquationsThanCoordinates) {
  const Mechanism m = model(kVars, "x^2 + y^2 = 1;\nx = y;\nx + y = 1;", "[INPUTS] x\n[OUTPUTS] y");
  auto [line, message] = error_of([&] { singularity_system(m, SingularitySet::forward); });
  EXPECT_EQ(line, 8);
  EXPECT_THAT(message, HasSubstr("so mobility -1, but 1 input; expected at most as many equations as coordinates"));
  std::tie(line, message) = error_of([&] { singularity_system(m, SingularitySet::cspace_singular); });
  EXPECT_THAT(message, HasSubstr("Phi_q never has full row rank"));
}

TEST(Derivation, ReportsAnEquationThatCanNeverHold) {
  const auto [line, message] = error_of([] { derive(model(kVars, std::string(kCircle) + "\n1 = 2;")); });
  EXPECT_EQ(line, 6);
  EXPECT_THAT(message, HasSubstr("`1 = 2` can never hold"));
}

TEST(Derivation, ReportsAnEquationThatHoldsAlways) {
  const auto [line, message] = error_of([] { derive(model(kVars, std::string(kCircle) + "\n\nx + y - x = y;")); });
  EXPECT_EQ(line, 7);
  EXPECT_THAT(message, HasSubstr("always holds"));
}

TEST(Derivation, ReportsADivisionByZero) {
  const auto [line, message] = error_of([] { derive(model(kVars, "x/(1 - 1) = y;")); });
  EXPECT_EQ(line, 5);
  EXPECT_THAT(message, HasSubstr("has no value"));
}

TEST(Derivation, DifferentiatesDeeplyNestedEquations) {
  Mechanism m;
  const Expression a = m.constant("a", "3/2"), x = m.length("x", -1, 1), y = m.length("y", -1, 1);
  Expression nested = x;
  for (int i = 0; i < 30; ++i) nested = (a - y) * nested + x;  // Horner: 31 terms expanded, and none is
  m.constrain(nested == Expression(0));
  const Values at = {{"a", 1.5L}, {"x", 0.5L}, {"y", 0.75L}};
  long double power = 1, sum = 0;
  for (int i = 0; i <= 30; ++i, power *= 0.75L) sum += power;
  EXPECT_NEAR(static_cast<double>(evaluate(derive(m).velocity.matrix.rows[0][0], at)), static_cast<double>(sum), 1e-12);
}

TEST(Derivation, KeepsLargeNumbersExact) {
  EXPECT_EQ(texts(derive(model(kVars, "1e300*1e300*x + 1e-3*y^2 = 1/3;")).velocity.matrix),
            (Rows{{"1" + std::string(600, '0'), "0.002*y"}}));
}

TEST(Derivation, ReportsAPowerTooLargeToCompute) {
  Mechanism m;
  const Expression x = m.length("x", -1, 1);
  m.constrain(pow(pow(Expression(2) * x, 900), 900) == Expression(1), {"m.cuik", 3, 1});
  EXPECT_EQ(error_of([&] { derive(m); }).first, 3);
}

}  // namespace
}  // namespace corank::symbolic
