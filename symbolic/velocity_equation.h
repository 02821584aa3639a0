// The velocity equation L m = 0 of a mechanism, which every feasible velocity m satisfies. Its columns have roles: locking
// the rates of one makes its columns go, and what is left of L tells whether the mechanism can still move. GiNaC
// differentiates Φ with respect to q in trigonometric form, so that an angle has one column.
//
//   L_y = L without the input columns      L_z = L without the output columns      L_p = the passive columns alone
//
// Bohigas, Manubens, Ros, "Singularities of Robot Mechanisms", 2017 (key Bohigas2017), §§ 2–3.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "corank/symbolic/mechanism.h"
#include "corank/symbolic/set_definition.h"

namespace corank::symbolic {

/// Row-major matrix of expressions.
struct ExpressionMatrix {
  std::vector<std::string> columns;  ///< the coordinate of each column
  std::vector<std::vector<Expression>> rows;
};

/// L m = 0, shape n_e × n_m.
struct VelocityEquation {
  ExpressionMatrix matrix;            ///< L, whose columns are named after the coordinates whose rates they multiply
  std::vector<Role> roles;            ///< n_m, of the columns
  std::vector<SourceLocation> where;  ///< n_e, of the rows

  /// L without the columns of these roles.
  ExpressionMatrix without(std::span<const Role> locked) const;
  /// Its rows of zeros, where columns went: equations in the locked coordinates and constants alone, such as a unit vector's
  /// norm. They leave the right kernel as it is, and so many more coordinates than the mobility may be locked.
  std::vector<std::size_t> ties(std::span<const Role> locked) const;
};

/// Φ, n_e expressions, and L = Φ_q.
struct Derivation {
  std::vector<Expression> phi;  ///< lhs − rhs of each equation
  VelocityEquation velocity;
};

/// Throws ModelError where the mechanism is not valid (Mechanism::validate).
Derivation derive(const Mechanism& mechanism);

Role role_of(const Mechanism& mechanism, const std::string& coordinate);
/// The inputs or the outputs.
const std::vector<std::string>& names_of(const Mechanism& mechanism, Role role);

}  // namespace corank::symbolic
