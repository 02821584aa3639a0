#include "corank/certify/contraction.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "corank/core/check.h"
#include "corank/core/rounding.h"

namespace corank::certify {

std::optional<Contraction> contraction(const std::vector<double>& e, std::vector<double> sizes) {
  constexpr int kCandidates = 6;
  const std::size_t n = sizes.size();
  CORANK_CHECK(e.size() == n * n && UpwardRounding::active());
  std::vector<double> r = sizes, next(n);
  for (int candidate = 0; candidate < kCandidates; ++candidate) {
    double factor = 0, largest = 0;
    for (std::size_t i = 0; i < n; ++i) {
      double sum = 0;
      for (std::size_t j = 0; j < n; ++j) sum += e[i * n + j] * r[j];
      if (!std::isfinite(sum)) return std::nullopt;
      next[i] = sum;
      factor = std::max(factor, sum / r[i]);
      largest = std::max(largest, sum / sizes[i]);
    }
    if (factor < 1) return Contraction{std::move(r), factor};
    for (std::size_t i = 0; i < n; ++i) r[i] = next[i] / largest + 0.05 * sizes[i];
  }
  return std::nullopt;
}

}  // namespace corank::certify
