// Intervals of MPFI (Revol, Rouillier 2005), which round outward: their memory, and nothing more.
#pragma once

#include <mpfi.h>
#include <mpfr.h>

namespace corank {

class Mpfi {
 public:
  explicit Mpfi(mpfr_prec_t bits) { mpfi_init2(x_, bits); }
  Mpfi(const Mpfi& o) : Mpfi(mpfi_get_prec(o.x_)) { mpfi_set(x_, o.x_); }
  /// o has no value afterwards, only what destroys it or assigns to it may follow.
  Mpfi(Mpfi&& o) noexcept {
    *x_ = *o.x_;  // MPFR's numbers may be moved bit by bit
    o.x_->left._mpfr_d = nullptr;
  }
  Mpfi& operator=(const Mpfi& o) {
    if (this == &o) return *this;
    if (!has_value()) mpfi_init2(x_, mpfi_get_prec(o.x_));
    mpfi_set(x_, o.x_);
    return *this;
  }
  Mpfi& operator=(Mpfi&& o) noexcept { return mpfi_swap(x_, o.x_), *this; }
  ~Mpfi() {
    if (has_value()) mpfi_clear(x_);
  }

  operator mpfi_ptr() { return x_; }
  operator mpfi_srcptr() const { return x_; }
  mpfr_srcptr lower() const { return &x_->left; }
  mpfr_srcptr upper() const { return &x_->right; }

 private:
  bool has_value() const { return x_->left._mpfr_d != nullptr; }  // not moved from

  mpfi_t x_;
};

}  // namespace corank
