#include "corank/solve/store/degeneracy.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>
#include <utility>

#include "corank/certify/polynomial_algebra.h"
#include "corank/core/box.h"
#include "corank/core/rounding.h"
#include "corank/solve/step/heuristics.h"
#include "corank/solve/step/points.h"
#include "corank/solve/store/strata.h"

namespace corank::solve {
namespace {

// Is every equation's zero, linearized, close to x? Where equations are badly scaled, small residuals say little.
bool may_be_solution(const Problem& problem, const std::vector<double>& x) {
  const UpwardRounding rounding;
  const certify::CompiledSystem& system = problem.compiled;
  std::vector<double> jacobian(system.entries());
  system.approximate_jacobian(x.data(), jacobian.data());
  for (int row = 0; row < system.equations(); ++row) {
    const Interval value = system.evaluate_at(row, x.data());
    double slope = 0;
    for (int k = system.row_begin(row); k < system.row_begin(row + 1); ++k)
      slope += std::fabs(jacobian[k]) * system.scales()[system.column(k)];
    if (value.mig() > kCloseShare * slope) return false;
  }
  return true;
}

// Is there another degenerate solution a step away from this one, in some direction in which solutions may go on?
bool goes_on(const Problem& problem, const LocalSolution& start, double step, std::mt19937& random) {
  const auto& system = problem.compiled;
  const auto exact = local_solution(problem, start.x, kSolutionTolerance);
  const int full = std::min(system.equations(), system.unknowns());
  if (!exact || exact->rank >= full || breaks_inequality(problem, exact->x, step)) return false;
  const std::vector<double> basis = kernel_basis(problem, *exact, 100 * kSolutionTolerance);
  const std::size_t n = system.variables(), k = basis.size() / n;
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < kDirections; ++trial) {
    std::vector<double> direction(n, 0.0), weights(k);
    double length = 0;
    for (double& w : weights) w = normal(random), length += w * w;
    if (length == 0) return false;
    LocalSolution there = *exact;
    for (std::size_t j = 0; j < n; ++j) {
      for (std::size_t c = 0; c < k; ++c) direction[j] += weights[c] / std::sqrt(length) * basis[j * k + c];
      there.x[j] += step * direction[j] * system.scales()[j];
    }
    const auto next = local_solution(problem, there.x, kSolutionTolerance);
    if (!next || next->rank >= full || !may_be_solution(problem, next->x)) continue;
    double moved = 0;
    for (std::size_t j = 0; j < n; ++j) moved = std::max(moved, std::fabs(next->x[j] - exact->x[j]) / system.scales()[j]);
    if (moved > 0.2 * step && moved < 5 * step) return true;
  }
  return false;
}

// Of the typical sizes: how far the cluster reaches.
double extent(const Problem& problem, const std::vector<Postponed>& boxes, const std::vector<std::size_t>& cluster) {
  Box hull = boxes[cluster[0]].box.x;
  for (const std::size_t i : cluster) include(hull, boxes[i].box.x);
  return problem.relative_width(hull);
}

bool is_along_a_set(const Problem& problem, const std::vector<Postponed>& boxes, const std::vector<std::size_t>& cluster,
                    double share) {
  // Surfaces meet each other and themselves along curves, curves do so at points. Around a point small boxes reach about
  // √share.
  if (problem.has_surfaces() && share < kSetShare && extent(problem, boxes, cluster) > kWideExtent) return true;
  std::mt19937 random(1);
  const std::size_t probes = std::min(kProbes, cluster.size());
  std::size_t along = 0;
  for (std::size_t k = 0; k < probes; ++k)
    along += goes_on(problem, boxes[cluster[k * cluster.size() / probes]].near, kProbeStep * share, random);
  return 2 * along >= probes;
}

// Does no relation exclude the box?
bool may_hold_in(const certify::SelfMotion& motion, const Box& x) {
  const UpwardRounding rounding;
  return std::ranges::all_of(motion.relations, [&](const Polynomial& f) { return certify::evaluate(f, x).contains(0.0); });
}

}  // namespace

void SelfMotions::begin(const Problem& problem) {
  if (!known_.empty()) return;
  known_ = problem.strata;
  for (const Stratum& stratum : known_)
    if (stratum.dimension > problem.compiled.unknowns() - problem.compiled.equations())
      observed_ = std::max(observed_, stratum.dimension);
}

void SelfMotions::prove_on(std::size_t index, const Problem& problem, Postponed& box) {
  certify::NewtonWorkspace workspace;
  auto [sheet, step] = prove_on_stratum(problem, known_[index].motion, static_cast<int>(index), box.box.x, workspace);
  box.proof = std::move(sheet);
  box.step = std::move(step);
}

bool SelfMotions::prove_on_known(const Problem& problem, Postponed& box) {
  bool known = false;
  std::optional<LocalSolution> precise;  // where `near` is not
  for (std::size_t k = 0; k < known_.size() && !box.proof.proven; ++k) {
    const auto& motion = known_[k].motion;
    known = known || holds_at(motion, problem, box.near.x);
    if (!known && !precise) precise = local_solution(problem, box.near.x, kSolutionTolerance);
    known = known || (precise && holds_at(motion, problem, precise->x));
    if (may_hold_in(motion, box.box.x)) prove_on(k, problem, box);
  }
  return known || box.proof.proven;
}

void SelfMotions::prove_cluster(const Problem& problem, const System& system, std::vector<Postponed>& boxes,
                                const std::vector<std::size_t>& cluster, double share) {
  std::mt19937 random(1);
  int attempts = 0;
  for (const std::size_t i : cluster) {
    Postponed& box = boxes[i];
    if (problem.ended()) return;
    if (prove_on_known(problem, box) || attempts >= kMotionAttempts ||
        !goes_on(problem, box.near, kProbeStep * share, random))
      continue;
    ++attempts;
    MotionCandidate candidate = find_self_motion(problem, system, box.near);
    const int expected = std::max(0, problem.compiled.unknowns() - problem.compiled.equations());
    if (candidate.dimension > expected) observed_ = std::max(observed_, candidate.dimension);
    if (!candidate.motion) continue;
    const auto same = std::ranges::find_if(
        known_, [&](const Stratum& other) { return certify::same_relations(other.motion, *candidate.motion); });
    const std::size_t index = same - known_.begin();
    if (same == known_.end()) {
      known_.push_back({std::move(*candidate.motion), candidate.dimension});
      attempts = 0;
    }
    prove_on(index, problem, box);
  }
}

std::vector<Reason> SelfMotions::prove(const Problem& problem, const System& system, std::vector<Postponed>& boxes,
                                       double share) {
  std::vector<Reason> reasons(boxes.size(), Reason::none);
  std::vector<const Box*> sides;
  for (const Postponed& box : boxes) sides.push_back(&box.box.x);
  const double last = system.dimension() == 0 ? kPointShare : kOtherShare;
  const std::size_t former = std::exchange(former_, boxes.size());
  for (const std::vector<std::size_t>& cluster : clusters(sides, problem.limits(1e-3 * share), problem.ended)) {
    if (problem.ended()) break;  // the search takes what is left back
    Reason reason = share < last ? Reason::degenerate_point : Reason::none;
    if (extent(problem, boxes, cluster) > kIsolatedHull * share) {  // more than one point
      reason = Reason::none;
      const bool along = is_along_a_set(problem, boxes, cluster, share);
      if (along && problem.compiled.parameters().empty()) prove_cluster(problem, system, boxes, cluster, share);
      const auto open =
          static_cast<std::size_t>(std::ranges::count_if(cluster, [&](std::size_t i) { return !boxes[i].proof.proven; }));
      // Boxes that touch over so many of their sizes: along a set, as far as it pays to look. What self-motions leave around
      // a few places may be divided on.
      const std::size_t many =
          along ? kManyAlongASet : std::max(kTooManyBoxes, former > 0 ? kGrowth * former : boxes.size());
      // Around a surface these places are curves, where each size has twice as many boxes, and the surface is proven in four
      // times as many.
      const bool surface = std::ranges::any_of(
          cluster, [&](std::size_t i) { return boxes[i].proof.proven && known_[boxes[i].proof.motion].dimension > 1; });
      if (share < (along ? kSetShare : last) || (open > many && (surface || 2 * open > cluster.size())))
        reason = Reason::degenerate_set;
    }
    for (const std::size_t i : cluster) {
      const bool on_known = !boxes[i].proof.proven && prove_on_known(problem, boxes[i]);
      const bool at_doubles_end = problem.relative_width(boxes[i].box.x) < kDoublesEnd || boxes[i].noisy;
      reasons[i] = reason == Reason::none && at_doubles_end ? Reason::precision : reason;
      if (reasons[i] != Reason::none && on_known) reasons[i] = Reason::degenerate_set;  // it is no point
    }
  }
  return reasons;
}

SelfMotions::Stored SelfMotions::stored() const {
  Stored result{{}, observed_, former_};
  for (const Stratum& known : known_) result.motions.push_back({known.dimension, known.motion.relations});
  return result;
}

SelfMotions SelfMotions::restored(const System& system, Stored stored) {
  const UpwardRounding rounding;
  SelfMotions result;
  result.observed_ = stored.observed;
  result.former_ = stored.former;
  for (SelfMotionRecord& record : stored.motions) {
    auto motion = certify::self_motion(system, std::move(record.relations), record.dimension);
    if (!motion) throw std::invalid_argument("the relations of a self-motion do not belong to this system");
    result.known_.push_back({std::move(*motion), record.dimension});
  }
  return result;
}

std::vector<SelfMotionRecord> SelfMotions::records(const certify::Reduction& reduction) const {
  std::vector<SelfMotionRecord> result;
  for (const Stratum& known : known_) {
    result.push_back({known.dimension, known.motion.relations});
    for (Polynomial& f : result.back().relations)
      for (Monomial& m : f.monomials)
        for (Factor& factor : m.factors) factor.variable = reduction.kept[factor.variable];
  }
  return result;
}

}  // namespace corank::solve
