// Pieces between singularities, counted by hand or by the geometry of the mechanism.
#include "corank/analyze/aspects.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

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
  EXPECT_EQ(a.aspects.at_least, 10);
  EXPECT_GE(a.aspects.at_most.value_or(10), 10);
  EXPECT_EQ(a.forward_factors.size(), 1u);
  EXPECT_EQ(a.inverse_factors.size(), 2u);
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
