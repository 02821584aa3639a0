// Requirements as texts, and what they become.
#include "corank/symbolic/sets/requirements.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "corank/symbolic/model/evaluate.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/model/requirement_text.h"
#include "corank/symbolic/sets/parameters.h"
#include "corank/symbolic/writing/printer.h"

namespace corank::symbolic {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const Mechanism& dextar() {
  static const Mechanism model = read_model(std::string(CORANK_SOURCE_DIR) + "/models/dextar.cuik");
  return model;
}
const Mechanism& rrr() {
  static const Mechanism model = read_model(std::string(CORANK_SOURCE_DIR) + "/models/3rrr.cuik");
  return model;
}

template <class Limit>
Limit parsed(const std::string& text) {
  return std::get<Limit>(parse_requirement(text).limit);
}

TEST(RequirementText, HasTheFormsOfItsKinds) {
  const auto plain = parsed<AmplificationLimit>("amplification(outputs) <= 3/2");
  EXPECT_EQ(plain.role, Role::output);
  EXPECT_EQ(plain.most.value.text(), "3/2");
  const auto metric = parsed<AmplificationLimit>("amplification( inputs )<=k metric x: 1 mm, phi:2 deg");
  EXPECT_EQ(metric.role, Role::input);
  ASSERT_EQ(metric.metric.size(), 2u);
  EXPECT_EQ(metric.metric[0].name + metric.metric[0].quantity.unit, "xmm");
  EXPECT_EQ(metric.metric[1].name + metric.metric[1].quantity.unit, "phideg");

  const auto effort = parsed<EffortLimit>("torque(theta2) <= 3 N m under force(x, y) <= 50 N, moment(phi) <= 2 kN*mm");
  EXPECT_TRUE(effort.torque);
  EXPECT_EQ(effort.motor, "theta2");
  EXPECT_EQ(effort.most.unit, "N m");
  ASSERT_EQ(effort.loads.size(), 2u);
  EXPECT_THAT(effort.loads[0].names, ElementsAre("x", "y"));
  EXPECT_EQ(effort.loads[0].most.unit, "N");
  EXPECT_TRUE(effort.loads[1].moment);
  EXPECT_EQ(effort.loads[1].most.unit, "kN mm");

  const auto tension = parsed<TensionLimit>("tension(d1, d2) in [5 N, 2/10 kN] under force(y) = -98 N, force(x, y)<=20");
  EXPECT_THAT(tension.cables, ElementsAre("d1", "d2"));
  EXPECT_EQ(tension.least.value.text() + tension.least.unit, "5N");
  EXPECT_EQ(tension.most.unit, "kN");
  ASSERT_EQ(tension.loads.size(), 2u);
  EXPECT_TRUE(tension.loads[0].constant);
  EXPECT_EQ(tension.loads[0].most.value.text(), "-98");
  EXPECT_FALSE(tension.loads[1].constant);

  const auto error = parsed<ErrorLimit>("error(x, y) <= 0.1 mm under inputs ± 0.01 deg");
  EXPECT_THAT(error.names, ElementsAre("x", "y"));
  EXPECT_EQ(error.most.unit, "mm");
  ASSERT_EQ(error.inputs.size(), 1u);
  EXPECT_EQ(error.inputs[0].name, "inputs");
  EXPECT_EQ(parsed<ErrorLimit>("error(x) <= 1 under a +- 1, b <= 2").inputs.size(), 2u);

  const auto distance = parsed<DistanceLimit>("distance(A B radius 3 mm, arm) >= 5 mm");
  ASSERT_EQ(distance.bodies.size(), 2u);
  EXPECT_THAT(distance.bodies[0].names, ElementsAre("A", "B"));
  EXPECT_EQ(distance.bodies[0].radius.value().unit, "mm");
  EXPECT_THAT(distance.bodies[1].names, ElementsAre("arm"));
  EXPECT_FALSE(distance.bodies[1].radius);
  EXPECT_EQ(distance.least.value.text() + distance.least.unit, "5mm");
  const auto pressure = parsed<LineAngleLimit>("pressure_angle(A B, P Q) <= 45 deg");
  EXPECT_FALSE(pressure.least);
  EXPECT_THAT(pressure.points, ElementsAre(ElementsAre("A", "B"), ElementsAre("P", "Q")));
  EXPECT_EQ(pressure.limit.unit, "deg");
  const auto transmission = parsed<LineAngleLimit>("transmission_angle(A B C) >= 1");
  EXPECT_TRUE(transmission.least);
  EXPECT_THAT(transmission.points, ElementsAre(ElementsAre("A", "B", "C")));

  EXPECT_EQ(parsed<Relation>("x^2 + y^2 <= 4").text(), "x^2 + y^2 <= 4");
  EXPECT_EQ(parsed<Relation>("sin(theta) >= 1/2").text(), "sin(theta) >= 1/2");
  EXPECT_EQ(parsed<Relation>("torque <= 1").text(), "torque <= 1") << "a name like another";
}

std::string fault_in(const std::string& text) {
  try {
    parse_requirement(text);
  } catch (const ModelError& error) {
    return error.what();
  }
  return "none";
}

TEST(RequirementText, SaysWhereItsFaultIs) {
  EXPECT_THAT(fault_in(""), HasSubstr("expected a number, a name"));
  EXPECT_THAT(fault_in("amplification(x) <= 1"), HasSubstr("expected outputs or inputs"));
  EXPECT_THAT(fault_in("amplification(outputs) < 1"), HasSubstr("expected '<='"));
  EXPECT_THAT(fault_in("amplification(outputs) <= 1 m"), ::testing::Eq("none")) << "its unit is refused later";
  EXPECT_THAT(fault_in("amplification(outputs) <= 1 miles"), HasSubstr("expected the end of the requirement"));
  EXPECT_THAT(fault_in("amplification(outputs) <= 1 metric"), HasSubstr("expected the name of an input"));
  EXPECT_THAT(fault_in("amplification(outputs) <= 1 metric x 1"), HasSubstr("expected ':'"));
  EXPECT_THAT(fault_in("torque(a) <= 1"), HasSubstr("expected a unit, or under"));
  EXPECT_THAT(fault_in("torque(a, b) <= 1 under force(x) <= 1"), HasSubstr("one motor"));
  EXPECT_THAT(fault_in("torque(a) <= 1 under weight(x) <= 1"), HasSubstr("expected force or moment"));
  EXPECT_THAT(fault_in("torque(a) <= 1 under force(x <= 1"), HasSubstr("expected ',' or ')'"));
  EXPECT_THAT(fault_in("torque() <= 1 under force(x) <= 1"), HasSubstr("expected the name of a coordinate"));
  EXPECT_THAT(fault_in("tension(d) <= 1"), HasSubstr("expected in and a range"));
  EXPECT_THAT(fault_in("tension(d) in 1"), HasSubstr("expected '['"));
  EXPECT_THAT(fault_in("tension(d) in [1]"), HasSubstr("expected a unit, or ','"));
  EXPECT_THAT(fault_in("tension(d) in [1, 2"), HasSubstr("expected a unit, or ']'"));
  EXPECT_THAT(fault_in("tension(d) in [1, 2]"), HasSubstr("under"));
  EXPECT_THAT(fault_in("tension(d) in [1, 2] under force(x, y) = 1"), HasSubstr("works on one rate"));
  EXPECT_THAT(fault_in("tension(d) in [1, 2] under force(x) 1"), HasSubstr("expected '<=' or '='"));
  EXPECT_THAT(fault_in("error(x) <= 1 under inputs = 1"), HasSubstr("expected '<=' or '±'"));
  EXPECT_THAT(fault_in("error(x) <= 1 under <= 1"), HasSubstr("expected inputs"));
  EXPECT_THAT(fault_in("distance(A, B) <= 1"), HasSubstr("expected '>='"));
  EXPECT_THAT(fault_in("distance(A) >= 1"), HasSubstr("expected a point, radius, or ','"));
  EXPECT_THAT(fault_in("distance(A, ) >= 1"), HasSubstr("expected the name of a body"));
  EXPECT_THAT(fault_in("distance(A, B, C) >= 1"), HasSubstr("expected ')'"));
  EXPECT_THAT(fault_in("pressure_angle(A B, C D) >= 1"), HasSubstr("expected '<='"));
  EXPECT_THAT(fault_in("transmission_angle(A B C) <= 1"), HasSubstr("expected '>='"));
  EXPECT_THAT(fault_in("x = 1"), HasSubstr("expected an operator, '<=' or '>='"));
  EXPECT_THAT(fault_in("x <= 1 N"), HasSubstr("requirement:1:8"));
  EXPECT_THAT(fault_in(std::string("x <= \xFF")), HasSubstr("requirement:1:"));
}

Mechanism with(Mechanism model, const std::vector<std::string>& texts) {
  for (const std::string& text : texts) model.require(text);
  return model;
}

FamilySystem family(const std::vector<std::string>& texts) {
  return family_system(with(dextar(), texts), {.set = SingularitySet::cspace, .over = {{"theta2", "0", "1"}}});
}

TEST(Requirements, HaveUnits) {
  // Of the model in dm: 3 N m are 30 N dm, 5 mm are 1/20 dm.
  const std::vector<Requirement> r =
      family({"torque(theta2) <= 3 N m under force(J3x, J3y) <= 1 kN", "error(J3x) <= 5 mm under inputs ± 90 deg"})
          .requirements;
  ASSERT_EQ(r[0].tests.size(), 1u);
  EXPECT_EQ(r[0].tests[0].bound.text(), "30");
  ASSERT_EQ(r[0].tests[0].groups.size(), 1u);
  EXPECT_EQ(r[0].tests[0].groups[0].weight.text(), "1000");
  EXPECT_EQ(r[1].tests.size(), 2u) << "the corners of two inputs' errors, up to the sign";
  EXPECT_EQ(r[1].tests[0].bound.text(), "1/20");
}

TEST(Requirements, ShareTheFunctionsThatTheyHold) {
  const std::string text = "amplification(outputs) <= 2";
  const auto size = [](const std::vector<std::string>& texts) { return family(texts).system.size(); };
  EXPECT_GT(size({text}), size({}));
  EXPECT_EQ(size({text, text}), size({text}));
}

std::string refusal(const Mechanism& model, const std::string& text, const std::vector<std::string>& parameters = {}) {
  try {
    Requirements(with(model, {text}), parameters);
  } catch (const ModelError& error) {
    return error.what();
  }
  return "none";
}

TEST(Requirements, AreRefusedWhereTheyMeanNothing) {
  EXPECT_THAT(refusal(dextar(), "torque(theta3) <= 1 under force(J3x) <= 1"), HasSubstr("'theta3' is no input"));
  EXPECT_THAT(refusal(dextar(), "torque(theta22) <= 1 under force(J3x) <= 1"), HasSubstr("did you mean 'theta2'"));
  EXPECT_THAT(refusal(dextar(), "force(theta2) <= 1 under force(J3x) <= 1"), HasSubstr("is an angle; expected torque"));
  EXPECT_THAT(refusal(dextar(), "torque(theta2) <= 1 N under force(J3x) <= 1"), HasSubstr("N is the unit of a force"));
  EXPECT_THAT(refusal(dextar(), "torque(theta2) <= 1 under moment(J3x) <= 1"), HasSubstr("'J3x' is a length"));
  EXPECT_THAT(refusal(dextar(), "torque(theta2) <= 1 under force(J3x, J3x) <= 1"), HasSubstr("occurs twice"));
  EXPECT_THAT(refusal(dextar(), "torque(theta2) <= 1 under force(theta5) <= 1"), HasSubstr("is an input"));
  EXPECT_THAT(refusal(dextar(), "torque(theta2) <= -1 under force(J3x) <= 1"), HasSubstr("is not positive"));
  EXPECT_THAT(refusal(dextar(), "amplification(outputs) <= 1 m"), HasSubstr("has no unit"));
  EXPECT_THAT(refusal(dextar(), "error(J3x) <= 1 deg under inputs <= 1"),
              HasSubstr("deg is the unit of an angle; expected the unit of a length"));
  EXPECT_THAT(refusal(dextar(), "error(J3x) <= 1 under theta2 <= 1"), HasSubstr("the error of 'theta5' is not given"));
  EXPECT_THAT(refusal(dextar(), "amplification(outputs) <= 2*l", {"l"}), HasSubstr("depends on a parameter"));
  EXPECT_THAT(refusal(dextar(), "amplification(outputs) <= 2*l2", {"l"}), HasSubstr("depends on a parameter"))
      << "through another constant";
  EXPECT_THAT(refusal(rrr(), "amplification(outputs) <= 1"), HasSubstr("expected metric"));
  EXPECT_THAT(refusal(rrr(), "amplification(outputs) <= 1 metric x: 1, y: 1"), HasSubstr("'phi' has no metric"));
  EXPECT_THAT(refusal(rrr(), "error(x, phi) <= 1 under inputs <= 1"), HasSubstr("a requirement for each"));
  EXPECT_THAT(refusal(rrr(), "error(x) <= 1 mm under inputs <= 1"), HasSubstr("unit"));
  EXPECT_THAT(refusal(parse_model("[SYSTEM VARS]\nx : [0, 1]\n[SYSTEM EQS]\nx^2 = x;", "m"), "amplification(outputs) <= 1"),
              HasSubstr("a plain system"));
}

TEST(Requirements, HaveASectionInAModel) {
  const std::string text =
      "[SYSTEM VARS]\nx : [-2, 2]\nu ~ [-pi, pi]\n[SYSTEM EQS]\nx = cos(u);\n[INPUTS] u\n[OUTPUTS] x\n"
      "[REQUIREMENTS]\namplification(outputs) <= 1/2;  % slow\n  x <= 1;\n";
  const Mechanism model = parse_model(text, "m.cuik");
  EXPECT_THAT(model.requirement_texts(), ElementsAre("amplification(outputs) <= 1/2", "x <= 1"));
  EXPECT_THAT(parse_model(to_model(model), "m.cuik").requirement_texts(),
              ElementsAre("amplification(outputs) <= 1/2", "x <= 1"));
  const auto fault_of = [&](const std::string& line) -> std::string {
    try {
      parse_model(text + line, "m.cuik");
    } catch (const ModelError& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_THAT(fault_of("x <=\n 1;"), ::testing::Eq("none"));
  EXPECT_THAT(fault_of("x <= 1 % slow\n;"), HasSubstr("has a comment in it"));
  EXPECT_THAT(fault_of("x < 1;"), HasSubstr("m.cuik:11:3: "));
  EXPECT_THAT(fault_of("x <= 1"), HasSubstr("expected ';' after the requirement"));
  EXPECT_THAT(fault_of(";"), HasSubstr("expected a requirement, or a section"));
}

// x = cos u: |dx/du| = |sin u| ≤ 1/2 is at its limit where sin u = ±1/2; x ≤ 1/4 where x = 1/4.
TEST(Requirements, ReachTheirLimitsOnASet) {
  const Mechanism model = parse_model(
      "[SYSTEM VARS]\nx : [-2, 2]\nu ~ [-pi, pi]\n[SYSTEM EQS]\nx = cos(u);\n[INPUTS] u\n[OUTPUTS] x\n", "m.cuik");
  const auto matrix = [&](const std::string& text) {
    return kernel_question(with(model, {text}), SingularitySet::requirements).matrix;
  };
  const ExpressionMatrix of_form = matrix("amplification(outputs) <= 1/2");
  EXPECT_EQ(of_form.rows.size(), 3u);
  EXPECT_EQ(of_form.columns.size(), 3u);
  EXPECT_EQ(matrix("x <= 1/4").rows.size(), 1u);
  EXPECT_EQ(matrix("x <= 1/4").rows[0][0].text(), "-0.25 + x");
  EXPECT_THROW(kernel_question(model, SingularitySet::requirements), ModelError) << "there are none";
}

// With the motor locked, u moves x: A = (1, sin u), and F |m_x| = 1/2 |m_u| asks for no multipliers.
TEST(Requirements, OfEffortsTakeSeveralLoadsWithoutMultipliers) {
  const Mechanism model = parse_model(
      "[SYSTEM VARS]\nx : [-2, 2]\ny : [-2, 2]\nu ~ [-pi, pi]\n[SYSTEM EQS]\nx = cos(u);\ny = sin(u);\n"
      "[INPUTS] u\n[OUTPUTS] x, y\n",
      "m.cuik");
  const Mechanism one = with(model, {"torque(u) <= 1/2 under force(x) <= 3, force(x, y) <= 1"});
  const KernelQuestion kernel = kernel_question(one, SingularitySet::requirements);
  EXPECT_EQ(kernel.matrix.rows.size(), 2u);
  EXPECT_EQ(kernel.matrix.columns.size(), 3u);
  const TrigonometricSystem system = singularity_system(one, SingularitySet::requirements);
  EXPECT_EQ(system.kernel_unknowns.size(), 3u);
  EXPECT_EQ(system.further_unknowns.size(), 2u);
  EXPECT_THROW(singularity_system(one, SingularitySet::requirements, KernelSide::left), ModelError);
  EXPECT_THROW(singularity_system(one, SingularitySet::requirements, {}, {}, 2), ModelError);
  const Mechanism two = with(model, {"torque(u) <= 1/2 under force(x) <= 3, force(x, y) <= 1", "x <= 1"});
  const std::vector<RequirementPart> parts = requirement_parts(two);
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_EQ(parts[1].name, "x <= 1");
  EXPECT_EQ(kernel_question(two, parts[1]).matrix.rows.size(), 1u);
  EXPECT_THROW(at_requirements(two), ModelError) << "one matrix for all has one load";
}

// Three motors for two freedoms: the loads do not say what each of them does. And equations that leave no freedom.
TEST(Requirements, OfMotorsThatTheLoadsDoNotDetermineAreRefused) {
  Mechanism more = dextar();
  more.inputs({Expression("theta3")});
  EXPECT_THAT(refusal(more, "torque(theta2) <= 1 under force(J3x) <= 1"), HasSubstr("as many inputs as the mobility"));
  EXPECT_EQ(refusal(more, "amplification(outputs) <= 1"), "none");
  const Mechanism stuck = parse_model(
      "[SYSTEM VARS]\nx : [-2, 2]\nu ~ [-pi, pi]\n[SYSTEM EQS]\nx = cos(u);\nx = sin(u);\nx^2 = 1/2;\n"
      "[INPUTS] u\n[OUTPUTS] x\n[REQUIREMENTS]\nx <= 1;\n",
      "m.cuik");
  EXPECT_THROW(kernel_question(stuck, SingularitySet::requirements), ModelError);
}

// As where a ball is about its values.
TEST(Requirements, KnowAnAngleThatCountsAsALength) {
  Mechanism model = rrr();
  model.unroll("phi", -1, 1);
  EXPECT_EQ(refusal(model, "amplification(outputs) <= 1 metric x: 1, y: 1, phi: 1 deg"), "none");
  EXPECT_EQ(refusal(model, "torque(theta1) <= 1 under moment(phi) <= 1"), "none");
}

// Of the model in dm: 10 mm and two radii of 3 mm are 0.16 dm. A drawing in the plane, and points that are numbers.
TEST(Requirements, OfDistancesKnowTheirBodies) {
  const std::vector<Requirement> r = family({"distance(J5 J4 radius 3 mm, J1 J2 radius 3 mm) >= 10 mm"}).requirements;
  ASSERT_EQ(r[0].distances.size(), 1u);
  const DistanceTest& test = r[0].distances[0];
  EXPECT_EQ(test.least.text(), "4/25");
  ASSERT_EQ(test.hulls[0].size(), 2u);
  EXPECT_EQ(test.hulls[0][0][0].variable, -1) << "J5 is the origin";
  EXPECT_GE(test.hulls[0][1][0].variable, 0);
  EXPECT_EQ(test.hulls[0][1][2].variable, -1) << "in the plane";
}

const char* const kDrawn =
    "[SYSTEM VARS]\nx : [-2, 2]\nu ~ [-pi, pi]\n[SYSTEM EQS]\nx = cos(u);\n[INPUTS] u\n[OUTPUTS] x\n[DRAWING]\n"
    "unit m\npoint A = (0, 0, 0)\npoint B = (x, 0, 1)\npoint C = (x, 1, 1)\npoint D = (x, 1, 2)\n"
    "link bar = A B #aabbcc\nsphere ball = A radius 1/4\ncylinder tool = A B radius 1/2\nball A\n"
    "platform plate = A B C\nplatform plate = B C D\nlink A C\nlink tool = C D\n";

TEST(Requirements, OfDistancesTakeBodiesOfTheDrawing) {
  const Mechanism model = parse_model(kDrawn, "m.cuik");
  EXPECT_EQ(model.drawing().parts[0].name, "bar");
  EXPECT_EQ(model.drawing().parts[6].name, "");
  const auto distances = [&](const std::string& text) {
    return Requirements(with(model, {text})).of_functions().at(0).distances;
  };
  EXPECT_EQ(distances("distance(bar, ball) >= 1").at(0).least.text(), "5/4") << "and the ball's radius";
  EXPECT_EQ(distances("distance(bar radius 1/4, ball radius 50 cm) >= 1").at(0).least.text(), "2");
  ASSERT_EQ(distances("distance(tool, ball) >= 0").size(), 2u) << "each part of a body";
  EXPECT_EQ(distances("distance(tool, ball) >= 0").at(0).least.text(), "3/4");
  EXPECT_EQ(distances("distance(tool, ball) >= 0").at(1).least.text(), "1/4");
  ASSERT_EQ(distances("distance(plate, ball) >= 0").size(), 1u) << "but faces are those of one solid";
  EXPECT_EQ(distances("distance(plate, ball) >= 0").at(0).hulls[0].size(), 6u);
}

TEST(Requirements, AreWrittenWithTheBodiesThatTheyName) {
  const Mechanism model = with(parse_model(kDrawn, "m.cuik"), {"distance(bar, ball) >= 1"});
  const Mechanism again = parse_model(to_model(model), "again.cuik");
  EXPECT_EQ(again.requirement_texts(), model.requirement_texts());
  std::vector<std::string> names;
  for (const DrawingPart& part : again.drawing().parts) names.push_back(part.name);
  EXPECT_THAT(names, ElementsAre("bar", "ball", "tool", "", "plate", "plate", "", "tool"));
}

TEST(Requirements, OfDistancesAreRefusedWhereTheyMeanNothing) {
  const Mechanism model = parse_model(kDrawn, "m.cuik");
  EXPECT_THAT(refusal(model, "distance(bar, bal) >= 1"), HasSubstr("'bal' is no body or point"));
  EXPECT_THAT(refusal(model, "distance(bar, bal) >= 1"), HasSubstr("did you mean 'bar'"));
  EXPECT_THAT(refusal(model, "distance(A bar, B) >= 1"), HasSubstr("'bar' is no body or point"));
  EXPECT_THAT(refusal(model, "distance(bar, C) >= 0"), HasSubstr("is not positive"));
  EXPECT_THAT(refusal(model, "distance(bar, ball) >= -1"), HasSubstr("is not 0 or more"));
  EXPECT_THAT(refusal(model, "distance(bar, ball) >= 1 deg"), HasSubstr("deg is the unit of an angle"));
  EXPECT_THAT(refusal(model, "distance(bar radius 1 N, ball) >= 1"), HasSubstr("N is the unit of a force"));
  EXPECT_THAT(refusal(rrr(), "distance(A1 B1, C1 B1) >= 1 mm"), HasSubstr("unit"));
  const auto set_of = [&](const std::string& text) -> std::string {
    try {
      kernel_question(with(model, {text}), SingularitySet::requirements);
    } catch (const ModelError& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_THAT(set_of("distance(bar, ball) >= 1"), HasSubstr("whose limit is no single equation; expected corank map"));
  const auto model_with = [](const std::string& line) -> std::string {
    try {
      parse_model(kDrawn + line, "m.cuik");
    } catch (const ModelError& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_THAT(model_with("joint pin = A"), HasSubstr("a joint is no body that has a name"));
  EXPECT_THAT(model_with("link bar ="), HasSubstr("expected"));
}

// A rod from A to B along (x, 0, 1), a point that moves along the third axis: cos² of the angle is 1/(x² + 1).
TEST(Requirements, OfAnglesBetweenLinesAreComparisons) {
  const Mechanism model = parse_model(kDrawn, "m.cuik");
  const auto excess = [&](const std::string& text) {
    const Requirements r(with(model, {text}));
    EXPECT_TRUE(r.of_functions().at(0).excess);
    return r.functions().at(*r.of_functions().at(0).excess);
  };
  const auto at = [&](const std::string& text, double x) {
    return evaluate(excess(text), std::map<std::string, double>{{"x", x}});
  };
  EXPECT_NEAR(at("pressure_angle(A B, C D) <= 30 deg", std::tan(M_PI / 6)), 0, 1e-12);
  EXPECT_LT(at("pressure_angle(A B, C D) <= 30 deg", 0.5), 0);
  EXPECT_GT(at("pressure_angle(A B, C D) <= 30 deg", 0.6), 0);
  EXPECT_GT(at("pressure_angle(A B, D C) <= 30 deg", 0.6), 0) << "the lines have no direction";
  // At C between A and D: D - C is the third axis, A - C is (-x, -1, -1).
  EXPECT_NEAR(at("transmission_angle(A C D) >= pi/4", 0), 0, 1e-12);
  EXPECT_LT(at("transmission_angle(A C D) >= 40 deg", 0), 0);
  EXPECT_GT(at("transmission_angle(A C D) >= 50 deg", 0), 0);
  EXPECT_NO_THROW(kernel_question(with(model, {"pressure_angle(A B, C D) <= 30 deg"}), SingularitySet::requirements));
  EXPECT_THAT(refusal(model, "pressure_angle(A B, C D) <= 90 deg"), HasSubstr("is not below 90 degrees"));
  EXPECT_THAT(refusal(model, "pressure_angle(A B, C D) <= 1 mm"), HasSubstr("mm is the unit of a length"));
  EXPECT_THAT(refusal(model, "pressure_angle(A B C, C D) <= 1"), HasSubstr("a line has 3 points"));
  EXPECT_THAT(refusal(model, "transmission_angle(A B) >= 1"), HasSubstr("it has 2 points"));
  EXPECT_THAT(refusal(model, "transmission_angle(A B K) >= 1"), HasSubstr("'K' is no body or point"));
}

}  // namespace
}  // namespace corank::symbolic
