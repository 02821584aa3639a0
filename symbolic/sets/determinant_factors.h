// The determinant of a square matrix of expressions, in factors: it vanishes where one of them does. Where two factors
// vanish at once the determinant's own gradient is zero; theirs need not be.
#pragma once

#include <array>
#include <vector>

#include "corank/core/ended.h"
#include "corank/symbolic/sets/singularity_system.h"
#include "corank/symbolic/velocity/exact_matrix.h"
#include "corank/symbolic/velocity/velocity_equation.h"

namespace corank::symbolic {

/// All configurations are singular.
class DeterminantVanishes : public ModelError {
 public:
  using ModelError::ModelError;
};

/// Expressions in coordinates and constants, none twice, whose zeros at configurations are those of det M; none where det M
/// is a constant other than 0. Each divides det M, or of an arm, where Φ gives all coordinates explicitly, det M in the
/// coordinates that are left. Sines and cosines count as unknowns of their own: what only sin² + cos² = 1 shows to be a
/// product stays one factor. M is brought to block triangular form first (exact_matrix.h), after rows have been eliminated
/// by entries that are numbers, so that what is expanded and factored is small. What takes long to factor
/// (RationalPolynomial::factors), or is not by the time `ended` says so, stays one factor. Throws DeterminantVanishes where
/// det M vanishes at all configurations, as where a factor without a coordinate is 0, ModelError where M is not square,
/// DeterminantTooLarge where a block has more than 16 rows, or its determinant more than 20,000 terms.
/// `constants`: where given, further factors are added to it: those without a coordinate, but for numbers. Constants with
/// tolerances are unknowns, too, so that all of this holds for every robot.
std::vector<Expression> determinant_factors(const Mechanism& mechanism, const ExpressionMatrix& matrix,
                                            const Ended& ended = {}, std::vector<Expression>* constants = nullptr);

/// L_y of the forward set or L_z of the inverse one, as `corank derive` prints them.
ExpressionMatrix locked_matrix(const Mechanism& mechanism, SingularitySet set);

/// The loci that divide a C-space: where det L_y, and where det L_z, is 0; and further functions that do.
struct Loci {
  std::array<ExpressionMatrix, 2> matrices;          ///< L_y, L_z
  std::array<std::vector<Expression>, 2> factors;    ///< of their determinants
  std::vector<Expression> all_factors;               ///< of both, and further functions, each once
  std::array<std::vector<std::size_t>, 2> places{};  ///< of the factors of each among all
  std::vector<std::size_t> further{};                ///< likewise
  std::vector<Expression> constants{};               ///< factors of det L_y and det L_z without a coordinate

  /// Of the functions that divide C-space into aspects, assembly modes and working modes, the places among all factors.
  std::array<std::vector<std::size_t>, 3> lists() const;
  /// These divide it as well (RequiredSpace::functions).
  void add(const std::vector<Expression>& functions);
};
/// Throws as determinant_factors() does, and where the model has no inputs or outputs.
Loci singularity_loci(const Mechanism& mechanism, const Ended& ended = {});

}  // namespace corank::symbolic
