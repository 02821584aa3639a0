// Sides that the equations imply, and sides that they nearly do: each lemma of certify/implied.h at its edges.
#include "corank/certify/implied.h"

#include <gtest/gtest.h>

#include "corank/core/rounding.h"
#include "corank/tests/system_builder.h"

namespace corank::certify {
namespace {

using test::SystemBuilder;

std::vector<ImpliedSides> implied(const SystemBuilder& b) { return implied_domains(b.system()); }

TEST(ImpliedBySquares, IsNoSideThatCutsTheCircleOff) {
  for (const bool cuts : {false, true}) {
    SystemBuilder b;  // a circle of radius 1/2
    const int x = b.variable("x", cuts ? "-3/10" : "-1/2", cuts ? "3/10" : "1/2"), y = b.variable("y", "-1", "1");
    b.equation({{"1", {{x, 2}}}, {"1", {{y, 2}}}, {"-1/4", {}}});
    EXPECT_EQ(implied(b)[0].lower, !cuts);
    EXPECT_EQ(implied(b)[0].upper, !cuts);
  }
}

TEST(ImpliedBySquares, IsEachSideForItself) {
  SystemBuilder b;
  const int x = b.variable("x", "-1", "3/10"), y = b.variable("y", "-3/10", "1");
  b.equation({{"1", {{x, 2}}}, {"1", {{y, 2}}}, {"-1/4", {}}});
  EXPECT_TRUE(implied(b)[0].lower && !implied(b)[0].upper);
  EXPECT_TRUE(!implied(b)[1].lower && implied(b)[1].upper);
}

TEST(ImpliedBySquares, IsNoSideOfTheOtherSign) {
  SystemBuilder b;  // x <= −1/2 is no bound of the circle, though (−1/2)² is as much as its radius squared
  const int x = b.variable("x", "-1", "-1/2"), y = b.variable("y", "1/2", "1");
  b.equation({{"1", {{x, 2}}}, {"1", {{y, 2}}}, {"-1/4", {}}});
  EXPECT_TRUE(implied(b)[0].lower && !implied(b)[0].upper);
  EXPECT_TRUE(!implied(b)[1].lower && implied(b)[1].upper);
}

TEST(ImpliedBySquares, IsNotThatOfHigherPowers) {
  SystemBuilder b;  // x⁴ + y² = 1/16: x goes to 1/2
  const int x = b.variable("x", "-1/4", "1/4"), y = b.variable("y", "-1", "1");
  b.equation({{"1", {{x, 4}}}, {"1", {{y, 2}}}, {"-1/16", {}}});
  EXPECT_FALSE(implied(b)[0].lower || implied(b)[0].upper);
}

TEST(ImpliedBySquares, IsNotThatOfCoefficientsWithATolerance) {
  SystemBuilder b;
  const int x = b.variable("x", "-1", "1"), y = b.variable("y", "-1", "1");
  b.equation({{"9/10", {{x, 2}}}, {"9/10", {{y, 2}}}, {"-9/10", {}}});
  EXPECT_TRUE(implied(b)[0].both());
  System system = b.system();
  widen(system.equations[0], 1e-3);
  EXPECT_FALSE(implied_domains(system)[0].lower || implied_domains(system)[0].upper);
}

TEST(ImpliedByTheModel, IsEachEndBeyondOneOfAComponentOfADirection) {
  SystemBuilder b;
  b.variable("u", "-11/10", "1"), b.variable("v", "-1", "9/10"), b.variable("w", "-9/10", "2"), b.variable("x", "-2", "2");
  System system = b.system();
  for (int j = 0; j < 3; ++j) system.variables[j].within_one = true;
  const std::vector<ImpliedSides> sides = implied_domains(system);
  EXPECT_TRUE(sides[0].both());
  EXPECT_TRUE(sides[1].lower && !sides[1].upper);
  EXPECT_TRUE(!sides[2].lower && sides[2].upper);
  EXPECT_FALSE(sides[3].lower || sides[3].upper);
  system.coefficient_tolerance = 1e-6;  // a direction that others are made of is no unit vector then
  for (const ImpliedSides& s : implied_domains(system)) EXPECT_FALSE(s.lower || s.upper);
}

// x = −2c + d with c in [−1, 1] and d in [0, 3], where only what is implied counts.
class ImpliedBySums : public testing::Test {
 protected:
  ImpliedSides x_in(const char* lower, const char* upper, bool d_lower = true, bool d_upper = true,
                    const char* factor = "1") {
    SystemBuilder b;
    const int x = b.variable("x", lower, upper), c = b.variable("c", "-1", "1"), s = b.variable("s", "-1", "1"),
              d = b.variable("d", "0", "3");
    b.equation({{"1", {{c, 2}}}, {"1", {{s, 2}}}, {"-1", {}}});
    const bool negative = factor[0] == '-';
    b.equation({{factor, {{x, 1}}}, {negative ? "-2" : "2", {{c, 1}}}, {negative ? "1" : "-1", {{d, 1}}}});
    System system = b.system();
    system.variables[3].lower_implied = d_lower, system.variables[3].upper_implied = d_upper;
    return implied_domains(system)[0];
  }
};

TEST_F(ImpliedBySums, IsWhereTheSumEnds) {
  for (const char* factor : {"1", "-1"}) {
    EXPECT_TRUE(x_in("-2", "5", true, true, factor).both());
    const ImpliedSides less = x_in("-1.9", "4.9", true, true, factor);
    EXPECT_FALSE(less.lower || less.upper) << factor;
    const ImpliedSides one = x_in("-2", "4.9", true, true, factor);
    EXPECT_TRUE(one.lower && !one.upper) << factor;
  }
}

TEST_F(ImpliedBySums, NeedsTheSidesThatBoundItsTerms) {
  const ImpliedSides no_upper = x_in("-2", "5", true, false), no_lower = x_in("-2", "5", false, true);
  EXPECT_TRUE(no_upper.lower && !no_upper.upper);
  EXPECT_TRUE(!no_lower.lower && no_lower.upper);
}

TEST_F(ImpliedBySums, IsOfAllTermsButTheOne) {
  SystemBuilder b;  // x = c + d, all implied: c is bounded by x − d only in [−3, 3]
  const int x = b.variable("x", "-2", "2"), c = b.variable("c", "-2.5", "2.5"), d = b.variable("d", "-1", "1");
  b.equation({{"1", {{x, 1}}}, {"-1", {{c, 1}}}, {"-1", {{d, 1}}}});
  System system = b.system();
  for (const int j : {0, 2}) system.variables[j].lower_implied = system.variables[j].upper_implied = true;
  EXPECT_FALSE(implied_domains(system)[1].lower || implied_domains(system)[1].upper);
  system.variables[1].lower = -3, system.variables[1].upper = 3;
  EXPECT_TRUE(implied_domains(system)[1].both());
  system.variables[0].lower_implied = false;
  EXPECT_TRUE(!implied_domains(system)[1].lower && implied_domains(system)[1].upper) << "c >= x − 1";
}

// r = Σ b_k y_k z_k with |p|² = 1 and Σ f_i q_i² = 1.
class ImpliedByProducts : public testing::Test {
 protected:
  using Terms = std::vector<SystemBuilder::Term>;
  ImpliedByProducts() {
    for (int i = 0; i < 2; ++i) p_[i] = builder_.variable("p" + std::to_string(i), "-9", "9");
    for (int i = 0; i < 2; ++i) q_[i] = builder_.variable("q" + std::to_string(i), "-9", "9");
  }
  void sphere(const int (&v)[2], const char* first, const char* second, const char* radius = "-1") {
    builder_.equation({{first, {{v[0], 2}}}, {second, {{v[1], 2}}}, {radius, {}}});
  }
  // Is |r| ≤ end implied, where r = the terms?
  bool is_implied(const std::string& end, Terms terms) const {
    SystemBuilder b = builder_;
    const int r = b.variable("r", "-" + end, end);
    terms.push_back({"-1", {{r, 1}}});
    b.equation(terms);
    return implied(b).back().both();
  }

  int p_[2] = {}, q_[2] = {};
  SystemBuilder builder_;
};

TEST_F(ImpliedByProducts, GoesByTheLargestFactor) {
  sphere(p_, "1", "1"), sphere(q_, "1", "1");
  const Terms rising{{"1", {{p_[0], 1}, {q_[1], 1}}}, {"2", {{p_[1], 1}, {q_[0], 1}}}};
  const Terms falling{{"-2", {{p_[0], 1}, {q_[1], 1}}}, {"1", {{p_[1], 1}, {q_[0], 1}}}};
  for (const Terms& terms : {rising, falling}) {
    EXPECT_TRUE(is_implied("2", terms));
    EXPECT_FALSE(is_implied("1.9", terms)) << "2 at p = (0, 1), q = (1, 0), or the other way round";
  }
}

TEST_F(ImpliedByProducts, GoesByTheLeastFactorOfEachNorm) {
  sphere(p_, "1", "1"), sphere(q_, "1/4", "1");
  const Terms terms{{"1", {{p_[0], 1}, {q_[1], 1}}}, {"-1", {{p_[1], 1}, {q_[0], 1}}}};
  EXPECT_TRUE(is_implied("2", terms));
  EXPECT_FALSE(is_implied("1.9", terms)) << "2 at p = (0, 1), q = (2, 0)";
}

TEST_F(ImpliedByProducts, GoesByTheLeastFactorOfTheFirstNorm) {
  sphere(p_, "1", "1/4"), sphere(q_, "1", "1");
  const Terms terms{{"1", {{p_[0], 1}, {q_[1], 1}}}, {"-1", {{p_[1], 1}, {q_[0], 1}}}};
  EXPECT_TRUE(is_implied("2", terms));
  EXPECT_FALSE(is_implied("1.9", terms)) << "2 at p = (0, 2), q = (1, 0)";
}

TEST_F(ImpliedByProducts, GoesByBothNorms) {
  sphere(p_, "1", "1", "-4"), sphere(q_, "1", "1", "-9");
  const Terms terms{{"1", {{p_[0], 1}, {q_[1], 1}}}, {"-1", {{p_[1], 1}, {q_[0], 1}}}};
  EXPECT_TRUE(is_implied("6", terms));
  EXPECT_FALSE(is_implied("5.9", terms));
}

TEST_F(ImpliedByProducts, AsksForDistinctFactorsOnBothSides) {
  sphere(p_, "1", "1"), sphere(q_, "1", "1");
  // √2 at p = (1, 0), q = (1, 1)/√2, and at p = (1, 1)/√2, q = (1, 0).
  EXPECT_FALSE(is_implied("1", {{"1", {{p_[0], 1}, {q_[0], 1}}}, {"1", {{p_[0], 1}, {q_[1], 1}}}}));
  EXPECT_FALSE(is_implied("1", {{"1", {{p_[0], 1}, {q_[0], 1}}}, {"1", {{p_[1], 1}, {q_[0], 1}}}}));
  EXPECT_TRUE(is_implied("1", {{"1", {{p_[0], 1}, {q_[0], 1}}}, {"1", {{p_[1], 1}, {q_[1], 1}}}}));
}

}  // namespace
}  // namespace corank::certify
