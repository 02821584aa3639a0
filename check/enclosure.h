// The checker's intervals: MPFI at kBits bits, which rounds every operation outward. Nothing here is shared with
// core/interval.h but doubles, and no rounding mode of the processor matters. core/mpfi.h, which certify/ uses, too,
// holds the memory of the two ends and computes nothing.
//
// The empty set is no Enclosure: what may yield it returns false or nothing.
#pragma once

#include <limits>
#include <optional>
#include <utility>

#include "corank/core/exact_number.h"
#include "corank/core/interval.h"
#include "corank/core/mpfi.h"
#include "corank/core/nearest_rounding.h"

namespace corank::check {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

class Enclosure {
 public:
  static constexpr int kBits = Mpfi::kStoredBits;

  Enclosure() : Enclosure(0.0) {}
  /*implicit*/ Enclosure(double point) { mpfi_set_d(x_, point); }
  Enclosure(double lo, double hi);
  explicit Enclosure(const Interval& x) : Enclosure(x.lo(), x.hi()) {}
  /// Contains the number.
  explicit Enclosure(const ExactNumber& x);
  explicit operator Interval() const { return {lo(), hi()}; }  ///< contains it
  static Enclosure whole() { return {-kInfinity, kInfinity}; }
  static Enclosure pi();

  Enclosure& operator+=(const Enclosure& x) { return mpfi_add(x_, x_, x.x_), *this; }
  Enclosure& operator-=(const Enclosure& x) { return mpfi_sub(x_, x_, x.x_), *this; }
  Enclosure& operator*=(const Enclosure& x) { return mpfi_mul(x_, x_, x.x_), *this; }
  friend Enclosure operator+(const Enclosure& x, const Enclosure& y) { return made(mpfi_add, x, y); }
  friend Enclosure operator-(const Enclosure& x, const Enclosure& y) { return made(mpfi_sub, x, y); }
  friend Enclosure operator*(const Enclosure& x, const Enclosure& y) { return made(mpfi_mul, x, y); }
  friend Enclosure operator-(const Enclosure& x) { return Enclosure(0.0) - x; }
  /// this += a·x, this += a·x with a point a.
  void add_product(const Enclosure& a, const Enclosure& x);
  void add_product(double a, const Enclosure& x);

  double lo() const { return mpfr_get_d(x_.lower(), MPFR_RNDD); }    ///< at most the lower end
  double hi() const { return mpfr_get_d(x_.upper(), MPFR_RNDU); }    ///< at least the upper end
  double mid() const;                                                ///< a double near the middle
  double width() const { return (upper_end() - lower_end()).hi(); }  ///< at least the upper end − the lower end
  double mag() const;                                                ///< at least max |x|
  double mig() const;                                                ///< at most min |x|
  bool is_bounded() const { return mpfi_bounded_p(x_) != 0; }
  bool is_zero() const { return mpfi_is_zero(x_) > 0; }  ///< [0, 0]
  bool has_zero() const { return mpfi_has_zero(x_) > 0; }
  bool is_nonnegative() const { return mpfr_sgn(x_.lower()) >= 0; }
  bool is_positive() const { return mpfr_sgn(x_.lower()) > 0; }
  bool is_negative() const { return mpfr_sgn(x_.upper()) < 0; }
  bool may_be_nonnegative() const { return mpfr_sgn(x_.upper()) >= 0; }
  bool inside(const Enclosure& x) const { return mpfi_is_inside(x_, x.x_) > 0; }  ///< a subset of x
  bool strictly_inside(const Enclosure& x) const;                                 ///< of the interior of x
  bool inside(const Interval& x) const;
  bool overlaps(const Enclosure& x) const;
  bool overlaps(const Interval& x) const;
  /// Is every number of this ≤ (<) every one of x?
  bool at_most(const Enclosure& x) const { return mpfr_lessequal_p(x_.upper(), x.x_.lower()) != 0; }
  bool below(const Enclosure& x) const { return mpfr_less_p(x_.upper(), x.x_.lower()) != 0; }

  /// this := this ∩ x; false, and unchanged, where that is empty.
  bool intersect(const Enclosure& x);
  bool intersect(const std::optional<Enclosure>& x) { return x && intersect(*x); }
  static Enclosure hull(const Enclosure& x, const Enclosure& y) { return made(mpfi_union, x, y); }
  /// The smallest and the greatest number.
  Enclosure lower_end() const;
  Enclosure upper_end() const;

  friend Enclosure power(const Enclosure& x, int p);
  friend Enclosure sine(const Enclosure& x);
  friend Enclosure cosine(const Enclosure& x);
  friend Enclosure quotient(const Enclosure& x, const Enclosure& y);  ///< y has no 0
  friend Enclosure square_root(const Enclosure& x);                   ///< of the nonnegative part, which is not empty
  friend Enclosure arc_cosine(const Enclosure& x);                    ///< x within [−1, 1]

 private:
  explicit Enclosure(Mpfi x) : x_(std::move(x)) {}
  static Enclosure made(auto operation, const auto&... x) {
    Mpfi result(kBits);
    operation(result, x.x_...);
    return Enclosure(std::move(result));
  }

  Mpfi x_{kBits};
};

/// hull{x ∈ within : d·x = n for some n ∈ num, d ∈ den}; nothing where that is empty.
std::optional<Enclosure> divide(const Enclosure& num, const Enclosure& den, const Enclosure& within);
/// hull{x ∈ within : xᵖ ∈ y}, p ≥ 1.
std::optional<Enclosure> root(const Enclosure& y, int p, const Enclosure& within);
/// hull{x ∈ within : cos x ∈ y}, hull{x ∈ within : sin x ∈ y}: cos x ∈ y ⇔ x ∈ ∪ₖ (2πk − A) ∪ (2πk + A), A = acos(y ∩ [−1,
/// 1]).
std::optional<Enclosure> inverse_cosine(const Enclosure& y, const Enclosure& within);
std::optional<Enclosure> inverse_sine(const Enclosure& y, const Enclosure& within);

}  // namespace corank::check
