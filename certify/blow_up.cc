#include "corank/certify/blow_up.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

#include "corank/certify/algebraic_number.h"
#include "corank/certify/exact_verification.h"

namespace corank::certify {
namespace {

// A polynomial in u with coefficients in Q[t]/(p): exponents of u → coefficient. A term of degree d in u stands with t^d.
using Exponents = std::vector<int>;
using Form = std::map<Exponents, RationalPolynomial>;

int degree(const Exponents& e) { return std::accumulate(e.begin(), e.end(), 0); }

class BlowUp {
 public:
  BlowUp(const System& system, const ExactPoint& point, const Ended& ended)
      : system_(system),
        point_(point),
        ended_(ended),
        n_(system.variables.size()),
        t_(point.polynomial, point.lower, point.upper) {}

  std::optional<std::vector<System>> faces(const ExactNumber& radius) {
    std::vector<Form> rows;
    for (const Polynomial& f : system_.equations) {
      if (is_over(ended_)) return std::nullopt;
      rows.push_back(shifted(f));
      if (rows.back().contains(Exponents(n_, 0))) return std::nullopt;  // F(p) ≠ 0
    }
    if (!eliminate_linear_parts(rows)) return std::nullopt;
    std::vector<System> faces;
    for (std::size_t j = 0; j < n_; ++j) faces.push_back(face(rows, j, radius));
    return faces;
  }

 private:
  void add(Form& f, const Exponents& e, const RationalPolynomial& c) const {
    RationalPolynomial& entry = f[e];
    entry = sum(entry, c);
    if (entry.empty()) f.erase(e);
  }

  // f(p + u)
  Form shifted(const Polynomial& f) const {
    Form result;
    for (const Monomial& m : f.monomials) {
      if (!m.coefficient.is_rational() || m.is_trigonometric()) throw std::domain_error("not a rational polynomial");
      Form product{{Exponents(n_, 0), {m.coefficient}}};
      for (const Factor& x : m.factors)
        for (int k = 0; k < x.power; ++k) {
          const std::size_t v = x.variable;
          Form next;
          for (const auto& [e, c] : product) {
            const RationalPolynomial constant = t_.product(c, point_.coordinates[v]);
            if (!constant.empty()) add(next, e, constant);
            Exponents with = e;
            ++with[v];
            add(next, with, c);
          }
          product = std::move(next);
        }
      for (const auto& [e, c] : product) add(result, e, c);
    }
    return result;
  }

  Exponents unit(std::size_t v) const {
    Exponents e(n_, 0);
    e[v] = 1;
    return e;
  }

  // Row operations a := pivot · a − a_v · (pivot row), regular since the pivot is not 0, until a row has no linear part or a
  // pivot of its own. False where a sign cannot be decided, or the run has ended.
  bool eliminate_linear_parts(std::vector<Form>& rows) const {
    for (std::size_t from = 0; from < rows.size(); ++from) {
      std::size_t row = rows.size(), v = 0;
      for (std::size_t i = from; i < rows.size() && row == rows.size(); ++i)
        for (std::size_t j = 0; j < n_ && row == rows.size(); ++j) {
          const auto entry = rows[i].find(unit(j));
          if (entry == rows[i].end()) continue;  // ≡ 0
          const auto sign = t_.sign(entry->second);
          if (!sign || *sign == 0) return false;  // 0 at t, but not modulo the polynomial
          row = i, v = j;
        }
      if (row == rows.size()) return true;
      std::swap(rows[from], rows[row]);
      const RationalPolynomial pivot = rows[from].at(unit(v));
      for (std::size_t i = 0; i < rows.size(); ++i) {
        const auto entry = rows[i].find(unit(v));
        if (i == from || entry == rows[i].end()) continue;
        if (is_over(ended_)) return false;
        const RationalPolynomial factor = scaled(entry->second, ExactNumber(-1));
        Form next;
        for (const auto& [e, c] : rows[i]) add(next, e, t_.product(pivot, c));
        for (const auto& [e, c] : rows[from]) add(next, e, t_.product(factor, c));
        rows[i] = std::move(next);
      }
    }
    return true;
  }

  System face(const std::vector<Form>& rows, std::size_t one, const ExactNumber& radius) const {
    System result;
    result.name = "blow-up of " + system_.name;
    for (std::size_t j = 0; j < n_; ++j)
      result.variables.emplace_back("u" + std::to_string(j + 1), VariableKind::length, ExactNumber(j == one ? 1 : -1), 1);
    const int scale = static_cast<int>(n_), root = scale + 1;
    result.variables.emplace_back("t", VariableKind::length, -radius, radius);
    const bool rational = t_.polynomial().size() == 2;
    if (!rational) {
      result.variables.emplace_back("alpha", VariableKind::length, t_.lower(), t_.upper());
      result.equations.push_back({{}, "defining polynomial"});
      add_powers(result.equations.back(), t_.polynomial(), {}, root);
    }
    for (const Form& row : rows) {
      if (row.empty()) continue;
      int order = degree(row.begin()->first);
      for (const auto& [e, c] : row) order = std::min(order, degree(e));
      Polynomial g;
      g.source = "blow-up";
      for (const auto& [e, c] : row) {
        std::vector<Factor> factors;
        for (std::size_t j = 0; j < n_; ++j)
          if (e[j] > 0) factors.push_back({static_cast<int>(j), e[j]});
        if (const int power = degree(e) - order; power > 0) factors.push_back({scale, power});
        add_powers(g, c, factors, root);
      }
      result.equations.push_back(std::move(g));
    }
    result.configuration_size = result.size();
    return result;
  }

  // Adds Σ_k c_k α^k · (factors).
  static void add_powers(Polynomial& f, const RationalPolynomial& c, const std::vector<Factor>& factors, int root) {
    for (std::size_t k = 0; k < c.size(); ++k) {
      if (c[k].is_zero()) continue;
      std::vector<Factor> all = factors;
      if (k > 0) all.push_back({root, static_cast<int>(k)});
      f.monomials.emplace_back(c[k], std::move(all));
    }
  }

  const System& system_;
  const ExactPoint& point_;
  const Ended& ended_;
  std::size_t n_;
  AlgebraicNumber t_;
};

}  // namespace

std::optional<std::vector<System>> blow_up(const System& system, const ExactPoint& point, const ExactNumber& radius,
                                           const Ended& ended) {
  if (point.coordinates.size() != system.variables.size() || system.coefficient_tolerance > 0 || radius.sign() != 1)
    return std::nullopt;
  for (const RationalPolynomial& x : point.coordinates)
    if (x.empty()) return std::nullopt;
  try {
    return BlowUp(system, point, ended).faces(radius);
  } catch (const std::domain_error&) {
    return std::nullopt;
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
}

bool holds_nothing_else(const ExactPoint& point, const std::vector<Interval>& box) {
  return point.sole_within > 0 && (reach(point, box) - ExactNumber::dyadic(point.sole_within)).sign() == -1;
}

}  // namespace corank::certify
