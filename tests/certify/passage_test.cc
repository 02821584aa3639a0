// Barriers and passages of planted forms: none false, few lost.
#include "corank/certify/passage.h"

#include <gtest/gtest.h>

#include "corank/core/rounding.h"
#include "corank/tests/planted_passage.h"
#include "corank/tests/system_builder.h"

namespace corank::certify {
namespace {

struct Count {
  int all = 0, lost = 0, wrong = 0;
};

// Are the findings in boxes of this radius what was planted?
Count count(double radius, std::size_t zeros, unsigned seed, int halvings = 0) {
  test::PassagePlanter planter(seed);
  const UpwardRounding rounding;
  Count c;
  for (int i = 0; i < 300; ++i) {
    const auto equations = static_cast<std::size_t>(planter.number(1, 4)),
               kernel = static_cast<std::size_t>(planter.number(0, 3)),
               limits = static_cast<std::size_t>(planter.number(kernel == 0 ? 1 : 0, 2));
    const test::PlantedPassage p = planter.plant(equations, kernel, limits, std::min(zeros, kernel + limits), i % 2 == 0);
    const PassageTest::Finding found = PassageTest(p.system).of(p.box(radius), halvings);
    ++c.all;
    if (found.passage == Passage::unproven) {
      c.lost += p.is_barrier() || p.is_traversable();
      continue;
    }
    bool right = found.passage == Passage::barrier ? p.is_barrier() : p.is_traversable();
    if (right && found.passage == Passage::barrier) {
      const std::vector<double> side = p.side();
      right = side[0] * found.side[0] + side[1] * found.side[1] > 0;
    }
    c.wrong += !right;
  }
  return c;
}

TEST(PassageOfABoundary, IsFoundInSmallBoxesAndNeverWrong) {
  const Count c = count(1e-7, 0, 1);
  EXPECT_EQ(c.wrong, 0);
  EXPECT_EQ(c.lost, 0);
}

TEST(PassageOfABoundary, IsNeverWrongInLargeBoxes) {
  int proven = 0;
  for (const double radius : {0.003, 0.03, 0.3, 3.0}) {
    const Count c = count(radius, 0, 2);
    EXPECT_EQ(c.wrong, 0) << radius;
    proven += c.all - c.lost;
  }
  EXPECT_GT(proven, 200) << "some of the boxes are small enough";
}

TEST(PassageOfABoundary, IsFoundInMoreBoxesByHalves) {
  const Count whole = count(0.02, 0, 3), halved = count(0.02, 0, 3, 8);
  EXPECT_EQ(halved.wrong, 0);
  EXPECT_LT(halved.lost, whole.lost);
}

TEST(PassageOfABoundary, IsNoBarrierWhereTheFormHasAZero) {
  for (const double radius : {0.0, 1e-9, 1e-3}) EXPECT_EQ(count(radius, 1, 4).wrong, 0) << radius;
}

TEST(PassageOfABoundary, NeedsANormalAndAMultiplier) {
  test::PassagePlanter planter(5);
  const UpwardRounding rounding;
  test::PlantedPassage p = planter.plant(2, 1, 0);
  ASSERT_NE(PassageTest(p.system).of(p.box(1e-7)).passage, Passage::unproven);
  test::PlantedPassage flat = p;
  for (Polynomial& n : flat.system.passage->normal) n.monomials.clear();
  EXPECT_EQ(PassageTest(flat.system).of(p.box(1e-7)).passage, Passage::unproven) << "C-space may be singular there";
  Box box = p.box(1e-7);
  for (std::size_t i = 1; i < box.size(); ++i) box[i] = Interval(-1, 1);
  EXPECT_EQ(PassageTest(p.system).of(box).passage, Passage::unproven) << "no multiplier is seen not to be 0";
  System tolerant = p.system;
  tolerant.coefficient_tolerance = 1e-9;
  EXPECT_FALSE(PassageTest(tolerant).applies());
  tolerant.passage.reset();
  EXPECT_FALSE(PassageTest(tolerant).applies());
}

// Where a side would need coordinates that the system does not have.
TEST(PassageOfABoundary, IsFoundWithoutANormal) {
  test::PassagePlanter planter(7);
  const UpwardRounding rounding;
  int lost = 0;
  for (int i = 0; i < 200; ++i) {
    test::PlantedPassage p = planter.plant(3, i % 3, i % 3 == 0 ? 2 : i % 2, i % 5 == 0, i % 2 == 0);
    p.system.passage->normal.clear();
    const PassageTest::Finding found = PassageTest(p.system).of(p.box(1e-7));
    EXPECT_TRUE(found.side.empty());
    if (found.passage == Passage::unproven) {
      lost += p.is_barrier() || p.is_traversable();
    } else {
      EXPECT_TRUE(found.passage == Passage::barrier ? p.is_barrier() : p.is_traversable());
    }
  }
  EXPECT_LE(lost, 4);
}

// The slacks are what is planted behind the form's numbers: without them its own signs may be one or both.
TEST(PassageOfABoundary, IsNoBarrierWithoutTheSlacks) {
  test::PassagePlanter planter(8);
  const UpwardRounding rounding;
  int traversable = 0;
  for (int i = 0; i < 200; ++i) {
    test::PlantedPassage p = planter.plant(3, 1 + i % 3, 1, 0, i % 2 == 0);
    p.system.passage->slack.clear();
    p.system.passage->has_slacks = false;
    const Passage passage = PassageTest(p.system).of(p.box(1e-7)).passage;
    EXPECT_NE(passage, Passage::barrier);
    EXPECT_TRUE(passage != Passage::traversable || p.is_traversable());
    traversable += passage == Passage::traversable;
  }
  EXPECT_GT(traversable, 20);
}

// Where Φ_z loses another rank, λ is one of many.
TEST(PassageOfABoundary, NeedsAKernelOfOneDimension) {
  test::PassagePlanter planter(6);
  const UpwardRounding rounding;
  for (int i = 0; i < 20; ++i) {
    test::PlantedPassage p = planter.plant(3, 1, 1);
    PassageForm& form = *p.system.passage;
    for (int j = 0; j < form.columns; ++j)
      for (int row : {0, 1, 2}) form.jacobian[static_cast<std::size_t>(row * form.columns + j)].monomials.clear();
    EXPECT_EQ(PassageTest(p.system).of(p.box(1e-7)).passage, Passage::unproven);
  }
  test::PlantedPassage p = planter.plant(3, 1, 1, 0, false);
  ASSERT_NE(PassageTest(p.system).of(p.box(1e-7)).passage, Passage::unproven);
  for (Polynomial& f : p.system.passage->jacobian) f.monomials.clear();
  EXPECT_EQ(PassageTest(p.system).of(p.box(1e-7)).passage, Passage::unproven) << "no λ is found";
}

// The form ((a, b), (b, c)) itself, a kernel of two dimensions without equations, or with (x, 1/10; 0, 0) for Φ_z.
struct Entries {
  System system;
  int a, b, c, x, multiplier;

  explicit Entries(bool equations) {
    test::SystemBuilder s;
    a = s.variable("a", "-9", "9"), b = s.variable("b", "-9", "9"), c = s.variable("c", "-9", "9");
    x = s.variable("x", "-9", "9"), multiplier = s.variable("l", "-9", "9");
    system = s.system();
    const auto entry = [](int v) { return test::SystemBuilder::polynomial({{"1", {{v, 1}}}}); };
    const auto number = [](const char* text) { return test::SystemBuilder::polynomial({{text, {}}}); };
    PassageForm form;
    form.equations = equations ? 2 : 0, form.columns = 2;
    if (equations) form.jacobian = {entry(x), number("1/10"), {}, {}}, form.multipliers = {a, multiplier};
    form.hessian = {entry(a), entry(b), entry(c)};
    form.normal = {number("1"), {}};
    system.passage = form;
  }
  Passage of(const Interval& a_side, const Interval& b_side, const Interval& x_side) const {
    const UpwardRounding rounding;
    return PassageTest(system).of({a_side, b_side, Interval(1.0), x_side, Interval(5.0)}, 0).passage;
  }
};

TEST(PassageOfABoundary, IsNoBarrierWhereAFormWithinIsIndefinite) {
  const Entries entries(false);
  EXPECT_EQ(entries.of(Interval(1.0), Interval(-0.5, 0.5), Interval(1.0)), Passage::barrier);
  EXPECT_EQ(entries.of(Interval(1.0), Interval(-1.5, 1.5), Interval(1.0)), Passage::unproven) << "its diagonal is positive";
}

TEST(PassageOfABoundary, NeedsARegularN) {
  const Entries entries(true);
  EXPECT_EQ(entries.of(Interval(1.0), Interval(0.0), Interval(1, 2)), Passage::barrier);
  EXPECT_EQ(entries.of(Interval(1.0), Interval(0.0), Interval(-1, 2)), Passage::unproven) << "x may be 0";
}

TEST(PassageOfABoundary, IsProvenForEveryMultiplierOfTheBox) {
  const UpwardRounding rounding;
  const PassageTest test(test::system_with_multipliers_to_find());
  EXPECT_EQ(test.of({Interval(0.9, 1.1)}).passage, Passage::barrier);
  EXPECT_EQ(test.of({Interval(0, 2)}).passage, Passage::unproven);
}

}  // namespace
}  // namespace corank::certify
