#include "corank/solve/points.h"

#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>
#include <cmath>
#include <numeric>

#include "corank/certify/distinct.h"

namespace corank::solve {
namespace {

using certify::Interval;
using certify::Verdict;

bool is_proven(const Found& f) { return f.sheet != nullptr; }

// Calls visit(i, j) for every pair i in first, j in second (i ≠ j) whose first sides overlap when widened by their gaps, one for each side.
// Sweeps along the variable that spreads the boxes most.
template <class Visit>
void for_each_close_pair(const std::vector<const std::vector<Interval>*>& boxes, const std::vector<std::size_t>& first,
                         const std::vector<std::size_t>& second, const std::vector<double>& gaps, Visit visit) {
  if (first.empty() || second.empty() || boxes[second[0]]->empty()) return;
  std::size_t along = 0;
  double best = -1;
  for (std::size_t j = 0; j < gaps.size(); ++j) {
    double least = HUGE_VAL, greatest = -HUGE_VAL, width = 0;
    for (std::size_t i : second) {
      least = std::min(least, (*boxes[i])[j].lo());
      greatest = std::max(greatest, (*boxes[i])[j].lo());
      width = std::max(width, (*boxes[i])[j].width());
    }
    const double spread = (greatest - least) / (width + gaps[j] + 1e-300);
    if (spread > best) best = spread, along = j;
  }
  std::vector<std::size_t> order(second);
  const auto lower_end = [&](std::size_t i) { return (*boxes[i])[along].lo(); };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return lower_end(a) < lower_end(b); });
  double width = 0;
  for (std::size_t i : order) width = std::max(width, (*boxes[i])[along].width());
  for (std::size_t i : first) {
    const auto& a = *boxes[i];
    const double from = a[along].lo() - width - gaps[along], to = a[along].hi() + gaps[along];
    auto at = std::lower_bound(order.begin(), order.end(), from,
                               [&](std::size_t k, double value) { return lower_end(k) < value; });
    for (; at != order.end() && lower_end(*at) <= to; ++at) {
      if (*at == i) continue;
      const auto& b = *boxes[*at];
      bool close = true;
      for (std::size_t j = 0; j < gaps.size() && close; ++j)
        close = a[j].lo() <= b[j].hi() + gaps[j] && b[j].lo() <= a[j].hi() + gaps[j];
      if (close) visit(i, *at);
    }
  }
}

template <class Choose>
std::vector<std::size_t> indices(const std::vector<Found*>& found, Choose choose) {
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < found.size(); ++i)
    if (choose(*found[i])) result.push_back(i);
  return result;
}

std::vector<const std::vector<Interval>*> sides(const std::vector<Found*>& found) {
  std::vector<const std::vector<Interval>*> result;
  for (const Found* f : found) result.push_back(&f->box.box);
  return result;
}

}  // namespace

void merge_isolated(std::vector<Found*>& found) {
  std::vector<bool> remove(found.size(), false), unclear(found.size(), false);
  const auto proven = indices(found, is_proven);
  const auto all = indices(found, [](const Found&) { return true; });
  const auto absorb = [&](std::size_t i, std::size_t j) {  // box j's solutions, if it has any, are in box i
    remove[j] = true;
    found[i]->leaves.insert(found[i]->leaves.end(), found[j]->leaves.begin(), found[j]->leaves.end());
  };
  const std::vector<double> gaps(found.empty() ? 0 : found[0]->box.box.size(), 0.0);
  for_each_close_pair(sides(found), proven, all, gaps, [&](std::size_t i, std::size_t j) {
    if (remove[i] || remove[j]) return;
    if (!is_proven(*found[j])) {
      if (certify::holds_nothing_else(*found[i]->sheet, found[j]->box.box.data())) absorb(i, j);
    } else if (i < j) {
      switch (certify::compare_isolated(*found[i]->sheet, *found[j]->sheet)) {
        case certify::Identity::same: absorb(i, j); break;
        case certify::Identity::different: break;
        case certify::Identity::unknown: unclear[i] = unclear[j] = true; break;
      }
    }
  });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (remove[i]) continue;
    if (unclear[i]) {
      found[i]->box.verdict = Verdict::undecided;
      found[i]->sheet = nullptr;
      found[i]->region = nullptr;
    }
    found[kept++] = found[i];
  }
  found.resize(kept);
}

std::vector<std::vector<std::size_t>> clusters(const std::vector<const certify::Box*>& boxes,
                                               const std::vector<double>& gaps) {
  boost::disjoint_sets_with_storage<> sets(boxes.size());
  std::vector<std::size_t> all(boxes.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  for_each_close_pair(boxes, all, all, gaps, [&](std::size_t i, std::size_t j) { sets.union_set(i, j); });
  std::vector<std::vector<std::size_t>> result;
  std::vector<std::size_t> place(boxes.size(), boxes.size());  // of each set in the result
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    std::size_t& at = place[sets.find_set(i)];
    if (at == boxes.size()) {
      at = result.size();
      result.emplace_back();
    }
    result[at].push_back(i);
  }
  return result;
}

std::vector<certify::CoverBox> collect_points(const std::vector<Found*>& found, const std::vector<double>& gaps) {
  const auto along_a_set = [](const Found& f) {
    return !f.box.free.empty() || f.box.reason == certify::Reason::degenerate_set || f.box.verdict == Verdict::pending;
  };
  const auto open = indices(found, [&](const Found& f) { return !is_proven(f) && !along_a_set(f); });
  std::vector<const certify::Box*> open_sides;
  for (const std::size_t i : open) open_sides.push_back(&found[i]->box.box);
  std::vector<bool> joined(found.size(), false);
  std::vector<certify::Box> hulls(found.size());  // of clusters, where their first box stands
  for (const std::vector<std::size_t>& cluster : clusters(open_sides, gaps)) {
    certify::Box& hull = hulls[open[cluster[0]]];
    hull = *open_sides[cluster[0]];
    for (std::size_t k = 1; k < cluster.size(); ++k) {
      joined[open[cluster[k]]] = true;
      for (std::size_t j = 0; j < hull.size(); ++j) hull[j] = Interval::hull(hull[j], (*open_sides[cluster[k]])[j]);
    }
  }
  std::vector<certify::CoverBox> points;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (along_a_set(*found[i]) || joined[i]) continue;
    points.push_back(found[i]->box);
    if (!hulls[i].empty()) points.back().box = std::move(hulls[i]);
  }
  return points;
}

}  // namespace corank::solve
