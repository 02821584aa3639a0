#include "corank/check/kernel.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "corank/check/krawczyk.h"

namespace corank::check {
namespace {

// Rows and columns in turn divided by the roots of their largest entries. `sizes`: those of the entries in a whole box,
// since a column that is 0 in its middle but for roundings is to stay small.
std::vector<double> balanced(std::vector<double> a, std::vector<double> sizes, std::size_t m, std::size_t k) {
  constexpr int kTurns = 8;
  const auto divide = [&](std::size_t first, std::size_t step, std::size_t count) {
    double largest = 0;
    for (std::size_t i = 0; i < count; ++i) largest = std::max(largest, sizes[first + i * step]);
    for (std::size_t i = 0; largest > 0 && i < count; ++i) {
      sizes[first + i * step] /= std::sqrt(largest);
      a[first + i * step] /= std::sqrt(largest);
    }
  };
  for (int turn = 0; turn < kTurns; ++turn) {
    for (std::size_t i = 0; i < m; ++i) divide(i * k, 1, k);
    for (std::size_t j = 0; j < k; ++j) divide(j, k, m);
  }
  return a;
}

constexpr int kMostParts = 2000;

}  // namespace

KernelCheck::KernelCheck(const System& system, const StopFlag& stop) : stop_(stop) {
  std::vector<int> column(system.variables.size(), -1), identity(system.variables.size());
  std::iota(identity.begin(), identity.end(), 0);
  const auto of_kernel = [&](int j) { return system.variables[static_cast<std::size_t>(j)].kind == VariableKind::kernel; };
  for (int j = 0; j < system.size(); ++j) columns_ += of_kernel(j);
  columns_ /= system.kernel_vectors;
  for (int j = 0, k = 0; j < system.size() && k < columns_; ++j)
    if (of_kernel(j)) column[static_cast<std::size_t>(j)] = k++;
  for (const Polynomial& f : system.equations) {
    std::vector<Polynomial> entries(static_cast<std::size_t>(columns_));
    bool linear = !f.monomials.empty();
    for (const Monomial& m : f.monomials) {
      const auto is_kernel = [&](const Factor& x) { return of_kernel(x.variable); };
      linear = linear && std::count_if(m.factors.begin(), m.factors.end(), is_kernel) == 1;
      if (!linear) break;
      const auto unknown = std::find_if(m.factors.begin(), m.factors.end(), is_kernel);
      linear = unknown->power == 1 && unknown->function == Function::identity &&
               column[static_cast<std::size_t>(unknown->variable)] >= 0;
      if (!linear) break;
      Monomial rest = m;
      rest.factors.erase(rest.factors.begin() + (unknown - m.factors.begin()));
      for (const Factor& x : rest.factors) arguments_.push_back(x.variable);
      entries[static_cast<std::size_t>(column[static_cast<std::size_t>(unknown->variable)])].monomials.push_back(
          std::move(rest));
    }
    if (!linear) continue;
    rows_.emplace_back();
    for (const Polynomial& entry : entries) rows_.back().emplace_back(Terms(entry, system.coefficient_tolerance), identity);
  }
  settle(system);
}

KernelCheck::KernelCheck(const System& system, const PolynomialMatrix& matrix, const StopFlag& stop)
    : stop_(stop), columns_(matrix.columns) {
  std::vector<int> identity(system.variables.size());
  std::iota(identity.begin(), identity.end(), 0);
  for (std::size_t k = 0; k < matrix.entries.size(); ++k) {
    if (k % static_cast<std::size_t>(columns_) == 0) rows_.emplace_back();
    rows_.back().emplace_back(Terms(matrix.entries[k], 0), identity);
    for (const Monomial& m : matrix.entries[k].monomials)
      for (const Factor& x : m.factors) arguments_.push_back(x.variable);
  }
  settle(system);
}

void KernelCheck::settle(const System& system) {
  lengths_ = domain_lengths(system);
  std::sort(arguments_.begin(), arguments_.end());
  arguments_.erase(std::unique(arguments_.begin(), arguments_.end()), arguments_.end());
}

bool KernelCheck::has_rank(std::size_t s, const Sides& x) const {
  const std::size_t m = rows_.size(), k = static_cast<std::size_t>(columns_);
  if (s == 0) return true;
  if (s > std::min(m, k)) return false;
  std::vector<double> middle;
  for (const Enclosure& side : x) middle.push_back(side.mid());
  std::vector<double> matrix, sizes;
  Sides entries;
  for (const std::vector<Row>& row : rows_)
    for (const Row& entry : row) {
      matrix.push_back(entry.approximate(middle));
      entries.push_back(entry.value(x));
      sizes.push_back(entries.back().mag());
    }
  // Complete pivoting picks the submatrix, whatever the units of its entries.
  std::vector<double> t = balanced(matrix, sizes, m, k);
  std::vector<std::size_t> rows, columns;
  for (std::size_t step = 0; step < s; ++step) {
    std::size_t row = m, column = k;
    double best = 0;
    for (std::size_t i = 0; i < m; ++i)
      for (std::size_t j = 0; j < k; ++j) {
        if (std::find(rows.begin(), rows.end(), i) != rows.end()) continue;
        if (std::find(columns.begin(), columns.end(), j) != columns.end()) continue;
        if (std::fabs(t[i * k + j]) > best) best = std::fabs(t[i * k + j]), row = i, column = j;
      }
    if (row == m) return false;
    for (std::size_t i = 0; i < m; ++i) {
      const double factor = t[i * k + column] / t[row * k + column];
      if (i == row || std::find(rows.begin(), rows.end(), i) != rows.end()) continue;
      for (std::size_t j = 0; j < k; ++j) t[i * k + j] -= factor * t[row * k + j];
    }
    rows.push_back(row);
    columns.push_back(column);
  }
  std::vector<double> minor;
  for (const std::size_t i : rows)
    for (const std::size_t j : columns) minor.push_back(matrix[i * k + j]);
  const std::vector<double> y = inverse(minor, s);
  if (y.size() != s * s) return false;
  std::vector<double> excess;
  for (std::size_t a = 0; a < s; ++a)
    for (std::size_t j = 0; j < s; ++j) {
      Enclosure entry(a == j ? -1.0 : 0.0);
      for (std::size_t b = 0; b < s; ++b) entry.add_product(y[a * s + b], entries[rows[b] * k + columns[j]]);
      excess.push_back(entry.mag());
    }
  return is_contraction(excess, s);
}

bool KernelCheck::is_at_most(int most, const Box& box) const {
  if (most >= columns_) return true;
  Sides whole;
  for (const Interval& side : box) whole.emplace_back(side);
  std::vector<Sides> open{std::move(whole)};
  for (int parts = 0; !open.empty(); ++parts) {
    stop_.poll();
    Sides x = std::move(open.back());
    open.pop_back();
    if (has_rank(static_cast<std::size_t>(columns_ - std::max(most, 0)), x)) continue;
    std::size_t widest = x.size();
    double width = 0;
    for (const int j : arguments_)
      if (const Enclosure& side = x[static_cast<std::size_t>(j)];
          side.width() > width * lengths_[static_cast<std::size_t>(j)] && side.lo() < side.mid() && side.mid() < side.hi())
        width = side.width() / lengths_[static_cast<std::size_t>(j)], widest = static_cast<std::size_t>(j);
    if (widest == x.size() || parts > kMostParts) return false;
    const double from = x[widest].lo(), middle = x[widest].mid(), to = x[widest].hi();
    open.push_back(x);
    open.back()[widest] = Enclosure(middle, to);
    open.push_back(std::move(x));
    open.back()[widest] = Enclosure(from, middle);
  }
  return true;
}

}  // namespace corank::check
