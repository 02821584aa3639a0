// Factorizations of matrices of doubles, compiled in one place: half of the time that sources took which use them. Nothing
// is proven by them.
#pragma once

#include <Eigen/Core>

namespace corank {

struct LeastSquares {
  Eigen::VectorXd x;
  int rank = 0;  ///< of a, within the threshold
};

/// Of the x for which |a x − b| is least the shortest (complete orthogonal decomposition), a of m × n, b of m.
/// @param threshold pivots below that share of the largest count as 0; 0: such as rounding leaves
LeastSquares least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b, double threshold = 0);

/// The a⁺ for which a⁺ b is that x, of n × m.
Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& a);

/// a = u · diag(values) · vᵀ, u of m × m and v of n × n orthogonal, the values falling (one-sided Jacobi).
struct SingularValueDecomposition {
  Eigen::MatrixXd u, v;
  Eigen::VectorXd values;  ///< min(m, n)
};

SingularValueDecomposition decompose(const Eigen::MatrixXd& a);
Eigen::VectorXd singular_values(const Eigen::MatrixXd& a);

/// a = vectors · diag(values) · vectorsᵀ for a symmetric a, of which the lower half is read, the values rising.
struct SymmetricEigen {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;  ///< not a number where the iteration does not end
};

SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& a);

/// By elimination with row pivots; what a is not regular for has entries that are not finite, or large.
Eigen::MatrixXd inverse(const Eigen::MatrixXd& a);
double determinant(const Eigen::MatrixXd& a);

}  // namespace corank
