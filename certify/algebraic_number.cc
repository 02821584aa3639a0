#include "corank/certify/algebraic_number.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace corank::certify {
namespace {

constexpr int kMostHalvings = 2000;

void trim(RationalPolynomial& f) {
  while (!f.empty() && f.back().is_zero()) f.pop_back();
}

ExactNumber value_at(const RationalPolynomial& f, const ExactNumber& x) {
  ExactNumber value;
  for (auto c = f.rbegin(); c != f.rend(); ++c) value = value * x + *c;
  return value;
}

int sign_at(const RationalPolynomial& f, const ExactNumber& x) { return *value_at(f, x).sign(); }

RationalPolynomial remainder(RationalPolynomial f, const RationalPolynomial& p) {
  trim(f);
  while (f.size() >= p.size()) {
    const ExactNumber q = f.back() / p.back();
    const std::size_t shift = f.size() - p.size();
    for (std::size_t k = 0; k + 1 < p.size(); ++k) f[shift + k] = f[shift + k] - q * p[k];
    f.pop_back();
    trim(f);
  }
  return f;
}

// Sturm's theorem: the number of distinct real roots in (a, b], p(a) ≠ 0 ≠ p(b), is the number of sign changes of the Sturm
// sequence p, p', −rem(p, p') … at a less that at b.
int roots_between(const RationalPolynomial& p, const ExactNumber& a, const ExactNumber& b) {
  std::vector<RationalPolynomial> sequence{p, {}};
  for (std::size_t k = 1; k < p.size(); ++k) sequence[1].push_back(p[k] * ExactNumber(static_cast<long>(k)));
  while (!sequence.back().empty()) {
    RationalPolynomial next = remainder(sequence[sequence.size() - 2], sequence.back());
    for (ExactNumber& c : next) c = -c;
    sequence.push_back(std::move(next));
  }
  sequence.pop_back();
  const auto changes = [&](const ExactNumber& x) {
    int count = 0, last = 0;
    for (const RationalPolynomial& f : sequence) {
      const int s = sign_at(f, x);
      if (s != 0 && last != 0 && s != last) ++count;
      if (s != 0) last = s;
    }
    return count;
  };
  return changes(a) - changes(b);
}

// [lower, upper] · [from, to]
void multiply(AlgebraicNumber::Bounds& x, const ExactNumber& from, const ExactNumber& to) {
  std::vector<ExactNumber> products{x.lower * from, x.lower * to, x.upper * from, x.upper * to};
  const auto less = [](const ExactNumber& a, const ExactNumber& b) { return (a - b).sign() == -1; };
  const auto [least, greatest] = std::minmax_element(products.begin(), products.end(), less);
  x = {*least, *greatest};
}

}  // namespace

AlgebraicNumber::AlgebraicNumber(RationalPolynomial p, ExactNumber lower, ExactNumber upper)
    : p_(std::move(p)), lower_(std::move(lower)), upper_(std::move(upper)) {
  trim(p_);
  const bool rational = std::ranges::all_of(p_, [](const ExactNumber& c) { return c.is_rational(); });
  if (!rational || !lower_.is_rational() || !upper_.is_rational())
    throw std::invalid_argument("an algebraic number needs a rational polynomial and a rational interval");
  if (p_.size() < 2 || (upper_ - lower_).sign() != 1)
    throw std::invalid_argument("an algebraic number has no polynomial or interval");
  sign_at_upper_ = sign_at(p_, upper_);
  if (sign_at_upper_ == 0 || sign_at(p_, lower_) != -sign_at_upper_ || roots_between(p_, lower_, upper_) != 1)
    throw std::invalid_argument("the interval does not isolate a root of the polynomial");
}

// By bisection: the sign change, and so the one root, stays between the ends.
void AlgebraicNumber::halve() const {
  ExactNumber middle = (lower_ + upper_) / ExactNumber(2);
  int s = sign_at(p_, middle);
  if (s == 0) {  // the root itself: move off it, keeping it inside
    const ExactNumber quarter = (upper_ - lower_) / ExactNumber(8);
    lower_ = middle - quarter;
    upper_ = middle + quarter;
    return;
  }
  (s == sign_at_upper_ ? upper_ : lower_) = std::move(middle);
}

RationalPolynomial AlgebraicNumber::reduced(RationalPolynomial f) const { return remainder(std::move(f), p_); }

RationalPolynomial AlgebraicNumber::product(const RationalPolynomial& f, const RationalPolynomial& g) const {
  if (f.empty() || g.empty()) return {};
  RationalPolynomial result(f.size() + g.size() - 1);
  for (std::size_t i = 0; i < f.size(); ++i)
    for (std::size_t j = 0; j < g.size(); ++j) result[i + j] = result[i + j] + f[i] * g[j];
  return reduced(std::move(result));
}

AlgebraicNumber::Bounds AlgebraicNumber::bounds(const RationalPolynomial& f, const ExactNumber& width) const {
  const RationalPolynomial g = reduced(f);
  if (g.size() < 2) return {g.empty() ? ExactNumber() : g[0], g.empty() ? ExactNumber() : g[0]};
  for (int k = 0;; ++k) {
    Bounds value{ExactNumber(), ExactNumber()};  // Horner's scheme in interval arithmetic
    for (auto c = g.rbegin(); c != g.rend(); ++c) {
      multiply(value, lower_, upper_);
      value = {value.lower + *c, value.upper + *c};
    }
    if ((value.upper - value.lower - width).sign() != 1 || k == kMostHalvings) return value;
    halve();
  }
}

std::optional<int> AlgebraicNumber::sign(const RationalPolynomial& f) const {
  const RationalPolynomial g = reduced(f);
  if (g.empty()) return 0;
  if (g.size() == 1) return g[0].sign();
  ExactNumber width(1);
  for (int k = 0; k < 12; ++k) {
    const Bounds value = bounds(g, width);
    if (value.lower.sign() == 1) return 1;
    if (value.upper.sign() == -1) return -1;
    width = width / ExactNumber(1L << 20);
  }
  return std::nullopt;
}

Interval AlgebraicNumber::enclose(const RationalPolynomial& f) const {
  static const ExactNumber kWidth = ExactNumber(1) / pow(ExactNumber(2), 80);
  const Bounds value = bounds(f, kWidth);
  return Interval::hull(value.lower.enclose(), value.upper.enclose());
}

std::optional<std::string> text(const AlgebraicNumber& t, const RationalPolynomial& f) {
  RationalPolynomial g = t.reduced(f);
  if (g.size() < 2) return g.empty() ? "0" : g[0].text();
  const RationalPolynomial& p = t.polynomial();
  if (p.size() != 3) return std::nullopt;
  // t = −b/2 ± √d with d = b²/4 − c, for t² + b t + c = 0; the sign is that of t + b/2.
  const ExactNumber half = p[1] / (ExactNumber(2) * p[2]), c = p[0] / p[2], d = half * half - c;
  const auto sign = t.sign({half, ExactNumber(1)});
  if (!sign || *sign == 0) return std::nullopt;
  const ExactNumber constant = g[0] - g[1] * half;
  // √(n/m) = √(n m)/m, and squares of small numbers come out of the root.
  const std::string fraction = d.text();
  const std::size_t slash = fraction.find('/');
  const ExactNumber n = ExactNumber::rational(fraction.substr(0, slash));
  const ExactNumber m = slash == std::string::npos ? ExactNumber(1) : ExactNumber::rational(fraction.substr(slash + 1));
  ExactNumber inside = n * m, outside = g[1] * ExactNumber(*sign) / m;
  constexpr int kLargestFactor = 1000;
  for (int k = 2; k <= kLargestFactor; ++k) {
    const ExactNumber square(k * k);
    for (ExactNumber q = inside / square; q.text().find('/') == std::string::npos; q = inside / square) {
      inside = q;
      outside = outside * ExactNumber(k);
    }
  }
  const ExactNumber root = ExactNumber::apply(ConstantFunction::sqrt, inside);
  return (constant + outside * root).text();
}

RationalPolynomial sum(const RationalPolynomial& f, const RationalPolynomial& g) {
  RationalPolynomial result(std::max(f.size(), g.size()));
  for (std::size_t k = 0; k < result.size(); ++k) {
    if (k < f.size()) result[k] = f[k];
    if (k < g.size()) result[k] = result[k] + g[k];
  }
  trim(result);
  return result;
}

RationalPolynomial scaled(const RationalPolynomial& f, const ExactNumber& factor) {
  RationalPolynomial result;
  for (const ExactNumber& c : f) result.push_back(c * factor);
  trim(result);
  return result;
}

}  // namespace corank::certify
