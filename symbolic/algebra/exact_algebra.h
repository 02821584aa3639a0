// A mechanism's expressions in GiNaC, expanded, with the values of its constants put in; and a few unknowns more.
#pragma once

#include <ginac/ginac.h>

#include <string>
#include <vector>

#include "corank/symbolic/algebra/ginac_bridge.h"
#include "corank/symbolic/model/mechanism.h"

namespace corank::symbolic {

/// To be used while GiNaC's lock is held, of a mechanism without tolerances.
class ExactAlgebra {
 public:
  explicit ExactAlgebra(const Mechanism& mechanism, const std::vector<std::string>& unknowns = {});

  GiNaC::ex value(const Expression& e) const { return bridge_.to_ginac(e, {}).subs(constants_).expand(); }
  const GiNaC::symbol& symbol(const std::string& name) const { return bridge_.symbol(name); }
  Expression expression(const GiNaC::ex& e) const { return bridge_.to_expression(e); }

 private:
  const GinacBridge bridge_;
  GiNaC::exmap constants_;
};

}  // namespace corank::symbolic
