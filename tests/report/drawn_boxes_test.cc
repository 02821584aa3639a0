// Hulls in place of very many boxes hold all of them, of each verdict for itself.
#include "corank/report/pictures/drawn_boxes.h"

#include <gtest/gtest.h>

#include <random>

namespace corank::report {
namespace {

result::Result many_boxes(std::size_t count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> anywhere(-1, 1);
  result::Result result;
  result.variables.resize(3);
  result.configuration_size = 2;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = anywhere(random), y = anywhere(random);
    CoverBox box;
    box.box = {{x, x + 0.01}, {y, y + 0.01}, {x * y, x * y + 0.1}};
    box.verdict = i % 10 == 0 ? Verdict::undecided : Verdict::regular;
    box.types.proven = i % 2 == 0 ? 3 : 1;
    result.cover.boxes.push_back(std::move(box));
  }
  return result;
}

bool holds(const CoverBox& hull, const CoverBox& box) {
  for (std::size_t j = 0; j < box.box.size(); ++j)
    if (!hull.box[j].contains(box.box[j])) return false;
  return hull.verdict == box.verdict && (hull.types.proven & ~box.types.proven) == 0;
}

TEST(DrawnBoxes, EveryBoxIsInAHullOfItsVerdictWithNoTypeThatItHasNot) {
  const result::Result all = many_boxes(3000);
  const std::vector<CoverBox> hulls = hulls_of(all, 12);
  EXPECT_LT(hulls.size(), 600u);
  EXPECT_GE(hulls.size(), 3000u / 12);
  for (const CoverBox& box : all.cover.boxes) {
    bool found = false;
    for (const CoverBox& hull : hulls) found = found || holds(hull, box);
    EXPECT_TRUE(found);
  }
}

TEST(DrawnBoxes, HullsAreOfNeighbours) {
  double area = 0;
  for (const CoverBox& hull : hulls_of(many_boxes(3000), 12)) area += hull.box[0].width() * hull.box[1].width();
  EXPECT_LT(area, 2 * 4.0 + 1);  // two verdicts, each at most once over the square, and what sticks out
}

TEST(DrawnBoxes, FewBoxesAreDrawnOneByOne) {
  EXPECT_EQ(boxes_in_one(many_boxes(1000), {}), 1u);
  result::Result many;
  many.cover.boxes.resize(kMostDrawn + 1);
  EXPECT_EQ(boxes_in_one(many, {}), 8u);
  many.outputs = {"x", "y"};
  EXPECT_EQ(boxes_in_one(many, {}), 1u);
}

TEST(DrawnBoxes, AreFewOnAPageThatIsWrittenAfterItsRunWasEnded) {
  const Components ended{.counted = false};
  EXPECT_EQ(boxes_in_one(many_boxes(1000), ended), 1u);
  EXPECT_EQ(boxes_in_one(many_boxes(60'000), ended), 8u);
}

}  // namespace
}  // namespace corank::report
