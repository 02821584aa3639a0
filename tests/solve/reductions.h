// What the tests of reductions share.
#pragma once

#include <string>
#include <vector>

#include "corank/certify/polynomial_algebra.h"
#include "corank/certify/reduction.h"
#include "corank/core/rounding.h"
#include "corank/tests/system_builder.h"

namespace corank::solve {

using namespace certify;
using test::SystemBuilder;

inline std::vector<Interval> point(const std::vector<double>& x) { return {x.begin(), x.end()}; }

// The solution of the whole system that belongs to values of the kept variables.
inline std::vector<Interval> lifted(const Reduction& r, const std::vector<double>& kept) {
  const UpwardRounding rounding;
  std::vector<Interval> sides = point(kept);
  for (const auto& d : r.definitions) sides.push_back(evaluate(d.value, point(kept)));
  return r.lift(sides);
}

inline std::string text(const Polynomial& f) {
  std::string result;
  for (const Monomial& m : f.monomials) {
    result += (result.empty() ? "" : " + ") + m.coefficient.text();
    for (const Factor& x : m.factors) result += "*x" + std::to_string(x.variable) + "^" + std::to_string(x.power);
  }
  return result;
}

// x = 2y + 1, z = −y, w = x·z + y² in [−2, 2] and nowhere else; x² + y² + z² = 9 is 6y² + 4y = 8.
inline SystemBuilder chain() {
  SystemBuilder b;
  const int x = b.variable("x", "-4", "4"), y = b.variable("y", "-4", "4"), z = b.variable("z", "-1", "3"),
            w = b.variable("w", "-2", "2");
  b.equation({{"1", {{x, 1}}}, {"-2", {{y, 1}}}, {"-1", {}}}).equation({{"3", {{z, 1}}}, {"3", {{y, 1}}}});
  b.equation({{"1", {{x, 1}, {z, 1}}}, {"1", {{y, 2}}}, {"-1", {{w, 1}}}});
  b.equation({{"1", {{x, 2}}}, {"1", {{y, 2}}}, {"1", {{z, 2}}}, {"-9", {}}});
  return b;
}

}  // namespace corank::solve
