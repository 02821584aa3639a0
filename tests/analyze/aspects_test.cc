// Pieces between singularities, counted by hand or by the geometry of the mechanism.
#include "corank/analyze/aspects.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "corank/certify/angle.h"
#include "corank/study/model.h"
#include "corank/symbolic/model_file.h"

namespace corank::analyze {
namespace {

Aspects of(symbolic::Mechanism model) {
  solve::Control control;
  return aspects({.model = std::move(model)}, {}, control);
}

Aspects of_model(const std::string& name) {
  return of(study::read_model(std::string(CORANK_SOURCE_DIR) + "/models/" + name + ".cuik").mechanism);
}

// |y_A| and |y_B| are √(1 − x_C²) and √(16/25 − x_C²) on two closed curves; det L_y = 0 where x_C y_B = 0, det L_z = 0
// where x_C y_A = 0, which for y_A is never so. 8 forward singularities on 2 closed curves leave 8 arcs, 4 inverse ones 4.
TEST(Aspects, OfTheThreeSlidersAreArcs) {
  const Aspects a = of_model("three_slider");
  ASSERT_TRUE(a.aspects.exact() && a.assembly_modes.exact() && a.working_modes.exact());
  EXPECT_EQ(a.aspects.at_least, 8);
  EXPECT_EQ(a.assembly_modes.at_least, 8);
  EXPECT_EQ(a.working_modes.at_least, 4);
}

// C-space is two closed curves where the linkage is of Grashof's kind, else one. A crank has no dead points: the other
// link's four (two on each curve) divide the curves.
TEST(Aspects, OfFourBarsAreThoseOfTheirGrashofType) {
  struct Case {
    const char* model;
    int aspects;
  };
  for (const auto& [model, count] :
       {Case{"crank_rocker", 4}, Case{"double_crank", 2}, Case{"double_rocker", 8}, Case{"triple_rocker", 4}}) {
    SCOPED_TRACE(model);
    const Aspects a = of_model(std::string("planar/four_bar_") + model);
    ASSERT_TRUE(a.aspects.exact());
    EXPECT_EQ(a.aspects.at_least, count);
  }
}

// A five-bar has two sides of J2, J4 on which J3 may be, and each arm two postures.
TEST(Aspects, OfDextarHaveTheModesOfAFiveBar) {
  const Aspects a = of_model("dextar");
  ASSERT_TRUE(a.assembly_modes.exact() && a.working_modes.exact());
  EXPECT_EQ(a.assembly_modes.at_least, 2);
  EXPECT_EQ(a.working_modes.at_least, 4);
  EXPECT_EQ(a.forward_factors.size(), 1u);
  EXPECT_EQ(a.inverse_factors.size(), 2u);
}

// Within a working mode the place of J3 says the configuration: the pieces of a grid of places, without those so near to a
// singularity that the grid does not show on which side they are.
TEST(Aspects, OfDextarAreThoseOfAFloodFill) {
  constexpr int kRows = 900;
  constexpr double kStep = 4.0 / kRows, l = 0.9, d = 1.18;
  const auto elbow = [&](double center, double sign, double x, double y) {
    const double r = std::hypot(x - center, y), h = std::sqrt(std::max(l * l - r * r / 4, 0.0)) / r;
    return std::array{center + (x - center) / 2 - sign * h * y, y / 2 + sign * h * (x - center), r};
  };
  int pieces = 0;
  for (const double left : {-1.0, 1.0})
    for (const double right : {-1.0, 1.0}) {
      std::vector<int> side(kRows * kRows, 0);  // of J3 to J4 and J2
      for (int i = 0; i < kRows; ++i)
        for (int j = 0; j < kRows; ++j) {
          const double x = d / 2 - 2 + (i + 0.5) * kStep, y = -2 + (j + 0.5) * kStep;
          const auto [ax, ay, a] = elbow(0, left, x, y);
          const auto [bx, by, b] = elbow(d, right, x, y);
          const double area = (x - ax) * (y - by) - (y - ay) * (x - bx);
          if (std::min(a, b) > 3 * kStep && std::max(a, b) < 2 * l) side[i * kRows + j] = area > 0 ? 1 : -1;
        }
      std::vector<int> stack;
      for (int start = 0; start < kRows * kRows; ++start) {
        const int sign = std::exchange(side[start], 0);
        if (sign == 0) continue;
        int size = 0;
        for (stack.push_back(start); !stack.empty(); ++size) {
          const int at = stack.back();
          stack.pop_back();
          for (const int to : {at - 1, at + 1, at - kRows, at + kRows})  // the grid's border is out of reach
            if (side[to] == sign) side[to] = 0, stack.push_back(to);
        }
        pieces += size > 50;
      }
    }
  EXPECT_EQ(pieces, 10);
  const Aspects a = of_model("dextar");
  ASSERT_TRUE(a.aspects.exact()) << a.aspects.reason;
  EXPECT_EQ(a.aspects.at_least, pieces);
}

// Straight lines on the torus of v and w: two of v + k w = ±π/2 and two of v − m w = ±π/2, which meet in 4 (k + m) points,
// divide it into as many pieces (Euler).
TEST(Aspects, OfLinesThatCrossOnATorusAreItsFaces) {
  for (const auto& [k, m] : {std::pair(1, 0), {1, 1}, {1, 2}, {2, 1}}) {
    SCOPED_TRACE(k * 10 + m);
    const auto line = [](int c) { return std::to_string(c) + "*w"; };
    const Aspects a = of(symbolic::parse_model("[SYSTEM VARS]\nv ~ [-pi, pi]\nw ~ [-pi, pi]\nx : [-2, 2]\ny : [-2, 2]\n"
                                               "[SYSTEM EQS]\nx = sin(v + " +
                                                   line(k) + ");\ny = sin(v - " + line(m) +
                                                   ");\n[INPUTS] v, w\n[OUTPUTS] x, y\n",
                                               "lines.cuik"));
    ASSERT_TRUE(a.aspects.exact()) << a.reason << a.aspects.reason;
    EXPECT_EQ(a.aspects.at_least, 4 * (k + m));
    EXPECT_EQ(a.assembly_modes.at_least, 1);
  }
}

TEST(Aspects, OfTheSphericalFiveBarAreCounted) {
  const Aspects a = of_model("spherical_five_bar");
  ASSERT_TRUE(a.aspects.exact()) << a.aspects.reason;
  EXPECT_EQ(a.aspects.at_least, 10);
}

// Each is a configuration, and has the signs that are said of it.
TEST(Aspects, AreRepresentedByConfigurations) {
  const Aspects a = of_model("dextar");
  ASSERT_EQ(a.aspects.representatives.size(), a.aspects.signs.size());
  for (std::size_t k = 0; k < a.aspects.signs.size(); ++k) {
    std::map<std::string, double> q;
    const Box& box = a.aspects.representatives[k];
    for (const Angle& angle : a.system.angles)
      q[angle.name] =
          std::atan2(box[static_cast<std::size_t>(angle.sine)].mid(), box[static_cast<std::size_t>(angle.cosine)].mid());
    const double l = 0.9, d = 1.18;
    EXPECT_NEAR(d + l * (cos(q["theta2"]) + cos(q["theta3"]) + cos(q["theta4"]) - cos(q["theta5"])), 0, 1e-9);
    EXPECT_NEAR(l * (sin(q["theta2"]) + sin(q["theta3"]) + sin(q["theta4"]) - sin(q["theta5"])), 0, 1e-9);
    EXPECT_GT(std::abs(sin(q["theta3"] - q["theta4"]) * sin(q["theta2"] - q["theta3"]) * sin(q["theta4"] - q["theta5"])),
              1e-9);
  }
}

TEST(Aspects, AreNotCountedWhereCSpaceCrossesItself) {
  symbolic::Mechanism equal = symbolic::read_model(CORANK_SOURCE_DIR "/models/three_slider.cuik");
  equal.set_constant("L2", 1);
  const Aspects a = of(equal);
  EXPECT_FALSE(a.reason.empty());
  EXPECT_EQ(a.aspects.at_least, 0);
}

// A graph u = p(v) over a circle of v, a curve: p's critical points are the inverse singularities, and the arcs between
// them the working modes.
TEST(Aspects, OfPlantedCurvesAreTheirMonotoneArcs) {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> harmonic(1, 4);
  for (int k = 0; k < 8; ++k) {
    const int n = harmonic(random);
    const symbolic::Mechanism m =
        symbolic::parse_model("[SYSTEM VARS]\nv ~ [-pi, pi]\nu : [-2, 2]\n[SYSTEM EQS]\nu = sin(" + std::to_string(n) +
                                  "*v + 1/" + std::to_string(k + 2) + ");\n[INPUTS] v\n[OUTPUTS] u\n",
                              "wave.cuik");
    const Aspects a = of(m);
    ASSERT_TRUE(a.working_modes.exact() && a.assembly_modes.exact()) << n;
    EXPECT_EQ(a.working_modes.at_least, 2 * n);
    EXPECT_EQ(a.assembly_modes.at_least, 1);
    EXPECT_EQ(a.aspects.at_least, 2 * n);
  }
}

}  // namespace
}  // namespace corank::analyze
