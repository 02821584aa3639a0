#include "corank/check/terms.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace corank::check {
namespace {

Coefficient product(const Coefficient& x, const Coefficient& y) {
  return {x.exact * y.exact, x.range * y.range, x.tolerant || y.tolerant};
}

std::string name_of(const System& system, int variable) { return system.variables[variable].name; }

}  // namespace

Factors merged(const Factors& a, const Factors& b) {
  std::map<int, int> powers;
  for (const auto* list : {&a, &b})
    for (const Factor& f : *list) powers[f.variable] += f.power;
  Factors result;
  for (const auto& [variable, power] : powers) result.push_back({variable, power});
  return result;
}

Terms::Terms(const Polynomial& f, double tolerance) {
  for (const Monomial& m : f.monomials) {
    Coefficient c{m.coefficient, Enclosure(m.coefficient), false};
    const double rounded = std::nearbyint(c.range.mid());
    const bool integer = m.coefficient.is_rational() && (m.coefficient - ExactNumber(static_cast<long>(rounded))).is_zero();
    if (tolerance > 0 && !integer) {
      c.range *= Enclosure(1.0) + Enclosure(-tolerance, tolerance);
      c.tolerant = true;
    }
    add(m.factors, c);
  }
  drop_zeros();
}

Terms::Terms(const ExactNumber& constant) {
  add({}, {constant, Enclosure(constant), false});
  drop_zeros();
}

void Terms::add(const Factors& factors, const Coefficient& c) {
  const auto [at, is_new] = list_.try_emplace(factors, c);
  if (is_new) return;
  at->second.exact = at->second.exact + c.exact;
  at->second.range += c.range;
  at->second.tolerant = at->second.tolerant || c.tolerant;
}

void Terms::drop_zeros() {
  for (auto at = list_.begin(); at != list_.end();) {
    Coefficient& c = at->second;
    if (!c.tolerant) c.range = Enclosure(c.exact);  // sums and products have widened it
    at = c.exact.is_zero() && !c.tolerant ? list_.erase(at) : std::next(at);
  }
}

bool Terms::mentions(int variable) const {
  return std::ranges::any_of(list_, [&](const auto& term) {
    return std::ranges::any_of(term.first, [&](const Factor& f) { return f.variable == variable; });
  });
}

bool Terms::mentions_inside_function(int variable) const {
  return std::ranges::any_of(
      list_, [&](const auto& term) { return is_function(term.first) && term.first[0].variable == variable; });
}

bool Terms::is_constant() const {
  return std::ranges::all_of(list_, [](const auto& term) { return term.first.empty(); });
}

bool Terms::is_exact() const {
  return std::ranges::none_of(list_, [](const auto& term) { return term.second.tolerant; });
}

ExactNumber Terms::constant() const {
  const auto at = list_.find({});
  return at == list_.end() ? ExactNumber(0) : at->second.exact;
}

std::optional<Terms::Affine> Terms::affine() const {
  std::optional<Affine> result;
  for (const auto& [factors, c] : list_) {
    if (factors.empty()) continue;
    if (result || factors.size() != 1 || factors[0].power != 1 || is_function(factors)) return std::nullopt;
    result = Affine{factors[0].variable, c.exact, constant()};
  }
  return result;
}

std::optional<Terms> Terms::solved_for(int variable) const {
  const Coefficient* own = nullptr;
  for (const auto& [factors, c] : list_)
    for (const Factor& f : factors) {
      if (f.variable != variable) continue;
      if (own || factors.size() != 1 || f.power != 1 || f.function != Function::identity) return std::nullopt;
      own = &c;
    }
  if (!own || !own->exact.is_rational() || own->exact.is_zero() || own->range.has_zero()) return std::nullopt;
  Terms value;
  for (const auto& [factors, c] : list_) {
    if (&c == own) continue;
    value.add(factors, {-(c.exact / own->exact), quotient(-c.range, own->range), c.tolerant || own->tolerant});
  }
  value.drop_zeros();
  return value;
}

std::optional<Terms> Terms::substituted(int variable, const Terms& value) const {
  if (mentions_inside_function(variable)) return std::nullopt;
  Terms result;
  for (const auto& [factors, c] : list_) {
    const auto at = std::ranges::find_if(factors, [&](const Factor& f) { return f.variable == variable; });
    if (at == factors.end()) {
      result.add(factors, c);
      continue;
    }
    Factors rest = factors;
    rest.erase(rest.begin() + (at - factors.begin()));
    Terms partial;
    partial.add(rest, c);
    for (int k = 0; k < at->power; ++k) {
      Terms next;
      for (const auto& [f, x] : partial.list_)
        for (const auto& [g, y] : value.list_) {
          if ((is_function(f) && !g.empty()) || (is_function(g) && !f.empty())) return std::nullopt;
          next.add(is_function(f) ? f : is_function(g) ? g : merged(f, g), product(x, y));
        }
      next.drop_zeros();
      partial = std::move(next);
    }
    for (const auto& [f, x] : partial.list_) result.add(f, x);
  }
  result.drop_zeros();
  return result;
}

bool Terms::is_multiple_of(const Terms& g) const {
  if (list_.size() != g.list_.size() || list_.empty() || !is_exact() || !g.is_exact()) return false;
  std::optional<ExactNumber> ratio;
  for (auto x = list_.begin(), y = g.list_.begin(); x != list_.end(); ++x, ++y) {
    if (!(x->first == y->first) || x->second.exact.is_rational() != y->second.exact.is_rational()) return false;
    if (ratio || !x->second.exact.is_rational()) continue;
    ratio = x->second.exact / y->second.exact;
  }
  for (auto x = list_.begin(), y = g.list_.begin(); x != list_.end(); ++x, ++y) {
    const ExactNumber& own = x->second.exact;
    if (!((ratio ? *ratio * y->second.exact : y->second.exact) == own)) return false;
  }
  return true;
}

Terms Terms::plus(const ExactNumber& q, const Terms& g) const {
  Terms result = *this;
  const Coefficient factor{q, Enclosure(q), false};
  for (const auto& [factors, c] : g.list_) {
    // Expressions that are equal cancel, although only a rational 0 is known as such.
    const auto own = list_.find(factors);
    const bool same = own != list_.end() && !own->second.tolerant && !c.tolerant &&
                      (own->second.exact == -q * c.exact || (own->second.exact == c.exact && q == -1));
    if (same) {
      result.list_.erase(factors);
    } else {
      result.add(factors, product(factor, c));
    }
  }
  result.drop_zeros();
  return result;
}

std::optional<Terms> Terms::times(const Factors& powers) const {
  if (powers.empty()) return *this;
  Terms result;
  for (const auto& [factors, c] : list_) {
    if (is_function(factors)) return std::nullopt;
    result.add(merged(factors, powers), c);
  }
  return result;
}

Terms operator-(const Terms& f, const ExactNumber& c) { return f.plus(-1, Terms(c)); }
Terms operator-(const Terms& f) { return Terms().plus(-1, f); }

namespace {

class Reducer {
 public:
  Reducer(const System& system, const StopFlag& stop) : system_(system), stop_(stop) {
    // Where equations outnumber variables the tolerance is for `partial` only.
    const double tolerance = system.equations.size() <= system.variables.size() ? system.coefficient_tolerance : 0;
    for (const Polynomial& f : system.equations) equations_.emplace_back(Terms(f, tolerance));
    for (const Polynomial& g : system.inequalities) result_.inequalities.emplace_back(g, tolerance);
    result_.values.resize(system.variables.size());
  }

  // Replaces a variable everywhere by what the equation says of it, or its domain where there is none.
  void eliminate(int x, const std::optional<int>& row) {
    if (x < 0 || x >= system_.size() || (row && (*row < 0 || *row >= static_cast<int>(equations_.size()))))
      throw std::invalid_argument("an elimination names no variable or no equation");
    const auto refuse = [&](const std::string& reason) {
      throw std::invalid_argument("elimination of " + name_of(system_, x) + ": " + reason);
    };
    auto& value = result_.values[x];
    if (value) refuse("it is gone already");
    if (!row) {
      const Variable& v = system_.variables[x];
      if (!(v.lower == v.upper)) refuse("its domain is more than one number");
      value = Terms(v.lower);
    } else {
      auto& equation = equations_[*row];
      if (!equation) refuse("its equation has been used");
      value = equation->solved_for(x);
      if (!value) refuse("its equation does not define it");
      equation.reset();
    }
    const Terms put = *value;
    if (!result_.implied.empty()) refuse("after an implied equation");
    const auto replace = [&](Terms& f) {
      if (!f.mentions(x)) return;
      auto replaced = f.substituted(x, put);
      if (!replaced) refuse("its value cannot be put in");
      f = std::move(*replaced);
    };
    for (auto& f : equations_) {
      stop_.poll();
      if (f) replace(*f);
    }
    for (Terms& g : result_.inequalities) replace(g);
    for (auto& other : result_.values)
      if (other) replace(*other);
  }

  // {f + q·g = 0, g = 0} ⇔ {f = 0, g = 0}: g must be another equation that stays.
  void add(int row, int other, const ExactNumber& factor) {
    const auto is_there = [&](int i) { return i >= 0 && i < static_cast<int>(equations_.size()) && equations_[i]; };
    if (!is_there(row) || !is_there(other) || row == other)
      throw std::invalid_argument("a sum of equations: it does not name two different equations that exist");
    if (!factor.is_rational()) throw std::invalid_argument("a sum of equations: the factor is not rational");
    if (!result_.implied.empty()) throw std::invalid_argument("a sum of equations: after an implied equation");
    Terms& f = *equations_[row];
    f = f.plus(factor, *equations_[other]);
  }

  // Where all f vanish, so does Σ q·p·f.
  void imply(const ImpliedEquation& step) {
    const auto refuse = [](const std::string& reason) { throw std::invalid_argument("an implied equation: " + reason); };
    Terms h;
    for (const ImpliedEquation::Multiple& part : step.parts) {
      const int given = static_cast<int>(equations_.size()), implied = static_cast<int>(result_.implied.size());
      if (part.equation < 0 || part.equation >= given + implied) refuse("names an equation that is not there");
      const std::size_t k = part.equation;
      if (part.equation < given && !equations_[k]) refuse("names an equation that has been used");
      if (!part.factor.is_rational()) refuse("a factor is not rational");
      for (const Factor& x : part.product)
        if (x.variable < 0 || x.variable >= system_.size() || x.power < 1 || x.function != Function::identity ||
            result_.values[x.variable])
          refuse("a product is not one of powers of variables that are kept");
      const auto p = (part.equation < given ? *equations_[k] : result_.implied[k - equations_.size()]).times(part.product);
      if (!p) refuse("a product with a sine or cosine");
      h = h.plus(part.factor, *p);
    }
    result_.implied.push_back(std::move(h));
  }

  Reduced take_result() {
    for (int j = 0; j < system_.size(); ++j)
      if (!result_.values[j]) result_.kept.push_back(j);
    for (auto& f : equations_) {
      stop_.poll();
      if (!f) continue;
      if (f->is_constant() && !f->list().empty() && !f->list().begin()->second.range.has_zero())
        result_.contradiction = true;
      const auto repeated = [&](const Terms& g) { return f->is_multiple_of(g); };
      if (!f->list().empty() && std::ranges::none_of(result_.equations, repeated))
        result_.equations.push_back(std::move(*f));
    }
    return std::move(result_);
  }

 private:
  const System& system_;
  const StopFlag& stop_;
  std::vector<std::optional<Terms>> equations_;
  Reduced result_;
};

}  // namespace

Reduced reduce(const System& system, const std::vector<ReductionStep>& steps, const StopFlag& stop) {
  system.validate();
  Reducer reducer(system, stop);
  for (const ReductionStep& s : steps) {
    stop.poll();
    if (const auto* sum = std::get_if<SumOfEquations>(&s)) {
      reducer.add(sum->equation, sum->other, sum->factor);
    } else if (const auto* implied = std::get_if<ImpliedEquation>(&s)) {
      reducer.imply(*implied);
    } else {
      const Elimination& elimination = std::get<Elimination>(s);
      reducer.eliminate(elimination.variable, elimination.equation);
    }
  }
  return reducer.take_result();
}

}  // namespace corank::check
