// Closed intervals [lo, hi] of real numbers with double endpoints.
//
// Representation: the pair (−lo, hi) in one 128-bit register, so that under *upward* rounding both endpoints of a sum, a
// product … are rounded outward by the same instruction and no rounding mode is ever switched (Goualard, "Fast and correct
// SIMD algorithms for interval arithmetic", 2008). Precondition of every arithmetic operation: UpwardRounding::active().
//
// Fundamental theorem of interval arithmetic (Moore, Kearfott, Cloud 2009, Thm 5.1): for x ∈ X and y ∈ Y, x∘y ∈ X∘Y for each
// operation here, whatever the overflow or underflow. The empty set is not an Interval: operations that may yield it return
// false or std::nullopt. An endpoint may be infinite, never NaN.
#pragma once

#include <emmintrin.h>

#include <algorithm>
#include <cmath>
#include <iosfwd>
#include <limits>
#include <optional>

namespace corank {

class Interval {
 public:
  Interval() : data_(_mm_setzero_pd()) {}
  /*implicit*/ Interval(double point) : data_(_mm_set_pd(point, -point)) {}
  /// [lo, hi]; requires lo ≤ hi, neither NaN.
  Interval(double lo, double hi) : data_(_mm_set_pd(hi, -lo)) {}

  static Interval whole() {
    constexpr double kInf = std::numeric_limits<double>::infinity();
    return {-kInf, kInf};
  }
  /// Wraps the register (−lo, hi).
  static Interval from_register(__m128d data) {
    Interval x;
    x.data_ = data;
    return x;
  }
  __m128d data() const { return data_; }

  double neg_lo() const { return _mm_cvtsd_f64(data_); }
  double lo() const { return -neg_lo(); }
  double hi() const { return _mm_cvtsd_f64(_mm_unpackhi_pd(data_, data_)); }

  /// Upper bound of hi − lo (rounded upward).
  double width() const { return hi() + neg_lo(); }
  /// A double in [lo, hi] near the middle (not exact; finite for bounded intervals).
  double mid() const {
    const double m = 0.5 * hi() - 0.5 * neg_lo();
    return std::clamp(m, lo(), hi());
  }
  /// max |x| over the interval.
  double mag() const { return std::max(neg_lo(), hi()); }
  /// min |x| over the interval.
  double mig() const { return std::max({0.0, lo(), -hi()}); }

  bool contains(double x) const { return lo() <= x && x <= hi(); }
  bool contains(const Interval& x) const { return lo() <= x.lo() && x.hi() <= hi(); }
  /// x lies in the interior of this interval.
  bool strictly_contains(const Interval& x) const { return lo() < x.lo() && x.hi() < hi(); }
  bool contains_zero() const { return lo() <= 0.0 && 0.0 <= hi(); }
  bool is_point() const { return lo() == hi(); }
  bool is_bounded() const { return std::isfinite(lo()) && std::isfinite(hi()); }
  bool overlaps(const Interval& x) const { return lo() <= x.hi() && x.lo() <= hi(); }

  /// this := this ∩ x. Returns false, and leaves this unchanged, where the intersection is empty.
  bool intersect(const Interval& x) {
    const __m128d meet = _mm_min_pd(data_, x.data_);
    const Interval candidate = from_register(meet);
    if (candidate.lo() > candidate.hi()) return false;
    data_ = meet;
    return true;
  }
  /// The smallest interval that holds both.
  static Interval hull(const Interval& x, const Interval& y) { return from_register(_mm_max_pd(x.data_, y.data_)); }

  friend Interval operator-(const Interval& x) { return from_register(_mm_shuffle_pd(x.data_, x.data_, 1)); }
  friend Interval operator+(const Interval& x, const Interval& y) { return from_register(_mm_add_pd(x.data_, y.data_)); }
  friend Interval operator-(const Interval& x, const Interval& y) { return x + (-y); }
  friend Interval operator*(const Interval& x, const Interval& y);
  Interval& operator+=(const Interval& y) { return *this = *this + y; }
  Interval& operator-=(const Interval& y) { return *this = *this - y; }
  Interval& operator*=(const Interval& y) { return *this = *this * y; }
  friend bool operator==(const Interval& x, const Interval& y) { return x.lo() == y.lo() && x.hi() == y.hi(); }

 private:
  __m128d data_;
};

namespace internal {
/// Products of endpoints, with +∞ for the NaN of 0·∞ (minpd returns its second operand where the first is NaN): an upper
/// bound.
inline __m128d bounded_product(__m128d a, __m128d b) {
  return _mm_min_pd(_mm_mul_pd(a, b), _mm_set1_pd(std::numeric_limits<double>::infinity()));
}
inline __m128d swapped(__m128d a) { return _mm_shuffle_pd(a, a, 1); }
}  // namespace internal

inline Interval operator*(const Interval& x, const Interval& y) {
  // hi is the largest of the four products of endpoints, −lo the largest of the four negated ones. A NaN (0·∞, which stands
  // for 0) in p1 or p3 is dropped, since maxpd returns its second operand: by cases, one of the others is then 0, or is the
  // +∞ that stands for a NaN in p2 or p4.
  const __m128d a = x.data();                                                 // (−a, b)   for x = [a, b]
  const __m128d a_neg = _mm_xor_pd(internal::swapped(a), _mm_set1_pd(-0.0));  // (−b, a)
  const __m128d c = _mm_xor_pd(y.data(), _mm_set_pd(0.0, -0.0));              // (c, d)    for y = [c, d]
  const __m128d c_swap = internal::swapped(c);                                // (d, c)
  const __m128d p1 = _mm_mul_pd(a, c);                                        // (−ac, bd)
  const __m128d p2 = internal::bounded_product(a, c_swap);                    // (−ad, bc)
  const __m128d p3 = _mm_mul_pd(a_neg, c);                                    // (−bc, ad)
  const __m128d p4 = internal::bounded_product(a_neg, c_swap);                // (−bd, ac)
  return Interval::from_register(_mm_max_pd(_mm_max_pd(p1, p2), _mm_max_pd(p3, p4)));
}

/// point · X, for a finite point.
inline Interval scale(double point, const Interval& x) {
  const __m128d data = point < 0 ? internal::swapped(x.data()) : x.data();
  return Interval::from_register(internal::bounded_product(_mm_set1_pd(std::fabs(point)), data));
}

/// {x² : x ∈ X}.
inline Interval square(const Interval& x) {
  const __m128d a = x.data(), b = internal::swapped(a);
  const __m128d ends = _mm_move_sd(_mm_max_pd(a, b), _mm_min_pd(a, b));  // (min(−lo, hi), max |x|)
  const __m128d sizes = _mm_min_sd(ends, _mm_set1_pd(-0.0));             // (−min |x|, max |x|)
  return Interval::from_register(_mm_mul_pd(sizes, _mm_xor_pd(sizes, _mm_set_pd(0.0, -0.0))));
}

/// {xᵖ : x ∈ X}, p ≥ 0.
Interval power(const Interval& x, int p);
/// {√x : x ∈ X, x ≥ 0}; nothing where X < 0.
std::optional<Interval> square_root(const Interval& x);
/// {x : xᵖ ∈ X} ∩ within, p ≥ 1 (hull over both signs for even p); nothing where that is empty.
std::optional<Interval> root(const Interval& x, int p, const Interval& within);
/// hull{x ∈ within : d·x = n for some n ∈ num, d ∈ den}: extended division; nothing where that is empty.
std::optional<Interval> divide(const Interval& num, const Interval& den, const Interval& within);

/// 1 or −1, the sign of all its numbers; 0: they have not one, or 0 is among them.
inline int sign_of(const Interval& x) { return x.lo() > 0 ? 1 : x.hi() < 0 ? -1 : 0; }

std::ostream& operator<<(std::ostream& out, const Interval& x);

}  // namespace corank
