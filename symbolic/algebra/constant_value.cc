#include "corank/symbolic/algebra/constant_value.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "corank/symbolic/algebra/ginac_bridge.h"
#include "corank/symbolic/model/evaluate.h"

namespace corank::symbolic {
namespace {
using GiNaC::ex;
using GiNaC::ex_to;
using GiNaC::is_a;
using GiNaC::numeric;

constexpr double kMaxExpandedTerms = 1000;
constexpr long kMaxParts = 20'000;

// How many terms expand() would make, roughly; never less.
double expanded_terms(const ex& e) {
  if (is_a<GiNaC::add>(e)) {
    double sum = 0;
    for (const ex& term : e) sum += expanded_terms(term);
    return sum;
  }
  if (is_a<GiNaC::mul>(e)) {
    double product = 1;
    for (const ex& factor : e) product *= expanded_terms(factor);
    return product;
  }
  if (is_a<GiNaC::power>(e) && is_a<numeric>(e.op(1))) {
    const double k = expanded_terms(e.op(0)), n = std::abs(ex_to<numeric>(e.op(1)).to_double());
    return k <= 1 ? 1 : std::exp(std::lgamma(n + k) - std::lgamma(n + 1) - std::lgamma(k));  // binomial(n + k − 1, k − 1)
  }
  return 1;
}

// The number of nodes, counted up to the limit only.
void count_parts(const ex& e, long& parts) {
  if (++parts > kMaxParts) return;
  for (std::size_t i = 0; i < e.nops() && parts <= kMaxParts; ++i) count_parts(e.op(i), parts);
}

ex reduced(const ex& e) {
  if (is_a<numeric>(e)) {
    if (numeric_bits(e) > kMaxBits) throw std::domain_error("a number of more than 100000 bits");
    return e;
  }
  const ex result = expanded_terms(e) <= kMaxExpandedTerms ? e.expand() : e;
  long parts = 0;
  count_parts(result, parts);
  if (parts > kMaxParts) throw std::domain_error("an expression of more than 20000 parts");
  if (numeric_bits(result) > kMaxBits) throw std::domain_error("a number of more than 100000 bits");
  return result;
}

ExactNumber exact_of(const ex& e);

// Sums and products in an order of their own, so that the result does not depend on GiNaC's.
template <typename Combine>
ExactNumber combine(const ex& e, const ExactNumber& neutral, Combine&& op) {
  std::vector<std::pair<std::string, ExactNumber>> parts;
  for (const ex& part : e) {
    ExactNumber number = exact_of(part);
    std::string key = number.is_rational() ? "" : number.text();
    parts.emplace_back(std::move(key), std::move(number));
  }
  std::ranges::stable_sort(parts, [](const auto& a, const auto& b) { return a.first < b.first; });
  ExactNumber result = neutral;
  for (const auto& [key, part] : parts) result = op(result, part);
  return result;
}

ExactNumber exact_power(const ex& base, const ex& exponent) {
  if (is_a<numeric>(exponent)) {
    const numeric& n = ex_to<numeric>(exponent);
    if (n.is_integer() && GiNaC::abs(n) <= 1'000'000) return pow(exact_of(base), n.to_int());
    if (n.is_rational() && n.denom() == 2 && GiNaC::abs(n) <= 1'000'000)
      return pow(ExactNumber::apply(ConstantFunction::sqrt, exact_of(base)), n.numer().to_int());
  }
  return ExactNumber::apply(ConstantFunction::exp, exact_of(exponent * GiNaC::log(base)));
}

ExactNumber exact_of(const ex& e) {
  if (is_a<numeric>(e)) {
    if (!ex_to<numeric>(e).is_rational()) throw std::domain_error("not a real number");
    return ExactNumber::rational(text_of(e));
  }
  if (e.is_equal(GiNaC::Pi)) return ExactNumber::pi();
  if (is_a<GiNaC::add>(e)) return combine(e, 0, [](const auto& a, const auto& b) { return a + b; });
  if (is_a<GiNaC::mul>(e)) return combine(e, 1, [](const auto& a, const auto& b) { return a * b; });
  if (is_a<GiNaC::power>(e)) return exact_power(e.op(0), e.op(1));
  if (is_a<GiNaC::function>(e) && e.nops() == 1)
    if (const auto function = constant_function(e)) return ExactNumber::apply(*function, exact_of(e.op(0)));
  throw std::domain_error("`" + text_of(e) + "` is not a constant of the model language");
}

// √q for a rational q > 0 as r·√s with the small square factors in r, so that √12 and 2√3 are the same expression.
ex square_root(numeric q) {
  numeric outside = 1, inside = q.numer() * q.denom();
  const numeric below = q.denom();
  for (long p = 2; p < 1000 && numeric(p) * numeric(p) <= inside; ++p) {
    const numeric square = numeric(p) * numeric(p);
    while (GiNaC::irem(inside, square).is_zero()) {
      inside = GiNaC::iquo(inside, square);
      outside = outside * numeric(p);
    }
  }
  return outside / below * GiNaC::sqrt(ex(inside));
}

void require_sign(const ConstantValue& x, bool zero_allowed, const std::string& what) {
  const std::optional<int> s = x.sign();
  const std::string kind = zero_allowed ? "negative" : "not positive";
  if (!s) throw std::domain_error(what + " a number that cannot be distinguished from one that is " + kind);
  if (*s < 0 || (*s == 0 && !zero_allowed)) throw std::domain_error(what + " a number that is " + kind);
}

struct SquaredCosines : GiNaC::map_function {
  ex operator()(const ex& e) override {
    const ex inner = e.map(*this);
    if (!is_a<GiNaC::power>(inner) || !inner.op(1).info(GiNaC::info_flags::posint)) return inner;
    const ex base = inner.op(0);
    if (!is_a<GiNaC::function>(base) || ex_to<GiNaC::function>(base).get_name() != "cos") return inner;
    const int n = ex_to<numeric>(inner.op(1)).to_int();
    return GiNaC::pow(1 - GiNaC::pow(GiNaC::sin(base.op(0)), 2), n / 2) * GiNaC::pow(base, n % 2);
  }
};

}  // namespace

ConstantValue::ConstantValue(ex value) : value_(reduced(value)) {}

ConstantValue ConstantValue::number(const std::string& decimal) { return ConstantValue(ex(exact_decimal(decimal))); }
ConstantValue ConstantValue::pi() { return ConstantValue(ex(GiNaC::Pi)); }

// Most coefficients are rational, and many of those 0 or ±1, or short sums: what is made of such numbers needs no look at
// its parts, each of which GiNaC puts together anew.
ConstantValue operator+(const ConstantValue& x, const ConstantValue& y) {
  constexpr std::size_t kShort = 100;
  if (x.is_zero()) return y;
  if (y.is_zero()) return x;
  if (x.is_rational() && y.is_rational()) return ConstantValue(ex(ex_to<numeric>(x.value_).add(ex_to<numeric>(y.value_))));
  const ex sum = x.value_ + y.value_;  // of expanded ones, so expanded
  return is_a<GiNaC::add>(sum) && sum.nops() < kShort ? ConstantValue::as_is(sum) : ConstantValue(sum);
}
ConstantValue operator-(const ConstantValue& x, const ConstantValue& y) { return x + (-y); }
ConstantValue operator-(const ConstantValue& x) { return ConstantValue(-1) * x; }
ConstantValue operator*(const ConstantValue& x, const ConstantValue& y) {
  constexpr double kFewBits = 64;
  for (const auto& [one, other] : {std::pair(&x, &y), std::pair(&y, &x)}) {
    if (!one->is_rational()) continue;
    if (one->value_.is_equal(1)) return *other;
    if (other->is_rational()) return ConstantValue(ex(ex_to<numeric>(one->value_).mul(ex_to<numeric>(other->value_))));
    if (numeric_bits(one->value_) <= kFewBits) return ConstantValue::as_is(one->value_ * other->value_);
  }
  return ConstantValue(x.value_ * y.value_);
}

ConstantValue operator/(const ConstantValue& x, const ConstantValue& y) {
  const std::optional<int> s = y.sign();
  if (!s && !y.without_squared_cosines().is_zero())
    throw std::domain_error("division by a number that cannot be distinguished from zero");
  if (!s || *s == 0) throw std::domain_error("division by zero");
  return ConstantValue(x.value_ / y.value_);
}

ConstantValue pow(const ConstantValue& x, const ConstantValue& exponent) {
  const ex& e = exponent.value_;
  if (is_a<numeric>(e) && ex_to<numeric>(e).is_integer()) {
    if (ex_to<numeric>(e).is_negative()) return ConstantValue(1) / pow(x, -exponent);
    return ConstantValue(guarded_power(x.value_, e));
  }
  const bool positive_exponent = exponent.sign() == 1;
  require_sign(x, positive_exponent, "a fractional power of");
  if (x.is_zero()) return 0;
  if (is_a<numeric>(x.value_) && e.is_equal(numeric(1, 2))) return ConstantValue(square_root(ex_to<numeric>(x.value_)));
  return ConstantValue(guarded_power(x.value_, e));
}

ConstantValue ConstantValue::function(const std::string& name, const ConstantValue& x) {
  if (name == "sqrt") {
    require_sign(x, true, "sqrt of");
    return pow(x, ConstantValue(ex(numeric(1, 2))));
  }
  if (name == "log") require_sign(x, false, "log of");
  if (name == "asin" || name == "acos") {
    const std::optional<int> above = (ConstantValue(1) - x).sign(), below = (ConstantValue(1) + x).sign();
    if (!above || !below || *above < 0 || *below < 0) throw std::domain_error(name + " of a number outside [-1, 1]");
  }
  if (name == "tan") {
    const std::optional<int> s = function("cos", x).sign();
    if (!s || *s == 0) throw std::domain_error("tan at a pole");
  }
  if (name == "abs")
    if (const std::optional<int> s = x.sign()) return *s < 0 ? -x : x;
  return ConstantValue(function_value(name, x.value_));
}

std::optional<int> ConstantValue::integer() const {
  if (!is_a<numeric>(value_)) return std::nullopt;
  const numeric& q = ex_to<numeric>(value_);
  if (!q.is_integer() || GiNaC::abs(q) > 1'000'000'000) return std::nullopt;
  return q.to_int();
}

bool ConstantValue::is_rational() const { return is_a<numeric>(value_); }

std::optional<int> ConstantValue::sign() const {
  if (is_a<numeric>(value_)) return ex_to<numeric>(value_).csgn();
  return exact().sign();
}

ConstantValue ConstantValue::without_squared_cosines() const {
  SquaredCosines map;
  return ConstantValue(map(value_));
}

ExactNumber ConstantValue::exact() const { return exact_of(value_); }

}  // namespace corank::symbolic
