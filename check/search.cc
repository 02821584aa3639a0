#include "corank/check/search.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <iterator>

#include "corank/check/krawczyk.h"
#include "corank/core/dense.h"

namespace corank::check {
namespace {

constexpr int kPasses = 6;
constexpr double kGain = 0.2;
constexpr double kRankTolerance = 1e-9;

double total_width(const Sides& x) {
  double sum = 0;
  for (const Enclosure& side : x) sum += std::log(side.width() + 1e-300);
  return sum;
}

}  // namespace

bool Search::project(Sides& x, int row) const {
  const auto m = static_cast<int>(problem_.equations().size());
  if (row < 0) return problem_.implied()[-1 - row].project(x, true);
  if (row < m) return problem_.equations()[row].project(x, true);
  return std::ranges::all_of(problem_.conditions(), [&](const Condition& c) { return c.row.project(x, false); });
}

bool Search::newton(Sides& x, const LinearCombination& p, const std::vector<double>& center) {
  const std::size_t r = p.dependent.size(), n = x.size();
  const Sides c(center.begin(), center.end());
  std::vector<Sides> slopes(r);
  Sides residual(r), at_center;
  for (std::size_t b = 0; b < r; ++b) {
    const Row& f = problem_.equations()[p.equations[b]];
    f.slopes(x, c, slopes[b]);
    at_center.push_back(f.value(c));
  }
  std::vector<Sides> products;
  Sides sums;  // Y·F(c)
  for (std::size_t a = 0; a < r; ++a) {
    Sides product(n);
    Enclosure sum;
    for (std::size_t b = 0; b < r; ++b) {
      const double y = p.y(a, b);
      if (y == 0) continue;
      sum.add_product(y, at_center[b]);
      const auto& columns = problem_.equations()[p.equations[b]].columns();
      for (std::size_t k = 0; k < columns.size(); ++k) product[columns[k]].add_product(y, slopes[b][k]);
    }
    products.push_back(std::move(product));
    sums.push_back(std::move(sum));
  }
  // Row a, solved for x_v. False: it has no solution.
  const auto solve_for = [&](std::size_t a, std::size_t v) {
    Enclosure sum = sums[a];
    for (std::size_t j = 0; j < n; ++j)
      if (j != v && !products[a][j].is_zero()) sum.add_product(products[a][j], x[j] - c[j]);
    const auto shift = divide(-sum, products[a][v], x[v] - c[v]);
    return shift && x[v].intersect(c[v] + *shift);
  };
  std::vector<bool> is_free(n, true);
  for (std::size_t a = 0; a < r; ++a) {
    const std::size_t d = p.dependent[a];
    is_free[d] = false;
    if (!solve_for(a, d)) return false;
  }
  for (std::size_t v = 0; v < n; ++v)
    for (std::size_t a = 0; a < r && is_free[v]; ++a)
      if (!products[a][v].is_zero() && !solve_for(a, v)) return false;
  return true;
}

bool Search::own_combination(const Sides& x, LinearCombination& p, std::vector<double>& center) {
  const std::size_t n = x.size();
  center.resize(n);
  for (std::size_t j = 0; j < n; ++j) center[j] = x[j].mid();
  const Eigen::MatrixXd jacobian = approximate_jacobian(problem_.equations(), center);
  Eigen::MatrixXd scaled = jacobian;
  for (std::size_t j = 0; j < n; ++j)  // what the others are solved for
    if (problem_.system().variables[problem_.kept()[j]].is_parameter()) scaled.col(j).setZero();
  for (auto row : scaled.rowwise()) row /= std::max(1e-300, row.lpNorm<Eigen::Infinity>());
  const Pivots chosen = pivots(std::move(scaled), std::min(problem_.equations().size(), n), kRankTolerance);
  p = {chosen.rows, chosen.columns, inverse(jacobian(chosen.rows, chosen.columns))};
  if (p.dependent.empty() || !p.y.allFinite()) return false;
  drop_noise(p.y);
  return true;
}

bool Search::contract(Sides& x) {
  LinearCombination p;
  std::vector<double> center;
  for (int pass = 0; pass < kPasses; ++pass) {
    problem_.stop().poll();
    const double before = total_width(x);
    for (int row = 0; row <= static_cast<int>(problem_.equations().size()); ++row)
      if (!project(x, row)) return false;
    for (int k = 0; k < static_cast<int>(problem_.implied().size()); ++k)
      if (!project(x, -1 - k)) return false;
    if (own_combination(x, p, center) && !newton(x, p, center)) return false;
    if (total_width(x) > before - kGain) break;
  }
  return true;
}

int Search::widest(const Sides& x) const {
  std::vector<double> weight(x.size(), 0.0);
  Sides entries;
  for (const Row& f : problem_.equations()) {
    f.derivatives(x, entries);
    for (std::size_t k = 0; k < entries.size(); ++k) {
      double& w = weight[f.columns()[k]];
      w = std::max(w, entries[k].mag());
    }
  }
  int best = -1;
  double most = 0;
  for (std::size_t j = 0; j < x.size(); ++j) {
    const double width = x[j].width(), middle = x[j].mid();
    if (!(x[j].lo() < middle && middle < x[j].hi())) continue;
    if (const double size = width * std::max(weight[j], 1e-6); size > most) most = size, best = static_cast<int>(j);
  }
  return best;
}

std::optional<std::array<Sides, 2>> Search::halves(const Sides& x) const {
  const int j = widest(x);
  if (j < 0) return std::nullopt;
  const std::size_t v = j;
  const double middle = x[v].lo() + 0.47 * (x[v].hi() - x[v].lo());
  std::array<Sides, 2> parts{x, x};
  if (!parts[0][v].intersect(Enclosure(-kInfinity, middle)) || !parts[1][v].intersect(Enclosure(middle, kInfinity)))
    return std::nullopt;
  return parts;
}

bool Search::is_empty(Sides x, std::size_t most_parts) {
  std::size_t parts = 0;
  const bool shown = has_none_but(
      {std::move(x)}, [](const Sides&) { return false; }, most_parts, parts);
  searched_ += parts > 0;
  return shown;
}

bool Search::has_none_but(std::vector<Sides> open, const Known& known, std::size_t most_parts, std::size_t& parts) {
  const std::size_t last = parts + most_parts;
  while (!open.empty()) {
    Sides x = std::move(open.back());
    open.pop_back();
    if (!contract(x) || known(x)) continue;
    auto both = halves(x);
    if (!both || ++parts > last) return false;
    open.push_back(std::move((*both)[1]));
    open.push_back(std::move((*both)[0]));
  }
  return true;
}

std::vector<Sides> Search::sift(std::vector<Sides> open, const Known& narrow, std::size_t most_parts, std::size_t& parts) {
  const std::size_t last = parts + most_parts;
  std::deque<Sides> waiting(std::make_move_iterator(open.begin()), std::make_move_iterator(open.end()));
  open.clear();
  while (!waiting.empty()) {
    Sides x = std::move(waiting.front());
    waiting.pop_front();
    if (!contract(x)) continue;
    auto both = parts < last && !narrow(x) ? halves(x) : std::nullopt;
    if (!both) {
      open.push_back(std::move(x));
      continue;
    }
    ++parts;
    for (Sides& part : *both) waiting.push_back(std::move(part));
  }
  return open;
}

bool Search::confine(Sides& x, const std::vector<Interval>& bounds, bool& empty) {
  empty = false;
  const auto within = [&] {
    for (std::size_t j = 0; j < x.size(); ++j)
      if (!x[j].inside(bounds[j])) return false;
    return true;
  };
  if (within()) return true;
  if (!contract(x)) return empty = true;
  for (std::size_t j = 0; j < x.size(); ++j) {
    if (x[j].inside(bounds[j])) continue;
    for (const Enclosure& beyond : {Enclosure(-kInfinity, bounds[j].lo()), Enclosure(bounds[j].hi(), kInfinity)}) {
      Sides slab = x;
      // What lies on the bound lies between the bounds.
      if (!slab[j].intersect(beyond) || slab[j].inside(bounds[j])) continue;
      if (!is_empty(std::move(slab))) return false;
    }
    if (!x[j].intersect(Enclosure(bounds[j]))) return empty = true;
  }
  return true;
}

}  // namespace corank::check
