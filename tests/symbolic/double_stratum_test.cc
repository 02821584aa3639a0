// PlantedStratum double strata: that they are found, and that the theorem's equations are those of the set at random points.
// CORANK_SEEDS=1000 plants more.
#include "corank/symbolic/sets/double_stratum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>

#include "corank/tests/seeds.h"
#include "corank/tests/symbolic/evaluate.h"

namespace corank::symbolic {
namespace {

// x_v = a_v for k lengths, a_v an affine function of p others y; k equations, of which one does not vanish there; and an f
// that vanishes doubly.
struct PlantedStratum {
  explicit PlantedStratum(unsigned seed) : random(seed) {
    const int k = 2 + number(0, 1), p = 3;
    for (int j = 0; j < p; ++j) y.push_back(mechanism.length("y" + std::to_string(j), -2, 2));
    for (int v = 0; v < k; ++v) {
      x.push_back(mechanism.length("x" + std::to_string(v), -2, 2));
      Expression a = number(0, 1) ? Expression(number(-3, 3)) / Expression(4) : Expression(0);
      if (number(0, 3) == 0) a = a + number(1, 3) * y[static_cast<std::size_t>(number(0, p - 1))];
      t.push_back(x.back() - a);
    }
    const Expression g = y[0] * y[0] + number(1, 3) * y[1] * y[1] + y[2] * y[2] - number(1, 3);
    for (int i = 0; i < k; ++i) {
      Expression row = (i == 0 ? 1 : number(-2, 2)) * g;
      for (const Expression& each : t) row = row + each * (number(1, 3) + number(-2, 2) * any(y) + number(-1, 1) * any(t));
      mechanism.constrain(row == Expression(0));
    }
    f = t[0] * t[1] * any(y);
    for (int i = 0; i < k; ++i) f = f + number(1, 3) * t[i] * t[(i + 1) % k] * (number(0, 1) ? any(y) : any(t));
  }

  int number(int lo, int hi) { return lo + static_cast<int>(random() % static_cast<unsigned>(hi - lo + 1)); }
  Expression any(const std::vector<Expression>& list) { return list[random() % list.size()]; }

  std::mt19937_64 random;
  Mechanism mechanism{"planted"};
  std::vector<Expression> x, y, t;
  Expression f;
};

TEST(PlantedDoubleStrata, AreFoundAndDivideTheirSets) {
  int found = 0, checked = 0;
  const unsigned seeds = test::seeds(60);
  for (unsigned seed = 0; seed < seeds; ++seed) {
    PlantedStratum p(seed);
    const auto stratum = double_stratum(p.mechanism, p.f);
    if (!stratum) continue;
    ++found;
    TrigonometricSystem whole = plain_system(p.mechanism), on = whole;
    whole.equations.push_back({p.f == Expression(0), "f", {}, true});
    TrigonometricSystem beside = whole;
    put_on(*stratum, p.mechanism, on);
    put_beside(*stratum, p.mechanism, beside);
    ASSERT_EQ(on.equations.size(), whole.equations.size());
    const std::size_t k = stratum->relations.size();
    ASSERT_EQ(beside.equations.size(), whole.equations.size() + k + 1);
    std::uniform_real_distribution<long double> uniform(-1, 1);
    std::vector multiples(whole.equations.size(), std::vector<std::vector<long double>>(4 * whole.equations.size()));
    for (int trial = 0; trial < 5; ++trial) {
      Values at;
      for (const Coordinate& c : p.mechanism.coordinates()) at[c.name] = uniform(p.random);
      // On the stratum f vanishes, and every equation where those of the part do.
      for (const Relation& r : stratum->relations) at[r.lhs.name()] = evaluate(r.rhs, at);
      EXPECT_NEAR(static_cast<double>(evaluate(p.f, at)), 0, 1e-15) << seed;
      long double largest = 0;
      for (const auto& e : on.equations) largest = std::max(largest, std::fabs(residual(e.relation, at)));
      for (const auto& e : whole.equations)
        EXPECT_LE(std::fabs(residual(e.relation, at)), 10 * largest + 1e-15L) << seed << e.relation.text();
      // Beside it, each equation is a power of rho times the one in its place, and a multiple of one that is kept.
      long double norm = 0;
      const long double rho = at["rho1"] = uniform(p.random);
      for (std::size_t v = 1; v <= k; ++v) {
        const long double eta = at["eta" + std::to_string(v)] = uniform(p.random);
        norm += eta * eta;
      }
      for (std::size_t v = 0; v < k; ++v) at["eta" + std::to_string(v + 1)] /= std::sqrt(norm);
      for (std::size_t v = 0; v < k; ++v) {
        const Relation& r = stratum->relations[v];
        at[r.lhs.name()] = evaluate(r.rhs, at) + rho * at["eta" + std::to_string(v + 1)];
        EXPECT_NEAR(static_cast<double>(residual(beside.equations[v].relation, at)), 0, 1e-15);
      }
      EXPECT_NEAR(static_cast<double>(residual(beside.equations.back().relation, at)), 0, 1e-15);
      // By each power of rho, and each equation, the multiple of this one that would be it.
      const std::size_t m = whole.equations.size();
      for (std::size_t i = 0; i < m; ++i) {
        EXPECT_NE(residual(beside.equations[k + i].relation, at), 0) << seed;
        for (std::size_t way = 0; way < multiples[i].size(); ++way)
          multiples[i][way].push_back((residual(whole.equations[i].relation, at) -
                                       std::pow(rho, way / m) * residual(beside.equations[k + i].relation, at)) /
                                      residual(whole.equations[way % m].relation, at));
      }
    }
    for (std::size_t i = 0; i < whole.equations.size(); ++i) {
      const bool is_one = std::ranges::any_of(multiples[i], [](const std::vector<long double>& q) {
        return std::ranges::all_of(q, [&](long double each) { return std::fabs(each - q[0]) < 1e-10L; });
      });
      checked += is_one;
      EXPECT_TRUE(is_one) << seed << ": " << beside.equations[k + i].relation.text();
    }
  }
  std::cout << found << " of " << seeds << " found, " << checked << " equations checked\n";
  EXPECT_GE(found, static_cast<int>(seeds / 2));
}

TEST(PlantedDoubleStrata, AreNoneWhereTheConditionIsSimple) {
  PlantedStratum p(1);
  EXPECT_FALSE(double_stratum(p.mechanism, p.f + p.t[0]));
  EXPECT_FALSE(double_stratum(p.mechanism, p.x[0]));
}

}  // namespace
}  // namespace corank::symbolic
