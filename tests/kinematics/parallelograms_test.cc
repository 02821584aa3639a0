// Parallelograms that are written out: found by their geometry, and kept where that is asked for.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "corank/kinematics/language/part_file.h"
#include "corank/kinematics/loops/parallelograms.h"
#include "corank/tests/kinematics/assembled.h"

namespace corank::kinematics {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using testing::UnorderedElementsAre;

// A leg whose shank is driven by a crank about the hip and a rod along the thigh.
std::string leg(const std::string& more, const std::string& rod = "220") {
  return "[LINKS]\nhip\nthigh\ncrank\nrod\nshank\n[JOINTS]\n" + more +
         "revolute q1 : hip (0,0,0)+(0,0,1) thigh (0,0,0)+(0,0,1) actuated\n"
         "revolute q2 : hip (0,0,0)+(0,0,1) crank (0,0,0)+(0,0,1) actuated\n"
         "revolute : thigh (220,0,0)+(0,0,1) shank (0,0,0)+(0,0,1)\n"
         "revolute : crank (60,0,0)+(0,0,1) rod (0,0,0)+(0,0,1)\n"
         "revolute : rod (" +
         rod +
         ",0,0)+(0,0,1) shank (60,0,0)+(0,0,1)\n"
         "[OUTPUTS]\nF : position of shank (-240,0,0)\n";
}

TEST(Parallelograms, AreFoundWhereTwoSidesTurnAboutOneAxis) {
  const Assembly a = assembled(leg(""));
  ASSERT_THAT(a.parallelograms, SizeIs(1));
  EXPECT_THAT(a.parallelograms[0].sides, UnorderedElementsAre("thigh", "shank", "rod", "crank"));
  EXPECT_EQ(a.parallelograms[0].angle, "crosswise");
  EXPECT_THAT(assembled(leg("", "221")).parallelograms, IsEmpty());
}

TEST(Parallelograms, ThatAreKeptLeaveNoLoop) {
  const Assembly a = assembled(leg("keep parallelograms\n"));
  EXPECT_THAT(a.parallelograms, IsEmpty());
  EXPECT_THAT(coordinate_names(a), ElementsAre("q1", "q2", "F_x", "F_y"));
  EXPECT_EQ(a.mobility, 2);
  const auto values = completed(a, {{"q1", 0.3}, {"q2", 1.9}});
  EXPECT_NEAR(values.at("F_x"), 220 * std::cos(0.3) - 240 * std::cos(1.9), 1e-9);
  EXPECT_NEAR(values.at("F_y"), 220 * std::sin(0.3) - 240 * std::sin(1.9), 1e-9);
}

TEST(Parallelograms, AreKeptOnlyWhereThereIsOne) {
  EXPECT_THAT(fault_of(leg("keep parallelograms\n", "221")), HasSubstr("`keep parallelograms` finds no parallelogram"));
}

// On a turning column, the fourth side a rod between two points.
TEST(Parallelograms, WithARodInSpaceAreKept) {
  const Assembly a = assembled(
      "[LINKS]\nbase\ncol\nupper\ncrank\nfore\n[JOINTS]\nkeep parallelograms\n"
      "revolute j1 : base (0,0,0)+(0,0,1) col (0,0,0)+(0,0,1) actuated\n"
      "revolute j2 : col (26,0,56)+(0,1,0) upper (0,0,0)+(0,1,0) actuated\n"
      "revolute j3 : col (26,0,56)+(0,1,0) crank (0,0,0)+(0,1,0) actuated\n"
      "revolute elbow : upper (0,0,85)+(0,1,0) fore (0,0,0)+(0,1,0)\n"
      "sph_sph rod : crank (-30,0,0) fore (-30,0,0) length 85\n");
  EXPECT_EQ(a.mobility, 3);
  const auto values = completed(a, {{"j1", 0.4}, {"j2", -0.7}, {"j3", 1.1}});
  const Transform crank = pose_of(a, "crank", values), fore = pose_of(a, "fore", values);
  double square = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(crank.r[i][k], fore.r[i][k], 1e-12);
    const double way = fore.p[i] - 30 * fore.r[i][0] - crank.p[i] + 30 * crank.r[i][0];
    square += way * way;
  }
  EXPECT_NEAR(square, 85 * 85, 1e-9);
}

// Random parallelograms, drawn in the plane and seen from links with random rational frames; hinges are where they were
// planted at every position, opposite sides stay parallel, and what is no parallelogram is not taken for one.
TEST(Parallelograms, OfRandomGeometryAreFoundAndKept) {
  std::mt19937_64 random(7);
  const auto pick = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
  // Rational points of the circle.
  const std::vector<std::pair<std::string, double>> turns{
      {"(1,0)", 0}, {"(0,1)", M_PI / 2}, {"(3/5,4/5)", std::atan2(4, 3)}, {"(-5/13,12/13)", std::atan2(12, -5)}};
  for (int round = 0; round < 40; ++round) {
    const int a = pick(1, 9), b = pick(1, 9), off = pick(0, 3) == 0 ? 1 : 0;
    const auto point = [&](int turn, int x, int y, int length) {  // (x, y) + length·(c, s), in exact numbers
      const std::string& u = turns[static_cast<std::size_t>(turn)].first;
      const std::size_t comma = u.find(',');
      return fmt::format("({} + {}*({}), {} + {}*({}), 0)", x, length, u.substr(1, comma - 1), y, length,
                         u.substr(comma + 1, u.size() - comma - 2));
    };
    // Of each side: where its first hinge is, and how its direction is turned.
    struct Side {
      int x, y, turn;
    };
    std::vector<Side> sides;
    for (int i = 0; i < 4; ++i) sides.push_back({pick(-3, 3), pick(-3, 3), pick(0, 3)});
    const std::array<int, 4> length{a, b, a + off, b};
    const auto end = [&](std::size_t i, bool second) {
      const Side& s = sides[i];
      return point(s.turn, s.x, s.y, second ? length[i] : 0);
    };
    const auto text = [&](const std::string& keep) {
      return "[LINKS]\nA\nB\nC\nD\n[JOINTS]\n" + keep + "revolute t : A " + end(0, true) + "+(0,0,1) B " + end(1, false) +
             "+(0,0,1) actuated\nrevolute : B " + end(1, true) + "+(0,0,1) C " + end(2, false) + "+(0,0,1)\nrevolute : C " +
             end(2, true) + "+(0,0,1) D " + end(3, false) + "+(0,0,1)\nrevolute : D " + end(3, true) + "+(0,0,1) A " +
             end(0, false) + "+(0,0,1)\n";
    };
    const Assembly open = assembled(text(""));
    EXPECT_EQ(open.parallelograms.size(), off == 0 ? 1u : 0u) << text("");
    if (off != 0) continue;
    const Assembly kept = assembled(text("keep parallelograms\n"));
    EXPECT_EQ(kept.mobility, 1) << text("");
    EXPECT_THAT(kept.mechanism.constraints(), IsEmpty());
    const auto values = completed(kept, {{kept.mechanism.coordinates().at(0).name, 0.1 * pick(-30, 30)}});
    const auto hinge = [&](std::size_t i, bool second) {
      const Transform pose = pose_of(kept, std::string(1, "ABCD"[i]), values);
      const double angle = turns[static_cast<std::size_t>(sides[i].turn)].second, l = second ? length[i] : 0;
      const std::array<double, 2> local{sides[i].x + l * std::cos(angle), sides[i].y + l * std::sin(angle)};
      std::array<double, 2> world{};
      for (std::size_t k = 0; k < 2; ++k) world[k] = pose.p[k] + pose.r[k][0] * local[0] + pose.r[k][1] * local[1];
      return world;
    };
    std::array<std::array<double, 2>, 4> along{};
    for (std::size_t i = 0; i < 4; ++i) {
      const auto from = hinge(i, false), to = hinge(i, true), next = hinge((i + 1) % 4, false);
      for (std::size_t k = 0; k < 2; ++k) {
        EXPECT_NEAR(to[k], next[k], 1e-9) << i << text("");
        along[i][k] = to[k] - from[k];
      }
    }
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(along[i][k], -along[i + 2][k], 1e-9) << text("");
  }
}

}  // namespace
}  // namespace corank::kinematics
