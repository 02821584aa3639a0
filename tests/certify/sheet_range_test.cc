// Ranges over pieces of proven sheets: what the faces tell, and never less than what there is.
#include "corank/certify/sheet_range.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "corank/core/rounding.h"
#include "corank/tests/system_builder.h"

namespace corank::certify {
namespace {

using test::SystemBuilder;

// u² + x² = 1, v = u·y with x and y free, and the value q = v + x − y.
class SheetRange : public testing::Test {
 protected:
  SheetRange() {
    SystemBuilder b;
    const int x = b.variable("x", "-2", "2"), y = b.variable("y", "-2", "2"), u = b.variable("u", "-2", "2"),
              v = b.variable("v", "-2", "2");
    b.equation({{"1", {{u, 2}}}, {"1", {{x, 2}}}, {"-1", {}}}).equation({{"1", {{v, 1}}}, {"-1", {{u, 1}, {y, 1}}}});
    const std::vector<Polynomial> values{SystemBuilder::polynomial({{"1", {{v, 1}}}, {"1", {{x, 1}}}, {"-1", {{y, 1}}}})};
    system_ = std::make_unique<CompiledSystem>(b.system(), values);
  }

  // The piece over x and y with u > 0, its sides and the value's; empty where no sheet is proven.
  std::vector<Interval> piece(Interval x, Interval y) {
    const double u = std::sqrt(1 - x.mid() * x.mid());
    p_ = {{0, 1}, {2, 3}, {1 / (2 * u), 0, y.mid() / (2 * u), 1}};
    const std::vector<Interval> box{x, y, Interval(u - 0.01, u + 0.01), Interval(u * y.mid() - 0.01, u * y.mid() + 0.01)};
    sheet_ = newton_prove(*system_, p_, box, workspace_);
    if (!sheet_.proven) return {};
    std::vector<Interval> sides = sheet_.image;
    tighten_sheet(*system_, p_, sides, workspace_);
    sides.push_back(system_->evaluate(system_->value_row(0), sides));
    return sides;
  }
  std::vector<Interval> shrunk(std::vector<Interval> sides, double width = 0) {
    shrink_to_faces(*system_, sheet_, p_, std::vector<double>(sides.size(), width), sides, workspace_);
    return sides;
  }

  UpwardRounding rounding_;
  NewtonWorkspace workspace_;
  std::unique_ptr<CompiledSystem> system_;
  Preconditioner p_;
  Sheet sheet_;
};

double u_at(double x) { return std::sqrt(1 - x * x); }

TEST_F(SheetRange, IsThatOfTheFacesWhereTheSheetIsMonotone) {
  const auto before = piece(Interval(0.3, 0.5), Interval(0.4, 0.7));
  ASSERT_FALSE(before.empty());
  const auto after = shrunk(before);
  const auto expect = [&](std::size_t side, double lower, double upper) {
    const double room = (upper - lower) / 100;
    EXPECT_NEAR(after[side].lo(), lower - room / 2, room);
    EXPECT_NEAR(after[side].hi(), upper + room / 2, room);
    EXPECT_LT(after[side].width(), 0.95 * before[side].width()) << "Newton alone is wider";
  };
  expect(2, u_at(0.5), u_at(0.3));
  expect(3, u_at(0.5) * 0.4, u_at(0.3) * 0.7);
  // q = u·y + x − y falls with y, and rises with x: 1 − x·y/u > 0.
  expect(4, 0.7 * u_at(0.3) + 0.3 - 0.7, 0.4 * u_at(0.5) + 0.5 - 0.4);
}

TEST_F(SheetRange, KeepsAnExtremeInside) {
  const auto before = piece(Interval(-0.2, 0.3), Interval(0.5, 0.6));
  ASSERT_FALSE(before.empty());
  const auto after = shrunk(before);
  EXPECT_EQ(after[2], before[2]) << "u is monotone in neither: it does not depend on y";
  EXPECT_GE(after[3].hi(), 0.6) << "u·y at x = 0";
  EXPECT_LE(after[3].lo(), u_at(0.3) * 0.5);
}

TEST_F(SheetRange, LeavesSidesThatAreNarrowEnough) {
  const auto before = piece(Interval(0.3, 0.5), Interval(0.4, 0.7));
  ASSERT_FALSE(before.empty());
  const double between = 0.5 * (before[2].width() + before[3].width());
  ASSERT_LT(before[2].width(), between);
  const auto after = shrunk(before, between);
  EXPECT_EQ(after[2], before[2]);
  EXPECT_LT(after[3].width(), before[3].width());
}

TEST_F(SheetRange, LosesNoPointOfTheSheet) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> at(-0.8, 0.6), width(0, 0.4), share(0, 1);
  int proven = 0, narrower = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const double x = at(random), y = at(random);
    const Interval xs(x, x + width(random)), ys(y, y + width(random));
    const auto before = piece(xs, ys);
    if (before.empty()) continue;
    ++proven;
    const auto after = shrunk(before);
    for (std::size_t j = 0; j < after.size(); ++j) {
      EXPECT_TRUE(before[j].contains(after[j]));
      narrower += after[j].width() < 0.98 * before[j].width();
    }
    for (int sample = 0; sample < 60; ++sample) {
      // Corners and edges, too.
      const auto pick = [&](const Interval& side) {
        const double s = share(random);
        return s < 0.25 ? side.lo() : s > 0.75 ? side.hi() : side.lo() + share(random) * (side.hi() - side.lo());
      };
      const double px = pick(xs), py = pick(ys), u = u_at(px);
      const double point[] = {px, py, u, u * py, u * py + px - py};
      for (std::size_t j = 0; j < after.size(); ++j)
        EXPECT_TRUE((after[j] + Interval(-1e-14, 1e-14)).contains(point[j])) << "side " << j << " in trial " << trial;
    }
  }
  EXPECT_GT(proven, 200);
  EXPECT_GT(narrower, proven);
}

TEST_F(SheetRange, LeavesARoomThatTheWidthAllows) {
  const auto before = piece(Interval(0.3, 0.5), Interval(0.4, 0.7));
  ASSERT_FALSE(before.empty());
  const double width = 0.99 * before[3].width();
  const auto after = shrunk(before, width);
  EXPECT_LE(after[3].width(), width);
  EXPECT_GT(after[3].width(), 0.9 * width);
}

TEST_F(SheetRange, SaysNothingOfAPointOrWhereTheJacobianMayBeSingular) {
  SystemBuilder b;
  const int x = b.variable("x", "-2", "2");
  b.equation({{"1", {{x, 2}}}, {"-2", {}}});
  const CompiledSystem root(b.system());
  const Preconditioner p{{0}, {0}, {1 / 2.8}};
  std::vector<Interval> sides{Interval(1.41, 1.42)};
  const Sheet point = newton_prove(root, p, sides, workspace_);
  ASSERT_TRUE(point.proven);
  sides = point.image;
  shrink_to_faces(root, point, p, {0.0}, sides, workspace_);
  EXPECT_EQ(sides, point.image);

  const auto near = piece(Interval(0.3, 0.5), Interval(0.4, 0.7));
  ASSERT_FALSE(near.empty());
  p_.y[0] = 100;  // |I − Y·J| is far above 1
  EXPECT_EQ(shrunk(near), near);
}

TEST_F(SheetRange, RefusesAPieceThatIsNotTheSheets) {
  const auto sides = piece(Interval(0.3, 0.5), Interval(0.4, 0.7));
  ASSERT_FALSE(sides.empty());
  auto wider = sides;
  wider[0] = Interval(0.2, 0.5);
  EXPECT_THROW(shrunk(wider), std::logic_error);
  p_.dependent = {2, 1};
  EXPECT_THROW(shrunk(sides), std::logic_error);
}

// d + d²/5 = f with f free, and the value q = d − c·f, whose derivative vanishes at some d of the piece: U has to say so for
// any Y, over all of the piece.
TEST(SheetRangeOfAValue, LosesNoPointWhereItTurns) {
  const UpwardRounding rounding;
  NewtonWorkspace workspace;
  std::mt19937 random(23);
  std::uniform_real_distribution<double> share(0, 1);
  int proven = 0;
  for (int trial = 0; trial < 600; ++trial) {
    const double lo = -0.8 + 1.6 * share(random), hi = lo + 0.1 + 0.4 * share(random), turn = lo + share(random) * (hi - lo);
    const int c = static_cast<int>(std::lround(1e6 / (1 + 0.4 * turn)));
    SystemBuilder b;
    const int f = b.variable("f", "-9", "9"), d = b.variable("d", "-9", "9");
    b.equation({{"1", {{d, 1}}}, {"1/5", {{d, 2}}}, {"-1", {{f, 1}}}});
    const std::vector<Polynomial> values{
        SystemBuilder::polynomial({{"1", {{d, 1}}}, {"-" + std::to_string(c) + "/1000000", {{f, 1}}}})};
    const CompiledSystem system(b.system(), values);
    const double good = 1 / (1 + 0.2 * (lo + hi)), factors[] = {1, 1, 0.5, 0.7, 1.3};
    const Preconditioner p{{0}, {d}, {good * factors[trial % 5]}};
    const auto f_at = [](double at) { return at + at * at / 5; };
    const std::vector<Interval> box{Interval(f_at(lo), f_at(hi)), Interval(lo - 0.2, hi + 0.2)};
    const Sheet sheet = newton_prove(system, p, box, workspace);
    if (!sheet.proven) continue;
    ++proven;
    std::vector<Interval> sides = sheet.image;
    for (int k = 0; k < 3; ++k) tighten_sheet(system, p, sides, workspace);
    sides.push_back(system.evaluate(system.value_row(0), sides));
    shrink_to_faces(system, sheet, p, {0, 0, 0}, sides, workspace);
    for (int k = 0; k <= 100; ++k) {
      const double at = lo + (hi - lo) * k / 100, q = at - c * 1e-6 * f_at(at);
      EXPECT_TRUE((sides[1] + Interval(-1e-14, 1e-14)).contains(at)) << trial;
      EXPECT_TRUE((sides[2] + Interval(-1e-14, 1e-14)).contains(q)) << trial << ": " << q << " not in " << sides[2];
    }
  }
  EXPECT_GT(proven, 300);
}

TEST(SheetRangeOfAValue, IsAskedWithTheSheetsOwnRows) {
  const UpwardRounding rounding;
  NewtonWorkspace workspace;
  SystemBuilder b;
  const int f = b.variable("f", "-9", "9"), d = b.variable("d", "-9", "9");
  b.equation({{"1", {{d, 1}}}, {"-1", {{f, 1}}}}).equation({{"1", {{d, 1}}}, {"-0.9", {{f, 1}}}});
  const CompiledSystem system(b.system());
  const std::vector<Interval> box{Interval(0, 1), Interval(-1, 2)};
  const Sheet sheet = newton_prove(system, {{0}, {d}, {1}}, box, workspace);
  ASSERT_TRUE(sheet.proven);
  std::vector<Interval> piece = sheet.image;
  EXPECT_NO_THROW(shrink_to_faces(system, sheet, {{0}, {d}, {1}}, {0, 0}, piece, workspace));
  EXPECT_THROW(shrink_to_faces(system, sheet, {{1}, {d}, {1}}, {0, 0}, piece, workspace), std::logic_error);
  piece[1] = Interval(-5, 5);  // the sheet's claim does not go so far
  EXPECT_THROW(shrink_to_faces(system, sheet, {{0}, {d}, {1}}, {0, 0}, piece, workspace), std::logic_error);
}

}  // namespace
}  // namespace corank::certify
