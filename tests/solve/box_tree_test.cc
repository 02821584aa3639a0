// Which boxes overlap, and which hang together: compared with every pair.
#include "corank/core/box_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "corank/solve/step/points.h"

namespace corank::solve {
namespace {

std::vector<Box> random_boxes(std::size_t count, std::size_t sides, double widest, std::mt19937& random) {
  std::uniform_real_distribution<double> place(-1, 1), width(0, widest);
  std::vector<Box> boxes(count);
  for (Box& box : boxes)
    for (std::size_t j = 0; j < sides; ++j) {
      const double at = place(random);
      box.push_back(Interval(at, at + width(random)));
    }
  // Some large ones, some equal ones, some that touch.
  for (std::size_t i = 0; i + 3 < count; i += 50) {
    for (Interval& side : boxes[i]) side = Interval(side.lo(), side.lo() + 0.7);
    boxes[i + 1] = boxes[i + 2];
    boxes[i + 3] = boxes[i + 2];
    boxes[i + 3][0] = Interval(boxes[i + 2][0].hi(), boxes[i + 2][0].hi() + widest);
  }
  return boxes;
}

std::vector<const Box*> pointers(const std::vector<Box>& boxes) {
  std::vector<const Box*> result;
  for (const Box& box : boxes) result.push_back(&box);
  return result;
}

bool close(const Box& a, const Box& b, double gap) {
  for (std::size_t j = 0; j < a.size(); ++j)
    if (a[j].lo() > b[j].hi() + gap || b[j].lo() > a[j].hi() + gap) return false;
  return true;
}

// By every pair: the least index that a box hangs together with.
std::vector<std::size_t> groups_by_pairs(const std::vector<Box>& boxes, double gap) {
  std::vector<std::size_t> first(boxes.size());
  for (std::size_t i = 0; i < first.size(); ++i) first[i] = i;
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t i = 0; i < boxes.size(); ++i)
      for (std::size_t j = 0; j < boxes.size(); ++j)
        if (first[j] < first[i] && close(boxes[i], boxes[j], gap)) first[i] = first[j], changed = true;
  }
  std::vector<std::size_t> numbers(boxes.size()), seen;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const auto at = std::find(seen.begin(), seen.end(), first[i]);
    numbers[i] = static_cast<std::size_t>(at - seen.begin());
    if (at == seen.end()) seen.push_back(first[i]);
  }
  return numbers;
}

TEST(BoxTree, FindsWhatEveryPairShows) {
  std::mt19937 random(5);
  for (const auto& [count, sides, widest] : std::vector<std::tuple<std::size_t, std::size_t, double>>{
           {0, 2, 0.1}, {1, 1, 0.1}, {9, 3, 0.5}, {300, 1, 0.001}, {400, 2, 0.02}, {400, 3, 0.05}, {200, 6, 0.4}}) {
    const std::vector<Box> boxes = random_boxes(count, sides, widest, random);
    const BoxTree tree(pointers(boxes), sides);
    GrowingBoxTree growing(sides);
    for (const Box& box : boxes) growing.add(box);
    for (const double gap : {0.0, 0.03}) {
      for (std::size_t i = 0; i < boxes.size(); ++i) {
        std::vector<std::size_t> expected, found, grown;
        for (std::size_t j = 0; j < boxes.size(); ++j)
          if (close(boxes[i], boxes[j], gap)) expected.push_back(j);
        tree.for_each_overlapping(boxes[i], gap, [&](std::size_t j) { found.push_back(j); });
        std::sort(found.begin(), found.end());
        EXPECT_EQ(found, expected);
        if (gap > 0) continue;
        growing.for_each_overlapping(boxes[i], [&](std::size_t j) { grown.push_back(j); });
        std::sort(grown.begin(), grown.end());
        EXPECT_EQ(grown, expected);
      }
      EXPECT_EQ(tree.groups(gap, {}), groups_by_pairs(boxes, gap));
    }
  }
}

TEST(BoxTree, JoinsBoxesThatAllOverlapWithFewQuestions) {
  // 20,000 boxes through one point have 2·10⁸ overlapping pairs.
  std::mt19937 random(7);
  std::uniform_real_distribution<double> reach(0.1, 1);
  std::vector<Box> boxes;
  for (int i = 0; i < 20'000; ++i)
    boxes.push_back({Interval(-reach(random), reach(random)), Interval(-reach(random), reach(random))});
  const std::vector<std::size_t> groups = BoxTree(pointers(boxes), 2).groups(0, {});
  EXPECT_EQ(std::count(groups.begin(), groups.end(), 0u), 20'000);
}

TEST(Clusters, AreInTheOrderOfTheirFirstBoxes) {
  const std::vector<Box> boxes{{Interval(5, 6)}, {Interval(0, 1)}, {Interval(6, 7)}, {Interval(1.5, 2)}, {Interval(1, 1.2)}};
  EXPECT_EQ(clusters(pointers(boxes), {0.0}), (std::vector<std::vector<std::size_t>>{{0, 2}, {1, 4}, {3}}));
  EXPECT_EQ(clusters(pointers(boxes), {0.4}), (std::vector<std::vector<std::size_t>>{{0, 2}, {1, 3, 4}}));
}

TEST(Clusters, ArePartsOfThemselvesWhereTheRunHasEnded) {
  const std::vector<Box> boxes{{Interval(0, 1)}, {Interval(1, 2)}};
  EXPECT_EQ(clusters(pointers(boxes), {0.0}, [] { return true; }), (std::vector<std::vector<std::size_t>>{{0}, {1}}));
}

// Isolated solutions of x = 0 with regions as wide as their boxes.
std::vector<Found> isolated(const std::vector<Box>& boxes) {
  std::vector<Found> found(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    certify::Sheet sheet;
    sheet.proven = true;
    sheet.dependent = {0};
    sheet.region = sheet.image = boxes[i];
    found[i].box.box = boxes[i];
    found[i].box.verdict = Verdict::isolated;
    found[i].sheet = std::make_unique<const certify::Sheet>(std::move(sheet));
  }
  return found;
}

TEST(MergeIsolated, LeavesUndecidedWhatItDidNotCompare) {
  std::vector<Found> found = isolated({{Interval(0, 2)}, {Interval(1, 1.5)}, {Interval(5, 6)}});
  std::vector<Found*> all, stopped;
  for (Found& f : found) all.push_back(&f);
  stopped = all;
  merge_isolated(all);
  ASSERT_EQ(all.size(), 2u) << "the second is the first's solution";
  EXPECT_EQ(all[0]->box.verdict, Verdict::isolated);
  merge_isolated(stopped, [] { return true; });
  ASSERT_EQ(stopped.size(), 3u);
  for (const Found* f : stopped) EXPECT_EQ(f->box.verdict, Verdict::undecided);
}

TEST(CollectPoints, MakesOneOfWhatItDidNotCluster) {
  std::vector<Found> found(3);
  std::vector<Found*> all;
  for (std::size_t i = 0; i < found.size(); ++i) {
    found[i].box.box = {Interval(10.0 * static_cast<double>(i), 10.0 * static_cast<double>(i) + 1)};
    all.push_back(&found[i]);
  }
  EXPECT_EQ(collect_points(all, {0.1}).size(), 3u);
  const auto points = collect_points(all, {0.1}, [] { return true; });
  ASSERT_EQ(points.size(), 1u);
  EXPECT_EQ(points[0].box[0], Interval(0, 21));
  EXPECT_EQ(points[0].verdict, Verdict::undecided);
}

}  // namespace
}  // namespace corank::solve
