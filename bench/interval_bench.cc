// corank's interval type against CGAL's Interval_nt<false>, which has the same representation: same operands, same rounding
// mode.
#include <CGAL/Interval_nt.h>
#include <benchmark/benchmark.h>

#include <cfenv>
#include <random>
#include <vector>

#include "corank/core/interval.h"

namespace {

using Own = corank::Interval;
using Cgal = CGAL::Interval_nt<false>;

template <class T>
std::vector<T> operands() {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> in(-1, 1);
  std::vector<T> result;
  for (int k = 0; k < 1024; ++k) {
    const double a = in(random), b = in(random);
    result.emplace_back(std::min(a, b), std::max(a, b));
  }
  return result;
}

template <class T, class Operation>
void run(benchmark::State& state, Operation operation) {
  const auto x = operands<T>();
  const int mode = std::fegetround();
  std::fesetround(FE_UPWARD);
  for (auto _ : state) {
    T sum(0);
    for (std::size_t k = 0; k + 1 < x.size(); ++k) sum += operation(x[k], x[k + 1]);
    benchmark::DoNotOptimize(sum);
  }
  std::fesetround(mode);
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * (x.size() - 1)));
}

void own_product(benchmark::State& s) {
  run<Own>(s, [](const Own& a, const Own& b) { return a * b; });
}
void cgal_product(benchmark::State& s) {
  run<Cgal>(s, [](const Cgal& a, const Cgal& b) { return a * b; });
}
void own_square(benchmark::State& s) {
  run<Own>(s, [](const Own& a, const Own&) { return corank::square(a); });
}
void cgal_square(benchmark::State& s) {
  run<Cgal>(s, [](const Cgal& a, const Cgal&) { return CGAL::square(a); });
}

BENCHMARK(own_product);
BENCHMARK(cgal_product);
BENCHMARK(own_square);
BENCHMARK(cgal_square);

}  // namespace

BENCHMARK_MAIN();
