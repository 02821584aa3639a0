#include <algorithm>
#include <set>

#include "corank/certify/polynomial_algebra.h"
#include "corank/certify/reduction.h"
#include "corank/core/rounding.h"
#include "corank/solve/equation_multiples.h"
#include "corank/solve/implied_equations.h"

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

}  // namespace

std::optional<ImpliedEquation> express_by_equations(const Polynomial& h, const System& system, const Ended& ended) {
  return SumSearch(h, system, ended).find();
}

}  // namespace corank::solve
