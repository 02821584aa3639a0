#include "corank/solve/chart.h"

#include <cmath>

namespace corank::solve {
namespace {
constexpr int kExchanges = 16;
}  // namespace

void improve(Chart& chart, double gain) {
  const std::size_t k = chart.free.size();
  std::vector<double>& t = chart.tangent;
  for (int step = 0; step < kExchanges; ++step) {
    double best = gain;
    std::size_t at = t.size();
    for (std::size_t i = 0; i < t.size(); ++i)
      if (std::fabs(t[i]) > best) best = std::fabs(t[i]), at = i;
    if (at == t.size()) return;
    const std::size_t row = at / k, f = at % k;
    chart.free[f] = static_cast<int>(row);
    // Column operations that make `row` a unit vector.
    const double pivot = t[at];
    for (std::size_t i = 0; i < t.size(); i += k) t[i + f] /= pivot;
    for (std::size_t g = 0; g < k; ++g) {
      const double factor = t[row * k + g];
      if (g == f || factor == 0) continue;
      for (std::size_t i = 0; i < t.size(); i += k) t[i + g] -= factor * t[i + f];
    }
  }
}

}  // namespace corank::solve
