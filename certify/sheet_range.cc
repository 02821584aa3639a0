#include "corank/certify/sheet_range.h"

#include <algorithm>
#include <map>

#include "corank/certify/slope_matrix.h"
#include "corank/core/box.h"
#include "corank/core/check.h"
#include "corank/core/rounding.h"

namespace corank::certify {
namespace {

constexpr int kTightenings = 2;            // of a face
constexpr double kRoomAtEnds = 1.0 / 128;  // of a range, left at its ends at least

class FaceRange {
 public:
  FaceRange(const CompiledSystem& system, const Preconditioner& p, const std::vector<double>& widths,
            std::vector<Interval>& piece, NewtonWorkspace& w)
      : system_(system),
        p_(p),
        piece_(piece),
        w_(w),
        n_(system.variables()),
        r_(p.rank()),
        widths_(widths),
        free_(all_but(p.dependent, system.variables())) {}

  void shrink() {
    if (free_.empty() || !differentiate()) return;
    std::vector<Interval> along(free_.size());
    for (std::size_t a = 0; a < r_; ++a) {
      const std::size_t side = p_.dependent[a];
      if (piece_[side].width() <= widths_[side]) continue;
      for (std::size_t f = 0; f < free_.size(); ++f) along[f] = derivatives_[a * free_.size() + f];
      shrink(side, widths_[side], along);
    }
    for (int k = 0; k < system_.values(); ++k) {
      const std::size_t side = n_ + k;
      if (piece_[side].width() <= widths_[side]) continue;
      differentiate(system_.value_row(k), along);
      shrink(side, widths_[side], along);
    }
  }

 private:
  // −1, 1: the free variable is at the lower, upper end; 0: anywhere.
  using Face = std::vector<int>;

  // derivatives_[a·k + f] ∋ ∂(dependent a)/∂(free f) on the sheet over the piece. False: no bound.
  bool differentiate() {
    slope_.resize(system_.entries());
    system_.jacobian(piece_, slope_);
    panel_.set_matrix(p_.y, p_.rank());
    if (!panel_.assign_product(system_, p_.equations, slope_)) return false;
    magnitude_.resize(r_ * r_);
    for (std::size_t a = 0; a < r_; ++a)
      for (std::size_t b = 0; b < r_; ++b)
        magnitude_[a * r_ + b] = (Interval(a == b ? 1.0 : 0.0) - panel_.at(static_cast<int>(a), p_.dependent[b])).mag();
    derivatives_.assign(r_ * free_.size(), Interval());
    for (std::size_t f = 0; f < free_.size(); ++f)
      if (!differentiate(f)) return false;
    return true;
  }

  bool differentiate(std::size_t f) {
    constexpr int kSteps = 12;
    const auto slope = [&](std::size_t a) { return panel_.at(static_cast<int>(a), free_[f]); };
    const auto scale = [&](std::size_t a) { return system_.scales()[p_.dependent[a]]; };
    double largest = 1e-300;
    for (std::size_t a = 0; a < r_; ++a) largest = std::max(largest, slope(a).mag() / scale(a));
    std::vector<double> v(r_), bound(r_);  // bound: upper bounds, by upward rounding, of E·v
    for (std::size_t a = 0; a < r_; ++a) v[a] = largest * scale(a);
    for (int step = 0; step < kSteps; ++step) {
      bool holds = true;
      for (std::size_t a = 0; a < r_; ++a) {
        bound[a] = 0;
        for (std::size_t b = 0; b < r_; ++b) bound[a] += magnitude_[a * r_ + b] * v[b];
        holds = holds && bound[a] + slope(a).mag() < v[a];
      }
      if (holds) {
        for (std::size_t a = 0; a < r_; ++a) derivatives_[a * free_.size() + f] = -slope(a) + Interval(-bound[a], bound[a]);
        return true;
      }
      for (std::size_t a = 0; a < r_; ++a) {
        v[a] = 1.05 * (bound[a] + slope(a).mag()) + 1e-3 * largest * scale(a);
        if (!std::isfinite(v[a])) return false;
      }
    }
    return false;
  }

  // along[f] ∋ the derivative of a value row.
  void differentiate(int row, std::vector<Interval>& along) {
    system_.jacobian(row, piece_, slope_);
    gradient_.assign(n_, Interval());
    for (int e = system_.row_begin(row); e < system_.row_begin(row + 1); ++e) gradient_[system_.column(e)] = slope_[e];
    for (std::size_t f = 0; f < free_.size(); ++f) {
      along[f] = gradient_[free_[f]];
      for (std::size_t a = 0; a < r_; ++a) along[f] += gradient_[p_.dependent[a]] * derivatives_[a * free_.size() + f];
    }
  }

  void shrink(std::size_t side, double width, const std::vector<Interval>& along) {
    Face up(free_.size(), 0), down(free_.size(), 0);
    for (std::size_t f = 0; f < free_.size(); ++f) {
      if (along[f].lo() >= 0) {
        up[f] = 1, down[f] = -1;
      } else if (along[f].hi() <= 0) {
        up[f] = -1, down[f] = 1;
      }
    }
    if (up == down) return;  // monotone in no variable
    const double lower = over(down)[side].lo(), upper = over(up)[side].hi();
    CORANK_CHECK(lower <= upper);  // the sheet has solutions
    const double room = std::max(kRoomAtEnds * (upper - lower), 0.49 * (width - (upper - lower)));
    CORANK_CHECK(piece_[side].intersect(Interval(lower, upper) + Interval(-room, room)));
  }

  // What the sides are over a face.
  const std::vector<Interval>& over(const Face& face) {
    const auto [at, is_new] = faces_.try_emplace(face);
    if (!is_new) return at->second;
    std::vector<Interval> x(piece_.begin(), piece_.begin() + n_);
    for (std::size_t f = 0; f < free_.size(); ++f) {
      Interval& side = x[free_[f]];
      if (face[f] != 0) side = Interval(face[f] > 0 ? side.hi() : side.lo());
    }
    NewtonStep step = tighten_sheet(system_, p_, x, w_);
    for (int k = 1; k < kTightenings; ++k) step = tighten_sheet(system_, p_, x, w_);
    for (int k = 0; k < system_.values(); ++k) {
      const int row = system_.value_row(k);
      Interval value = system_.evaluate(row, x);
      if (piece_[x.size()].width() > widths_[x.size()]) CORANK_CHECK(value.intersect(step.value_at_zeros(row, x)));
      x.push_back(value);
    }
    return at->second = std::move(x);
  }

  const CompiledSystem& system_;
  const Preconditioner& p_;
  std::vector<Interval>& piece_;
  NewtonWorkspace& w_;
  SlopeMatrix panel_;
  const std::size_t n_, r_;
  const std::vector<double>& widths_;
  const std::vector<int> free_;
  std::vector<double> magnitude_;
  std::vector<Interval> slope_, derivatives_, gradient_;
  std::map<Face, std::vector<Interval>> faces_;
};

}  // namespace

void shrink_to_faces(const CompiledSystem& system, const Sheet& sheet, const Preconditioner& p,
                     const std::vector<double>& widths, std::vector<Interval>& piece, NewtonWorkspace& w) {
  CORANK_CHECK(UpwardRounding::active());
  CORANK_CHECK(piece.size() == static_cast<std::size_t>(system.variables() + system.values()));
  CORANK_CHECK(widths.size() == piece.size());
  // The hypotheses about the sheet.
  CORANK_CHECK(sheet.proven && sheet.region.size() == static_cast<std::size_t>(system.variables()));
  CORANK_CHECK(std::ranges::is_permutation(p.dependent, sheet.dependent));
  CORANK_CHECK(std::ranges::is_permutation(p.equations, sheet.equations));
  CORANK_CHECK(contains(sheet.region, piece));
  FaceRange(system, p, widths, piece, w).shrink();
}

}  // namespace corank::certify
