#include "corank/bench/lu_unit.h"

#include <Eigen/LU>
#include <algorithm>
#include <chrono>

namespace corank::bench {

double lu_seconds() {
  using Matrix = Eigen::Matrix<double, 14, 14>;
  constexpr int kBatches = 20, kFactorizations = 1000;
  Matrix a = Matrix::Random();
  double best = 1, sink = 0;
  for (int batch = 0; batch < kBatches; ++batch) {
    const auto start = std::chrono::steady_clock::now();
    for (int k = 0; k < kFactorizations; ++k) {
      a(0, 0) += 1e-9;  // keep the compiler from factorizing once
      const Eigen::PartialPivLU<Matrix> lu(a);
      sink += lu.matrixLU()(13, 13);
    }
    best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() / kFactorizations);
  }
  volatile double keep = sink;
  static_cast<void>(keep);
  return best;
}

}  // namespace corank::bench
