#include "corank/check/kernel.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "corank/check/krawczyk.h"

namespace corank::check {
namespace {

// Rows and columns in turn divided by the roots of their largest entries. `sizes`: those of the entries in a whole box,
// since a column that is 0 in its middle but for roundings is to stay small.
std::vector<std::vector<double>> balanced(std::vector<std::vector<double>> a, std::vector<std::vector<double>> sizes) {
  constexpr int kTurns = 8;
  const std::size_t columns = a.empty() ? 0 : a[0].size();
  const auto divide = [&](std::size_t count, const auto& place) {
    double largest = 0;
    for (std::size_t k = 0; k < count; ++k) {
      const auto [i, j] = place(k);
      largest = std::max(largest, sizes[i][j]);
    }
    for (std::size_t k = 0; largest > 0 && k < count; ++k) {
      const auto [i, j] = place(k);
      sizes[i][j] /= std::sqrt(largest);
      a[i][j] /= std::sqrt(largest);
    }
  };
  for (int turn = 0; turn < kTurns; ++turn) {
    for (std::size_t i = 0; i < a.size(); ++i) divide(columns, [i](std::size_t j) { return std::pair(i, j); });
    for (std::size_t j = 0; j < columns; ++j) divide(a.size(), [j](std::size_t i) { return std::pair(i, j); });
  }
  return a;
}

constexpr int kMostKernelParts = 2000;

}  // namespace

PolynomialMatrix kernel_matrix(const System& system) {
  const auto is_kernel = [&](int j) { return system.variables[j].kind == VariableKind::kernel; };
  const auto of_kernel = [&](const Factor& x) { return is_kernel(x.variable); };
  std::vector<int> unknowns;
  for (int j = 0; j < system.size(); ++j)
    if (is_kernel(j)) unknowns.push_back(j);
  unknowns.resize(unknowns.size() / system.kernel_vectors);  // those of one vector
  PolynomialMatrix matrix{0, static_cast<int>(unknowns.size()), {}};
  for (const Polynomial& f : system.equations) {
    std::vector<Polynomial> row(matrix.columns);
    bool linear = !f.monomials.empty();
    for (const Monomial& m : f.monomials) {
      linear = linear && std::ranges::count_if(m.factors, of_kernel) == 1;
      if (!linear) break;
      const auto unknown = std::ranges::find_if(m.factors, of_kernel);
      const auto column = std::ranges::find(unknowns, unknown->variable) - unknowns.begin();
      linear = unknown->power == 1 && unknown->function == Function::identity && column < matrix.columns;
      if (!linear) break;
      Monomial rest = m;
      rest.factors.erase(rest.factors.begin() + (unknown - m.factors.begin()));
      row[column].monomials.push_back(std::move(rest));
    }
    if (!linear) continue;
    ++matrix.rows;
    matrix.entries.insert(matrix.entries.end(), row.begin(), row.end());
  }
  return matrix;
}

KernelCheck::KernelCheck(const System& system, const PolynomialMatrix& matrix, const StopFlag& stop, double tolerance)
    : stop_(stop),
      columns_(matrix.columns),
      rows_(entries_of(matrix, system.size(), tolerance)),
      arguments_(variables_of(rows_)),
      lengths_(domain_lengths(system)) {}

bool KernelCheck::has_rank(std::size_t s, const Sides& x) const {
  if (s == 0) return true;
  std::vector<double> middle;
  for (const Enclosure& side : x) middle.push_back(side.mid());
  const std::vector<Sides> entries = values(rows_, x);
  std::vector<std::vector<double>> matrix(rows_.size()), sizes(rows_.size());
  for (std::size_t i = 0; i < rows_.size(); ++i)
    for (std::size_t j = 0; j < rows_[i].size(); ++j) {
      matrix[i].push_back(rows_[i][j].approximate(middle));
      sizes[i].push_back(entries[i][j].mag());
    }
  const auto [rows, columns] = pivots(balanced(matrix, std::move(sizes)), s);  // whatever the units of its entries
  if (rows.size() < s) return false;
  std::vector<double> minor;
  for (const std::size_t i : rows)
    for (const std::size_t j : columns) minor.push_back(matrix[i][j]);
  const std::vector<double> y = inverse(minor, s);
  if (y.size() != s * s) return false;
  std::vector<double> excess;
  for (std::size_t a = 0; a < s; ++a)
    for (std::size_t j = 0; j < s; ++j) {
      Enclosure entry(a == j ? -1.0 : 0.0);
      for (std::size_t b = 0; b < s; ++b) entry.add_product(y[a * s + b], entries[rows[b]][columns[j]]);
      excess.push_back(entry.mag());
    }
  return is_contraction(excess, s);
}

bool KernelCheck::is_at_most(int most, const Box& box) const {
  if (most >= columns_) return true;
  const std::size_t rank = columns_ - std::max(most, 0);
  return shown_in_parts(Sides(box.begin(), box.end()), arguments_, lengths_, kMostKernelParts, stop_,
                        [&](const Sides& x) { return has_rank(rank, x); });
}

}  // namespace corank::check
