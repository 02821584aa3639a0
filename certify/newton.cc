#include "corank/certify/newton.h"

#include <algorithm>

#include "corank/certify/check.h"
#include "corank/certify/rounding.h"

namespace corank::certify {
namespace {

void set_center(const Interval* x, int n, NewtonWorkspace& w) {
  w.center.resize(n);
  for (int j = 0; j < n; ++j) w.center[j] = x[j].mid();
}

// product (r×n) := Y · sparse (the rows p.equations of a matrix in the system's sparsity pattern).
void multiply(const CompiledSystem& system, const Preconditioner& p, const std::vector<Interval>& sparse,
              std::vector<Interval>& product) {
  const int r = p.rank(), n = system.variables();
  product.assign(static_cast<std::size_t>(r) * n, Interval());
  for (int a = 0; a < r; ++a) {
    Interval* row = product.data() + static_cast<std::size_t>(a) * n;
    for (int b = 0; b < r; ++b) {
      const double y = p.y[static_cast<std::size_t>(a) * r + b];
      if (y == 0) continue;
      const int i = p.equations[b], end = system.row_begin(i + 1);
      // |y| > 0 is finite, so |y| · (−lo, hi) cannot be NaN; a negative y swaps the endpoints.
      const __m128d magnitude = _mm_set1_pd(std::fabs(y));
      for (int k = system.row_begin(i); k < end; ++k) {
        __m128d s = sparse[k].data();
        if (y < 0) s = _mm_shuffle_pd(s, s, 1);
        Interval& entry = row[system.column(k)];
        entry = Interval::from_register(_mm_add_pd(entry.data(), _mm_mul_pd(magnitude, s)));
      }
    }
  }
}

// residual (r) := Y · F(c).
void multiply_residual(const CompiledSystem& system, const Preconditioner& p, const double* c, NewtonWorkspace& w) {
  const int r = p.rank();
  w.image.resize(std::max<std::size_t>(w.image.size(), r));
  for (int b = 0; b < r; ++b) w.image[b] = system.evaluate_at(p.equations[b], c);
  w.residual.assign(r, Interval());
  for (int a = 0; a < r; ++a)
    for (int b = 0; b < r; ++b) {
      const double y = p.y[static_cast<std::size_t>(a) * r + b];
      if (y != 0) w.residual[a] += scale(y, w.image[b]);
    }
}

bool finite(const Preconditioner& p) {
  return std::all_of(p.y.begin(), p.y.end(), [](double y) { return std::isfinite(y); });
}

}  // namespace

NewtonOutcome newton_contract(const CompiledSystem& system, const Preconditioner& p, Interval* x, NewtonWorkspace& w) {
  NewtonOutcome outcome;
  const int r = p.rank(), n = system.variables();
  if (!finite(p)) return outcome;
  set_center(x, n, w);
  w.slope.resize(system.entries());
  system.slopes(x, w.center.data(), w.slope.data());
  multiply(system, p, w.slope, w.product);
  multiply_residual(system, p, w.center.data(), w);
  w.offset.resize(n);
  for (int j = 0; j < n; ++j) w.offset[j] = x[j] - Interval(w.center[j]);

  outcome.regular = true;
  for (int a = 0; a < r; ++a) {
    const Interval* row = w.product.data() + static_cast<std::size_t>(a) * n;
    const int d = p.dependent[a];
    Interval rest = w.residual[a];
    for (int j = 0; j < n; ++j)
      if (j != d) rest += row[j] * w.offset[j];
    // row[d] (x_d − c_d) = −rest
    const auto shift = divide(-rest, row[d], w.offset[d]);
    if (!shift) {
      outcome.empty = true;
      return outcome;
    }
    if (row[d].contains_zero()) outcome.regular = false;
    w.offset[d] = *shift;
    if (!x[d].intersect(Interval(w.center[d]) + *shift)) {
      outcome.empty = true;
      return outcome;
    }
  }
  for (int a = 0; a < r && outcome.regular; ++a) {
    const Interval* row = w.product.data() + static_cast<std::size_t>(a) * n;
    double sum = 0;
    for (int b = 0; b < r; ++b) sum += (Interval(a == b ? 1.0 : 0.0) - row[p.dependent[b]]).mag();
    outcome.spread = std::max(outcome.spread, sum);
  }
  return outcome;
}

namespace {

// image := Krawczyk image K over the box x about w.center; w.residual holds Y·F(c).
void krawczyk(const CompiledSystem& system, const Preconditioner& p, const Interval* x, NewtonWorkspace& w) {
  const int r = p.rank(), n = system.variables();
  w.slope.resize(system.entries());
  system.slopes(x, w.center.data(), w.slope.data());
  multiply(system, p, w.slope, w.product);
  w.offset.resize(n);
  for (int j = 0; j < n; ++j) w.offset[j] = x[j] - Interval(w.center[j]);
  w.image.resize(std::max<std::size_t>(w.image.size(), r));
  for (int a = 0; a < r; ++a) {
    const Interval* row = w.product.data() + static_cast<std::size_t>(a) * n;
    const int d = p.dependent[a];
    Interval sum = Interval(w.center[d]) - w.residual[a];
    for (int j = 0; j < n; ++j) {
      if (j == d)
        sum += (Interval(1.0) - row[j]) * w.offset[j];
      else
        sum -= row[j] * w.offset[j];
    }
    w.image[a] = sum;
  }
}

// Hypothesis (2): |I − Y·J_D(B)| r < r for some r > 0, which holds for some r exactly where the spectral radius is below 1. The
// candidates for r come from power iteration; the one that passes is checked with upward rounding.
bool jacobian_is_regular(const CompiledSystem& system, const Preconditioner& p, const Interval* b, NewtonWorkspace& w) {
  constexpr int kCandidates = 6;
  const int r = p.rank(), n = system.variables();
  system.jacobian(b, w.slope.data());
  multiply(system, p, w.slope, w.product);
  w.magnitude.resize(static_cast<std::size_t>(r) * r);
  for (int a = 0; a < r; ++a) {
    const Interval* row = w.product.data() + static_cast<std::size_t>(a) * n;
    for (int k = 0; k < r; ++k)
      w.magnitude[static_cast<std::size_t>(a) * r + k] = (Interval(k == a ? 1.0 : 0.0) - row[p.dependent[k]]).mag();
  }
  w.radius.assign(r, 1.0);
  w.next_radius.resize(r);
  for (int candidate = 0; candidate < kCandidates; ++candidate) {
    bool passes = true;
    double largest = 0;
    for (int a = 0; a < r; ++a) {
      double sum = 0;  // upward rounding: an upper bound of (|E| r)_a
      for (int k = 0; k < r; ++k) sum += w.magnitude[static_cast<std::size_t>(a) * r + k] * w.radius[k];
      if (!std::isfinite(sum)) return false;
      passes = passes && sum < w.radius[a];
      w.next_radius[a] = sum;
      largest = std::max(largest, sum);
    }
    if (passes) return true;
    for (int a = 0; a < r; ++a) w.radius[a] = w.next_radius[a] / largest + 0.05;
  }
  return false;
}

}  // namespace

Sheet newton_prove(const CompiledSystem& system, const Preconditioner& p, const Interval* x, NewtonWorkspace& w,
                   int iterations) {
  CORANK_CHECK(UpwardRounding::active());
  Sheet sheet;
  const int r = p.rank(), n = system.variables();
  // No dependent variable and no equation: every point of x is a solution.
  if ((r == 0 && system.equations() > 0) || r > n || !finite(p)) return sheet;
  set_center(x, n, w);
  multiply_residual(system, p, w.center.data(), w);
  std::vector<Interval>& b = w.region;  // X_F × Z
  b.assign(x, x + n);
  for (int step = 0; step < iterations; ++step) {
    krawczyk(system, p, b.data(), w);
    bool inside = true;
    for (int a = 0; a < r && inside; ++a) inside = b[p.dependent[a]].strictly_contains(w.image[a]);
    if (inside) {  // hypothesis (1) holds for B
      std::vector<Interval> image(b);
      for (int a = 0; a < r; ++a) image[p.dependent[a]] = w.image[a];
      if (!jacobian_is_regular(system, p, b.data(), w)) return sheet;
      sheet.proven = true;
      sheet.equations = p.equations;
      sheet.dependent = p.dependent;
      sheet.region = b;
      sheet.image = std::move(image);
      return sheet;
    }
    for (int a = 0; a < r; ++a) {  // ε-inflation
      const Interval& k = w.image[a];
      if (!k.is_bounded()) return sheet;
      const double margin = 0.1 * k.width() + 1e-15 * k.mag() + 1e-300;
      b[p.dependent[a]] = k + Interval(-margin, margin);
    }
  }
  return sheet;
}

Interval value_at_zeros(const CompiledSystem& system, const Preconditioner& p, int row, const Interval* x,
                        NewtonWorkspace& w) {
  CORANK_CHECK(UpwardRounding::active());
  const int r = p.rank(), n = system.variables();
  CORANK_CHECK(w.product.size() == static_cast<std::size_t>(r) * n && w.center.size() == static_cast<std::size_t>(n));
  w.slope.resize(system.entries());
  system.slopes(row, x, w.center.data(), w.slope.data());
  w.gradient.assign(n, Interval());
  for (int k = system.row_begin(row); k < system.row_begin(row + 1); ++k) w.gradient[system.column(k)] = w.slope[k];
  Interval value = system.evaluate_at(row, w.center.data());
  for (int a = 0; a < r; ++a) {
    const double lambda = w.gradient[p.dependent[a]].mid();
    if (!std::isfinite(lambda)) return Interval::whole();
    if (lambda == 0) continue;
    value -= scale(lambda, w.residual[a]);
    const Interval* product = w.product.data() + static_cast<std::size_t>(a) * n;
    for (int j = 0; j < n; ++j) w.gradient[j] -= scale(lambda, product[j]);
  }
  for (int j = 0; j < n; ++j) value += w.gradient[j] * (x[j] - Interval(w.center[j]));
  return value;
}

double tighten_sheet(const CompiledSystem& system, const Preconditioner& p, Interval* x, NewtonWorkspace& w) {
  // The dependents of p are the sheet's; newton_contract touches no other variable and deletes no solution. An empty outcome
  // would contradict the sheet's existence proof.
  const NewtonOutcome outcome = newton_contract(system, p, x, w);
  CORANK_CHECK(!outcome.empty);
  return outcome.regular ? outcome.spread : HUGE_VAL;
}

}  // namespace corank::certify
