// All postures of arms from data sheets, against forward kinematics and Newton's method of their own; counts that are known;
// poses with infinitely many postures.
#include "corank/analyze/postures/postures.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <random>
#include <set>

#include "corank/study/model.h"
#include "corank/tests/analyze/data_sheet_arms.h"
#include "corank/tests/seeds.h"

namespace corank::analyze {
namespace {

using ::testing::HasSubstr;

// Newton's method with numeric derivatives and steps of half a radian at most; nothing where it does not end in a posture.
std::optional<Joints> newton(const Arm& arm, const Matrix4d& goal, Joints q) {
  const auto residual = [&](const Joints& at) {
    const Matrix4d t = hand(arm, at);
    Joints r;
    r.head<3>() = t.topRightCorner<3, 1>() - goal.topRightCorner<3, 1>();
    const Eigen::Matrix3d turn = goal.topLeftCorner<3, 3>().transpose() * t.topLeftCorner<3, 3>();
    r.tail<3>() = Vector3d(turn(2, 1) - turn(1, 2), turn(0, 2) - turn(2, 0), turn(1, 0) - turn(0, 1)) / 2;
    return r;
  };
  for (int step = 0; step < 60; ++step) {
    const Joints r = residual(q);
    if (r.cwiseAbs().maxCoeff() < 1e-13) break;
    Eigen::Matrix<double, 6, 6> j;
    for (int k = 0; k < 6; ++k) {
      Joints next = q;
      next[k] += 1e-7;
      j.col(k) = (residual(next) - r) / 1e-7;
    }
    const Joints whole = j.fullPivLu().solve(r);
    q -= whole * std::min(1.0, 0.5 / std::max(whole.cwiseAbs().maxCoeff(), 1e-9));
    if (!(q.cwiseAbs().maxCoeff() < 1e3)) return std::nullopt;
  }
  return difference(hand(arm, q), goal) < 1e-11 ? std::optional(q) : std::nullopt;
}

// CORANK_SEEDS=250: 100,000 starts of Newton's method in all.
TEST(Postures, OfArmsFromDataSheetsAreAllFound) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> angle(-M_PI, M_PI);
  const auto any = [&] { return Joints(Joints::NullaryExpr([&] { return angle(random); })); };
  for (const Arm& arm : arms()) {
    SCOPED_TRACE(arm.name);
    const PostureFinder finder = finder_of(arm_question(arm));
    EXPECT_EQ(finder.way(), "six joints");
    std::size_t most = 0, unknown = 0, starts = 0, ended = 0, lost = 0;
    const unsigned poses = test::seeds(6);
    for (unsigned n = 0; n < poses; ++n) {
      const Joints made_by = any();
      const Matrix4d goal = hand(arm, made_by);
      const Pose pose = pose_of(goal);
      solve::Control control;
      const Postures found = finder.find(pose.position, pose.orientation, control);
      if (found.at_most() != found.at_least()) {
        ++unknown;
        continue;
      }
      most = std::max(most, found.found.size());
      EXPECT_EQ(found.found.size() % 2, 0u);
      EXPECT_LE(found.found.size(), static_cast<std::size_t>(arm.most));
      double nearest = 10;
      for (const Posture& posture : found.found) {
        EXPECT_LT(difference(hand(arm, joints_of(posture)), goal), 1e-8);
        for (const CoordinateValue& v : posture.values) EXPECT_LT(v.value.width(), 1e-6);
        nearest = std::min(nearest, distance(joints_of(posture), made_by));
      }
      EXPECT_LT(nearest, 1e-6) << "the posture that made the pose is one of them";
      for (int start = 0; start < (test::long_run() ? 100 : 8); ++start) {
        const auto other = newton(arm, goal, any());
        ++starts;
        if (!other) continue;
        ++ended;
        const bool known = std::ranges::any_of(
            found.found, [&](const Posture& posture) { return distance(joints_of(posture), *other) < 1e-5; });
        lost += known ? 0 : 1;
      }
    }
    EXPECT_EQ(lost, 0u) << "Newton's method finds more";
    EXPECT_GT(ended, starts / 50);
    std::cout << arm.name << ": " << poses << " poses, " << unknown << " of which not decided; Newton's method from "
              << starts << " starts: " << ended << " ended in a posture, " << lost << " of which not listed\n";
    EXPECT_LE(unknown, poses / 12);
    EXPECT_GE(most, 8u);
    EXPECT_TRUE(std::string(arm.name) != "puma" || most == 8u);
  }
}

// Frames 0 … 6; joint k turns about z of frame k − 1.
std::vector<Matrix4d> frames(const Arm& arm, const Joints& q) {
  std::vector<Matrix4d> result;
  for (int n = 0; n <= 6; ++n) {
    Arm part = arm;
    Joints turned = q;
    for (int k = n; k < 6; ++k) part.rows[static_cast<std::size_t>(k)] = {0, 0, 0}, turned[k] = 0;
    result.push_back(hand(part, turned));
  }
  return result;
}

// The three functions of the theorem (theory.md, "Arms that are not cuspidal"), and the Jacobian's determinant.
struct Signs {
  Vector3d values;
  double determinant;
};
Signs signs_of(const Arm& arm, const Joints& q, bool parallel) {
  const std::vector<Matrix4d> t = frames(arm, q);
  const auto z = [&](std::size_t joint) -> Vector3d { return t[joint - 1].block<3, 1>(0, 2); };
  const auto at = [&](std::size_t frame) -> Vector3d { return t[frame].block<3, 1>(0, 3); };
  const Vector3d n = z(2), centre = at(parallel ? 5 : 4), end = parallel ? at(3) : centre;
  Eigen::Matrix<double, 6, 6> j;
  for (std::size_t k = 1; k <= 6; ++k) {
    j.block<3, 1>(0, static_cast<int>(k) - 1) = z(k).cross(at(6) - at(k - 1));
    j.block<3, 1>(3, static_cast<int>(k) - 1) = z(k);
  }
  return {{centre.dot(n.cross(z(1))), n.dot((end - at(1)).cross(end - at(2))), (parallel ? n : z(4)).cross(z(5)).dot(z(6))},
          j.determinant()};
}

TEST(Postures, OfIndustrialArmsAreToldApartByThreeSigns) {
  std::mt19937 random(12);
  const auto in = [&](double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(random); };
  const auto length = [&] { return std::round(in(50, 500)) / 1000; };
  const auto turn = [&] { return std::round(in(40, 140)); };
  const auto any = [&] { return Joints(Joints::NullaryExpr([&] { return in(-M_PI, M_PI); })); };
  for (unsigned n = 0; n < test::seeds(8); ++n) {
    const bool parallel = n % 2 == 0;
    Arm arm{"arm", {{{length(), 90, length()}, {length(), 0, length()}, {}, {}, {}, {0, 0, length()}}}, 16};
    arm.rows[2] = {length(), parallel ? 0 : turn(), length()};
    arm.rows[3] = {parallel ? length() : 0, parallel ? -90 : turn(), length()};
    arm.rows[4] = {0, turn(), parallel ? length() : 0};
    SCOPED_TRACE(parallel ? "three parallel axes" : "spherical wrist");
    const Signs first = signs_of(arm, any(), parallel);
    const double ratio = first.determinant / first.values.prod();
    const PostureFinder finder = finder_of(arm_question(arm));
    for (int pose = 0; pose < 3; ++pose) {
      const Joints q = any();
      const Signs there = signs_of(arm, q, parallel);
      EXPECT_NEAR(there.determinant, ratio * there.values.prod(), 1e-9 * std::fabs(ratio)) << "0 at singularities only";
      const Pose at = pose_of(hand(arm, q));
      solve::Control control;
      const Postures found = finder.find(at.position, at.orientation, control);
      if (found.at_most() != found.at_least()) continue;
      std::set<std::array<bool, 3>> seen;
      for (const Posture& posture : found.found) {
        const Vector3d g = signs_of(arm, joints_of(posture), parallel).values;
        EXPECT_TRUE(seen.insert({g[0] > 0, g[1] > 0, g[2] > 0}).second) << "two postures of the same signs";
      }
    }
  }
}

TEST(Postures, OfAWristThatIsSingularAreAFamilyAndSixMore) {
  const PostureFinder finder = finder_of(arm_question(arms()[1]));
  solve::Control control;
  // All angles are 0: the wrist's outer axes are one line, and the pose is exact.
  const Postures found = finder.find({"0.4521", "-0.15005", "0.4318"}, rotation_of({1, 0, 0, 0}), control);
  EXPECT_TRUE(found.complete);
  EXPECT_EQ(found.at_least(), 6);
  EXPECT_FALSE(found.at_most());
  ASSERT_EQ(found.families.size(), 1u);
  EXPECT_EQ(found.families[0].dimension, 1);
  EXPECT_TRUE(found.families[0].proven);
  for (const CoordinateValue& v : found.families[0].values) {
    const bool turns = v.name == "q4" || v.name == "q6";
    EXPECT_TRUE(turns ? v.value.width() > 6.2 : v.value.mag() < 1e-6) << v.name << " in " << v.value;
  }
}

TEST(Postures, NearASingularityAreNotClaimedToBeAll) {
  const Arm& puma = arms()[1];
  const PostureFinder finder = finder_of(arm_question(puma));
  Joints q;
  q << 0.3, 0.5, 0.7, 0.2, 0, 0.4;  // rounded: two postures a hundred-millionth apart
  const Pose pose = pose_of(hand(puma, q));
  solve::Control control;
  const Postures found = finder.find(pose.position, pose.orientation, control);
  EXPECT_GE(found.at_least(), 6);
  EXPECT_TRUE(!found.at_most() || *found.at_most() == 8);
}

TEST(Postures, OutOfReachAreNone) {
  const PostureFinder finder = finder_of(arm_question(arms()[0]));
  solve::Control control;
  const Postures found = finder.find({"2", "0", "0"}, rotation_of({1, 0, 0, 0}), control);
  EXPECT_EQ(found.at_most(), 0);
}

TEST(Postures, KeepTheJointsRanges) {
  const Arm& gofa = arms()[3];
  const PostureFinder all = finder_of(arm_question(gofa)), some = finder_of(arm_question(gofa, "limits [-100deg, 100deg]"));
  std::mt19937 random(6);
  std::uniform_real_distribution<double> angle(-1.5, 1.5);
  int left_out = 0;
  for (int n = 0; n < 10; ++n) {
    const Pose pose = pose_of(hand(gofa, Joints::NullaryExpr([&] { return angle(random); })));
    solve::Control control;
    const Postures free = all.find(pose.position, pose.orientation, control),
                   kept = some.find(pose.position, pose.orientation, control);
    const auto inside = [](const Posture& posture) {
      return std::ranges::all_of(posture.values, [](const CoordinateValue& v) { return v.value.mag() < 100 * M_PI / 180; });
    };
    EXPECT_EQ(kept.at_most(), std::ranges::count_if(free.found, inside));
    left_out += static_cast<int>(free.found.size() - kept.found.size());
  }
  EXPECT_GT(left_out, 10);
}

PostureFinder dextar(const std::vector<std::string>& given) {
  study::Model model = study::read_model(CORANK_SOURCE_DIR "/models/dextar.cuik");
  return PostureFinder({.question = {.model = std::move(model.mechanism)}, .given = given});
}

TEST(Postures, OfAFiveBarAreTwoAtItsMotorsAndFourAtItsPoint) {
  solve::Control control;
  EXPECT_EQ(dextar({"theta2", "theta5"}).find({"pi/2", "2"}, {}, control).at_most(), 2);
  const Postures four = dextar({"J3x", "J3y"}).find({"0.4", "1"}, {}, control);
  EXPECT_EQ(four.at_most(), 4);
  EXPECT_EQ(four.at_least(), 4);
  EXPECT_EQ(dextar({"theta2", "theta5"}).find({"pi/3", "2"}, {}, control).at_most(), 0) << "its elbows are too far apart";
}

// A prismatic joint is in it: the general way.
TEST(Postures, OfAnArmWithASlideAreFoundToo) {
  study::Model model =
      study::parse_model({"[CONSTANTS]\nunit m\n[DH]\nstandard\na alpha d theta\n0 -90deg 0.4 q1\n0 90deg 0.15 q2\n0 0 q3 "
                          "-pi/2 range [0.2, 1]\n"
                          "0 -90deg 0 q4\n0 90deg 0 q5\n0 0 0.2 q6\n",
                          "stanford.cuik"});
  const PostureFinder finder = finder_of({.model = std::move(model.mechanism), .assembly = std::move(model.assembly)});
  EXPECT_EQ(finder.way(), "hand held");
  solve::Control control;
  const Postures found = finder.find({"0.3", "0.4", "0.6"}, rotation_of({3, 1, 1, 2}), control);
  EXPECT_TRUE(found.complete);
  EXPECT_EQ(found.at_most(), 4) << "two ways to reach the wrist's centre with the slide on its side, two of the wrist";
}

// An arm with one joint more than a pose needs, whose value is given, is the arm of six joints with that one held: random
// arms of seven joints, the given one of which may slide, find the configuration that the pose is from.
TEST(Postures, OfAnArmOfSevenJointsWithOneGivenAreThoseOfTheOtherSix) {
  std::mt19937 random(7);
  const auto draw = [&](int from, int to) { return std::uniform_int_distribution(from, to)(random); };
  int found_in = 0;
  for (unsigned seed = 0; seed < test::seeds(6); ++seed) {
    const int held = draw(0, 6);
    const bool slides = held > 0 && draw(0, 2) == 0;
    std::string text = "[CONSTANTS]\nunit m\n[DH]\nstandard\na alpha d theta\n";
    std::vector<double> q;
    Matrix4d t = Matrix4d::Identity();
    for (int k = 0; k < 7; ++k) {
      const double a = draw(0, 3) / 8.0, alpha = k == 6 ? 0 : draw(0, 1) == 0 ? 90 : -90, d = draw(0, 4) / 8.0;
      const bool is_slide = k == held && slides;
      q.push_back(std::round(256 * std::uniform_real_distribution<double>(is_slide ? 0 : -3, is_slide ? 0.5 : 3)(random)) /
                  256);
      text += fmt::format("{} {}deg {} {} range {}\n", a, alpha, is_slide ? fmt::format("q{}", k + 1) : fmt::format("{}", d),
                          is_slide ? "0" : fmt::format("q{}", k + 1), is_slide ? "[0, 0.5]" : "[-3.1, 3.1]");
      Eigen::Affine3d step = Eigen::Affine3d::Identity();
      step.rotate(Eigen::AngleAxisd(is_slide ? 0 : q.back(), Vector3d::UnitZ()));
      step.translate(Vector3d(0, 0, is_slide ? q.back() : d));
      step.translate(Vector3d(a, 0, 0));
      step.rotate(Eigen::AngleAxisd(alpha * M_PI / 180, Vector3d::UnitX()));
      t = t * step.matrix();
    }
    study::Model model = study::parse_model({text, "seven.cuik"});
    const PostureFinder finder({.question = {.model = std::move(model.mechanism), .assembly = std::move(model.assembly)},
                                .given = {"tool_x", fmt::format("q{}", held + 1), "tool_y", "tool_z"},
                                .orientation = true});
    Pose pose = pose_of(t);
    pose.position.insert(pose.position.begin() + 1, exact(q[static_cast<std::size_t>(held)]));
    solve::Control control({.boxes = 20'000});
    const Postures found = finder.find(pose.position, pose.orientation, control, 1);
    if (!found.complete) continue;  // by chance singular, or without an end in so few boxes
    ++found_in;
    const auto is_planted = [&](const Posture& posture) {
      return std::ranges::all_of(posture.values, [&](const CoordinateValue& v) {
        const double planted = q[static_cast<std::size_t>(v.name[1] - '1')];
        return std::fabs(std::remainder(v.value.mid() - planted, 2 * M_PI)) < 1e-5;
      });
    };
    EXPECT_TRUE(std::ranges::any_of(found.found, is_planted) || !found.families.empty()) << text;
    pose.position[1] = exact(slides ? 0.6 : 3.12);
    EXPECT_EQ(finder.find(pose.position, pose.orientation, control, 1).at_most(), 0) << "outside its range";
  }
  EXPECT_GT(found_in, static_cast<int>(test::seeds(6)) * 3 / 4);
}

// The hand's pose is that of a point of the tool: the same postures, found the same way.
TEST(Postures, OfAPointOfTheToolAreThoseOfItsFrame) {
  const Arm& crx = arms()[2];
  study::Model model =
      study::parse_model({"[CONSTANTS]\nunit m\n[DH]\nstandard\na alpha d theta\n0 -90deg 0 q1\n0.71 0 0 q2\n0 -90deg 0 q3\n"
                          "0 90deg 0.54 q4\n0 -90deg 0.15 q5\n0 0 0.16 q6\n[OUTPUTS]\nh : pose of tool (0.1, 0, 0.2)\n",
                          "crx.cuik"});
  const PostureFinder finder({.question = {.model = std::move(model.mechanism), .assembly = std::move(model.assembly)},
                              .given = {"h_x", "h_y", "h_z"},
                              .orientation = true});
  EXPECT_EQ(finder.way(), "six joints");
  Joints q;
  q << 0.3, -0.5, 0.7, 0.2, 0.9, 0.4;
  Matrix4d goal = hand(crx, q), point = Matrix4d::Identity();
  point(0, 3) = 0.1, point(2, 3) = 0.2;
  const Pose pose = pose_of(goal * point);
  solve::Control control;
  const Postures found = finder.find(pose.position, pose.orientation, control);
  EXPECT_EQ(found.at_most(), found.at_least());
  EXPECT_TRUE(std::ranges::any_of(found.found, [&](const Posture& p) { return distance(joints_of(p), q) < 1e-9; }));
  for (const Posture& posture : found.found) EXPECT_LT(difference(hand(crx, joints_of(posture)), goal), 1e-9);
}

// Both elbows of a five-bar are at one place: its end goes round them, and beyond that there is one more configuration.
TEST(Postures, ThatFormASetAreSaidSo) {
  study::Model model = study::read_model(CORANK_SOURCE_DIR "/models/dextar.cuik", {{"l", "1"}, {"d", "1"}});
  const PostureFinder finder({.question = {.model = std::move(model.mechanism)}, .given = {"theta2", "theta5"}});
  solve::Control control;
  const Postures found = finder.find({"2*pi/3", "pi/3"}, {}, control);
  EXPECT_FALSE(found.at_most());
  ASSERT_EQ(found.families.size(), 1u);
  EXPECT_TRUE(found.families[0].proven);
  EXPECT_EQ(found.families[0].dimension, 1);
}

TEST(Postures, AreRefusedWhereTheQuestionMakesNoSense) {
  const auto fault = [](auto&& question) -> std::string {
    try {
      question();
    } catch (const symbolic::ModelError& error) {
      return error.what();
    }
    return "none";
  };
  solve::Control control;
  EXPECT_THAT(fault([&] { dextar({"theta2"}).find({"1"}, {}, control); }), HasSubstr("leave 1 degree of freedom"));
  EXPECT_THAT(fault([&] { dextar({"x"}); }), HasSubstr("there is no coordinate 'x'"));
  EXPECT_THAT(fault([&] { dextar({"J3x", "J3x"}); }), HasSubstr("two values"));
  study::Model five_bar = study::read_model(CORANK_SOURCE_DIR "/models/dextar.cuik");
  EXPECT_THAT(fault([&] { PostureFinder({.question = {.model = five_bar.mechanism}, .given = {}, .orientation = true}); }),
              HasSubstr("which orientation is meant"));
  EXPECT_THROW(rotation_of({0, 0, 0, 0}), std::invalid_argument);
}

}  // namespace
}  // namespace corank::analyze
