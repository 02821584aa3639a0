#include "corank/certify/newton.h"

#include <algorithm>
#include <utility>

#include "corank/certify/numeric.h"
#include "corank/certify/slope_matrix.h"
#include "corank/core/box.h"
#include "corank/core/check.h"
#include "corank/core/dense.h"
#include "corank/core/rounding.h"

namespace corank::certify {

struct NewtonBuffers {
  SlopeMatrix matrix;  ///< Y and Y·S
  std::vector<Interval> slope, values, residual, offset, image, region, gradient;
  std::vector<double> center, distance, sizes;
  std::vector<unsigned char> is_dependent;
  std::vector<int> free;
  std::vector<Interval> stepped;  ///< the box of a step
  Preconditioner p;               ///< its rows and dependents, without Y
};

namespace {

void set_center(std::span<const Interval> x, int n, NewtonBuffers& w) {
  w.center.resize(n);
  for (int j = 0; j < n; ++j) w.center[j] = x[j].mid();
}

// residual (r) := Y · F(c), after matrix.set_matrix(Y).
void multiply_residual(const CompiledSystem& system, const Preconditioner& p, NewtonBuffers& w) {
  const int r = p.rank();
  w.values.resize(r);
  for (int b = 0; b < r; ++b) w.values[b] = system.evaluate_at(p.equations[b], w.center.data());
  w.matrix.multiply(w.values, w.residual);
}

void set_offsets(std::span<const Interval> x, NewtonBuffers& w) {
  w.offset.resize(w.center.size());
  for (std::size_t j = 0; j < w.offset.size(); ++j) w.offset[j] = x[j] - Interval(w.center[j]);
}

bool bounded(const std::vector<Interval>& x) {
  return std::ranges::all_of(x, [](const Interval& side) { return side.is_bounded(); });
}

// The rows Y·F(c) + Y·S·(x − c) ∋ 0 of the matrix, each solved for its dependent variable.
NewtonOutcome solve_rows(const Preconditioner& p, std::span<Interval> x, NewtonBuffers& w) {
  const int r = p.rank();
  set_offsets(x, w);
  w.image = w.residual;
  w.matrix.accumulate(w.offset.data(), p.dependent, SlopeMatrix::Diagonal::zero, w.image);
  NewtonOutcome outcome;
  outcome.regular = true;
  for (int a = 0; a < r; ++a) {
    const int d = p.dependent[a];
    const Interval pivot = w.matrix.at(a, d);
    if (!w.image[a].is_bounded()) {
      outcome.regular = false;
      continue;
    }
    // pivot · (x_d − c_d) = −image
    const auto shift = divide(-w.image[a], pivot, w.offset[d]);
    if (pivot.contains_zero()) outcome.regular = false;
    if (!shift || !x[d].intersect(Interval(w.center[d]) + *shift)) {
      outcome.empty = true;
      return outcome;
    }
  }
  return outcome;
}

}  // namespace

Preconditioner midpoint_preconditioner(const CompiledSystem& system, const std::vector<double>& point,
                                       const std::vector<int>& dependent) {
  const int m = system.equations();
  CORANK_CHECK(static_cast<int>(dependent.size()) == m);
  Eigen::MatrixXd y = inverse(approximate_jacobian(system, point)(Eigen::all, dependent));
  if (!y.allFinite()) y.setZero();
  Preconditioner p;
  p.dependent = dependent;
  for (int a = 0; a < m; ++a) {
    p.equations.push_back(a);
    for (int b = 0; b < m; ++b) p.y.push_back(y(a, b));
  }
  return p;
}

NewtonWorkspace::NewtonWorkspace() = default;
NewtonWorkspace::~NewtonWorkspace() = default;
NewtonWorkspace::NewtonWorkspace(NewtonWorkspace&&) noexcept = default;
NewtonWorkspace& NewtonWorkspace::operator=(NewtonWorkspace&&) noexcept = default;

NewtonWorkspace::Borrowed NewtonWorkspace::take() {
  if (spare_.empty()) return Borrowed(new NewtonBuffers, {this});
  Borrowed last(spare_.back().release(), {this});
  spare_.pop_back();
  return last;
}

void NewtonWorkspace::GiveBack::operator()(NewtonBuffers* buffers) const { home->spare_.emplace_back(buffers); }

NewtonStep::NewtonStep(const CompiledSystem& system, const Preconditioner& p, std::span<Interval> x, NewtonWorkspace& w)
    : system_(&system), buffers_(w.take()) {
  NewtonBuffers& b = *buffers_;
  b.p.equations = p.equations;
  b.p.dependent = p.dependent;
  if (!b.matrix.set_matrix(p.y, p.rank())) return;
  set_center(x, system.variables(), b);
  b.slope.resize(system.entries());
  system.slopes(x, b.center.data(), b.slope);
  if (!b.matrix.assign_product(system, p.equations, b.slope)) return;
  multiply_residual(system, p, b);
  bounded_ = true;
  b.stepped.assign(x.begin(), x.begin() + system.variables());
  outcome_ = solve_rows(p, x, b);
  if (outcome_.regular && !outcome_.empty) outcome_.spread = b.matrix.distance_from_identity(p.dependent, system.scales());
}

const std::vector<int>& NewtonStep::equations() const { return buffers_->p.equations; }
const std::vector<int>& NewtonStep::dependent() const { return buffers_->p.dependent; }
std::span<const double> NewtonStep::center() const { return buffers_->center; }
double NewtonStep::derivative(int a, int j) const { return bounded_ ? -buffers_->matrix.at(a, j).mid() : 0; }
double NewtonStep::noise(int a) const { return bounded_ ? buffers_->residual[a].width() : 0; }

void NewtonStep::add_smears(std::span<const Interval> x, std::vector<double>& sums) const {
  if (!bounded_) return;
  const SlopeMatrix& matrix = buffers_->matrix;
  std::vector<double> parts(sums.size());
  for (int a = 0; a < buffers_->p.rank(); ++a) {
    double sum = 0;
    for (int j = 0; j < matrix.columns(); ++j) {
      const Interval entry = matrix.at(a, j);
      const double size = j == buffers_->p.dependent[a] ? (entry - Interval(1.0)).mag() : entry.mag();
      sum += parts[j] = size * x[j].width();
    }
    if (!(sum > 0 && std::isfinite(sum))) continue;
    for (std::size_t j = 0; j < parts.size(); ++j) sums[j] += std::sqrt(parts[j] / sum);
  }
}

void NewtonStep::check_part(std::span<const Interval> x) const {
  CORANK_CHECK(UpwardRounding::active());
  CORANK_CHECK(contains(buffers_->stepped, x));
}

bool NewtonStep::contract_free(std::span<Interval> x) const {
  if (!bounded_) return true;
  check_part(x);
  NewtonBuffers& w = *buffers_;
  const Preconditioner& p = w.p;
  const int r = p.rank(), n = w.matrix.columns();
  w.is_dependent.assign(n, 0);
  for (int d : p.dependent) w.is_dependent[d] = 1;
  w.free.clear();
  for (int j = 0; j < n; ++j)
    if (!w.is_dependent[j]) w.free.push_back(j);
  // image (r) := Y·F(c) + (Y·S)_D (x_D − c_D)
  w.offset.assign(n, Interval());
  for (int d : p.dependent) w.offset[d] = x[d] - Interval(w.center[d]);
  w.image = w.residual;
  w.matrix.accumulate(w.offset.data(), p.dependent, SlopeMatrix::Diagonal::zero, w.image);
  for (int a = 0; a < r; ++a) w.image[a] += w.matrix.at(a, p.dependent[a]) * w.offset[p.dependent[a]];
  for (int f : w.free) w.offset[f] = x[f] - Interval(w.center[f]);
  for (int f : w.free) {
    for (int a = 0; a < r; ++a) {
      Interval others = w.image[a];
      for (int g : w.free)
        if (g != f) others += w.matrix.at(a, g) * w.offset[g];
      const Interval slope = w.matrix.at(a, f);
      if (!others.is_bounded() || (-others).contains(slope * w.offset[f])) continue;  // no information
      const auto shift = divide(-others, slope, w.offset[f]);
      if (!shift || !x[f].intersect(Interval(w.center[f]) + *shift)) return false;
    }
    w.offset[f] = x[f] - Interval(w.center[f]);
  }
  return true;
}

namespace {

// image := Krawczyk image K over the box x about w.center; w.residual holds Y·F(c), the matrix Y. False: no bounded image.
bool krawczyk(const CompiledSystem& system, const Preconditioner& p, std::span<const Interval> x, NewtonBuffers& w) {
  const int r = p.rank();
  w.slope.resize(system.entries());
  system.slopes(x, w.center.data(), w.slope);
  if (!w.matrix.assign_product(system, p.equations, w.slope)) return false;
  set_offsets(x, w);
  // K = c_D − (Y·F(c) + (Y·S_D − I)(Z − c_D) + Y·S_F (X_F − c_F))
  w.image = w.residual;
  w.matrix.accumulate(w.offset.data(), p.dependent, SlopeMatrix::Diagonal::minus_one, w.image);
  for (int a = 0; a < r; ++a) w.image[a] = Interval(w.center[p.dependent[a]]) - w.image[a];
  return bounded(w.image);
}

// Hypothesis (2): |I − Y·J_D(B)| r < r for some r > 0.
bool jacobian_is_regular(const CompiledSystem& system, const Preconditioner& p, std::span<const Interval> b,
                         NewtonBuffers& w) {
  w.slope.resize(system.entries());
  system.jacobian(b, w.slope);
  if (!w.matrix.assign_product(system, p.equations, w.slope)) return false;
  w.distance.clear();
  w.sizes.clear();
  for (int a = 0; a < p.rank(); ++a) {
    for (int k = 0; k < p.rank(); ++k)
      w.distance.push_back((Interval(k == a ? 1.0 : 0.0) - w.matrix.at(a, p.dependent[k])).mag());
    w.sizes.push_back(system.scales()[p.dependent[a]]);
  }
  return is_contraction(w.distance, w.sizes);
}

}  // namespace

Sheet newton_prove(const CompiledSystem& system, const Preconditioner& p, std::span<const Interval> x,
                   NewtonWorkspace& workspace, int iterations) {
  CORANK_CHECK(UpwardRounding::active());
  const NewtonWorkspace::Borrowed borrowed = workspace.take();
  NewtonBuffers& w = *borrowed;
  Sheet sheet;
  const int r = p.rank(), n = system.variables();
  // No dependent variable and no equation: every point of x is a solution.
  if ((r == 0 && system.equations() > 0) || r > n || !w.matrix.set_matrix(p.y, r)) return sheet;
  set_center(x, n, w);
  multiply_residual(system, p, w);
  if (!bounded(w.residual)) return sheet;
  std::vector<Interval>& b = w.region;  // X_F × Z
  b.assign(x.begin(), x.begin() + n);
  for (int step = 0; step < iterations; ++step) {
    if (!krawczyk(system, p, b, w)) return sheet;
    bool inside = true;
    for (int a = 0; a < r && inside; ++a) inside = b[p.dependent[a]].strictly_contains(w.image[a]);
    if (inside) {  // hypothesis (1) holds for B
      std::vector<Interval> image(b);
      for (int a = 0; a < r; ++a) image[p.dependent[a]] = w.image[a];
      if (!jacobian_is_regular(system, p, b, w)) return sheet;
      sheet.proven = true;
      sheet.equations = p.equations;
      sheet.dependent = p.dependent;
      sheet.region = b;
      sheet.image = std::move(image);
      return sheet;
    }
    for (int a = 0; a < r; ++a) {  // ε-inflation
      const Interval& k = w.image[a];
      const double margin = 0.1 * k.width() + 1e-15 * k.mag() + 1e-30 * system.scales()[p.dependent[a]];
      b[p.dependent[a]] = k + Interval(-margin, margin);
    }
  }
  return sheet;
}

Sheet newton_prove_in_part(const CompiledSystem& system, const Preconditioner& p, std::span<const Interval> x,
                           std::span<const Interval> near, NewtonWorkspace& workspace) {
  CORANK_CHECK(UpwardRounding::active());
  const std::vector<Interval> box(x.begin(), x.begin() + system.variables());
  {
    const NewtonWorkspace::Borrowed borrowed = workspace.take();
    NewtonBuffers& w = *borrowed;
    if (p.rank() == 0 || !w.matrix.set_matrix(p.y, p.rank()) || !jacobian_is_regular(system, p, box, w)) return {};
  }
  Sheet sheet = newton_prove(system, p, near, workspace);
  if (!sheet.proven || !contains(box, sheet.region)) return {};
  sheet.image = box;
  return sheet;
}

bool Sheet::spans_image() const {
  for (std::size_t j = 0; j < image.size(); ++j)
    if (std::ranges::find(dependent, static_cast<int>(j)) == dependent.end() && !region[j].contains(image[j])) return false;
  return true;
}

Interval NewtonStep::gradient_about_center(int row, std::span<const Interval> x) const {
  NewtonBuffers& w = *buffers_;
  w.slope.resize(system_->entries());
  system_->slopes(row, x, w.center.data(), w.slope);
  w.gradient.assign(system_->variables(), Interval());
  for (int k = system_->row_begin(row); k < system_->row_begin(row + 1); ++k) w.gradient[system_->column(k)] = w.slope[k];
  return system_->evaluate_at(row, w.center.data());
}

bool NewtonStep::eliminate_dependents(Interval& value, std::vector<Interval>& gradient) const {
  const NewtonBuffers& w = *buffers_;
  for (int a = 0; a < w.p.rank(); ++a) {
    const double lambda = gradient[w.p.dependent[a]].mid();
    if (!std::isfinite(lambda)) return false;
    if (lambda == 0) continue;
    value -= scale(lambda, w.residual[a]);
    w.matrix.subtract_row(lambda, a, gradient.data());
  }
  return true;
}

Interval NewtonStep::value_at_zeros(int row, std::span<const Interval> x) const {
  if (!bounded_) return Interval::whole();
  check_part(x);
  NewtonBuffers& w = *buffers_;
  Interval value = gradient_about_center(row, x);
  if (!eliminate_dependents(value, w.gradient)) return Interval::whole();
  for (int j = 0; j < system_->variables(); ++j) value += w.gradient[j] * (x[j] - Interval(w.center[j]));
  return value;
}

AffineForm NewtonStep::form_of(Interval value, std::span<const Interval> x, const std::vector<int>& free) const {
  NewtonBuffers& w = *buffers_;
  AffineForm form{Interval::whole(), std::vector<Interval>(free.size())};
  if (!eliminate_dependents(value, w.gradient)) return form;
  for (std::size_t k = 0; k < free.size(); ++k) form.slopes[k] = std::exchange(w.gradient[free[k]], Interval());
  form.constant = value;
  for (int j = 0; j < system_->variables(); ++j) form.constant += w.gradient[j] * (x[j] - Interval(w.center[j]));
  return form;
}

AffineForm NewtonStep::form_at_zeros(int row, std::span<const Interval> x, const std::vector<int>& free) const {
  if (!bounded_) return {Interval::whole(), std::vector<Interval>(free.size())};
  check_part(x);
  const Interval value = gradient_about_center(row, x);
  return form_of(value, x, free);
}

AffineForm NewtonStep::form_of_variable(int variable, std::span<const Interval> x, const std::vector<int>& free) const {
  if (!bounded_) return {Interval::whole(), std::vector<Interval>(free.size())};
  check_part(x);
  buffers_->gradient.assign(system_->variables(), Interval());
  buffers_->gradient[variable] = Interval(1.0);
  return form_of(Interval(buffers_->center[variable]), x, free);
}

void NewtonStep::tighten_part(std::span<Interval> x) const {
  if (!bounded_) return;
  check_part(x);
  CORANK_CHECK(!solve_rows(buffers_->p, x, *buffers_).empty);
}

NewtonStep tighten_sheet(const CompiledSystem& system, const Preconditioner& p, std::span<Interval> x, NewtonWorkspace& w) {
  // The dependents of p are the sheet's; a step touches no other variable and deletes no solution. An empty outcome would
  // contradict the sheet's existence proof.
  NewtonStep step(system, p, x, w);
  CORANK_CHECK(!step.outcome().empty);
  return step;
}

}  // namespace corank::certify
