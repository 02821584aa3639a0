#include "corank/analyze/sets/nearest.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <memory>
#include <random>

#include "corank/analyze/sets/distance_system.h"
#include "corank/certify/implied.h"
#include "corank/core/box.h"
#include "corank/core/rounding.h"
#include "corank/core/threads.h"
#include "corank/solve/exactness/ipopt.h"
#include "corank/solve/search/solve.h"
#include "corank/solve/step/branching.h"
#include "corank/solve/step/preconditioner.h"
#include "corank/solve/step/problem.h"
#include "corank/solve/step/propagation.h"

namespace corank::analyze {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kFinest = 1e-10;   // of typical sizes: doubles resolve little more
constexpr double kMargin = 1e-7;    // of a side: so far inside the domain a solution is sought that is to be proven
constexpr int kTries = 6;           // to prove a solution beside one that resists
constexpr double kFirstTry = 1e-4;  // how far beside, of the typical sizes; each next one is as much farther again
constexpr double kClose = 1e-9;     // of their typical sizes: what solves the equations nearly
// Of kernel unknowns when it is chosen what to bisect: where nearly all boxes are empty it is the directions that show it.
// Measured, see bench/HISTORY.md.
constexpr double kKernelWeight = 4;
constexpr std::size_t kBatch = 32;  // boxes that are processed at once, whatever the number of threads

double root_below(double square) { return square <= 0 ? 0 : square_root(Interval(square))->lo(); }

class Search {
 public:
  Search(const solve::Prepared& prepared, const std::vector<Polynomial>& differences, const NearestOptions& options,
         solve::Control& control);
  Nearest run();

 private:
  struct Node {
    double bound;
    Box x;
    bool operator<(const Node& other) const { return bound > other.bound; }  // the least bound is on top
  };
  // No solution farther away, in squares, matters.
  void set_cutoff();
  void search(Nearest& result);
  // What is left of a box: its halves, or the bound of one that is not divided any more.
  struct Parts {
    std::vector<Node> nodes;
    std::optional<Node> stuck;
  };
  struct Worker {
    Worker(const certify::CompiledSystem& system, const solve::Heuristics& heuristics, const Ended& ended)
        : preconditioners(system, ended), contractor(system, heuristics, preconditioners, workspace) {}
    solve::PreconditionerFactory preconditioners;
    certify::NewtonWorkspace workspace;
    solve::Contractor contractor;
    Statistics statistics;
  };
  Parts process(Node node, Worker& worker) const;
  void process_batch();
  // Looks for a solution near the middle of x, and keeps it where it is proven and nearer than all before.
  void improve(std::span<const Interval> x);
  void try_point(const std::vector<double>& point);
  bool nearly_solves(const std::vector<double>& point) const;

  const solve::Prepared& prepared_;
  const NearestOptions& options_;
  solve::Control& control_;
  const DistanceSystem extended_;
  const certify::DomainTest domain_;
  certify::CompiledSystem compiled_;
  const solve::BranchingRule branching_;
  solve::PreconditionerFactory preconditioners_;
  certify::NewtonWorkspace workspace_;
  ThreadArena arena_;
  std::vector<std::unique_ptr<Worker>> workers_;  // one for each thread
  Box inner_;                                     // where solutions are sought
  std::vector<double> limits_, equation_sizes_;
  void push(Node node);
  Node pop();
  const Node& next() const { return waiting_.front(); }

  std::vector<Node> waiting_;  // a heap
  double stuck_ = kInfinity;   // the least bound of boxes that are not divided any more
  double cutoff_ = kInfinity, upper_ = kInfinity, unproven_square_ = kInfinity;
  std::optional<Witness> best_;
  std::vector<double> unproven_;
  Statistics statistics_;
  std::mt19937 random_{20170814};
};

Search::Search(const solve::Prepared& prepared, const std::vector<Polynomial>& differences, const NearestOptions& options,
               solve::Control& control)
    : prepared_(prepared),
      options_(options),
      control_(control),
      extended_(distance_system(prepared.reduction, differences)),
      domain_(extended_.system),
      compiled_(extended_.system, extended_.values),
      branching_(extended_.system, kKernelWeight),
      preconditioners_(compiled_, [&control] { return control.ended(); }),
      arena_(prepared.options.threads) {
  const solve::Heuristics heuristics = solve::heuristics_for(extended_.system, prepared.reduction.tolerant);
  for (int k = 0; k < arena_.threads(); ++k)
    workers_.push_back(std::make_unique<Worker>(compiled_, heuristics, [this] { return control_.ended(); }));
  solve::TypicalSizes sizes = solve::typical_sizes(compiled_, extended_.system.domain());
  compiled_.set_scales(std::move(sizes.variables));
  equation_sizes_ = std::move(sizes.equations);
  for (const double size : compiled_.scales()) limits_.push_back(2 * kFinest * size);
  const std::vector<certify::ImpliedSides> implied = certify::implied_domains(extended_.system);
  for (std::size_t j = 0; j < implied.size(); ++j) {
    const Interval side = extended_.system.variables[j].domain;
    const double room = kMargin * side.width(), lower = side.lo() + (implied[j].lower ? -room : room),
                 upper = side.hi() + (implied[j].upper ? room : -room);
    inner_.push_back(lower < upper ? Interval(lower, upper) : side);
  }
}

void Search::push(Node node) {
  waiting_.push_back(std::move(node));
  std::push_heap(waiting_.begin(), waiting_.end());
}

Search::Node Search::pop() {
  std::pop_heap(waiting_.begin(), waiting_.end());
  Node node = std::move(waiting_.back());
  waiting_.pop_back();
  return node;
}

void Search::set_cutoff() {
  if (upper_ < kInfinity) {
    const double r = root_above(upper_) * (1 - options_.precision);
    cutoff_ = r * r;  // rounded upward
  }
  if (options_.at_most > 0) cutoff_ = std::min(cutoff_, options_.at_most * options_.at_most);
}

bool Search::nearly_solves(const std::vector<double>& point) const {
  for (int row = 0; row < compiled_.equations(); ++row)
    if (compiled_.evaluate_at(row, point.data()).mag() > kClose * equation_sizes_[row]) return false;
  return true;
}

void Search::try_point(const std::vector<double>& point) {
  const int squared = extended_.squared;
  if (!(point[squared] < upper_) && !(point[squared] < unproven_square_)) return;
  std::uniform_real_distribution<double> direction(-1, 1);
  for (int attempt = 0; attempt <= kTries; ++attempt) {
    std::vector<double> start = point;
    for (std::size_t j = 0; attempt > 0 && j < start.size(); ++j)
      start[j] += kFirstTry * std::pow(2.0, attempt) * compiled_.scales()[j] * direction(random_);
    auto witness = prove_near(compiled_, domain_, start, preconditioners_, workspace_);
    if (!witness) continue;
    if (witness->sheet.image[squared].hi() < upper_) {
      upper_ = witness->sheet.image[squared].hi();
      best_ = std::move(witness);
      set_cutoff();
    }
    return;
  }
  if (point[squared] < unproven_square_ && nearly_solves(point)) unproven_square_ = point[squared], unproven_ = point;
}

void Search::improve(std::span<const Interval> x) {
  const std::vector<double> start = midpoint(x);
  if (const auto point =
          solve::local_minimum(compiled_, extended_.squared, inner_, start, [this] { return control_.ended(); }))
    try_point(*point);
}

Search::Parts Search::process(Node node, Worker& worker) const {
  const UpwardRounding rounding;
  Parts parts;
  Box& x = node.x;
  const int squared = extended_.squared;
  if (!x[squared].intersect(Interval(-kInfinity, cutoff_))) return parts;
  if (!worker.contractor.run(x, worker.statistics)) return parts;
  node.bound = std::max(node.bound, x[squared].lo());
  if (node.bound >= cutoff_) return parts;
  const auto& step = worker.contractor.step();
  const int j = branching_.choose(compiled_, x, limits_, step ? &*step : nullptr);
  const auto where = j < 0 ? std::nullopt : solve::split_point(x[j]);
  if (!where) {
    parts.stuck = std::move(node);
    return parts;
  }
  const Interval side = x[j];
  parts.nodes = {node, std::move(node)};
  parts.nodes[0].x[j] = Interval(side.lo(), *where);
  parts.nodes[1].x[j] = Interval(*where, side.hi());
  return parts;
}

void Search::process_batch() {
  std::vector<Node> batch;
  while (!waiting_.empty() && next().bound < cutoff_ && batch.size() < kBatch && control_.count_box())
    batch.push_back(pop());
  std::vector<Parts> parts(batch.size());
  arena_.execute([&] {
    tbb::parallel_for(std::size_t{0}, batch.size(), [&](std::size_t i) {
      parts[i] = process(std::move(batch[i]), *workers_[tbb::this_task_arena::current_thread_index()]);
    });
  });
  const std::uint64_t before = statistics_.processed;
  statistics_.processed += batch.size();
  for (Parts& part : parts) {
    if (part.stuck) {
      stuck_ = std::min(stuck_, part.stuck->bound);
      try_point(midpoint(part.stuck->x));
    }
    for (Node& node : part.nodes) push(std::move(node));
  }
  // Now and then, ever more seldom.
  if (std::bit_width(before) < std::bit_width(statistics_.processed) && statistics_.processed >= options_.patience &&
      !waiting_.empty() && next().bound < cutoff_)
    improve(Box(next().x));
}

void Search::search(Nearest& result) {
  if (prepared_.reduction.consistent) push({0, extended_.system.domain()});
  result.complete = true;
  while (!waiting_.empty() && next().bound < cutoff_) {
    if (best_ && root_above(upper_) <= options_.enough) {
      result.complete = false;
      break;
    }
    // Beside a point that resists proof nothing better is to be had.
    const double r = (1 - options_.precision) * root_below(unproven_square_);
    if (upper_ > unproven_square_ && unproven_square_ < kInfinity && next().bound >= r * r) {
      result.complete = false;
      break;
    }
    const std::uint64_t before = statistics_.processed;
    if (control_.search_ended()) {
      result.complete = false;
      break;
    }
    if (options_.progress)
      options_.progress(root_below(next().bound), best_ ? std::optional(root_above(upper_)) : std::nullopt,
                        statistics_.processed);
    process_batch();
    if (statistics_.processed == before) {
      result.complete = false;
      break;
    }
  }
}

Nearest Search::run() {
  const UpwardRounding rounding;
  const solve::InStage stage(control_, solve::Stage::search);
  Nearest result;
  set_cutoff();
  search(result);
  const double left = std::min(stuck_, waiting_.empty() ? kInfinity : next().bound);
  const double lower = std::min(left, cutoff_);
  result.empty = lower == kInfinity;
  result.lower = result.empty ? kInfinity : root_below(lower);
  result.complete = result.complete && (result.empty || stuck_ >= cutoff_);
  for (const auto& worker : workers_) statistics_.newton_steps += worker->statistics.newton_steps;
  result.statistics = statistics_;
  if (best_) {
    result.upper = root_above(upper_);
    result.box = lifted(compiled_, prepared_.reduction, best_->sheet.image);
    for (int j : best_->free)
      if (std::cmp_less(j, prepared_.reduction.kept.size())) result.free.push_back(prepared_.reduction.kept[j]);
  }
  if (unproven_square_ < upper_ && !unproven_.empty()) {
    const Box point(unproven_.begin(), unproven_.end());
    result.unproven = midpoint(lifted(compiled_, prepared_.reduction, point));
    result.unproven_distance = root_above(unproven_square_);
  }
  return result;
}

}  // namespace

double root_above(double square) { return square <= 0 ? 0 : square_root(Interval(square))->hi(); }

Nearest nearest(const solve::Prepared& prepared, const std::vector<Polynomial>& differences, const NearestOptions& options,
                solve::Control& control) {
  return Search(prepared, differences, options, control).run();
}

Cover search_briefly(System system, std::uint64_t solutions, std::uint64_t boxes, int threads,
                     const solve::Control& control) {
  constexpr double kSeconds = 3;
  const solve::Options options{.threads = threads, .max_solutions = solutions};
  solve::Control own(control.rest(kSeconds, boxes));
  return solve::solve(solve::prepare(std::move(system), options, own), own);
}

Box lifted(const certify::CompiledSystem& compiled, const certify::Reduction& reduction, const Box& x) {
  Box sides(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(reduction.kept.size()));
  for (int k = 0; k < compiled.values(); ++k) sides.push_back(compiled.evaluate(compiled.value_row(k), x));
  return reduction.lift(sides);
}

std::optional<Witness> prove_near(const certify::CompiledSystem& system, const certify::DomainTest& domain,
                                  const std::vector<double>& point, solve::PreconditionerFactory& preconditioners,
                                  certify::NewtonWorkspace& workspace) {
  constexpr int kCorrections = 4;
  std::vector<Interval> x(point.begin(), point.end());
  for (int step = 0; step < kCorrections; ++step) {
    const certify::Preconditioner& p = preconditioners.at_midpoint(x);
    if (p.rank() < system.equations()) return std::nullopt;
    std::vector<double> now = midpoint(x);
    for (int a = 0; a < p.rank(); ++a) {
      double shift = 0;
      for (int b = 0; b < p.rank(); ++b)
        shift += p.y[a * p.rank() + b] * system.evaluate_at(p.equations[b], now.data()).mid();
      const double moved = now[p.dependent[a]] - shift;
      if (!std::isfinite(moved)) return std::nullopt;
      x[p.dependent[a]] = moved;
    }
  }
  const certify::Preconditioner& p = preconditioners.at_midpoint(x);
  if (p.rank() < system.equations()) return std::nullopt;
  Witness witness{certify::newton_prove(system, p, x, workspace), {}};
  if (!witness.sheet.proven || domain.locate(system, witness.sheet.image) != certify::Location::inside) return std::nullopt;
  witness.free = all_but(p.dependent, system.variables());
  return witness;
}

}  // namespace corank::analyze
