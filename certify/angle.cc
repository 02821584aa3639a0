#include "corank/certify/angle.h"

#include <mpfr.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace corank::certify {
namespace {

// Wide enough that the only rounding that shows is the last one, to double.
constexpr mpfr_prec_t kBits = 160;

class Real {
 public:
  Real() { mpfr_init2(value_, kBits); }
  ~Real() { mpfr_clear(value_); }
  Real(const Real&) = delete;
  Real& operator=(const Real&) = delete;
  mpfr_ptr get() { return value_; }

 private:
  mpfr_t value_;
};

// atan2(s, c) + 2πk, rounded in the direction `rounding` (RNDD or RNDU) at every step.
double angle(double c, double s, long k, mpfr_rnd_t rounding) {
  Real x, y, turn;
  mpfr_set_d(x.get(), c, MPFR_RNDN);  // exact
  mpfr_set_d(y.get(), s, MPFR_RNDN);  // exact
  mpfr_atan2(y.get(), y.get(), x.get(), rounding);
  mpfr_const_pi(turn.get(), (k >= 0) == (rounding == MPFR_RNDU) ? MPFR_RNDU : MPFR_RNDD);
  mpfr_mul_si(turn.get(), turn.get(), 2 * k, rounding);
  mpfr_add(y.get(), y.get(), turn.get(), rounding);
  return mpfr_get_d(y.get(), rounding);
}

// A corner of the box with so many extra turns.
struct Corner {
  double c, s;
  long turns;
};

// Over a box without the origin the angle is monotone along every edge: its extremes are taken at corners.
struct Corners {
  std::vector<Corner> low, high;  // one of them has the smallest, the largest angle
};

Corners corners(const Interval& c, const Interval& s) {
  if (c.contains_zero() && s.contains_zero()) return {{{-1.0, -0.0, 0}}, {{-1.0, 0.0, 0}}};  // [−π, π]
  // The sign of a zero sine decides between −π and π in atan2: 0 is +0 but where said otherwise.
  const double sl = s.lo() == 0 ? 0.0 : s.lo(), sh = s.hi() == 0 ? 0.0 : s.hi();
  if (c.hi() < 0 && sl < 0 && sh >= 0) {
    // Across the cut: the part above it is [low, π], the part below is one turn later, [π, high]. A box that only touches the
    // cut from below keeps to the lower side, [−π, high].
    const long turn = sh == 0 ? 0 : 1;
    const double top = sh == 0 ? -0.0 : sh;
    return {{{c.lo(), top, 0}, {c.hi(), top, 0}}, {{c.lo(), sl, turn}, {c.hi(), sl, turn}}};
  }
  const std::vector<Corner> all{{c.lo(), sl, 0}, {c.lo(), sh, 0}, {c.hi(), sl, 0}, {c.hi(), sh, 0}};
  return {all, all};
}

Interval turned(const Corners& corners, long k) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Corner& p : corners.low) low = std::min(low, angle(p.c, p.s, p.turns + k, MPFR_RNDD));
  for (const Corner& p : corners.high) high = std::max(high, angle(p.c, p.s, p.turns + k, MPFR_RNDU));
  return {low, high};
}

// Length of the overlap; only for the choice of k.
double overlap(const Interval& x, const Interval& y) { return std::min(x.hi(), y.hi()) - std::max(x.lo(), y.lo()); }

}  // namespace

Interval angle_enclosure(const Interval& c, const Interval& s, const Interval& range) {
  const Corners extremes = corners(c, s);
  Interval best = turned(extremes, 0);
  const double turns = (0.5 * (range.lo() - best.lo()) + 0.5 * (range.hi() - best.hi())) / (2 * M_PI);
  if (range.contains(best) || !(std::fabs(turns) < 1e9)) return best;
  constexpr double kTie = 1e-9;
  for (const long nearest = std::lround(turns); const long k : {nearest, nearest - 1, nearest + 1}) {
    const Interval candidate = turned(extremes, k);
    if (range.contains(candidate)) return candidate;
    if (overlap(candidate, range) > overlap(best, range) + kTie) best = candidate;
  }
  return best;
}

}  // namespace corank::certify
