#include "corank/certify/checker/krawczyk.h"

#include <algorithm>
#include <cmath>

namespace corank::certify::checker {
namespace {

// The inverse of a row-major r×r matrix by Gauss–Jordan with partial pivoting; empty where it is singular to double precision.
std::vector<double> inverse(std::vector<double> a, std::size_t r) {
  std::vector<double> b(r * r, 0.0);
  for (std::size_t i = 0; i < r; ++i) b[i * r + i] = 1;
  for (std::size_t k = 0; k < r; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < r; ++i)
      if (std::fabs(a[i * r + k]) > std::fabs(a[pivot * r + k])) pivot = i;
    if (!(std::fabs(a[pivot * r + k]) > 0)) return {};
    for (std::size_t j = 0; j < r; ++j) {
      std::swap(a[k * r + j], a[pivot * r + j]);
      std::swap(b[k * r + j], b[pivot * r + j]);
    }
    const double scale = 1 / a[k * r + k];
    for (std::size_t j = 0; j < r; ++j) a[k * r + j] *= scale, b[k * r + j] *= scale;
    for (std::size_t i = 0; i < r; ++i) {
      const double factor = a[i * r + k];
      if (i == k || factor == 0) continue;
      for (std::size_t j = 0; j < r; ++j) a[i * r + j] -= factor * a[k * r + j], b[i * r + j] -= factor * b[k * r + j];
    }
  }
  const bool finite = std::all_of(b.begin(), b.end(), [](double x) { return std::isfinite(x); });
  return finite ? b : std::vector<double>();
}

}  // namespace

Krawczyk::Krawczyk(const std::vector<Row>& equations, int variables)
    : equations_(equations), n_(variables), entries_(equations.size()) {}

bool Krawczyk::set(const std::vector<int>& dependent, const Sides& x) {
  const std::size_t r = equations_.size();
  if (dependent.size() != r) return false;
  dependent_ = dependent;
  center_.resize(static_cast<std::size_t>(n_));
  for (std::size_t j = 0; j < center_.size(); ++j) center_[j] = x[j].mid();
  std::vector<int> row_of(center_.size(), -1);
  for (std::size_t a = 0; a < r; ++a) row_of[static_cast<std::size_t>(dependent[a])] = static_cast<int>(a);
  std::vector<double> matrix(r * r, 0.0), entries;
  for (std::size_t b = 0; b < r; ++b) {
    equations_[b].approximate(center_, entries);
    for (std::size_t k = 0; k < entries.size(); ++k)
      if (const int a = row_of[static_cast<std::size_t>(equations_[b].columns()[k])]; a >= 0)
        matrix[b * r + static_cast<std::size_t>(a)] = entries[k];
  }
  const std::vector<double> rough = inverse(matrix, r);
  if (rough.size() != r * r) return false;
  center_sides_.assign(center_.begin(), center_.end());
  refine(rough, row_of);
  at_center_.clear();
  for (const Row& f : equations_) at_center_.push_back(f.value(center_sides_));
  residual_.assign(r, Enclosure());
  for (std::size_t a = 0; a < r; ++a)
    for (std::size_t b = 0; b < r; ++b) residual_[a].add_product(y_[a * r + b], at_center_[b]);
  return true;
}

void Krawczyk::refine(const std::vector<double>& rough, const std::vector<int>& row_of) {
  const std::size_t r = equations_.size();
  Sides a(r * r), entries;
  for (std::size_t b = 0; b < r; ++b) {
    equations_[b].derivatives(center_sides_, entries);
    for (std::size_t k = 0; k < entries.size(); ++k)
      if (const int column = row_of[static_cast<std::size_t>(equations_[b].columns()[k])]; column >= 0)
        a[b * r + static_cast<std::size_t>(column)] = entries[k];
  }
  y_.assign(rough.begin(), rough.end());
  constexpr int kSteps = 2;  // 2⁻⁵³ → 2⁻¹⁰⁶ → all bits
  for (int step = 0; step < kSteps; ++step) {
    Sides residual(r * r), next(y_);  // I − A·Y, Y + Y·(I − A·Y)
    for (std::size_t i = 0; i < r; ++i)
      for (std::size_t j = 0; j < r; ++j) {
        if (i == j) residual[i * r + j] = Enclosure(1.0);
        for (std::size_t k = 0; k < r; ++k)
          if (!a[i * r + k].is_zero() && !y_[k * r + j].is_zero()) residual[i * r + j] -= a[i * r + k] * y_[k * r + j];
      }
    for (std::size_t i = 0; i < r; ++i)
      for (std::size_t j = 0; j < r; ++j)
        for (std::size_t k = 0; k < r; ++k)
          if (!y_[i * r + k].is_zero() && !residual[k * r + j].is_zero())
            next[i * r + j].add_product(y_[i * r + k], residual[k * r + j]);
    for (std::size_t i = 0; i < y_.size(); ++i) {
      if (!next[i].is_bounded()) return;
      y_[i] = next[i].lower_end();  // some point: any Y is valid
    }
  }
}

void Krawczyk::multiply(const std::vector<Sides>& rows) {
  const std::size_t r = equations_.size();
  product_.assign(r, Sides(static_cast<std::size_t>(n_)));
  for (std::size_t a = 0; a < r; ++a)
    for (std::size_t b = 0; b < r; ++b) {
      const Enclosure& y = y_[a * r + b];
      if (y.is_zero()) continue;
      for (std::size_t k = 0; k < rows[b].size(); ++k)
        product_[a][static_cast<std::size_t>(equations_[b].columns()[k])].add_product(y, rows[b][k]);
    }
}

Sides Krawczyk::image(const Sides& x) {
  for (std::size_t b = 0; b < equations_.size(); ++b) equations_[b].slopes(x, center_sides_, entries_[b]);
  multiply(entries_);
  Sides image;
  for (std::size_t a = 0; a < dependent_.size(); ++a) {
    Enclosure sum = residual_[a];
    for (std::size_t j = 0; j < x.size(); ++j) {
      const bool own = static_cast<int>(j) == dependent_[a];
      if (!own && product_[a][j].is_zero()) continue;
      sum.add_product(own ? product_[a][j] - Enclosure(1.0) : product_[a][j], x[j] - center_sides_[j]);
    }
    image.push_back(center_sides_[static_cast<std::size_t>(dependent_[a])] - sum);
  }
  return image;
}

bool Krawczyk::is_injective(const Sides& x) {
  constexpr int kCandidates = 8;
  const std::size_t r = dependent_.size();
  for (std::size_t b = 0; b < r; ++b) equations_[b].derivatives(x, entries_[b]);
  multiply(entries_);
  std::vector<double> excess(r * r);  // ≥ |I − Y·J_D|
  for (std::size_t a = 0; a < r; ++a)
    for (std::size_t k = 0; k < r; ++k) {
      const Enclosure& entry = product_[a][static_cast<std::size_t>(dependent_[k])];
      excess[a * r + k] = (Enclosure(a == k ? 1.0 : 0.0) - entry).mag();
    }
  std::vector<double> radius(r, 1.0), next(r);
  for (int candidate = 0; candidate < kCandidates; ++candidate) {
    bool passes = true;
    double largest = 0;
    for (std::size_t a = 0; a < r; ++a) {
      Enclosure sum;
      for (std::size_t k = 0; k < r; ++k) sum.add_product(radius[k], Enclosure(excess[a * r + k]));
      if (!sum.is_bounded()) return false;
      passes = passes && sum.below(Enclosure(radius[a]));
      next[a] = sum.hi();
      largest = std::max(largest, next[a]);
    }
    if (passes) return true;
    for (std::size_t a = 0; a < r; ++a) radius[a] = next[a] / largest + 0.05;
  }
  return false;
}

bool Krawczyk::center_is_zero() const {
  return std::all_of(at_center_.begin(), at_center_.end(), [](const Enclosure& f) { return f.is_zero(); });
}

Enclosure Krawczyk::value_at_zeros(const Row& row, const Sides& x) const {
  // With R = Y·F and any real λ: R(c) + Y·S (z − c) ∋ 0 at a zero z, so row(z) ∈ row(c) − λ·R(c) + (S_row − λ·Y·S)(x − c).
  Sides slopes, gradient(x.size());
  row.slopes(x, center_sides_, slopes);
  for (std::size_t k = 0; k < slopes.size(); ++k) gradient[static_cast<std::size_t>(row.columns()[k])] = slopes[k];
  Enclosure value = row.value(center_sides_);
  for (std::size_t a = 0; a < dependent_.size(); ++a) {
    const double lambda = gradient[static_cast<std::size_t>(dependent_[a])].mid();
    if (lambda == 0) continue;
    value.add_product(-lambda, residual_[a]);
    for (std::size_t j = 0; j < x.size(); ++j)
      if (!product_[a][j].is_zero()) gradient[j].add_product(-lambda, product_[a][j]);
  }
  for (std::size_t j = 0; j < x.size(); ++j)
    if (!gradient[j].is_zero()) value.add_product(gradient[j], x[j] - center_sides_[j]);
  return value;
}

}  // namespace corank::certify::checker
