// Rows over three variables, and what an enclosure holds, for tests of the checker.
#pragma once

#include <vector>

#include "corank/check/rows.h"
#include "corank/tests/system_builder.h"

namespace corank::check {

using Term = test::SystemBuilder::Term;

inline Row row(const std::vector<Term>& terms, double tolerance = 0) {
  return Row(Terms(test::SystemBuilder::polynomial(terms), tolerance), {0, 1, 2});
}

inline bool holds(const Enclosure& x, double p) { return Enclosure(p).inside(x); }

}  // namespace corank::check
