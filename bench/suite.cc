// Runs the benchmark suite and prints a line for each problem: boxes, verdicts, seconds, and the time in units of one 14×14 LU
// measured just before and after. Usage: corank_bench [WORD]: only the lines that contain WORD.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "corank/bench/lu_unit.h"
#include "corank/solve/solve.h"
#include "corank/symbolic/algebrizer.h"
#include "corank/symbolic/model_file.h"
#include "corank/symbolic/singularity_system.h"

namespace {

using corank::certify::Verdict;
using corank::symbolic::SingularitySet;

struct Line {
  const char* model;
  SingularitySet set;
  double sigma;
  double
      reference_kilo_lu;  ///< a one-thread prototype of the same algorithm (150 lines, nothing tuned), 0 where not measured
};

constexpr auto kForward = SingularitySet::forward, kInverse = SingularitySet::inverse, kCspace = SingularitySet::cspace;

// References: seconds of the prototype over 0.45 µs, the LU time on the core that ran it.
const std::vector<Line> kSuite = {
    {"three_slider", kForward, 1e-8, 0}, {"three_slider", kInverse, 1e-8, 0}, {"dextar", kForward, 1, 0},
    {"dextar", kForward, 0.1, 51},       {"dextar", kForward, 0.01, 164},     {"dextar", kInverse, 1, 0},
    {"dextar", kInverse, 0.1, 267},      {"dextar", kInverse, 0.01, 578},     {"dextar", kCspace, 0.2, 182},
    {"dextar", kCspace, 0.1, 0},         {"dextar", kCspace, 0.05, 1778},
};

}  // namespace

int main(int argc, char** argv) {
  using namespace corank;
  const std::string only = argc > 1 ? argv[1] : "";
  fmt::print("corank {}; one 14x14 LU: {:.3f} us\n", CORANK_VERSION, 1e6 * bench::lu_seconds());
  fmt::print("{:<30}{:>10}{:>9}{:>10}{:>9}{:>9}{:>7}{:>8}{:>9}{:>10}{:>8}\n", "problem", "processed", "boxes", "newton",
             "regular", "isolated", "bound.", "undec.", "seconds", "kLU", "/proto");
  for (const Line& line : kSuite) {
    const std::string name = fmt::format("{} {} {}", line.model, symbolic::to_string(line.set), line.sigma);
    if (name.find(only) == std::string::npos) continue;
    const auto model = symbolic::read_model(std::string(CORANK_SOURCE_DIR "/models/") + line.model + ".cuik");
    const auto system = symbolic::algebrize(symbolic::singularity_system(model, line.set));
    solve::Options options;
    options.sigma = line.sigma;
    const double unit_before = bench::lu_seconds();
    const auto cover = solve::solve(system, options);
    const double unit = 0.5 * (unit_before + bench::lu_seconds());
    const double kilo_lu = cover.statistics.seconds_total / unit / 1000;
    const std::string ratio = line.reference_kilo_lu > 0 ? fmt::format("{:.2f}", kilo_lu / line.reference_kilo_lu) : "";
    fmt::print("{:<30}{:>10}{:>9}{:>10}{:>9}{:>9}{:>7}{:>8}{:>9.3f}{:>10.1f}{:>8}\n", name, cover.statistics.processed,
               cover.boxes.size(), cover.statistics.newton_steps, cover.count(Verdict::regular),
               cover.count(Verdict::isolated), cover.count(Verdict::boundary), cover.count(Verdict::undecided),
               cover.statistics.seconds_total, kilo_lu, ratio);
  }
}
