// What is shown all over a region is said of the boxes that were cut from it, and of nothing else: a point of a cover may
// be the hull of boxes that reach out of the region.
#include <gtest/gtest.h>

#include <random>

#include "corank/solve/search/box_labels.h"
#include "corank/solve/step/control.h"
#include "corank/solve/step/options.h"
#include "corank/tests/system_builder.h"

namespace corank::solve {
namespace {

using Builder = test::SystemBuilder;

// L = (x − a | 1), u before v: an RO singularity at x = a only. As kernel equations (x − a) ξ1 = 0 and |ξ|² = 1, ξ of two
// components: of dimension 2 at x = a only.
struct Planted {
  explicit Planted(const std::string& a) {
    Builder b;
    const int x = b.variable("x", "-4", "4");
    const int xi = b.variable("xi1", "-1", "1", VariableKind::kernel);
    const int eta = b.variable("xi2", "-1", "1", VariableKind::kernel);
    b.equation({{"1", {{x, 1}, {xi, 1}}}, {"-" + a, {{xi, 1}}}});
    b.equation({{"1", {{xi, 2}}}, {"1", {{eta, 2}}}, {"-1", {}}});
    system = b.system();
    const Polynomial pivot = Builder::polynomial({{"1", {{x, 1}}}, {"-" + a, {}}}), one = Builder::polynomial({{"1", {}}});
    blocks.matrices = {PolynomialMatrix{1, 2, {pivot, one}}, {1, 1, {pivot}}, {1, 1, {one}}, {1, 0, {}}, {}, {}};
    blocks.outputs = blocks.inputs = 1;
    blocks.at_most = {1, 1, 1, 0, 0, 0};
    blocks.asked = blocks.of_set = bit(SingularityType::ro);
  }
  System system;
  VelocityBlocks blocks;
};

CoverBox cut(double lower, double upper) {
  CoverBox box;
  box.box = {Interval(lower, upper), Interval(-1, 1), Interval(-1, 1)};
  box.region = 0;
  return box;
}

// Two boxes of a region that does not hold a, and a point of that region whose hull does hold it.
Cover cover_beside(double a, double gap, double width) {
  Cover cover;
  cover.boxes = {cut(a + gap, a + gap + width), cut(a + gap + width, a + gap + 2 * width)};
  cover.regions = {{Interval(a + gap, a + gap + 2 * width), Interval(-1, 1), Interval(-1, 1)}};
  cover.points = {cut(a - width, a + gap + width)};
  return cover;
}

TEST(RegionClaims, AreNotOfPointsThatReachOutOfTheRegion) {
  std::mt19937 random(5);
  std::uniform_int_distribution<int> place(1, 12);
  std::uniform_real_distribution<double> size(0.01, 0.5);
  Control control;
  for (int k = 0; k < 200; ++k) {
    const int a = place(random);
    const Planted planted(std::to_string(a) + "/8");
    const Prepared prepared = prepare(planted.system, {}, control);
    Cover cover = cover_beside(a / 8.0, size(random), size(random));
    label_types(prepared, {planted.blocks}, cover, control);
    bound_kernel_dimensions(prepared, cover, control);
    for (const CoverBox& box : cover.boxes) {
      EXPECT_EQ(box.types.excluded, bit(SingularityType::ro));
      EXPECT_EQ(box.kernel_at_most, 1);
    }
    EXPECT_EQ(cover.points[0].types, TypeLabels{}) << "holds the singularity, and others besides";
    EXPECT_EQ(cover.points[0].kernel_at_most, 2);
  }
}

}  // namespace
}  // namespace corank::solve
