// Does an exactly known point solve a system, and how large is the kernel there? Decided in exact rational arithmetic.
//
// Kernel matrix. The equations of a system that are linear and homogeneous in its variables of kind `kernel` read M(q) ξ =
// 0; of a system with several kernel vectors those in ξ¹ alone do. The dimension of M's kernel at a point is its number of
// columns less its rank, and the rank r is proven by exact elimination: r pivots that are not 0, and nothing but zeros in
// the rows that remain.
#pragma once

#include <optional>
#include <string>

#include "corank/certify/algebraic_number.h"
#include "corank/core/ended.h"
#include "corank/core/singularity_types.h"
#include "corank/core/system.h"

namespace corank::certify {

/// M(q): rows of equations, columns of ξ¹'s variables; entries are polynomials in the other variables. No rows where the
/// system has no kernel equations.
PolynomialMatrix kernel_matrix(const System& system);

struct ExactVerification {
  bool holds = false;
  std::string failure;  ///< where it does not: what fails, or cannot be decided
  int corank = -1;      ///< dimension of the kernel of M at the point; −1: there is no M
};

/// Proves, where it holds: the point satisfies every equation and inequality of the system and lies in its domain. Where
/// coordinates of kernel variables are missing, this is about the equations and inequalities without those, and corank, at
/// least System::kernel_vectors, tells for how many independent ξ the kernel equations hold, too. Needs rational
/// coefficients and no sines or cosines. Nothing is proven once `ended` is true.
ExactVerification verify_exactly(const System& system, const ExactPoint& point, const Ended& ended = {});

/// The rank of a matrix at an exact point, by exact elimination. Nothing where an entry's variable is not known, a
/// coefficient is no rational number, a sign cannot be decided, or `ended` is true before.
std::optional<int> exact_rank(const System& system, const PolynomialMatrix& matrix, const ExactPoint& point,
                              const Ended& ended = {});

/// Where a point is.
class PointLocation {
 public:
  explicit PointLocation(const ExactPoint& point);
  /// Are the coordinates that are known all in the box's sides? True is proven. By enclosures where they decide, else by
  /// exact signs.
  bool in(const std::vector<Interval>& box) const;

 private:
  AlgebraicNumber t_;
  std::vector<RationalPolynomial> coordinates_;
  std::vector<Interval> enclosures_;
};

/// A rational number r that no known coordinate's distance from any point of its side exceeds: the box lies in the cube of
/// radius r about the point.
ExactNumber reach(const ExactPoint& point, const std::vector<Interval>& box);

}  // namespace corank::certify
