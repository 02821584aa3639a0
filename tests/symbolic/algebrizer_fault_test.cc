// Every fault that the algebrizer reports, with its place and term.
#include "corank/tests/symbolic/compiled_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace corank::symbolic {
namespace {

using ::testing::HasSubstr;

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
              "the angle 'theta' is outside sin and cos in `theta + 1 = 0`"},
        Fault{"AngleTimesSine", second("theta*sin(theta) = 0;"), 7, "the angle 'theta' is outside"},
        Fault{"TangentOfAngle", second("tan(theta) = x;"), 7, "'tan(theta)' is tan of an unknown"},
        Fault{"QuotientOfUnknowns", second("x/cos(theta) = 1;"), 7, "'x/cos(theta)' divides by an unknown"},
        Fault{"TangentOfLength", second("tan(x) = 1;"), 7, "'tan(x)' is tan of an unknown"},
        Fault{"ProductOfLengths", second("sin(x*x) = 1;"), 7, "'x*x' inside sin or cos is a product of unknowns"},
        Fault{"LengthTimesAngle", second("sin(x*theta) = 1;"), 7, "'x*theta' inside sin or cos is a product of unknowns"},
        Fault{"SquareOfLength", second("cos(1 - x^2) = x;"), 7, "'x^2' is inside sin or cos"},
        Fault{"CosineOfSineOfLength", second("cos(sin(x)) = x;"), 7, "'sin(x)' is inside sin or cos"},
        Fault{"HiddenZeroTimesLength", second("cos((sqrt(2)*sqrt(3) - sqrt(6))*x) = x;"), 7,
              "the multiple of 'x' in 'cos((sqrt(2)*sqrt(3) - sqrt(6))*x)' cannot be distinguished from zero"},
        Fault{"HalfAngle", second("cos(theta/2) = x;"), 7, "'cos(theta/2)' has a fractional multiple of the angle 'theta'"},
        Fault{"IrrationalMultiple", second("cos(sqrt(2)*theta) = x;"), 7, "fractional multiple"},
        Fault{"ProductOfAngles", second("cos(theta*psi) = x;"), 7, "'theta*psi' inside sin or cos is a product of unknowns"},
        Fault{"SquareOfAngle", second("cos(theta^2) = x;"), 7, "'theta^2' is inside sin or cos"},
        Fault{"SineOfSine", second("sin(sin(theta)) = x;"), 7, "'sin(theta)' is inside sin or cos"},
        Fault{"QuotientByAngle", second("sin(1/theta) = x;"), 7, "'1/theta' is inside sin or cos"},
        Fault{"MultipleTooLarge", second("cos(65*theta) = x;"), 7,
              "'cos(65*theta)' is too large in `cos(65*theta) = x`; expected at most 64"},
        Fault{"FractionalPower", second("x^(1/2) = 1;"), 7, "fractional power of an unknown"},
        Fault{"NegativePower", second("x^(-1) = 1;"), 7, "negative power of an unknown"},
        Fault{"IrrationalPower", second("x^pi = 1;"), 7, "that is not an integer"},
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
        Fault{"AlwaysTrue", second("(x + 1)^2 = x^2 + 2*x + 1;"), 7, "always holds"},
        Fault{"UndecidableConstants", second("sqrt(2)*sqrt(3) = sqrt(6);"), 7, "cannot be decided"},
        Fault{"InconsistentInequality", second("1 >= 2;"), 7, "`1 >= 2` contains no unknown and can never hold"},
        Fault{"CoefficientTooLarge", second("1e300*1e300*x = 1;"), 7, "of the equation `1e300*1e300*x = 1` is too large"},
        Fault{"DivisionByZero", second("x/(1 - 1) = 1;"), 7, "'x/(1 - 1)' has no real value: division by zero"},
        Fault{"DivisionByHiddenZero", second("x/(sqrt(2)*sqrt(3) - sqrt(6)) = 1;"), 7, "cannot be distinguished from zero"},
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
              "the angle 'theta' is outside sin and cos in `x = theta`"},
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
    EXPECT_THAT(error.what(), HasSubstr("the angle 't' is outside sin and cos in `t = 1`"));
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
