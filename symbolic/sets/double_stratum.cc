#include "corank/symbolic/sets/double_stratum.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "corank/core/rounding.h"
#include "corank/symbolic/algebra/exact_algebra.h"
#include "corank/symbolic/algebra/exact_value.h"
#include "corank/symbolic/algebra/expression_range.h"
#include "corank/symbolic/algebra/ginac_lock.h"
#include "corank/symbolic/velocity/exact_matrix.h"
#include "corank/symbolic/velocity/kernel_vector.h"

namespace corank::symbolic {
namespace {

constexpr std::size_t kMostTermsOfF = 100;
constexpr int kMostBranches = 100;

// Numbers before the rests of a sum's terms.
std::map<GiNaC::ex, GiNaC::ex, GiNaC::ex_is_less> coefficients_of(const GiNaC::ex& sum) {
  std::map<GiNaC::ex, GiNaC::ex, GiNaC::ex_is_less> result;
  for (const GiNaC::ex& term : parts_of<GiNaC::add>(sum)) {
    GiNaC::ex number = 1, rest = 1;
    for (const GiNaC::ex& factor : parts_of<GiNaC::mul>(term))
      (GiNaC::is_a<GiNaC::numeric>(factor) ? number : rest) *= factor;
    result[rest] += number;
  }
  return result;
}

// The rational number q with f = q·g, both expanded and not 0.
std::optional<GiNaC::ex> ratio(const GiNaC::ex& f, const GiNaC::ex& g) {
  const auto a = coefficients_of(f), b = coefficients_of(g);
  const auto same = a.find(b.begin()->first);
  if (same == a.end()) return std::nullopt;
  const GiNaC::ex q = same->second / b.begin()->second;
  return (f - q * g).expand().is_zero() ? std::optional(q) : std::nullopt;
}

// The factors of a polynomial; none where they are not found.
std::vector<GiNaC::ex> factors_of(const Mechanism& mechanism, const ExactAlgebra& algebra, const GiNaC::ex& e,
                                  const Ended& ended) {
  ExpressionMatrix one;
  one.columns = {"f"};
  one.rows = {{algebra.expression(e)}};
  std::vector<GiNaC::ex> result;
  try {
    const ExactMatrix matrix(mechanism, one);
    const auto list = matrix.determinant().factors(ended);
    for (const RationalPolynomial& f : list.value_or(std::vector<RationalPolynomial>{}))
      result.push_back(algebra.value(matrix.expression(f)));
  } catch (const ModelError&) {  // no polynomial
  }
  return result;
}

// Of an affine function of lengths with ranges: the first of them, and what it is where the function is 0.
std::optional<Relation> solved(const Mechanism& mechanism, const ExactAlgebra& algebra, const GiNaC::ex& e) {
  const Coordinate* first = nullptr;
  GiNaC::ex rest = e;
  for (const Coordinate& c : mechanism.coordinates()) {
    const GiNaC::ex x = algebra.symbol(c.name);
    if (!rest.has(x)) continue;
    const bool is_affine = c.kind == CoordinateKind::length && rest.is_polynomial(x) && rest.degree(x) == 1 &&
                           GiNaC::is_a<GiNaC::numeric>(rest.coeff(x, 1));
    if (!is_affine || !c.has_range) return std::nullopt;
    rest = rest.coeff(x, 0);
    if (first == nullptr && !is_fixed(c)) first = &c;
  }
  if (first == nullptr || !GiNaC::is_a<GiNaC::numeric>(rest)) return std::nullopt;
  const GiNaC::ex x = algebra.symbol(first->name);
  return Expression::symbol(first->name) == algebra.expression((x - e / e.coeff(x, 1)).expand());
}

// The equations as representatives g and as h = F − q g, which vanish at the stratum.
struct Sorted {
  std::vector<std::size_t> representatives;
  std::map<std::size_t, GiNaC::ex> vanishing;
};

Sorted sorted(const ExactAlgebra& algebra, const DoubleStratum& stratum,
              const std::vector<TrigonometricSystem::Equation>& equations) {
  GiNaC::exmap at;
  for (const Relation& r : stratum.relations) at[algebra.symbol(r.lhs.name())] = algebra.value(r.rhs);
  Sorted result;
  std::vector<GiNaC::ex> wholes, there;
  for (std::size_t i = 0; i < equations.size(); ++i) {
    const GiNaC::ex whole = algebra.value(equations[i].relation.lhs - equations[i].relation.rhs),
                    own = whole.subs(at).expand();
    if (own.is_zero()) {
      result.vanishing[i] = whole;
      continue;
    }
    bool is_new = true;
    for (std::size_t p = 0; p < there.size() && is_new; ++p)
      if (const auto q = ratio(own, there[p])) {
        result.vanishing[i] = (whole - *q * wholes[p]).expand();
        is_new = false;
      }
    if (!is_new) continue;
    result.representatives.push_back(i);
    wholes.push_back(whole);
    there.push_back(own);
  }
  return result;
}

// A whole number that ‖x − a‖ does not exceed; nothing where it is large, or x = a is outside the ranges.
std::optional<int> farthest(const DoubleStratum& stratum, const std::vector<Coordinate>& coordinates,
                            const Mechanism& mechanism) {
  const UpwardRounding rounding;
  const auto known = [&](const Expression& e) -> std::optional<Interval> {
    const auto exact = [&](const Expression& value) { return exact_value(mechanism, value, "a range").enclose(); };
    const auto c = std::ranges::find(coordinates, e.name(), &Coordinate::name);
    if (e.kind() == Expression::Kind::symbol && c != coordinates.end())
      return Interval::hull(exact(c->lower), exact(c->upper));
    return e.kind() == Expression::Kind::number ? std::optional(exact(e)) : std::nullopt;
  };
  Interval sum(0);
  for (const Relation& r : stratum.relations) {
    const std::optional<Interval> x = range_of(r.lhs - r.rhs, known);
    if (!x || !x->contains(0)) return std::nullopt;
    sum = sum + Interval(0, x->mag()) * Interval(0, x->mag());
  }
  constexpr double kMost = 1e9;
  const double bound = std::ceil(std::sqrt(sum.hi()));
  return bound < kMost ? std::optional(static_cast<int>(bound) + 1) : std::nullopt;
}

// Looks for relations at which all of some polynomials vanish.
class Search {
 public:
  Search(const Mechanism& mechanism, const ExactAlgebra& algebra, const Ended& ended)
      : mechanism_(mechanism), algebra_(algebra), ended_(ended) {}

  std::vector<DoubleStratum> run(const Expression& f) {
    std::vector<GiNaC::ex> polynomials{algebra_.value(f)};
    if (parts_of<GiNaC::add>(polynomials[0]).size() > kMostTermsOfF) return {};
    for (const Coordinate& c : mechanism_.coordinates())
      polynomials.push_back(polynomials[0].diff(algebra_.symbol(c.name)).expand());
    branch(std::move(polynomials), {});
    return std::move(found_);
  }

 private:
  void branch(std::vector<GiNaC::ex> polynomials, DoubleStratum so_far) {
    std::erase_if(polynomials, [](const GiNaC::ex& e) { return e.is_zero(); });
    if (polynomials.empty()) {
      std::ranges::sort(so_far.relations, {}, [&](const Relation& r) { return mechanism_.find_coordinate(r.lhs.name()); });
      if (std::ranges::find(found_, so_far) == found_.end()) found_.push_back(std::move(so_far));
      return;
    }
    if (++branches_ > kMostBranches || is_over(ended_)) return;
    const auto rank = [&](const GiNaC::ex& e) {
      return std::pair(parts_of<GiNaC::add>(e).size(), algebra_.expression(e).text());
    };
    std::vector<Relation> relations;
    for (const GiNaC::ex& factor : factors_of(mechanism_, algebra_, std::ranges::min(polynomials, {}, rank), ended_))
      if (auto relation = solved(mechanism_, algebra_, factor)) relations.push_back(std::move(*relation));
    std::ranges::sort(relations, {}, &Relation::text);  // GiNaC's order is another in each process
    for (const Relation& relation : relations) {
      const GiNaC::exmap put{{algebra_.symbol(relation.lhs.name()), algebra_.value(relation.rhs)}};
      DoubleStratum next;
      for (const Relation& r : so_far.relations)
        next.relations.push_back(r.lhs == algebra_.expression(algebra_.value(r.rhs).subs(put).expand()));
      next.relations.push_back(relation);
      std::vector<GiNaC::ex> rest;
      for (const GiNaC::ex& e : polynomials) rest.push_back(e.subs(put).expand());
      branch(std::move(rest), next);
    }
  }

  const Mechanism& mechanism_;
  const ExactAlgebra& algebra_;
  const Ended& ended_;
  int branches_ = 0;
  std::vector<DoubleStratum> found_;
};

}  // namespace

std::string DoubleStratum::text() const {
  std::vector<std::string> texts;
  for (const Relation& r : relations) texts.push_back(r.text());
  return fmt::format("{}", fmt::join(texts, ", "));
}

std::optional<DoubleStratum> double_stratum(const Mechanism& mechanism, const Expression& f, const Ended& ended) {
  const TrigonometricSystem space = plain_system(mechanism);
  const std::vector<TrigonometricSystem::Equation>& phi = space.equations;
  const GinacLock lock;
  const ExactAlgebra algebra(mechanism);
  std::vector<DoubleStratum> found = Search(mechanism, algebra, ended).run(f);
  std::ranges::sort(found, {}, &DoubleStratum::text);
  for (DoubleStratum& stratum : found) {
    const bool is_as_large =
        stratum.relations.size() + sorted(algebra, stratum, phi).representatives.size() == phi.size() + 1;
    const std::optional<int> most = farthest(stratum, space.coordinates, mechanism);
    if (!is_as_large || !most) continue;
    stratum.farthest = *most;
    return stratum;
  }
  return std::nullopt;
}

void put_on(const DoubleStratum& stratum, const Mechanism& mechanism, TrigonometricSystem& system) {
  const GinacLock lock;
  std::vector<TrigonometricSystem::Equation> equations;
  for (const std::size_t i : sorted(ExactAlgebra(mechanism), stratum, system.equations).representatives)
    equations.push_back(system.equations[i]);
  for (const Relation& r : stratum.relations) equations.push_back({r, stratum.text(), model_place(mechanism), true});
  system.equations = std::move(equations);
  system.claimed.clear();
}

void put_beside(const DoubleStratum& stratum, const Mechanism& mechanism, TrigonometricSystem& system) {
  const std::vector<std::string> names = kernel_names(mechanism, stratum.relations.size(), 1, "eta");
  const std::string rho = kernel_names(mechanism, 1, 1, "rho")[0];
  const std::vector<Expression> eta = symbols(names);
  const SourceLocation where = model_place(mechanism);
  std::vector<std::string> unknowns = names;
  unknowns.push_back(rho);
  const GinacLock lock;
  const ExactAlgebra algebra(mechanism, unknowns);
  std::vector<TrigonometricSystem::Equation> equations;
  GiNaC::exmap along;
  for (std::size_t k = 0; k < eta.size(); ++k) {
    const Relation& r = stratum.relations[k];
    const Expression beside = Expression::symbol(rho) * eta[k];
    equations.push_back({r.lhs == (same_tree(r.rhs, 0) ? beside : r.rhs + beside), "beside " + r.text(), where, true});
    along[algebra.symbol(r.lhs.name())] = algebra.value(equations.back().relation.rhs);
  }
  const Sorted sort = sorted(algebra, stratum, system.equations);
  for (std::size_t i = 0; i < system.equations.size(); ++i) {
    TrigonometricSystem::Equation& e = equations.emplace_back(system.equations[i]);
    const auto h = sort.vanishing.find(i);
    if (h == sort.vanishing.end()) continue;
    const GiNaC::symbol& length = algebra.symbol(rho);
    const GiNaC::ex there = h->second.subs(along).expand();
    e.relation = algebra.expression((there / GiNaC::pow(length, there.ldegree(length))).expand()) == Expression(0);
    e.of_kernel = true;
  }
  equations.push_back({square_of(eta) == Expression(1), "norm of " + names.front(), where, true});
  system.equations = std::move(equations);
  system.inequalities.push_back({generic_form(eta) >= Expression(0), "half-space of " + names.front(), where, true});
  for (const std::string& name : names) system.further_unknowns.push_back({name});
  system.further_unknowns.push_back({rho, -stratum.farthest, stratum.farthest});
  system.claimed.clear();
}

}  // namespace corank::symbolic
