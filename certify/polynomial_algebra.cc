#include "corank/certify/polynomial_algebra.h"

#include <algorithm>
#include <map>
#include <set>

#include "corank/certify/trigonometric.h"
#include "corank/core/check.h"
#include "corank/core/rounding.h"

namespace corank::certify {
namespace {

struct Coefficient {
  ExactNumber exact;
  Interval enclosure;
  bool tolerant;
};

// Terms by their factors, summed.
class Sum {
 public:
  void add(const Factors& factors, const ExactNumber& exact, const Interval& enclosure, bool tolerant) {
    const auto [at, is_new] = terms_.try_emplace(factors, Coefficient{exact, enclosure, tolerant});
    if (is_new) return;
    at->second.exact = at->second.exact + exact;
    at->second.enclosure += enclosure;
    at->second.tolerant = at->second.tolerant || tolerant;
  }
  void add(const Monomial& m) { add(m.factors, m.coefficient, m.enclosure, carries_tolerance(m)); }
  void remove(const Factors& factors) { terms_.erase(factors); }
  std::vector<Monomial> monomials() const {
    std::vector<Monomial> result;
    for (const auto& [factors, c] : terms_) {
      if (c.exact.is_zero() && !c.tolerant) continue;
      result.emplace_back(c.exact, factors);
      if (c.tolerant) result.back().enclosure = c.enclosure;
    }
    return result;
  }

 private:
  std::map<Factors, Coefficient> terms_;
};

Factors product(const Factors& a, const Factors& b) {
  Factors result;
  std::size_t i = 0, j = 0;
  while (i < a.size() || j < b.size()) {
    if (j == b.size() || (i < a.size() && a[i].variable < b[j].variable)) {
      result.push_back(a[i++]);
    } else if (i == a.size() || b[j].variable < a[i].variable) {
      result.push_back(b[j++]);
    } else {
      result.push_back({a[i].variable, a[i].power + b[j].power});
      ++i, ++j;
    }
  }
  return result;
}

std::vector<Monomial> product(const std::vector<Monomial>& a, const std::vector<Monomial>& b) {
  Sum sum;
  for (const Monomial& x : a)
    for (const Monomial& y : b) {
      CORANK_CHECK((!x.is_trigonometric() || y.factors.empty()) && (!y.is_trigonometric() || x.factors.empty()));
      sum.add(product(x.factors, y.factors), x.coefficient * y.coefficient, x.enclosure * y.enclosure,
              carries_tolerance(x) || carries_tolerance(y));
    }
  return sum.monomials();
}

}  // namespace

bool carries_tolerance(const Monomial& m) { return !m.coefficient.enclose().contains(m.enclosure); }

bool mentions(const Polynomial& f, int variable) {
  return std::ranges::any_of(f.monomials, [&](const Monomial& m) {
    return std::ranges::any_of(m.factors, [&](const Factor& x) { return x.variable == variable; });
  });
}

Polynomial substitute(const Polynomial& f, int variable, const Polynomial& value) {
  CORANK_CHECK(UpwardRounding::active());
  Sum sum;
  for (const Monomial& m : f.monomials) {
    CORANK_CHECK(!m.is_trigonometric() || m.factors[0].variable != variable);
    const auto at = std::ranges::find_if(m.factors, [&](const Factor& x) { return x.variable == variable; });
    if (at == m.factors.end()) {
      sum.add(m);
      continue;
    }
    Monomial rest = m;
    rest.factors.erase(rest.factors.begin() + (at - m.factors.begin()));
    std::vector<Monomial> terms{rest};
    for (int k = 0; k < at->power; ++k) terms = product(terms, value.monomials);
    for (const Monomial& t : terms) sum.add(t);
  }
  return {sum.monomials(), f.source};
}

Polynomial product(const Polynomial& f, const Factors& powers) {
  CORANK_CHECK(UpwardRounding::active());
  return {product(f.monomials, {Monomial(1, powers)}), f.source};
}

std::optional<Polynomial> solved_for(const Polynomial& f, int variable) {
  CORANK_CHECK(UpwardRounding::active());
  const Monomial* own = nullptr;
  for (const Monomial& m : f.monomials)
    for (const Factor& x : m.factors) {
      if (x.variable != variable) continue;
      if (own || m.factors.size() != 1 || x.power != 1 || m.is_trigonometric()) return std::nullopt;
      own = &m;
    }
  if (!own || !own->coefficient.is_rational() || own->enclosure.contains_zero()) return std::nullopt;
  Polynomial value{{}, f.source};
  for (const Monomial& m : f.monomials) {
    if (&m == own) continue;
    const auto quotient = divide(-m.enclosure, own->enclosure, Interval::whole());
    CORANK_CHECK(quotient.has_value());
    Monomial t = m;
    t.coefficient = -(m.coefficient / own->coefficient);
    t.enclosure = carries_tolerance(m) || carries_tolerance(*own) ? *quotient : t.coefficient.enclose();
    value.monomials.push_back(std::move(t));
  }
  return value;
}

bool cancels(const ExactNumber& a, const ExactNumber& q, const ExactNumber& b) {
  return a == -q * b || (a == b && q == -1) || (a + q * b).is_zero();
}

Polynomial sum(const Polynomial& f, const ExactNumber& q, const Polynomial& g) {
  CORANK_CHECK(UpwardRounding::active());
  Sum sum;
  for (const Monomial& m : f.monomials) sum.add(m);
  for (const Monomial& m : g.monomials) {
    const auto own = std::ranges::find_if(f.monomials, [&](const Monomial& a) { return a.factors == m.factors; });
    if (own != f.monomials.end() && !carries_tolerance(m) && !carries_tolerance(*own) &&
        cancels(own->coefficient, q, m.coefficient)) {
      sum.remove(m.factors);
    } else {
      sum.add(m.factors, q * m.coefficient, q.enclose() * m.enclosure, carries_tolerance(m));
    }
  }
  return {sum.monomials(), f.source};
}

std::optional<ExactNumber> proportional(const Polynomial& f, const Polynomial& g) {
  if (f.monomials.size() != g.monomials.size() || f.monomials.empty()) return std::nullopt;
  Sum a, b;  // in the same order
  for (const Monomial& m : f.monomials) a.add(m);
  for (const Monomial& m : g.monomials) b.add(m);
  const auto x = a.monomials(), y = b.monomials();
  if (x.size() != y.size() || x.empty()) return std::nullopt;
  std::optional<ExactNumber> ratio;
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (x[k].factors != y[k].factors) return std::nullopt;
    if (x[k].coefficient.is_rational() != y[k].coefficient.is_rational()) return std::nullopt;
    if (!x[k].coefficient.is_rational()) continue;
    if (y[k].coefficient.is_zero()) return std::nullopt;
    const ExactNumber r = x[k].coefficient / y[k].coefficient;
    if (ratio && !(r == *ratio)) return std::nullopt;
    ratio = r;
  }
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (x[k].coefficient.is_rational()) continue;
    const ExactNumber scaled = ratio ? *ratio * y[k].coefficient : y[k].coefficient;
    if (!(scaled == x[k].coefficient)) return std::nullopt;
  }
  return ratio.value_or(1);
}

Products products_of(const Polynomial& f) {
  Products products;
  for (const Monomial& m : f.monomials) products.push_back(m.factors);
  std::ranges::sort(products);
  products.erase(std::unique(products.begin(), products.end()), products.end());
  return products;
}

std::vector<int> variables_of(std::span<const Polynomial> list) {
  std::set<int> result;
  for (const Polynomial& f : list)
    for (const Monomial& m : f.monomials)
      for (const Factor& x : m.factors) result.insert(x.variable);
  return {result.begin(), result.end()};
}

std::vector<int> variables_of(const Polynomial& f) { return variables_of({&f, 1}); }

bool is_affine(const Polynomial& f) {
  return std::ranges::all_of(f.monomials, [](const Monomial& m) {
    return m.factors.empty() || (m.factors.size() == 1 && m.factors[0].power == 1 && !m.is_trigonometric());
  });
}

Interval evaluate(const Factor& f, const std::vector<Interval>& x) {
  const Interval& side = x[f.variable];
  switch (f.function) {
    case Function::identity: return power(side, f.power);
    case Function::sine: return sine(side);
    case Function::cosine: return cosine(side);
  }
  return Interval::whole();
}

Interval evaluate(const Polynomial& f, const std::vector<Interval>& x) {
  CORANK_CHECK(UpwardRounding::active());
  Interval sum;
  for (const Monomial& m : f.monomials) {
    Interval term = m.enclosure;
    for (const Factor& factor : m.factors) term *= evaluate(factor, x);
    sum += term;
  }
  return sum;
}

}  // namespace corank::certify
