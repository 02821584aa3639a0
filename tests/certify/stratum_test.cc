// What is said of a critical point on a stratum, on a circle and a sphere whose critical points are known, and what must not
// be said.
#include "corank/certify/stratum.h"

#include <gtest/gtest.h>

#include <cmath>

#include "corank/certify/polynomial_algebra.h"
#include "corank/core/dense.h"
#include "corank/core/rounding.h"

namespace corank::certify {
namespace {

using Point = std::vector<double>;

ExactNumber number(const std::string& text) { return ExactNumber::rational(text); }

Polynomial linear(const std::vector<std::string>& coefficients, const std::string& constant) {
  Polynomial f;
  for (std::size_t j = 0; j < coefficients.size(); ++j)
    if (coefficients[j] != "0")
      f.monomials.emplace_back(number(coefficients[j]), std::vector<Factor>{{static_cast<int>(j)}});
  if (constant != "0") f.monomials.emplace_back(number(constant), std::vector<Factor>{});
  return f;
}

// The unit sphere of `dimension` + 1 lengths.
System sphere(int dimension) {
  System s;
  Polynomial f;
  for (int j = 0; j <= dimension; ++j) {
    s.variables.emplace_back("x" + std::to_string(j), VariableKind::length, -2, 2);
    f.monomials.emplace_back(1, std::vector<Factor>{{j, 2}});
  }
  f.monomials.emplace_back(-1, std::vector<Factor>{});
  s.equations.push_back(f);
  return s;
}

System with(System s, const std::vector<Polynomial>& inequalities) {
  s.inequalities = inequalities;
  return s;
}

std::vector<End> all_ends(const System& s) {
  std::vector<End> ends;
  for (std::size_t k = 0; k < s.inequalities.size(); ++k)
    ends.push_back({s.inequalities[k], Contact::With::inequality, static_cast<int>(k)});
  return ends;
}

double value(const Polynomial& f, const Point& x) {
  const UpwardRounding rounding;
  std::vector<Interval> box;
  for (const double v : x) box.emplace_back(v);
  return evaluate(f, box).mid();
}

// A small box about x and the unit multipliers with which the stratum's equations hold there, μ ≥ 0.
Box solution(const Strata::Stratum& stratum, const Point& x) {
  const int n = static_cast<int>(x.size()), k = stratum.system.size() - n, q = stratum.coordinates;
  const std::size_t first = stratum.system.equations.size() - 1 - static_cast<std::size_t>(q);
  Eigen::MatrixXd m(q, k);
  for (int j = 0; j < k; ++j) {
    Point at = x;
    at.resize(static_cast<std::size_t>(n + k), 0.0);
    at[static_cast<std::size_t>(n + j)] = 1;
    for (int i = 0; i < q; ++i) m(i, j) = value(stratum.system.equations[first + static_cast<std::size_t>(i)], at);
  }
  Eigen::VectorXd xi = decompose(m).v.col(k - 1);
  EXPECT_LT((m * xi).norm(), 1e-12) << "no critical point";
  if (xi(k - 1) < 0) xi = -xi;
  Box box;
  const double r = 1e-9;
  for (const double v : x) box.emplace_back(v - r, v + r);
  for (int j = 0; j < k; ++j) box.emplace_back(xi(j) - r, xi(j) + r);
  return box;
}

std::optional<StratumTest::Kind> kind(const Strata& strata, const std::vector<int>& ends, const Point& x) {
  const UpwardRounding rounding;
  const Strata::Stratum stratum = strata.stratum(ends);
  return StratumTest(strata, stratum).kind(solution(stratum, x));
}

double length(const Point& x) {
  double sum = 0;
  for (const double v : x) sum += v * v;
  return std::sqrt(sum);
}

// Where the height is greatest on the unit sphere.
Point top(const Strata& strata, int variables) {
  Point x;
  for (int j = 0; j < variables; ++j) {
    Point unit(static_cast<std::size_t>(variables), 0.0);
    unit[static_cast<std::size_t>(j)] = 1;
    x.push_back(value(strata.height(), unit));
  }
  const double size = length(x);
  for (double& v : x) v /= size;
  return x;
}

TEST(Stratum, KnowsTheTopAndTheBottomOfASphere) {
  const Strata strata(sphere(2), {}, 0);
  ASSERT_TRUE(strata.problem().empty());
  EXPECT_EQ(strata.dimension(), 2);
  Point x = top(strata, 3);
  const auto above = kind(strata, {}, x);
  ASSERT_TRUE(above);
  EXPECT_EQ(above->index, 2);
  for (double& v : x) v = -v;
  const auto beneath = kind(strata, {}, x);
  ASSERT_TRUE(beneath);
  EXPECT_EQ(beneath->index, 0);
}

// On a half circle x ≥ 0 the ends are (0, ±1); the height grows inward as it does along the circle.
TEST(Stratum, KnowsAcrossWhichEndTheHeightGrowsInward) {
  for (int height = 0; height < 4; ++height) {
    const System half = with(sphere(1), {linear({"1", "0"}, "0")});
    const Strata strata(half, all_ends(half), height);
    for (const double y : {1.0, -1.0}) {
      const auto k = kind(strata, {0}, {0, y});
      ASSERT_TRUE(k);
      const double t = 1e-3, inside = value(strata.height(), {std::sin(t), y * std::cos(t)});
      EXPECT_EQ(k->counted(), inside > value(strata.height(), {0, y}));
    }
  }
}

// The same of an angle between its ends, whose coordinates are a cosine and a sine.
TEST(Stratum, TakesAnAngleAsOneCoordinate) {
  System s;
  s.variables.emplace_back("c", VariableKind::cosine, 0, 1);
  s.variables.emplace_back("s", VariableKind::sine, -1, 1);
  s.variables.emplace_back("x", VariableKind::length, -2, 2);
  s.angles.push_back({"t", 0, 1, Interval(-1.6, 1.6)});
  Polynomial circle;
  circle.monomials.emplace_back(1, std::vector<Factor>{{0, 2}});
  circle.monomials.emplace_back(1, std::vector<Factor>{{1, 2}});
  circle.monomials.emplace_back(-1, std::vector<Factor>{});
  s.equations = {circle, linear({"0", "-1", "1"}, "0")};  // x = sin t
  s.inequalities = {linear({"1", "0", "0"}, "-3/5")};
  for (int height = 0; height < 4; ++height) {
    const Strata strata(s, all_ends(s), height);
    ASSERT_TRUE(strata.problem().empty());
    EXPECT_EQ(strata.dimension(), 1);
    {
      const UpwardRounding rounding;
      EXPECT_EQ(strata.stratum({0}).system.variables[0].domain.lo(), -1);  // the equation holds the end
    }
    for (const double y : {0.8, -0.8}) {
      const auto k = kind(strata, {0}, {0.6, y, y});
      ASSERT_TRUE(k);
      const double t = (y > 0 ? 1 : -1) * (std::acos(0.6) - 1e-3);
      EXPECT_EQ(k->counted(),
                value(strata.height(), {std::cos(t), std::sin(t), std::sin(t)}) > value(strata.height(), {0.6, y, y}));
    }
  }
}

// The index is that along the stratum: of the height on the circle z = 0.
TEST(Stratum, TakesTheIndexAlongTheStratum) {
  const System half = with(sphere(2), {linear({"0", "0", "1"}, "0")});
  const Strata strata(half, all_ends(half), 0);
  const Point h = top(strata, 3);
  const double size = length({h[0], h[1]});
  const auto most = kind(strata, {0}, {h[0] / size, h[1] / size, 0}),
             least = kind(strata, {0}, {-h[0] / size, -h[1] / size, 0});
  ASSERT_TRUE(most && least);
  EXPECT_EQ(most->index, 1);
  EXPECT_EQ(least->index, 0);
  EXPECT_EQ(most->counted(), h[2] > 0);  // inward is upward there
  EXPECT_EQ(least->counted(), h[2] > 0);
}

TEST(Stratum, IsSilentWhereAnotherEndIsReached) {
  const System s = with(sphere(1), {linear({"1", "0"}, "0"), linear({"2", "1"}, "-1")});
  const Strata strata(s, all_ends(s), 0);
  EXPECT_FALSE(kind(strata, {0}, {0, 1}));
  EXPECT_FALSE(kind(strata, {0}, {0, -1}));  // there 2x + y − 1 < 0
  const System wide = with(sphere(1), {linear({"1", "0"}, "0"), linear({"2", "1"}, "2")});
  EXPECT_TRUE(kind(Strata(wide, all_ends(wide), 0), {0}, {0, 1}));
}

// An end through the top: there the height does not grow across it to first order.
TEST(Stratum, IsSilentWhereTheHeightIsCriticalAcrossTheEnd) {
  const Strata plain(sphere(1), {}, 0);
  const Point x = top(plain, 2);
  Polynomial g;  // the tangent direction, as a function that is 0 at x within 1e-17
  g.monomials.emplace_back(ExactNumber::dyadic(-x[1]), std::vector<Factor>{{0}});
  g.monomials.emplace_back(ExactNumber::dyadic(x[0]), std::vector<Factor>{{1}});
  const System s = with(sphere(1), {g});
  EXPECT_FALSE(kind(Strata(s, all_ends(s), 0), {0}, x));
}

// An end that is tangent to the circle: no manifold with ends, μ = 0.
TEST(Stratum, IsSilentWhereAnEndIsTangent) {
  const System s = with(sphere(1), {linear({"3/5", "4/5"}, "1")});
  EXPECT_FALSE(kind(Strata(s, all_ends(s), 0), {0}, {-0.6, -0.8}));
}

TEST(Stratum, ListsEachSetOfEndsOnceButNotBothEndsOfAVariable) {
  const System s = sphere(2);
  std::vector<End> ends;
  for (int j = 0; j < 2; ++j) {
    ends.push_back({linear(j == 0 ? std::vector<std::string>{"1"} : std::vector<std::string>{"0", "1"}, "2"),
                    Contact::With::lower_end, j});
    ends.push_back({linear(j == 0 ? std::vector<std::string>{"-1"} : std::vector<std::string>{"0", "-1"}, "2"),
                    Contact::With::upper_end, j});
  }
  EXPECT_EQ(Strata(s, ends, 0).strata().size(), 1u + 4u + 4u);
}

TEST(Stratum, DoesNotTakeSinesOfLengths) {
  System s = sphere(1);
  s.equations.front().monomials.emplace_back(1, std::vector<Factor>{{0, 1, Function::sine}});
  EXPECT_FALSE(Strata(s, {}, 0).problem().empty());
}

}  // namespace
}  // namespace corank::certify
