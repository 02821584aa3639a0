#include "corank/solve/reduction/product_elimination.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "corank/certify/polynomial_algebra.h"

namespace corank::solve {
namespace {

bool is_linear(const Monomial& m) { return m.degree() <= 1 && !m.is_trigonometric(); }

double size_of(const Monomial& m, const std::vector<double>& sizes) {
  double size = 1;
  for (const Factor& x : m.factors)
    if (x.function == Function::identity) size *= std::pow(sizes[x.variable], x.power);
  return size;
}

// A group of equations as a matrix of doubles: a row for each, a column for each product, scaled by its size.
class Tableau {
 public:
  Tableau(const std::vector<Polynomial>& rows, std::vector<std::size_t> members, const std::vector<double>& sizes)
      : members_(std::move(members)) {
    std::map<Factors, std::size_t> columns;
    for (const std::size_t i : members_)
      for (const Monomial& m : rows[i].monomials)
        if (columns.try_emplace(m.factors, columns.size()).second) {
          linear_.push_back(is_linear(m));
          sizes_.push_back(size_of(m, sizes));
        }
    n_ = columns.size();
    entries_.assign(members_.size() * n_, 0.0);
    magnitude_ = entries_;
    for (std::size_t k = 0; k < members_.size(); ++k)
      for (const Monomial& m : rows[members_[k]].monomials) {
        const std::size_t j = columns[m.factors];
        at(k, j) = m.enclosure.mid() * sizes_[j];
        magnitude_[k * n_ + j] = std::fabs(at(k, j));
      }
    for (std::size_t k = 0; k < members_.size(); ++k) largest_.push_back(largest_entry(k));
  }

  // Makes every linear column, or every other, one row's alone where it can.
  void eliminate(bool linear, const std::function<void()>& check) {
    std::vector<bool> used(members_.size(), false), taken(n_, false);
    if (linear)  // by rows that have nothing else
      for (std::size_t k = 0; k < members_.size(); ++k)
        for (std::size_t j = 0; j < n_; ++j) used[k] = used[k] || (!linear_[j] && counts(k, j));
    for (;;) {
      check();
      double best = 0;
      std::size_t row = 0, column = 0;
      for (std::size_t k = 0; k < members_.size(); ++k) {
        if (used[k]) continue;
        const double scale = largest(k);
        for (std::size_t j = 0; j < n_; ++j) {
          if (linear_[j] != linear || taken[j] || !is_pivot(k, j)) continue;
          const double size = std::fabs(at(k, j)) / scale;
          if (size > (1 + kTie) * best) best = size, row = k, column = j;
        }
      }
      if (best == 0) return;
      used[row] = taken[column] = true;
      for (std::size_t k = 0; k < members_.size(); ++k)
        if (k != row && counts(k, column) && is_moderate(k, row, column)) add(k, row, column);
    }
  }

  // Adds a multiple of a row to another where that leaves fewer terms, the best such pair first, as long as there is one.
  void shorten(const std::function<void()>& check) {
    for (std::size_t former = weight() + 1; weight() < former;) {
      former = weight();
      std::ptrdiff_t best = 0;
      std::size_t row = 0, other = 0, column = 0;
      std::vector<std::size_t> counted;
      for (std::size_t k = 0; k < members_.size(); ++k) {
        counted.clear();
        for (std::size_t j = 0; j < n_; ++j)
          if (counts(k, j)) counted.push_back(j);
        check();
        for (std::size_t i = 0; i < members_.size(); ++i) {
          if (i == k) continue;
          for (const std::size_t j : counted) {
            if (!is_pivot(i, j)) continue;
            const std::ptrdiff_t saved = saved_by(k, i, j);
            if (saved > best && is_moderate(k, i, j)) best = saved, row = k, other = i, column = j;
          }
        }
      }
      if (best == 0) return;
      add(row, other, column);
    }
  }

  // Terms that count, products more than linear ones.
  std::size_t weight() const {
    std::size_t sum = 0;
    for (std::size_t k = 0; k < members_.size(); ++k)
      for (std::size_t j = 0; j < n_; ++j) sum += counts(k, j) ? (linear_[j] ? 1 : kProductWeight) : 0;
    return sum;
  }

  // What the rows cost a projection: Σ |term| / the row's largest, products more than linear ones: a row bounds a
  // variable the better the less its other terms contribute.
  double cost() const {
    double sum = 0;
    for (std::size_t k = 0; k < members_.size(); ++k) {
      const double scale = largest(k);
      for (std::size_t j = 0; j < n_; ++j)
        if (counts(k, j)) sum += std::fabs(at(k, j)) / scale * (linear_[j] ? 1 : kProductWeight);
    }
    return sum;
  }

  const std::vector<RowSum>& sums() const { return sums_; }

 private:
  static constexpr double kTie = 1e-9;         // of two pivots as large the first, whatever rounding says
  static constexpr double kLeastPivot = 1e-3;  // of its row's largest entry, and of what was added up to it
  static constexpr double kLargestPart = 1e3;  // of a row's largest entry: as large a part of another may be added to it
  static constexpr std::size_t kProductWeight = 4;

  double& at(std::size_t k, std::size_t j) { return entries_[k * n_ + j]; }
  double at(std::size_t k, std::size_t j) const { return entries_[k * n_ + j]; }
  double largest(std::size_t k) const { return largest_[k]; }
  double largest_entry(std::size_t k) const {
    double size = 0;
    for (std::size_t j = 0; j < n_; ++j) size = std::max(size, std::fabs(at(k, j)));
    return size;
  }
  bool counts(std::size_t k, std::size_t j) const {
    return std::fabs(at(k, j)) > kResidue * std::max(magnitude_[k * n_ + j], largest(k));
  }
  bool is_pivot(std::size_t k, std::size_t j) const {
    return std::fabs(at(k, j)) > kLeastPivot * std::max(magnitude_[k * n_ + j], largest(k));
  }
  bool is_moderate(std::size_t k, std::size_t row, std::size_t column) const {
    return std::fabs(at(k, column) / at(row, column)) * largest(row) <= kLargestPart * largest(k);
  }
  // How much less row k weighs when a multiple of row i has taken its column j away.
  std::ptrdiff_t saved_by(std::size_t k, std::size_t i, std::size_t j) const {
    const double factor = -at(k, j) / at(i, j);
    const double least = kResidue * std::max(largest(k), std::fabs(factor) * largest(i));
    std::ptrdiff_t saved = 0;
    for (std::size_t c = 0; c < n_; ++c) {
      const bool before = counts(k, c);
      const double sum = at(k, c) + factor * at(i, c);
      const bool after = c != j && std::fabs(sum) > least && std::fabs(sum) > kResidue * std::fabs(factor * at(i, c));
      saved += (static_cast<std::ptrdiff_t>(before) - static_cast<std::ptrdiff_t>(after)) *
               static_cast<std::ptrdiff_t>(linear_[c] ? 1 : kProductWeight);
    }
    return saved;
  }
  void add(std::size_t k, std::size_t row, std::size_t column) {
    const double factor = -at(k, column) / at(row, column);
    for (std::size_t j = 0; j < n_; ++j) {
      const double part = factor * at(row, j);
      at(k, j) += part;
      magnitude_[k * n_ + j] = std::max(magnitude_[k * n_ + j], std::fabs(part));
    }
    at(k, column) = 0;
    largest_[k] = largest_entry(k);
    sums_.push_back({members_[k], members_[row], ExactNumber::dyadic(factor)});
  }

  std::vector<std::size_t> members_;
  std::size_t n_ = 0;
  std::vector<bool> linear_;
  std::vector<double> sizes_, entries_, magnitude_;  // magnitude_: the largest that ever was added there
  std::vector<double> largest_;                      // of each row, in absolute value
  std::vector<RowSum> sums_;
};

// The groups of rows that share products, or that have none and share variables; each ascending. Rows that share nothing are
// in no group.
std::vector<std::vector<std::size_t>> groups_of(const std::vector<Polynomial>& rows) {
  std::vector<std::size_t> parent(rows.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&](std::size_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  std::map<Factors, std::size_t> first;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const bool all_linear = std::ranges::all_of(rows[i].monomials, is_linear);
    for (const Monomial& m : rows[i].monomials)
      if (is_linear(m) == all_linear && !m.factors.empty()) {
        const auto [known, is_new] = first.try_emplace(m.factors, i);
        if (!is_new) parent[root(i)] = root(known->second);
      }
  }
  std::map<std::size_t, std::vector<std::size_t>> by_root;
  for (std::size_t i = 0; i < rows.size(); ++i) by_root[root(i)].push_back(i);
  std::vector<std::vector<std::size_t>> groups;
  for (auto& [r, members] : by_root)
    if (members.size() > 1) groups.push_back(std::move(members));
  return groups;
}

}  // namespace

std::vector<RowSum> eliminate_products(const std::vector<Polynomial>& rows, const std::vector<double>& sizes,
                                       const std::function<void()>& check) {
  std::vector<RowSum> sums;
  for (std::vector<std::size_t>& members : groups_of(rows)) {
    check();
    Tableau tableau(rows, std::move(members), sizes);
    Tableau pairs = tableau, products = tableau;
    pairs.shorten(check);
    products.eliminate(false, check);
    Tableau linear = products;
    linear.eliminate(true, check);
    products.shorten(check);
    linear.shorten(check);
    const Tableau* best = &tableau;
    for (const Tableau* other : {&pairs, &products, &linear})
      if (other->weight() < tableau.weight() && other->cost() < best->cost()) best = other;
    sums.insert(sums.end(), best->sums().begin(), best->sums().end());
  }
  return sums;
}

Polynomial without_residues(const Polynomial& row, const std::vector<double>& sizes) {
  double largest = 0;
  for (const Monomial& m : row.monomials) largest = std::max(largest, m.enclosure.mag() * size_of(m, sizes));
  Polynomial result{{}, row.source};
  for (const Monomial& m : row.monomials)
    if (m.enclosure.mag() * size_of(m, sizes) > kResidue * largest) result.monomials.push_back(m);
  return result;
}

}  // namespace corank::solve
