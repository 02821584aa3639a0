// Runs the benchmark suite and prints a line for each problem, with times also in units of one 14×14 LU measured just before
// and after. Usage: corank_bench [--threads N] [WORD]: only the lines that contain WORD, with N threads (default 1; 0: one
// for each core). Lines of minutes run only where WORD has their model's name in it, and end after kLongTimeLimit seconds.
//
// The first lines are sets of corank's models. The others are files of the CUIK suite, solved as `corank solve FILE --param
// FILE.param` does, but for at most kTimeLimit seconds; they are no part of the repository and are looked for in
// CORANK_CUIK_DIR, by default ../shared/cuik beside the sources.
//
//   n, m        variables and equations
//   kLU         elapsed time in thousands of LU units
//   overhead    elapsed time ÷ (returned boxes × mean time of one certified test): what all of the search costs, in proofs
//               of each box that it returns. One certified test is the choice of Y at a box's middle for the box's own free
//               variables (solve/step/preconditioner.h) and certify::newton_prove. Its mean time is measured here, on
//               the reduced system and up to kSamples of its proven boxes, evenly spaced in the sorted result, kRepeats
//               times each.
//               Pending boxes do not count. With several threads the elapsed time shrinks, and the factor with it.
//   /proto      kLU ÷ that of a one-thread prototype of the same algorithm (150 lines, nothing tuned)
//   CUIK        the CUIK suite's boxes and time on the same problem at the same σ (Clp, one core), where they are known, and
//               its time ÷ ours, both in LU units
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "corank/bench/lu_unit.h"
#include "corank/certify/newton.h"
#include "corank/core/rounding.h"
#include "corank/result/cuik/cuik_files.h"
#include "corank/solve/reduction/reducer.h"
#include "corank/solve/search/solve.h"
#include "corank/solve/step/preconditioner.h"
#include "corank/study/question.h"
#include "corank/symbolic/model/model_error.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/sets/algebrizer.h"

namespace {

using namespace corank;
using symbolic::SingularitySet;

constexpr double kTimeLimit = 10, kLongTimeLimit = 300;
// Seconds of the prototype and of the CUIK suite are on a core where the LU takes so long.
constexpr double kReferenceUnit = 0.45e-6;

/// What the CUIK suite needs; 0 where it is not known.
struct CuikRun {
  int boxes = 0;
  double seconds = 0;
};

struct Line {
  const char* model;
  SingularitySet set;
  double sigma;
  double prototype_kilo_lu = 0;  ///< 0 where not measured
  CuikRun cuik = {};
  bool is_long = false;  ///< minutes: runs only where it is named
};

constexpr auto kForward = SingularitySet::forward, kInverse = SingularitySet::inverse, kCspace = SingularitySet::cspace;

const std::vector<Line> kSuite = {
    {"three_slider", kForward, 1e-8},
    {"three_slider", kInverse, 1e-8},
    {"dextar", kForward, 1},
    {"dextar", kForward, 0.1, 51, {340, 6.4}},
    {"dextar", kForward, 0.01, 164, {3393, 38.0}},
    {"dextar", kForward, 0.001},
    {"dextar", kInverse, 1},
    {"dextar", kInverse, 0.1, 267, {733, 23.0}},
    {"dextar", kInverse, 0.01, 578, {7214, 82.9}},
    {"dextar", kInverse, 0.001},
    {"dextar", kCspace, 0.2, 182, {5775, 17.9}},
    {"dextar", kCspace, 0.1},
    {"dextar", kCspace, 0.05, 1778, {91933, 272}},
    {"3rrr_fixed_orientation", kForward, 0.1},
    {"3rrr_fixed_orientation", kForward, 0.01},
    {"3rrr", kForward, 0.4, 0, {}, true},
    {"3rrr", kForward, 0.2, 0, {}, true},
};

/// Models that users brought; no set: a plain system. σ = 0: the default.
struct UserLine {
  const char* model;
  std::optional<SingularitySet> set;
  double sigma;
};

const std::vector<UserLine> kUserSuite = {
    {"stewart_fixed_orientation", kForward, 0.1}, {"spatial/stewart_rotation_matrix", kForward, 0.1},
    {"spatial/stewart_twist", {}, 0.1},           {"spatial/stewart_twist_12_digits", {}, 0.1},
    {"spatial/3rps_one_mode", kForward, 0.1},     {"spatial/delta_position", {}, 0},
    {"spatial/delta_position_by_legs", {}, 0},    {"peaucellier_ineq", kCspace, 0},
};

struct CuikLine {
  const char* name;
  CuikRun cuik;
};

const std::vector<CuikLine> kCuikSuite = {
    {"Welding0D", {2, 0.01}},
    {"Welding1D", {126, 0.25}},
    {"FourBars", {532, 3.0}},
    {"FourBars_extraeq", {522, 2.8}},
    {"Serial6RRX60", {8, 7.3}},
    {"Checker3", {815, 3.7}},
    {"SmartBird", {1370, 14}},
    {"simple_sing", {10928, 6.8}},
    {"3RPR_sing", {2881, 12.7}},
    {"3RPR_full", {}},
    {"3RPR", {}},
    {"FiveBars_sing", {}},
};

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Mean seconds of one certified test, see above; nothing where no box is proven.
std::optional<double> seconds_per_proof(const System& system, const Cover& cover) {
  const certify::Reduction reduction = solve::reduce(system);
  constexpr std::size_t kSamples = 500;
  constexpr int kRepeats = 5;
  struct Sample {
    Box box;
    std::vector<int> dependent;
  };
  std::vector<Sample> proven;
  for (const CoverBox& b : cover.boxes) {
    if (b.verdict == Verdict::undecided || b.verdict == Verdict::pending) continue;
    proven.emplace_back();
    for (int j = 0; j < reduction.system.size(); ++j) {
      const int v = reduction.kept[static_cast<std::size_t>(j)];
      proven.back().box.push_back(b.box[static_cast<std::size_t>(v)]);
      if (std::find(b.free.begin(), b.free.end(), v) == b.free.end()) proven.back().dependent.push_back(j);
    }
  }
  if (proven.empty()) return std::nullopt;
  std::vector<Sample> samples;
  const std::size_t count = std::min(kSamples, proven.size());
  for (std::size_t k = 0; k < count; ++k) samples.push_back(proven[k * proven.size() / count]);

  const certify::CompiledSystem compiled(reduction.system);
  solve::PreconditionerFactory preconditioners(compiled);
  certify::NewtonWorkspace workspace;
  const UpwardRounding rounding;
  const auto start = std::chrono::steady_clock::now();
  for (int repeat = 0; repeat < kRepeats; ++repeat) {
    for (const Sample& s : samples) {
      const certify::Preconditioner& p = preconditioners.at_midpoint(s.box, &s.dependent);
      certify::newton_prove(compiled, p, s.box, workspace);
    }
  }
  return seconds_since(start) / static_cast<double>(kRepeats * count);
}

void print_header() {
  fmt::print("corank {}; one 14x14 LU: {:.3f} us\n", CORANK_VERSION, 1e6 * bench::lu_seconds());
  fmt::print("{:123}{:>24}\n", "", "CUIK -------------------");
  fmt::print("{:<35}{:>4}{:>4}{:>10}{:>9}{:>8}{:>8}{:>5}{:>7}{:>6}{:>6}{:>8}{:>9}{:>9}{:>7}{:>7}{:>9}{:>8}\n", "problem",
             "n", "m", "processed", "newton", "boxes", "regular", "iso", "bound.", "part.", "undec", "seconds", "kLU",
             "overhead", "/proto", "boxes", "kLU", "speedup");
}

void run(const std::string& name, const System& system, const solve::Options& options, double prototype,
         const CuikRun& cuik) {
  const double unit_before = bench::lu_seconds();
  const Cover cover = solve::solve(system, options);
  const double unit = 0.5 * (unit_before + bench::lu_seconds());
  const double seconds = cover.statistics.seconds_total, kilo_lu = seconds / unit / 1000;
  const double returned = static_cast<double>(cover.boxes.size() - cover.count(Verdict::pending));
  const std::optional<double> proof = seconds_per_proof(system, cover);
  const auto number = [](double x, int digits) { return x > 0 ? fmt::format("{:.{}f}", x, digits) : std::string(); };
  const double cuik_kilo_lu = cuik.seconds / kReferenceUnit / 1000;
  fmt::print("{:<35}{:>4}{:>4}{:>10}{:>9}{:>8}{:>8}{:>5}{:>7}{:>6}{:>6}{:>8.3f}{:>9.1f}{:>9}{:>7}{:>7}{:>9}{:>8}{}\n", name,
             system.size(), system.equations.size(), cover.statistics.processed, cover.statistics.newton_steps,
             cover.boxes.size(), cover.count(Verdict::regular), cover.count(Verdict::isolated),
             cover.count(Verdict::boundary), cover.count(Verdict::partial), cover.count(Verdict::undecided), seconds,
             kilo_lu, proof ? number(seconds / (returned * *proof), 1) : "",
             number(prototype > 0 ? kilo_lu / prototype : 0, 2), cuik.boxes > 0 ? std::to_string(cuik.boxes) : "",
             number(cuik_kilo_lu, 0), number(cover.complete() ? cuik_kilo_lu / kilo_lu : 0, 1),
             cover.complete() ? "" : fmt::format("  incomplete: {} pending", cover.count(Verdict::pending)));
  std::fflush(stdout);
}

void run_models(const std::string& only, int threads) {
  for (const Line& line : kSuite) {
    const std::string name = fmt::format("{} {} {}", line.model, symbolic::to_string(line.set), line.sigma);
    if (name.find(only) == std::string::npos) continue;
    if (line.is_long && only.find(line.model) == std::string::npos) continue;
    const auto model = symbolic::read_model(std::string(CORANK_SOURCE_DIR "/models/") + line.model + ".cuik");
    solve::Options options;
    options.sigma = line.sigma;
    options.threads = threads;
    if (line.is_long) options.time_limit = kLongTimeLimit;
    run(name, study::system({model, line.set}), options, line.prototype_kilo_lu, line.cuik);
  }
}

void run_user_models(const std::string& only, int threads) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::path(CORANK_SOURCE_DIR "/../shared/models").lexically_normal();
  for (const UserLine& line : kUserSuite) {
    const fs::path file = folder / (std::string(line.model) + ".cuik");
    const std::string name =
        fmt::format("{} {} {}", file.stem().string(), line.set ? symbolic::to_string(*line.set) : "", line.sigma);
    if (name.find(only) == std::string::npos || !fs::exists(file)) continue;
    const auto model = symbolic::read_model(file);
    solve::Options options;
    if (line.sigma > 0) options.sigma = line.sigma;
    options.threads = threads;
    options.time_limit = kTimeLimit;
    run(name, study::system({model, line.set}), options, 0, {});
  }
}

void run_cuik_files(const std::string& only, int threads) {
  namespace fs = std::filesystem;
  const char* const given = std::getenv("CORANK_CUIK_DIR");
  const fs::path suite = given != nullptr && *given != '\0' ? given : CORANK_SOURCE_DIR "/../shared/cuik";
  const fs::path folder = (suite / "problems").lexically_normal();
  if (!fs::exists(folder)) {
    fmt::print("the CUIK suite's files are skipped: they are not in {} (CORANK_CUIK_DIR)\n", folder.string());
    return;
  }
  for (const CuikLine& line : kCuikSuite) {
    if (std::string(line.name).find(only) == std::string::npos) continue;
    const fs::path model = folder / (std::string(line.name) + ".cuik");
    try {
      System system = symbolic::algebrize(symbolic::plain_system(symbolic::read_model(model)));
      system.coefficient_tolerance = solve::printed_tolerance(system);
      solve::Options options;
      options.sigma = result::sigma_for(result::read_param(fs::path(model).replace_extension(".param")), system);
      options.threads = threads;
      options.time_limit = kTimeLimit;
      run(fmt::format("{} {}", line.name, options.sigma.value_or(0)), system, options, 0, line.cuik);
    } catch (const symbolic::ModelError& error) {
      fmt::print("{:<35}  refused: {}\n", line.name, error.what());
    }
  }
}

int usage() {
  fmt::print(stderr, "usage: corank_bench [--threads N] [WORD]\n");
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  std::string only;
  int threads = 1;
  bool word = false;
  for (int k = 1; k < argc; ++k) {
    const std::string argument = argv[k];
    if (argument == "--threads") {
      const std::string value = ++k < argc ? argv[k] : "";
      const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), threads);
      if (error != std::errc{} || end != value.data() + value.size() || threads < 0) return usage();
    } else if (word || argument.starts_with("-")) {
      return usage();
    } else {
      only = argument;
      word = true;
    }
  }
  print_header();
  run_models(only, threads);
  run_user_models(only, threads);
  run_cuik_files(only, threads);
}
