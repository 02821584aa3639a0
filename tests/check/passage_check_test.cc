// What is said of barriers and passages, against planted forms.
#include "corank/check/passage.h"

#include <gtest/gtest.h>

#include "corank/tests/planted_passage.h"

namespace corank::check {
namespace {

CoverBox claim(const test::PlantedPassage& p, double radius, Passage passage, std::vector<double> side) {
  CoverBox box;
  box.box = p.box(radius);
  box.passage = passage;
  box.side = std::move(side);
  return box;
}

bool holds(const test::PlantedPassage& p, double radius, Passage passage, const std::vector<double>& side) {
  return PassageCheck(p.system).fault(claim(p, radius, passage, side)).empty();
}

TEST(PassageCheck, AcceptsWhatIsPlantedAndNothingElse) {
  test::PassagePlanter planter(11);
  int barriers = 0, traversable = 0, neither = 0;
  for (int i = 0; i < 120; ++i) {
    const auto kernel = static_cast<std::size_t>(planter.number(0, 3)),
               limits = static_cast<std::size_t>(planter.number(kernel == 0, 2));
    const test::PlantedPassage p =
        planter.plant(static_cast<std::size_t>(planter.number(1, 4)), kernel, limits,
                      std::min<std::size_t>(planter.number(0, 3) == 0, kernel + limits), i % 2 == 0);
    const std::vector<double> side = p.side(), other{-side[0], -side[1]};
    EXPECT_EQ(holds(p, 1e-8, Passage::barrier, side), p.is_barrier());
    EXPECT_FALSE(holds(p, 1e-8, Passage::barrier, other));
    EXPECT_EQ(holds(p, 1e-8, Passage::traversable, side), p.is_traversable());
    ++(p.is_barrier() ? barriers : p.is_traversable() ? traversable : neither);
  }
  EXPECT_GT(barriers, 10);
  EXPECT_GT(traversable, 10);
  EXPECT_GT(neither, 2);
}

TEST(PassageCheck, RejectsSidesThatAreNone) {
  test::PassagePlanter planter(12);
  const test::PlantedPassage p = planter.plant(2, 0, 1);
  const std::vector<double> side = p.side();
  ASSERT_TRUE(holds(p, 1e-8, Passage::barrier, side));
  EXPECT_FALSE(holds(p, 1e-8, Passage::barrier, {}));
  EXPECT_FALSE(holds(p, 1e-8, Passage::barrier, {2 * side[0], 2 * side[1]}));
  EXPECT_FALSE(holds(p, 1e-8, Passage::barrier, {-side[1], side[0]})) << "along the boundary";
  EXPECT_FALSE(holds(p, 1e-8, Passage::unproven, side));
  EXPECT_TRUE(holds(p, 1e-8, Passage::unproven, {}));
}

TEST(PassageCheck, NeedsNoSideWhereThereIsNoNormal) {
  test::PassagePlanter planter(15);
  for (int i = 0; i < 120; ++i) {
    test::PlantedPassage p = planter.plant(3, i % 3, i % 3 == 0 ? 2 : i % 2, i % 5 == 0, i % 2 == 0);
    const std::vector<double> side = p.side();
    p.system.passage->normal.clear();
    EXPECT_EQ(holds(p, 1e-8, Passage::barrier, {}), p.is_barrier());
    EXPECT_EQ(holds(p, 1e-8, Passage::traversable, {}), p.is_traversable());
    EXPECT_FALSE(holds(p, 1e-8, Passage::barrier, side));
  }
}

TEST(PassageCheck, NeedsTheSlacksForABarrier) {
  test::PassagePlanter planter(16);
  int barriers = 0;
  for (int i = 0; i < 60; ++i) {
    test::PlantedPassage p = planter.plant(2, 1, 1, 0, i % 2 == 0);
    barriers += holds(p, 1e-8, Passage::barrier, p.side());
    p.system.passage->slack.clear();
    p.system.passage->has_slacks = false;
    EXPECT_FALSE(holds(p, 1e-8, Passage::barrier, p.side()));
  }
  EXPECT_GT(barriers, 10);
}

TEST(PassageCheck, KnowsOfNoPassageWithoutAForm) {
  test::PassagePlanter planter(13);
  test::PlantedPassage p = planter.plant(2, 0, 1);
  const CoverBox box = claim(p, 1e-8, Passage::barrier, p.side());
  p.system.passage.reset();
  EXPECT_FALSE(PassageCheck(p.system).fault(box).empty());
}

TEST(PassageCheck, NeedsAKernelOfOneDimension) {
  test::PassagePlanter planter(14);
  for (const bool has_multipliers : {true, false}) {
    test::PlantedPassage p = planter.plant(3, 0, 1, 0, has_multipliers);
    ASSERT_TRUE(holds(p, 1e-8, Passage::barrier, p.side()));
    for (Polynomial& f : p.system.passage->jacobian) f.monomials.clear();
    EXPECT_FALSE(holds(p, 1e-8, Passage::barrier, p.side()));
  }
}

TEST(PassageCheck, IsAboutEveryMultiplierOfTheBox) {
  const PassageCheck check(test::system_with_multipliers_to_find());
  CoverBox box;
  box.passage = Passage::barrier;
  box.side = {-1};
  box.box = {Interval(0.9, 1.1)};
  EXPECT_EQ(check.fault(box), "");
  box.box = {Interval(0, 2)};
  EXPECT_NE(check.fault(box), "");
}

}  // namespace
}  // namespace corank::check
