// Aspects of a C-space of three dimensions that closure equations give, against a flood fill that knows nothing of them.
#include <gtest/gtest.h>

#include <array>
#include <boost/pending/disjoint_sets.hpp>
#include <cmath>
#include <map>
#include <vector>

#include "corank/analyze/aspects/aspects.h"
#include "corank/symbolic/model/model_file.h"

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

// A grid over the platform's positions: at each the rods' signs, slide above (1) or below (0) the platform, tell the
// configuration.
struct FloodFill {
  static constexpr std::size_t kAcross = 300, kUp = 8;

  // Of the configurations with these signs and this sign of the determinant, those that hang together; 0: of either sign. A
  // single column of the grid is cut off from a corner by the grid.
  static std::size_t pieces(int mode, int sign) {
    const auto at = [](std::size_t i, std::size_t j, std::size_t k) { return (i * kAcross + j) * kUp + k; };
    std::vector<bool> inside(kAcross * kAcross * kUp);
    boost::disjoint_sets_with_storage<> together(inside.size());
    for (std::size_t i = 0; i < kAcross; ++i)
      for (std::size_t j = 0; j < kAcross; ++j)
        for (std::size_t k = 0; k < kUp; ++k) {
          const std::size_t own = at(i, j, k);
          inside[own] = is_inside(mode, sign, {place(i), place(j), height(k)});
          if (!inside[own]) continue;
          if (i > 0 && inside[at(i - 1, j, k)]) together.union_set(own, at(i - 1, j, k));
          if (j > 0 && inside[at(i, j - 1, k)]) together.union_set(own, at(i, j - 1, k));
          if (k > 0 && inside[at(i, j, k - 1)]) together.union_set(own, at(i, j, k - 1));
        }
    std::map<std::size_t, std::size_t> sizes;
    for (std::size_t c = 0; c < inside.size(); ++c)
      if (inside[c]) ++sizes[together.find_set(c)];
    return static_cast<std::size_t>(std::ranges::count_if(sizes, [](const auto& piece) { return piece.second > kUp; }));
  }

 private:
  static double place(std::size_t i) { return -kRod + 2 * kRod * (static_cast<double>(i) + 0.53) / kAcross; }
  static double height(std::size_t k) { return kLowest + (kHighest - kLowest) * (static_cast<double>(k) + 0.5) / kUp; }

  static bool is_inside(int mode, int sign, const Vector& p) {
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
};

TEST(AspectsInSpace, OfALinearDeltaAreThoseOfAFloodFill) {
  solve::Control control;
  const Aspects found = aspects({.model = linear_delta()}, {}, control);
  ASSERT_TRUE(found.reason.empty()) << found.reason;
  ASSERT_TRUE(found.aspects.exact()) << found.aspects.reason;
  ASSERT_TRUE(found.working_modes.exact()) << found.working_modes.reason;
  std::size_t counted = 0, modes = 0;
  for (int mode = 0; mode < 8; ++mode) {
    modes += FloodFill::pieces(mode, 0);
    for (const int sign : {-1, 1}) counted += FloodFill::pieces(mode, sign);
  }
  EXPECT_EQ(counted, 14U);
  EXPECT_EQ(modes, 8U);
  EXPECT_EQ(static_cast<std::size_t>(found.aspects.at_least), counted);
  EXPECT_EQ(static_cast<std::size_t>(found.working_modes.at_least), modes);
  EXPECT_TRUE(found.assembly_modes.exact()) << found.assembly_modes.reason;
  EXPECT_EQ(found.assembly_modes.at_least, 2);
}

}  // namespace
}  // namespace corank::analyze
