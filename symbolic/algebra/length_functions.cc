#include "corank/symbolic/algebra/length_functions.h"

#include <algorithm>
#include <tuple>

namespace corank::symbolic {

namespace {

// Polynomials first, in the order of ExpandedPolynomial, then sines and cosines: an order that does not depend on stand-ins.
bool before(const Monomial& a, const Monomial& b) {
  const auto key = [](const Factor& f) { return std::tuple(f.variable, f.power, f.function); };
  if (a.is_trigonometric() != b.is_trigonometric()) return b.is_trigonometric();
  return std::lexicographical_compare(a.factors.begin(), a.factors.end(), b.factors.begin(), b.factors.end(),
                                      [&](const Factor& f, const Factor& g) { return key(f) < key(g); });
}

}  // namespace

int LengthFunctions::argument(const ExpandedPolynomial& lengths) {
  const auto& [key, coefficient] = *lengths.terms().begin();
  if (lengths.terms().size() == 1 && coefficient.integer() == 1) return key.front().first;
  for (std::size_t i = 0; i < stand_ins_.size(); ++i)
    if (is_sum(stand_ins_[i]) && (stand_ins_[i].sum - lengths).terms().empty()) return first_ + static_cast<int>(i);
  stand_ins_.push_back({Function::identity, -1, lengths});
  return first_ + static_cast<int>(stand_ins_.size()) - 1;
}

std::pair<ExpandedPolynomial, ExpandedPolynomial> LengthFunctions::cosine_and_sine(int argument) {
  const auto known =
      std::ranges::find_if(stand_ins_, [&](const StandIn& s) { return !is_sum(s) && s.argument == argument; });
  const int cosine = first_ + static_cast<int>(known - stand_ins_.begin());
  if (known == stand_ins_.end()) {
    stand_ins_.push_back({Function::cosine, argument, {}});
    stand_ins_.push_back({Function::sine, argument, {}});
  }
  return {ExpandedPolynomial::variable(cosine), ExpandedPolynomial::variable(cosine + 1)};
}

void LengthFunctions::mark(const std::vector<Polynomial>& polynomials) {
  for (const Polynomial& polynomial : polynomials)
    for (const Monomial& monomial : polynomial.monomials)
      for (const Factor& factor : monomial.factors) {
        if (factor.variable < first_) continue;
        StandIn& s = stand_ins_[factor.variable - first_];
        s.used = true;
        s.multiplied = s.multiplied || monomial.factors.size() > 1 || factor.power > 1;
        if (s.argument >= first_) stand_ins_[s.argument - first_].used = true;
      }
}

void LengthFunctions::replace(std::vector<Polynomial>& polynomials) const {
  for (Polynomial& polynomial : polynomials) {
    for (Monomial& monomial : polynomial.monomials) {
      for (Factor& factor : monomial.factors) {
        if (factor.variable < first_) continue;
        const StandIn& s = stand_ins_[factor.variable - first_];
        factor = s.multiplied ? Factor{s.variable, factor.power} : Factor{s.argument, 1, s.function};
      }
      std::ranges::sort(monomial.factors, [](const Factor& f, const Factor& g) { return f.variable < g.variable; });
    }
    std::ranges::sort(polynomial.monomials, before);
  }
}

void LengthFunctions::add_sum(StandIn& s, System& system, const std::function<std::string(std::string)>& fresh_name) const {
  std::string name = "u";
  ExactNumber lower, upper;
  for (const auto& [key, coefficient] : s.sum.terms()) {
    const Variable& v = system.variables[key.front().first];
    name += "_" + v.name;
    const bool negative = coefficient.sign() == -1;
    lower = lower + coefficient.exact() * (negative ? v.upper : v.lower);
    upper = upper + coefficient.exact() * (negative ? v.lower : v.upper);
  }
  s.variable = system.size();
  system.variables.emplace_back(fresh_name(name), VariableKind::auxiliary, lower, upper);
}

void LengthFunctions::settle(System& system, const std::function<std::string(std::string)>& fresh_name) {
  mark(system.equations);
  mark(system.inequalities);
  mark(system.claimed);
  for (StandIn& s : stand_ins_)
    if (is_sum(s) && s.used) add_sum(s, system, fresh_name);
  std::vector<Polynomial> definitions;
  for (const StandIn& s : stand_ins_)
    if (is_sum(s) && s.used)
      definitions.push_back(
          (ExpandedPolynomial::variable(s.variable) - s.sum).compile("definition of " + system.variables[s.variable].name));
  for (StandIn& s : stand_ins_) {
    if (is_sum(s) || !s.used) continue;
    if (s.argument >= first_) s.argument = stand_ins_[s.argument - first_].variable;
    if (!s.multiplied) continue;
    s.variable = system.size();
    const std::string name = (s.function == Function::cosine ? "c_" : "s_") + system.variables[s.argument].name;
    system.variables.emplace_back(fresh_name(name), VariableKind::auxiliary, -1, 1);
    definitions.push_back({{{1, {{s.variable, 1}}}, {-1, {{s.argument, 1, s.function}}}},
                           "definition of " + system.variables[s.variable].name});
  }
  replace(system.equations);
  replace(system.inequalities);
  replace(system.claimed);
  system.equations.insert(system.equations.end(), definitions.begin(), definitions.end());
}

}  // namespace corank::symbolic
