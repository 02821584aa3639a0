#include "corank/symbolic/algebra/exact_value.h"

#include <stdexcept>

#include "corank/symbolic/algebra/ginac_lock.h"
#include "corank/symbolic/algebra/polynomial_expander.h"
#include "corank/symbolic/model/expression_words.h"

namespace corank::symbolic {

ExactNumber exact_value(const Mechanism& mechanism, const Expression& expression, const std::string& what) {
  const GinacLock lock;
  const SourceLocation where{mechanism.name(), 0, 0};
  try {
    PolynomialExpander expander;
    for (const Constant& c : mechanism.constants()) expander.define(c);
    return expander.constant(expression, "the value of " + in_quotes(what), where).exact();
  } catch (const std::domain_error& error) {
    throw ModelError(where, "the value of " + in_quotes(what) + " is not a real number: " + error.what(), "a real number");
  }
}

}  // namespace corank::symbolic
