// Sets of corank 2, solved as sets of their own, against planted truth: nothing may be lost, and what is claimed must be so.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "corank/certify/exact_verification.h"
#include "corank/check/checker.h"
#include "corank/solve/exactness/corank_system.h"
#include "corank/solve/exactness/exactness.h"
#include "corank/solve/search/solve.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/symbolic/sets/kernel_scale.h"
#include "corank/symbolic/sets/singularity_system.h"
#include "corank/tests/models/exactly_solved.h"

namespace corank {
namespace {
using symbolic::SingularitySet;
using test::exactly_solved;
using test::holds;

System system_of(const std::string& model, SingularitySet set, int corank = 2) {
  const symbolic::Mechanism mechanism = symbolic::parse_model(model, "model.cuik");
  return symbolic::algebrize(
      symbolic::singularity_system(mechanism, set, std::nullopt, symbolic::kernel_scales(mechanism, set), corank));
}

std::size_t boxes_with(const Cover& cover, const std::vector<double>& q) {
  return static_cast<std::size_t>(
      std::count_if(cover.boxes.begin(), cover.boxes.end(), [&](const CoverBox& b) { return holds(b, q); }));
}

// Every box is near one of the configurations.
void expect_near(const Cover& cover, const std::vector<std::vector<double>>& all, double slack) {
  for (const CoverBox& box : cover.boxes)
    EXPECT_TRUE(std::any_of(all.begin(), all.end(), [&](const auto& q) { return holds(box, q, slack); }));
}

void expect_accepted(const System& system, const Cover& cover) {
  const auto report = check::check(system, cover, {});
  EXPECT_TRUE(report.failures.empty()) << report.failures[0].reason;
}

// The second-smallest singular value of M in the middle of a box, relative to the largest.
double second_value(const System& system, const CoverBox& box) {
  std::vector<double> x;
  for (const auto& side : box.box) x.push_back(side.mid());
  const std::vector<double> s = solve::singular_values(certify::kernel_matrix(system), x);
  return s[s.size() - 2] / s[0];
}

std::string number(int x) { return x < 0 ? "(" + std::to_string(x) + ")" : std::to_string(x); }

// v_i = f_i(y) with quadratic f_i and inputs v: L_y = ∂f/∂y is any matrix of linear forms with symmetric coefficients of
// each row. Planted: at y0 its four rows are combinations of two.
struct Quadratics {
  std::string model;
  std::vector<double> y0;
};

Quadratics quadratics(unsigned seed) {
  std::mt19937 random(seed);
  const auto draw = [&](int most) { return std::uniform_int_distribution<int>(-most, most)(random); };
  std::array<int, 4> y0{};
  std::array<std::array<int, 4>, 4> rows{};
  for (int& c : y0) c = draw(5);
  rows[0] = {1, 0, draw(3), draw(3)};
  rows[1] = {0, 1, draw(3), draw(3)};
  for (std::size_t i = 2; i < 4; ++i) {
    const int a = draw(3), b = draw(3);
    for (std::size_t j = 0; j < 4; ++j) rows[i][j] = a * rows[0][j] + b * rows[1][j];
  }
  Quadratics result;
  std::string variables, equations, inputs, outputs;
  for (std::size_t i = 0; i < 4; ++i) {
    const std::string k = std::to_string(i + 1);
    variables += "y" + k + " : [" + std::to_string(y0[i] * 10 - 2) + "/100, " + std::to_string(y0[i] * 10 + 3) + "/100]\nv" +
                 k + " : [-1000, 1000]\n";
    inputs += (i > 0 ? ", v" : "v") + k;
    outputs += (i > 0 ? ", y" : "y") + k;
    result.y0.push_back(y0[i] / 10.0);
    std::string f;
    for (std::size_t a = 0; a < 4; ++a) {
      const auto shifted = [&](std::size_t j) { return "(y" + std::to_string(j + 1) + " - " + number(y0[j]) + "/10)"; };
      f += " + " + number(rows[i][a]) + "*" + shifted(a);
      for (std::size_t b = a; b < 4; ++b) f += " + " + number(draw(4)) + "*" + shifted(a) + "*" + shifted(b);
    }
    equations += "v" + k + " = 0" + f + ";\n";
  }
  result.model =
      "[SYSTEM VARS]\n" + variables + "[SYSTEM EQS]\n" + equations + "[INPUTS] " + inputs + "\n[OUTPUTS] " + outputs + "\n";
  return result;
}

TEST(CorankTwo, IsolatedConfigurationsOfGenericMatricesAreProven) {
  std::size_t lost = 0, isolated = 0;
  for (unsigned seed = 1; seed <= 2; ++seed) {
    const Quadratics planted = quadratics(seed);
    const System system = system_of(planted.model, SingularitySet::forward);
    ASSERT_EQ(system.equations.size(), system.variables.size())
        << "a mechanism of mobility 4: as many equations as unknowns";
    const Cover cover = exactly_solved(system);
    EXPECT_TRUE(cover.complete());
    std::vector<std::size_t> y;
    for (int i = 1; i <= 4; ++i) y.push_back(static_cast<std::size_t>(system.find("y" + std::to_string(i))));
    const auto here = [&](const CoverBox& b) {
      for (std::size_t i = 0; i < 4; ++i)
        if (planted.y0[i] < b.box[y[i]].lo() - 1e-12 || planted.y0[i] > b.box[y[i]].hi() + 1e-12) return false;
      return true;
    };
    lost += std::none_of(cover.boxes.begin(), cover.boxes.end(), here);
    for (const CoverBox& b : cover.boxes) {
      if (b.verdict != Verdict::isolated) continue;
      ++isolated;
      EXPECT_LT(second_value(system, b), 1e-9) << seed;
      EXPECT_EQ(b.kernel_at_most, 2);
    }
    expect_accepted(system, cover);
  }
  EXPECT_EQ(lost, 0u);
  EXPECT_EQ(isolated, 2u);
}

// v_i = a_i P(y1) + b_i Q(y2): corank 2 where P′ = Q′ = 0, with the zeros planted. Two unknowns for four conditions:
// over-determined.
TEST(CorankTwo, ConfigurationsWhereAllDerivativesVanishAreFoundAndNoOthers) {
  std::mt19937 random(11);
  for (int trial = 0; trial < 8; ++trial) {
    const auto draw = [&](int least, int most) { return std::uniform_int_distribution<int>(least, most)(random); };
    const std::array<int, 2> p{draw(-9, -1), draw(1, 9)}, q{draw(-9, -1), draw(1, 9)};
    const auto cubic = [](const std::string& y, const std::array<int, 2>& zeros) {  // derivative (y − z1)(y − z2), in tenths
      return "(" + y + "^3/3 - " + number(zeros[0] + zeros[1]) + "/20*" + y + "^2 + " + number(zeros[0] * zeros[1]) +
             "/100*" + y + ")";
    };
    const std::string model =
        "[SYSTEM VARS]\ny1 : [-2, 2]\ny2 : [-2, 2]\nv1 : [-90, 90]\nv2 : [-90, 90]\n[SYSTEM EQS]\nv1 = " +
        number(draw(1, 3)) + "*" + cubic("y1", p) + " + " + cubic("y2", q) + ";\nv2 = " + number(draw(-3, -1)) + "*" +
        cubic("y1", p) + " + " + cubic("y2", q) + ";\n[INPUTS] v1, v2\n[OUTPUTS] y1, y2\n";
    const System system = system_of(model, SingularitySet::forward);
    const Cover cover = exactly_solved(system);
    EXPECT_TRUE(cover.complete());
    std::vector<std::vector<double>> all;
    for (const int a : p)
      for (const int b : q) all.push_back({a / 10.0, b / 10.0});
    for (const auto& configuration : all) EXPECT_GE(boxes_with(cover, configuration), 1u);
    expect_near(cover, all, 1e-4);
    EXPECT_EQ(cover.exact_points.size(), 4u);
    for (const auto& point : cover.exact_points) EXPECT_EQ(point.corank, 2);
    expect_accepted(system, cover);
  }
}

// r cos t + l cos p = x, r sin t + l sin p = 0, side by side: with x locked a slider-crank is singular where it is straight,
// t, p ∈ {0, π}.
std::string sliders(const std::array<int, 4>& bars) {
  std::string variables, equations;
  for (std::size_t i = 0; i < 2; ++i) {
    const std::string k = std::to_string(i + 1), r = number(bars[2 * i]), l = number(bars[2 * i + 1]);
    variables += "t" + k + " ~ [-pi, pi]\np" + k + " ~ [-pi, pi]\nx" + k + " : [-30, 30]\n";
    equations += r + "*cos(t" + k + ") + " + l + "*cos(p" + k + ") = x" + k + ";\n" + r + "*sin(t" + k + ") + " + l +
                 "*sin(p" + k + ") = 0;\n";
  }
  return "[SYSTEM VARS]\n" + variables + "[SYSTEM EQS]\n" + equations + "[INPUTS] x1, x2\n[OUTPUTS] t1, t2\n";
}

std::vector<std::vector<double>> straight_twice(const std::array<int, 4>& bars) {
  std::vector<std::vector<double>> all;
  for (int s = 0; s < 16; ++s) {
    std::vector<double> q;
    for (std::size_t i = 0; i < 2; ++i) {
      const double t = (s >> (2 * i)) % 2 ? 1 : -1, p = (s >> (2 * i + 1)) % 2 ? 1 : -1;
      q.insert(q.end(), {t, 0, p, 0, t * bars[2 * i] + p * bars[2 * i + 1]});
    }
    all.push_back(q);
  }
  return all;
}

TEST(CorankTwo, OfTwoSliderCranksSideBySideIsTheProductOfTheirSingularities) {
  for (const std::array<int, 4> bars : {std::array{1, 2, 3, 4}, std::array{5, 3, 2, 7}}) {
    const System system = system_of(sliders(bars), SingularitySet::forward);
    const Cover cover = exactly_solved(system);
    EXPECT_TRUE(cover.complete());
    const auto all = straight_twice(bars);
    for (const auto& q : all) EXPECT_GE(boxes_with(cover, q), 1u);
    expect_near(cover, all, 1e-3);
    EXPECT_EQ(cover.exact_points.size(), 16u) << "each is named exactly";
    std::size_t with_point = 0;
    for (const CoverBox& point : cover.points) with_point += point.point >= 0;
    EXPECT_GE(with_point, 16u);
    expect_accepted(system, cover);
  }
}

// x = cos t + cos p, 0 = sin t + sin p: with equal bars C-space crosses itself where both stand upright; two of these side
// by side.
TEST(CorankTwo, OfCSpaceIsWhereTwoPartsCrossThemselvesAtOnce) {
  const System system = system_of(sliders({1, 1, 2, 2}), SingularitySet::cspace_singular);
  const Cover cover = exactly_solved(system);
  EXPECT_TRUE(cover.complete());
  std::vector<std::vector<double>> all;
  for (const double a : {1.0, -1.0})
    for (const double b : {1.0, -1.0}) all.push_back({0, a, 0, -a, 0, 0, b, 0, -b, 0});
  for (const auto& q : all) EXPECT_GE(boxes_with(cover, q), 1u);
  expect_near(cover, all, 1e-3);
  EXPECT_EQ(cover.exact_points.size(), 4u);
  expect_accepted(system, cover);
}

// Both arms of Dextar straight: the two points at distance l2 + l3 and l4 + l5 of the motors.
TEST(CorankTwo, OfDextarsInverseKinematicsIsBothArmsStretched) {
  const symbolic::Mechanism dextar = symbolic::read_model(CORANK_SOURCE_DIR "/models/dextar.cuik");
  const System system =
      symbolic::algebrize(symbolic::singularity_system(dextar, SingularitySet::inverse, std::nullopt, {}, 2));
  const Cover cover = exactly_solved(system);
  EXPECT_TRUE(cover.complete());
  const double x = 0.59, y = std::sqrt(1.8 * 1.8 - x * x);
  EXPECT_GE(boxes_with(cover, {x, y}), 1u);
  EXPECT_GE(boxes_with(cover, {x, -y}), 1u);
  expect_near(cover, {{x, y}, {x, -y}}, 1e-4);
  expect_accepted(system, cover);
}

// Three equal legs from cranks to one point, at a fixed height: where cos t = −R/L the cranks' ends meet on the axis, and
// the point moves on a circle about it. All legs are then one, and the rows of L_y with them: a curve of corank 2 where
// C-space is a surface.
TEST(CorankTwo, OfThreeLegsInOneIsACurveProvenWithItsDimension) {
  std::string equations;
  for (int i = 1; i <= 3; ++i) {
    const std::string t = "t" + std::to_string(i), turn = std::to_string(2 * (i - 1)) + "*pi/3";
    equations += "(x - (3/10 + 1/2*cos(" + t + "))*cos(" + turn + "))^2 + (y - (3/10 + 1/2*cos(" + t + "))*sin(" + turn +
                 "))^2 + (z + 1/2*sin(" + t + "))^2 = 36/25;\n";
  }
  const System system = system_of(
      "[SYSTEM VARS]\nx : [-2, 2]\ny : [-2, 2]\nz : [-1, -1]\nt1 ~ [-pi, pi]\nt2 ~ [-pi, pi]\nt3 ~ [-pi, pi]\n[SYSTEM "
      "EQS]\n" +
          equations + "[INPUTS] t1, t2, t3\n[OUTPUTS] x, y, z\n",
      SingularitySet::forward);
  EXPECT_GT(system.equations.size(), system.variables.size());
  const Cover cover = exactly_solved(system);
  EXPECT_TRUE(cover.complete());
  ASSERT_EQ(cover.self_motions.size(), 1u) << "each is named once";
  EXPECT_EQ(cover.self_motions[0].dimension, 1);
  const double radius = std::sqrt(1.44 - 0.36);
  int proven = 0, lost = 0;
  constexpr int kSamples = 1000;
  for (int k = 0; k < kSamples; ++k) {
    const double turn = 2 * std::numbers::pi * (k + 0.3) / kSamples;
    const std::vector<double> q{radius * std::cos(turn), radius * std::sin(turn), -1, -0.6, 0.8, -0.6, 0.8, -0.6, 0.8};
    lost += boxes_with(cover, q) == 0;
    proven += std::any_of(cover.boxes.begin(), cover.boxes.end(),
                          [&](const CoverBox& b) { return b.verdict == Verdict::regular && holds(b, q); });
  }
  EXPECT_EQ(lost, 0);
  EXPECT_GT(proven, kSamples * 9 / 10);
  for (const CoverBox& b : cover.boxes) {
    if (b.verdict != Verdict::regular) continue;
    EXPECT_EQ(b.free.size(), 1u);
    EXPECT_NEAR(std::hypot(b.box[0].mid(), b.box[1].mid()), radius, 0.05);
    EXPECT_NEAR(b.box[3].mid(), -0.6, 1e-9);
    EXPECT_EQ(b.kernel_at_most, 2);
  }
  expect_accepted(system, cover);
}

// What corank 1 has at the configurations of corank 2 is a continuum; each of them is met by corank 2, too, and the reverse.
TEST(CorankTwo, IsInsideTheSetOfCorankOne) {
  const std::array<int, 4> bars{1, 2, 3, 4};
  const Cover one = exactly_solved(system_of(sliders(bars), SingularitySet::forward, 1));
  for (const auto& q : straight_twice(bars)) EXPECT_GE(boxes_with(one, q), 1u);
}

TEST(CorankTwo, TamperedBoxesAreRefused) {
  const System system = system_of(sliders({1, 2, 3, 4}), SingularitySet::forward);
  const Cover all = exactly_solved(system);
  const auto box = std::find_if(all.boxes.begin(), all.boxes.end(),
                                [](const CoverBox& b) { return b.verdict == Verdict::undecided && b.point >= 0; });
  ASSERT_NE(box, all.boxes.end());
  const int named = box->point;
  Cover cover = all;  // this box and its point alone: to check the others as often would take long
  cover.boxes = {*box};
  std::erase_if(cover.points, [&](const CoverBox& p) { return p.point != named; });
  cover.exact_points = {all.exact_points[static_cast<std::size_t>(named)]};
  cover.boxes[0].point = 0;
  for (CoverBox& p : cover.points) p.point = 0;
  const auto refused = [&](const Cover& changed) { return !check::check(system, changed, {}).failures.empty(); };
  ASSERT_FALSE(refused(cover));
  Cover changed = cover;
  changed.boxes[0].kernel_at_most = 1;  // a smaller kernel than the box has
  EXPECT_TRUE(refused(changed));
  changed = cover;
  changed.exact_points[0].corank = 3;
  EXPECT_TRUE(refused(changed));
  changed = cover;
  changed.exact_points[0].corank = 1;
  EXPECT_TRUE(refused(changed));
  changed = cover;  // cos t1 = ±1 is left out
  const auto side = changed.boxes[0].box[0];
  changed.boxes[0].box[0] = side.mid() > 0 ? Interval(0.5, 0.75) : Interval(-0.75, -0.5);
  EXPECT_TRUE(refused(changed));
  changed = cover;  // an undecided box with a known configuration is no proof that there is exactly one solution
  changed.boxes[0].verdict = Verdict::exact;
  EXPECT_TRUE(refused(changed));
  changed = cover;  // one slider-crank is not straight
  auto& point = changed.exact_points[0];
  point.coordinates[0] = {ExactNumber::rational("3/5")};
  point.coordinates[1] = {ExactNumber::rational("4/5")};
  EXPECT_TRUE(refused(changed));
}

}  // namespace
}  // namespace corank
