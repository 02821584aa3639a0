#include <algorithm>
#include <set>

#include "corank/certify/polynomial_algebra.h"
#include "corank/certify/reduction.h"
#include "corank/core/rounding.h"
#include "corank/solve/reduction/equation_multiples.h"
#include "corank/solve/reduction/implied_equations.h"

namespace corank::solve {
namespace {

constexpr std::size_t kMostMultiples = 20'000;  // before those are dropped that serve nothing

// All products of at most that degree of the variables, 1 the first.
std::vector<Powers> products_up_to(int most, const std::set<int>& variables) {
  std::vector<Powers> all{{}};
  for (std::size_t begin = 0; most > 0; --most) {
    const std::size_t end = all.size();
    for (std::size_t k = begin; k < end; ++k)
      for (const int v : variables)
        if (all[k].empty() || v >= all[k].back().first) all.push_back(times(all[k], {{v, 1}}));
    begin = end;
    if (all.size() > kMostRows) break;
  }
  return all;
}

class SumSearch {
 public:
  // Of h and the equations all that is needed; nothing to be found where h is no polynomial in rational numbers.
  SumSearch(const Polynomial& h, const System& system, const Ended& ended) : h_(h), system_(system), ended_(ended) {
    const auto row = row_of(h);
    if (!row) return;
    target_ = *row;
    for (const auto* list : {&system.equations, &system.implied})
      for (const Polynomial& f : *list) {
        if (auto terms = row_of(f)) equations_.emplace_back(static_cast<int>(polynomials_.size()), std::move(*terms));
        polynomials_.push_back(&f);
      }
    note_variables(target_);
    for (const auto& [i, f] : equations_) note_variables(f);
  }

  std::optional<ImpliedEquation> find() const {
    for (int excess = 0; excess <= kMostExcess && !target_.empty(); ++excess) {
      if (is_over(ended_)) break;
      if (auto found = find(h_.degree() + excess)) return found;
    }
    return std::nullopt;
  }

 private:
  static constexpr int kMostExcess = 2;

  void note_variables(const Row& row) {
    for (const auto& [p, c] : row)
      for (const auto& [variable, power] : p) variables_.insert(variable);
  }

  std::optional<ImpliedEquation> find(int most) const {
    std::vector<Multiple> multiples;
    for (const auto& [i, f] : equations_) {
      const int own = polynomials_[i]->degree();
      if (own > most) continue;
      for (const Powers& p : products_up_to(most - own, variables_)) {
        multiples.emplace_back(i, f, p);
        if (multiples.size() > kMostMultiples) return std::nullopt;
      }
    }
    drop_lone(multiples, 0, target_);
    if (multiples.empty() || multiples.size() > kMostRows) return std::nullopt;
    return combination(multiples);
  }

  // Which multiples have a part in it, modulo the prime; their factors in rational numbers; and the sum itself, exactly.
  std::optional<ImpliedEquation> combination(const std::vector<Multiple>& multiples) const {
    std::map<Powers, std::size_t> place;
    for (const Multiple& m : multiples)
      for (const auto& [p, c] : m.row) place.try_emplace(p, place.size());
    const std::size_t n = multiples.size();
    PrimeMatrix matrix(place.size(), n + 1);
    for (std::size_t k = 0; k < n; ++k)
      for (const auto& [p, c] : multiples[k].row) matrix.at(place[p], k) = c;
    for (const auto& [p, c] : target_) {
      if (!place.contains(p)) return std::nullopt;
      matrix.at(place[p], n) = c;
    }
    if (!matrix.reduce(ended_)) return std::nullopt;
    std::vector<const Multiple*> used;
    for (std::size_t i = 0; i < place.size(); ++i) {
      std::size_t pivot = 0;
      while (pivot <= n && matrix.at(i, pivot) == 0) ++pivot;
      if (pivot == n) return std::nullopt;  // h is no such sum
      if (pivot < n && matrix.at(i, n) != 0) used.push_back(&multiples[pivot]);
    }
    return rational_combination(used, place);
  }

  // The factors with which the multiples sum up to h.
  std::optional<ImpliedEquation> rational_combination(const std::vector<const Multiple*>& used,
                                                      const std::map<Powers, std::size_t>& place) const {
    RationalMatrix a(place.size(), used.size()), b(place.size(), 1), x(used.size(), 1);
    for (std::size_t k = 0; k < used.size(); ++k)
      for (const Monomial& m : polynomials_[used[k]->equation]->monomials)
        set(a.at(place.at(times(powers_of(m), used[k]->product)), k), m.coefficient);
    for (const Monomial& m : h_.monomials) set(b.at(place.at(powers_of(m)), 0), m.coefficient);
    if (!fmpq_mat_can_solve(x.get(), a.get(), b.get())) return std::nullopt;
    ImpliedEquation result;
    for (std::size_t k = 0; k < used.size(); ++k) result.parts.push_back(used[k]->part(exact(x.at(k, 0))));
    if (!is_h(result)) return std::nullopt;
    return result;
  }

  bool is_h(const ImpliedEquation& of) const {
    const UpwardRounding rounding;
    return certify::sum(certify::implied_equation(system_, of), -1, h_).monomials.empty();
  }

  const Polynomial& h_;
  const System& system_;
  const Ended& ended_;
  Row target_;
  std::vector<const Polynomial*> polynomials_;  // by the numbers of equations
  std::vector<std::pair<int, Row>> equations_;
  std::set<int> variables_;
};

std::optional<mp_limb_t> modulo_prime(const ExactNumber& x) {
  Rational q;
  if (!x.is_rational() || fmpq_set_str(q.get(), x.text().c_str(), 10) != 0) return std::nullopt;
  const mp_limb_t numerator = fmpz_fdiv_ui(fmpq_numref(q.get()), PrimeMatrix::kPrime),
                  denominator = fmpz_fdiv_ui(fmpq_denref(q.get()), PrimeMatrix::kPrime);
  if (denominator == 0) return std::nullopt;
  return nmod_div(numerator, denominator, PrimeMatrix::field());
}

// h in the variables that are kept.
Polynomial reduced(Polynomial h, const certify::Reduction& reduction) {
  std::vector<int> place(reduction.kept.size() + reduction.definitions.size(), -1);
  for (std::size_t j = 0; j < reduction.kept.size(); ++j) place[reduction.kept[j]] = static_cast<int>(j);
  // A value is in kept variables, by their new indices: those of h get them first, apart from the eliminated ones.
  const int beyond = static_cast<int>(place.size());
  for (Monomial& m : h.monomials) {
    for (Factor& x : m.factors) {
      const int kept = place[x.variable];
      x.variable = kept >= 0 ? kept : beyond + x.variable;
    }
    std::ranges::sort(m.factors, [](const Factor& a, const Factor& b) { return a.variable < b.variable; });
  }
  for (const auto& definition : reduction.definitions)
    h = certify::substitute(h, beyond + definition.variable, definition.value);
  return h;
}

}  // namespace

std::optional<ImpliedEquation> express_by_equations(const Polynomial& h, const System& system, const Ended& ended) {
  return SumSearch(h, system, ended).find();
}

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

ImpliedEquation::Multiple Multiple::part(const ExactNumber& factor) const {
  ImpliedEquation::Multiple part{equation, factor, {}};
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
      return std::ranges::any_of(m.row, [&](const auto& t) { return degree(t.first) >= of_degree && uses[t.first] == 1; });
    });
  }
}

std::vector<std::size_t> add_implied_equations(const std::vector<Polynomial>& claimed, certify::Reduction& reduction,
                                               const Ended& ended) {
  std::vector<std::size_t> unproven;
  if (!reduction.consistent || reduction.tolerant) return unproven;
  const UpwardRounding rounding;
  const std::vector<ImpliedEquation> found = find_implied_equations(reduction.system, ended);
  for (std::size_t k = 0; k < found.size(); ++k)
    certify::add_implied(reduction, found[k], "implied equation " + std::to_string(k + 1));
  for (std::size_t k = 0; k < claimed.size(); ++k) {
    const Polynomial& claim = claimed[k];
    const bool is_polynomial = std::ranges::none_of(claim.monomials, [](const Monomial& m) { return m.is_trigonometric(); });
    const Polynomial h = is_polynomial ? reduced(claim, reduction) : claim;
    const auto is_known = [&](const Polynomial& f) { return certify::proportional(f, h).has_value(); };
    if (h.monomials.empty() || std::ranges::any_of(reduction.system.equations, is_known) ||
        std::ranges::any_of(reduction.system.implied, is_known))
      continue;
    if (const auto of = express_by_equations(h, reduction.system, ended)) {
      certify::add_implied(reduction, *of, claim.source);
    } else {
      unproven.push_back(k);
    }
  }
  return unproven;
}

}  // namespace corank::solve
