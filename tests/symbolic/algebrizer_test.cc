// The algebrizer against direct evaluation of the trigonometric system.
#include "corank/tests/symbolic/compiled_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace corank::symbolic {
namespace {

using ::testing::ElementsAre;

System reference_set(const std::string& name, SingularitySet set, std::optional<KernelSide> side = {}) {
  return algebrize(singularity_system(read_model(std::string(CORANK_SOURCE_DIR) + "/models/" + name + ".cuik"), set, side));
}

TEST(Algebrizer, MakesDextarsForwardSystem) {
  const System s = reference_set("dextar", SingularitySet::forward);
  std::vector<std::string> names;
  for (const auto& variable : s.variables) names.push_back(variable.name);
  EXPECT_THAT(names, ElementsAre("J3x", "J3y", "c_theta2", "s_theta2", "c_theta3", "s_theta3", "c_theta4", "s_theta4",
                                 "c_theta5", "s_theta5", "xi1", "xi2", "xi3", "xi4"));
  EXPECT_EQ(s.name, "dextar forward");
  EXPECT_EQ(s.configuration_size, 10);
  EXPECT_EQ(s.equations.size(), 13u);
  EXPECT_EQ(s.dimension(), 1);
  EXPECT_EQ(s.variables[0].kind, VariableKind::length);
  EXPECT_EQ(s.variables[2].kind, VariableKind::cosine);
  EXPECT_EQ(s.variables[3].kind, VariableKind::sine);
  EXPECT_EQ(s.variables[10].kind, VariableKind::kernel);
  EXPECT_EQ(s.variables[0].upper.text(), "9/5");
  EXPECT_EQ(s.equations[0].source, "dextar.cuik:27");
  EXPECT_EQ(s.equations[4].source, "circle of theta2");
  EXPECT_EQ(s.equations[8].source, "row 1 of L_y xi = 0");
  ASSERT_EQ(s.angles.size(), 4u);
  EXPECT_EQ(s.angles[1].name, "theta3");
  EXPECT_EQ(s.angles[1].cosine, 4);
  EXPECT_EQ(s.angles[1].sine, 5);
  EXPECT_NEAR(s.angles[1].range.hi(), 3.14159265358979, 1e-14);
  ASSERT_EQ(s.inequalities.size(), 1u);  // the whole circle needs no condition
  EXPECT_EQ(s.inequalities[0].source, "half-space of xi");
  EXPECT_EQ(canonical(s.equations[0]), " + 59/50 + 9/10·x2^1 + 9/10·x4^1 + 9/10·x6^1 + -9/10·x8^1");
}

TEST(Algebrizer, MakesTheThreeSlidersSystems) {
  const System s = reference_set("three_slider", SingularitySet::inverse);
  EXPECT_THAT(canonical(s.equations),
              ElementsAre(" + -1 + 1·x0^2 + 1·x2^2", " + -16/25 + 1·x1^2 + 1·x2^2",  //
                          " + 2·x0^1·x3^1 + 2·x2^1·x4^1", " + 2·x2^1·x4^1", " + -1 + 1·x3^2 + 1·x4^2"));
  EXPECT_EQ(s.dimension(), 0);
  EXPECT_EQ(reference_set("three_slider", SingularitySet::cspace_singular).equations.size(), 6u);
}

TEST(Algebrizer, GivesTheSameSystemForAMechanismBuiltInCpp) {
  Mechanism m("three_slider");
  const Expression l1 = m.constant("L1", 1), l2 = m.constant("L2", "4/5");
  const Expression y_a = m.length("y_A", -l1, l1), y_b = m.length("y_B", -l2, l2), x_c = m.length("x_C", -l1, l1);
  m.constrain(pow(y_a, 2) + pow(x_c, 2) == pow(l1, 2));
  m.constrain(pow(y_b, 2) + pow(x_c, 2) == pow(l2, 2));
  m.inputs({y_a});
  m.outputs({y_b});
  for (const auto set :
       {SingularitySet::cspace, SingularitySet::forward, SingularitySet::inverse, SingularitySet::cspace_singular}) {
    const System built = algebrize(singularity_system(m, set)), read = reference_set("three_slider", set);
    EXPECT_EQ(built.name, read.name);
    EXPECT_EQ(canonical(built.equations), canonical(read.equations));
    EXPECT_EQ(canonical(built.inequalities), canonical(read.inequalities));
    ASSERT_EQ(built.size(), read.size());
    for (std::size_t i = 0; i < built.variables.size(); ++i) {
      EXPECT_EQ(built.variables[i].name, read.variables[i].name);
      EXPECT_EQ(built.variables[i].domain, read.variables[i].domain);
    }
  }
}

TEST(Algebrizer, MakesPolynomialsInTheVariablesOfItsSystem) {
  const auto text = [](const std::string& model, const std::vector<std::string>& expressions) {
    const TrigonometricSystem system = plain_system(parse_model(model, "m.cuik"));
    std::vector<Expression> parsed;
    for (const std::string& e : expressions) parsed.push_back(parse_expression(e, "test"));
    std::vector<std::string> result;
    for (const Polynomial& p : polynomials(system, parsed)) result.push_back(canonical(p));
    return result;
  };
  const std::string fixed =
      "[CONSTANTS]\nl := 3/2\n[SYSTEM VARS]\nx : [-2, 2]\na ~ [-pi, pi]\nb ~ [pi/3, pi/3]\n"
      "[SYSTEM EQS]\nx = l*cos(a)+sin(b);\n";
  EXPECT_THAT(text(fixed, {"l*sin(2*a)", "x^2-1", "0", "cos(a+b)"}),
              ElementsAre(" + 3·x1^1·x2^1", " + -1 + 1·x0^2", "", " + 1/2·x1^1 + -1/2*sqrt(3)·x2^1"));
  EXPECT_THROW(text("[SYSTEM VARS]\nx : [-2, 2]\n[SYSTEM EQS]\nx = 1/2;\n", {"sin(x)"}), ModelError);
}

TEST(Algebrizer, RenamesAVariableWhoseNameIsTaken) {
  const System s = compile(
      "[CONSTANTS]\ns_theta := 2\n[SYSTEM VARS]\ntheta ~ [-pi, pi]\nc_theta : [0, 1]\n[SYSTEM EQS]\nc_theta = cos(theta);");
  EXPECT_EQ(s.variables[0].name, "c_theta_");
  EXPECT_EQ(s.variables[1].name, "s_theta_");
  EXPECT_EQ(s.variables[2].name, "c_theta");
}

TEST(Algebrizer, GivesAnUnusedAngleItsVariables) {
  const System s = compile(with_equation("x^2 = 1/4;"));
  EXPECT_EQ(s.angles.size(), 2u);
  EXPECT_EQ(s.equations.size(), 3u);
}

TEST(Algebrizer, ExpandsSumsAndMultiplesOfAngles) {
  // x0 = x, x1 = cos theta, x2 = sin theta, x3 = cos psi, x4 = sin psi
  EXPECT_EQ(only_equation("cos(theta + psi) = x;"), " + -1·x0^1 + 1·x1^1·x3^1 + -1·x2^1·x4^1");
  EXPECT_EQ(only_equation("sin(theta - psi) = x;"), " + -1·x0^1 + -1·x1^1·x4^1 + 1·x2^1·x3^1");
  EXPECT_EQ(only_equation("cos(2*theta) = x;"), " + -1 + -1·x0^1 + 2·x1^2");
  EXPECT_EQ(only_equation("sin(theta + pi/2) = x;"), " + -1·x0^1 + 1·x1^1");
  EXPECT_EQ(only_equation("sin(3*(theta + pi)/3 - theta) = x;"), " + -1·x0^1");
  EXPECT_EQ(only_equation("cos(theta + pi/7) = x;"), " + -1·x0^1 + cos(1/7*pi)·x1^1 + -sin(1/7*pi)·x2^1");
}

TEST(Algebrizer, KeepsCoefficientsExact) {
  EXPECT_EQ(only_equation("sqrt(2)*x*sqrt(2) = 0.90;"), " + -9/10 + 2·x0^1");
  EXPECT_EQ(only_equation("(1 + sqrt(2))^2*x = sin(pi/6);"), " + -1/2 + 3 + 2*sqrt(2)·x0^1");
  EXPECT_EQ(only_equation("sqrt(12)*x - 2*sqrt(3)*x + x = 0;"), " + 1·x0^1");
  EXPECT_EQ(only_equation("x/3 = 1e-3;"), " + -1/1000 + 1/3·x0^1");
  EXPECT_EQ(only_equation("cos(pi/7)^2*x + sin(pi/7)^2*x - x + cos(theta) = 0;"), " + 1·x1^1");
  EXPECT_EQ(only_equation("2^(1/3)*x = exp(1);"), " + -exp(1) + exp(1/3*log(2))·x0^1");
}

TEST(Algebrizer, AgreesWithDirectEvaluationOnRandomMechanisms) {
  RandomMechanism generator(kSeed);
  for (int i = 0; i < 60; ++i) {
    const Mechanism mechanism = generator.make(2);
    const TrigonometricSystem trigonometric = plain_system(mechanism);
    const System system = algebrize(trigonometric);
    for (int k = 0; k < 5; ++k) {
      const Values values = generator.point(mechanism);
      const std::vector<long double> x = compiled_point(system, values);
      for (std::size_t j = 0; j < 2; ++j) {
        const double direct = static_cast<double>(residual(trigonometric.equations[j].relation, values));
        long double size = 1;  // of the terms that cancel
        for (const auto& monomial : system.equations[j].monomials)
          size += std::fabs(evaluate(Polynomial{{monomial}, ""}, x));
        ASSERT_NEAR(static_cast<double>(evaluate(system.equations[j], x)), direct, 1e-14 * static_cast<double>(size))
            << "seed " << kSeed << ": " << trigonometric.equations[j].relation;
      }
    }
  }
}

TEST(Algebrizer, AgreesWithDirectEvaluationOnSingularitySystems) {
  RandomMechanism generator(kSeed + 1);
  for (int i = 0; i < 6; ++i) {
    const Mechanism mechanism = generator.make(3);
    const TrigonometricSystem trigonometric = singularity_system(mechanism, SingularitySet::cspace_singular);
    const System system = algebrize(trigonometric);
    Values values = generator.point(mechanism);
    for (const std::string& xi : trigonometric.kernel_unknowns) values[xi] = generator.uniform(-1, 1);
    const std::vector<long double> x = compiled_point(system, values);
    std::map<std::string, const Polynomial*> by_source;
    for (const auto& polynomial : system.equations) by_source[polynomial.source] = &polynomial;
    for (const auto& equation : trigonometric.equations) {
      ASSERT_TRUE(by_source.contains(equation.source)) << equation.source;
      const Polynomial& polynomial = *by_source[equation.source];
      long double size = 1;
      for (const auto& monomial : polynomial.monomials) size += std::fabs(evaluate(Polynomial{{monomial}, ""}, x));
      ASSERT_NEAR(static_cast<double>(evaluate(polynomial, x)), static_cast<double>(residual(equation.relation, values)),
                  1e-13 * static_cast<double>(size))
          << "seed " << kSeed + 1 << ": " << equation.relation;
    }
  }
}

TEST(Algebrizer, ExpandsMultiplesUpToItsLimit) {
  for (const int n : {1, -1, 5, 17, 64}) {
    const System s = compile(with_equation("cos(" + std::to_string(n) + "*theta - 1) = x;"));
    for (const long double theta : {-3.0L, -0.4L, 1.1L, 2.5L}) {
      // T_64 has coefficients of 2^63 in double enclosures: only near the ends of [-1, 1] would this lose all digits.
      const double tolerance = n == 64 ? 1e7 : n == 17 ? 1e-9 : 1e-14;
      const auto x = compiled_point(s, {{"x", 0.25L}, {"theta", theta}, {"psi", 0}});
      EXPECT_NEAR(static_cast<double>(evaluate(s.equations[0], x)), static_cast<double>(std::cos(n * theta - 1) - 0.25L),
                  tolerance)
          << n;
    }
  }
}

TEST(Algebrizer, ExpandsHighDegreesOfLengths) {
  EXPECT_EQ(compile(with_equation("x^64 = 1/2;")).equations[0].degree(), 64);
  EXPECT_EQ(compile(with_equation("(x^3 + x^2 + x + 1)^60 = 1/2;")).equations[0].monomials.size(), 181u);
  EXPECT_EQ(compile(with_equation("(x + cos(theta))^3*sin(theta) = 1/2;")).equations[0].degree(), 4);
}

TEST(Algebrizer, TurnsInequalitiesIntoPolynomialsThatAreNotNegative) {
  const System s = compile(with_equation("x = cos(theta);\nx >= 1/3;\nx <= sin(theta);\n1 <= 2;"));
  EXPECT_THAT(canonical(s.inequalities), ElementsAre(" + -1/3 + 1·x0^1", " + -1·x0^1 + 1·x2^1"));
}

TEST(Algebrizer, DropsKernelRowsThatTheConstantsMakeZero) {
  const Mechanism m = parse_model(
      "[CONSTANTS]\na := 0\n[SYSTEM VARS]\nx : [-1, 1]\ny : [-1, 1]\nz : [-1, 1]\n[SYSTEM EQS]\n"
      "x^2 + a*y^2 = 1/4;\ny = z;\n[INPUTS] x\n[OUTPUTS] z",
      "m.cuik");
  EXPECT_EQ(algebrize(singularity_system(m, SingularitySet::forward)).equations.size(), 4u);
}

}  // namespace
}  // namespace corank::symbolic
