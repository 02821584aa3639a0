// Singularities of arms with more joints than outputs, by values of joints and conditions in place of a kernel vector,
// against kinematics in double precision.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <random>
#include <vector>

#include "corank/study/answer.h"
#include "corank/study/model.h"
#include "corank/symbolic/model/evaluate.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/sets/set_parts.h"
#include "corank/tests/seeds.h"

namespace corank {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
constexpr double kPi = std::numbers::pi;

/// By standard Denavit and Hartenberg: Rz(theta) Tz(d) Tx(a) Rx(alpha), alpha in right angles.
struct Arm {
  struct Row {
    int alpha;
    double a, d;
  };
  std::vector<Row> rows;
  bool whole_pose = true;

  std::string text() const {
    std::string text = "[DH]\nstandard\na alpha d theta\n";
    for (std::size_t i = 0; i < rows.size(); ++i)
      text += fmt::format("{} {}deg {} q{} limits [-175deg, 175deg]\n", rows[i].a, 90 * rows[i].alpha, rows[i].d, i + 1);
    return text + "[OUTPUTS]\ntip : " + (whole_pose ? "pose" : "position") + " of tool\n";
  }

  /// Of the tip's velocity, and of the tool's angular velocity.
  MatrixXd jacobian(const VectorXd& q) const {
    std::vector<Vector3d> axes, points;
    Eigen::Isometry3d t = Eigen::Isometry3d::Identity();
    for (std::size_t i = 0; i < rows.size(); ++i) {
      axes.emplace_back(t.linear().col(2));
      points.emplace_back(t.translation());
      t.rotate(Eigen::AngleAxisd(q[static_cast<Eigen::Index>(i)], Vector3d::UnitZ()));
      t.translate(Vector3d(rows[i].a, 0, rows[i].d));
      t.rotate(Eigen::AngleAxisd(rows[i].alpha * kPi / 2, Vector3d::UnitX()));
    }
    MatrixXd j(whole_pose ? 6 : 3, rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const auto column = static_cast<Eigen::Index>(i);
      j.col(column).head(3) = axes[i].cross(t.translation() - points[i]);
      if (whole_pose) j.col(column).tail(3) = axes[i];
    }
    return j;
  }
  double smallest_value(const VectorXd& q) const {
    return Eigen::JacobiSVD<MatrixXd>(jacobian(q)).singularValues().tail(1)[0];
  }
};

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double uniform(double low, double high) { return std::uniform_real_distribution<>(low, high)(engine_); }
  VectorXd configuration(std::size_t joints) {
    VectorXd q(static_cast<Eigen::Index>(joints));
    for (double& x : q) x = uniform(-3, 3);
    return q;
  }
  /// Joints at right angles to each other, some of whose axes meet.
  Arm arm(bool whole_pose) {
    Arm arm{{}, whole_pose};
    const std::size_t joints = whole_pose ? 7 : 5 + engine_() % 2;
    for (std::size_t i = 0; i < joints; ++i) {
      const auto length = [&](double often) { return uniform(0, 1) < often ? std::round(uniform(1, 9)) / 10 : 0; };
      arm.rows.push_back({i + 1 == joints ? 0 : engine_() % 2 == 0 ? 1 : -1, length(0.1), length(i % 2 == 0 ? 0.9 : 0.1)});
    }
    if (arm.rows.back().d == 0) arm.rows.back().d = 0.3;  // a tip that moves
    return arm;
  }

  /// Six joints, the first three axes of which meet.
  Arm arm_with_shoulder() {
    const auto length = [&](double often) { return uniform(0, 1) < often ? std::round(uniform(1, 9)) / 10 : 0; };
    const auto alpha = [&] { return engine_() % 2 == 0 ? 1 : -1; };
    return {{{alpha(), 0, length(1)},
             {alpha(), 0, 0},
             {alpha(), length(0.5), length(1)},
             {alpha(), length(0.5), length(0.5)},
             {alpha(), length(0.3), length(1)},
             {0, length(0.7), length(1)}},
            false};
  }

 private:
  std::mt19937 engine_;
};

/// A zero of a smallest singular value, by Newton's method along its gradient: it falls linearly to 0.
std::optional<VectorXd> singular_near(const std::function<double(const VectorXd&)>& smallest_value, VectorXd q) {
  constexpr double kStep = 1e-6, kZero = 1e-9;
  for (int iteration = 0; iteration < 60; ++iteration) {
    const double value = smallest_value(q);
    if (value < kZero) return q;
    VectorXd gradient(q.size());
    for (Eigen::Index i = 0; i < q.size(); ++i) {
      VectorXd more = q;
      more[i] += kStep;
      gradient[i] = (smallest_value(more) - value) / kStep;
    }
    if (gradient.squaredNorm() < 1e-12) return std::nullopt;
    q -= gradient * (value / gradient.squaredNorm());
    if (q.cwiseAbs().maxCoeff() > 3.05) return std::nullopt;
  }
  return std::nullopt;
}

/// A part by what it names: joints with their values, functions that are 0, and a matrix that loses rank.
struct Part {
  std::string name;
  std::map<std::size_t, double> values;
  std::vector<symbolic::Expression> conditions;
  std::map<std::string, double> constants;
  std::optional<symbolic::ExpressionMatrix> block{};

  std::map<std::string, double> names_at(const VectorXd& q) const {
    std::map<std::string, double> names = constants;
    for (Eigen::Index i = 0; i < q.size(); ++i) names[fmt::format("q{}", i + 1)] = q[i];
    return names;
  }
  /// The smallest singular value of the matrix; 0 if the part has no matrix.
  double smallest_value(const VectorXd& q) const {
    if (!block) return 0;
    const auto names = names_at(q);
    MatrixXd m(block->rows.size(), block->columns.size());
    for (Eigen::Index i = 0; i < m.rows(); ++i)
      for (Eigen::Index j = 0; j < m.cols(); ++j)
        m(i, j) = symbolic::evaluate(block->rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)], names);
    return Eigen::JacobiSVD<MatrixXd>(m).singularValues().tail(1)[0];
  }
  VectorXd held(VectorXd q) const {
    for (const auto& [joint, value] : values) q[static_cast<Eigen::Index>(joint)] = value;
    return q;
  }

  VectorXd residuals(const VectorXd& q) const {
    std::vector<double> all;
    for (const auto& [joint, value] : values)
      all.push_back(std::remainder(q[static_cast<Eigen::Index>(joint)] - value, 2 * kPi));
    const auto names = names_at(q);
    for (const symbolic::Expression& e : conditions) all.push_back(symbolic::evaluate(e, names));
    return Eigen::Map<VectorXd>(all.data(), std::ssize(all));
  }
  MatrixXd gradients(const VectorXd& q) const {
    constexpr double kStep = 1e-6;
    MatrixXd result(residuals(q).size(), q.size());
    for (Eigen::Index i = 0; i < q.size(); ++i) {
      VectorXd more = q, less = q;
      more[i] += kStep, less[i] -= kStep;
      result.col(i) = (residuals(more) - residuals(less)) / (2 * kStep);
    }
    return result;
  }
  /// Steps of Newton and Gauss to it.
  std::optional<VectorXd> point_near(VectorXd q) const {
    if (block) return singular_near([&](const VectorXd& x) { return smallest_value(held(x)); }, held(q));
    for (int iteration = 0; iteration < 50; ++iteration) {
      const VectorXd r = residuals(q);
      if (r.cwiseAbs().maxCoeff() < 1e-12) return q;
      q -= gradients(q).completeOrthogonalDecomposition().solve(r);
    }
    return std::nullopt;
  }
  /// To first order.
  double distance(const VectorXd& q) const {
    if (block) return std::max((q - held(q)).cwiseAbs().maxCoeff(), smallest_value(held(q)));
    return gradients(q).completeOrthogonalDecomposition().solve(residuals(q)).norm();
  }
};

symbolic::Mechanism mechanism_of(const Arm& arm) {
  return study::parse_model({.text = arm.text(), .file = "arm.cuik"}).mechanism;
}

/// None where the set has one part with a kernel vector.
std::vector<Part> parts_of(const symbolic::Mechanism& mechanism) {
  std::vector<Part> parts;
  for (const symbolic::SetPart& part : symbolic::set_parts(mechanism, symbolic::SingularitySet::inverse)) {
    const auto& component = std::get<symbolic::Component>(part);
    Part& own = parts.emplace_back(
        Part{component.name, {}, component.conditions, symbolic::constant_values(mechanism), component.block});
    for (const auto& [joint, value] : component.values)
      own.values.emplace(std::stoul(joint.substr(1)) - 1, symbolic::evaluate(value, {{"pi", kPi}}));
  }
  if (parts.size() == 1 && parts.front().block) parts.clear();
  return parts;
}

TEST(RankLoss, IsThatOfTheJacobianInDoubles) {
  std::size_t arms = 0, with_matrices = 0, names = 0, on_parts = 0, found = 0;
  for (unsigned seed = 1; seed <= test::seeds(12); ++seed) {
    Random random(seed);
    const Arm arm = seed % 4 == 3 ? random.arm_with_shoulder() : random.arm(seed % 4 != 0);
    SCOPED_TRACE(arm.text());
    const std::vector<Part> parts = parts_of(mechanism_of(arm));
    if (parts.empty()) continue;
    ++arms, names += parts.size();
    with_matrices += std::ranges::any_of(parts, [](const Part& part) { return part.block.has_value(); });
    for (const Part& part : parts)
      for (int trial = 0; trial < 5; ++trial) {
        std::optional<VectorXd> q = part.point_near(random.configuration(arm.rows.size()));
        if (!q) continue;
        ++on_parts;
        q = part.held(*q);
        EXPECT_LT(arm.smallest_value(*q), 1e-6) << part.name << " at " << q->transpose();
      }
    for (int trial = 0; trial < 40; ++trial) {
      const auto q =
          singular_near([&](const VectorXd& x) { return arm.smallest_value(x); }, random.configuration(arm.rows.size()));
      if (!q) continue;
      ++found;
      double nearest = std::numeric_limits<double>::infinity();
      for (const Part& part : parts) nearest = std::min(nearest, part.distance(*q));
      EXPECT_LT(nearest, 1e-3) << "lost: " << q->transpose();
    }
  }
  std::cout << fmt::format(
      "{} arms with {} parts, of {} some with a matrix, {} configurations on these, {} singular ones found\n", arms, names,
      with_matrices, on_parts, found);
  EXPECT_GT(with_matrices, 0U);
  EXPECT_GT(arms, 6U);
  EXPECT_GT(on_parts, 50U);
  EXPECT_GT(found, 50U);
}

constexpr const char* kSevenJoints = R"([DH]
standard
a alpha d theta
0 -90deg 0.34 q1 limits [-170deg, 170deg]
0 90deg 0 q2 limits [-120deg, 120deg]
0 90deg 0.4 q3 limits [-170deg, 170deg]
0 -90deg 0 q4 limits [-120deg, 120deg]
0 -90deg 0.4 q5 limits [-170deg, 170deg]
0 90deg 0 q6 limits [-120deg, 120deg]
0 0 0.126 q7
[OUTPUTS]
tip : )";

std::vector<std::string> names_of_parts(const result::Result& result) {
  std::vector<std::string> names;
  for (const result::Result& part : result.parts) names.push_back(part.part);
  return names;
}

// Of the pose: the arm stretched; the first and the third axis in a line, and the shoulder or the wrist beside it; likewise
// the fifth and the seventh.
TEST(RankLoss, OfAShoulderAnElbowAndAWristIsKnown) {
  const auto solved = [](const std::string& output) {
    study::Options options;
    options.search.surfaces_whole = true;
    const auto model = study::parse_model({.text = kSevenJoints + output + " of tool\n", .file = "arm.cuik"});
    return study::answer({.model = model.mechanism, .set = symbolic::SingularitySet::inverse}, options);
  };
  const result::Result pose = solved("pose");
  EXPECT_TRUE(pose.cover.complete());
  EXPECT_EQ(pose.cover.count(Verdict::undecided), 0U);
  EXPECT_EQ(names_of_parts(pose), (std::vector<std::string>{"q4 = 0", "q2 = 0, q3 = -pi/2", "q2 = 0, q3 = pi/2",
                                                            "q2 = 0, q6 = 0", "q5 = -pi/2, q6 = 0", "q5 = pi/2, q6 = 0"}));
  const result::Result position = solved("position");
  EXPECT_TRUE(position.cover.complete());
  EXPECT_EQ(position.cover.count(Verdict::undecided), 0U);
  EXPECT_EQ(names_of_parts(position),
            (std::vector<std::string>{"q4 = 0, q6 = 0", "q2 = 0, q3 = -pi/2, q6 = 0", "q2 = 0, q3 = pi/2, q6 = 0",
                                      "q2 = 0, q3 = 0, q4 = 0, q5 = -pi/2", "q2 = 0, q3 = 0, q4 = 0, q5 = pi/2"}));
}

// The first three axes meet in a point, at which the tip never is. Where q2 is not 0 the rank is lost where the line from
// there to the tip meets all axes: three conditions on the three joints beyond.
TEST(RankLoss, OfAShoulderIsByTheLineFromItToTheTip) {
  study::Options options;
  options.search.surfaces_whole = true;
  const auto model = study::parse_model({.text = R"([DH]
modified
a alpha d theta
0 0 0.333 q1 limits [-166deg, 166deg]
0 -90deg 0 q2 limits [-100deg, 100deg]
0 90deg 0.316 q3 limits [-165deg, 165deg]
0.0825 90deg 0 q4 limits [-176deg, -4deg]
-0.0825 -90deg 0.384 q5 limits [-165deg, 165deg]
0 90deg 0 q6 limits [-1deg, 215deg]
0.088 90deg 0.107 q7 limits [-165deg, 165deg]
[OUTPUTS]
tip : position of tool
)",
                                         .file = "panda.cuik"});
  const study::Question question{.model = model.mechanism, .set = symbolic::SingularitySet::inverse};
  const result::Result position = study::answer(question, options);
  EXPECT_EQ(names_of_parts(position),
            (std::vector<std::string>{"44*cos(q6) + 53.5*sin(q6) = 0, 2 conditions on q4, q5, q6",
                                      "q5 = 0, 2 conditions on q4, q6", "q2 = 0, a kernel vector in q3, q4, q5 and q6"}));
  EXPECT_TRUE(position.cover.complete());
  const std::vector<study::Question> parts = study::parts_of(question);
  for (const std::size_t i : {0U, 1U}) {
    solve::Control control;
    const Cover points = study::answer(parts.at(i), study::system(parts[i]), options, control).cover;
    EXPECT_EQ(points.points.size(), 2 - i);
    EXPECT_EQ(points.boxes.size(), 2 - i);
  }
  EXPECT_LT(100 * position.cover.count(Verdict::undecided), position.cover.boxes.size());
}

// A joint's range may be turns away: its sine and cosine are the same.
TEST(RankLoss, IsTheSameSomeTurnsAway) {
  constexpr const char* kPanda = R"([DH]
modified
a alpha d theta
0 0 0.333 q1
0 -90deg 0 q2 limits [-100deg, 100deg]
0 90deg 0.316 q3 limits [-165deg, 165deg]
0.0825 90deg 0 q4 limits {}
-0.0825 -90deg 0.384 q5 limits [-165deg, 165deg]
0 90deg 0 q6 limits [0deg, 215deg]
0.088 90deg 0.107 q7
[OUTPUTS]
tip : pose of tool
)";
  const std::string stretched = std::string(kSevenJoints) + "pose of tool\n";
  const auto relations = [](const std::string& text) {
    std::vector<std::string> result;
    const auto model = study::parse_model({.text = text, .file = "arm.cuik"});
    for (const symbolic::SetPart& part : symbolic::set_parts(model.mechanism, symbolic::SingularitySet::inverse))
      result.push_back(std::get<symbolic::Component>(part).relation());
    return result;
  };
  const auto range = [](int turns, int from, int to) {
    return fmt::format("[{}deg, {}deg]", 360 * turns + from, 360 * turns + to);
  };
  for (const int turns : {0, 1, 2, 3, -1, -2, -4}) {
    SCOPED_TRACE(turns);
    std::string arm = stretched;
    const std::string own = "q4 limits [-120deg, 120deg]";
    arm.replace(arm.find(own), own.size(), "q4 limits " + range(turns, -20, 40));
    const std::string zero = turns == 0             ? "0"
                             : std::abs(turns) == 1 ? (turns < 0 ? "-2*pi" : "2*pi")
                                                    : fmt::format("{}*pi", 2 * turns);
    const std::vector<std::string> found = relations(arm);
    EXPECT_EQ(found.size(), 6U);
    EXPECT_NE(std::ranges::find(found, "q4 = " + zero), found.end());
    // One of its minors vanishes at q4 = -0.467, no multiple of 90 degrees.
    EXPECT_EQ(relations(fmt::format(fmt::runtime(kPanda), range(turns, -176, -4))),
              relations(fmt::format(fmt::runtime(kPanda), range(0, -176, -4))));
  }
}

}  // namespace
}  // namespace corank
