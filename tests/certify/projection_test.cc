#include "corank/certify/projection.h"

#include <gtest/gtest.h>

#include <random>

#include "corank/certify/domain.h"
#include "corank/certify/rounding.h"
#include "corank/tests/system_builder.h"

namespace corank::certify {
namespace {

using test::SystemBuilder;

bool project_once(const System& system, std::vector<Interval>& x, int row = 0) {
  const UpwardRounding rounding;
  std::vector<std::uint8_t> changed(x.size());
  return project(CompiledSystem(system), row, x.data(), 0.1, changed.data());
}

TEST(Projection, ShrinksACircleToItsArc) {
  SystemBuilder b;
  const int c = b.variable("c", "-1", "1"), s = b.variable("s", "-1", "1");
  b.equation({{"1", {{c, 2}}}, {"1", {{s, 2}}}, {"-1", {}}});
  std::vector<Interval> x{Interval(0.6, 1), Interval(0, 1)};
  ASSERT_TRUE(project_once(b.system(), x));
  EXPECT_EQ(x[c], Interval(0.6, 1));
  EXPECT_GE(x[s].hi(), 0.8);
  EXPECT_LE(x[s].hi(), 0.8 + 1e-15);
}

TEST(Projection, DeletesABoxWithoutSolutions) {
  SystemBuilder b;
  const int c = b.variable("c", "-1", "1"), s = b.variable("s", "-1", "1");
  b.equation({{"1", {{c, 2}}}, {"1", {{s, 2}}}, {"-1", {}}});
  std::vector<Interval> x{Interval(0.8, 1), Interval(0.7, 1)};
  EXPECT_FALSE(project_once(b.system(), x));
}

TEST(Projection, HonoursAnInequality) {
  SystemBuilder b;
  const int u = b.variable("u", "-4", "4"), v = b.variable("v", "-4", "4");
  b.at_least_zero({{"1", {{u, 1}}}, {"-1", {{v, 1}}}});  // u ≥ v
  std::vector<Interval> x{Interval(0, 1), Interval(0.5, 3)};
  ASSERT_TRUE(project_once(b.system(), x));
  EXPECT_EQ(x[u], Interval(0.5, 1));
  EXPECT_EQ(x[v], Interval(0.5, 1));
  std::vector<Interval> none{Interval(0, 1), Interval(2, 3)};
  EXPECT_FALSE(project_once(b.system(), none));
}

// Random polynomials with a planted root: whatever the box around it, no projection may lose it.
TEST(Projection, NeverLosesAPlantedSolution) {
  std::mt19937 random(20261121);
  const auto integer = [&](int lo, int hi) { return lo + static_cast<int>(random() % static_cast<unsigned>(hi - lo + 1)); };
  for (int trial = 0; trial < 3000; ++trial) {
    SystemBuilder b;
    std::vector<double> root;
    std::vector<ExactNumber> exact_root;
    for (int j = 0; j < 4; ++j) {
      b.variable("x" + std::to_string(j), "-4", "4");
      const int numerator = integer(-64, 64);
      root.push_back(numerator / 16.0);
      exact_root.push_back(ExactNumber(numerator) / ExactNumber(16));
    }
    const bool inequality = trial % 5 == 0;
    std::vector<Monomial> monomials;
    ExactNumber sum;
    for (int t = 0; t < integer(1, 6); ++t) {
      std::vector<Factor> factors;
      ExactNumber value(integer(1, 9) * (integer(0, 1) ? 1 : -1));
      const ExactNumber coefficient = value;
      for (int j = 0; j < 4; ++j)
        if (integer(0, 2) == 0) {
          factors.push_back({j, integer(1, 3)});
          value = value * pow(exact_root[j], factors.back().power);
        }
      if (factors.empty() || std::any_of(monomials.begin(), monomials.end(), [&](auto& m) { return m.factors == factors; }))
        continue;
      monomials.emplace_back(coefficient, factors);
      sum = sum + value;
    }
    if (monomials.empty()) continue;
    monomials.emplace_back(-sum, std::vector<Factor>{});
    System system = b.system();
    (inequality ? system.inequalities : system.equations).push_back({monomials, "planted"});

    std::vector<Interval> x;
    for (double r : root)
      x.emplace_back(std::max(-4.0, r - integer(0, 40) / 10.0), std::min(4.0, r + integer(0, 40) / 10.0));
    ASSERT_TRUE(project_once(system, x)) << "trial " << trial;
    for (int j = 0; j < 4; ++j) ASSERT_TRUE(x[j].contains(root[j])) << "trial " << trial << " variable " << j;
  }
}

TEST(Domain, IsImpliedByACircleOrANorm) {
  SystemBuilder b;
  const int c = b.variable("c", "-1", "1"), s = b.variable("s", "-1/2", "1"), y = b.variable("y", "-0.8", "0.8"),
            z = b.variable("z", "-1", "1");
  b.equation({{"1", {{c, 2}}}, {"1", {{s, 2}}}, {"-1", {}}});
  b.equation({{"1", {{y, 2}}}, {"1", {{c, 2}}}, {"-0.64", {}}});
  b.equation({{"1", {{z, 2}}}, {"-1", {{c, 2}}}, {"-1", {}}});
  const auto implied = implied_domains(b.system());
  EXPECT_TRUE(implied[c]);
  EXPECT_FALSE(implied[s]) << "−1/2 cuts the circle";
  EXPECT_TRUE(implied[y]) << "0.8² = 0.64 exactly";
  EXPECT_FALSE(implied[z]) << "not a sum of squares";
}

TEST(Domain, LocatesPiecesInsideOutsideAndAcross) {
  const UpwardRounding rounding;
  SystemBuilder b;
  const int u = b.variable("u", "0", "1"), v = b.variable("v", "0", "1");
  b.at_least_zero({{"1", {{u, 1}}}, {"-1", {{v, 1}}}});
  const CompiledSystem compiled(b.system());
  const DomainTest domain(b.system());
  const auto locate = [&](Interval x, Interval y) {
    const std::vector<Interval> box{x, y};
    return domain.locate(compiled, box.data());
  };
  EXPECT_EQ(locate({0.5, 0.6}, {0.1, 0.2}), Location::inside);
  EXPECT_EQ(locate({0.1, 0.2}, {0.5, 0.6}), Location::outside);
  EXPECT_EQ(locate({0.4, 0.6}, {0.5, 0.6}), Location::across);
  EXPECT_EQ(locate({0.9, 1.1}, {0.1, 0.2}), Location::across);
  EXPECT_EQ(locate({1.1, 1.2}, {0.1, 0.2}), Location::outside);
}

}  // namespace
}  // namespace corank::certify
