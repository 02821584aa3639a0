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

// residual (r) := Y · F(c), after panel.set_matrix(Y).
void multiply_residual(const CompiledSystem& system, const Preconditioner& p, NewtonWorkspace& w) {
  const int r = p.rank();
  w.values.resize(static_cast<std::size_t>(r));
  for (int b = 0; b < r; ++b) w.values[b] = system.evaluate_at(p.equations[b], w.center.data());
  w.panel.multiply(w.values, w.residual);
}

bool bounded(const std::vector<Interval>& x) {
  return std::all_of(x.begin(), x.end(), [](const Interval& side) { return side.is_bounded(); });
}

// What the panel and the residual say was computed by the last newton_contract for these rows and a box that contains x.
void check_step(const Preconditioner& p, const Interval* x, const NewtonWorkspace& w) {
  CORANK_CHECK(UpwardRounding::active());
  CORANK_CHECK(p.equations == w.rows && p.dependent == w.row_sides);
  bool part = true;
  for (std::size_t j = 0; j < w.stepped.size(); ++j) part = part && w.stepped[j].contains(x[j]);
  CORANK_CHECK(part);
}

// The rows Y·F(c) + Y·S·(x − c) ∋ 0 of the panel, each solved for its dependent variable.
NewtonOutcome solve_rows(const Preconditioner& p, Interval* x, NewtonWorkspace& w) {
  const int r = p.rank(), n = w.panel.columns();
  w.offset.resize(static_cast<std::size_t>(n));
  for (int j = 0; j < n; ++j) w.offset[j] = x[j] - Interval(w.center[j]);
  w.image = w.residual;
  w.panel.accumulate(w.offset.data(), p.dependent, Panel::Diagonal::zero, w.image);
  NewtonOutcome outcome;
  outcome.regular = true;
  for (int a = 0; a < r; ++a) {
    const int d = p.dependent[a];
    const Interval pivot = w.panel.at(a, d);
    if (!w.image[a].is_bounded()) {
      outcome.regular = false;
      continue;
    }
    // pivot · (x_d − c_d) = −image
    const auto shift = divide(-w.image[a], pivot, w.offset[d]);
    if (!shift) {
      outcome.empty = true;
      return outcome;
    }
    if (pivot.contains_zero()) outcome.regular = false;
    if (!x[d].intersect(Interval(w.center[d]) + *shift)) {
      outcome.empty = true;
      return outcome;
    }
  }
  return outcome;
}

}  // namespace

NewtonOutcome newton_contract(const CompiledSystem& system, const Preconditioner& p, Interval* x, NewtonWorkspace& w) {
  w.contracted = false;
  if (!w.panel.set_matrix(p.y, p.rank())) return {};
  set_center(x, system.variables(), w);
  w.slope.resize(system.entries());
  system.slopes(x, w.center.data(), w.slope.data());
  if (!w.panel.assign_product(system, p.equations, w.slope)) return {};
  multiply_residual(system, p, w);
  w.contracted = true;
  w.stepped.assign(x, x + system.variables());
  w.rows = p.equations;
  w.row_sides = p.dependent;
  NewtonOutcome outcome = solve_rows(p, x, w);
  if (outcome.regular && !outcome.empty) outcome.spread = w.panel.distance_from_identity(p.dependent, system.scales());
  return outcome;
}

bool contract_free(const Preconditioner& p, Interval* x, NewtonWorkspace& w) {
  if (!w.contracted) return true;
  check_step(p, x, w);
  const int r = p.rank(), n = w.panel.columns();
  w.is_dependent.assign(static_cast<std::size_t>(n), 0);
  for (int d : p.dependent) w.is_dependent[d] = 1;
  w.free.clear();
  for (int j = 0; j < n; ++j)
    if (!w.is_dependent[j]) w.free.push_back(j);
  // image (r) := Y·F(c) + (Y·S)_D (x_D − c_D)
  w.offset.assign(static_cast<std::size_t>(n), Interval());
  for (int d : p.dependent) w.offset[d] = x[d] - Interval(w.center[d]);
  w.image = w.residual;
  w.panel.accumulate(w.offset.data(), p.dependent, Panel::Diagonal::zero, w.image);
  for (int a = 0; a < r; ++a) w.image[a] += w.panel.at(a, p.dependent[a]) * w.offset[p.dependent[a]];
  for (int f : w.free) w.offset[f] = x[f] - Interval(w.center[f]);
  for (int f : w.free) {
    for (int a = 0; a < r; ++a) {
      Interval others = w.image[a];
      for (int g : w.free)
        if (g != f) others += w.panel.at(a, g) * w.offset[g];
      const Interval slope = w.panel.at(a, f);
      if (!others.is_bounded() || (-others).contains(slope * w.offset[f])) continue;  // no information
      const auto shift = divide(-others, slope, w.offset[f]);
      if (!shift || !x[f].intersect(Interval(w.center[f]) + *shift)) return false;
    }
    w.offset[f] = x[f] - Interval(w.center[f]);
  }
  return true;
}

namespace {

// image := Krawczyk image K over the box x about w.center; w.residual holds Y·F(c), the panel Y. False: no bounded image.
bool krawczyk(const CompiledSystem& system, const Preconditioner& p, const Interval* x, NewtonWorkspace& w) {
  const int r = p.rank(), n = system.variables();
  w.slope.resize(system.entries());
  system.slopes(x, w.center.data(), w.slope.data());
  if (!w.panel.assign_product(system, p.equations, w.slope)) return false;
  w.offset.resize(n);
  for (int j = 0; j < n; ++j) w.offset[j] = x[j] - Interval(w.center[j]);
  // K = c_D − (Y·F(c) + (Y·S_D − I)(Z − c_D) + Y·S_F (X_F − c_F))
  w.image = w.residual;
  w.panel.accumulate(w.offset.data(), p.dependent, Panel::Diagonal::minus_one, w.image);
  for (int a = 0; a < r; ++a) w.image[a] = Interval(w.center[p.dependent[a]]) - w.image[a];
  return bounded(w.image);
}

// Hypothesis (2): |I − Y·J_D(B)| r < r for some r > 0, which holds for some r exactly where the spectral radius is below 1. The
// candidates for r come from power iteration, the first one is the variables' scales; the one that passes is checked with upward
// rounding.
bool jacobian_is_regular(const CompiledSystem& system, const Preconditioner& p, const Interval* b, NewtonWorkspace& w) {
  constexpr int kCandidates = 6;
  const int r = p.rank();
  system.jacobian(b, w.slope.data());
  if (!w.panel.assign_product(system, p.equations, w.slope)) return false;
  w.magnitude.resize(static_cast<std::size_t>(r) * r);
  for (int a = 0; a < r; ++a) {
    for (int k = 0; k < r; ++k)
      w.magnitude[static_cast<std::size_t>(a) * r + k] =
          (Interval(k == a ? 1.0 : 0.0) - w.panel.at(a, p.dependent[k])).mag();
  }
  const auto scale = [&](int a) { return system.scales()[static_cast<std::size_t>(p.dependent[a])]; };
  w.radius.resize(r);
  for (int a = 0; a < r; ++a) w.radius[a] = scale(a);
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
      largest = std::max(largest, sum / scale(a));
    }
    if (passes) return true;
    for (int a = 0; a < r; ++a) w.radius[a] = w.next_radius[a] / largest + 0.05 * scale(a);
  }
  return false;
}

}  // namespace

Sheet newton_prove(const CompiledSystem& system, const Preconditioner& p, const Interval* x, NewtonWorkspace& w,
                   int iterations) {
  CORANK_CHECK(UpwardRounding::active());
  Sheet sheet;
  const int r = p.rank(), n = system.variables();
  w.contracted = false;  // the panel becomes the proof's
  // No dependent variable and no equation: every point of x is a solution.
  if ((r == 0 && system.equations() > 0) || r > n || !w.panel.set_matrix(p.y, r)) return sheet;
  set_center(x, n, w);
  multiply_residual(system, p, w);
  if (!bounded(w.residual)) return sheet;
  std::vector<Interval>& b = w.region;  // X_F × Z
  b.assign(x, x + n);
  for (int step = 0; step < iterations; ++step) {
    if (!krawczyk(system, p, b.data(), w)) return sheet;
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
      const double margin = 0.1 * k.width() + 1e-15 * k.mag() + 1e-300;
      b[p.dependent[a]] = k + Interval(-margin, margin);
    }
  }
  return sheet;
}

Interval value_at_zeros(const CompiledSystem& system, const Preconditioner& p, int row, const Interval* x,
                        NewtonWorkspace& w) {
  if (!w.contracted) return Interval::whole();
  check_step(p, x, w);
  const int r = p.rank(), n = system.variables();
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
    w.panel.subtract_row(lambda, a, w.gradient.data());
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

void tighten_part(const Preconditioner& p, Interval* x, NewtonWorkspace& w) {
  if (!w.contracted) return;
  check_step(p, x, w);
  CORANK_CHECK(!solve_rows(p, x, w).empty);
}

}  // namespace corank::certify
