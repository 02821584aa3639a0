#include "corank/solve/step/points.h"

#include <algorithm>
#include <functional>
#include <numeric>

#include "corank/certify/distinct.h"
#include "corank/core/box.h"
#include "corank/core/box_tree.h"
#include "corank/solve/step/heuristics.h"

namespace corank::solve {
namespace {

bool is_proven(const Found& f) { return f.sheet != nullptr; }

template <class Choose>
std::vector<std::size_t> indices(const std::vector<Found*>& found, Choose choose) {
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < found.size(); ++i)
    if (choose(*found[i])) result.push_back(i);
  return result;
}

const Box& box_of(const Found* found) { return found->box.box; }

// The solutions of `from`, if it has any, are in `to`.
void take_leaves(Found& to, const Found& from) { to.leaves.insert(to.leaves.end(), from.leaves.begin(), from.leaves.end()); }

constexpr std::size_t kBetweenChecks = 64;

}  // namespace

void merge_isolated(std::vector<Found*>& found, const Ended& ended) {
  std::vector<bool> remove(found.size(), false);
  std::vector<Reason> unclear(found.size(), Reason::none);
  const auto absorb = [&](std::size_t i, std::size_t j) {
    remove[j] = true;
    take_leaves(*found[i], *found[j]);
  };
  const auto compare = [&](std::size_t i, std::size_t j) {
    if (i == j || remove[i] || remove[j]) return;
    if (!is_proven(*found[j])) {
      if (certify::holds_nothing_else(*found[i]->sheet, found[j]->box.box)) absorb(i, j);
    } else if (i < j) {
      switch (certify::compare_isolated(*found[i]->sheet, *found[j]->sheet)) {
        case certify::Identity::same: absorb(i, j); break;
        case certify::Identity::different: break;
        case certify::Identity::unknown: unclear[i] = unclear[j] = Reason::precision; break;
      }
    }
  };
  const auto proven = indices(found, is_proven);
  const BoxTree tree = proven.empty() ? BoxTree({}, 0) : box_tree(found, box_of);
  std::vector<std::size_t> close;
  bool over = false;
  for (std::size_t k = 0; k < proven.size(); ++k) {
    over = over || (k % kBetweenChecks == 0 && is_over(ended));
    if (over) {  // nothing is known of the pairs of those that are left
      unclear[proven[k]] = Reason::limit;
      continue;
    }
    close.clear();
    tree.for_each_overlapping(found[proven[k]]->box.box, 0.0, [&](std::size_t j) { close.push_back(j); });
    std::ranges::sort(close);
    for (const std::size_t j : close) compare(proven[k], j);
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (remove[i]) continue;
    if (unclear[i] != Reason::none) {
      found[i]->box.verdict = Verdict::undecided;
      found[i]->box.reason = unclear[i];
      found[i]->sheet = nullptr;
      found[i]->region = nullptr;
    }
    found[kept++] = found[i];
  }
  found.resize(kept);
}

std::vector<std::vector<std::size_t>> clusters(const std::vector<const Box*>& boxes, const std::vector<double>& gaps,
                                               const Ended& ended) {
  std::vector<Box> widened(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (std::size_t j = 0; j < gaps.size(); ++j)
      widened[i].push_back((*boxes[i])[j] + Interval(-0.5 * gaps[j], 0.5 * gaps[j]));
  const std::vector<std::size_t> group = box_tree(widened, std::identity()).groups(0, ended);
  std::vector<std::vector<std::size_t>> result;
  for (std::size_t i = 0; i < group.size(); ++i) {
    if (group[i] == result.size()) result.emplace_back();
    result[group[i]].push_back(i);
  }
  return result;
}

void merge_degenerate(const Problem& problem, std::vector<Found*>& found, double gap, const Ended& ended) {
  const auto degenerate = indices(found, [](const Found& f) { return f.box.reason == Reason::degenerate_point; });
  std::vector<const Box*> sides;
  for (const std::size_t i : degenerate) sides.push_back(&found[i]->box.box);
  for (const std::vector<std::size_t>& cluster : clusters(sides, problem.limits(gap), ended)) {
    Box hull = *sides[cluster[0]];
    for (const std::size_t k : cluster) include(hull, *sides[k]);
    if (problem.relative_width(hull) > kIsolatedHull * gap) continue;
    Found& first = *found[degenerate[cluster[0]]];
    first.box.box = std::move(hull);
    for (const std::size_t k : cluster) {
      Found*& other = found[degenerate[k]];
      if (other == &first) continue;
      take_leaves(first, *other);
      other = nullptr;
    }
  }
  std::erase(found, nullptr);
}

std::vector<CoverBox> collect_points(const std::vector<Found*>& found, const std::vector<double>& gaps, const Ended& ended,
                                     std::size_t parameters) {
  const auto along_a_set = [parameters](const Found& f) {
    return f.box.free.size() > parameters || f.box.reason == Reason::degenerate_set || f.box.verdict == Verdict::pending;
  };
  const auto open = indices(found, [&](const Found& f) { return !is_proven(f) && !along_a_set(f); });
  std::vector<const Box*> open_sides;
  for (const std::size_t i : open) open_sides.push_back(&found[i]->box.box);
  std::vector<bool> joined(found.size(), false);
  std::vector<Box> hulls(found.size());  // of clusters, where their first box stands
  std::vector<std::vector<std::size_t>> groups = clusters(open_sides, gaps, ended);
  if (is_over(ended) && !open.empty()) {  // the groups are pieces of clusters: hardly a box each
    groups.assign(1, std::vector<std::size_t>(open.size()));
    std::iota(groups[0].begin(), groups[0].end(), std::size_t{0});
  }
  for (const std::vector<std::size_t>& cluster : groups) {
    Box& hull = hulls[open[cluster[0]]];
    hull = *open_sides[cluster[0]];
    for (std::size_t k = 1; k < cluster.size(); ++k) {
      joined[open[cluster[k]]] = true;
      include(hull, *open_sides[cluster[k]]);
    }
  }
  std::vector<CoverBox> points;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (along_a_set(*found[i]) || joined[i]) continue;
    points.push_back(found[i]->box);
    if (!hulls[i].empty()) points.back().box = std::move(hulls[i]);
  }
  return points;
}

}  // namespace corank::solve
