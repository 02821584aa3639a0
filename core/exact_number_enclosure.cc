// Enclosures of exact numbers with MPFI, whose operations round outward (Revol, Rouillier 2005): by induction over the
// expression, the interval computed for a node contains its value, where every function below is defined on the whole of its
// argument's interval.
#include <mpfi.h>
#include <mpfr.h>

#include <algorithm>
#include <cstdlib>
#include <deque>
#include <stdexcept>
#include <string>

#include "corank/core/exact_number_node.h"
#include "corank/core/nearest_rounding.h"

namespace corank {
namespace {

using Node = ExactNumber::Node;
using Kind = Node::Kind;
using NodePtr = std::shared_ptr<const Node>;

constexpr mpfr_exp_t kMaxTrigExponent = 65'536;  // sin(x) needs about log2|x| bits of pi
constexpr int kFirstBits = 128, kLastBits = 8192;

class Mpfi {
 public:
  explicit Mpfi(int precision) { mpfi_init2(x_, precision); }
  ~Mpfi() { mpfi_clear(x_); }
  Mpfi(const Mpfi&) = delete;
  Mpfi& operator=(const Mpfi&) = delete;
  operator mpfi_ptr() { return x_; }
  mpfr_srcptr lo() const { return &x_->left; }
  mpfr_srcptr hi() const { return &x_->right; }

 private:
  mpfi_t x_;
};

// More bits may decide what this precision cannot (is the divisor zero? is the radicand negative?).
struct Undecided : std::domain_error {
  using std::domain_error::domain_error;
};

void evaluate(Mpfi& result, const Node& x, int precision);

void evaluate_power(Mpfi& result, const Mpfi& base_in, int n, int precision) {
  Mpfi base(precision);
  mpfi_set(base, const_cast<Mpfi&>(base_in));
  if (n < 0) {
    if (mpfr_sgn(base.lo()) <= 0 && mpfr_sgn(base.hi()) >= 0) throw Undecided("a divisor cannot be distinguished from zero");
    mpfi_ui_div(base, 1, base);
  }
  mpfi_set_ui(result, 1);
  for (unsigned long m = static_cast<unsigned long>(std::labs(static_cast<long>(n))); m != 0; m >>= 1) {
    if (m & 1) mpfi_mul(result, result, base);
    if (m > 1) mpfi_sqr(base, base);
  }
}

void apply(Mpfi& result, ConstantFunction f, Mpfi& a, int precision);

// The few angles of a model occur in all of its coefficients: what was computed last of an argument is remembered.
void evaluate_function(Mpfi& result, const Node& x, int precision) {
  struct Known {
    Known(ConstantFunction f, int bits) : function(f), precision(bits), argument(bits), value(bits) {}
    ConstantFunction function;
    int precision;
    Mpfi argument, value;
  };
  constexpr std::size_t kMost = 16;
  thread_local std::deque<Known> known;
  Mpfi a(precision);
  evaluate(a, *x.operands[0], precision);
  for (Known& k : known)
    if (k.function == x.function && k.precision == precision && mpfr_equal_p(k.argument.lo(), a.lo()) &&
        mpfr_equal_p(k.argument.hi(), a.hi())) {
      mpfi_set(result, k.value);
      return;
    }
  apply(result, x.function, a, precision);
  Known& newest = known.emplace_front(x.function, precision);
  mpfi_set(newest.argument, a);
  mpfi_set(newest.value, result);
  if (known.size() > kMost) known.pop_back();
}

void apply(Mpfi& result, ConstantFunction f, Mpfi& a, int precision) {
  const std::string name = function_name(f);
  const auto trig_argument = [&] {
    for (mpfr_srcptr end : {a.lo(), a.hi()})
      if (!mpfr_number_p(end) || (!mpfr_zero_p(end) && mpfr_get_exp(end) > kMaxTrigExponent))
        throw std::domain_error("the argument of " + name + " is too large");
  };
  const auto unit_argument = [&] {
    if (mpfr_cmp_si(a.lo(), 1) > 0 || mpfr_cmp_si(a.hi(), -1) < 0)
      throw std::domain_error(name + " of a number outside [-1, 1]");
    if (mpfr_cmp_si(a.hi(), 1) > 0 || mpfr_cmp_si(a.lo(), -1) < 0)
      throw Undecided(name + " of a number that cannot be distinguished from one outside [-1, 1]");
  };
  switch (f) {
    case ConstantFunction::sqrt:
      if (mpfr_sgn(a.hi()) < 0) throw std::domain_error("sqrt of a negative number");
      if (mpfr_sgn(a.lo()) < 0) throw Undecided("sqrt of a number that cannot be distinguished from a negative one");
      mpfi_sqrt(result, a);
      break;
    case ConstantFunction::log:
      if (mpfr_sgn(a.hi()) < 0 || (mpfr_zero_p(a.lo()) && mpfr_zero_p(a.hi())))
        throw std::domain_error("log of a number that is not positive");
      if (mpfr_sgn(a.lo()) <= 0) throw Undecided("log of a number that cannot be distinguished from zero");
      mpfi_log(result, a);
      break;
    case ConstantFunction::sin: trig_argument(), mpfi_sin(result, a); break;
    case ConstantFunction::cos: trig_argument(), mpfi_cos(result, a); break;
    case ConstantFunction::tan: {
      // sin/cos rather than mpfi_tan: a pole then shows as a divisor that may be zero.
      trig_argument();
      Mpfi c(precision);
      mpfi_cos(c, a);
      if (mpfr_sgn(c.lo()) <= 0 && mpfr_sgn(c.hi()) >= 0)
        throw Undecided("tan at a number that cannot be distinguished from a pole");
      mpfi_sin(result, a);
      mpfi_div(result, result, c);
      break;
    }
    case ConstantFunction::asin: unit_argument(), mpfi_asin(result, a); break;
    case ConstantFunction::acos: unit_argument(), mpfi_acos(result, a); break;
    case ConstantFunction::atan: mpfi_atan(result, a); break;
    case ConstantFunction::exp: mpfi_exp(result, a); break;
    case ConstantFunction::abs: mpfi_abs(result, a); break;
  }
}

void evaluate(Mpfi& result, const Node& x, int precision) {
  switch (x.kind) {
    case Kind::rational: mpfi_set_q(result, x.value.get_mpq_t()); break;
    case Kind::pi: mpfi_const_pi(result); break;
    case Kind::sum:
    case Kind::product: {
      mpfi_set_q(result, x.value.get_mpq_t());
      Mpfi part(precision);
      for (const NodePtr& operand : x.operands) {
        evaluate(part, *operand, precision);
        x.kind == Kind::sum ? mpfi_add(result, result, part) : mpfi_mul(result, result, part);
      }
      break;
    }
    case Kind::power: {
      Mpfi base(precision);
      evaluate(base, *x.operands[0], precision);
      evaluate_power(result, base, x.exponent, precision);
      break;
    }
    case Kind::function: evaluate_function(result, x, precision); break;
  }
  if (mpfr_nan_p(result.lo()) || mpfr_nan_p(result.hi())) throw Undecided("an undefined operation on unbounded numbers");
}

// The enclosure is so narrow that rounding it outward to doubles adds all the width that counts: width ≤ 2⁻⁶² of the
// magnitude.
bool narrow(const Mpfi& x) {
  if (!mpfr_number_p(x.lo()) || !mpfr_number_p(x.hi())) return false;
  if (mpfr_equal_p(x.lo(), x.hi())) return true;
  if (mpfr_sgn(x.lo()) != mpfr_sgn(x.hi())) return false;
  Mpfi width(64);
  mpfi_set_fr(width, x.hi());
  mpfi_sub_fr(width, width, x.lo());
  const mpfr_srcptr smaller = mpfr_cmpabs(x.lo(), x.hi()) < 0 ? x.lo() : x.hi();
  return mpfr_get_exp(width.hi()) <= mpfr_get_exp(smaller) - 62;
}

Interval outward(const Mpfi& x) { return {mpfr_get_d(x.lo(), MPFR_RNDD), mpfr_get_d(x.hi(), MPFR_RNDU)}; }

}  // namespace

Interval ExactNumber::enclose() const {
  const NearestRounding nearest;
  if (is_rational()) {
    // 53 bits rounded downward (upward), then to a double in the same direction: the grid of the second rounding is part of
    // the first one's, so the pair is the narrowest.
    Mpfi x(53);
    mpfi_set_q(x, node_->value.get_mpq_t());
    return outward(x);
  }
  for (int precision = kFirstBits;; precision *= 2) {
    try {
      Mpfi x(precision);
      evaluate(x, *node_, precision);
      if (narrow(x) || 2 * precision > kLastBits) return outward(x);
    } catch (const Undecided& undecided) {
      if (2 * precision > kLastBits) throw std::domain_error(text() + " is not a real number: " + undecided.what());
    } catch (const std::domain_error& error) {
      throw std::domain_error(text() + " is not a real number: " + error.what());
    }
  }
}

std::pair<ExactNumber, ExactNumber> ExactNumber::bounds(int bits) const {
  if (is_rational()) return {*this, *this};
  const NearestRounding nearest;
  constexpr int kGuardBits = 32;
  const auto rational_of = [](mpfr_srcptr end) {
    if (!mpfr_number_p(end)) throw Undecided("a number of unknown size");
    mpq_class q;
    mpfr_get_q(q.get_mpq_t(), end);
    return Node::number(std::move(q));
  };
  for (int precision = bits + kGuardBits;; precision *= 2) {
    try {
      Mpfi x(precision);
      evaluate(x, *node_, precision);
      return {rational_of(x.lo()), rational_of(x.hi())};
    } catch (const Undecided& undecided) {
      if (2 * precision > std::max(kLastBits, 2 * bits))
        throw std::domain_error(text() + " is not a real number: " + undecided.what());
    } catch (const std::domain_error& error) {
      throw std::domain_error(text() + " is not a real number: " + error.what());
    }
  }
}

std::optional<int> ExactNumber::sign(int max_bits) const {
  if (is_rational()) return sgn(node_->value);
  const NearestRounding nearest;
  for (int precision = 64; precision <= std::max(64, max_bits); precision *= 2) {
    try {
      Mpfi x(precision);
      evaluate(x, *node_, precision);
      if (mpfr_sgn(x.lo()) > 0) return 1;
      if (mpfr_sgn(x.hi()) < 0) return -1;
      if (mpfr_zero_p(x.lo()) && mpfr_zero_p(x.hi())) return 0;
    } catch (const Undecided&) {
    } catch (const std::domain_error& error) {
      throw std::domain_error(text() + " is not a real number: " + error.what());
    }
  }
  return std::nullopt;
}

}  // namespace corank
