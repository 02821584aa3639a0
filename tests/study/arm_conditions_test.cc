// The parts of random arms' inverse sets, against the determinant of a Jacobian by other kinematics.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <random>

#include "corank/study/answer.h"
#include "corank/study/model.h"
#include "corank/symbolic/model/evaluate.h"
#include "corank/tests/seeds.h"

namespace corank::study {
namespace {

using std::numbers::pi;
using symbolic::SingularitySet;

// Six revolute joints by rows of Denavit and Hartenberg, their axes parallel or perpendicular to the next; and the
// determinant of the Jacobian by the textbook: columns (z × (p − o), z).
struct RandomArm {
  struct Row {
    double a, d;
    int quarters;  // of a turn, alpha
  };

  explicit RandomArm(unsigned seed) {
    std::mt19937 random(seed);
    const auto below = [&](unsigned n) { return static_cast<int>(random() % n); };
    text = "[DH]\nstandard\na alpha d theta\n";
    for (int i = 0; i < 6; ++i) {
      const auto length = [&] { return below(2) == 0 ? 0.0 : (1 + below(40)) / 20.0; };
      rows.push_back({length(), length(), i == 5 ? 0 : below(4) == 0 ? 0 : below(2) == 0 ? 1 : -1});
      text += fmt::format("{} {}deg {} q{}\n", rows[i].a, 90 * rows[i].quarters, rows[i].d, i + 1);
    }
    text += "[OUTPUTS]\nhand : pose of tool\n";
  }

  double determinant(const std::map<std::string, double>& q) const {
    Eigen::Matrix3d turned = Eigen::Matrix3d::Identity();
    Eigen::Vector3d at = Eigen::Vector3d::Zero();
    std::vector<Eigen::Vector3d> axes, places;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      axes.emplace_back(turned.col(2));
      places.push_back(at);
      const double t = q.at(fmt::format("q{}", i + 1)), alpha = rows[i].quarters * pi / 2;
      Eigen::Matrix3d about_z, about_x;
      about_z << std::cos(t), -std::sin(t), 0, std::sin(t), std::cos(t), 0, 0, 0, 1;
      about_x << 1, 0, 0, 0, std::cos(alpha), -std::sin(alpha), 0, std::sin(alpha), std::cos(alpha);
      at += turned * (about_z * Eigen::Vector3d(rows[i].a, 0, rows[i].d));
      turned = turned * about_z * about_x;
    }
    Eigen::Matrix<double, 6, 6> jacobian;
    for (std::size_t i = 0; i < axes.size(); ++i)
      jacobian.col(static_cast<Eigen::Index>(i)) << axes[i].cross(at - places[i]), axes[i];
    return jacobian.determinant();
  }

  std::vector<Row> rows;
  std::string text;
};

double value_of(const symbolic::Component& part, const std::map<std::string, double>& q) {
  if (part.condition) return symbolic::evaluate(*part.condition, q);
  const symbolic::DependentAngle& angle = part.dependent_angle.value();
  return std::sin((q.at(angle.angle) - angle.sign * q.at(angle.other) - angle.quarters * pi / 2) / 2);
}

TEST(SetPartsOf, RandomArmsOfSixJointsAreConditionsOnTheirJoints) {
  constexpr double kZero = 1e-7;
  int arms = 0, on_parts = 0, on_determinants = 0, with_vectors = 0;
  for (unsigned seed = 1; seed <= test::seeds(10); ++seed) {
    SCOPED_TRACE(seed);
    const RandomArm arm(seed);
    std::mt19937 random(seed);
    const auto point = [&] {
      std::map<std::string, double> q;
      for (int i = 1; i <= 6; ++i) q[fmt::format("q{}", i)] = std::uniform_real_distribution<>(-pi, pi)(random);
      return q;
    };
    // Between two random points, by bisection.
    const auto zero = [&](const auto& f) -> std::optional<std::map<std::string, double>> {
      std::map<std::string, double> from = point(), to = point();
      const bool positive = f(from) > 0;
      if (positive == (f(to) > 0)) return std::nullopt;
      for (int step = 0; step < 60; ++step) {
        auto middle = from;
        for (auto& [name, value] : middle) value = (value + to.at(name)) / 2;
        ((f(middle) > 0) == positive ? from : to) = middle;
      }
      return from;
    };
    const auto determinant = [&](const std::map<std::string, double>& q) { return arm.determinant(q); };
    if (std::fabs(determinant(point())) < 1e-12) continue;  // it is singular everywhere
    const Model robot = parse_model({arm.text, "arm.cuik"});
    const std::vector<Question> questions =
        parts_of({.model = robot.mechanism, .set = SingularitySet::inverse, .assembly = robot.assembly, .in_parts = true});
    std::vector<symbolic::Component> parts;
    for (const Question& question : questions)
      if (question.part) parts.push_back(std::get<symbolic::Component>(*question.part));
    const auto in_joints = [](const symbolic::Component& part) {
      return part.dependent_angle || (part.condition && part.condition->text().find("_link") == std::string::npos);
    };
    if (parts.empty() || !std::all_of(parts.begin(), parts.end(), in_joints)) {
      ++with_vectors;
      continue;
    }
    ++arms;
    for (const symbolic::Component& part : parts)
      for (int trial = 0; trial < 5; ++trial)
        if (const auto at = zero([&](const auto& q) { return value_of(part, q); })) {
          ++on_parts;
          EXPECT_LT(std::fabs(determinant(*at)), kZero) << part.name;
        }
    for (int trial = 0; trial < 10; ++trial)
      if (const auto at = zero(determinant)) {
        ++on_determinants;
        double least = 1;
        for (const symbolic::Component& part : parts) least = std::min(least, std::fabs(value_of(part, *at)));
        EXPECT_LT(least, 1e-4);  // of a factor that is there twice the square root
      }
    if (HasFailure()) break;
  }
  EXPECT_GT(arms, with_vectors);
  EXPECT_GT(on_parts, 2 * arms);
  EXPECT_GT(on_determinants, 2 * arms);
}

}  // namespace
}  // namespace corank::study
