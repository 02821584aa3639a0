#include "corank/check/blow_up.h"

#include <algorithm>
#include <map>

#include "corank/check/problem.h"
#include "corank/check/search.h"

namespace corank::check {
namespace {

constexpr std::size_t kMostParts = 200'000;  // of a face

// A polynomial in u and t with coefficients in ℚ[a]/(p), a the point's number: u_j is variable j, t variable n.
using Blown = std::map<Factors, RationalPolynomial>;

class BlowUp {
 public:
  BlowUp(const System& system, const ExactCheck& point) : system_(system), point_(point), n_(system.size()) {}

  std::string run(double radius) {
    for (const Polynomial& f : system_.equations) {
      std::optional<Blown> row = blown(f);
      if (!row) return "its equations are not polynomials with rational coefficients";
      rows_.push_back(std::move(*row));
    }
    if (!eliminate()) return "the rank of the Jacobian is not shown there";
    for (Blown& row : rows_)
      if (!divide(row)) return "an equation does not hold there";
    for (int j = 0; j < n_; ++j)
      if (!is_empty(face(j, radius))) return "it is not shown that no other solution is near it";
    return {};
  }

 private:
  void add(Blown& to, const Factors& factors, const RationalPolynomial& c) const {
    RationalPolynomial& sum = to[factors];
    sum = point_.sum(sum, c);
    if (sum.empty()) to.erase(factors);
  }

  Blown product(const Blown& f, const Blown& g) const {
    Blown result;
    for (const auto& [x, c] : f)
      for (const auto& [y, d] : g) add(result, merged(x, y), point_.product(c, d));
    return result;
  }

  // F(p + t·u).
  std::optional<Blown> blown(const Polynomial& f) const {
    Blown sum;
    for (const Monomial& m : f.monomials) {
      if (!m.coefficient.is_rational()) return std::nullopt;
      Blown term;
      add(term, {}, {m.coefficient});
      for (const Factor& x : m.factors) {
        if (x.function != Function::identity || !point_.knows(x.variable)) return std::nullopt;
        Blown value;
        add(value, {}, point_.polynomial(x.variable));
        add(value, {{x.variable, 1}, {n_, 1}}, {1});
        for (int k = 0; k < x.power; ++k) term = product(term, value);
      }
      for (const auto& [factors, c] : term) add(sum, factors, c);
    }
    return sum;
  }

  RationalPolynomial linear(const Blown& row, int j) const {
    const auto at = row.find({{j, 1}, {n_, 1}});
    return at == row.end() ? RationalPolynomial() : at->second;
  }

  // Rows are multiplied by pivots that are not 0, and other rows' multiples subtracted: T is regular. False: undecided.
  bool eliminate() {
    std::vector<unsigned char> done(rows_.size(), 0);
    for (;;) {
      std::size_t pivot_row = rows_.size();
      int pivot = -1;
      bool open = false;
      for (std::size_t i = 0; i < rows_.size() && pivot < 0; ++i)
        for (int j = 0; j < n_ && !done[i] && pivot < 0; ++j) {
          const RationalPolynomial entry = linear(rows_[i], j);
          open = open || !entry.empty();
          if (!entry.empty() && !point_.enclose(entry).has_zero()) pivot_row = i, pivot = j;
        }
      if (pivot < 0) return !open;
      done[pivot_row] = 1;
      const Blown by = rows_[pivot_row];
      Blown scale;
      add(scale, {}, linear(by, pivot));
      for (std::size_t i = 0; i < rows_.size(); ++i) {
        const RationalPolynomial entry = linear(rows_[i], pivot);
        if (i == pivot_row || entry.empty()) continue;
        Blown factor;
        add(factor, {}, point_.product(entry, {-1}));
        Blown row = product(rows_[i], scale);
        for (const auto& [factors, c] : product(by, factor)) add(row, factors, c);
        rows_[i] = std::move(row);
      }
    }
  }

  // Divides by the power of t; false where the row has a constant.
  bool divide(Blown& row) const {
    const auto power_of_t = [&](const Factors& factors) {
      return !factors.empty() && factors.back().variable == n_ ? factors.back().power : 0;
    };
    int least = row.empty() ? 0 : 1 << 30;
    for (const auto& [factors, c] : row) least = std::min(least, power_of_t(factors));
    if (!row.empty() && least == 0) return false;
    Blown result;
    for (const auto& [factors, c] : row) {
      Factors rest = factors;
      rest.back().power -= least;
      if (rest.back().power == 0) rest.pop_back();
      result[rest] = c;
    }
    row = std::move(result);
    return true;
  }

  System face(int j, double radius) const {
    System face;
    for (int i = 0; i < n_; ++i)
      face.variables.emplace_back("u" + std::to_string(i), VariableKind::length, i == j ? 1 : -1, 1);
    face.variables.emplace_back("t", VariableKind::length, -ExactNumber::dyadic(radius), ExactNumber::dyadic(radius));
    face.variables.emplace_back("a", VariableKind::length, point_.lower(), point_.upper());
    for (const Blown& row : rows_) {
      Polynomial f;
      for (const auto& [factors, c] : row)
        for (std::size_t k = 0; k < c.size(); ++k) {
          if (c[k].is_zero()) continue;
          Factors all = factors;
          if (k > 0) all.push_back({n_ + 1, static_cast<int>(k)});
          f.monomials.emplace_back(c[k], all);
        }
      if (!f.monomials.empty()) face.equations.push_back(std::move(f));
    }
    const auto names_a = [&](const Polynomial& f) {
      return std::ranges::any_of(f.monomials, [&](const Monomial& m) {
        return std::ranges::any_of(m.factors, [&](const Factor& x) { return x.variable == n_ + 1; });
      });
    };
    // Rows without a: what defines it says nothing of them.
    if (std::ranges::none_of(face.equations, names_a)) {
      face.variables.pop_back();
      return face;
    }
    Polynomial p;
    for (std::size_t k = 0; k < point_.minimal().size(); ++k)
      if (!point_.minimal()[k].is_zero())
        p.monomials.emplace_back(point_.minimal()[k], k == 0 ? Factors() : Factors{{n_ + 1, static_cast<int>(k)}});
    face.equations.push_back(std::move(p));
    return face;
  }

  bool is_empty(const System& face) const {
    const Problem problem(face, {}, point_.stop());
    if (problem.contradiction()) return true;
    return Search(problem).is_empty(problem.domain(), kMostParts);
  }

  const System& system_;
  const ExactCheck& point_;
  int n_;
  std::vector<Blown> rows_;
};

}  // namespace

std::string check_sole(const System& system, const ExactCheck& point, double radius) {
  return BlowUp(system, point).run(radius);
}

}  // namespace corank::check
