#include "corank/symbolic/algebra/rational_polynomial.h"

#include <flint/fmpq_mpoly_factor.h>

#include <map>
#include <sstream>

#include "corank/core/check.h"
#include "corank/core/guarded_process.h"

namespace corank::symbolic {
namespace {

struct Rational {
  Rational() { fmpq_init(q); }
  ~Rational() { fmpq_clear(q); }
  Rational(const Rational&) = delete;
  Rational& operator=(const Rational&) = delete;
  fmpq_t q;
};

std::string taken(char* flint_text) {
  const std::unique_ptr<char, void (*)(void*)> text(flint_text, flint_free);
  return text.get();
}

}  // namespace

PolynomialRing::PolynomialRing(std::size_t unknowns)
    : context_(new fmpq_mpoly_ctx_struct, [](fmpq_mpoly_ctx_struct* context) {
        fmpq_mpoly_ctx_clear(context);
        delete context;
      }) {
  fmpq_mpoly_ctx_init(context_.get(), unknowns, ORD_LEX);
}

RationalPolynomial::RationalPolynomial(const PolynomialRing& ring) : ring_(ring) {
  fmpq_mpoly_init(value_, ring_.context());
}

RationalPolynomial RationalPolynomial::number(const PolynomialRing& ring, const std::string& value) {
  RationalPolynomial result(ring);
  Rational number;
  CORANK_CHECK(fmpq_set_str(number.q, value.c_str(), 10) == 0);
  fmpq_mpoly_set_fmpq(result.value_, number.q, ring.context());
  return result;
}

RationalPolynomial RationalPolynomial::unknown(const PolynomialRing& ring, std::size_t index) {
  RationalPolynomial result(ring);
  fmpq_mpoly_gen(result.value_, index, ring.context());
  return result;
}

RationalPolynomial::RationalPolynomial(const RationalPolynomial& other) : RationalPolynomial(other.ring_) {
  fmpq_mpoly_set(value_, other.value_, ring_.context());
}
RationalPolynomial::RationalPolynomial(RationalPolynomial&& other) noexcept : RationalPolynomial(other.ring_) {
  fmpq_mpoly_swap(value_, other.value_, ring_.context());
}
RationalPolynomial& RationalPolynomial::operator=(RationalPolynomial other) noexcept {
  std::swap(ring_, other.ring_);
  std::swap(value_[0], other.value_[0]);
  return *this;
}
RationalPolynomial::~RationalPolynomial() { fmpq_mpoly_clear(value_, ring_.context()); }

bool RationalPolynomial::is_number() const { return fmpq_mpoly_is_fmpq(value_, ring_.context()) != 0; }
std::size_t RationalPolynomial::size() const { return fmpq_mpoly_length(value_, ring_.context()); }

bool RationalPolynomial::mentions(std::size_t unknown) const {
  return fmpq_mpoly_degree_si(value_, static_cast<slong>(unknown), ring_.context()) > 0;
}

std::size_t RationalPolynomial::unknowns() const {
  std::size_t count = 0;
  for (std::size_t k = 0; k < ring_.unknowns(); ++k) count += mentions(k);
  return count;
}

std::vector<RationalPolynomial::Term> RationalPolynomial::terms() const {
  std::vector<Term> result(size());
  std::vector<ulong> powers(ring_.unknowns());
  Rational coefficient;
  for (std::size_t k = 0; k < result.size(); ++k) {
    fmpq_mpoly_get_term_coeff_fmpq(coefficient.q, value_, k, ring_.context());
    fmpq_mpoly_get_term_exp_ui(powers.data(), value_, k, ring_.context());
    result[k] = {taken(fmpq_get_str(nullptr, 10, coefficient.q)), {powers.begin(), powers.end()}};
  }
  return result;
}

RationalPolynomial RationalPolynomial::power(std::uint64_t exponent) const {
  RationalPolynomial result(ring_);
  CORANK_CHECK(fmpq_mpoly_pow_ui(result.value_, value_, exponent, ring_.context()) != 0);
  return result;
}

RationalPolynomial RationalPolynomial::with(std::size_t unknown, std::uint64_t step, const RationalPolynomial& value) const {
  if (fmpq_mpoly_degree_si(value_, static_cast<slong>(unknown), ring_.context()) < static_cast<slong>(step)) return *this;
  // By the value's power. Terms that share it keep their lexicographic order, and stay different.
  std::map<ulong, RationalPolynomial> parts;
  std::vector<ulong> powers(ring_.unknowns());
  Rational coefficient;
  for (std::size_t k = 0; k < size(); ++k) {
    fmpq_mpoly_get_term_coeff_fmpq(coefficient.q, value_, k, ring_.context());
    fmpq_mpoly_get_term_exp_ui(powers.data(), value_, k, ring_.context());
    RationalPolynomial& part = parts.try_emplace(powers[unknown] / step, ring_).first->second;
    powers[unknown] %= step;
    fmpq_mpoly_push_term_fmpq_ui(part.value_, coefficient.q, powers.data(), ring_.context());
  }
  RationalPolynomial sum(ring_);
  for (auto& [power, part] : parts) {
    fmpq_mpoly_reduce(part.value_, ring_.context());
    sum = sum + part * value.power(power);
  }
  return sum;
}

RationalPolynomial RationalPolynomial::over(const RationalPolynomial& number) const {
  RationalPolynomial result(ring_);
  Rational divisor;
  fmpq_mpoly_get_fmpq(divisor.q, number.value_, ring_.context());
  fmpq_mpoly_scalar_div_fmpq(result.value_, value_, divisor.q, ring_.context());
  return result;
}

std::optional<RationalPolynomial> RationalPolynomial::divided_by(const RationalPolynomial& divisor) const {
  RationalPolynomial result(ring_);
  if (fmpq_mpoly_divides(result.value_, value_, divisor.value_, ring_.context()) == 0) return std::nullopt;
  return result;
}

std::string RationalPolynomial::text() const { return taken(fmpq_mpoly_get_str_pretty(value_, nullptr, ring_.context())); }

RationalPolynomial RationalPolynomial::parsed(const PolynomialRing& ring, const std::string& text) {
  RationalPolynomial result(ring);
  CORANK_CHECK(fmpq_mpoly_set_str_pretty(result.value_, text.c_str(), nullptr, ring.context()) == 0);
  return result;
}

// FLINT cannot be asked to end: what may take long is done by a process that can.
std::optional<std::vector<RationalPolynomial>> RationalPolynomial::factors(const Ended& ended) const {
  constexpr std::size_t kFewTerms = 30;
  constexpr ProcessLimits kLimits{std::uint64_t{4} << 30, 10};
  if (size() <= kFewTerms) return factors_here();
  std::string lines;
  try {
    const SharedBytes found = run_guarded(
        kLimits,
        [this](ByteSink& sink) {
          for (const RationalPolynomial& factor : factors_here()) sink.write(factor.text() + "\n");
        },
        ended);
    lines.assign(reinterpret_cast<const char*>(found.bytes().data()), found.bytes().size());
  } catch (const GuardedWorkError&) {
    return std::nullopt;
  }
  std::vector<RationalPolynomial> result;
  std::istringstream stream(lines);
  for (std::string line; std::getline(stream, line);) result.push_back(parsed(ring_, line));
  return result;
}

std::vector<RationalPolynomial> RationalPolynomial::factors_here() const {
  fmpq_mpoly_factor_t all;
  fmpq_mpoly_factor_init(all, ring_.context());
  const bool factored = fmpq_mpoly_factor(all, value_, ring_.context()) != 0;
  std::vector<RationalPolynomial> result;
  RationalPolynomial product(ring_);
  fmpq_mpoly_factor_expand(product.value_, all, ring_.context());
  for (slong k = 0; factored && k < fmpq_mpoly_factor_length(all, ring_.context()); ++k) {
    RationalPolynomial base(ring_);
    fmpq_mpoly_factor_get_base(base.value_, all, k, ring_.context());
    if (!base.is_number()) result.push_back(std::move(base));
  }
  fmpq_mpoly_factor_clear(all, ring_.context());
  CORANK_CHECK(!factored || product == *this);
  if (!factored && !is_number()) result.push_back(*this);
  return result;
}

template <auto flint>
RationalPolynomial RationalPolynomial::made_of(const RationalPolynomial& a, const RationalPolynomial& b) {
  RationalPolynomial result(a.ring_);
  flint(result.value_, a.value_, b.value_, a.ring_.context());
  return result;
}
RationalPolynomial operator+(const RationalPolynomial& a, const RationalPolynomial& b) {
  return RationalPolynomial::made_of<fmpq_mpoly_add>(a, b);
}
RationalPolynomial operator-(const RationalPolynomial& a, const RationalPolynomial& b) {
  return RationalPolynomial::made_of<fmpq_mpoly_sub>(a, b);
}
RationalPolynomial operator*(const RationalPolynomial& a, const RationalPolynomial& b) {
  return RationalPolynomial::made_of<fmpq_mpoly_mul>(a, b);
}
bool operator==(const RationalPolynomial& a, const RationalPolynomial& b) {
  return fmpq_mpoly_equal(a.value_, b.value_, a.ring_.context()) != 0;
}

}  // namespace corank::symbolic
