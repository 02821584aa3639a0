// Unions, products and strata with known solutions. Each equation is a product of one to three planes; some planes are
// factors of several equations, and then solutions lie in sets larger than the equations' number says. Beside them there may
// be a circle, which makes the whole a product. Nothing is lost, and no box claims more or fewer solutions than it holds.
// CORANK_FIRST_SEED=1000 CORANK_SEEDS=20000 ./solve_test --gtest_filter='PlantedUnions.*' looks further.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <map>
#include <optional>
#include <random>

#include "corank/solve/search/solve.h"
#include "corank/tests/cover_lookup.h"
#include "corank/tests/seeds.h"
#include "corank/tests/system_builder.h"

namespace corank::solve {
namespace {

constexpr double kSampleError = 1e-9, kApart = 1e-5;

struct UnionTally {
  std::size_t systems = 0, complete = 0, unions = 0, products = 0, strata = 0, points = 0, claims = 0, parts = 0, lost = 0,
              wrong = 0;
};

class PlantedUnion {
 public:
  using Place = std::vector<double>;

  explicit PlantedUnion(unsigned seed) : random_(seed) {
    planes_in_ = 2 + below(3);
    const std::size_t equations = std::max<std::size_t>(1, planes_in_ - below(3));
    for (std::size_t k = 0; k < 2; ++k)
      for (std::size_t j = 0; j < planes_in_; ++j) eighths_[k].push_back(static_cast<int>(below(13)) - 6);
    factors_.resize(equations);
    if (equations > 1 && below(3) == 0) {  // a factor of all equations, or of two
      const Plane shared = plane();
      const std::size_t owners = below(2) == 0 ? equations : 2;
      for (std::size_t i = 0; i < owners; ++i) factors_[i].push_back(shared);
      has_stratum = true;
    }
    for (auto& row : factors_)
      for (std::size_t count = 1 + below(2); count > 0; --count) row.push_back(plane());
    has_union = std::ranges::any_of(factors_, [](const auto& row) { return row.size() > 1; });
    has_circle = below(3) == 0;
    is_mixed_ = equations > 1 && below(4) == 0;
  }

  System system() const {
    test::SystemBuilder builder;
    for (std::size_t j = 0; j < planes_in_; ++j) builder.variable("x" + std::to_string(j), "-1", "1");
    std::vector<Terms> rows;
    for (const auto& row : factors_) {
      Terms product{{{}, 1}};
      for (const Plane& factor : row) product = times(product, factor);
      rows.push_back(std::move(product));
    }
    if (is_mixed_)  // the same solutions, but no equation is seen to be a product
      for (const auto& [powers, number] : rows[1]) rows[0][powers] += number;
    for (const Terms& row : rows) {
      std::vector<test::SystemBuilder::Term> terms;
      for (const auto& [powers, number] : row) {
        std::vector<Factor> factors;
        for (const auto& [variable, power] : powers) factors.push_back({variable, power});
        if (number != 0) terms.emplace_back(std::to_string(number), factors);
      }
      builder.equation(terms);
    }
    if (has_circle) {
      const int c = builder.variable("c", "-1", "1"), s = builder.variable("s", "-1", "1");
      builder.equation({{"1", {{c, 2}}}, {"1", {{s, 2}}}, {"-1", {}}});
    }
    return builder.system();
  }

  // A random point that solves one chosen factor of each equation; some of its coordinates may be given. None: there is no
  // such point, or the random one is outside the domain.
  std::optional<Place> member(std::map<int, double> given, const std::vector<std::size_t>& choice) {
    std::vector<std::vector<double>> rows;
    for (std::size_t i = 0; i < factors_.size(); ++i) rows.push_back(row_of(factors_[i][choice[i]]));
    Place x(planes_in_, HUGE_VAL);
    std::vector<bool> open(planes_in_, true);
    for (const auto& [j, value] : given)
      if (static_cast<std::size_t>(j) < planes_in_)
        open[static_cast<std::size_t>(j)] = false, x[static_cast<std::size_t>(j)] = value;
    return solved(std::move(rows), std::move(open), std::move(x), given);
  }

  std::vector<std::size_t> any_choice() {
    std::vector<std::size_t> choice;
    for (const auto& row : factors_) choice.push_back(below(row.size()));
    return choice;
  }
  std::vector<std::vector<std::size_t>> every_choice() const {
    std::vector<std::vector<std::size_t>> all{{}};
    for (const auto& row : factors_) {
      std::vector<std::vector<std::size_t>> longer;
      for (const auto& choice : all)
        for (std::size_t k = 0; k < row.size(); ++k) longer.push_back(choice), longer.back().push_back(k);
      all = std::move(longer);
    }
    return all;
  }
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }

  bool has_union = false, has_circle = false, has_stratum = false;

 private:
  struct Plane {
    std::vector<int> normal;
    int constant;  // normal · 8 x = constant
  };
  using Terms = std::map<std::map<int, int>, long>;

  std::size_t below(std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random_); }

  // Through one of two planted points, so that many meet there.
  Plane plane() {
    Plane result{std::vector<int>(planes_in_, 0), 0};
    const auto& point = eighths_[below(3) == 0 ? 1 : 0];
    while (std::ranges::all_of(result.normal, [](int a) { return a == 0; }))
      for (int& a : result.normal) a = below(2) == 0 ? 0 : static_cast<int>(below(7)) - 3;
    for (std::size_t j = 0; j < planes_in_; ++j) result.constant += result.normal[j] * point[j];
    return result;
  }
  std::vector<double> row_of(const Plane& factor) const {
    std::vector<double> row;
    for (const int a : factor.normal) row.push_back(8 * a);
    row.push_back(factor.constant);
    return row;
  }
  static Terms times(const Terms& product, const Plane& factor) {
    Terms result;
    for (const auto& [powers, number] : product) {
      result[powers] -= number * factor.constant;
      for (std::size_t j = 0; j < factor.normal.size(); ++j) {
        auto raised = powers;
        ++raised[static_cast<int>(j)];
        if (factor.normal[j] != 0) result[raised] += number * 8 * factor.normal[j];
      }
    }
    return result;
  }

  std::optional<Place> solved(std::vector<std::vector<double>> rows, std::vector<bool> open, Place x,
                              const std::map<int, double>& given) {
    std::vector<std::pair<std::size_t, std::size_t>> pivots;  // (row, variable)
    for (auto& row : rows)
      for (std::size_t j = 0; j < planes_in_; ++j)
        if (!open[j]) row[planes_in_] -= row[j] * x[j], row[j] = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      std::size_t pivot = 0;
      for (std::size_t j = 0; j < planes_in_; ++j)
        if (std::fabs(rows[i][j]) > std::fabs(rows[i][pivot])) pivot = j;
      if (std::fabs(rows[i][pivot]) < 1e-9) {
        if (std::fabs(rows[i][planes_in_]) > 1e-9) return std::nullopt;
        continue;
      }
      pivots.emplace_back(i, pivot);
      for (std::size_t k = 0; k < rows.size(); ++k) {
        if (k == i) continue;
        const double ratio = rows[k][pivot] / rows[i][pivot];
        for (std::size_t j = 0; j <= planes_in_; ++j) rows[k][j] -= ratio * rows[i][j];
      }
    }
    std::vector<bool> dependent(planes_in_, false);
    for (const auto& [row, variable] : pivots) dependent[variable] = true;
    for (std::size_t j = 0; j < planes_in_; ++j)
      if (open[j] && !dependent[j]) x[j] = between(-1, 1);
    for (const auto& [row, variable] : pivots) {
      double rest = rows[row][planes_in_];
      for (std::size_t j = 0; j < planes_in_; ++j)
        if (open[j] && !dependent[j]) rest -= rows[row][j] * x[j];
      x[variable] = rest / rows[row][variable];
    }
    if (!std::ranges::all_of(x, [](double v) { return std::fabs(v) <= 1 + 1e-12; })) return std::nullopt;
    if (has_circle) add_circle(x, given);
    return x;
  }
  void add_circle(Place& x, const std::map<int, double>& given) {
    const int first = static_cast<int>(planes_in_);
    const auto c = given.find(first), s = given.find(first + 1);
    const double sign = below(2) == 0 ? -1 : 1;
    if (c == given.end() && s == given.end()) {
      const double angle = between(-3.2, 3.2);
      x.push_back(std::cos(angle)), x.push_back(std::sin(angle));
    } else {
      x.push_back(c != given.end() ? c->second : sign * std::sqrt(std::max(0.0, 1 - s->second * s->second)));
      x.push_back(s != given.end() ? s->second : sign * std::sqrt(std::max(0.0, 1 - c->second * c->second)));
    }
  }

  std::mt19937 random_;
  std::size_t planes_in_ = 0;
  std::vector<int> eighths_[2];
  std::vector<std::vector<Plane>> factors_;  // of each equation
  bool is_mixed_ = false;
};

bool claims_at_most_one(const CoverBox& b) {
  return b.verdict == Verdict::regular || b.verdict == Verdict::isolated || b.verdict == Verdict::boundary;
}
bool is_in(const CoverBox& b, const std::vector<double>& x, double slack) {
  for (std::size_t j = 0; j < x.size(); ++j)
    if (x[j] < b.box[j].lo() - slack || x[j] > b.box[j].hi() + slack) return false;
  return true;
}
double apart(const std::vector<double>& x, const std::vector<double>& y) {
  double most = 0;
  for (std::size_t j = 0; j < x.size(); ++j) most = std::max(most, std::fabs(x[j] - y[j]));
  return most;
}

// What a cover says of points that are known.
void compare_with_members(PlantedUnion& planted, const Cover& cover, UnionTally& tally) {
  const test::CoverLookup lookup(cover);
  const auto all = planted.every_choice();
  const auto at_free = [](const CoverBox& b, const std::vector<double>& x) {
    std::map<int, double> given;
    for (const int j : b.free) given[j] = x[static_cast<std::size_t>(j)];
    return given;
  };
  for (int trial = 0; trial < 100; ++trial) {
    const auto x = planted.member({}, planted.any_choice());
    if (!x) continue;
    ++tally.points;
    tally.lost += !lookup.holds(*x, kSampleError);
    lookup.for_each(*x, kSampleError, [&](const CoverBox& b) {
      if (!claims_at_most_one(b) || !is_in(b, *x, -kSampleError)) return;
      for (const auto& choice : all)  // another one for the same values of the free variables
        if (const auto y = planted.member(at_free(b, *x), choice))
          tally.wrong += apart(*x, *y) > kApart && is_in(b, *y, -kSampleError);
    });
  }
  for (int trial = 0; trial < 40 && !cover.boxes.empty(); ++trial) {
    const CoverBox& b =
        cover.boxes[static_cast<std::size_t>(planted.between(0, 0.999) * static_cast<double>(cover.boxes.size()))];
    if (b.verdict != Verdict::regular && b.verdict != Verdict::isolated) continue;
    ++tally.claims;
    const bool in_part = !b.free.empty() && !spans(cover, b);
    tally.parts += in_part;
    std::vector<double> x;
    for (const Interval& side : in_part ? cover.regions[static_cast<std::size_t>(b.region)] : b.box)
      x.push_back(planted.between(side.lo(), side.hi()));
    bool found = false;
    for (int again = 0; again < 40 && !found; ++again)  // of the circle, either half
      for (const auto& choice : all)
        if (const auto y = planted.member(at_free(b, x), choice)) found = found || is_in(b, *y, kSampleError);
    tally.wrong += !found;
  }
}

enum class Boxes { cut, cut_or_narrow_parts, as_they_are_proven };

Cover cover_of(const PlantedUnion& planted, Boxes boxes = Boxes::cut) {
  Options options;
  options.surfaces_whole = boxes != Boxes::cut;
  if (boxes != Boxes::as_they_are_proven) options.sigma = 0.25;
  options.max_boxes = 2000;
  return solve(planted.system(), options);
}

TEST(PlantedUnions, LoseNothingAndClaimNothingFalse) {
  const char* from = std::getenv("CORANK_FIRST_SEED");
  const unsigned first = from != nullptr ? static_cast<unsigned>(std::atoi(from)) : 0, count = test::seeds(200);
  UnionTally tally;
  for (unsigned seed = first; seed < first + count && !HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    PlantedUnion planted(seed);
    const Cover cover =
        cover_of(planted, std::array{Boxes::cut, Boxes::as_they_are_proven, Boxes::cut_or_narrow_parts}[seed % 3]);
    ++tally.systems;
    tally.complete += cover.complete();
    tally.unions += planted.has_union;
    tally.products += planted.has_circle;
    tally.strata += planted.has_stratum;
    compare_with_members(planted, cover, tally);
    EXPECT_EQ(tally.lost, 0U);
    EXPECT_EQ(tally.wrong, 0U);
  }
  if (test::long_run())
    std::cout << tally.systems << " systems: " << tally.unions << " unions, " << tally.products << " products, "
              << tally.strata << " with a shared factor; " << tally.complete << " complete; " << tally.points << " points, "
              << tally.claims << " claims, " << tally.parts << " of parts of sheets; lost " << tally.lost << ", false "
              << tally.wrong << std::endl;
  EXPECT_GT(tally.points, 10 * tally.systems);
  EXPECT_GT(tally.claims, tally.systems);
  EXPECT_GT(2 * tally.parts, tally.systems);
}

TEST(PlantedUnions, AreMissedWhereABoxIsLostOrAClaimIsFalse) {
  UnionTally without, wider, moved;
  for (unsigned seed = 0; seed < 8; ++seed) {
    PlantedUnion planted(seed);
    const Cover cover = cover_of(planted);
    Cover fewer = cover;
    for (std::size_t k = 0; k < fewer.boxes.size() / 2; ++k) fewer.boxes.erase(fewer.boxes.begin() + static_cast<long>(k));
    compare_with_members(planted, fewer, without);
    Cover wide = cover, away = cover;
    for (std::size_t k = 0; k < cover.boxes.size(); ++k)
      for (std::size_t j = 0; j < cover.boxes[k].box.size(); ++j)
        if (std::ranges::find(cover.boxes[k].free, static_cast<int>(j)) == cover.boxes[k].free.end()) {
          const Interval side = cover.boxes[k].box[j];
          if (k % 8 == 0) wide.boxes[k].box[j] = Interval(-1, 1);
          away.boxes[k].box[j] = Interval(side.hi() + 0.01, side.hi() + 0.02 + side.width());
        }
    compare_with_members(planted, wide, wider);
    compare_with_members(planted, away, moved);
  }
  EXPECT_GT(without.lost, 20U);
  EXPECT_GT(wider.wrong, 20U) << "two solutions, one claimed";
  EXPECT_GT(moved.wrong, 20U) << "no solution, one claimed";
}

}  // namespace
}  // namespace corank::solve
