#include "corank/certify/projection.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "corank/certify/trigonometric.h"

namespace corank::certify {
namespace {

constexpr int kMaxStackTerms = 64;

class Projector {
 public:
  Projector(const CompiledSystem& system, std::span<Interval> x, double share, std::uint8_t* changed)
      : system_(system), x_(x), share_(share), changed_(changed) {}

  // Shrinks the variables of t to where t(x) ∈ image.
  bool invert(const CompiledSystem::Term& t, const Interval& image) {
    using Shape = CompiledSystem::Shape;
    switch (t.shape) {
      case Shape::constant: return true;
      case Shape::linear: return set(t.x, divide(image, t.c, x_[t.x]));
      case Shape::square: {
        const auto square_image = divide(image, t.c, square(x_[t.x]));
        return square_image && set(t.x, root(*square_image, 2, x_[t.x]));
      }
      case Shape::bilinear:
        return set(t.x, divide(image, t.c * x_[t.y], x_[t.x])) && set(t.y, divide(image, t.c * x_[t.x], x_[t.y]));
      case Shape::sine: {
        const auto sines = divide(image, t.c, sine(x_[t.x]));
        return sines && set(t.x, inverse_sine(*sines, x_[t.x]));
      }
      case Shape::cosine: {
        const auto cosines = divide(image, t.c, cosine(x_[t.x]));
        return cosines && set(t.x, inverse_cosine(*cosines, x_[t.x]));
      }
      case Shape::general: break;
    }
    const auto factors = system_.factors(t);
    for (const auto& f : factors) {
      Interval others = t.c;
      for (const auto& g : factors)
        if (g.variable != f.variable) others *= power(x_[g.variable], g.power);
      const auto power_image = divide(image, others, power(x_[f.variable], f.power));
      if (!power_image || !set(f.variable, root(*power_image, f.power, x_[f.variable]))) return false;
    }
    return true;
  }

  bool set(int v, const std::optional<Interval>& shrunk) {
    if (!shrunk) return false;
    const double before = x_[v].width(), after = shrunk->width();
    x_[v] = *shrunk;
    if (after < (1 - share_) * before) changed_[v] = 1;
    return true;
  }

 private:
  const CompiledSystem& system_;
  std::span<Interval> x_;
  double share_;
  std::uint8_t* changed_;
};

bool is_linear(std::span<const CompiledSystem::Term> terms) {
  using Shape = CompiledSystem::Shape;
  return std::ranges::all_of(terms, [](const auto& t) { return t.shape == Shape::constant || t.shape == Shape::linear; });
}

// f(x) ≥ 0 by slopes: f(c) + Σ s_j·(x_j − c_j), solved for each x_j.
bool project_by_slopes(const CompiledSystem& system, int row, std::span<Interval> x, Projector& projector) {
  thread_local std::vector<Interval> slopes, offsets;  // all of the row's are written before they are read
  thread_local std::vector<double> center;
  const int begin = system.row_begin(row), end = system.row_begin(row + 1);
  center.resize(x.size());
  for (int k = begin; k < end; ++k) {
    const int j = system.column(k);
    if (!x[j].is_bounded()) return true;
    center[j] = x[j].mid();
  }
  slopes.resize(system.entries());
  offsets.resize(slopes.size());
  system.slopes(row, x, center.data(), slopes);
  const Interval at_center = system.evaluate_at(row, center.data());
  Interval sum = at_center;
  for (int k = begin; k < end; ++k) {
    const int j = system.column(k);
    offsets[k] = x[j] - Interval(center[j]);
    sum += slopes[k] * offsets[k];
  }
  if (sum.hi() < 0) return false;
  if (sum.lo() >= 0) return true;
  for (int k = begin; k < end; ++k) {
    const int j = system.column(k);
    Interval others = at_center;
    for (int i = begin; i < end; ++i)
      if (i != k) others += slopes[i] * offsets[i];
    const Interval image(-others.hi(), std::numeric_limits<double>::infinity());
    if (image.contains(slopes[k] * offsets[k])) continue;  // no information
    const auto offset = divide(image, slopes[k], offsets[k]);
    if (!offset) return false;
    Interval side = x[j];
    if (!side.intersect(*offset + Interval(center[j]))) return false;
    projector.set(j, side);
  }
  return true;
}

}  // namespace

bool project(const CompiledSystem& system, int row, std::span<Interval> x, double share, std::uint8_t* changed) {
  const auto terms = system.terms(row);
  const std::size_t n = terms.size();
  Interval stack[2 * kMaxStackTerms + 1];
  std::vector<Interval> heap;
  Interval* value = stack;
  if (n > kMaxStackTerms) {
    heap.resize(2 * n + 1);
    value = heap.data();
  }
  Interval* suffix = value + n;  // suffix[k] = Σ_{j ≥ k} T_j
  suffix[n] = Interval();
  for (std::size_t k = n; k-- > 0;) {
    value[k] = system.evaluate(terms[k], x);
    suffix[k] = value[k] + suffix[k + 1];
  }
  const bool equation = system.is_equation(row);
  if (equation ? !suffix[0].contains_zero() : suffix[0].hi() < 0) return false;
  if (!equation && suffix[0].lo() >= 0) return true;  // holds on all of the box

  Projector projector(system, x, share, changed);
  Interval prefix;
  for (std::size_t k = 0; k < n; ++k) {
    Interval image = -(prefix + suffix[k + 1]);
    if (!equation) image = Interval(image.lo(), std::numeric_limits<double>::infinity());
    prefix += value[k];
    if (image.contains(value[k])) continue;  // no information
    if (!projector.invert(terms[k], image)) return false;
  }
  return equation || is_linear(terms) || project_by_slopes(system, row, x, projector);
}

}  // namespace corank::certify
