#include "corank/check/krawczyk.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "corank/core/dense.h"

namespace corank::check {

Eigen::MatrixXd approximate_jacobian(const std::vector<Row>& equations, const std::vector<double>& point) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(std::ssize(equations), std::ssize(point));
  std::vector<double> entries;
  for (std::size_t i = 0; i < equations.size(); ++i) {
    equations[i].approximate(point, entries);
    for (std::size_t k = 0; k < entries.size(); ++k) result(i, equations[i].columns()[k]) = entries[k];
  }
  return result;
}

Pivots pivots(Eigen::MatrixXd t, std::size_t most, double least) {
  const int m = static_cast<int>(t.rows()), n = static_cast<int>(t.cols());
  Pivots result;
  std::vector<bool> used(m, false), taken(n, false);
  while (result.rows.size() < most) {
    int row = 0, column = 0;
    double best = least;
    for (int i = 0; i < m; ++i)
      for (int j = 0; j < n && !used[i]; ++j)
        if (!taken[j] && std::fabs(t(i, j)) > best) best = std::fabs(t(i, j)), row = i, column = j;
    if (best == least) break;
    used[row] = taken[column] = true;
    result.rows.push_back(row);
    result.columns.push_back(column);
    for (int i = 0; i < m; ++i) {
      const double factor = t(i, column) / t(row, column);
      for (int j = 0; j < n && !used[i]; ++j) t(i, j) -= factor * t(row, j);
    }
  }
  return result;
}

bool is_contraction(const Eigen::MatrixXd& e) {
  constexpr int kCandidates = 200;
  const std::size_t r = e.rows();
  // r = Σ Eᵏ·1 to where Eᵏ·1 < 1: then E·r < r. In doubles; what they find is checked in enclosures.
  std::vector<double> power(r, 1.0), radius(r, 1.0), next(r);
  for (int candidate = 0; candidate < kCandidates; ++candidate) {
    for (std::size_t a = 0; a < r; ++a) {
      next[a] = 0;
      for (std::size_t k = 0; k < r; ++k) next[a] += e(a, k) * power[k];
      if (!std::isfinite(next[a])) return false;
    }
    power = next;
    if (std::ranges::all_of(power, [](double x) { return x < 1; })) break;
    for (std::size_t a = 0; a < r; ++a) radius[a] += power[a];
  }
  for (std::size_t a = 0; a < r; ++a) {
    Enclosure sum;
    for (std::size_t k = 0; k < r; ++k) sum.add_product(radius[k], Enclosure(e(a, k)));
    if (!sum.is_bounded() || !sum.below(Enclosure(radius[a]))) return false;
  }
  return true;
}

void drop_noise(Eigen::MatrixXd& y) {
  constexpr double kNoise = 1e-13;
  for (auto row : y.rowwise()) row = (row.array().abs() <= kNoise * row.cwiseAbs().maxCoeff()).select(0, row);
}

Krawczyk::Krawczyk(const std::vector<Row>& equations, int variables)
    : equations_(equations), n_(variables), entries_(equations.size()) {}

bool Krawczyk::set(const std::vector<int>& dependent, const Sides& x, Center around) {
  constexpr int kSteps = 4;
  const std::size_t r = equations_.size();
  if (dependent.size() != r) return false;
  dependent_ = dependent;
  center_.resize(n_);
  for (std::size_t j = 0; j < center_.size(); ++j) center_[j] = x[j].mid();
  const auto inverted = [&] { return around == Center::refined ? invert_refined() : invert(); };
  if (!inverted()) return false;
  std::vector<double> values(r);
  for (int step = 0; around != Center::middle && step < kSteps; ++step) {
    const Sides at(center_.begin(), center_.end());
    for (std::size_t b = 0; b < r; ++b)
      values[b] = around == Center::refined ? equations_[b].value(at).mid() : equations_[b].approximate(center_);
    if (!polish(x, values)) break;  // so would be every further step
    if (!inverted()) return false;
  }
  center_sides_.assign(center_.begin(), center_.end());
  Sides at_center;
  for (const Row& f : equations_) at_center.push_back(f.value(center_sides_));
  residual_.assign(r, Enclosure());
  for (std::size_t a = 0; a < r; ++a)
    for (std::size_t b = 0; b < r; ++b) residual_[a].add_product(y_(a, b), at_center[b]);
  return true;
}

bool Krawczyk::polish(const Sides& x, const std::vector<double>& values) {
  const std::size_t r = equations_.size();
  bool moved = false;
  for (std::size_t a = 0; a < r; ++a) {
    const std::size_t d = dependent_[a];
    double shift = 0;
    for (std::size_t b = 0; b < r; ++b) shift += y_(a, b) * values[b];
    if (!std::isfinite(shift)) continue;
    const double next = std::clamp(center_[d] - shift, x[d].lo(), x[d].hi());
    moved = moved || next != center_[d];
    center_[d] = next;
  }
  return moved;
}

bool Krawczyk::invert() {
  y_ = inverse(approximate_jacobian(equations_, center_)(Eigen::all, dependent_));
  if (!y_.allFinite()) return false;
  drop_noise(y_);
  return true;
}

bool Krawczyk::invert_refined() {
  const std::size_t r = equations_.size();
  const Sides center(center_.begin(), center_.end());
  std::vector<int> place(center_.size(), -1);  // of each variable which dependent it is
  for (std::size_t a = 0; a < r; ++a) place[dependent_[a]] = static_cast<int>(a);
  Sides entries;
  std::vector<Sides> t(r, Sides(2 * r));  // J_D | I
  for (std::size_t b = 0; b < r; ++b) {
    equations_[b].derivatives(center, entries);
    t[b][r + b] = Enclosure(1.0);
    for (std::size_t k = 0; k < entries.size(); ++k)
      if (const int a = place[equations_[b].columns()[k]]; a >= 0) t[b][a] = entries[k];
  }
  for (std::size_t k = 0; k < r; ++k) {
    const auto pivot =
        std::max_element(t.begin() + k, t.end(), [k](const Sides& a, const Sides& b) { return a[k].mig() < b[k].mig(); });
    if (!((*pivot)[k].mig() > 0)) return false;
    std::iter_swap(t.begin() + k, pivot);
    // Nothing reads the columns up to the k-th again, and zeros, of which both halves are full, add nothing.
    std::vector<std::size_t> columns;
    for (std::size_t j = k + 1; j < 2 * r; ++j)
      if (!t[k][j].is_zero()) columns.push_back(j);
    for (const std::size_t j : columns) t[k][j] = quotient(t[k][j], t[k][k]);
    for (std::size_t i = 0; i < r; ++i) {
      if (i == k || t[i][k].is_zero()) continue;
      const Enclosure factor = -t[i][k];
      for (const std::size_t j : columns) t[i][j].add_product(factor, t[k][j]);
    }
  }
  y_.resize(std::ssize(t), std::ssize(t));
  for (std::size_t a = 0; a < r; ++a)
    for (std::size_t b = 0; b < r; ++b) y_(a, b) = t[a][r + b].mid();
  return y_.allFinite();
}

void Krawczyk::multiply(const std::vector<Sides>& rows, std::vector<Sides>& product) const {
  const std::size_t r = equations_.size();
  product.resize(r);
  for (std::size_t a = 0; a < r; ++a) {
    product[a].assign(n_, Enclosure());
    for (std::size_t b = 0; b < r; ++b) {
      const double y = y_(a, b);
      if (y == 0) continue;
      for (std::size_t k = 0; k < rows[b].size(); ++k) product[a][equations_[b].columns()[k]].add_product(y, rows[b][k]);
    }
  }
}

Sides Krawczyk::image(const Sides& x) {
  for (std::size_t b = 0; b < equations_.size(); ++b) equations_[b].slopes(x, center_sides_, entries_[b]);
  multiply(entries_, product_);
  Sides image, distance;
  for (std::size_t j = 0; j < x.size(); ++j) distance.push_back(x[j] - center_sides_[j]);
  for (std::size_t a = 0; a < dependent_.size(); ++a) {
    Enclosure sum = residual_[a];
    for (std::size_t j = 0; j < x.size(); ++j) {
      const bool own = static_cast<int>(j) == dependent_[a];
      if (!own && product_[a][j].is_zero()) continue;
      sum.add_product(own ? product_[a][j] - Enclosure(1.0) : product_[a][j], distance[j]);
    }
    image.push_back(center_sides_[dependent_[a]] - sum);
  }
  return image;
}

bool Krawczyk::is_inside(const Sides& image, const Sides& x) const {
  for (std::size_t a = 0; a < image.size(); ++a)
    if (!image[a].strictly_inside(x[dependent_[a]])) return false;
  return true;
}

bool Krawczyk::shrink(Sides& x, const Sides& image) const {
  for (std::size_t a = 0; a < image.size(); ++a)
    if (!x[dependent_[a]].intersect(image[a])) return false;
  return true;
}

bool Krawczyk::is_injective(const Sides& x) {
  const std::size_t r = dependent_.size();
  for (std::size_t b = 0; b < r; ++b) equations_[b].derivatives(x, entries_[b]);
  multiply(entries_, derivatives_);
  Eigen::MatrixXd excess(std::ssize(dependent_), std::ssize(dependent_));  // ≥ |I − Y·J_D|
  for (std::size_t a = 0; a < r; ++a)
    for (std::size_t k = 0; k < r; ++k) {
      const Enclosure& entry = derivatives_[a][dependent_[k]];
      excess(a, k) = (Enclosure(a == k ? 1.0 : 0.0) - entry).mag();
    }
  return is_contraction(excess);
}

bool Krawczyk::center_solves(const Sides& x) const {
  Sides there = x;
  for (const int d : dependent_) there[d] = center_sides_[d];
  return std::ranges::all_of(equations_, [&](const Row& f) { return f.value(there).is_zero(); });
}

void Krawczyk::eliminate_dependents(Enclosure& value, Sides& gradient) const {
  // With R = Y·F and any real λ: R(c) + Y·S (z − c) ∋ 0 at a zero z, so row(z) ∈ row(c) − λ·R(c) + (S_row − λ·Y·S)(z − c).
  for (std::size_t a = 0; a < dependent_.size(); ++a) {
    const double lambda = gradient[dependent_[a]].mid();
    if (lambda == 0) continue;
    value.add_product(-lambda, residual_[a]);
    for (std::size_t j = 0; j < gradient.size(); ++j)
      if (!product_[a][j].is_zero()) gradient[j].add_product(-lambda, product_[a][j]);
  }
}

Enclosure Krawczyk::value_and_slopes(const Row& row, const Sides& x, Sides& gradient) const {
  Sides slopes;
  row.slopes(x, center_sides_, slopes);
  gradient.assign(x.size(), Enclosure());
  for (std::size_t k = 0; k < slopes.size(); ++k) gradient[row.columns()[k]] = slopes[k];
  return row.value(center_sides_);
}

Enclosure Krawczyk::value_at_zeros(const Row& row, const Sides& x) const {
  Sides gradient;
  Enclosure value = value_and_slopes(row, x, gradient);
  eliminate_dependents(value, gradient);
  for (std::size_t j = 0; j < x.size(); ++j)
    if (!gradient[j].is_zero()) value.add_product(gradient[j], x[j] - center_sides_[j]);
  return value;
}

Form Krawczyk::form_of(Enclosure value, Sides gradient, const Sides& x, const std::vector<int>& free) const {
  eliminate_dependents(value, gradient);
  Form form;
  for (const int f : free) form.slopes.push_back(std::exchange(gradient[f], Enclosure()));
  form.constant = value;
  for (std::size_t j = 0; j < x.size(); ++j)
    if (!gradient[j].is_zero()) form.constant.add_product(gradient[j], x[j] - center_sides_[j]);
  return form;
}

Form Krawczyk::form_at_zeros(const Row& row, const Sides& x, const std::vector<int>& free) const {
  Sides gradient;
  Enclosure value = value_and_slopes(row, x, gradient);
  return form_of(std::move(value), std::move(gradient), x, free);
}

Form Krawczyk::form_of_variable(int variable, const Sides& x, const std::vector<int>& free) const {
  Sides gradient(x.size());
  gradient[variable] = Enclosure(1.0);
  return form_of(center_sides_[variable], std::move(gradient), x, free);
}

}  // namespace corank::check
