// The velocity equation L m = 0 of a mechanism, which every feasible velocity m satisfies. Its columns have roles: locking
// the rates of one makes its columns go, and what is left of L tells whether the mechanism can still move. GiNaC
// differentiates Φ with respect to q in trigonometric form, so that an angle has one column; where the mechanism brings its
// own velocity equation, L holds the coefficients of its rates.
//
//   L_y = L without the input columns      L_z = L without the output columns      L_p = the passive columns alone
//
// Bohigas, Manubens, Ros, "Singularities of Robot Mechanisms", 2017 (key Bohigas2017), §§ 2–3.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "corank/symbolic/model/mechanism.h"
#include "corank/symbolic/model/set_definition.h"

namespace corank::symbolic {

/// Row-major matrix of expressions.
struct ExpressionMatrix {
  std::vector<std::string> columns;  ///< the coordinate, or the rate, of each column
  std::vector<std::vector<Expression>> rows;
  std::vector<Role> roles = {};  ///< of the columns
};

/// L m = 0, with one row for each equation and one column for each component of m.
struct VelocityEquation {
  /// L, whose columns are named after the coordinates whose rates they multiply, or after the mechanism's own rates.
  ExpressionMatrix matrix;
  std::vector<SourceLocation> where;  ///< of the rows
  bool given = false;                 ///< by the mechanism; else L = Φ_q

  /// L without the columns of these roles.
  ExpressionMatrix without(std::span<const Role> locked) const;
  /// The columns of this role.
  std::vector<std::string> names_of(Role role) const;
  /// Its rows of zeros, where columns went: equations in the locked coordinates and constants alone, such as a unit vector's
  /// norm. They leave the right kernel as it is; for each, one more coordinate than the mobility may be locked.
  std::vector<std::size_t> dependencies(std::span<const Role> locked) const;
};

/// Φ, n_e expressions, and L.
struct Derivation {
  std::vector<Expression> phi;  ///< lhs − rhs of each equation
  VelocityEquation velocity;
};

/// Coordinates less equations, or rates less velocity equations of its own; without the coordinates that have one value.
long mobility(const Mechanism& mechanism);

/// Φ.
std::vector<Expression> residuals(const Mechanism& mechanism);

/// Throws ModelError where the mechanism is not valid (Mechanism::validate).
Derivation derive(const Mechanism& mechanism);

/// Of a function of coordinates its first and second derivatives by these.
struct Derivatives {
  std::vector<Expression> first;
  std::vector<std::vector<Expression>> second;  ///< by j and k, j ≤ k: [j][k − j]
};
/// Of Φ, in the order of Derivation::phi. Throws ModelError where an equation cannot be differentiated.
std::vector<Derivatives> derivatives(const Mechanism& mechanism, const std::vector<std::string>& coordinates);
std::vector<Derivatives> derivatives(const Mechanism& mechanism, const std::vector<std::string>& coordinates,
                                     const std::vector<Expression>& functions);

/// Of a coordinate, as [INPUTS] and [OUTPUTS] name them.
Role role_of(const Mechanism& mechanism, const std::string& coordinate);
/// The inputs or the outputs.
const std::vector<std::string>& names_of(const Mechanism& mechanism, Role role);

}  // namespace corank::symbolic
