#include "corank/solve/equation_multiples.h"

#include <algorithm>

namespace corank::solve {
namespace {

std::optional<mp_limb_t> modulo_prime(const ExactNumber& x) {
  Rational q;
  if (!x.is_rational() || fmpq_set_str(q.get(), x.text().c_str(), 10) != 0) return std::nullopt;
  const mp_limb_t numerator = fmpz_fdiv_ui(fmpq_numref(q.get()), PrimeMatrix::kPrime),
                  denominator = fmpz_fdiv_ui(fmpq_denref(q.get()), PrimeMatrix::kPrime);
  if (denominator == 0) return std::nullopt;
  return nmod_div(numerator, denominator, PrimeMatrix::field());
}

}  // namespace

int degree(const Powers& p) {
  int sum = 0;
  for (const auto& [variable, power] : p) sum += power;
  return sum;
}

Powers times(const Powers& p, const Powers& q) {
  std::map<int, int> powers(p.begin(), p.end());
  for (const auto& [variable, power] : q) powers[variable] += power;
  return {powers.begin(), powers.end()};
}

Powers powers_of(const Monomial& m) {
  Powers p;
  for (const Factor& x : m.factors) p.emplace_back(x.variable, x.power);
  return p;
}

std::optional<Row> row_of(const Polynomial& f) {
  Row row;
  for (const Monomial& m : f.monomials) {
    const auto c = modulo_prime(m.coefficient);
    if (!c || m.is_trigonometric()) return std::nullopt;
    row[powers_of(m)] = *c;
  }
  return row;
}

std::optional<ExactNumber> fraction_of(mp_limb_t x) {
  Rational q, a, p;
  fmpz_set_ui(fmpq_numref(a.get()), x);
  fmpz_set_ui(fmpq_numref(p.get()), PrimeMatrix::kPrime);
  if (!fmpq_reconstruct_fmpz(q.get(), fmpq_numref(a.get()), fmpq_numref(p.get()))) return std::nullopt;
  return q.exact();
}

Multiple::Multiple(int of, const Row& terms, Powers by) : equation(of), product(std::move(by)) {
  for (const auto& [p, c] : terms) row[times(p, product)] = c;
}

ImpliedEquation::Part Multiple::part(const ExactNumber& factor) const {
  ImpliedEquation::Part part{equation, factor, {}};
  for (const auto& [variable, power] : product) part.product.push_back({variable, power});
  return part;
}

void drop_lone(std::vector<Multiple>& multiples, int of_degree, const Row& target) {
  for (std::size_t before = 0; before != multiples.size();) {
    before = multiples.size();
    std::map<Powers, int> uses;
    for (const Multiple& m : multiples)
      for (const auto& [p, c] : m.row)
        if (degree(p) >= of_degree) ++uses[p];
    for (const auto& [p, c] : target) ++uses[p];
    std::erase_if(multiples, [&](const Multiple& m) {
      return std::any_of(m.row.begin(), m.row.end(),
                         [&](const auto& t) { return degree(t.first) >= of_degree && uses[t.first] == 1; });
    });
  }
}

}  // namespace corank::solve
