#include "corank/solve/search/passes.h"

#include <algorithm>
#include <utility>

#include "corank/core/box.h"
#include "corank/core/rounding.h"
#include "corank/solve/step/box_order.h"
#include "corank/solve/step/heuristics.h"

namespace corank::solve {
namespace {

// The hull of the sheets, in all variables; the domain where there is none.
Box hull_of(const Prepared& prepared, const Problem& problem, const std::vector<Shard*>& shards) {
  const UpwardRounding rounding;
  Box hull;
  for (const Shard* shard : shards)
    for (const Proven& proven : shard->sheets) {
      Box sides = proven.sheet.image;
      for (std::size_t j = 0; j < sides.size(); ++j) sides[j].intersect(proven.x[j]);
      problem.append_values(sides);
      include(hull, sides);
      if (hull.empty()) hull = std::move(sides);
    }
  return hull.empty() ? prepared.system.domain() : prepared.reduction.lift(hull);
}

// Of the sets found: self-motions are larger than expected.
int largest_dimension(const System& system, const std::vector<Shard*>& shards) {
  int dimension = system.dimension();
  for (const Shard* shard : shards)
    for (const Proven& proven : shard->sheets) {
      const auto free = proven.sheet.region.size() - proven.sheet.dependent.size();
      dimension = std::max(dimension, static_cast<int>(free) - system.parameters());
    }
  return dimension;
}

}  // namespace

Sigma chosen_sigma(const Options& options, const System& system, const Box& hull, int dimension) {
  const Sigma by_default = default_sigma(system, hull, dimension);
  const auto coarser = [&](double sigma) { return dimension == 0 ? sigma : sigma * options.coarser; };
  return {options.asked_length().value_or(coarser(by_default.length)),
          options.asked_angle().value_or(coarser(by_default.angle))};
}

Work first_pass(const Prepared& prepared) {
  if (!prepared.options.roots.empty()) return pass_over(prepared.reduction, prepared.options.roots);
  return {{{prepared.reduction.system.domain(), 1, {}}}, kFirstShare};
}

Work pass_over(const certify::Reduction& reduction, const std::vector<Box>& boxes) {
  std::vector<Waiting> roots;
  for (const Box& given : boxes) {
    Box root = reduction.system.domain();
    bool empty = false;
    for (std::size_t j = 0; j < root.size(); ++j) empty = empty || !root[j].intersect(given.at(reduction.kept[j]));
    if (!empty) roots.push_back({std::move(root), 0, {.place = roots.size()}});
  }
  for (Waiting& root : roots) root.share = 1.0 / static_cast<double>(roots.size());
  return {std::move(roots), kFirstShare};
}

Work next_pass(const Prepared& prepared, const Work& pass, std::vector<Postponed> all, Pool& pool, SelfMotions& motions) {
  std::ranges::sort(all, [](const Postponed& a, const Postponed& b) { return before(a.box.x, b.box.x); });
  const UpwardRounding rounding;
  std::vector<Reason> reasons = motions.prove(pool.problem(), prepared.reduction.system, all, pass.postpone);
  if (pool.ended()) std::ranges::replace(reasons, Reason::none, Reason::limit);
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
  std::ranges::reverse(open);
  return {std::move(open), kNextShare * pass.postpone};
}

Sigma sigma_of_search(const Prepared& prepared, const Problem& problem) {
  if (problem.parts_of_sheets && prepared.options.leaves_whole()) return {kWhole, kWhole};
  const bool any_dimension = problem.tolerant && prepared.system.equations.size() > prepared.system.variables.size();
  return chosen_sigma(prepared.options, prepared.system, prepared.system.domain(),
                      any_dimension ? 1 : prepared.reduction.system.dimension());
}

Sigma sigma_of_set(const Prepared& prepared, const Problem& problem, const std::vector<Shard*>& shards) {
  const Options& options = prepared.options;
  const int dimension = largest_dimension(prepared.reduction.system, shards);
  if (options.leaves_whole() && dimension > 1) return {kWhole, kWhole};
  return chosen_sigma(options, prepared.system, hull_of(prepared, problem, shards), dimension);
}

}  // namespace corank::solve
