#include "corank/solve/search/estimate.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <functional>
#include <random>
#include <utility>

#include "corank/core/box.h"
#include "corank/core/rounding.h"
#include "corank/core/threads.h"
#include "corank/solve/cutting/cut_planner.h"
#include "corank/solve/search/box_processor.h"
#include "corank/solve/search/passes.h"
#include "corank/solve/step/preconditioner.h"
#include "corank/solve/store/memory.h"
#include "corank/solve/store/strata.h"

namespace corank::solve {
namespace {

constexpr int kTrials = 6;                           // independent, for the interval
constexpr std::size_t kFewest = 24, kMost = 20'000;  // boxes of a level in one trial
constexpr double kUsualDepth = 60;                   // levels: how the trial's time is divided among them
constexpr double kSearchShare = 0.6;                 // of the trial's time
constexpr double kLeastSpread = 0.1;                 // of a count that is not exact
constexpr double kClockSpread = 0.35;                // of times: caches, other work on the machine
// Measured (bench/HISTORY.md): sorting a box and lifting it to all variables; looking whether pieces of a curve merge.
constexpr double kStartSeconds = 3e-3, kAssemblySeconds = 1e-6, kMergingSeconds = 1.5e-6;
constexpr double kMostPieces = 20'000;  // of one sheet: a larger one is cut more coarsely, and counted up
constexpr std::size_t kMostSheets = 5'000, kLargestSheets = 30;

double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct Weighed {
  Proven sheet;
  double weight, pieces = 0;
};

struct Trial {
  double processed = 0, seconds = 0, sheets = 0, postponed = 0, unproven = 0;
  bool whole = true;
};

struct Mean {
  double value = 0, error = 0;  // of the mean
};

Mean mean_of(const std::vector<double>& values) {
  Mean mean;
  const auto n = static_cast<double>(values.size());
  for (const double v : values) mean.value += v / n;
  double variance = 0;
  for (const double v : values) variance += (v - mean.value) * (v - mean.value);
  if (values.size() > 1) mean.error = std::sqrt(variance / (n - 1) / n);
  return mean;
}

CostRange range_of(double likely, double relative_error) {
  const double factor = 1 + 2 * relative_error;
  return {likely / factor, likely, likely * factor};
}

class Estimator {
 public:
  Estimator(const Prepared& prepared, Control& control, double seconds, std::uint32_t seed)
      : prepared_(prepared),
        control_(control),
        seconds_(seconds),
        random_(seed),
        problem_(problem_with_strata(prepared, [&control] { return control.ended(); })) {
    problem_.set_sigma(sigma_of_search(prepared, problem_));
  }

  CostEstimate run() {
    const UpwardRounding rounding;
    const double begun = cpu_seconds();
    std::vector<Trial> trials;
    do {
      trials.push_back(descend(seconds_ * kSearchShare / kTrials));
    } while (trials.size() < kTrials && !trials.back().whole && !control_.ended());
    CostEstimate e = of_search(trials);
    const double each = 1 / static_cast<double>(trials.size());
    for (Weighed& sheet : sheets_) sheet.weight *= each;
    add_cutting(e, seconds_ * (1 - kSearchShare));
    e.trial_seconds = cpu_seconds() - begun;
    return e;
  }

 private:
  // One population of boxes, from the roots to the leaves.
  Trial descend(double seconds) {
    Trial trial;
    const Work first = first_pass(prepared_);
    std::vector<Waiting> level = first.boxes, next;
    Shard shard(1, false);
    BoxProcessor processor(problem_, shard);
    double weight = 1, per_box = 0;
    std::uint64_t done = 0;
    const double begun = cpu_seconds();
    while (!level.empty() && !control_.ended()) {
      const double most = per_box > 0 ? seconds / (kUsualDepth * per_box) : kFewest;
      const auto keep = static_cast<std::size_t>(std::clamp<double>(most, kFewest, kMost));
      if (level.size() > keep) {
        weight *= static_cast<double>(level.size()) / static_cast<double>(keep);
        std::ranges::shuffle(level, random_);
        level.resize(keep);
        trial.whole = false;
      }
      next.clear();
      const double level_begun = cpu_seconds();
      for (Waiting& box : level) process(processor, shard, box, first.postpone, weight, next, trial);
      trial.seconds += weight * (cpu_seconds() - level_begun);
      trial.processed += weight * static_cast<double>(level.size());
      done += level.size();
      per_box = (cpu_seconds() - begun) / static_cast<double>(done);
      std::swap(level, next);
    }
    if (control_.ended()) trial.whole = false;
    return trial;
  }

  void process(BoxProcessor& processor, Shard& shard, Waiting& box, double postpone, double weight,
               std::vector<Waiting>& next, Trial& trial) {
    const auto outcome = processor.process(box.x, postpone, box.share);
    for (Proven& sheet : shard.sheets) sheets_.push_back({std::move(sheet), weight});
    trial.sheets += weight * static_cast<double>(shard.sheets.size());
    trial.postponed += weight * static_cast<double>(shard.postponed.size());
    trial.unproven += weight * static_cast<double>(shard.found.size());
    shard.sheets.clear();
    shard.postponed.clear();
    shard.found.clear();
    if (outcome != BoxProcessor::Outcome::split) return;
    auto [lower, upper] = processor.halves(std::move(box));
    next.push_back(std::move(upper));
    next.push_back(std::move(lower));
  }

  CostEstimate of_search(const std::vector<Trial>& trials) {
    CostEstimate e;
    e.whole_tree = trials.back().whole;
    std::vector<Trial> used = trials;
    if (e.whole_tree) used = {trials.back()};
    const auto column = [&](double Trial::*member) {
      std::vector<double> values;
      for (const Trial& t : used) values.push_back(t.*member);
      return mean_of(values);
    };
    const Mean processed = column(&Trial::processed), sheets = column(&Trial::sheets), seconds = column(&Trial::seconds);
    const auto relative = [&](const Mean& m) {
      return e.whole_tree || m.value == 0 ? 0 : std::max(kLeastSpread, m.error / m.value);
    };
    e.processed = range_of(processed.value, relative(processed));
    e.sheets = range_of(sheets.value, relative(sheets));
    sheets_error_ = relative(sheets);
    search_seconds_ = seconds.value;
    search_error_ = relative(seconds);
    unproven_ = column(&Trial::unproven).value + column(&Trial::postponed).value;
    e.postponed = processed.value > 0 ? column(&Trial::postponed).value / processed.value : 0;
    return e;
  }

  // So many pieces a sheet would make, linearized, with problem_'s σ.
  double pieces_of(const Proven& proven) {
    const certify::Sheet& sheet = proven.sheet;
    Box sides = sheet.image;
    const auto& p = preconditioners_.at_midpoint(sides, &sheet.dependent, &sheet.equations);
    const certify::NewtonStep step = certify::tighten_sheet(problem_.compiled, p, sides, workspace_);
    problem_.append_values(sides);
    double product = 1;
    const std::vector<int> free = all_but(sheet.dependent, problem_.compiled.variables());
    for (const int count :
         planner_.parts(step, problem_.without_parameters(free), sides, planner_.widened_sigma(step, sides)))
      product *= count;
    return product;
  }

  // By which σ is to be multiplied, so that none of the largest sheets makes too many pieces; problem_ has that σ then.
  double coarser_for(const Sigma& sigma) {
    std::vector<const Weighed*> largest;
    for (const Weighed& sheet : sheets_) largest.push_back(&sheet);
    std::ranges::sort(largest, std::greater<>(), &Weighed::pieces);
    largest.resize(std::min(kLargestSheets, largest.size()));
    double coarser = 1;
    const auto makes_too_many = [&](const Weighed* sheet) { return pieces_of(sheet->sheet) > kMostPieces; };
    while (!control_.ended() && std::ranges::any_of(largest, makes_too_many)) {
      coarser *= 1.5;
      problem_.set_sigma({sigma.length * coarser, sigma.angle * coarser});
    }
    return coarser;
  }

  void add_cutting(CostEstimate& e, double seconds) {
    Shard all(1, false);
    for (const Weighed& sheet : sheets_) all.sheets.push_back(sheet.sheet);
    e.sigma = problem_.tolerant ? sigma_of_search(prepared_, problem_) : sigma_of_set(prepared_, problem_, {&all});
    problem_.set_sigma(e.sigma);
    std::ranges::shuffle(sheets_, random_);
    if (sheets_.size() > kMostSheets) {
      for (Weighed& sheet : sheets_) sheet.weight *= static_cast<double>(sheets_.size()) / kMostSheets;
      sheets_.resize(kMostSheets);
    }
    double whole_size = 0;
    for (Weighed& sheet : sheets_) {
      if (control_.ended()) break;
      sheet.pieces = pieces_of(sheet.sheet);
      whole_size += sheet.weight * sheet.pieces;
    }
    const double coarser = coarser_for(e.sigma);
    Shard shard(1, false);
    BoxProcessor processor(problem_, shard);
    const double begun = cpu_seconds();
    double size = 0, pieces = 0, spent = 0, squares = 0;
    std::size_t cut = 0;
    const MemoryEstimate memory(prepared_.reduction, control_.limits().later_bytes);
    double bytes = 0, found = 0;
    for (const Weighed& sheet : sheets_) {
      const double now = cpu_seconds();
      if (cut > 0 && (now - begun > seconds || control_.ended())) break;
      processor.cut(sheet.sheet, false);
      const double proxy = sheet.weight * sheet.pieces;
      const double taken = cpu_seconds() - now, scale = coarser > 1 ? sheet.pieces / pieces_of(sheet.sheet) : 1;
      size += proxy;
      pieces += sheet.weight * scale * static_cast<double>(shard.found.size());
      squares += proxy * proxy;
      spent += sheet.weight * scale * taken;
      for (std::size_t i = 0; i < shard.found.size(); ++i)
        bytes += static_cast<double>(memory.of(shard.found[i], i > 0 ? &shard.found[i - 1] : nullptr));
      found += static_cast<double>(shard.found.size());
      shard.found.clear();
      ++cut;
    }
    const double ratio = size > 0 ? whole_size / size : 0;
    const double boxes = pieces * ratio + unproven_;
    const double sampling = cut < sheets_.size() && size > 0 ? std::sqrt(squares) / size : 0;
    const double spread = std::hypot(sheets_error_, std::hypot(sampling, coarser > 1 ? kLeastSpread : 0));
    e.boxes = range_of(boxes, spread);
    const int threads = threads_for(prepared_.options.threads);
    const double cutting = spent * ratio;
    const bool curve = prepared_.reduction.system.dimension() == 1;
    const double total = search_seconds_ + cutting;
    const double after = kStartSeconds + boxes * (kAssemblySeconds + (curve ? kMergingSeconds : 0));
    const double error = total > 0 ? std::hypot(search_seconds_ * search_error_, cutting * spread) / total : 0;
    e.seconds = range_of(total / threads + after, std::hypot(error, kClockSpread / 2));
    const auto sides = static_cast<double>(prepared_.system.variables.size());
    constexpr double kOfABox = 3, kOfAFile = 20'000;  // bytes beside its sides
    constexpr double kOfAProcess = 42e6;
    e.file = range_of(kOfAFile + boxes * (kOfABox + kFileBytes * sides) + 16 * sides * e.sheets.likely, spread);
    e.memory = range_of(kOfAProcess + (found > 0 ? bytes / found : 0) * boxes + e.sheets.likely * 48 * sides,
                        std::hypot(spread, kLeastSpread));
  }

  const Prepared& prepared_;
  Control& control_;
  const double seconds_;
  std::mt19937 random_;
  Problem problem_;
  PreconditionerFactory preconditioners_{problem_.compiled};
  certify::NewtonWorkspace workspace_;
  CutPlanner planner_{problem_};
  std::vector<Weighed> sheets_;
  double sheets_error_ = 0, search_seconds_ = 0, search_error_ = 0, unproven_ = 0;
};

}  // namespace

CostEstimate estimate(const Prepared& prepared, Control& control, double trial_seconds, std::uint32_t seed) {
  return Estimator(prepared, control, trial_seconds, seed).run();
}

}  // namespace corank::solve
