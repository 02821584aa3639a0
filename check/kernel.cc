#include "corank/check/kernel.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "corank/check/krawczyk.h"
#include "corank/core/dense.h"

namespace corank::check {
namespace {

// Rows and columns in turn divided by the roots of their largest entries. `sizes`: those of the entries in a whole box,
// since a column that is 0 in its middle but for roundings is to stay small.
Eigen::MatrixXd balanced(Eigen::MatrixXd a, Eigen::MatrixXd sizes) {
  constexpr int kTurns = 8;
  const auto divide = [](auto line, auto sizes_of_line) {
    const double largest = sizes_of_line.maxCoeff();
    if (!(largest > 0)) return;
    line /= std::sqrt(largest);
    sizes_of_line /= std::sqrt(largest);
  };
  for (int turn = 0; turn < kTurns && a.size() > 0; ++turn) {
    for (Eigen::Index i = 0; i < a.rows(); ++i) divide(a.row(i), sizes.row(i));
    for (Eigen::Index j = 0; j < a.cols(); ++j) divide(a.col(j), sizes.col(j));
  }
  return a;
}

constexpr int kMostKernelParts = 2000;

}  // namespace

PolynomialMatrix kernel_matrix(const System& system) {
  if (system.singular) return *system.singular;
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
  Eigen::MatrixXd matrix(std::ssize(rows_), columns_), sizes = matrix;
  for (std::size_t i = 0; i < rows_.size(); ++i)
    for (std::size_t j = 0; j < rows_[i].size(); ++j) {
      matrix(i, j) = rows_[i][j].approximate(middle);
      sizes(i, j) = entries[i][j].mag();
    }
  const auto [rows, columns] = pivots(balanced(matrix, std::move(sizes)), s);  // whatever the units of its entries
  if (rows.size() < s) return false;
  const Eigen::MatrixXd y = inverse(matrix(rows, columns));
  if (!y.allFinite()) return false;
  Eigen::MatrixXd excess = y;
  for (std::size_t a = 0; a < s; ++a)
    for (std::size_t j = 0; j < s; ++j) {
      Enclosure entry(a == j ? -1.0 : 0.0);
      for (std::size_t b = 0; b < s; ++b) entry.add_product(y(a, b), entries[rows[b]][columns[j]]);
      excess(a, j) = entry.mag();
    }
  return is_contraction(excess);
}

bool KernelCheck::is_at_most(int most, const Box& box) const {
  if (most >= columns_) return true;
  const std::size_t rank = columns_ - std::max(most, 0);
  return shown_in_parts(Sides(box.begin(), box.end()), arguments_, lengths_, kMostKernelParts, stop_,
                        [&](const Sides& x) { return has_rank(rank, x); });
}

}  // namespace corank::check
