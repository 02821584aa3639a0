#include "corank/solve/search/box_processor.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "corank/core/box.h"
#include "corank/solve/step/heuristics.h"
#include "corank/solve/store/strata.h"

namespace corank::solve {
BoxProcessor::BoxProcessor(const Problem& problem, Shard& shard)
    : problem_(problem),
      shard_(shard),
      recorder_(shard.script ? &*shard.script : nullptr),
      preconditioners_(problem.compiled, problem.ended),
      contractor_(problem.compiled, problem.heuristics, preconditioners_, workspace_, recorder_),
      slicer_(problem, preconditioners_, workspace_, recorder_) {}

certify::Sheet BoxProcessor::prove(std::span<const Interval> x, int steps) {
  if (preconditioners_.at_midpoint(x).rank() < problem_.compiled.equations()) {
    dependent_ = preconditioners_.last().dependent;
    return {};
  }
  std::vector<int> pivots = preconditioners_.last().dependent;
  std::ranges::sort(pivots);
  dependent_ = preconditioners_.chart_of_last(problem_.compiled.scales(), kChartGain);
  const auto& p = pivots == dependent_ ? preconditioners_.last() : preconditioners_.at_midpoint(x, &dependent_);
  if (p.rank() < problem_.compiled.equations()) return {};
  return certify::newton_prove(problem_.compiled, p, x, workspace_, steps);
}

certify::Sheet BoxProcessor::prove_in_part(std::span<const Interval> x) {
  const certify::Preconditioner& p = preconditioners_.last();
  if (p.rank() < problem_.compiled.equations()) return {};
  const std::optional<Box> near = box_about_solution(problem_.compiled, preconditioners_, x);
  return near ? certify::newton_prove_in_part(problem_.compiled, p, x, *near, workspace_) : certify::Sheet{};
}

certify::Sheet BoxProcessor::prove_partially(std::span<const Interval> x) {
  certify::Sheet narrow =
      certify::newton_prove(problem_.compiled, preconditioners_.near_solution(x, problem_.rank_tolerance), x, workspace_);
  if (!narrow.proven || !problem_.is_partial(narrow) || narrow.dependent.size() == narrow.region.size()) return narrow;
  std::vector<Interval> wide(x.begin(), x.begin() + problem_.compiled.variables());
  for (std::size_t j = 0; j < wide.size(); ++j) {
    const double half = 0.5 * std::min(problem_.sigma[j], 2 * kPartialShare * problem_.compiled.scales()[j]);
    wide[j] = Interval::hull(wide[j], Interval(wide[j].mid() - half, wide[j].mid() + half));
  }
  const auto& p = preconditioners_.near_solution(wide, problem_.rank_tolerance);
  certify::Sheet sheet = certify::newton_prove(problem_.compiled, p, wide, workspace_);
  if (!sheet.proven || !problem_.is_partial(sheet)) return sheet;
  const std::vector<int> free = all_but(sheet.dependent, problem_.compiled.variables());
  if (!slicer_.holds_on_parts(sheet, free, sheet.image, kPartialDepth)) return {};
  for (int j : free) sheet.region[j] = sheet.image[j] = x[j];  // for every value of the free variables: so for x's too
  return sheet;
}

bool BoxProcessor::certify(std::span<Interval> x, Proof proof) {
  const auto start = std::chrono::steady_clock::now();
  ++shard_.statistics.proofs_tried;
  const bool part = proof == Proof::full && problem_.may_be_part(x);
  certify::Sheet sheet = proof == Proof::full ? prove(x, part ? kProofStepsBeforeParts : kProofSteps) : prove_partially(x);
  if (!sheet.proven && part) sheet = prove_in_part(x);
  if (sheet.proven) {
    if (recorder_) {
      recorder_->newton(preconditioners_.last(), x);
      recorder_->keep(x);
    }
    shard_.sheets.push_back({copy_of(x), sheet, go_on_later()});
  }
  shard_.statistics.seconds_certify += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return sheet.proven;
}

void BoxProcessor::add_unproven(std::span<const Interval> x, Verdict verdict, Reason reason) {
  Found found;
  found.box.box = copy_of(x);
  problem_.append_values(found.box.box);
  found.box.verdict = verdict;
  found.box.reason = reason;
  if (recorder_) recorder_->leaf_box(shard_.found.size());
  shard_.found.push_back(std::move(found));
}

void BoxProcessor::leave(const Waiting& box) {
  if (recorder_) recorder_->begin(box.node, box.x, problem_.compiled.variables());
  if (problem_.domain.locate(problem_.compiled, box.x) != certify::Location::outside) {
    add_unproven(box.x, Verdict::pending);
  } else if (recorder_) {
    recorder_->leaf_empty();
  }
}

int BoxProcessor::widest_of(const std::vector<int>& sides, std::span<const Interval> x) const {
  const std::vector<double>& scales = problem_.compiled.scales();
  int widest = -1;
  for (const int j : sides)
    if (widest < 0 || x[j].width() * scales[widest] > x[widest].width() * scales[j]) widest = j;
  return widest;
}

int BoxProcessor::widest_free(std::span<const Interval> x) {
  std::vector<int> free = problem_.without_parameters(all_but(dependent_, problem_.compiled.variables()));
  if (!settled_.empty()) std::erase_if(free, [&](int j) { return settled_[j]; });
  return widest_of(free, x);
}

void BoxProcessor::find_settled(std::span<const Interval> x) {
  settled_.clear();
  // What tolerances leave unproven is given up at once, and is to be narrow then.
  if (!problem_.tolerant) settled_ = problem_.branching.settled(problem_.compiled, x);
}

std::vector<double> BoxProcessor::limits(double share, Sides of) const {
  std::vector<double> result = problem_.limits(share);
  for (std::size_t j = 0; j < settled_.size(); ++j)
    if (settled_[j] != (of == Sides::settled)) result[j] = HUGE_VAL;
  return result;
}

double BoxProcessor::relative_width(std::span<const Interval> x) const {
  if (settled_.empty()) return problem_.relative_width(x);
  Box open = copy_of(x);
  for (std::size_t j = 0; j < open.size(); ++j)
    if (settled_[j]) open[j] = Interval(open[j].mid());
  return problem_.relative_width(open);
}

void BoxProcessor::add_proven(const Postponed& postponed) {
  const Box& x = postponed.box.x;
  if (recorder_) {
    recorder_->begin(postponed.box.node, x, problem_.compiled.variables());
    recorder_->newton(postponed.step, x);
  }
  shard_.sheets.push_back({x, postponed.proof, go_on_later()});
}

bool BoxProcessor::cut(const Proven& proven, bool whole) {
  const auto start = std::chrono::steady_clock::now();
  if (recorder_) recorder_->begin(proven.node, proven.x, problem_.compiled.variables());
  const bool finished = slicer_.slice(proven.sheet, proven.x, shard_.found, whole);
  shard_.statistics.seconds_certify += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return finished && !preconditioners_.over();
}

std::vector<double> BoxProcessor::midpoint(std::span<const Interval> x) const {
  return corank::midpoint(x.first(problem_.compiled.variables()));
}

std::optional<LocalSolution> BoxProcessor::degenerate_solution(std::span<const Interval> x, double share) const {
  const auto& system = problem_.compiled;
  auto near = local_solution(problem_, midpoint(x), kRankShare * share, problem_.relative_width(x) + kReach * share);
  if (!near || near->rank >= std::min(system.equations(), system.unknowns())) return std::nullopt;
  for (int j = 0; j < system.variables(); ++j) {
    const double at = near->x[j], room = 2 * share * system.scales()[j];
    if (at < x[j].lo() - room || at > x[j].hi() + room) return std::nullopt;
  }
  if (breaks_inequality(problem_, near->x, share)) return std::nullopt;
  return near;
}

// The variable to bisect; −1: the box is small enough to be given up, and `near` says why where that is known.
int BoxProcessor::choose_split(std::span<const Interval> x, double share, std::optional<LocalSolution>& near) {
  const auto& branching = problem_.branching;
  find_settled(x);
  if (std::ranges::all_of(settled_, [](bool settled) { return settled; })) settled_.clear();  // then all sides are alike
  const double width = relative_width(x);
  if (width <= problem_.tolerance_width) return -1;  // what remains open belongs to tolerances: other robots differ
  const bool noisy = contractor_.noisy() && width < kNoisySize;
  const certify::NewtonStep* const step = width > problem_.heuristics.wide ? &*contractor_.step() : nullptr;
  int split = noisy ? -1 : branching.choose(problem_.compiled, x, limits(share, Sides::open), step);
  if (split < 0 && !noisy && !problem_.tolerant) {
    // Where Newton is regular a smaller box may be proven; where no degenerate solution is near a smaller one is empty or
    // may be, but not for long. What is regular and yet not proven in a tiny box is next to a degenerate solution: around a
    // point of a surface there would be no end of such boxes, and of surfaces that cross along a curve twice as many of
    // each next size.
    if (!contractor_.regular() || width < kTiny || (problem_.has_surfaces() && width < kRegularShare * share) ||
        !settled_.empty())
      near = degenerate_solution(x, share);
    const auto choose = [&](double finest, Sides sides) {
      return branching.choose(problem_.compiled, x, limits(finest, sides), step);
    };
    if (!near && (!contractor_.regular() || !settled_.empty())) split = choose(kOpenShare * share, Sides::open);
    // Settled sides wait where a degenerate solution is; where none is, a proof may need them narrow.
    if (!near && split < 0 && !settled_.empty()) split = choose(share, Sides::settled);
    if (!near && split < 0 && contractor_.regular()) split = choose(kFinestShare, Sides::open);
  }
  // What else cannot be divided waits, too: it may lie on a self-motion.
  if (split < 0 && !near && !problem_.tolerant) {
    near = LocalSolution{midpoint(x), problem_.compiled.equations()};
  }
  if (!contractor_.near_sheet()) return split;
  if (!contractor_.worth_proving()) dependent_ = contractor_.step()->dependent();
  // Where a proof is near, the solutions in x are a sheet over the free variables: cutting along those alone gives parts
  // whose sheets do not overlap.
  const int free = widest_free(x);
  const auto relative_width = [&](int j) { return x[j].width() / problem_.compiled.scales()[j]; };
  if (free >= 0 && split >= 0 && split_point(x[free]) &&
      relative_width(free) > problem_.heuristics.free_share * relative_width(split))
    return free;
  return split;
}

std::array<Waiting, 2> BoxProcessor::halves(Waiting box) const {
  const Interval side = box.x[split_variable_];
  const double at = split_at_ ? *split_at_ : *split_point(side);
  const double lower = split_at_ ? (at - side.lo()) / side.width() : kBisectionPoint;
  Waiting upper{box.x, box.share * (1 - lower), {}};
  upper.x[split_variable_] = Interval(at, side.hi());
  box.x[split_variable_] = Interval(side.lo(), at);
  return {Waiting{std::move(box.x), box.share * lower, {}}, std::move(upper)};
}

BoxProcessor::Outcome BoxProcessor::give_up(std::span<Interval> x, Reason reason) {
  split_at_.reset();
  find_settled(x);
  if (!settled_.empty() && !preconditioners_.over()) {
    if (!contractor_.run(x, shard_.statistics)) {
      if (recorder_) recorder_->leaf_empty();
      return Outcome::done;
    }
    const int split = problem_.branching.choose(problem_.compiled, x, limits(kSetShare, Sides::settled));
    if (split >= 0) {
      if (recorder_) recorder_->keep(x);
      split_variable_ = split;
      return Outcome::split;
    }
  }
  add_unproven(x, Verdict::undecided, reason);
  return Outcome::done;
}

int BoxProcessor::widest(std::span<const Interval> x, double share) const {
  const std::vector<double> finest = problem_.limits(share);
  std::vector<int> cuttable = all_but({}, problem_.compiled.variables());
  std::erase_if(cuttable, [&](int j) { return x[j].width() <= finest[j] || !split_point(x[j]); });
  return widest_of(cuttable, x);
}

BoxProcessor::Outcome BoxProcessor::process_in_tube(std::span<Interval> x, int stratum, double postpone, double share) {
  ++shard_.statistics.proofs_tried;
  Box box = copy_of(x);
  MotionProof proof = prove_on_stratum(problem_, problem_.strata[stratum].motion, stratum, box, workspace_);
  if (recorder_ && proof.sheet.proven) recorder_->newton(proof.step, x);
  if (recorder_) recorder_->keep(x);
  if (proof.sheet.proven) {
    shard_.sheets.push_back({std::move(box), std::move(proof.sheet), go_on_later()});
    return Outcome::done;
  }
  split_variable_ = widest(x, std::max(postpone, kTubeShare));
  if (split_variable_ >= 0) return Outcome::split;
  LocalSolution near{midpoint(x), problem_.compiled.equations() - 1};
  shard_.postponed.push_back({{std::move(box), share, go_on_later()}, std::move(near), false, {}, {}});
  return Outcome::postponed;
}

std::optional<BoxProcessor::Outcome> BoxProcessor::process_on_strata(std::span<Interval> x, double postpone, double share) {
  if (problem_.strata.empty()) return std::nullopt;
  const Box box = copy_of(x);
  for (std::size_t k = 0; k < problem_.strata.size(); ++k) {
    const TubePlace place = locate(problem_.strata[k], problem_.compiled, box);
    if (place.where == TubePlace::Where::inside) return process_in_tube(x, static_cast<int>(k), postpone, share);
    if (place.where == TubePlace::Where::outside || place.variable < 0) continue;
    if (recorder_) recorder_->keep(x);
    split_variable_ = place.variable;
    split_at_ = place.at;
    return Outcome::split;
  }
  return std::nullopt;
}

bool BoxProcessor::reaches_beyond(std::span<const Interval> x) const {
  return problem_.parts_of_sheets && relative_width(x) > kAcrossShare &&
         problem_.domain.locate_zeros(*contractor_.step(), x) != certify::Location::inside;
}

BoxProcessor::Outcome BoxProcessor::process(std::span<Interval> x, double postpone, double share) {
  ++shard_.statistics.processed;
  split_at_.reset();
  if (!contractor_.run(x, shard_.statistics)) {
    if (recorder_) recorder_->leaf_empty();
    return Outcome::done;
  }
  if (preconditioners_.over()) return Outcome::interrupted;
  if (contractor_.worth_proving() && !reaches_beyond(x) && certify(x, Proof::full)) return Outcome::done;
  if (const auto outcome = process_on_strata(x, postpone, share)) return *outcome;
  std::optional<LocalSolution> near;
  split_variable_ = choose_split(x, postpone, near);
  if (split_variable_ >= 0) {
    if (recorder_) recorder_->keep(x);
    return Outcome::split;
  }
  if (near) {
    if (recorder_) recorder_->keep(x);
    const bool noisy = contractor_.noisy() && relative_width(x) < kNoisySize;
    shard_.postponed.push_back({{copy_of(x), share, go_on_later()}, std::move(*near), noisy, {}, {}});
    return Outcome::postponed;
  }
  // At its final size: where equations may be redundant, the box gets its one chance of such a proof here, where its rank
  // shows.
  if (problem_.redundant.applies() && certify(x, Proof::partial)) return Outcome::done;
  add_unproven(x, Verdict::undecided, Reason::tolerance);
  return Outcome::done;
}

}  // namespace corank::solve
