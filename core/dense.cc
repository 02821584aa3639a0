#include "corank/core/dense.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <limits>

namespace corank {

using Eigen::MatrixXd;
using Eigen::VectorXd;

LeastSquares least_squares(const MatrixXd& a, const VectorXd& b, double threshold) {
  Eigen::CompleteOrthogonalDecomposition<MatrixXd> factors;
  if (threshold > 0) factors.setThreshold(threshold);
  factors.compute(a);
  return {factors.solve(b), static_cast<int>(factors.rank())};
}

MatrixXd pseudo_inverse(const MatrixXd& a) { return a.completeOrthogonalDecomposition().pseudoInverse(); }

SingularValueDecomposition decompose(const MatrixXd& a) {
  const Eigen::JacobiSVD<MatrixXd> svd(a, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return {svd.matrixU(), svd.matrixV(), svd.singularValues()};
}

VectorXd singular_values(const MatrixXd& a) { return Eigen::JacobiSVD<MatrixXd>(a).singularValues(); }

SymmetricEigen symmetric_eigen(const MatrixXd& a) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(a);
  if (eigen.info() == Eigen::Success) return {eigen.eigenvalues(), eigen.eigenvectors()};
  const double none = std::numeric_limits<double>::quiet_NaN();
  return {VectorXd::Constant(a.rows(), none), MatrixXd::Constant(a.rows(), a.rows(), none)};
}

MatrixXd inverse(const MatrixXd& a) { return a.inverse(); }

double determinant(const MatrixXd& a) { return a.determinant(); }

}  // namespace corank
