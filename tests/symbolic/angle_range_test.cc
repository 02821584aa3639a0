// Ranges of angles as conditions on sine and cosine.
#include "corank/tests/symbolic/compiled_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace corank::symbolic {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

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
  std::map<std::string, const Polynomial*> by_source;
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

}  // namespace
}  // namespace corank::symbolic
