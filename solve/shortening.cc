#include "corank/solve/shortening.h"

#include <algorithm>
#include <map>
#include <set>

#include "corank/certify/polynomial_algebra.h"
#include "corank/core/exact_number_node.h"

namespace corank::solve {
namespace {

// The rational number q that leaves f + q·g with the fewest terms, and how many fewer than f has. Irrational coefficients
// count only where they cancel as expressions: else a 0 that nothing recognizes would stay.
struct Shortening {
  ExactNumber factor;
  std::ptrdiff_t saved = 0;
};
Shortening shortening(const Polynomial& f, const Polynomial& g) {
  struct Candidate {
    ExactNumber factor;
    std::ptrdiff_t cancelled;
  };
  std::vector<Candidate> candidates;
  std::vector<std::pair<const ExactNumber*, const ExactNumber*>> irrational;
  std::ptrdiff_t common = 0;
  for (const Monomial& b : g.monomials)
    common += std::any_of(f.monomials.begin(), f.monomials.end(), [&](const Monomial& m) { return m.factors == b.factors; });
  const auto added = static_cast<std::ptrdiff_t>(g.monomials.size()) - common;
  if (common <= added) return {};  // however many of them cancel
  for (const Monomial& b : g.monomials) {
    const auto a =
        std::find_if(f.monomials.begin(), f.monomials.end(), [&](const Monomial& m) { return m.factors == b.factors; });
    if (a == f.monomials.end()) continue;
    if (!a->coefficient.is_rational() || !b.coefficient.is_rational() || b.coefficient.is_zero()) {
      irrational.emplace_back(&a->coefficient, &b.coefficient);
      continue;
    }
    const ExactNumber q = -(a->coefficient / b.coefficient);
    const auto same = std::find_if(candidates.begin(), candidates.end(), [&](const Candidate& c) { return c.factor == q; });
    if (same == candidates.end()) {
      candidates.push_back({q, 1});
    } else {
      ++same->cancelled;
    }
  }
  Shortening best;
  for (const Candidate& c : candidates) {
    const std::ptrdiff_t saved = c.cancelled + static_cast<std::ptrdiff_t>(irrational.size()) - added;
    if (saved > best.saved && std::all_of(irrational.begin(), irrational.end(), [&](const auto& pair) {
          return certify::cancels(*pair.first, c.factor, *pair.second);
        }))
      best = {c.factor, saved};
  }
  return best;
}

}  // namespace

bool has_long_number(const Polynomial& f) {
  constexpr std::size_t kMostBits = 2000;
  return std::any_of(f.monomials.begin(), f.monomials.end(), [](const Monomial& m) {
    const mpq_class& q = m.coefficient.node().value;
    return std::max(mpz_sizeinbase(q.get_num_mpz_t(), 2), mpz_sizeinbase(q.get_den_mpz_t(), 2)) > kMostBits;
  });
}

BestShortening best_shortening(const std::vector<Polynomial>& rows, const std::function<void()>& check) {
  // Only a row that shares a product with another can shorten it (the constant alone is too little, but for a row that is
  // nothing else).
  std::map<Factors, std::vector<std::size_t>> with_product;
  std::vector<certify::Products> products;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    products.push_back(has_long_number(rows[i]) ? certify::Products{} : certify::products_of(rows[i]));
    if (products[i].size() > 1) std::erase(products[i], Factors{});
    for (const auto& product : products[i]) with_product[product].push_back(i);
  }
  BestShortening best;
  std::set<std::size_t> partners;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    partners.clear();
    for (const auto& product : products[i]) partners.insert(with_product[product].begin(), with_product[product].end());
    partners.erase(i);
    for (const std::size_t j : partners) {
      check();
      Shortening here = shortening(rows[i], rows[j]);
      if (here.saved > best.saved) best = {i, j, std::move(here.factor), here.saved};
    }
  }
  return best;
}

}  // namespace corank::solve
