#include "corank/symbolic/algebra/expanded_polynomial.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>
#include <stdexcept>

namespace corank::symbolic {
namespace {

using Key = ExpandedPolynomial::Key;

Key product(const Key& x, const Key& y) {
  Key result;
  result.reserve(x.size() + y.size());
  auto i = x.begin();
  auto j = y.begin();
  int degree = 0;
  while (i != x.end() || j != y.end()) {
    if (j == y.end() || (i != x.end() && i->first < j->first)) {
      result.push_back(*i++);
    } else if (i == x.end() || j->first < i->first) {
      result.push_back(*j++);
    } else {
      result.emplace_back(i->first, i->second + j->second);
      ++i, ++j;
    }
    degree += result.back().second;
  }
  if (degree > ExpandedPolynomial::kMaxDegree)
    throw std::length_error("it expands to a polynomial of degree " + std::to_string(degree));
  return result;
}

// binomial(n, k), as a double: infinite where it is absurd.
double binomial(double n, double k) { return std::exp(std::lgamma(n + 1) - std::lgamma(k + 1) - std::lgamma(n - k + 1)); }

// Bounds the terms of xⁿ by the number of ways to choose n of x's terms, and by the number of monomials of that degree.
// Where both are too many, nobody has to wait for the product to find out.
void check_power(const std::map<Key, ConstantValue>& terms, int n) {
  int degree = 0;
  std::set<int> variables;
  for (const auto& [key, coefficient] : terms) {
    int sum = 0;
    for (const auto& [variable, power] : key) sum += power, variables.insert(variable);
    degree = std::max(degree, sum);
  }
  if (degree * n > ExpandedPolynomial::kMaxDegree)
    throw std::length_error("it expands to a polynomial of degree " + std::to_string(degree * n));
  const auto v = static_cast<double>(variables.size()), k = static_cast<double>(terms.size());
  if (std::min(binomial(n + k - 1, k - 1), binomial(degree * n + v, v)) > static_cast<double>(ExpandedPolynomial::kMaxTerms))
    throw std::length_error("it expands to a polynomial of more than " + std::to_string(ExpandedPolynomial::kMaxTerms) +
                            " terms");
}

}  // namespace

ExpandedPolynomial ExpandedPolynomial::variable(int index) {
  ExpandedPolynomial result;
  result.terms_.emplace(Key{{index, 1}}, 1);
  return result;
}

std::optional<ConstantValue> ExpandedPolynomial::constant() const {
  if (terms_.empty()) return ConstantValue();
  if (terms_.size() == 1 && terms_.begin()->first.empty()) return terms_.begin()->second;
  return std::nullopt;
}

void ExpandedPolynomial::add(const Key& key, const ConstantValue& coefficient) {
  if (coefficient.is_zero()) return;
  const auto [it, fresh] = terms_.try_emplace(key, coefficient);
  if (!fresh) {
    it->second = it->second + coefficient;
    if (it->second.is_zero()) terms_.erase(it);
  }
  if (terms_.size() > kMaxTerms) throw std::length_error("it expands to more than " + std::to_string(kMaxTerms) + " terms");
}

ExpandedPolynomial& ExpandedPolynomial::operator+=(const ExpandedPolynomial& y) {
  for (const auto& [key, coefficient] : y.terms_) add(key, coefficient);
  return *this;
}

ExpandedPolynomial operator*(const ExpandedPolynomial& x, const ExpandedPolynomial& y) {
  // Products whose terms mostly cancel are no reason to work forever.
  constexpr std::size_t kMaxWork = 5 * ExpandedPolynomial::kMaxTerms;
  if (x.terms_.size() * y.terms_.size() > kMaxWork)
    throw std::length_error("it expands to a product of " + std::to_string(x.terms_.size()) + " and " +
                            std::to_string(y.terms_.size()) + " terms");
  ExpandedPolynomial result;
  for (const auto& [x_key, x_coefficient] : x.terms_)
    for (const auto& [y_key, y_coefficient] : y.terms_) result.add(product(x_key, y_key), x_coefficient * y_coefficient);
  return result;
}

ExpandedPolynomial operator*(const ConstantValue& c, const ExpandedPolynomial& x) {
  ExpandedPolynomial result;
  for (const auto& [key, coefficient] : x.terms_) result.add(key, c * coefficient);
  return result;
}

ExpandedPolynomial pow(const ExpandedPolynomial& x, int n) {
  if (n > 1) check_power(x.terms_, n);
  ExpandedPolynomial result(1);
  for (int i = 0; i < n; ++i) result = result * x;
  return result;
}

Polynomial ExpandedPolynomial::compile(const std::string& source) const {
  Polynomial result;
  result.source = source;
  for (const auto& [key, coefficient] : terms_) {
    if (!coefficient.is_rational() && !coefficient.exact().sign(256) && coefficient.without_squared_cosines().is_zero())
      continue;
    std::vector<Factor> factors;
    for (const auto& [variable_index, power] : key) factors.push_back({variable_index, power});
    result.monomials.emplace_back(coefficient.exact(), std::move(factors));
  }
  return result;
}

std::pair<ExpandedPolynomial, ExpandedPolynomial> multiple_angle(int n, const ExpandedPolynomial& c,
                                                                 const ExpandedPolynomial& s) {
  // T_0 = 1, T_1 = c, U_0 = 1, U_{-1} = 0; both obey P_{k+1} = 2c·P_k − P_{k−1}.
  if (n == 0) return {1, 0};
  const ExpandedPolynomial two_c = ConstantValue(2) * c;
  ExpandedPolynomial t_before = 1, t = c, u_before, u = 1;
  for (int k = 1; k < std::abs(n); ++k) {
    ExpandedPolynomial t_next = two_c * t - t_before, u_next = two_c * u - u_before;
    t_before = std::exchange(t, std::move(t_next));
    u_before = std::exchange(u, std::move(u_next));
  }
  ExpandedPolynomial sine = s * u;
  if (n < 0) sine = -sine;
  return {std::move(t), std::move(sine)};
}

}  // namespace corank::symbolic
