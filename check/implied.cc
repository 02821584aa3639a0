#include "corank/check/implied.h"

#include <algorithm>

namespace corank::check {
namespace {

ExactNumber magnitude(const ExactNumber& x) { return x.sign() == -1 ? -x : x; }
bool not_less(const ExactNumber& a, const ExactNumber& b) { return (a - b).sign().value_or(-1) >= 0; }

}  // namespace

Implied::Implied(const System& system, const std::vector<Terms>& equations) {
  for (const Terms& f : equations) {
    const bool rational =
        f.is_exact() && std::ranges::all_of(f.list(), [](const auto& term) { return term.second.exact.is_rational(); });
    if (!rational) continue;
    equations_.push_back(f);
    Squares squares;
    bool is_sum = true;
    for (const auto& [factors, c] : f.list()) {
      if (factors.empty()) {
        squares.bound = -c.exact;
      } else if (factors.size() == 1 && factors[0].power == 2 && c.exact.sign() == 1) {
        squares.of.emplace(factors[0].variable, c.exact);
      } else {
        is_sum = false;
      }
    }
    if (is_sum && !squares.of.empty() && squares.bound.sign() != -1) squares_.push_back(squares);
  }
  add_shorter_sums();
  for (const Variable& v : system.variables) {
    const bool within_one = v.within_one && system.coefficient_tolerance == 0;
    domains_.push_back({{v.lower, v.upper},
                        {v.lower.is_rational(), v.upper.is_rational()},
                        {within_one && not_less(-1, v.lower), within_one && not_less(v.upper, 1)}});
  }
  index(system.variables.size());
  spread();
}

void Implied::index(std::size_t variables) {
  equations_of_.resize(variables);
  squares_of_.resize(variables);
  for (std::size_t i = 0; i < equations_.size(); ++i) {
    for (const auto& [factors, c] : equations_[i].list()) {
      for (const Factor& factor : factors) {
        auto& list = equations_of_[factor.variable];
        if (list.empty() || list.back() != i) list.push_back(i);
      }
    }
  }
  for (std::size_t i = 0; i < squares_.size(); ++i)
    for (const auto& [y, a] : squares_[i].of) squares_of_[y].push_back(i);
}

// Looks at each variable, and again where another one of an equation of its has a new bound.
void Implied::spread() {
  std::vector<int> open;
  for (int y = 0; y < static_cast<int>(domains_.size()); ++y) open.push_back(y);
  while (!open.empty()) {
    const int y = open.back();
    open.pop_back();
    Domain& domain = domains_[y];
    for (const int side : {0, 1}) {
      if (domain.implied[side] || !domain.rational[side]) continue;
      domain.implied[side] = holds(y, domain.end[side], side == 1 ? 1 : -1);
      if (!domain.implied[side]) continue;
      for (const std::size_t i : equations_of_[y])
        for (const auto& [factors, c] : equations_[i].list())
          if (is_variable(factors) && factors[0].variable != y) open.push_back(factors[0].variable);
    }
  }
}

void Implied::add_shorter_sums() {
  constexpr std::size_t kMostRows = 120;  // before and after the reduction
  std::vector<Terms> linear;
  for (const Terms& f : equations_) {
    const auto& list = f.list();
    if (std::ranges::all_of(
            list, [](const auto& term) { return term.first.empty() || is_function(term.first) || is_variable(term.first); }))
      linear.push_back(f);
  }
  if (linear.size() > kMostRows) return;
  for (std::size_t i = 0; i < linear.size(); ++i) {
    for (std::size_t k = i + 1; k < linear.size(); ++k) {
      for (const auto& [factors, c] : linear[i].list()) {
        const auto same = linear[k].list().find(factors);
        if (!is_variable(factors) || same == linear[k].list().end()) continue;
        Terms sum = linear[i].plus(-c.exact / same->second.exact, linear[k]);
        if (sum.list().size() < std::max(linear[i].list().size(), linear[k].list().size()))
          equations_.push_back(std::move(sum));
      }
    }
  }
}

bool Implied::holds(int y, const ExactNumber& end, int sign) const {
  if (!end.is_rational()) return false;
  const Domain& domain = domains_[y];
  const int side = sign > 0 ? 1 : 0;
  if (domain.implied[side] && (sign > 0 ? not_less(end, domain.end[1]) : not_less(domain.end[0], end))) return true;
  const ExactNumber h = sign > 0 ? end : -end;
  if (h.sign() != -1 && by_squares(y, h)) return true;
  const auto& list = equations_of_[y];
  return std::ranges::any_of(list, [&](std::size_t i) {
    return (h.sign() != -1 && by_products(equations_[i], y, h)) || by_sum(equations_[i], y, end, sign);
  });
}

bool Implied::by_squares(int y, const ExactNumber& h) const {
  const auto& list = squares_of_[y];
  return std::ranges::any_of(list, [&](std::size_t i) { return not_less(squares_[i].of.at(y) * h * h, squares_[i].bound); });
}

// The largest (sign 1) or least value of a term, where it is known.
std::optional<ExactNumber> Implied::extreme(const Factors& factors, const ExactNumber& c, int sign) const {
  if (factors.empty()) return c;
  if (is_function(factors)) return sign > 0 ? magnitude(c) : -magnitude(c);
  if (!is_variable(factors)) return std::nullopt;
  const Domain& domain = domains_[factors[0].variable];
  const int side = sign * c.sign().value_or(0) > 0 ? 1 : 0;
  if (!domain.implied[side]) return std::nullopt;
  return c * domain.end[side];
}

bool Implied::by_sum(const Terms& f, int y, const ExactNumber& end, int sign) const {
  ExactNumber a;
  for (const auto& [factors, c] : f.list())
    if (is_variable(factors) && factors[0].variable == y) a = c.exact;
  if (a.is_zero()) return false;
  // a y = −rest; y ≤ end needs the least value of rest where a > 0, the largest one where a < 0; y ≥ end the others.
  const int extreme_of_rest = -sign * a.sign().value_or(0);
  ExactNumber rest;
  for (const auto& [factors, c] : f.list()) {
    if (is_variable(factors) && factors[0].variable == y) continue;
    const auto value = extreme(factors, c.exact, extreme_of_rest);
    if (!value) return false;
    rest = rest + *value;
  }
  const ExactNumber limit = -rest / a;
  return sign > 0 ? not_less(end, limit) : not_less(limit, end);
}

bool Implied::by_products(const Terms& f, int y, const ExactNumber& h) const {
  ExactNumber a, constant, largest;
  std::vector<std::pair<int, int>> products;
  for (const auto& [factors, c] : f.list()) {
    if (factors.empty()) {
      constant = magnitude(c.exact);
    } else if (is_variable(factors) && factors[0].variable == y) {
      a = magnitude(c.exact);
    } else if (factors.size() == 2 && factors[0].power == 1 && factors[1].power == 1) {
      products.emplace_back(factors[0].variable, factors[1].variable);
      if (not_less(magnitude(c.exact), largest)) largest = magnitude(c.exact);
    } else {
      return false;
    }
  }
  if (a.is_zero() || products.empty()) return false;
  const ExactNumber room = a * h - constant;
  if (room.sign() == -1) return false;
  for (const std::size_t u : squares_of_[products[0].first]) {
    for (const std::size_t v : squares_of_[products[0].second]) {
      const auto bound = product_bound(products, squares_[u], squares_[v]);
      if (bound && not_less(room * room, largest * largest * *bound)) return true;
    }
  }
  return false;
}

std::optional<ExactNumber> Implied::product_bound(const std::vector<std::pair<int, int>>& products, const Squares& u,
                                                  const Squares& v) {
  std::vector<int> of_u, of_v;
  std::optional<ExactNumber> least_u, least_v;
  const auto take = [](int x, const Squares& squares, std::vector<int>& taken, std::optional<ExactNumber>& least) {
    const auto c = squares.of.find(x);
    if (c == squares.of.end() || std::ranges::find(taken, x) != taken.end()) return false;
    taken.push_back(x);
    if (!least || not_less(*least, c->second)) least = c->second;
    return true;
  };
  for (const auto& [first, second] : products) {
    const bool as_written = u.of.contains(first) && v.of.contains(second);
    if (!take(as_written ? first : second, u, of_u, least_u) || !take(as_written ? second : first, v, of_v, least_v))
      return std::nullopt;
  }
  return u.bound * v.bound / (*least_u * *least_v);
}

}  // namespace corank::check
