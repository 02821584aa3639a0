// Areas of workspaces between their bounds, against samples and closed forms.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <random>

#include "corank/analyze/maps/area_by_boundary.h"
#include "corank/result/files/verification.h"
#include "corank/study/answer.h"
#include "corank/study/model.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/tests/seeds.h"

namespace corank {
namespace {

using Eigen::Vector2d;
constexpr double kPi = std::numbers::pi;

// An angle as the limits count it.
double wrapped(double t) { return std::remainder(t, 2 * kPi); }

study::Question about_boundary(symbolic::Mechanism model) {
  return {.model = std::move(model), .set = symbolic::SingularitySet::boundary};
}

// The area by samples on a grid, wrong by less than the cells along the boundary.
double sampled_area(double reach, int n, const std::function<bool(const Vector2d&)>& reaches) {
  int inside = 0;
  const double step = 2 * reach / n;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) inside += reaches({-reach + (i + 0.5) * step, -reach + (j + 0.5) * step});
  return inside * step * step;
}

TEST(WorkspaceArea, IsBetweenItsBounds) {
  const symbolic::Mechanism arm = symbolic::read_model(CORANK_SOURCE_DIR "/models/planar/arm_2r_limits.cuik");
  const double sampled = sampled_area(2, 800, [](const Vector2d& p) {
    const double c = (p.squaredNorm() - 1.64) / 1.6;
    if (std::fabs(c) > 1) return false;
    for (const double t2 : {std::acos(c), -std::acos(c)}) {
      const double t1 = wrapped(std::atan2(p[1], p[0]) - std::atan2(0.8 * std::sin(t2), 1 + 0.8 * std::cos(t2)));
      if (t2 >= -kPi / 4 && t2 <= 3 * kPi / 4 && t1 >= -kPi / 6 && t1 <= kPi / 2) return true;
    }
    return false;
  });
  const System system = symbolic::configurations(arm);
  analyze::AreaBounds before{0, 100, 0};
  for (const std::size_t cells : {200u, 800u, 3200u}) {
    const analyze::AreaBounds bounds = analyze::workspace_area(system, 0, 1, {.max_cells = cells});
    EXPECT_LT(bounds.lo, sampled * 1.002);
    EXPECT_GT(bounds.hi, sampled * 0.998);
    EXPECT_GE(bounds.lo, before.lo);
    EXPECT_LE(bounds.hi, before.hi);
    before = bounds;
  }
  EXPECT_GT(before.lo, 0.6 * before.hi);
}

TEST(WorkspaceArea, IsKnownByItsBoundary) {
  solve::Control control;
  const symbolic::Mechanism arm = symbolic::read_model(CORANK_SOURCE_DIR "/models/planar/arm_2r_limits.cuik");
  const auto bounds = analyze::area_by_boundary(about_boundary(arm), {}, control);
  ASSERT_TRUE(bounds);
  EXPECT_LT(bounds->hi - bounds->lo, 0.015 * bounds->hi);
  const double sampled = 2.969;  // within 0.2 %, see above
  EXPECT_LT(bounds->lo, sampled * 1.002);
  EXPECT_GT(bounds->hi, sampled * 0.998);
}

// planar/3rpr_limits.cuik, its lengths times `unit`.
study::Question limited_platform(const std::string& unit) {
  return about_boundary(symbolic::parse_model(
      "[CONSTANTS]\nu := " + unit +
          "\n[SYSTEM VARS]\nx : [-5*u, 5*u]\ny : [-5*u, 5*u]\nphi ~ [-pi, pi]\nrho1 : [0, 4*u]\nrho2 : [0, 4*u]\n"
          "rho3 : [0, 4*u]\n[SYSTEM EQS]\n(x/u - cos(phi) + 1)^2 + (y/u - sin(phi))^2 = (rho1/u)^2;\n"
          "(x/u - cos(phi) - 1)^2 + (y/u - sin(phi))^2 = (rho2/u)^2;\n"
          "(x/u + cos(phi) - 2)^2 + (y/u + sin(phi))^2 = (rho3/u)^2;\n[OUTPUTS] x, y\n[LIMITS]\n"
          "rho1 : [sqrt(2)*u, 2*u]\nrho2 : [sqrt(2)*u, 2*u]\nrho3 : [u, 3*u]\n",
      "platform.cuik"));
}

TEST(Boundary, HasTheSameBarriersAndAreaInEveryUnitOfLength) {
  std::map<Passage, double> first;
  for (const auto& [text, unit] : {std::pair("1", 1.0), {"1000000", 1e6}, {"1/1000", 1e-3}}) {
    if (unit < 1 && !test::long_run()) break;
    const study::Question question = limited_platform(text);
    const result::Result result = study::answer(question);
    EXPECT_TRUE(result.cover.complete());
    std::map<Passage, double> count;
    for (const CoverBox& box : result.cover.boxes) ++count[box.passage];
    if (first.empty()) first = count;
    EXPECT_GT(count[Passage::barrier], 1000);
    EXPECT_GT(count[Passage::traversable], 1000);
    for (const auto& [passage, boxes] : first) EXPECT_NEAR(count[passage], boxes, 0.02 * boxes + 4) << text;
    if (unit != 1) {
      EXPECT_TRUE(result::verify(result).verified()) << text;
    }
    solve::Control control;
    const auto area = analyze::area_by_boundary(question, {}, control);
    ASSERT_TRUE(area);
    EXPECT_GT(area->lo / (unit * unit), 4.09) << text;
    EXPECT_LT(area->hi / (unit * unit), 4.19) << text;
  }
}

// Annular sectors by closed form: t2 in [0, b] makes the elbow's side one, so outputs are (r, angle) one to one.
TEST(WorkspaceArea, OfRandomArmsIsBetweenItsBounds) {
  std::mt19937 random(11);
  std::uniform_int_distribution<int> tenths(3, 20), degrees(20, 150);
  for (int k = 0; k < 8; ++k) {
    const double l1 = tenths(random) / 10.0, l2 = tenths(random) / 10.0;
    const int turn = degrees(random), bend = degrees(random);
    const auto number = [](double x) { return symbolic::Expression::number(std::to_string(x)); };
    symbolic::Mechanism arm("arm");
    const auto x = arm.length("x", -5, 5), y = arm.length("y", -5, 5), t1 = arm.angle("t1"), t2 = arm.angle("t2");
    using symbolic::cos, symbolic::sin;
    arm.constrain(x == number(l1) * cos(t1) + number(l2) * cos(t1 + t2));
    arm.constrain(y == number(l1) * sin(t1) + number(l2) * sin(t1 + t2));
    arm.inputs({t1, t2});
    arm.outputs({x, y});
    const auto angle = [](int of) { return symbolic::pi() * symbolic::Expression(of) / symbolic::Expression(180); };
    arm.limit("t1", symbolic::Expression(0), angle(turn));
    arm.limit("t2", symbolic::Expression(0), angle(bend));
    solve::Control control;
    const auto bounds = analyze::area_by_boundary(about_boundary(arm), {}, control);
    ASSERT_TRUE(bounds);
    // Each output has one configuration; its density is |det J| = l1 l2 sin t2.
    const double area = l1 * l2 * (turn * kPi / 180) * (1 - std::cos(bend * kPi / 180));
    EXPECT_LE(bounds->lo, area) << l1 << " " << l2 << " " << turn << " " << bend;
    EXPECT_GE(bounds->hi, area) << l1 << " " << l2 << " " << turn << " " << bend;
    EXPECT_LT(bounds->hi - bounds->lo, 0.1 * bounds->hi);
  }
}

// A range of an output cuts the workspace: its line is a boundary. An inequality is one, too.
TEST(WorkspaceArea, KnowsWhatRangesAndInequalitiesCut) {
  symbolic::Mechanism arm("arm");
  const auto x = arm.length("x", 0, 2), y = arm.length("y", -2, 2), t1 = arm.angle("t1"), t2 = arm.angle("t2");
  using symbolic::cos, symbolic::sin;
  arm.constrain(x == cos(t1) + symbolic::Expression("1/2") * cos(t2));
  arm.constrain(y == sin(t1) + symbolic::Expression("1/2") * sin(t2));
  arm.inputs({t1, t2});
  arm.outputs({x, y});
  solve::Control control;
  const auto half = analyze::area_by_boundary(about_boundary(arm), {}, control);
  ASSERT_TRUE(half);
  EXPECT_LE(half->lo, kPi);
  EXPECT_GE(half->hi, kPi);
  EXPECT_LT(half->hi - half->lo, 0.05 * kPi);
  arm.constrain(y >= symbolic::Expression(0));
  arm.constrain(cos(t2) >= symbolic::Expression(0));
  const auto quarter = analyze::area_by_boundary(about_boundary(arm), {}, control);
  ASSERT_TRUE(quarter);
  // The points p for which some c on the unit circle has |p − c| = 1/2 and c_x ≤ p_x.
  double area = 0;
  constexpr int kSteps = 2000;
  for (int i = 0; i < kSteps; ++i)
    for (int k = 0; k < kSteps; ++k) {
      const double px = 1.5 * (i + 0.5) / kSteps, py = 1.5 * (k + 0.5) / kSteps, r2 = px * px + py * py;
      bool is_in = false;
      const double along = (r2 + 0.75) / 2, across2 = r2 - along * along;  // p·c with |c| = 1, |p − c| = 1/2
      for (const double across : {std::sqrt(std::max(0.0, across2)), -std::sqrt(std::max(0.0, across2))})
        is_in = is_in || (across2 >= 0 && (along * px - across * py) / r2 <= px);
      area += is_in * 1.5 * 1.5 / kSteps / kSteps;
    }
  EXPECT_LE(quarter->lo, area);
  EXPECT_GE(quarter->hi, area);
  EXPECT_LT(quarter->hi - quarter->lo, 0.1 * area);
}

// A hand that turns about the output is in no part's system.
TEST(WorkspaceArea, IsThatWithoutIdleCoordinates) {
  const study::Model robot = study::parse_model(
      {"[LINKS]\nbase : point O (0, 0, 0)\nl1 : point E (1, 0, 0)\nl2 : point H (0.7, 0, 0)\nhand : point H (0, 0, 0)\n"
       "[JOINTS]\nrevolute sh : base O + (0, 0, 1)  l1 (0, 0, 0) + (0, 0, 1)\n"
       "revolute el : l1 E + (0, 0, 1)  l2 (0, 0, 0) + (0, 0, 1)  range [-1, 2]\n"
       "revolute wr : l2 H + (0, 0, 1)  hand H + (0, 0, 1)\n[OUTPUTS]\np : position of hand.H\n",
       "arm.cuik"});
  solve::Control control;
  const auto bounds = analyze::area_by_boundary(about_boundary(robot.mechanism), {}, control);
  ASSERT_TRUE(bounds);
  const double area = kPi * 1.4 * (1 - std::cos(2.0));
  EXPECT_LE(bounds->lo, area);
  EXPECT_GE(bounds->hi, area);
  EXPECT_LT(bounds->hi - bounds->lo, 0.05 * area);
}

TEST(WorkspaceArea, OfAnUnlimitedTwoLinkArmIsThatOfItsRing) {
  symbolic::Mechanism arm("arm");
  const auto x = arm.length("x", -2, 2), y = arm.length("y", -2, 2), t1 = arm.angle("t1"), t2 = arm.angle("t2");
  using symbolic::cos, symbolic::sin, symbolic::Expression;
  arm.constrain(x == cos(t1) + Expression("1/2") * cos(t2));
  arm.constrain(y == sin(t1) + Expression("1/2") * sin(t2));
  const analyze::AreaBounds bounds = analyze::workspace_area(symbolic::configurations(arm), 0, 1, {.max_cells = 3000});
  EXPECT_LT(bounds.lo, 2 * kPi);
  EXPECT_GT(bounds.hi, 2 * kPi);
  EXPECT_GT(bounds.lo, 0.7 * 2 * kPi);
  EXPECT_LT(bounds.hi, 1.2 * 2 * kPi);
}

TEST(WorkspaceArea, OfNothingIsZero) {
  symbolic::Mechanism none("none");
  const auto x = none.length("x", -2, 2), y = none.length("y", -2, 2), t = none.angle("t");
  none.constrain(x == symbolic::Expression(3) + symbolic::cos(t) / symbolic::Expression(2));
  none.constrain(y == symbolic::sin(t));
  const analyze::AreaBounds bounds = analyze::workspace_area(symbolic::configurations(none), 0, 1);
  EXPECT_EQ(bounds.lo, 0);
  EXPECT_EQ(bounds.hi, 0);
}

TEST(WorkspaceArea, EndsWhenItIsAskedTo) {
  const symbolic::Mechanism arm = symbolic::read_model(CORANK_SOURCE_DIR "/models/planar/arm_2r_limits.cuik");
  const analyze::AreaBounds bounds =
      analyze::workspace_area(symbolic::configurations(arm), 0, 1, {.stop = [] { return true; }});
  EXPECT_EQ(bounds.cells, 0u);
  EXPECT_EQ(bounds.lo, 0);
  EXPECT_GT(bounds.hi, 2.9);
}

}  // namespace
}  // namespace corank
