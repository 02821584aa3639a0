// Models as texts, compiled by the algebrizer.
#pragma once

#include <string>
#include <vector>

#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/tests/symbolic/evaluate.h"

namespace corank::symbolic {

inline constexpr unsigned kSeed = 314159;

inline System compile(const std::string& text) { return algebrize(plain_system(parse_model(text, "m.cuik"))); }

// Lines 2 (x), 3 (theta), 4 (psi), then the equations from line 6 on.
inline std::string with_equation(const std::string& equation) {
  return "[SYSTEM VARS]\nx : [-1, 1]\ntheta ~ [-pi, pi]\npsi ~ [-pi, pi]\n[SYSTEM EQS]\n" + equation;
}

inline std::string only_equation(const std::string& equation) {
  return canonical(compile(with_equation(equation)).equations[0]);
}

inline std::vector<std::string> names(const System& s) {
  std::vector<std::string> result;
  for (const auto& variable : s.variables) result.push_back(variable.name);
  return result;
}

}  // namespace corank::symbolic
