#include "corank/solve/points.h"

#include <algorithm>
#include <numeric>

#include "corank/certify/distinct.h"

namespace corank::solve {
namespace {

using certify::Interval;
using certify::Verdict;

bool is_proven(const Found& f) { return f.sheet.proven; }

// Disjoint sets of box indices.
class Clusters {
 public:
  explicit Clusters(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }
  std::size_t root(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::size_t i, std::size_t j) { parent_[std::max(root(i), root(j))] = std::min(root(i), root(j)); }

 private:
  std::vector<std::size_t> parent_;
};

// Calls visit(i, j) for every pair whose sides overlap when widened by gap; sorted along the first variable.
template <class Visit>
void for_each_close_pair(const std::vector<const std::vector<Interval>*>& boxes, double gap, Visit visit) {
  std::vector<std::size_t> order(boxes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return (*boxes[a])[0].lo() < (*boxes[b])[0].lo(); });
  for (std::size_t s = 0; s < order.size(); ++s) {
    const auto& a = *boxes[order[s]];
    for (std::size_t t = s + 1; t < order.size(); ++t) {
      const auto& b = *boxes[order[t]];
      if (b[0].lo() > a[0].hi() + gap) break;
      bool close = true;
      for (std::size_t j = 0; j < a.size() && close; ++j)
        close = a[j].lo() <= b[j].hi() + gap && b[j].lo() <= a[j].hi() + gap;
      if (close) visit(std::min(order[s], order[t]), std::max(order[s], order[t]));
    }
  }
}

std::vector<const std::vector<Interval>*> sides(const std::vector<Found>& found) {
  std::vector<const std::vector<Interval>*> result;
  for (const Found& f : found) result.push_back(&f.box.box);
  return result;
}

}  // namespace

void merge_isolated(std::vector<Found>& found) {
  std::vector<bool> remove(found.size(), false), unclear(found.size(), false);
  for_each_close_pair(sides(found), 0.0, [&](std::size_t i, std::size_t j) {
    if (remove[i] || remove[j]) return;
    if (is_proven(found[i]) && is_proven(found[j])) {
      switch (certify::compare_isolated(found[i].sheet, found[j].sheet)) {
        case certify::Identity::same: remove[j] = true; break;
        case certify::Identity::different: break;
        case certify::Identity::unknown: unclear[i] = unclear[j] = true; break;
      }
    } else if (is_proven(found[i]) != is_proven(found[j])) {
      const std::size_t proven = is_proven(found[i]) ? i : j, other = is_proven(found[i]) ? j : i;
      if (certify::holds_nothing_else(found[proven].sheet, found[other].box.box.data())) remove[other] = true;
    }
  });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (remove[i]) continue;
    if (unclear[i]) {
      found[i].box.verdict = Verdict::undecided;
      found[i].sheet = {};
    }
    if (kept != i) found[kept] = std::move(found[i]);
    ++kept;
  }
  found.resize(kept);
}

std::vector<certify::CoverBox> collect_points(const std::vector<Found>& found, double gap) {
  Clusters clusters(found.size());
  for_each_close_pair(sides(found), gap, [&](std::size_t i, std::size_t j) {
    if (!is_proven(found[i]) && !is_proven(found[j])) clusters.join(i, j);
  });
  std::vector<certify::CoverBox> points;
  std::vector<std::size_t> point_of(found.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    const std::size_t root = clusters.root(i);
    if (root == i) {
      point_of[i] = points.size();
      points.push_back(found[i].box);
      continue;
    }
    auto& hull = points[point_of[root]].box;
    for (std::size_t j = 0; j < hull.size(); ++j) hull[j] = Interval::hull(hull[j], found[i].box.box[j]);
  }
  return points;
}

}  // namespace corank::solve
