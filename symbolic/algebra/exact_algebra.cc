#include "corank/symbolic/algebra/exact_algebra.h"

#include "corank/core/check.h"

namespace corank::symbolic {
namespace {

std::vector<std::string> with(std::vector<std::string> names, const std::vector<std::string>& more) {
  names.insert(names.end(), more.begin(), more.end());
  return names;
}

}  // namespace

ExactAlgebra::ExactAlgebra(const Mechanism& mechanism, const std::vector<std::string>& unknowns)
    : bridge_(names_of(mechanism.constants()), with(names_of(mechanism.coordinates()), unknowns)) {
  CORANK_CHECK(mechanism.toleranced().empty());
  for (const Constant& c : mechanism.constants())
    constants_[bridge_.symbol(c.name)] = bridge_.to_ginac(c.value, c.where).subs(constants_);
}

}  // namespace corank::symbolic
