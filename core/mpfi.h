// Intervals of MPFI (Revol, Rouillier 2005), which round outward: their memory, and nothing more.
#pragma once

#include <mpfi.h>
#include <mpfr.h>

#include <vector>

namespace corank {

/// Memory of numbers of kStoredBits bits is used again: taking it from the system and giving it back costs as much as
/// computing with it.
class Mpfi {
 public:
  static constexpr mpfr_prec_t kStoredBits = 160;  // of the checker's

  explicit Mpfi(mpfr_prec_t bits) {
    if (bits != kStoredBits || !Store::take(*x_)) mpfi_init2(x_, bits);
  }
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
    if (has_value() && !(mpfi_get_prec(x_) == kStoredBits && Store::keep(*x_))) mpfi_clear(x_);
  }

  operator mpfi_ptr() { return x_; }
  operator mpfi_srcptr() const { return x_; }
  mpfr_srcptr lower() const { return &x_->left; }
  mpfr_srcptr upper() const { return &x_->right; }

 private:
  // A thread's numbers that nobody uses.
  class Store {
   public:
    static bool take(__mpfi_struct& x) {
      std::vector<__mpfi_struct>* free = of_thread();
      if (!free || free->empty()) return false;
      x = free->back();
      free->pop_back();
      return true;
    }
    static bool keep(__mpfi_struct& x) {
      std::vector<__mpfi_struct>* free = of_thread();
      if (!free || free->size() == kMost) return false;
      free->push_back(x);
      return true;
    }

   private:
    static constexpr std::size_t kMost = 4096;

    Store() { free_.reserve(kMost); }
    ~Store() {
      for (__mpfi_struct& x : free_) mpfi_clear(&x);
      ended() = true;
    }
    // Null where the thread has ended: the numbers of static objects live longer.
    static std::vector<__mpfi_struct>* of_thread() {
      if (ended()) return nullptr;
      thread_local Store store;
      return &store.free_;
    }
    static bool& ended() {
      thread_local bool value = false;
      return value;
    }

    std::vector<__mpfi_struct> free_;
  };

  bool has_value() const { return x_->left._mpfr_d != nullptr; }  // not moved from

  mpfi_t x_;
};

}  // namespace corank
