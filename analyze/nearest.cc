#include "corank/analyze/nearest.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <random>

#include "corank/analyze/distance_system.h"
#include "corank/analyze/witness.h"
#include "corank/certify/implied.h"
#include "corank/core/rounding.h"
#include "corank/solve/branching.h"
#include "corank/solve/contractor.h"
#include "corank/solve/minimum.h"

namespace corank::analyze {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kFinest = 1e-10;       // of typical sizes: doubles resolve little more
constexpr double kMargin = 1e-7;        // of a side: so far inside the domain a solution is sought that is to be proven
constexpr int kTries = 6;               // to prove a solution beside one that resists
constexpr double kFirstTry = 1e-4;      // how far beside, of the typical sizes; each next one is as much farther again
constexpr double kClose = 1e-6;         // of the typical sizes: what solves the equations nearly
constexpr std::uint64_t kReport = 256;  // boxes between two calls of the progress function

double root_below(double square) { return square <= 0 ? 0 : square_root(Interval(square))->lo(); }
double root_above(double square) { return square <= 0 ? 0 : square_root(Interval(square))->hi(); }

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
  void process(Node node);
  // Looks for a solution near the middle of x, and keeps it where it is proven and nearer than all before.
  void improve(std::span<const Interval> x);
  void try_point(const std::vector<double>& point);
  bool nearly_solves(const std::vector<double>& point) const;
  Box lifted(const Box& x) const;

  const solve::Prepared& prepared_;
  const NearestOptions& options_;
  solve::Control& control_;
  const DistanceSystem extended_;
  const certify::DomainTest domain_;
  certify::CompiledSystem compiled_;
  const solve::BranchingRule branching_;
  solve::PreconditionerFactory preconditioners_;
  certify::NewtonWorkspace workspace_;
  solve::Contractor contractor_;
  Box inner_;  // where solutions are sought
  std::vector<double> limits_;
  std::priority_queue<Node> waiting_;
  double stuck_ = kInfinity;  // the least bound of boxes that are not divided any more
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
      branching_(extended_.system),
      preconditioners_(compiled_, [&control] { return control.ended(); }),
      contractor_(compiled_, preconditioners_, workspace_) {
  compiled_.set_scales(solve::typical_sizes(compiled_, extended_.system.domain()).variables);
  for (const double size : compiled_.scales()) limits_.push_back(2 * kFinest * size);
  const std::vector<certify::ImpliedSides> implied = certify::implied_domains(extended_.system);
  for (std::size_t j = 0; j < implied.size(); ++j) {
    const Interval side = extended_.system.variables[j].domain;
    const double room = kMargin * side.width(), lower = side.lo() + (implied[j].lower ? -room : room),
                 upper = side.hi() + (implied[j].upper ? room : -room);
    inner_.push_back(lower < upper ? Interval(lower, upper) : side);
  }
}

void Search::set_cutoff() {
  if (upper_ < kInfinity) {
    const double r = root_above(upper_) * (1 - options_.precision);
    cutoff_ = r * r;  // rounded upward
  }
  if (options_.at_most > 0) cutoff_ = std::min(cutoff_, options_.at_most * options_.at_most);
}

Box Search::lifted(const Box& x) const {
  Box sides(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(prepared_.reduction.kept.size()));
  for (int k = 0; k < compiled_.values(); ++k) sides.push_back(compiled_.evaluate(compiled_.value_row(k), x));
  return prepared_.reduction.lift(sides);
}

bool Search::nearly_solves(const std::vector<double>& point) const {
  std::vector<double> j(static_cast<std::size_t>(compiled_.entries()));
  compiled_.approximate_jacobian(point.data(), j.data());
  for (int row = 0; row < compiled_.equations(); ++row) {
    double size = 0;
    for (int k = compiled_.row_begin(row); k < compiled_.row_begin(row + 1); ++k)
      size = std::max(size, std::fabs(j[static_cast<std::size_t>(k)]) *
                                compiled_.scales()[static_cast<std::size_t>(compiled_.column(k))]);
    if (compiled_.evaluate_at(row, point.data()).mag() > kClose * std::max(size, kClose)) return false;
  }
  return true;
}

void Search::try_point(const std::vector<double>& point) {
  const auto squared = static_cast<std::size_t>(extended_.squared);
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
  std::vector<double> start;
  for (int j = 0; j < compiled_.variables(); ++j) start.push_back(x[static_cast<std::size_t>(j)].mid());
  if (const auto point =
          solve::local_minimum(compiled_, extended_.squared, inner_, start, [this] { return control_.ended(); }))
    try_point(*point);
}

void Search::process(Node node) {
  Box& x = node.x;
  const auto squared = static_cast<std::size_t>(extended_.squared);
  if (!x[squared].intersect(Interval(-kInfinity, cutoff_))) return;
  if (!contractor_.run(x, statistics_)) return;
  const double bound = std::max(node.bound, x[squared].lo());
  if (bound >= cutoff_) return;
  const std::uint64_t n = statistics_.processed;
  if ((n & (n - 1)) == 0) {  // 1, 2, 4, 8 …
    improve(x);
    if (bound >= cutoff_) return;
  }
  const int j = branching_.choose(compiled_, x, limits_, contractor_.step() ? &*contractor_.step() : nullptr);
  const auto where = j < 0 ? std::nullopt : solve::split_point(x[static_cast<std::size_t>(j)]);
  if (!where) {
    stuck_ = std::min(stuck_, bound);
    return;
  }
  Node upper{bound, x};
  upper.x[static_cast<std::size_t>(j)] = Interval(*where, x[static_cast<std::size_t>(j)].hi());
  x[static_cast<std::size_t>(j)] = Interval(x[static_cast<std::size_t>(j)].lo(), *where);
  node.bound = bound;
  waiting_.push(std::move(upper));
  waiting_.push(std::move(node));
}

void Search::search(Nearest& result) {
  if (prepared_.reduction.consistent) waiting_.push({0, extended_.system.domain()});
  result.complete = true;
  while (!waiting_.empty() && waiting_.top().bound < cutoff_) {
    // Beside a point that resists proof nothing better is to be had.
    const double r = (1 - options_.precision) * root_below(unproven_square_);
    if (upper_ > unproven_square_ && unproven_square_ < kInfinity && waiting_.top().bound >= r * r) {
      result.complete = false;
      break;
    }
    if (control_.search_ended() || !control_.count_box()) {
      result.complete = false;
      break;
    }
    ++statistics_.processed;
    if (options_.progress && statistics_.processed % kReport == 0)
      options_.progress(root_below(waiting_.top().bound), best_ ? std::optional(root_above(upper_)) : std::nullopt,
                        statistics_.processed);
    Node node = waiting_.top();
    waiting_.pop();
    process(std::move(node));
  }
}

Nearest Search::run() {
  const UpwardRounding rounding;
  const solve::InStage stage(control_, solve::Stage::search);
  Nearest result;
  set_cutoff();
  search(result);
  const double left = std::min(stuck_, waiting_.empty() ? kInfinity : waiting_.top().bound);
  const double lower = std::min(left, cutoff_);
  result.empty = lower == kInfinity;
  result.lower = result.empty ? kInfinity : root_below(lower);
  result.complete = result.complete && (result.empty || stuck_ >= cutoff_);
  result.statistics = statistics_;
  if (best_) {
    result.upper = root_above(upper_);
    result.box = lifted(best_->sheet.image);
    for (int j : best_->free)
      if (static_cast<std::size_t>(j) < prepared_.reduction.kept.size())
        result.free.push_back(prepared_.reduction.kept[static_cast<std::size_t>(j)]);
  }
  if (unproven_square_ < upper_ && !unproven_.empty()) {
    const Box point(unproven_.begin(), unproven_.end());
    for (const Interval& side : lifted(point)) result.unproven.push_back(side.mid());
    result.unproven_distance = root_above(unproven_square_);
  }
  return result;
}

}  // namespace

Nearest nearest(const solve::Prepared& prepared, const std::vector<Polynomial>& differences, const NearestOptions& options,
                solve::Control& control) {
  return Search(prepared, differences, options, control).run();
}

}  // namespace corank::analyze
