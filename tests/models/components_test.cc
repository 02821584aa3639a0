// Outputs that are some components of a point's position, against closed forms.
#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "corank/tests/models/planar_parts.h"

namespace corank {
namespace {
using symbolic::SingularitySet;
using test::Configuration;

// x = cos θ ± √(9 − sin² θ), whose derivative is 0 where sin θ = 0, and nowhere infinite.
TEST(Components, OfAPointOfARodStandStillAtItsDeadCentres) {
  const study::Model model = study::parse_model({R"([LINKS]
    ground
    crank  : point A (1, 0, 0)
    rod    : point P (3, 0, 0)
    slider
    [JOINTS]
    revolute theta : ground (0, 0, 0) + (0, 0, 1)  crank (0, 0, 0) + (0, 0, 1)  actuated
    revolute A     : crank A + (0, 0, 1)           rod (0, 0, 0) + (0, 0, 1)
    revolute P     : rod P + (0, 0, 1)             slider (0, 0, 0) + (0, 0, 1)
    prismatic s    : ground (0, 0, 0) + (1, 0, 0)  slider (0, 0, 0) + (1, 0, 0)
    [OUTPUTS]
    p : position of rod.P  only x)",
                                                 "slider.cuik"});
  EXPECT_EQ(model.mechanism.outputs(), std::vector<std::string>{"p_x"});
  const double pi = std::numbers::pi;
  std::vector<Configuration> centres;
  for (const double theta : {0.0, pi})
    for (const double phi : {0.0, pi}) {
      const double x = std::cos(theta) + 3 * std::cos(phi);
      centres.push_back({{"theta", theta}, {"phi_rod", phi}, {"s", x}, {"p_x", x}});
    }
  const System inverse = test::set_of(model.mechanism, SingularitySet::inverse);
  test::expect_points(inverse, solve::solve(inverse), centres);
  const System forward = test::set_of(model.mechanism, SingularitySet::forward);
  test::expect_points(forward, solve::solve(forward), {});
}

// Hand at (1 + 2 cos t)(cos p, sin p) and −2 sin t above: det ∂(x, y)/∂(p, t) = 2 sin t (1 + 2 cos t). By twists.
TEST(Components, OfAHandInSpaceHaveAVelocityEquationOfTheirOwn) {
  const study::Model model = study::parse_model({R"([LINKS]
    ground
    turret : point S (1, 0, 0)
    fore   : point H (2, 0, 0)
    [JOINTS]
    revolute pan  : ground (0, 0, 0) + (0, 0, 1)  turret (0, 0, 0) + (0, 0, 1)  actuated
    revolute tilt : turret S + (0, 1, 0)          fore (0, 0, 0) + (0, 1, 0)    actuated
    [OUTPUTS]
    hand : position of fore.H  only x y)",
                                                 "arm.cuik"});
  EXPECT_EQ(model.mechanism.outputs(), (std::vector<std::string>{"hand_x", "hand_y"}));
  const System system = test::set_of(model.mechanism, SingularitySet::inverse);
  const Cover cover = test::cover_of(system, 0.1, 0.1);
  EXPECT_TRUE(cover.complete());
  std::mt19937 random(7);
  std::uniform_real_distribution<double> turn(-std::numbers::pi, std::numbers::pi);
  std::vector<Configuration> samples;
  for (const double tilt : {0.0, std::numbers::pi, 2 * std::numbers::pi / 3, -2 * std::numbers::pi / 3})
    for (int k = 0; k < 50; ++k) {
      const double pan = turn(random), reach = 1 + 2 * std::cos(tilt);
      samples.push_back({{"pan", pan},
                         {"tilt", tilt},
                         {"u_fore_x", std::cos(pan) * std::cos(tilt)},
                         {"u_fore_y", std::sin(pan) * std::cos(tilt)},
                         {"u_fore_z", -std::sin(tilt)},
                         {"hand_x", reach * std::cos(pan)},
                         {"hand_y", reach * std::sin(pan)}});
    }
  EXPECT_EQ(test::lost(system, cover, samples), 0);
  // And nowhere else.
  const Angle* tilt = nullptr;
  for (const Angle& angle : system.angles)
    if (angle.name == "tilt") tilt = &angle;
  ASSERT_NE(tilt, nullptr);
  for (const CoverBox& box : cover.boxes) {
    EXPECT_EQ(box.verdict, Verdict::regular);
    const Interval c = box.box[static_cast<std::size_t>(tilt->cosine)], s = box.box[static_cast<std::size_t>(tilt->sine)];
    EXPECT_TRUE(s.contains(0) || c.contains(-0.5));
  }
}

}  // namespace
}  // namespace corank
