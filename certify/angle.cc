#include "corank/certify/angle.h"

#include <algorithm>
#include <cmath>

#include "corank/certify/multiprecision.h"

namespace corank::certify {
namespace {

// Wide enough that the only rounding that shows is nearly always the last one, to double. Wider is slower.
constexpr int kBits = 72;

// atan2(s, c) + 2πk, rounded in the direction `rounding` (RNDD or RNDU) at every step.
double angle(double c, double s, long k, mpfr_rnd_t rounding) {
  const Precision precision(kBits);
  Real x = c, y = s;  // exact
  mpfr_atan2(y.data(), y.data(), x.data(), rounding);
  if (k == 0) return mpfr_get_d(y.data(), rounding);
  Real turn;
  mpfr_const_pi(turn.data(), (k >= 0) == (rounding == MPFR_RNDU) ? MPFR_RNDU : MPFR_RNDD);
  mpfr_mul_si(turn.data(), turn.data(), 2 * k, rounding);
  mpfr_add(y.data(), y.data(), turn.data(), rounding);
  return mpfr_get_d(y.data(), rounding);
}

// A corner of the box with a number of extra turns.
struct Corner {
  double c, s;
  long turns = 0;
};

// Where the smallest and the largest angle are taken. By dθ = (c ds − s dc)/(c² + s²) the angle decreases with c where s > 0
// and increases where s < 0; it increases with s where c > 0 and decreases where c < 0. So over a box without the origin the
// extremes are at corners.
struct Extremes {
  Corner low, high;
};

Extremes extremes(const Interval& c, const Interval& s) {
  // The sign of a zero sine decides between −π and π in atan2: 0 is +0 but where said otherwise.
  const double cl = c.lo(), ch = c.hi(), sl = s.lo() == 0 ? 0.0 : s.lo(), sh = s.hi() == 0 ? 0.0 : s.hi();
  if (c.contains_zero() && s.contains_zero()) return {{-1.0, -0.0}, {-1.0, 0.0}};  // [−π, π]
  if (sl >= 0) return {{ch, ch > 0 ? sl : sh}, {cl, cl > 0 ? sh : sl}};
  if (ch < 0 && sh >= 0) {
    // Across the cut: the part above it is [low, π], the part below is one turn later, [π, high]. A box that only touches
    // the cut from below keeps to the lower side, [−π, high].
    const long turn = sh == 0 ? 0 : 1;
    return {{turn == 0 ? cl : ch, turn == 0 ? -0.0 : sh}, {ch, sl, turn}};
  }
  if (sh <= 0) return {{cl, cl > 0 ? sl : sh}, {ch, ch > 0 ? sh : sl}};
  return {{cl, sl}, {cl, sh}};  // c > 0, across the positive axis
}

Interval turned(const Extremes& e, long k) {
  return {angle(e.low.c, e.low.s, e.low.turns + k, MPFR_RNDD), angle(e.high.c, e.high.s, e.high.turns + k, MPFR_RNDU)};
}

// Length of the overlap; only for the choice of k.
double overlap(const Interval& x, const Interval& y) { return std::min(x.hi(), y.hi()) - std::max(x.lo(), y.lo()); }

}  // namespace

Interval angle_enclosure(const Interval& c, const Interval& s, const Interval& range) {
  const Extremes ends = extremes(c, s);
  Interval best = turned(ends, 0);
  const double turns = (0.5 * (range.lo() - best.lo()) + 0.5 * (range.hi() - best.hi())) / (2 * M_PI);
  if (range.contains(best) || !(std::fabs(turns) < 1e9)) return best;
  constexpr double kTie = 1e-9;
  for (const long nearest = std::lround(turns); const long k : {nearest, nearest - 1, nearest + 1}) {
    const Interval candidate = turned(ends, k);
    if (range.contains(candidate)) return candidate;
    if (overlap(candidate, range) > overlap(best, range) + kTie) best = candidate;
  }
  return best;
}

}  // namespace corank::certify
