#include "corank/certify/preconditioning.h"

#include <Eigen/Core>

#include "corank/core/check.h"
#include "corank/core/dense.h"

namespace corank::certify {

Preconditioner midpoint_preconditioner(const CompiledSystem& system, const std::vector<double>& point,
                                       const std::vector<int>& dependent) {
  const int m = system.equations();
  CORANK_CHECK(static_cast<int>(dependent.size()) == m);
  std::vector<double> entries(static_cast<std::size_t>(system.entries()));
  system.approximate_jacobian(point.data(), entries.data());
  std::vector<int> place(static_cast<std::size_t>(system.variables()), -1);
  for (int a = 0; a < m; ++a) place[static_cast<std::size_t>(dependent[static_cast<std::size_t>(a)])] = a;
  Eigen::MatrixXd j = Eigen::MatrixXd::Zero(m, m);
  for (int i = 0; i < m; ++i)
    for (int k = system.row_begin(i); k < system.row_begin(i + 1); ++k)
      if (const int a = place[static_cast<std::size_t>(system.column(k))]; a >= 0)
        j(i, a) += entries[static_cast<std::size_t>(k)];
  Eigen::MatrixXd y = inverse(j);
  if (!y.allFinite()) y.setZero();
  Preconditioner p;
  p.dependent = dependent;
  for (int a = 0; a < m; ++a) {
    p.equations.push_back(a);
    for (int b = 0; b < m; ++b) p.y.push_back(y(a, b));
  }
  return p;
}

}  // namespace corank::certify
