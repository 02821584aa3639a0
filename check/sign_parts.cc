#include "corank/check/sign_parts.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "corank/check/inertia.h"
#include "corank/check/krawczyk.h"
#include "corank/core/box.h"
#include "corank/core/dense.h"

namespace corank::check {
namespace {

constexpr double kShare = 0.53;  // of a segment: its middle may well be a zero of a function

bool is_nonpositive(const Enclosure& x) { return (-x).is_nonnegative(); }

// s·x
Enclosure turned(const Enclosure& x, int s) { return s > 0 ? x : -x; }

}  // namespace

struct SignParts::Arc {
  int intervals = 0;
  bool first = true;

  void add(bool begins_in_part, bool has_part) {
    if (has_part && (first || !begins_in_part)) ++intervals;
    first = false;
  }
};

SignCell SignParts::cell(const std::vector<int>& free, Sides sides) const {
  SignCell result;
  result.free = &free;
  result.sides = std::move(sides);
  result.range.assign(functions_.size(), Enclosure::whole());
  result.mixed.resize(functions_.size());
  std::iota(result.mixed.begin(), result.mixed.end(), std::size_t{0});
  return result;
}

bool SignParts::bound(SignCell& cell, int steps) const {
  const std::vector<int> dependent = all_but(*cell.free, problem_.size());
  Krawczyk newton(problem_.equations(), problem_.size());
  for (int step = 0; step < steps && (step == 0 || !cell.mixed.empty()); ++step) {
    const bool linear = newton.set(dependent, cell.sides, Krawczyk::Center::polished);
    if (linear && !newton.shrink(cell.sides, newton.image(cell.sides))) return false;
    std::vector<std::size_t> mixed;
    for (const std::size_t k : cell.mixed) {
      Enclosure value = functions_[k].value(cell.sides);
      if (linear && value.has_zero() && !value.intersect(newton.value_at_zeros(functions_[k], cell.sides))) return false;
      if (value.has_zero()) mixed.push_back(k);
      cell.range[k] = value;
    }
    cell.mixed = std::move(mixed);
    if (!linear) break;
  }
  return true;
}

SignParts::Part SignParts::whole(const SignCell& cell, const std::vector<int>& signs) const {
  bool all = true;
  for (std::size_t k = 0; k < signs.size(); ++k) {
    const Enclosure value = turned(cell.range[k], signs[k]);
    if (is_nonpositive(value)) return Part::empty;
    all = all && value.is_positive();
  }
  return all ? Part::connected : Part::unknown;
}

bool SignParts::slopes(const SignCell& cell, Slopes& result) const {
  const std::vector<int> dependent = all_but(*cell.free, problem_.size());
  const std::vector<Row>& equations = problem_.equations();
  const std::size_t m = equations.size(), n = cell.sides.size();
  thread_local std::vector<Sides> jacobian;  // whose memory is used again
  thread_local Sides entries;
  jacobian.resize(m);
  const auto derive = [&](const Row& row, Sides& dense) {
    dense.assign(n, Enclosure());
    row.derivatives(cell.sides, entries);
    for (std::size_t k = 0; k < entries.size(); ++k) dense[row.columns()[k]] = entries[k];
  };
  for (std::size_t b = 0; b < m; ++b) derive(equations[b], jacobian[b]);
  const auto basis = kernel_basis(jacobian, dependent, *cell.free);
  if (!basis) return false;
  result.clear();
  for (const std::size_t g : cell.mixed) {
    Sides gradient, by_free;
    derive(functions_[g], gradient);
    for (std::size_t f = 0; f < cell.free->size(); ++f) {
      Enclosure sum = gradient[(*cell.free)[f]];
      for (const int d : dependent) sum.add_product(gradient[d], (*basis)[d][f]);
      by_free.push_back(sum);
    }
    result.push_back(std::move(by_free));
  }
  return true;
}

bool SignParts::grows(const SignCell& cell, const Slopes& slopes, const Direction& d, const std::vector<int>& signs) {
  for (std::size_t k = 0; k < cell.mixed.size(); ++k) {
    Enclosure along;
    for (std::size_t f = 0; f < d.size(); ++f) along.add_product(d[f], slopes[k][f]);
    if (!turned(along, signs[cell.mixed[k]]).is_positive()) return false;
  }
  return true;
}

SignCell SignParts::face(const SignCell& cell, std::size_t f, bool upper, int steps) const {
  SignCell result = cell;
  Enclosure& side = result.sides[(*cell.free)[f]];
  side = upper ? side.upper_end() : side.lower_end();
  if (!bound(result, steps)) result = cell;  // says no more than the cell does
  return result;
}

bool SignParts::add_segment(SignCell cell, std::size_t along, bool upwards, const std::vector<int>& signs, int depth,
                            Arc& arc) const {
  problem_.stop().poll();
  if (!bound(cell, 1)) return false;
  if (const Part all = whole(cell, signs); all != Part::unknown) {
    arc.add(all == Part::connected, all == Part::connected);
    return true;
  }
  const SignCell begin = face(cell, along, !upwards, 2), end = face(cell, along, upwards, 2);
  const Part at_begin = whole(begin, signs), at_end = whole(end, signs);
  const bool holds = at_begin == Part::connected || at_end == Part::connected;
  Slopes s;
  if (slopes(cell, s) && std::ranges::none_of(s, [&](const Sides& slope) { return slope[along].has_zero(); })) {
    bool empty = false;
    for (std::size_t i = 0; i < s.size(); ++i) {
      const std::size_t k = cell.mixed[i];
      const bool at_upper = turned(s[i][along], signs[k]).is_positive();  // is s_k·g_k largest
      empty = empty || is_nonpositive(turned((at_upper == upwards ? end : begin).range[k], signs[k]));
    }
    if (empty || holds) {
      arc.add(at_begin == Part::connected, !empty);
      return true;
    }
  }
  const std::size_t j = (*cell.free)[along];
  const double from = cell.sides[j].lo(), to = cell.sides[j].hi(), cut = from + kShare * (to - from);
  if (depth == 0 || !(from < cut && cut < to)) return false;
  SignCell first = cell, second = cell;
  (upwards ? first : second).sides[j] = Enclosure(from, cut);
  (upwards ? second : first).sides[j] = Enclosure(cut, to);
  return add_segment(std::move(first), along, upwards, signs, depth - 1, arc) &&
         add_segment(std::move(second), along, upwards, signs, depth - 1, arc);
}

SignParts::Part SignParts::outflow(const SignCell& cell, const std::vector<std::size_t>& open, const std::vector<int>& signs,
                                   const Direction& d) const {
  constexpr int kHalvings = 10;
  Arc arc;
  // The one face ends at the arc's corner, the other begins there.
  for (std::size_t k = 0; k < 2; ++k) {
    const double out = d[open[k]], other = d[open[1 - k]];
    if (out == 0) continue;
    const bool upwards = (other >= 0) == (k == 0);
    if (!add_segment(face(cell, open[k], out > 0, 1), open[1 - k], upwards, signs, kHalvings, arc)) return Part::unknown;
  }
  return arc.intervals == 0 ? Part::empty : arc.intervals == 1 ? Part::connected : Part::unknown;
}

SignParts::Part SignParts::part(const SignCell& cell, std::vector<std::size_t> open, const std::vector<int>& signs,
                                const std::vector<Direction>& directions) const {
  constexpr int kTries = 3, kHalvings = 10;
  if (const Part all = whole(cell, signs); all != Part::unknown || open.empty()) return all;
  if (open.size() == 1) {
    Arc arc;
    if (!add_segment(cell, open.front(), true, signs, kHalvings, arc)) return Part::unknown;
    return arc.intervals == 0 ? Part::empty : arc.intervals == 1 ? Part::connected : Part::unknown;
  }
  Slopes s;
  if (!slopes(cell, s)) return Part::unknown;
  int tries = kTries;
  for (const Direction& d : directions) {
    std::vector<std::size_t> used;
    for (std::size_t f = 0; f < d.size(); ++f)
      if (d[f] != 0) used.push_back(f);
    if (!std::includes(open.begin(), open.end(), used.begin(), used.end()) || !grows(cell, s, d, signs)) continue;
    if (open.size() == 2) {
      if (const Part p = outflow(cell, open, signs, d); p != Part::unknown) return p;
      if (--tries == 0) break;
    } else if (used.size() == 1) {
      open.erase(std::ranges::find(open, used.front()));
      return part(face(cell, used.front(), d[used.front()] > 0, 1), std::move(open), signs, directions);
    }
  }
  return Part::unknown;
}

SignParts::Part SignParts::part(const SignCell& cell, const std::vector<int>& signs,
                                const std::vector<Direction>& directions) const {
  std::vector<std::size_t> open(cell.free->size());
  std::iota(open.begin(), open.end(), std::size_t{0});
  return part(cell, std::move(open), signs, directions);
}

SignParts::Directions SignParts::passages(const SignCell& cell, const std::vector<int>& signs,
                                          const std::vector<Direction>& directions) const {
  Directions result;
  Slopes s;
  if (!slopes(cell, s)) return result;
  for (std::size_t k = 0; k < directions.size() && k < kMostDirections; ++k)
    result[k] = grows(cell, s, directions[k], signs);
  return result;
}

// Along the shortest direction in which, at the middle and to first order, all grow alike: Gᵀ (G Gᵀ)⁻¹ 1, where the rows of
// G are the gradients of length 1; or along a usual direction.
bool SignParts::grow_together(SignCell cell, std::vector<std::size_t> functions, const std::vector<int>& signs) const {
  problem_.stop().poll();
  cell.mixed = std::move(functions);
  Slopes s;
  if (!slopes(cell, s)) return false;
  const std::size_t r = s.size(), n = cell.free->size();
  Eigen::MatrixXd g(r, n);
  for (std::size_t k = 0; k < r; ++k) {
    for (std::size_t f = 0; f < n; ++f) g(k, f) = s[k][f].mid();
    g.row(k) *= signs[cell.mixed[k]] / g.row(k).norm();
  }
  const Eigen::VectorXd d = g.transpose() * (inverse(g * g.transpose()) * Eigen::VectorXd::Ones(g.rows()));
  const auto all_grow = [&](const Direction& along) { return grows(cell, s, along, signs); };
  if (d.allFinite() && all_grow({d.begin(), d.end()})) return true;
  Direction widths;
  for (const int f : *cell.free) widths.push_back(cell.sides[f].width());
  return std::ranges::any_of(directions(widths), all_grow);
}

std::vector<SignParts::Direction> SignParts::directions(const std::vector<double>& widths) {
  std::vector<Direction> result;
  const auto add = [&](Direction d) {
    result.push_back(d);
    for (double& x : d) x = -x;
    result.push_back(std::move(d));
  };
  for (std::size_t a = 0; a < widths.size(); ++a) {
    Direction d(widths.size(), 0.0);
    d[a] = widths[a];
    add(d);
    for (std::size_t b = 0; b < a; ++b)
      for (const double share : {-4.0, -2.0, -1.0, -0.5, -0.25, 0.25, 0.5, 1.0, 2.0, 4.0}) {
        d[b] = share * widths[b];
        add(d);
        d[b] = 0;
      }
  }
  for (int signs = 0; widths.size() == 3 && signs < 4; ++signs)
    for (const double share : {1.0, 0.4})
      add({widths[0], ((signs & 1) != 0 ? share : -share) * widths[1], ((signs & 2) != 0 ? share : -share) * widths[2]});
  if (result.size() > kMostDirections) result.resize(kMostDirections);
  return result;
}

}  // namespace corank::check
