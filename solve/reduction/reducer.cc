#include "corank/solve/reduction/reducer.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "corank/certify/polynomial_algebra.h"
#include "corank/core/exact_number_node.h"
#include "corank/core/rounding.h"
#include "corank/solve/reduction/product_elimination.h"

namespace corank::solve {
namespace {

using certify::Reduction;

constexpr std::size_t kMostEliminations = 4;

bool is_short(const ExactNumber& q) {
  constexpr std::size_t kMostDigits = 100;
  return q.text().size() <= kMostDigits;
}

constexpr double kRounding = 1e-12;  // relative, of quotients in doubles
constexpr double kSmallTerm = 1e-2;

// A rational number with a small denominator that close to x, relatively.
std::optional<ExactNumber> simple_rational(double x, double tolerance) {
  constexpr double kLargest = 1000;
  double p0 = 1, q0 = 0, p1 = std::floor(x), q1 = 1, rest = x;  // convergents of the continued fraction
  while (q1 <= kLargest && std::fabs(p1) <= kLargest * kLargest) {
    if (std::fabs(x - p1 / q1) <= tolerance * std::fabs(x)) return ExactNumber::dyadic(p1) / ExactNumber::dyadic(q1);
    const double fraction = rest - std::floor(rest);
    if (fraction == 0) break;
    rest = 1 / fraction;
    const double digit = std::floor(rest);
    p0 = std::exchange(p1, digit * p1 + p0);
    q0 = std::exchange(q1, digit * q1 + q0);
  }
  return std::nullopt;
}

// Exact arithmetic with such numbers takes minutes, and intervals of doubles gain nothing by it: more than 2,000 bits.
bool has_long_number(const Polynomial& f) {
  constexpr std::size_t kMostBits = 2000;
  return std::ranges::any_of(f.monomials, [](const Monomial& m) {
    const mpq_class& q = m.coefficient.node().value;
    return std::max(mpz_sizeinbase(q.get_num_mpz_t(), 2), mpz_sizeinbase(q.get_den_mpz_t(), 2)) > kMostBits;
  });
}

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
    common += std::ranges::any_of(f.monomials, [&](const Monomial& m) { return m.factors == b.factors; });
  const auto added = static_cast<std::ptrdiff_t>(g.monomials.size()) - common;
  if (common <= added) return {};  // however many of them cancel
  for (const Monomial& b : g.monomials) {
    const auto a = std::ranges::find_if(f.monomials, [&](const Monomial& m) { return m.factors == b.factors; });
    if (a == f.monomials.end()) continue;
    if (!a->coefficient.is_rational() || !b.coefficient.is_rational() || b.coefficient.is_zero()) {
      irrational.emplace_back(&a->coefficient, &b.coefficient);
      continue;
    }
    const ExactNumber q = -(a->coefficient / b.coefficient);
    const auto same = std::ranges::find_if(candidates, [&](const Candidate& c) { return c.factor == q; });
    if (same == candidates.end()) {
      candidates.push_back({q, 1});
    } else {
      ++same->cancelled;
    }
  }
  Shortening best;
  for (const Candidate& c : candidates) {
    const std::ptrdiff_t saved = c.cancelled + static_cast<std::ptrdiff_t>(irrational.size()) - added;
    if (saved > best.saved && std::ranges::all_of(irrational, [&](const auto& pair) {
          return certify::cancels(*pair.first, c.factor, *pair.second);
        }))
      best = {c.factor, saved};
  }
  return best;
}

// `saved`: how many terms fewer than rows[row] the sum rows[row] + factor · rows[other] has; 0: there is no such pair.
struct BestShortening {
  std::size_t row = 0, other = 0;
  ExactNumber factor;
  std::ptrdiff_t saved = 0;
};

// Of all pairs the first that saves most. Rows with long numbers stay out of it. `check` is called for each pair.
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

// Thrown and caught here: the reduction is given up.
struct GivenUp {};

class Reducer {
 public:
  Reducer(const System& system, Eliminate eliminate, const Ended& ended, std::vector<int> parameters)
      : poll_([&ended] {
          if (is_over(ended)) throw GivenUp();
        }),
        rewriting_(system, eliminate != Eliminate::exact, std::move(parameters), poll_) {}
  Reduction run();

 private:
  // Replaces variables whose domain is one number by it.
  void eliminate_fixed();
  // One step of (a), of (b). False: nothing to do.
  bool eliminate_tied();
  bool eliminate_image();
  // Steps of (c) that leave few products. False: nothing to do.
  bool eliminate_shared();
  // One step of (c). False: nothing to do.
  bool shorten();
  std::vector<double> sizes() const;
  /// How large the variable's term in an affine equation is at most.
  double term(const Polynomial& f, int variable) const {
    for (const Monomial& m : f.monomials)
      if (!m.factors.empty() && m.factors[0].variable == variable)
        return m.enclosure.mag() * rewriting_.system().variables[variable].domain.mag();
    return 0;
  }
  ExactNumber exact_factor(const RowSum& sum) const;
  void add(std::size_t row, std::size_t other, const ExactNumber& factor) {
    rewriting_.apply(SumOfEquations{rewriting_.origin(row), rewriting_.origin(other), factor});
  }
  void eliminate(std::size_t row, int variable) { rewriting_.apply(Elimination{variable, rewriting_.origin(row)}); }
  // Does the value put in for the variable leave polynomials of moderate length, degree and coefficients?
  bool affordable(int variable, const Polynomial& value) const;

  const std::function<void()> poll_;
  certify::Rewriting rewriting_;
};

bool Reducer::affordable(int variable, const Polynomial& value) const {
  constexpr double kMostExpanded = 1000, kLargestCoefficient = 1e100;
  constexpr int kLargestPower = 100;
  if (has_long_number(value)) return false;
  int degree = 0;
  double size = 1;
  for (const Monomial& m : value.monomials) degree = std::max(degree, m.degree()), size += m.enclosure.mag();
  const auto fits = [&](const Polynomial& f) {
    return std::ranges::all_of(f.monomials, [&](const Monomial& m) {
      for (const Factor& x : m.factors) {
        if (x.variable != variable || x.power == 1) continue;
        // value^p has at most C(p + t − 1, p) terms, t those of the value.
        double terms = 1;
        for (int k = 1; k <= x.power && terms <= kMostExpanded; ++k)
          terms *= (static_cast<double>(value.monomials.size()) + k - 1) / k;
        return terms <= kMostExpanded && degree <= kLargestPower / x.power && std::pow(size, x.power) <= kLargestCoefficient;
      }
      return true;
    });
  };
  return std::ranges::all_of(rewriting_.system().equations, fits) &&
         std::ranges::all_of(rewriting_.system().inequalities, fits) &&
         std::ranges::all_of(rewriting_.definitions(), [&](const auto& d) { return fits(d.second); });
}

void Reducer::eliminate_fixed() {
  for (int j = 0; j < rewriting_.system().size(); ++j)
    if (const auto value = rewriting_.fixed_value(j); value && affordable(j, *value)) rewriting_.apply(Elimination{j, {}});
}

bool Reducer::eliminate_tied() {
  poll_();
  for (std::size_t i = 0; i < rewriting_.system().equations.size(); ++i) {
    const Polynomial& f = rewriting_.system().equations[i];
    const std::vector<int> variables = certify::variables_of(f);
    if (variables.empty() || variables.size() > 2 || !certify::is_affine(f)) continue;
    // The later variable goes: kernel unknowns and auxiliaries stand behind the configuration. But not one of a far smaller
    // term, in whose value the other's rounding would grow.
    std::vector<int> order(variables.rbegin(), variables.rend());
    if (order.size() == 2 && term(f, order[0]) < kSmallTerm * term(f, order[1])) std::swap(order[0], order[1]);
    for (const int v : order)
      if (const auto value = rewriting_.value_of(v, i); value && affordable(v, *value)) {
        eliminate(i, v);
        return true;
      }
  }
  return false;
}

bool Reducer::eliminate_image() {
  poll_();
  std::vector<int> uses(rewriting_.system().variables.size(), 0);
  for (const auto* rows : {&rewriting_.system().equations, &rewriting_.system().inequalities})
    for (const Polynomial& f : *rows)
      for (int v : certify::variables_of(f)) ++uses[v];
  for (std::size_t i = 0; i < rewriting_.system().equations.size(); ++i) {
    const Polynomial& f = rewriting_.system().equations[i];
    for (int v : certify::variables_of(f)) {
      if (uses[v] != 1 || certify::variables_of(f).size() < 2) continue;
      const auto value = rewriting_.value_of(v, i);
      if (!value || !affordable(v, *value)) continue;
      // A sine or cosine is no factor: c = cos t stays where another image is r·c.
      const bool has_function =
          std::ranges::any_of(value->monomials, [](const Monomial& m) { return m.is_trigonometric(); });
      if (has_function && std::ranges::any_of(rewriting_.definitions(), [&](const auto& definition) {
            return certify::mentions(definition.second, v);
          }))
        continue;
      eliminate(i, v);
      return true;
    }
  }
  return false;
}

std::vector<double> Reducer::sizes() const {
  std::vector<double> result;
  for (const Variable& v : rewriting_.system().variables) result.push_back(v.domain.mag());
  return result;
}

// The quotient of two coefficients itself, of which the factor is a rounded value, where that is rational and short.
ExactNumber Reducer::exact_factor(const RowSum& sum) const {
  const Polynomial &f = rewriting_.system().equations[sum.row], &g = rewriting_.system().equations[sum.other];
  const auto is_it = [&](const ExactNumber& q) {
    return (q - sum.factor).enclose().mag() <= kRounding * sum.factor.enclose().mag() && is_short(q);
  };
  const std::optional<ExactNumber> simple = simple_rational(sum.factor.enclose().mid(), kRounding);
  for (const Monomial& b : g.monomials)
    for (const Monomial& a : f.monomials) {
      if (a.factors != b.factors || b.coefficient.is_zero()) continue;
      if (a.coefficient.is_rational() && b.coefficient.is_rational()) {
        if (ExactNumber q = -(a.coefficient / b.coefficient); is_it(q)) return q;
      } else if (simple && certify::cancels(a.coefficient, *simple, b.coefficient)) {
        return *simple;
      }
    }
  return sum.factor;
}

bool Reducer::eliminate_shared() {
  if (!rewriting_.may_add()) return false;
  std::vector<Polynomial> rows = rewriting_.system().equations;
  for (Polynomial& f : rows)
    if (has_long_number(f)) f.monomials.clear();
  const std::vector<RowSum> sums = eliminate_products(rows, sizes(), poll_);
  for (const RowSum& sum : sums) {
    poll_();
    add(sum.row, sum.other, exact_factor(sum));
  }
  return !sums.empty();
}

bool Reducer::shorten() {
  if (!rewriting_.may_add()) return false;
  const std::vector<double> of_variables = sizes();
  std::vector<Polynomial> rows;
  for (const Polynomial& f : rewriting_.system().equations)
    rows.push_back(has_long_number(f) ? f : without_residues(f, of_variables));
  const BestShortening best = best_shortening(rows, poll_);
  if (best.saved == 0) return false;
  add(best.row, best.other, best.factor);
  return true;
}

Reduction Reducer::run() {
  const UpwardRounding rounding;
  eliminate_fixed();
  // Images first: a shorter equation may have its variable in two.
  std::size_t eliminated = 0, variables_left = rewriting_.system().variables.size() + 1;
  const auto go_on = [&] {  // products again where there are fewer variables
    const std::size_t left = rewriting_.system().variables.size() - rewriting_.definitions().size();
    if (eliminated < kMostEliminations && left < std::exchange(variables_left, left)) {
      ++eliminated;
      if (eliminate_shared()) return true;
    }
    return shorten();
  };
  do {
    while (rewriting_.drop_identities() && eliminate_tied()) {
    }
    rewriting_.drop_repeated();
    while (rewriting_.consistent() && eliminate_image()) {
    }
  } while (rewriting_.consistent() && go_on());
  return rewriting_.result();
}

}  // namespace

Reduction reduce(const System& system, Eliminate eliminate, const Ended& ended, const std::vector<int>& parameters) {
  try {
    return Reducer(system, eliminate, ended, parameters).run();
  } catch (const GivenUp&) {
    return certify::Rewriting(system, true).result();
  }
}

Reduction reduce(const System& system, const Ended& ended) {
  if (system.coefficient_tolerance > 0 && system.equations.size() <= system.variables.size())
    return reduce(system, Eliminate::integers, ended);
  Reduction exact = reduce(system, Eliminate::exact, ended);
  if (system.coefficient_tolerance == 0) return exact;
  if (exact.consistent && exact.system.equations.size() <= exact.system.variables.size()) return exact;
  return reduce(system, Eliminate::integers, ended);
}

}  // namespace corank::solve
