// Enclosures of exact numbers with MPFI, whose operations round outward: by induction over the expression, the interval
// computed for a node contains its value, where every function below is defined on the whole of its argument's interval.
#include <algorithm>
#include <cstdlib>
#include <deque>
#include <stdexcept>
#include <string>
#include <utility>

#include "corank/core/exact_number_node.h"
#include "corank/core/mpfi.h"
#include "corank/core/nearest_rounding.h"

namespace corank {
namespace {

using Node = ExactNumber::Node;
using Kind = Node::Kind;
using NodePtr = std::shared_ptr<const Node>;

constexpr mpfr_exp_t kMaxTrigExponent = 65'536;  // sin(x) needs about log2|x| bits of pi
constexpr int kFirstBits = 128, kLastBits = 8192;

// More bits may decide what this precision cannot (is the divisor zero? is the radicand negative?).
struct Undecided : std::domain_error {
  using std::domain_error::domain_error;
};

void evaluate(Mpfi& result, const Node& x, int precision);

void evaluate_power(Mpfi& result, Mpfi base, int n) {
  if (n < 0) {
    if (mpfr_sgn(base.lower()) <= 0 && mpfr_sgn(base.upper()) >= 0)
      throw Undecided("a divisor cannot be distinguished from zero");
    mpfi_ui_div(base, 1, base);
  }
  mpfi_set_ui(result, 1);
  for (long m = std::labs(n); m != 0; m >>= 1) {
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
    if (k.function == x.function && k.precision == precision && mpfr_equal_p(k.argument.lower(), a.lower()) &&
        mpfr_equal_p(k.argument.upper(), a.upper())) {
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
    for (mpfr_srcptr end : {a.lower(), a.upper()})
      if (!mpfr_number_p(end) || (!mpfr_zero_p(end) && mpfr_get_exp(end) > kMaxTrigExponent))
        throw std::domain_error("the argument of " + name + " is too large");
  };
  const auto unit_argument = [&] {
    if (mpfr_cmp_si(a.lower(), 1) > 0 || mpfr_cmp_si(a.upper(), -1) < 0)
      throw std::domain_error(name + " of a number outside [-1, 1]");
    if (mpfr_cmp_si(a.upper(), 1) > 0 || mpfr_cmp_si(a.lower(), -1) < 0)
      throw Undecided(name + " of a number that cannot be distinguished from one outside [-1, 1]");
  };
  switch (f) {
    case ConstantFunction::sqrt:
      if (mpfr_sgn(a.upper()) < 0) throw std::domain_error("sqrt of a negative number");
      if (mpfr_sgn(a.lower()) < 0) throw Undecided("sqrt of a number that cannot be distinguished from a negative one");
      mpfi_sqrt(result, a);
      break;
    case ConstantFunction::log:
      if (mpfr_sgn(a.upper()) < 0 || (mpfr_zero_p(a.lower()) && mpfr_zero_p(a.upper())))
        throw std::domain_error("log of a number that is not positive");
      if (mpfr_sgn(a.lower()) <= 0) throw Undecided("log of a number that cannot be distinguished from zero");
      mpfi_log(result, a);
      break;
    case ConstantFunction::sin: trig_argument(), mpfi_sin(result, a); break;
    case ConstantFunction::cos: trig_argument(), mpfi_cos(result, a); break;
    case ConstantFunction::tan: {
      // sin/cos rather than mpfi_tan: a pole then shows as a divisor that may be zero.
      trig_argument();
      Mpfi c(precision);
      mpfi_cos(c, a);
      if (mpfr_sgn(c.lower()) <= 0 && mpfr_sgn(c.upper()) >= 0)
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
      evaluate_power(result, std::move(base), x.exponent);
      break;
    }
    case Kind::function: evaluate_function(result, x, precision); break;
  }
  if (mpfr_nan_p(result.lower()) || mpfr_nan_p(result.upper()))
    throw Undecided("an undefined operation on unbounded numbers");
}

// The enclosure is so narrow that rounding it outward to doubles adds all the width that counts: width ≤ 2⁻⁶² of the
// magnitude.
bool narrow(const Mpfi& x) {
  if (!mpfr_number_p(x.lower()) || !mpfr_number_p(x.upper())) return false;
  if (mpfr_equal_p(x.lower(), x.upper())) return true;
  if (mpfr_sgn(x.lower()) != mpfr_sgn(x.upper())) return false;
  Mpfi width(64);
  mpfi_set_fr(width, x.upper());
  mpfi_sub_fr(width, width, x.lower());
  const mpfr_srcptr smaller = mpfr_cmpabs(x.lower(), x.upper()) < 0 ? x.lower() : x.upper();
  return mpfr_get_exp(width.upper()) <= mpfr_get_exp(smaller) - 62;
}

Interval outward(const Mpfi& x) { return {mpfr_get_d(x.lower(), MPFR_RNDD), mpfr_get_d(x.upper(), MPFR_RNDU)}; }

// The first answer of `found` about an enclosure of x. The first enclosure has `bits` bits, each further one twice as many,
// the last one at most `last`. `found` is told which is the last; of the others it says nothing if more bits are to decide.
template <class Found>
auto in_enclosures(const ExactNumber& x, int bits, int last, Found found) {
  const NearestRounding nearest;
  for (;; bits *= 2) {
    const bool is_last = 2 * bits > last;
    try {
      Mpfi enclosure(bits);
      evaluate(enclosure, x.node(), bits);
      if (const auto answer = found(enclosure, is_last); answer || is_last) return answer;
    } catch (const Undecided& undecided) {
      if (is_last) throw Undecided(x.text() + " is not a real number: " + undecided.what());
    } catch (const std::domain_error& error) {
      throw std::domain_error(x.text() + " is not a real number: " + error.what());
    }
  }
}

}  // namespace

Interval ExactNumber::enclose() const {
  if (is_rational()) {
    const NearestRounding nearest;
    // 53 bits rounded downward (upward), then to a double in the same direction: the grid of the second rounding is part of
    // the first one's, so the pair is the narrowest.
    Mpfi x(53);
    mpfi_set_q(x, node_->value.get_mpq_t());
    return outward(x);
  }
  return *in_enclosures(*this, kFirstBits, kLastBits, [](const Mpfi& x, bool is_last) {
    return narrow(x) || is_last ? std::optional(outward(x)) : std::nullopt;
  });
}

std::pair<ExactNumber, ExactNumber> ExactNumber::bounds(int bits) const {
  if (is_rational()) return {*this, *this};
  constexpr int kGuardBits = 32;
  const auto rational_of = [](mpfr_srcptr end) {
    if (!mpfr_number_p(end)) throw Undecided("a number of unknown size");
    mpq_class q;
    mpfr_get_q(q.get_mpq_t(), end);
    return Node::number(std::move(q));
  };
  return *in_enclosures(*this, bits + kGuardBits, std::max(kLastBits, 2 * bits), [&](const Mpfi& x, bool) {
    return std::optional(std::pair(rational_of(x.lower()), rational_of(x.upper())));
  });
}

std::optional<int> ExactNumber::sign(int max_bits) const {
  if (is_rational()) return sgn(node_->value);
  try {
    return in_enclosures(*this, 64, std::max(64, max_bits), [](const Mpfi& x, bool) -> std::optional<int> {
      if (mpfr_sgn(x.lower()) > 0) return 1;
      if (mpfr_sgn(x.upper()) < 0) return -1;
      if (mpfr_zero_p(x.lower()) && mpfr_zero_p(x.upper())) return 0;
      return std::nullopt;
    });
  } catch (const Undecided&) {
    return std::nullopt;
  }
}

}  // namespace corank
