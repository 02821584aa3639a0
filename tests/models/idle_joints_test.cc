// Arms some of whose joints do not move the tool's tip: boundaries of their workspaces, and pictures of their
// singularities, against kinematics in double precision.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <random>

#include "corank/result/files/verification.h"
#include "corank/study/answer.h"
#include "corank/study/cut.h"
#include "corank/study/model.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/tests/seeds.h"

namespace corank {
namespace {

using Eigen::Vector3d;
using Joints = std::vector<double>;
constexpr double kPi = std::numbers::pi;

/// By modified Denavit and Hartenberg: Rx(alpha) Tx(a) Rz(theta) Tz(d). The last `idle` joints turn about the tip.
struct Arm {
  struct Row {
    double alpha, a, d;  // alpha in degrees
    bool slides;
    double lower, upper;  // in degrees where it turns
  };
  std::vector<Row> rows;
  std::size_t idle = 0;

  std::string text() const {
    std::string text = "[DH]\nmodified\nalpha a d theta\n";
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const Row& r = rows[i];
      const std::string deg = r.slides ? "" : "deg", q = fmt::format("q{}", i + 1);
      text += fmt::format("{}deg {} {} {} limits [{}{}, {}{}]\n", r.alpha, r.a, r.slides ? q : fmt::format("{}", r.d),
                          r.slides ? "0" : q, r.lower, deg, r.upper, deg);
    }
    return text;
  }
  double lower(std::size_t i) const { return rows[i].slides ? rows[i].lower : rows[i].lower * kPi / 180; }
  double upper(std::size_t i) const { return rows[i].slides ? rows[i].upper : rows[i].upper * kPi / 180; }
  std::size_t moving() const { return rows.size() - idle; }

  Vector3d tip(const Joints& q) const {
    Eigen::Isometry3d t = Eigen::Isometry3d::Identity();
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const Row& r = rows[i];
      t.rotate(Eigen::AngleAxisd(r.alpha * kPi / 180, Vector3d::UnitX()));
      t.translate(Vector3d(r.a, 0, 0));
      t.rotate(Eigen::AngleAxisd(r.slides ? 0 : q[i], Vector3d::UnitZ()));
      t.translate(Vector3d(0, 0, r.slides ? q[i] : r.d));
    }
    return t.translation();
  }
  double determinant(const Joints& q) const {
    constexpr double kStep = 1e-5;
    Eigen::Matrix3d j;
    for (std::size_t i = 0; i < 3; ++i) {
      Joints more = q, less = q;
      more[i] += kStep, less[i] -= kStep;
      j.col(static_cast<Eigen::Index>(i)) = (tip(more) - tip(less)) / (2 * kStep);
    }
    return j.determinant();
  }
};

Arm scara() {
  return {{{0, 0, 0.4, false, -130, 130},
           {0, 0.325, 0, false, -145, 145},
           {0, 0.225, 0, true, -0.2, 0},
           {0, 0, 0, false, -360, 360}},
          1};
}

study::Model model_of(const Arm& arm) { return study::parse_model({.text = arm.text(), .file = "arm.cuik"}); }

result::Result answer_to(const Arm& arm, symbolic::SingularitySet set, std::uint64_t most = 0) {
  study::Options options;
  options.search.surfaces_whole = true;
  options.search.max_boxes = most;
  return study::answer({.model = model_of(arm).mechanism, .set = set}, options);
}

// Of the named part without its condition; any part where no name is given.
bool holds(const result::Result& result, const Arm& arm, const Joints& q, const std::string& part = "") {
  constexpr double kRoom = 1e-6;
  const Vector3d tip = arm.tip(q);
  std::map<std::string, double> values{{"tool_x", tip[0]}, {"tool_y", tip[1]}, {"tool_z", tip[2]}};
  for (std::size_t i = 0; i < q.size(); ++i) {
    const std::string name = fmt::format("q{}", i + 1);
    if (arm.rows[i].slides) values[name] = q[i];
    if (!arm.rows[i].slides) values["c_" + name] = std::cos(q[i]), values["s_" + name] = std::sin(q[i]);
  }
  return std::ranges::any_of(result.cover.boxes, [&](const CoverBox& box) {
    const std::string& name = result.parts[static_cast<std::size_t>(box.part)].part;
    if (!part.empty() && name.substr(0, name.find(':')) != part) return false;
    for (std::size_t v = 0; v < result.variables.size(); ++v) {
      const auto value = values.find(result.variables[v].name);
      if (value == values.end()) continue;  // components of axes
      if (value->second < box.box[v].lo() - kRoom || value->second > box.box[v].hi() + kRoom) return false;
    }
    return true;
  });
}

class RandomArm {
 public:
  explicit RandomArm(unsigned seed) : random_(seed) {
    const double angles[] = {0, 90, -90, 30};
    for (int i = 0; i < 3; ++i) {
      const bool slides = draw(0, 3) == 0;
      const double lower = slides ? draw(0, 4) / 10.0 : draw(-170, 0), upper = slides ? lower + 0.5 : draw(10, 170);
      arm.rows.push_back(
          {i == 0 ? 0 : angles[draw(0, 3)], i == 0 ? 0 : draw(0, 10) / 10.0, draw(0, 5) / 10.0, slides, lower, upper});
    }
    arm.idle = 1 + draw(0, 1);
    arm.rows.push_back({angles[draw(0, 3)], draw(3, 10) / 10.0, draw(0, 5) / 10.0, false, -100, 100});
    if (arm.idle == 2) arm.rows.push_back({angles[draw(0, 3)], 0, 0, false, -200, 200});
  }
  Joints configuration() {
    Joints q;
    for (std::size_t i = 0; i < arm.rows.size(); ++i)
      q.push_back(std::uniform_real_distribution(arm.lower(i), arm.upper(i))(random_));
    return q;
  }
  // On a line between two of them, where the tip's Jacobian is singular.
  std::optional<Joints> singular() {
    Joints from = configuration(), to = configuration();
    const auto at = [&](double t) {
      Joints q = from;
      for (std::size_t i = 0; i < arm.moving(); ++i) q[i] += t * (to[i] - from[i]);
      return q;
    };
    double lo = 0, hi = 1;
    const bool rises = arm.determinant(at(lo)) < 0;
    if (rises == (arm.determinant(at(hi)) < 0)) return std::nullopt;
    for (int i = 0; i < 60; ++i) {
      const double mid = (lo + hi) / 2;
      ((arm.determinant(at(mid)) < 0) == rises ? lo : hi) = mid;
    }
    return at(lo);
  }
  int draw(int from, int to) { return std::uniform_int_distribution(from, to)(random_); }

  Arm arm;

 private:
  std::mt19937 random_;
};

TEST(IdleJoints, AreLeftOutOfTheBoundaryOfAScara) {
  const result::Result result = answer_to(scara(), symbolic::SingularitySet::boundary);
  EXPECT_TRUE(result.cover.complete());
  EXPECT_EQ(result.cover.count(Verdict::undecided), 0u);
  EXPECT_LT(result.cover.boxes.size(), 500u);
  EXPECT_THAT(result.free_coordinates, testing::ElementsAre("q4"));
  EXPECT_EQ(result.parts.size(), 7u) << "a limit of q4 makes no part";
  std::size_t barriers = 0;
  for (const CoverBox& box : result.cover.boxes) barriers += box.passage == Passage::barrier;
  EXPECT_GT(barriers, result.cover.boxes.size() / 2);
  const result::Verification verification = result::verify(result);
  EXPECT_TRUE(verification.verified());
  ASSERT_TRUE(verification.samples);
  EXPECT_GT(verification.samples->of_set, 0);
}

TEST(IdleJoints, OfRandomArmsLoseNothingOfTheBoundary) {
  std::size_t arms = 0, samples = 0, singular = 0;
  for (unsigned seed = 0; seed < test::seeds(12); ++seed) {
    RandomArm random(seed);
    const Arm& arm = random.arm;
    if (std::fabs(arm.determinant(random.configuration())) < 1e-9) continue;  // the tip stays in a plane, or on a line
    const result::Result result = answer_to(arm, symbolic::SingularitySet::boundary, 20'000);
    if (!result.cover.complete()) continue;
    ++arms;
    EXPECT_EQ(result::left_out(result.parts.front()).size() >= arm.idle, true) << arm.text();
    for (int k = 0; k < 20; ++k) {
      const Joints q = random.configuration();
      for (std::size_t i = 0; i < arm.moving(); ++i) {
        const bool upper = random.draw(0, 1) == 1;
        Joints at = q;
        at[i] = upper ? arm.upper(i) : arm.lower(i);
        EXPECT_TRUE(holds(result, arm, at, fmt::format("q{} at its {} limit", i + 1, upper ? "upper" : "lower")))
            << arm.text();
        ++samples;
      }
      if (const auto s = random.singular()) {
        EXPECT_TRUE(holds(result, arm, *s, "no limit")) << arm.text();
        ++singular;
      }
    }
    if (seed % 4 == 0) {
      EXPECT_TRUE(result::verify(result).verified()) << arm.text();
    }
  }
  EXPECT_GT(arms, test::seeds(12) / 2);
  EXPECT_GT(samples, 20 * arms);
  EXPECT_GT(singular, arms);
}

// An arm of four joints that bring its tip somewhere: singular where its Jacobian has lost rank, which is a curve, whatever
// its first joint, by which it turns as a whole, and its idle one. Found by Newton's method for λᵀJ = 0 from random places.
std::optional<Joints> lost_rank_near(const Arm& arm, Joints q, Vector3d lambda) {
  const auto residual = [&](const Joints& at, const Vector3d& l) {
    constexpr double kStep = 1e-5;
    Eigen::VectorXd r(5);
    for (std::size_t i = 0; i < 4; ++i) {
      Joints more = at, less = at;
      more[i] += kStep, less[i] -= kStep;
      r[static_cast<Eigen::Index>(i)] = l.dot(arm.tip(more) - arm.tip(less)) / (2 * kStep);
    }
    r[4] = l.squaredNorm() - 1;
    return r;
  };
  for (int step = 0; step < 40; ++step) {
    const Eigen::VectorXd r = residual(q, lambda);
    if (r.norm() < 1e-10) return q;
    Eigen::MatrixXd j(5, 7);
    for (std::size_t i = 0; i < 7; ++i) {
      Joints moved = q;
      Vector3d turned = lambda;
      (i < 4 ? moved[i] : turned[static_cast<Eigen::Index>(i) - 4]) += 1e-6;
      j.col(static_cast<Eigen::Index>(i)) = (residual(moved, turned) - r) / 1e-6;
    }
    Eigen::VectorXd shift = j.completeOrthogonalDecomposition().solve(r);
    if (shift.norm() > 0.5) shift *= 0.5 / shift.norm();
    for (std::size_t i = 0; i < 4; ++i) q[i] -= shift[static_cast<Eigen::Index>(i)];
    lambda -= shift.tail<3>();
  }
  return std::nullopt;
}

TEST(IdleJoints, OfRedundantArmsLoseNothingOfTheSingularities) {
  std::size_t arms = 0, samples = 0;
  for (unsigned seed = 0; seed < test::seeds(4); ++seed) {
    RandomArm random(seed);
    Arm& arm = random.arm;
    arm.rows.clear();
    const double angles[] = {90, -90, 45};
    for (int i = 0; i < 4; ++i)
      arm.rows.push_back({i == 0 ? 0 : angles[random.draw(0, 2)], i == 0 ? 0 : random.draw(1, 8) / 10.0,
                          random.draw(0, 5) / 10.0, false, -170, 170});
    arm.rows.push_back({90, 0.6, 0.1, false, -90, 90});
    arm.idle = 1;
    const result::Result result = answer_to(arm, symbolic::SingularitySet::inverse, 150'000);
    ASSERT_EQ(result.parts.size(), 1u);
    EXPECT_THAT(result.free_coordinates, testing::IsSupersetOf({"q1", "q5"})) << arm.text();
    if (!result.cover.complete()) continue;
    ++arms;
    for (int k = 0; k < 30; ++k) {
      std::optional<Joints> q = lost_rank_near(arm, random.configuration(), Vector3d::Random().normalized());
      if (!q) continue;
      for (double& angle : *q) angle = std::remainder(angle, 2 * kPi);
      if (std::ranges::any_of(*q, [](double angle) { return std::fabs(angle) > 169 * kPi / 180; })) continue;
      (*q)[4] = 1;
      ++samples;
      EXPECT_TRUE(holds(result, arm, *q)) << arm.text();
    }
    if (seed % 4 == 0) {
      EXPECT_TRUE(result::verify(result).verified()) << arm.text();
    }
  }
  EXPECT_GE(arms, test::seeds(4) / 2);
  EXPECT_GT(samples, 5 * arms);
}

// Its C-space is a product; ranges of what the joints give cut nothing off.
TEST(IdleJoints, AreAllJointsOfAnArmsCspace) {
  Arm arm = scara();
  for (int k = 0; k < 2; ++k) arm.rows.push_back({90, 0.1, 0.2, false, -100, 100});
  const result::Result result = answer_to(arm, symbolic::SingularitySet::cspace);
  EXPECT_TRUE(result.cover.complete());
  EXPECT_EQ(result.cover.dimension, 6);
  EXPECT_EQ(result.cover.count(Verdict::undecided), 0u);
  EXPECT_LT(result.cover.statistics.processed, 100u);
  EXPECT_THAT(result.free_coordinates, testing::UnorderedElementsAre("q1", "q2", "q3", "q4", "q5", "q6"));
  for (const result::DomainNotes::Reason& reason : result.domain.boundary) EXPECT_EQ(reason.text, "range of q1");
  RandomArm random(1);
  random.arm = arm;
  for (int k = 0; k < 100; ++k) EXPECT_TRUE(holds(result, arm, random.configuration()));
  EXPECT_TRUE(result::verify(result).verified());
}

// A set in the joints alone says nothing of the outputs until it is drawn.
TEST(IdleJoints, OfAScaraStayOutOfThePictureOfItsSingularities) {
  const result::Result whole = answer_to(scara(), symbolic::SingularitySet::inverse);
  EXPECT_EQ(whole.cover.boxes.size(), 1u);
  EXPECT_TRUE(study::is_whole(whole));
  solve::Control control;
  const result::Result cut = study::cut(whole, {.sigma = 0.02}, control);
  EXPECT_TRUE(cut.cover.complete());
  EXPECT_FALSE(study::is_whole(cut));
  EXPECT_EQ(cut.cover.dimension, 3);
  EXPECT_THAT(cut.free_coordinates, testing::Contains("q4"));
  const auto place = [&](const std::string& name) {
    return static_cast<std::size_t>(std::ranges::find(cut.variables, name, &result::ResultVariable::name) -
                                    cut.variables.begin());
  };
  for (const CoverBox& box : cut.cover.boxes)
    EXPECT_NEAR(std::hypot(box.box[place("tool_x")].mid(), box.box[place("tool_y")].mid()), 0.55, 0.02);
  for (double q1 = -2.2; q1 < 2.2; q1 += 0.05) EXPECT_TRUE(holds(cut, scara(), {q1, 0, -0.03 * (q1 + 2.3), 3 * q1}));
  EXPECT_TRUE(result::verify(cut).verified());
}

TEST(IdleJoints, OfRandomArmsLoseNothingOfThePicture) {
  std::size_t arms = 0, singular = 0;
  for (unsigned seed = 0; seed < test::seeds(8); ++seed) {
    RandomArm random(seed);
    const result::Result whole = answer_to(random.arm, symbolic::SingularitySet::inverse, 20'000);
    if (!whole.cover.complete() || whole.parts.empty() || !study::is_whole(whole)) continue;
    solve::Control control;
    const result::Result cut = study::cut(whole, {.sigma = 0.2, .max_boxes = 200'000}, control);
    if (!cut.stopped.empty()) continue;
    ++arms;
    for (int k = 0; k < 20; ++k)
      if (const auto s = random.singular()) {
        EXPECT_TRUE(holds(cut, random.arm, *s)) << random.arm.text();
        ++singular;
      }
    if (seed % 4 == 0) {
      EXPECT_TRUE(result::verify(cut).verified()) << random.arm.text();
    }
  }
  EXPECT_GT(arms, test::seeds(8) / 4);
  EXPECT_GT(singular, arms);
}

// A SCARA and one direction of its hand: as many outputs as joints, so that a joint at its limit is a part. It is more than
// a surface, and the product of the other joints' ranges.
TEST(IdleJoints, OfAnArmAtALimitArePartsThatAreProducts) {
  const char* const kArm =
      "[SYSTEM VARS]\nx : [-6, 6]\ny : [-6, 6]\nz : [-2, 2]\nw : [-2, 2]\nt1 ~\nt2 ~\nt4 ~\nd3 : [-1, 2]\n"
      "[LIMITS]\nt1 : [-2, 2]\nt2 : [-2.5, 2.5]\nd3 : [0, 1]\nt4 : [-3, 3]\n[SYSTEM EQS]\n"
      "x = cos(t1) + 0.8*cos(t1 + t2);\ny = sin(t1) + 0.8*sin(t1 + t2);\nz = 1 - d3;\nw = cos(t1 + t2 + t4);\n"
      "[OUTPUTS] x, y, z, w\n";
  study::Options options;
  options.search.surfaces_whole = true;
  const result::Result result =
      study::answer({.model = symbolic::parse_model(kArm, "m.cuik"), .set = symbolic::SingularitySet::boundary}, options);
  EXPECT_TRUE(result.cover.complete());
  EXPECT_TRUE(result::verify(result).verified());
  std::mt19937 random(7);
  const auto between = [&](double a, double b) { return std::uniform_real_distribution(a, b)(random); };
  const std::map<std::string, std::pair<double, double>> limits{
      {"t1", {-2, 2}}, {"t2", {-2.5, 2.5}}, {"d3", {0, 1}}, {"t4", {-3, 3}}};
  int lost = 0, products = 0;
  for (const auto& [joint, ends] : limits)
    for (int k = 0; k < 100; ++k) {
      std::map<std::string, double> q;
      for (const auto& [name, range] : limits) q[name] = between(range.first, range.second);
      q[joint] = k % 2 == 0 ? ends.first : ends.second;
      q["x"] = std::cos(q["t1"]) + 0.8 * std::cos(q["t1"] + q["t2"]);
      q["y"] = std::sin(q["t1"]) + 0.8 * std::sin(q["t1"] + q["t2"]);
      q["z"] = 1 - q["d3"];
      q["w"] = std::cos(q["t1"] + q["t2"] + q["t4"]);
      const std::string name = joint + (k % 2 == 0 ? " at its lower limit" : " at its upper limit");
      const auto holds = [&](const CoverBox& box) {
        if (result.parts[static_cast<std::size_t>(box.part)].part != name) return false;
        for (std::size_t v = 0; v < box.box.size(); ++v) {
          const std::string& variable = result.variables[v].name;
          const double value = q.contains(variable) ? q.at(variable)
                               : variable[0] == 'c' ? std::cos(q.at(variable.substr(2)))
                                                    : std::sin(q.at(variable.substr(2)));
          if (value < box.box[v].lo() - 1e-9 || value > box.box[v].hi() + 1e-9) return false;
        }
        return true;
      };
      lost += std::ranges::none_of(result.cover.boxes, holds);
      const auto part = std::ranges::find(result.parts, name, &result::Result::part);
      products += part != result.parts.end() && !result::left_out(*part).empty();
    }
  EXPECT_EQ(lost, 0);
  EXPECT_GE(products, 200);
}

}  // namespace
}  // namespace corank
