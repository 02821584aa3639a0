#include "corank/certify/implied.h"

#include <algorithm>
#include <map>
#include <optional>

#include "corank/certify/polynomial_algebra.h"
#include "corank/core/rounding.h"

namespace corank::certify {
namespace {

ExactNumber magnitude(const ExactNumber& x) { return x.sign() == -1 ? -x : x; }

bool is_plain_variable(const Monomial& m) { return m.degree() == 1 && !m.is_trigonometric(); }

// Rational numbers only: their signs are known.
bool at_least(const ExactNumber& a, const ExactNumber& b) { return (a - b).sign().value_or(-1) >= 0; }

// Σ coefficients[i] x_i² ≤ bound, every coefficient positive.
struct SumOfSquares {
  std::map<int, ExactNumber> coefficients;
  ExactNumber bound;
};

std::optional<SumOfSquares> sum_of_squares(const Polynomial& f) {
  SumOfSquares sum;
  for (const Monomial& m : f.monomials) {
    if (m.factors.empty()) {
      sum.bound = -m.coefficient;
      continue;
    }
    if (m.factors.size() != 1 || m.factors[0].power != 2 || m.coefficient.sign() != 1) return std::nullopt;
    sum.coefficients.emplace(m.factors[0].variable, m.coefficient);
  }
  if (sum.coefficients.empty() || sum.bound.sign() == -1) return std::nullopt;
  return sum;
}

class Implication {
 public:
  explicit Implication(const System& system) : system_(system) {
    for (const Variable& v : system.variables) {
      const bool within_one = v.within_one && system.coefficient_tolerance == 0;
      sides_.push_back({v.lower_implied || (within_one && at_least(-1, v.lower)),
                        v.upper_implied || (within_one && at_least(v.upper, 1))});
    }
    for (const Polynomial& f : system.equations) {
      const bool rational = std::ranges::all_of(
          f.monomials, [](const Monomial& m) { return m.coefficient.is_rational() && !carries_tolerance(m); });
      if (!rational) continue;
      if (auto sum = sum_of_squares(f)) {
        for (const auto& [j, a] : sum->coefficients) squares_of_[j].push_back(squares_.size());
        squares_.push_back(std::move(*sum));
      } else {
        rows_.push_back(&f);
      }
    }
  }

  std::vector<ImpliedSides> run() {
    const std::vector<Polynomial> sums = shorter_sums();
    std::vector<const Polynomial*> linear;
    for (const Polynomial* f : rows_)
      if (is_linear(*f)) linear.push_back(f);
    for (const Polynomial& f : sums) linear.push_back(&f);
    linear_of_.resize(system_.variables.size());
    for (std::size_t row = 0; row < linear.size(); ++row) {
      for (const Monomial& m : linear[row]->monomials)
        if (is_plain_variable(m)) linear_of_[m.factors[0].variable].push_back(row);
      open_.push_back(row);
    }
    for (const SumOfSquares& sum : squares_)
      for (const auto& [j, coefficient] : sum.coefficients) {
        const auto& a = coefficient;  // clang 14 lets no lambda capture a binding
        bound(j, [&](const ExactNumber& h) { return at_least(a * h * h, sum.bound); });
      }
    for (const Polynomial* f : rows_) by_products(*f);
    while (!open_.empty()) {  // a row that has a new bound comes again
      const std::size_t row = open_.back();
      open_.pop_back();
      by_sums(*linear[row]);
    }
    return sides_;
  }

 private:
  static bool is_linear(const Polynomial& f) {
    return std::ranges::all_of(
        f.monomials, [](const Monomial& m) { return m.factors.empty() || m.is_trigonometric() || is_plain_variable(m); });
  }

  // Of two linear equations each, without a variable of both.
  std::vector<Polynomial> shorter_sums() const {
    constexpr std::size_t kMostRows = 60;
    std::vector<const Polynomial*> linear;
    for (const Polynomial* f : rows_)
      if (is_linear(*f)) linear.push_back(f);
    std::vector<Polynomial> sums;
    if (linear.size() > kMostRows) return sums;
    for (std::size_t i = 0; i < linear.size(); ++i)
      for (std::size_t k = i + 1; k < linear.size(); ++k) add_shorter_sums(*linear[i], *linear[k], sums);
    return sums;
  }

  static void add_shorter_sums(const Polynomial& f, const Polynomial& g, std::vector<Polynomial>& sums) {
    for (const Monomial& m : f.monomials) {
      const auto same = std::ranges::find_if(
          g.monomials, [&](const Monomial& n) { return n.factors == m.factors && is_plain_variable(n); });
      if (same == g.monomials.end()) continue;
      Polynomial sum = certify::sum(f, -m.coefficient / same->coefficient, g);
      if (sum.monomials.size() < std::max(f.monomials.size(), g.monomials.size())) sums.push_back(std::move(sum));
    }
  }

  // Takes |x_j| ≤ h as implied for each end h ≥ 0 of its domain for which that is true.
  template <class Holds>
  void bound(int j, Holds holds) {
    const Variable& v = system_.variables[j];
    const auto reaches = [&](const ExactNumber& h) { return h.is_rational() && h.sign() != -1 && holds(h); };
    if (reaches(-v.lower)) imply(j, false);
    if (reaches(v.upper)) imply(j, true);
  }

  void imply(int j, bool upper) {
    bool& side = upper ? sides_[j].upper : sides_[j].lower;
    if (side) return;
    side = true;
    const auto& rows = linear_of_[j];
    open_.insert(open_.end(), rows.begin(), rows.end());
  }

  // Is the upper (else lower) bound of a·x_j that of x_j's upper side?
  static bool by_upper_side(const Monomial& m, bool upper) { return upper == (m.coefficient.sign() == 1); }
  // Is there an implied upper (else lower) bound of m's value?
  bool has_end(const Monomial& m, bool upper) const {
    if (m.factors.empty() || m.is_trigonometric()) return true;
    const std::size_t j = m.factors[0].variable;
    const bool of_upper = by_upper_side(m, upper);
    return (of_upper ? sides_[j].upper : sides_[j].lower) &&
           (of_upper ? system_.variables[j].upper : system_.variables[j].lower).is_rational();
  }
  // That bound, where there is one.
  ExactNumber end(const Monomial& m, bool upper) const {
    if (m.factors.empty()) return m.coefficient;
    if (m.is_trigonometric()) return upper ? magnitude(m.coefficient) : -magnitude(m.coefficient);
    const Variable& v = system_.variables[m.factors[0].variable];
    return m.coefficient * (by_upper_side(m, upper) ? v.upper : v.lower);
  }
  // Is m a variable whose side close() is about not known to be implied?
  bool may_close(const Monomial& m, bool upper) const {
    if (!is_plain_variable(m)) return false;
    const ImpliedSides& sides = sides_[m.factors[0].variable];
    return !(upper == (m.coefficient.sign() == -1) ? sides.upper : sides.lower);
  }

  // The lemma about sums, for each variable of Σ m = 0.
  void by_sums(const Polynomial& f) {
    for (const bool upper : {false, true}) {
      const Monomial* open = nullptr;  // the last one without a bound
      int missing = 0;
      for (const Monomial& m : f.monomials)
        if (!has_end(m, upper)) open = &m, ++missing;
      const bool says_something =
          missing == 0 ? std::ranges::any_of(f.monomials, [&](const Monomial& m) { return may_close(m, upper); })
                       : missing == 1 && may_close(*open, upper);
      if (!says_something) continue;  // exact sums are long work
      ExactNumber sum;
      for (const Monomial& m : f.monomials)
        if (&m != open) sum = sum + end(m, upper);
      if (open) close(*open, sum, upper);
      for (const Monomial& m : f.monomials)
        if (missing == 0 && may_close(m, upper)) close(m, sum - end(m, upper), upper);
    }
  }

  // m + rest = 0 and rest ≤ sum (upper) or rest ≥ sum: −m does, too.
  void close(const Monomial& m, const ExactNumber& sum, bool upper) {
    const int j = m.factors[0].variable;
    const Variable& v = system_.variables[j];
    const bool side = upper == (m.coefficient.sign() == -1);  // x_j = −rest/coefficient
    const ExactNumber& end_of_j = side ? v.upper : v.lower;
    if (!end_of_j.is_rational()) return;
    const ExactNumber limit = -sum / m.coefficient;
    if (side ? at_least(end_of_j, limit) : at_least(limit, end_of_j)) imply(j, side);
  }

  // The lemma about products, where f has one variable alone and products of two.
  void by_products(const Polynomial& f) {
    const Monomial* linear = nullptr;
    ExactNumber rest, largest;
    std::vector<std::pair<int, int>> products;
    for (const Monomial& m : f.monomials) {
      if (m.factors.empty()) {
        rest = magnitude(m.coefficient);
      } else if (is_plain_variable(m) && !linear) {
        linear = &m;
      } else if (m.factors.size() == 2 && m.degree() == 2) {
        products.emplace_back(m.factors[0].variable, m.factors[1].variable);
        if (at_least(magnitude(m.coefficient), largest)) largest = magnitude(m.coefficient);
      } else {
        return;
      }
    }
    if (!linear || products.empty()) return;
    for (const std::size_t first : squares_of(products[0].first)) {
      for (const std::size_t second : squares_of(products[0].second)) {
        const auto square = square_of_bound(products, squares_[first], squares_[second]);
        if (!square) continue;
        bound(linear->factors[0].variable, [&](const ExactNumber& h) {
          const ExactNumber left = magnitude(linear->coefficient) * h - rest;
          return left.sign() != -1 && at_least(left * left, largest * largest * *square);
        });
      }
    }
  }

  const std::vector<std::size_t>& squares_of(int variable) const {
    static const std::vector<std::size_t> none;
    const auto found = squares_of_.find(variable);
    return found == squares_of_.end() ? none : found->second;
  }

  // Y Z/(min e min f), where each product is one of a variable of y and one of z, no variable twice.
  static std::optional<ExactNumber> square_of_bound(const std::vector<std::pair<int, int>>& products, const SumOfSquares& y,
                                                    const SumOfSquares& z) {
    std::map<int, ExactNumber> of_y, of_z;
    for (auto [first, second] : products) {
      if (!y.coefficients.contains(first) || !z.coefficients.contains(second)) std::swap(first, second);
      const auto a = y.coefficients.find(first), b = z.coefficients.find(second);
      if (a == y.coefficients.end() || b == z.coefficients.end()) return std::nullopt;
      if (!of_y.insert(*a).second || !of_z.insert(*b).second) return std::nullopt;
    }
    const auto least = [](const std::map<int, ExactNumber>& coefficients) {
      ExactNumber result = coefficients.begin()->second;
      for (const auto& [j, c] : coefficients)
        if (at_least(result, c)) result = c;
      return result;
    };
    return y.bound * z.bound / (least(of_y) * least(of_z));
  }

  const System& system_;
  std::vector<ImpliedSides> sides_;
  std::vector<SumOfSquares> squares_;
  std::map<int, std::vector<std::size_t>> squares_of_;  // those with a variable
  std::vector<const Polynomial*> rows_;
  std::vector<std::vector<std::size_t>> linear_of_;  // the linear rows of a variable
  std::vector<std::size_t> open_;                    // linear rows that may say more than before
};

}  // namespace

std::vector<ImpliedSides> implied_domains(const System& system) {
  const UpwardRounding rounding;  // of the enclosures in sums, which nobody looks at
  return Implication(system).run();
}

}  // namespace corank::certify
