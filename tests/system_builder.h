// Systems for tests, term by term: builder.equation({{"1", {{x, 2}}}, {"-2", {}}}) is x² − 2 = 0.
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "corank/core/system.h"

namespace corank::test {

class SystemBuilder {
 public:
  using Term = std::pair<std::string, std::vector<Factor>>;

  int variable(const std::string& name, const std::string& lower, const std::string& upper,
               VariableKind kind = VariableKind::length) {
    system_.variables.emplace_back(name, kind, ExactNumber::rational(lower), ExactNumber::rational(upper));
    system_.configuration_size = system_.size();
    return system_.size() - 1;
  }
  SystemBuilder& equation(const std::vector<Term>& terms) {
    system_.equations.push_back(polynomial(terms));
    return *this;
  }
  SystemBuilder& at_least_zero(const std::vector<Term>& terms) {
    system_.inequalities.push_back(polynomial(terms));
    return *this;
  }
  const System& system() const { return system_; }

  static Polynomial polynomial(const std::vector<Term>& terms) {
    Polynomial p;
    for (auto [coefficient, factors] : terms) {
      std::sort(factors.begin(), factors.end(), [](auto& a, auto& b) { return a.variable < b.variable; });
      p.monomials.emplace_back(ExactNumber::rational(coefficient), factors);
    }
    return p;
  }

 private:
  System system_;
};

}  // namespace corank::test
