// Aspects of a C-space of three dimensions that closure equations give, against a flood fill that knows nothing of them.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>

#include "corank/analyze/aspects/aspects.h"
#include "corank/study/model.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/tests/analyze/flood_fill.h"
#include "corank/tests/seeds.h"

namespace corank::analyze {
namespace {

// A linear Delta: vertical rails on a circle, rods of one length to a platform that keeps its orientation. Millimetres.
constexpr double kOffset = 115, kRod = 250, kRail = 500, kLowest = 225, kHighest = 275;

symbolic::Mechanism linear_delta() {
  return symbolic::parse_model(R"(
[CONSTANTS]
a := 115
h := a/2
w := a*cos(pi/6)
L := 250
[SYSTEM VARS]
z1 : [0, 500]
z2 : [0, 500]
z3 : [0, 500]
x : [-400, 400]
y : [-400, 400]
z : [225, 275]
[SYSTEM EQS]
(x - a)^2 + y^2 + (z - z1)^2 = L^2;
(x + h)^2 + (y - w)^2 + (z - z2)^2 = L^2;
(x + h)^2 + (y + w)^2 + (z - z3)^2 = L^2;
[INPUTS] z1, z2, z3
[OUTPUTS] x, y, z
)",
                               "linear_delta.cuik");
}

using Vector = std::array<double, 3>;

double determinant(const Vector& a, const Vector& b, const Vector& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

// Over the platform's positions the rods' signs, slide above (1) or below (0) the platform, tell the configuration.
bool is_in_mode(int mode, int sign, const Vector& p) {
  std::array<Vector, 3> rods{};
  for (int leg = 0; leg < 3; ++leg) {
    const double angle = 2 * M_PI * leg / 3;
    Vector& rod = rods[leg];
    rod = {p[0] - kOffset * std::cos(angle), p[1] - kOffset * std::sin(angle), 0};
    const double square = kRod * kRod - rod[0] * rod[0] - rod[1] * rod[1];
    if (!(square > 0)) return false;
    rod[2] = (mode >> leg & 1) != 0 ? -std::sqrt(square) : std::sqrt(square);
    const double slide = p[2] - rod[2];
    if (!(slide > 0 && slide < kRail)) return false;
  }
  return sign == 0 || sign * determinant(rods[0], rods[1], rods[2]) > 0;
}

// Of the configurations with these signs and this sign of the determinant; 0: of either sign.
std::size_t linear_delta_pieces(int mode, int sign) {
  constexpr std::size_t kAcross = 300, kUp = 8;
  const auto place = [](std::size_t i) { return -kRod + 2 * kRod * (static_cast<double>(i) + 0.53) / kAcross; };
  const auto height = [](std::size_t k) { return kLowest + (kHighest - kLowest) * (static_cast<double>(k) + 0.5) / kUp; };
  return flood_pieces({{kAcross, kAcross, kUp}, {}, kUp + 1}, [&](const std::array<std::size_t, 3>& p) {
    return is_in_mode(mode, sign, {place(p[0]), place(p[1]), height(p[2])});
  });
}

TEST(AspectsInSpace, OfALinearDeltaAreThoseOfAFloodFill) {
  solve::Control control;
  const Aspects found = aspects({.model = linear_delta()}, {}, control);
  ASSERT_TRUE(found.reason.empty()) << found.reason;
  ASSERT_TRUE(found.aspects.exact()) << found.aspects.reason;
  ASSERT_TRUE(found.working_modes.exact()) << found.working_modes.reason;
  std::size_t counted = 0, modes = 0;
  for (int mode = 0; mode < 8; ++mode) {
    modes += linear_delta_pieces(mode, 0);
    for (const int sign : {-1, 1}) counted += linear_delta_pieces(mode, sign);
  }
  EXPECT_EQ(counted, 14U);
  EXPECT_EQ(modes, 8U);
  EXPECT_EQ(static_cast<std::size_t>(found.aspects.at_least), counted);
  EXPECT_EQ(static_cast<std::size_t>(found.working_modes.at_least), modes);
  EXPECT_TRUE(found.assembly_modes.exact()) << found.assembly_modes.reason;
  EXPECT_EQ(found.assembly_modes.at_least, 2);
}

// models/platforms/delta_translation.cuik at all heights: its arms' angles and on which side of the plane of their ends the
// platform is (the sign of the rods' determinant) tell the configuration.
struct Elbows {
  static constexpr std::size_t kAcross = 150;
  static constexpr double kRod = 1.2, kOut = 0.5, kLowest = -3, kHighest = 1;

  // mode: of each arm the sign of the rod along the arm's motion, as a bit; below 0: any.
  static std::size_t pieces(int mode, int side) {
    return flood_pieces({{kAcross, kAcross, kAcross}, {}, 10},
                        [&](const std::array<std::size_t, 3>& p) { return is_inside(mode, side, 0, p); });
  }
  // Do both sides of a mode meet, where the platform is in that plane? Next to it is a point of each.
  static bool sides_meet(int mode) {
    std::size_t near = 0;
    for (std::size_t i = 0; i < kAcross; ++i)
      for (std::size_t j = 0; j < kAcross; ++j)
        for (std::size_t k = 0; k < kAcross; ++k)
          near += is_inside(mode, 1, 0.02, {i, j, k}) && is_inside(mode, -1, 0.02, {i, j, k}) ? 1 : 0;
    return near > 0;
  }

 private:
  // most: the largest height of the platform over the plane, squared; 0: any height.
  static bool is_inside(int mode, int side, double most, const std::array<std::size_t, 3>& p) {
    std::array<Eigen::Vector3d, 3> ends, motions;
    for (std::size_t leg = 0; leg < 3; ++leg) {
      const double turn = 2 * M_PI * static_cast<double>(leg) / 3, c = std::cos(turn), s = std::sin(turn),
                   angle = -M_PI / 3 + 5 * M_PI / 6 * (static_cast<double>(p[leg]) + 0.53) / kAcross,
                   out = kOut + std::cos(angle);
      ends[leg] = {out * c, out * s, -std::sin(angle)};
      motions[leg] = {-std::sin(angle) * c, -std::sin(angle) * s, -std::cos(angle)};
    }
    const Eigen::Vector3d u = ends[1] - ends[0], w = ends[2] - ends[0], normal = u.cross(w);
    const double square = normal.squaredNorm();
    const Eigen::Vector3d centre = (w.squaredNorm() * normal.cross(u) + u.squaredNorm() * w.cross(normal)) / (2 * square);
    const double height = kRod * kRod - centre.squaredNorm();
    if (!(height > 0) || (most > 0 && height > most)) return false;
    const Eigen::Vector3d at = ends[0] + centre + side * std::sqrt(height / square) * normal;
    if (!(at.z() > kLowest && at.z() < kHighest)) return false;
    for (std::size_t leg = 0; leg < 3 && mode >= 0; ++leg)
      if (((at - ends[leg]).dot(motions[leg]) > 0) != ((mode >> leg & 1) != 0)) return false;
    return true;
  }
};

// A quarter of an hour, so that only longer runs than usual do it.
TEST(AspectsInSpace, OfADeltaAreThoseOfAFloodFill) {
  if (test::seeds(0) < 100) GTEST_SKIP() << "takes long: CORANK_SEEDS=100";
  std::size_t counted = 0, assembled = 0, working = 0;
  for (int mode = 0; mode < 8; ++mode) {
    const std::size_t upper = Elbows::pieces(mode, 1), lower = Elbows::pieces(mode, -1);
    counted += upper + lower;
    if (upper + lower == 0) continue;
    EXPECT_TRUE(upper == 1 && lower == 1 && Elbows::sides_meet(mode)) << mode;
    ++working;  // both together
  }
  for (const int side : {-1, 1}) assembled += Elbows::pieces(-1, side);
  EXPECT_EQ(counted, 10U);
  EXPECT_EQ(assembled, 4U);
  EXPECT_EQ(working, 5U);
  const study::Model model =
      study::read_model(CORANK_SOURCE_DIR "/models/platforms/delta_translation.cuik", {{"lowest", "-3"}, {"highest", "1"}});
  solve::Control control;
  const Aspects found = aspects({.model = model.mechanism}, {}, control);
  ASSERT_TRUE(found.reason.empty()) << found.reason;
  EXPECT_EQ(static_cast<std::size_t>(found.aspects.at_least), counted);
  EXPECT_TRUE(found.aspects.exact()) << found.aspects.reason;
  EXPECT_EQ(static_cast<std::size_t>(found.assembly_modes.at_least), assembled);
  EXPECT_TRUE(found.assembly_modes.exact()) << found.assembly_modes.reason;
  EXPECT_EQ(static_cast<std::size_t>(found.working_modes.at_least), working);
  EXPECT_TRUE(found.working_modes.exact()) << found.working_modes.reason;
}

}  // namespace
}  // namespace corank::analyze
