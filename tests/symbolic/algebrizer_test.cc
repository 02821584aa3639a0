// The algebrizer against direct evaluation of the trigonometric system, and every fault it reports.
#include "corank/symbolic/algebrizer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "corank/symbolic/model_file.h"
#include "corank/tests/symbolic/evaluate.h"

namespace corank::symbolic {
namespace {

using certify::ExactNumber;
using certify::Interval;
using certify::System;
using certify::VariableKind;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr unsigned kSeed = 314159;

System compile(const std::string& text) { return algebrize(plain_system(parse_model(text, "m.cuik"))); }

System reference(const std::string& name, SingularitySet set, std::optional<KernelSide> side = {}) {
  return algebrize(singularity_system(read_model(std::string(CORANK_SOURCE_DIR) + "/models/" + name + ".cuik"), set, side));
}

// Lines 2 (x), 3 (theta), 4 (psi), then the equations from line 6 on.
std::string with_equation(const std::string& equation) {
  return "[SYSTEM VARS]\nx : [-1, 1]\ntheta ~ [-pi, pi]\npsi ~ [-pi, pi]\n[SYSTEM EQS]\n" + equation;
}

std::string only_equation(const std::string& equation) { return canonical(compile(with_equation(equation)).equations[0]); }

// ---- shape
// ------------------------------------------------------------------------------------------------------------------------

TEST(Algebrizer, MakesDextarsForwardSystem) {
  const System s = reference("dextar", SingularitySet::forward);
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
  const System s = reference("three_slider", SingularitySet::inverse);
  EXPECT_THAT(canonical(s.equations),
              ElementsAre(" + -1 + 1·x0^2 + 1·x2^2", " + -16/25 + 1·x1^2 + 1·x2^2",  //
                          " + 2·x0^1·x3^1 + 2·x2^1·x4^1", " + 2·x2^1·x4^1", " + -1 + 1·x3^2 + 1·x4^2"));
  EXPECT_EQ(s.dimension(), 0);
  EXPECT_EQ(reference("three_slider", SingularitySet::cspace_singular).equations.size(), 6u);
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
    const System built = algebrize(singularity_system(m, set)), read = reference("three_slider", set);
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

// ---- sines and cosines of lengths
// --------------------------------------------------------------------------------------------------------------------

std::vector<std::string> names(const System& s) {
  std::vector<std::string> result;
  for (const auto& variable : s.variables) result.push_back(variable.name);
  return result;
}

TEST(LengthFunctions, StandWhereTheyAreTermsAndBecomeVariablesWhereTheyAreFactors) {
  const System s = compile(
      "[SYSTEM VARS]\nq : [-2, 2]\ny : [-20, 20]\nt : [0, 8*pi]\n[SYSTEM EQS]\nq = 0.5*cos(t);\nt = y^2/4;\ny*sin(t)*3 = "
      "0;");
  EXPECT_THAT(names(s), ElementsAre("q", "y", "t", "s_t"));
  EXPECT_THAT(canonical(s.equations), ElementsAre(" + 1·x0^1 + -1/2·cos(x2)", " + -1/4·x1^2 + 1·x2^1",  //
                                                  " + 3·x1^1·x3^1", " + 1·x3^1 + -1·sin(x2)"));
  EXPECT_EQ(s.configuration_size, 3);
  EXPECT_EQ(s.variables[3].kind, VariableKind::auxiliary);
  EXPECT_EQ(s.variables[3].domain, Interval(-1, 1));
  EXPECT_EQ(s.equations[3].source, "definition of s_t");
  EXPECT_THAT(s.angles, IsEmpty());
}

std::vector<std::string> with_lengths(const std::string& equations) {
  return canonical(
      compile("[SYSTEM VARS]\nx : [-1, 1]\ny : [-2, 3]\ntheta ~ [-pi, pi]\n[SYSTEM EQS]\n" + equations).equations);
}

TEST(LengthFunctions, UseOneVariableEverywhereOnceTheyNeedIt) {
  // x0 = x, x1 = y, x2 = cos theta, x3 = sin theta, x4 the new one
  EXPECT_THAT(
      with_lengths("cos(x) = y;\ncos(x)^2 + sin(y) = 1;"),
      ElementsAre(" + -1·x1^1 + 1·x4^1", " + -1 + 1·x4^2 + 1·sin(x1)", " + -1 + 1·x2^2 + 1·x3^2", " + 1·x4^1 + -1·cos(x0)"));
  EXPECT_THAT(with_lengths("cos(x + theta) = y + sin(-x);"),
              ElementsAre(" + -1·x1^1 + 1·x2^1·x4^1 + -1·x3^1·x5^1 + 1·x5^1", " + -1 + 1·x2^2 + 1·x3^2",
                          " + 1·x4^1 + -1·cos(x0)", " + 1·x5^1 + -1·sin(x0)"));
}

TEST(LengthFunctions, TakeAnyLinearArgument) {
  EXPECT_EQ(with_lengths("cos(x + pi/3) = y;")[0], " + -1·x1^1 + -1/2*sqrt(3)·sin(x0) + 1/2·cos(x0)");
  EXPECT_EQ(with_lengths("sin(x - x) = y;")[0], " + -1·x1^1");
  const System s = compile(
      "[SYSTEM VARS]\nx : [-1, 1]\ny : [-2, 3]\n[SYSTEM EQS]\nsin(2*x - pi*y) + cos(pi*y - 2*x) = sin(y/2 + x/2 - y/2 + "
      "x/2);");
  EXPECT_THAT(names(s), ElementsAre("x", "y", "u_x_y"));
  EXPECT_THAT(canonical(s.equations), ElementsAre(" + -1·sin(x0) + 1·sin(x2) + 1·cos(x2)", " + -2·x0^1 + pi·x1^1 + 1·x2^1"));
  EXPECT_EQ(s.variables[2].lower.text(), "-2 - 3*pi");
  EXPECT_EQ(s.variables[2].upper.text(), "2 + 2*pi");
}

TEST(LengthFunctions, MayStandInInequalities) {
  const System s = compile(with_equation("x = cos(theta);\ncos(x) >= 1/2;\nx*sin(x) <= 1;"));
  EXPECT_THAT(canonical(s.inequalities), ElementsAre(" + -1/2 + 1·cos(x0)", " + 1 + -1·x0^1·x5^1"));
  EXPECT_EQ(canonical(s.equations.back()), " + 1·x5^1 + -1·sin(x0)");
}

TEST(LengthFunctions, AreDifferentiatedInKernelEquations) {
  // A point on a helix: turning about z by t lifts it by t/10.
  const Mechanism m = parse_model(
      "[SYSTEM VARS]\nt : [0, 20]\nx : [-2, 2]\nz : [0, 2]\n[SYSTEM EQS]\nx = cos(t);\nz = t/10;\n[INPUTS] x\n[OUTPUTS] z",
      "m.cuik");
  const System s = algebrize(singularity_system(m, SingularitySet::forward));
  EXPECT_THAT(names(s), ElementsAre("t", "x", "z", "xi1", "xi2", "s_t"));
  EXPECT_THAT(canonical(s.equations),
              ElementsAre(" + 1·x1^1 + -1·cos(x0)", " + -1/10·x0^1 + 1·x2^1", " + 1·x3^1·x5^1", " + -1/10·x3^1 + 1·x4^1",
                          " + -1 + 1·x3^2 + 1·x4^2", " + 1·x5^1 + -1·sin(x0)"));
}

TEST(LengthFunctions, TakeNamesThatAreFree) {
  const System s =
      compile("[SYSTEM VARS]\nt : [0, 1]\ns_t : [0, 1]\nu_t : [0, 1]\n[SYSTEM EQS]\nt*sin(t) = s_t*sin(2*t) + u_t;");
  EXPECT_THAT(names(s), ElementsAre("t", "s_t", "u_t", "u_t_", "s_t_", "s_u_t_"));
}

// ---- values
// -----------------------------------------------------------------------------------------------------------------------

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
          size += std::fabs(evaluate(certify::Polynomial{{monomial}, ""}, x));
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
    std::map<std::string, const certify::Polynomial*> by_source;
    for (const auto& polynomial : system.equations) by_source[polynomial.source] = &polynomial;
    for (const auto& equation : trigonometric.equations) {
      ASSERT_TRUE(by_source.contains(equation.source)) << equation.source;
      const certify::Polynomial& polynomial = *by_source[equation.source];
      long double size = 1;
      for (const auto& monomial : polynomial.monomials) size += std::fabs(evaluate(certify::Polynomial{{monomial}, ""}, x));
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

// ---- ranges
// -----------------------------------------------------------------------------------------------------------------------

System with_range(const std::string& range) {
  return compile("[SYSTEM VARS]\ntheta ~ " + range + "\nx : [-1, 1]\n[SYSTEM EQS]\nx = cos(theta);");
}

TEST(AngleRange, IsNoConditionWhereItIsTheWholeCircle) {
  for (const char* range : {"[-pi, pi]", "[0, 2*pi]", "[-10, 10]", "[pi/2, 5*pi/2]"}) {
    const System s = with_range(range);
    EXPECT_THAT(s.inequalities, IsEmpty()) << range;
    EXPECT_EQ(s.variables[0].domain, Interval(-1, 1)) << range;
    EXPECT_EQ(s.variables[1].domain, Interval(-1, 1)) << range;
  }
}

TEST(AngleRange, NarrowsSineAndCosineExactly) {
  const auto domains = [](const char* range) {
    const System s = with_range(range);
    std::string out;
    for (int i = 0; i < 2; ++i)
      out += "[" + s.variables[static_cast<std::size_t>(i)].lower.text() + ", " +
             s.variables[static_cast<std::size_t>(i)].upper.text() + "]";
    return out;
  };
  EXPECT_EQ(domains("[0, pi]"), "[-1, 1][0, 1]");
  EXPECT_EQ(domains("[-pi/3, pi/3]"), "[1/2, 1][-1/2*sqrt(3), 1/2*sqrt(3)]");
  EXPECT_EQ(domains("[pi/2, 3*pi/2]"), "[-1, 0][-1, 1]");
  EXPECT_EQ(domains("[1, 2]"), "[cos(2), cos(1)][sin(1), 1]");
  EXPECT_EQ(domains("[7, 8]"), "[cos(8), cos(7)][sin(7), 1]");
  EXPECT_EQ(domains("[-8, -7]"), "[cos(8), cos(7)][-1, -sin(7)]");
  EXPECT_EQ(domains("[pi/2, 2*pi]"), "[-1, 1][-1, 1]");
  EXPECT_EQ(domains("[100*pi, 100*pi + pi/2]"), "[0, 1][0, 1]");
}

TEST(AngleRange, BecomesTheChordInequality) {
  const System s = with_range("[0, pi/2]");
  EXPECT_THAT(canonical(s.inequalities), ElementsAre(" + -1/2*sqrt(2) + 1/2*sqrt(2)·x0^1 + 1/2*sqrt(2)·x1^1"));
  EXPECT_EQ(s.inequalities[0].source, "range of theta");
}

TEST(AngleRange, OfOneValueMakesTheAngleAConstant) {
  // x0 = cos theta, x1 = sin theta, x2 = x
  const auto equations = [](const char* value, const std::string& equation) {
    return canonical(compile(std::string("[CONSTANTS]\na := ") + value +
                             "\n[SYSTEM VARS]\ntheta ~ [a, a]\nx : [-1, 1]\n[SYSTEM EQS]\n" + equation)
                         .equations);
  };
  EXPECT_THAT(equations("1", "x = cos(theta);"),
              ElementsAre(" + -cos(1) + 1·x2^1", " + -cos(1) + 1·x0^1", " + -sin(1) + 1·x1^1"));
  EXPECT_THAT(equations("pi/2", "x = 2*sin(theta) + cos(theta);"),
              ElementsAre(" + -2 + 1·x2^1", " + 1·x0^1", " + -1 + 1·x1^1"));
  EXPECT_EQ(equations("pi/9", "x = sin(3*theta - pi/6);")[0], " + -1/2 + 1·x2^1");
  EXPECT_EQ(equations("pi/12", "x*cos(theta) = x*sin(5*theta) + x*cos(theta + pi/4) + x^2;")[0], " + -1/2·x2^1 + -1·x2^2");
  EXPECT_EQ(equations("7*pi/3", "x = cos(theta);")[0], " + -1/2 + 1·x2^1");
  const System s = with_range("[1, 1]");
  EXPECT_THAT(s.inequalities, IsEmpty());
  EXPECT_EQ(s.dimension(), 0);
  EXPECT_EQ(s.equations[1].source, "value of theta");
  ASSERT_EQ(s.angles.size(), 1u);
  EXPECT_EQ(s.angles[0].range, Interval(1));
}

TEST(AngleRange, OfOneValueMayMakeAnEquationOfTheModelSayNothing) {
  const auto equations = [](const char* value) {
    return compile(std::string("[CONSTANTS]\na := ") + value +
                   "\n[SYSTEM VARS]\ntheta ~ [a, a]\nx : [-1, 1]\n[SYSTEM EQS]\nx*sin(theta) = 0;\nx^3 = x;")
        .equations.size();
  };
  EXPECT_EQ(equations("pi/5"), 4u);
  EXPECT_EQ(equations("pi"), 3u);
}

// The system with theta in [alpha, alpha] is the one with theta in [-pi, pi] at that value, with the angle's own column.
TEST(AngleRange, OfOneValueLeavesTheAngleItsColumn) {
  const auto system = [](const char* range) {
    return algebrize(singularity_system(
        parse_model(std::string("[SYSTEM VARS]\ntheta ~ ") + range +
                        "\npsi ~ [-pi, pi]\nx : [-3, 3]\n[SYSTEM EQS]\nx = 2*cos(theta) + cos(theta + psi);\n"
                        "x*sin(theta) = sin(psi - 2*theta) + x;\n[INPUTS] x\n[OUTPUTS] psi",
                    "m.cuik"),
        SingularitySet::forward));
  };
  const System fixed = system("[3/5, 3/5]"), free = system("[-pi, pi]");
  ASSERT_EQ(names(fixed), names(free));
  EXPECT_EQ(fixed.configuration_size, free.configuration_size);
  std::map<std::string, const certify::Polynomial*> by_source;
  for (const auto& polynomial : fixed.equations) by_source[polynomial.source] = &polynomial;
  RandomMechanism random(kSeed + 2);
  for (int k = 0; k < 10; ++k) {
    const Values values{{"theta", 0.6L},
                        {"psi", random.uniform(-3, 3)},
                        {"x", random.uniform(-3, 3)},
                        {"xi1", random.uniform(-1, 1)},
                        {"xi2", random.uniform(-1, 1)}};
    const std::vector<long double> x = compiled_point(fixed, values);
    for (const auto& equation : free.equations) {
      if (equation.source == "circle of theta") continue;
      ASSERT_TRUE(by_source.contains(equation.source)) << equation.source;
      EXPECT_NEAR(static_cast<double>(evaluate(*by_source[equation.source], x)), static_cast<double>(evaluate(equation, x)),
                  1e-14)
          << equation.source;
    }
  }
}

TEST(AngleRange, HoldsExactlyForTheAnglesInIt) {
  RandomMechanism random(kSeed);
  for (int i = 0; i < 200; ++i) {
    const int lo = static_cast<int>(random.uniform(-9000, 9000)), width = static_cast<int>(random.uniform(1, 6283));
    const System s = with_range("[" + std::to_string(lo) + "/1000, " + std::to_string(lo + width) + "/1000]");
    ASSERT_EQ(s.inequalities.size(), 1u);
    for (int k = 0; k < 50; ++k) {
      const long double theta = random.uniform(-12, 12), alpha = lo / 1000.0L, beta = (lo + width) / 1000.0L;
      const long double turn = 2 * std::numbers::pi_v<long double>;
      const long double offset = theta - alpha - turn * std::floor((theta - alpha) / turn);  // in [0, 2π)
      if (std::fabs(offset - (beta - alpha)) < 1e-9L || offset < 1e-9L || offset > turn - 1e-9L) continue;
      const auto x = compiled_point(s, {{"theta", theta}, {"x", 0}});
      const bool inside = offset < beta - alpha;
      ASSERT_EQ(evaluate(s.inequalities[0], x) >= 0, inside) << alpha << " " << beta << " " << static_cast<double>(theta);
      for (std::size_t v = 0; inside && v < 2; ++v) {
        ASSERT_GE(x[v], s.variables[v].domain.lo());
        ASSERT_LE(x[v], s.variables[v].domain.hi());
      }
    }
  }
}

// ---- faults
// -----------------------------------------------------------------------------------------------------------------------

struct Fault {
  const char* name;
  std::string text;
  int line;
  const char* message;
};

class AlgebrizerFault : public ::testing::TestWithParam<Fault> {};

TEST_P(AlgebrizerFault, NamesPlaceAndTerm) {
  try {
    compile(GetParam().text);
    FAIL() << "no error";
  } catch (const ModelError& error) {
    EXPECT_EQ(error.where().line, GetParam().line) << error.what();
    EXPECT_THAT(error.what(), HasSubstr(GetParam().message));
    EXPECT_THAT(error.what(), HasSubstr("m.cuik:" + std::to_string(GetParam().line)));
    EXPECT_THAT(error.what(), HasSubstr("; expected "));
  }
}

// An equation in line 7; the one in line 6 is sound.
std::string second(const std::string& equation) { return with_equation("x = cos(theta);\n" + equation); }

std::string with_constant(const std::string& value) {
  return "[CONSTANTS]\na := 1\nk := " + value + "\n[SYSTEM VARS]\nx : [-1, 1]\n[SYSTEM EQS]\nx = 0;";
}

std::string with_x_range(const std::string& range) { return "[SYSTEM VARS]\nx : " + range + "\n[SYSTEM EQS]\nx = 0;"; }

std::string with_fixed_angle(const std::string& equation) {
  return "[SYSTEM VARS]\nx : [-1, 1]\ntheta ~ [1, 1] psi ~ [0, 1]\n[SYSTEM EQS]\n" + equation;
}

INSTANTIATE_TEST_SUITE_P(
    Every, AlgebrizerFault,
    ::testing::Values(
        Fault{"AngleOutsideSine", second("theta + 1 = 0;"), 7,
              "the angle 'theta' stands outside sin and cos in `theta + 1 = 0`"},
        Fault{"AngleTimesSine", second("theta*sin(theta) = 0;"), 7, "the angle 'theta' stands outside"},
        Fault{"TangentOfAngle", second("tan(theta) = x;"), 7, "'tan(theta)' is tan of an unknown"},
        Fault{"QuotientOfUnknowns", second("x/cos(theta) = 1;"), 7, "'x/cos(theta)' divides by an unknown"},
        Fault{"TangentOfLength", second("tan(x) = 1;"), 7, "'tan(x)' is tan of an unknown"},
        Fault{"ProductOfLengths", second("sin(x*x) = 1;"), 7, "'x*x' inside sin or cos is a product of unknowns"},
        Fault{"LengthTimesAngle", second("sin(x*theta) = 1;"), 7, "'x*theta' inside sin or cos is a product of unknowns"},
        Fault{"SquareOfLength", second("cos(1 - x^2) = x;"), 7, "'x^2' stands inside sin or cos"},
        Fault{"CosineOfSineOfLength", second("cos(sin(x)) = x;"), 7, "'sin(x)' stands inside sin or cos"},
        Fault{"HiddenZeroTimesLength", second("cos((sqrt(2)*sqrt(3) - sqrt(6))*x) = x;"), 7,
              "the multiple of 'x' in 'cos((sqrt(2)*sqrt(3) - sqrt(6))*x)' cannot be told from zero"},
        Fault{"HalfAngle", second("cos(theta/2) = x;"), 7, "'cos(theta/2)' has a fractional multiple of the angle 'theta'"},
        Fault{"IrrationalMultiple", second("cos(sqrt(2)*theta) = x;"), 7, "fractional multiple"},
        Fault{"ProductOfAngles", second("cos(theta*psi) = x;"), 7, "'theta*psi' inside sin or cos is a product of unknowns"},
        Fault{"SquareOfAngle", second("cos(theta^2) = x;"), 7, "'theta^2' stands inside sin or cos"},
        Fault{"SineOfSine", second("sin(sin(theta)) = x;"), 7, "'sin(theta)' stands inside sin or cos"},
        Fault{"QuotientByAngle", second("sin(1/theta) = x;"), 7, "'1/theta' stands inside sin or cos"},
        Fault{"MultipleTooLarge", second("cos(65*theta) = x;"), 7,
              "'cos(65*theta)' is too large in `cos(65*theta) = x`; expected at most 64"},
        Fault{"FractionalPower", second("x^(1/2) = 1;"), 7, "fractional power of an unknown"},
        Fault{"NegativePower", second("x^(-1) = 1;"), 7, "negative power of an unknown"},
        Fault{"IrrationalPower", second("x^pi = 1;"), 7, "that is no integer"},
        Fault{"UnknownExponent", second("2^x = 1;"), 7, "'2^x' has an unknown in its exponent"},
        Fault{"ExponentTooLarge", second("x^65 = 1;"), 7, "the exponent of 'x^65' is too large"},
        Fault{"RootOfUnknown", second("sqrt(x) = 1;"), 7, "'sqrt(x)' is sqrt of an unknown"},
        Fault{"ExponentialOfUnknown", second("exp(x) = 1;"), 7, "is exp of an unknown"},
        Fault{"LogarithmOfUnknown", second("log(x) = 1;"), 7, "is log of an unknown"},
        Fault{"AbsoluteValueOfUnknown", second("abs(cos(theta)) = 1;"), 7, "is abs of an unknown"},
        Fault{"TooManyTerms", second("(x + cos(theta) + sin(theta) + cos(psi) + sin(psi) + 1)^30 = 1;"), 7,
              "is too large: it expands to"},
        Fault{"ProductOfTooManyTerms", second("(x + cos(theta) + sin(theta) + 1)^16*(x + cos(psi) + sin(psi) + 2)^16 = 1;"),
              7, "it expands to more than 200000 terms"},
        Fault{"DegreeTooHigh", second("((x + 1)^64)^64 = 1;"), 7, "is too large: it expands to a polynomial of degree"},
        Fault{"InconsistentConstants", second("1 = 2;"), 7, "`1 = 2` contains no unknown and can never hold: -1 = 0"},
        Fault{"InconsistentAfterExpansion", second("(x + 1)^2 = x^2 + 2*x;"), 7, "can never hold: 1 = 0"},
        Fault{"AlwaysTrue", second("(x + 1)^2 = x^2 + 2*x + 1;"), 7, "holds always"},
        Fault{"UndecidableConstants", second("sqrt(2)*sqrt(3) = sqrt(6);"), 7, "cannot be decided"},
        Fault{"InconsistentInequality", second("1 >= 2;"), 7, "`1 >= 2` contains no unknown and can never hold"},
        Fault{"CoefficientTooLarge", second("1e300*1e300*x = 1;"), 7, "of the equation `1e300*1e300*x = 1` is too large"},
        Fault{"DivisionByZero", second("x/(1 - 1) = 1;"), 7, "'x/(1 - 1)' has no real value: division by zero"},
        Fault{"DivisionByHiddenZero", second("x/(sqrt(2)*sqrt(3) - sqrt(6)) = 1;"), 7, "cannot be told from zero"},
        Fault{"ConstantDividesByZero", with_constant("1/(a - 1)"), 3,
              "'1/(a - 1)' has no real value: division by zero, in the constant 'k'"},
        Fault{"ConstantRootOfNegative", with_constant("sqrt(-a)"), 3, "sqrt of a number that is negative"},
        Fault{"ConstantFractionalPowerOfNegative", with_constant("(-8)^(1/3)"), 3,
              "fractional power of a number that is negative"},
        Fault{"ConstantLogarithmOfZero", with_constant("log(a - 1)"), 3, "log of a number that is not positive"},
        Fault{"ConstantArcsineOutOfRange", with_constant("asin(2)"), 3, "asin of a number outside [-1, 1]"},
        Fault{"ConstantTangentAtPole", with_constant("tan(pi/2)"), 3, "tan at a pole"},
        Fault{"ConstantTower", with_constant("9^9^9^9"), 3, "too large"},
        Fault{"ConstantPowerTooLarge", with_constant("2^100000000"), 3, "too large"},
        Fault{"ConstantGrowsThroughProducts", with_constant("((10^300)^300)^300"), 3, "too large"},
        Fault{"EmptyRange", with_x_range("[1, -1]"), 2, "[1, -1], is empty"},
        Fault{"EmptyRangeOfIrrationals", with_x_range("[sqrt(2), 1.41421356237309504880]"), 2, "is empty"},
        Fault{"UnboundedRange", with_x_range("[0, 1e400]"), 2, "is unbounded"},
        Fault{"RangeThatIsNotReal", with_x_range("[0, sqrt(-2)]"), 2, "sqrt of a number that is negative"},
        Fault{"FixedAngleOutsideSine", with_fixed_angle("x = theta;"), 5,
              "the angle 'theta' stands outside sin and cos in `x = theta`"},
        Fault{"HalfFixedAngle", with_fixed_angle("x = sin(theta/2);"), 5,
              "'sin(theta/2)' has a fractional multiple of the angle 'theta'"},
        Fault{"FixedAngleTimesAngle", with_fixed_angle("x = sin(theta*psi);"), 5,
              "'theta*psi' inside sin or cos is a product of unknowns"},
        Fault{"EquationThatCanNeverHoldAtAFixedAngle", with_fixed_angle("sin(theta) = 1/2;"), 5,
              "`sin(theta) = 1/2` contains no unknown and can never hold"},
        Fault{"EmptyAngleRange", "[SYSTEM VARS]\ntheta ~ [pi, -pi]\n[SYSTEM EQS]\nsin(theta) = 0;", 2, "is empty"}),
    [](const auto& test) { return std::string(test.param.name); });

TEST(Algebrizer, ReportsAFaultOfAMechanismBuiltInCppWithoutALine) {
  Mechanism m("bare");
  const Expression t = m.angle("t");
  m.constrain(t == Expression(1));
  try {
    algebrize(plain_system(m));
    FAIL() << "no error";
  } catch (const ModelError& error) {
    EXPECT_THAT(error.what(), HasSubstr("the angle 't' stands outside sin and cos in `t = 1`"));
  }
}

TEST(Algebrizer, EndsOnConstantsThatGrow) {
  // Each doubles the length of the one before: 2^60 parts if nothing stopped it.
  std::string text = "[CONSTANTS]\nk0 := sqrt(2)\n";
  for (int i = 1; i <= 60; ++i) {
    const std::string before = "k" + std::to_string(i - 1);
    text += "k" + std::to_string(i) + " := " + before + " + sin(" + before + ")\n";
  }
  EXPECT_THROW(compile(text + "[SYSTEM VARS]\nx : [0, 1]\n[SYSTEM EQS]\nx = 0;"), ModelError);
}

TEST(Algebrizer, EnclosesTheValuesOfConstantsOfEveryFunction) {
  for (const char* text : {"sqrt(2)",
                           "sin(1)",
                           "cos(2)",
                           "tan(1)",
                           "asin(1/3)",
                           "acos(1/3)",
                           "atan(3)",
                           "exp(1/3)",
                           "log(7)",
                           "abs(1 - pi)",
                           "2^(1/3)",
                           "3^(-5/2)",
                           "pi^sqrt(2)",
                           "(1 + pi)^3/(2 - sqrt(3))",
                           "1/sqrt(2)",
                           "1e-3*pi",
                           "-(pi - 1)",
                           "asin(1/2)",
                           "sin(pi/5)*cos(pi/7)",
                           "exp(log(5))",
                           "sqrt(sqrt(2) + 1)",
                           "pi^-2",
                           "atan(tan(1/2))"}) {
    const System s = compile(std::string("[SYSTEM VARS]\nx : [-1, 1]\n[SYSTEM EQS]\n(") + text + ")*x = 1;");
    const double value = static_cast<double>(evaluate(parse_expression(text), {}));
    const Interval enclosure = s.equations[0].monomials[1].enclosure;
    EXPECT_NEAR(enclosure.lo(), value, 4e-16 * std::fabs(value)) << text;
    EXPECT_NEAR(enclosure.hi(), value, 4e-16 * std::fabs(value)) << text;
    // The text of the coefficient reads back as the same number.
    const ExactNumber coefficient = s.equations[0].monomials[1].coefficient;
    const System again = compile("[SYSTEM VARS]\nx : [-1, 1]\n[SYSTEM EQS]\n(" + coefficient.text() + ")*x = 1;");
    EXPECT_EQ(again.equations[0].monomials[1].coefficient, coefficient) << text;
  }
}

}  // namespace
}  // namespace corank::symbolic
