// The passes of a search: all boxes are searched until they are empty, proven or postponed; those postponed next to
// degenerate solutions are judged together, divided further in the next pass, or given up; then all sheets are cut to σ.
#include "corank/solve/solve.h"

#include <algorithm>

#include "corank/core/rounding.h"
#include "corank/solve/assembly.h"
#include "corank/solve/pool.h"

namespace corank::solve {
namespace {

// Boxes that resist proof next to a degenerate solution wait until the others are done, first of this size, then of the
// next.
constexpr double kFirstShare = 1.0 / 20, kNextShare = 1.0 / 4;

Box domain_of(const System& system) {
  Box domain;
  for (const auto& v : system.variables) domain.push_back(v.domain);
  return domain;
}

// The boxes to search, in the variables that are kept, within the domain.
std::vector<Waiting> roots_of(const Prepared& prepared) {
  const certify::Reduction& reduction = prepared.reduction;
  std::vector<Waiting> roots;
  if (prepared.options.roots.empty()) roots.push_back({domain_of(reduction.system), 1, 0});
  for (const Box& given : prepared.options.roots) {
    Box root = domain_of(reduction.system);
    bool empty = false;
    for (std::size_t j = 0; j < root.size(); ++j)
      empty = empty || !root[j].intersect(given.at(static_cast<std::size_t>(reduction.kept[j])));
    if (!empty) roots.push_back({std::move(root), 0, roots.size()});
  }
  for (Waiting& root : roots) root.share = 1.0 / static_cast<double>(roots.size());
  return roots;
}

// What is to be searched further of the boxes that were postponed; the others are proven or given up.
std::vector<Waiting> judge_postponed(const Prepared& prepared, Pool& pool, Tally& tally, SelfMotions& motions,
                                     double share) {
  std::vector<Postponed> all = pool.take_postponed();
  const UpwardRounding rounding;
  std::vector<Reason> reasons = motions.prove(pool.problem(), prepared.reduction.system, all, share);
  if (tally.ended()) std::replace(reasons.begin(), reasons.end(), Reason::none, Reason::limit);
  std::vector<Waiting> open;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].proof.proven) {
      pool.add_proven(all[i]);
    } else if (reasons[i] == Reason::none) {
      open.push_back(std::move(all[i].box));
    } else {
      pool.give_up(all[i], reasons[i]);
    }
  }
  std::reverse(open.begin(), open.end());
  return open;
}

// The σ that is asked for, the others by default from the hull of a set.
Sigma chosen_sigma(const Prepared& prepared, const Box& hull, int dimension) {
  const Options& options = prepared.options;
  const Sigma by_default = default_sigma(prepared.system, hull, dimension);
  const auto coarser = [&](double sigma) { return dimension == 0 ? sigma : sigma * options.coarser; };
  return {options.asked_length().value_or(coarser(by_default.length)),
          options.asked_angle().value_or(coarser(by_default.angle))};
}

// What tolerances of coefficients move is no reason for narrower boxes, and such systems are searched by σ.
Sigma sigma_of_search(const Prepared& prepared, const Problem& problem) {
  const bool any_dimension = problem.tolerant && prepared.system.equations.size() > prepared.system.variables.size();
  return chosen_sigma(prepared, domain_of(prepared.system), any_dimension ? 1 : prepared.reduction.system.dimension());
}

// The hull of the sheets, in all variables; the domain where there is none.
Box hull_of(const Prepared& prepared, const Problem& problem, const std::vector<Shard*>& shards) {
  const UpwardRounding rounding;
  Box hull;
  for (const Shard* shard : shards)
    for (const Proven& proven : shard->sheets) {
      Box sides = proven.sheet.image;
      for (std::size_t j = 0; j < sides.size(); ++j) sides[j].intersect(proven.x[j]);
      problem.append_values(sides);
      for (std::size_t j = 0; j < hull.size(); ++j) hull[j] = Interval::hull(hull[j], sides[j]);
      if (hull.empty()) hull = std::move(sides);
    }
  return hull.empty() ? domain_of(prepared.system) : prepared.reduction.lift(hull);
}

// Of the sets found: self-motions are larger than expected.
int largest_dimension(int dimension, const std::vector<Shard*>& shards) {
  for (const Shard* shard : shards)
    for (const Proven& proven : shard->sheets)
      dimension = std::max(dimension, static_cast<int>(proven.sheet.region.size() - proven.sheet.dependent.size()));
  return dimension;
}

}  // namespace

double printed_tolerance(const System& system) {
  constexpr double kPrintedDecimals = 1e-6;
  return system.equations.size() > system.variables.size() ? kPrintedDecimals : 0;
}

Cover solve(const System& system, const Options& options) {
  Control control(limits_of(options));
  return solve(prepare(system, options, control), control);
}

Cover solve(const Prepared& prepared, Control& control, std::uint64_t most) {
  Tally tally(prepared, control, most);
  Pool pool(prepared, tally);
  SelfMotions motions;
  const std::vector<Waiting> roots = roots_of(prepared);
  Sigma sigma = sigma_of_search(prepared, pool.problem());
  pool.set_sigma(sigma);
  if (prepared.reduction.consistent) {
    const InStage stage(control, Stage::search);
    Work work{roots, kFirstShare};
    for (; !work.boxes.empty(); work.postpone *= kNextShare) {
      pool.search(work);
      work.boxes = judge_postponed(prepared, pool, tally, motions, work.postpone);
    }
    const std::vector<Shard*> shards = pool.shards();
    if (!pool.problem().tolerant)
      sigma = chosen_sigma(prepared, hull_of(prepared, pool.problem(), shards),
                           largest_dimension(prepared.reduction.system.dimension(), shards));
    pool.set_sigma(sigma);
    pool.cut(shards);
  }
  Cover cover;
  pool.execute([&] { cover = assemble(prepared, pool.problem(), pool.shards(), roots, motions, sigma, control); });
  cover.statistics.seconds_certify /= pool.threads();
  cover.statistics.seconds_total = tally.seconds();
  cover.statistics.seconds_search = cover.statistics.seconds_total - cover.statistics.seconds_certify;
  tally.report(true);
  return cover;
}

}  // namespace corank::solve
