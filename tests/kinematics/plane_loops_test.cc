// Loops with parallel axes on a carrier that moves in space: planted motions against the assembled robot.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "corank/kinematics/language/part_file.h"
#include "corank/tests/kinematics/assembled.h"

namespace corank::kinematics {
namespace {

using testing::HasSubstr;
using Values = std::map<std::string, double>;

std::size_t loops_of(const Assembly& a) {
  std::size_t count = 0;
  for (const symbolic::Constraint& c : a.mechanism.constraints())
    count += c.note.starts_with("loop") || c.note.starts_with("rod");
  return count;
}

/// Each velocity equation holds for these rates.
void expect_rates(const Assembly& a, const Values& values, double tolerance) {
  EXPECT_FALSE(a.mechanism.velocity_equations().empty());
  for (const symbolic::Constraint& row : a.mechanism.velocity_equations())
    EXPECT_NEAR(symbolic::evaluate(row.relation.lhs, values), symbolic::evaluate(row.relation.rhs, values), tolerance)
        << row.relation.text();
}

std::string palletizer(const std::string& rod) {
  return "[CONSTANTS]\nunit mm\n[LINKS]\nbase\ncol\nupper\ncrank\nrod\nfore\n[JOINTS]\n"
         "revolute j1 : base (0,0,0)+(0,0,1) col (0,0,0)+(0,0,1) actuated\n"
         "revolute j2 : col (260,0,565)+(0,1,0) upper (0,0,0)+(0,1,0) zero (1,0,0) (1,0,0) actuated\n"
         "revolute j3 : col (260,0,565)+(0,1,0) crank (0,0,0)+(0,1,0) zero (1,0,0) (1,0,0) actuated\n"
         "revolute elbow : upper (0,0,850)+(0,1,0) fore (0,0,0)+(0,1,0)\n" +
         rod + "[OUTPUTS]\nW : position of fore (950,0,0)\n";
}

constexpr const char* kBars =
    "revolute r1 : crank (-300,0,0)+(0,1,0) rod (0,0,0)+(0,1,0)\n"
    "revolute r2 : rod (0,0,850)+(0,1,0) fore (-300,0,0)+(0,1,0)\n";

/// Of the palletizer's hand; the forearm is parallel to the crank.
Numbers hand(double j1, double j2, double j3) {
  const double out = 260 + 850 * std::sin(j2) + 950 * std::cos(j3);
  return {out * std::cos(j1), out * std::sin(j1), 565 + 850 * std::cos(j2) - 950 * std::sin(j3)};
}

TEST(PlaneLoops, OnATurningColumnCloseByTwoEquations) {
  const Assembly a = assembled(palletizer(kBars));
  EXPECT_EQ(a.space, Space::spatial);
  EXPECT_EQ(a.mobility, 3);
  EXPECT_EQ(a.mobility_by_rank, 3);
  EXPECT_EQ(loops_of(a), 5u);  // two, which branch it is, and two conditions
  const double j[3] = {0.3, 0.4, -0.5}, w[3] = {0.7, -1.2, 0.5}, h = 1e-6;
  Values values =
      completed(a, {{"j1", j[0]}, {"j2", j[1]}, {"j3", j[2]}, {"phi_fore", j[2]}, {"phi_rod", j[1]}, {"crosswise", 0}});
  const Numbers at = hand(j[0], j[1], j[2]);
  const Numbers before = hand(j[0] - h * w[0], j[1] - h * w[1], j[2] - h * w[2]);
  const Numbers after = hand(j[0] + h * w[0], j[1] + h * w[1], j[2] + h * w[2]);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string x(1, "xyz"[i]);
    EXPECT_NEAR(values.at("W_" + x), at[i], 1e-9);
    values["w_j" + std::to_string(i + 1)] = w[i];
    values["v_W_" + x] = (after[i] - before[i]) / (2 * h);
  }
  values["w_elbow"] = w[2] - w[1];
  values["w_r1"] = w[1] - w[2];
  expect_rates(a, values, 1e-3);
  values["w_elbow"] += 1;  // what is checked can fail
  double worst = 0;
  for (const symbolic::Constraint& row : a.mechanism.velocity_equations())
    worst = std::max(worst, std::fabs(symbolic::evaluate(row.relation.lhs, values)));
  EXPECT_GT(worst, 1);
}

TEST(PlaneLoops, HaveRodsInTheirPlane) {
  const Assembly a = assembled(palletizer("fix : base rod id\nsph_sph bar : crank (-300,0,0) fore (-300,0,0) length 850\n"));
  EXPECT_EQ(a.mobility, 3);
  EXPECT_EQ(loops_of(a), 3u);  // one, which branch it is, and a condition
  completed(a, {{"j1", 0.3}, {"j2", 0.4}, {"j3", -0.5}, {"phi_fore", -0.5}, {"crosswise", 0}});
  // A rod of variable length 100 beside the plane: l² = d² + 100².
  const Assembly driven = assembled(
      palletizer("fix : base rod id\nsph_prs_sph bar : crank (-300,100,0) fore (-300,0,0) range [1, 2000] actuated\n"));
  EXPECT_EQ(driven.mobility, 4);
  const double l = std::sqrt(850. * 850 + 100. * 100);
  Values values = completed(driven, {{"j1", 0.3}, {"j2", 0.4}, {"j3", -0.5}, {"phi_fore", -0.5}, {"bar", l}});
  // About the elbow alone: the rod's rate by a difference quotient.
  const double h = 1e-6;
  const auto length = [](double phi) {
    const double x = 850 * std::sin(0.4) - 300 * std::cos(phi) + 300 * std::cos(-0.5);
    const double z = 850 * std::cos(0.4) + 300 * std::sin(phi) - 300 * std::sin(-0.5);
    return std::sqrt(x * x + z * z + 100 * 100);
  };
  EXPECT_NEAR(length(-0.5), l, 1e-9);
  for (const char* still : {"w_j1", "w_j2", "w_j3"}) values[still] = 0;
  values["w_elbow"] = 2;
  values["v_bar"] = 2 * (length(-0.5 + h) - length(-0.5 - h)) / (2 * h);
  const double slope = 950 * 2;
  values["v_W_x"] = slope * -std::sin(-0.5) * std::cos(0.3);
  values["v_W_y"] = slope * -std::sin(-0.5) * std::sin(0.3);
  values["v_W_z"] = -slope * std::cos(-0.5);
  expect_rates(driven, values, 1e-2);
}

/// Five bars on a link that a skew joint carries, in a plane of the normal (1, 2, 2)/3, at heights of their own. The bars'
/// axes are along y in their own frames.
TEST(PlaneLoops, RandomFiveBarsOnASkewCarrier) {
  std::mt19937 random(4);
  const auto uniform = [&](double from, double to) { return std::uniform_real_distribution<double>(from, to)(random); };
  const Numbers e1{2. / 3, 1. / 3, -2. / 3}, e2{-2. / 3, 2. / 3, -1. / 3}, n{1. / 3, 2. / 3, 2. / 3};
  const std::string normal = "(1,2,2)", first = "(2,1,-2)";
  for (int k = 0; k < 10; ++k) {
    const int l1 = 4 + k % 3, l2 = 5, l3 = 6, l4 = 4, base = 3, up = k % 4;
    // Base from O to O + base e1 + up n.
    const auto place = [&](double x, double h) {
      std::string text = "(";
      for (std::size_t i = 0; i < 3; ++i)
        text += (i ? "," : "") + std::to_string(static_cast<int>(std::lround(3 * (x * e1[i] + h * n[i])))) + "/3";
      return text + ")";
    };
    const std::string y = "+(0,1,0)", zero = " zero " + first + " (1,0,0)";
    const Robot robot = parse_parts(
        "[LINKS]\nground\ncarrier\na\nb\nc\nd\n[JOINTS]\n"
        "revolute tilt : ground (1,2,3)+(1,0,1) carrier (0,0,0)+(0,3,4) zero (0,1,0) (1,0,0) actuated\n"
        "revolute t1 : carrier " +
            place(0, 0) + "+" + normal + " a (0,0,0)" + y + zero +
            " actuated\n"
            "revolute t4 : d (0,0,0)" +
            y + " carrier " + place(base, up) + "+" + normal + " zero (1,0,0) " + first +
            " actuated\n"
            "revolute e : a (" +
            std::to_string(l1) + ",1,0)" + y + " b (0,0,0)" + y +
            "\n"
            "revolute f : d (" +
            std::to_string(l4) + ",0,0)" + y + " c (0,5,0)" + y +
            "\n"
            "revolute g : b (" +
            std::to_string(l2) + ",-1,0)" + y + " c (" + std::to_string(l3) + "," + std::to_string(5 - up) + ",0)" + y +
            "\n"
            "[OUTPUTS]\nG : position of b (" +
            std::to_string(l2) + ",0,0)\n",
        "r.cuik");
    const Assembly a = assemble(robot);
    EXPECT_EQ(a.mobility, 3);
    EXPECT_EQ(loops_of(a), 2u);
    // t1 counts about the normal; t4 is of the carrier seen from d, so it counts the other way.
    double t1 = 0, t4 = 0, px = 0, py = 0, qx = 0, qy = 0, distance = 0;
    do {
      t1 = uniform(-3, 3), t4 = uniform(-3, 3);
      px = l1 * std::cos(t1), py = l1 * std::sin(t1), qx = base + l4 * std::cos(t4), qy = l4 * std::sin(t4);
      distance = std::hypot(qx - px, qy - py);
    } while (distance > l2 + l3 - 0.5 || distance < l3 - l2 + 0.5);
    const double along = (l2 * l2 - l3 * l3 + distance * distance) / (2 * distance);
    const double phi_b = std::atan2(qy - py, qx - px) + std::acos(along / l2);
    const double gx = px + l2 * std::cos(phi_b), gy = py + l2 * std::sin(phi_b);
    const double phi_c = std::atan2(gy - qy, gx - qx), tilt = uniform(-3, 3);
    // Angles count from the parts' own first directions.
    Values known{{"tilt", tilt}, {"t1", t1}, {"t4", -t4}};
    const Transform carrier = joint_motion(robot.joints[0], tilt, 0);
    const Transform in_carrier{{{{e1[0], e2[0], n[0]}, {e1[1], e2[1], n[1]}, {e1[2], e2[2], n[2]}}}, {0, 0, 0}};
    // A link's frame has x along the bar and y along the normal.
    const auto link = [&](double angle, double x, double yy, double h) {
      Transform t = turn({0, 0, 1}, angle);
      t.p = {x, yy, h};
      return carrier * in_carrier * t * turn({1, 0, 0}, M_PI / 2);
    };
    // phi_b and phi_c count from a direction of the plane that is at an eighth of a turn from e1: found by the equations.
    Values best;
    double closest = 1e9;
    for (int i = 0; i < 8; ++i)
      for (int j = 0; j < 8; ++j) {
        Values trial = known;
        for (const symbolic::Constant& c : a.mechanism.constants()) trial[c.name] = symbolic::evaluate(c.value, trial);
        trial["phi_b"] = phi_b + i * M_PI / 4;
        trial["phi_c"] = phi_c + j * M_PI / 4;
        double open = 0;
        for (const symbolic::Constraint& c : a.mechanism.constraints())
          if (c.note == "loop") open = std::max(open, std::fabs(symbolic::evaluate(c.relation.lhs, trial)));
        if (open < closest) closest = open, best = trial;
      }
    EXPECT_LT(closest, 1e-9);
    const Values values = completed(a, best);
    const Transform b = pose_of(a, "b", values);
    expect_same(b, link(phi_b, px, py, 1), "b");
    const Transform d = pose_of(a, "d", values);
    expect_same(d, link(t4, base, 0, up), "d");
    const Transform c = pose_of(a, "c", values);
    expect_same(c, link(phi_c, qx, qy, up - 5), "c");
  }
}

TEST(PlaneLoops, ThatLeaveTheirPlaneCannotClose) {
  try {
    assembled(
        palletizer("revolute r1 : crank (-300,0,0)+(0,1,0) rod (0,0,0)+(0,1,0)\n"
                   "revolute r2 : rod (0,1,850)+(0,1,0) fore (-300,0,0)+(0,1,0)\n"));
    ADD_FAILURE();
  } catch (const symbolic::ModelError& error) {
    EXPECT_THAT(error.what(), HasSubstr("the loop that the joint 'r2' closes leaves its plane and can never close"));
  }
}

// A slider–crank on a turning column: the block's way closes it, and is a coordinate.
TEST(PlaneLoops, SlideToo) {
  const Assembly a = assembled(
      "[LINKS]\nbase\ncol\ncrank\nrod\nblock\n[JOINTS]\n"
      "revolute j1 : base (0,0,0)+(0,0,1) col (0,0,0)+(0,0,1) actuated\n"
      "revolute j2 : col (0,0,0)+(0,1,0) crank (0,0,0)+(0,1,0) zero (1,0,0) (1,0,0)\n"
      "revolute e : crank (1,0,0)+(0,1,0) rod (0,0,0)+(0,1,0)\n"
      "revolute f : rod (3,0,0)+(0,1,0) block (0,0,0)+(0,1,0)\n"
      "prismatic s : col (0,0,0)+(1,0,0) block (0,0,0)+(1,0,0) range [1, 5] actuated\n"
      "[OUTPUTS]\np : position of crank (1,0,0)\n");
  EXPECT_EQ(a.mobility, 2);
  EXPECT_EQ(a.mobility_by_rank, 2);
  const double j2 = 0.4, s = std::cos(j2) + std::sqrt(9 - std::sin(j2) * std::sin(j2));
  const Values known{{"j1", 0.2}, {"phi_crank", j2}, {"s", s}, {"phi_rod", std::asin(-std::sin(j2) / 3)}};
  Values values = completed(a, known);
  EXPECT_NEAR(pose_of(a, "block", values).p[0], s * std::cos(0.2), 1e-9);
  EXPECT_NEAR(values.at("p_z"), -std::sin(j2), 1e-9);
}

// A leg between universal joints holds more than a length: its axes stay in a plane with it.
TEST(PlaneLoops, LeaveLegsBetweenUniversalJointsToSpace) {
  const Assembly a = assembled(
      "[LINKS]\nbase\narm\nhand\n[JOINTS]\nrevolute p : base (0,0,0)+(0,0,1) arm (0,0,0)+(0,0,1) actuated\n"
      "revolute q : arm (2,0,0)+(0,0,1) hand (0,0,0)+(0,0,1)\n"
      "uni_prs_uni leg : arm (0,1,0)+(1,2,3) hand (1,0,1)+(2,1,1) range [1/2, 5]\n");
  EXPECT_EQ(a.mobility_by_joints, 1);
  EXPECT_EQ(a.mobility, 1);
}

}  // namespace
}  // namespace corank::kinematics
