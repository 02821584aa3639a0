// Sets in parts, planted: random matrices of random blocks, some with a fixed angle and passive numbers among their entries,
// whose determinant is known where it is evaluated. No part is false: where it holds, the determinant vanishes. None is
// lost: where a planted factor vanishes or the determinant changes its sign, a part holds. CORANK_SEEDS=100000: as many.
#include "corank/symbolic/sets/decomposition.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <optional>

#include "corank/tests/seeds.h"
#include "corank/tests/symbolic/evaluate.h"

namespace corank::symbolic {
namespace {

using std::numbers::pi_v;
using MatrixOfExpressions = std::vector<std::vector<Expression>>;

long double determinant_at(const MatrixOfExpressions& m, const Values& at) {
  std::vector<std::vector<long double>> a;
  for (const auto& row : m) {
    auto& to = a.emplace_back();
    for (const Expression& e : row) to.push_back(evaluate(e, at));
  }
  return determinant_of(std::move(a));
}

// 0 where the part holds; it changes its sign there but at zeros of even order.
long double value_of(const Component& part, const Values& at) {
  if (part.dependent_angle) {
    const DependentAngle& t = *part.dependent_angle;
    return std::sin((at.at(t.angle) - t.sign * at.at(t.other) - t.quarters * pi_v<long double> / 2) / 2);
  }
  return !part.conditions.empty() ? evaluate(part.conditions.front(), at) : determinant_at(part.block->rows, at);
}

class Planted {
 public:
  explicit Planted(unsigned seed) : random_(seed) {
    for (const char* name : {"x", "y", "z"}) lengths_.push_back(mechanism.length(name, -1, 1));
    for (const char* name : {"a", "b", "c"}) angles_.push_back(mechanism.angle(name));
    // A coordinate that an equation gives: parts are told in the others.
    const Expression given = mechanism.length("given", -9, 9);
    mechanism.constrain(given - lengths_[0] * lengths_[1] - sin(angles_[0]) == 0);
    lengths_.push_back(given);
    // cos = 0 or ±1: entries that hold it vanish or become simpler.
    const Expression turn = Expression(below(4) - 1) * pi() / 2;
    fixed_value_ = evaluate(turn, {});
    fixed_ = mechanism.angle("fixed", turn, turn);
  }

  void plant() {
    std::vector<std::size_t> sizes;
    for (int k = 0, n = 1 + below(3); k < n; ++k) sizes.push_back(static_cast<std::size_t>(1 + (below(3) == 0)));
    const std::size_t n = std::accumulate(sizes.begin(), sizes.end(), std::size_t{0}) + static_cast<std::size_t>(below(3));
    rows.assign(n, std::vector<Expression>(n, Expression(0)));
    std::size_t start = 0;
    for (const std::size_t size : sizes) {
      for (std::size_t i = start; i < start + size; ++i)
        for (std::size_t j = start; j < start + size; ++j) rows[i][j] = size == 1 ? planted_product() : entry();
      start += size;
    }
    for (std::size_t i = start; i < n; ++i) rows[i][i] = Expression(1 + below(5));  // to be eliminated
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        if (same_tree(rows[i][j], 0) && j > i && below(2)) rows[i][j] = entry();
    // Numbers below the diagonal as well: multiples of a row.
    for (std::size_t k = start; k < n; ++k) {
      const auto i = static_cast<std::size_t>(below(static_cast<int>(n)));
      if (i == k || below(2)) continue;
      for (std::size_t j = 0; j < n; ++j)
        if (!same_tree(rows[k][j], 0)) rows[i][j] = rows[i][j] + Expression(2) * rows[k][j];
    }
    std::shuffle(rows.begin(), rows.end(), random_);
  }

  KernelQuestion question() const {
    KernelQuestion kernel{definition(SingularitySet::forward), "M", {}, {}, KernelSide::right, {}};
    kernel.matrix.rows = rows;
    for (std::size_t j = 0; j < rows.size(); ++j) kernel.matrix.columns.push_back("r" + std::to_string(j));
    kernel.matrix.roles.assign(rows.size(), Role::passive);
    kernel.where.assign(rows.size(), SourceLocation{"planted", 0, 0});
    return kernel;
  }

  Values point() {
    Values at{{"fixed", fixed_value_}};
    for (const Expression& x : lengths_) at[x.name()] = uniform(1);
    for (const Expression& a : angles_) at[a.name()] = uniform(pi_v<double>);
    return configuration(at);
  }
  static Values configuration(Values at) {
    at["given"] = at["x"] * at["y"] + std::sin(at["a"]);
    return at;
  }

  // Between two random points, by bisection.
  template <typename F>
  std::optional<Values> zero(const F& f) {
    const Values from = point(), to = point();
    const auto on_the_way = [&](long double t) {
      Values at;
      for (const auto& [name, value] : from) at[name] = value + t * (to.at(name) - value);
      return configuration(at);
    };
    long double low = 0, high = 1;
    const bool positive = f(from) > 0;
    if (positive == (f(to) > 0)) return std::nullopt;
    for (int step = 0; step < 70; ++step) {
      const long double middle = (low + high) / 2;
      ((f(on_the_way(middle)) > 0) == positive ? low : high) = middle;
    }
    return on_the_way(low);
  }

  Mechanism mechanism{"planted"};
  MatrixOfExpressions rows;
  std::vector<Expression> factors;  // of the determinant

 private:
  int below(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }
  double uniform(double size) { return std::uniform_real_distribution<>(-size, size)(random_); }
  const Expression& one_of(const std::vector<Expression>& list) {
    return list[static_cast<std::size_t>(below(static_cast<int>(list.size())))];
  }
  Expression fraction() { return Expression(below(7) - 3) / Expression(4 + below(3)); }
  Expression wave(const Expression& angle) { return below(2) ? sin(angle) : cos(angle); }

  Expression entry() {
    switch (below(6)) {
      case 0: return one_of(lengths_) + fraction();
      case 1: return one_of(lengths_) * wave(one_of(angles_)) + fraction() * wave(fixed_);
      case 2: return wave(fixed_) * one_of(lengths_);
      case 3: return wave(one_of(angles_));
      case 4: return wave(one_of(angles_)) * wave(one_of(angles_)) + fraction();
      default: return Expression(1 + below(3));
    }
  }

  Expression factor() {
    const std::size_t first = static_cast<std::size_t>(below(3)), second = (first + 1) % 3;
    const Expression &a = angles_[first], &b = angles_[second];
    switch (below(9)) {
      case 0: return sin(a) * cos(b) - cos(a) * sin(b);
      case 1: return sin(a) * cos(b) + cos(a) * sin(b);
      case 2: return cos(a) * cos(b) + sin(a) * sin(b);
      case 3: return cos(a) * cos(b) - sin(a) * sin(b);
      case 4: return one_of(lengths_) + Expression(2);  // vanishes nowhere
      case 5: return one_of(lengths_) * wave(a) - fraction();
      case 6: return wave(a);
      case 7: return cos(fixed_) * one_of(lengths_) + sin(fixed_) * wave(a);
      default: return one_of(lengths_) + fraction() * one_of(lengths_) * wave(b);
    }
  }

  Expression planted_product() {
    factors.push_back(factor());
    if (below(2)) return factors.back();
    factors.push_back(factor());
    return factors[factors.size() - 2] * factors.back();
  }

  std::mt19937_64 random_;
  std::vector<Expression> lengths_, angles_;
  Expression fixed_;
  long double fixed_value_ = 0;
};

TEST(Decomposition, LosesNoPlantedFactorAndNoPartIsFalse) {
  constexpr long double kZero = 1e-9L;
  // A determinant's zero of order k is found to ε^(1/k), with ε near 1e-19; a factor may be planted six times.
  constexpr long double kNearZero = 1e-3L;
  const unsigned seeds = test::seeds(40);
  int in_parts = 0, on_parts = 0, on_factors = 0, crossings = 0, ties = 0;
  for (unsigned seed = 0; seed < seeds; ++seed) {
    Planted planted(seed);
    planted.plant();
    SCOPED_TRACE(seed);
    const std::vector<Component> parts = decompose(planted.mechanism, planted.question());
    const auto determinant = [&](const Values& at) { return determinant_at(planted.rows, at); };
    const auto nearest = [&](const Values& at) {
      long double least = 1;
      for (const Component& part : parts) least = std::min(least, std::fabs(value_of(part, at)));
      return least;
    };
    // Of no parts nothing is said but that the question stays whole.
    if (parts.empty()) continue;
    ++in_parts;
    for (const Component& part : parts) {
      ties += part.dependent_angle.has_value();
      for (int trial = 0; trial < 10; ++trial)
        if (const auto at = planted.zero([&](const Values& x) { return value_of(part, x); })) {
          ++on_parts;
          EXPECT_LT(std::fabs(determinant(*at)), kZero) << part.name;
        }
    }
    for (const Expression& factor : planted.factors)
      for (int trial = 0; trial < 5; ++trial)
        if (const auto at = planted.zero([&](const Values& x) { return evaluate(factor, x); })) {
          ++on_factors;
          EXPECT_LT(nearest(*at), kZero) << factor.text();
        }
    for (int trial = 0; trial < 10; ++trial)
      if (const auto at = planted.zero(determinant)) {
        ++crossings;
        EXPECT_LT(nearest(*at), kNearZero);
      }
    if (HasFailure()) break;
  }
  EXPECT_GT(in_parts, static_cast<int>(seeds / 2));
  EXPECT_GT(on_parts, in_parts);
  EXPECT_GT(on_factors, in_parts);
  EXPECT_GT(crossings, in_parts);
  EXPECT_GT(ties, in_parts / 10);
}

// det M = (p² − q²) cos a cos b.
TEST(Decomposition, IsNoneWhereAConstantFactorIsOrMayBeZero) {
  Mechanism arm("arm");
  const Expression p = arm.constant("p", 2), q = arm.constant("q", 1), a = arm.angle("a"), b = arm.angle("b");
  arm.constrain(arm.length("x", -3, 3) - sin(a) - sin(b) == 0);
  KernelQuestion kernel{definition(SingularitySet::forward), "M", {}, {}, KernelSide::right, {}};
  kernel.matrix.columns = {"a", "b"};
  kernel.matrix.rows = {{p * cos(a), q * cos(b)}, {q * cos(a), p * cos(b)}};
  kernel.matrix.roles.assign(2, Role::input);
  kernel.where.assign(2, SourceLocation{"arm", 0, 0});
  EXPECT_EQ(decompose(arm, kernel).size(), 2u);
  arm.set_constant("q", 2);
  EXPECT_TRUE(decompose(arm, kernel).empty());
}

}  // namespace
}  // namespace corank::symbolic
