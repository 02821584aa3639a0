// Arms of six joints from data sheets, with forward kinematics of their own.
#pragma once

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "corank/analyze/postures/postures.h"
#include "corank/study/model.h"

namespace corank::analyze {

using Eigen::Matrix4d;
using Eigen::Vector3d;
using Joints = Eigen::Matrix<double, 6, 1>;

struct Row {
  double a, alpha, d;  // degrees
};
struct Arm {
  const char* name;
  std::array<Row, 6> rows;
  int most;  // postures
};

// Data sheets: UR5 (Universal Robots), PUMA 560 (Corke 1994), CRX-10iA/L and GoFa 5 as in the literature on cuspidal robots.
inline const std::vector<Arm>& arms() {
  static const std::vector<Arm> list{
      {"ur5",
       {{{0, 90, 0.089159}, {-0.425, 0, 0}, {-0.39225, 0, 0}, {0, 90, 0.10915}, {0, -90, 0.09465}, {0, 0, 0.0823}}},
       8},
      {"puma", {{{0, 90, 0}, {0.4318, 0, 0}, {0.0203, -90, 0.15005}, {0, 90, 0.4318}, {0, -90, 0}, {0, 0, 0}}}, 8},
      {"crx", {{{0, -90, 0}, {0.71, 0, 0}, {0, -90, 0}, {0, 90, 0.54}, {0, -90, 0.15}, {0, 0, 0.16}}}, 16},
      {"gofa", {{{0, 90, 0.265}, {0.444, 0, 0}, {0.11, -90, 0}, {0, 90, 0.47}, {0.08, -90, 0}, {0, 0, 0.101}}}, 16},
  };
  return list;
}

inline study::Question arm_question(const Arm& arm, const std::string& after_each = "") {
  std::string text = "[CONSTANTS]\nunit m\n[DH]\nstandard\na alpha d theta\n";
  for (std::size_t k = 0; k < 6; ++k)
    text += std::to_string(arm.rows[k].a) + " " + std::to_string(static_cast<int>(arm.rows[k].alpha)) + "deg " +
            std::to_string(arm.rows[k].d) + " q" + std::to_string(k + 1) + " " + after_each + "\n";
  study::Model model = study::parse_model({text, std::string(arm.name) + ".cuik"});
  return {.model = std::move(model.mechanism), .assembly = std::move(model.assembly)};
}

inline Matrix4d hand(const Arm& arm, const Joints& q) {
  Matrix4d t = Matrix4d::Identity();
  for (std::size_t k = 0; k < 6; ++k) {
    const auto& [a, alpha, d] = arm.rows[k];
    Eigen::Affine3d step = Eigen::Affine3d::Identity();
    step.rotate(Eigen::AngleAxisd(q[static_cast<int>(k)], Vector3d::UnitZ()));
    step.translate(Vector3d(0, 0, d));
    step.translate(Vector3d(a, 0, 0));
    step.rotate(Eigen::AngleAxisd(alpha * M_PI / 180, Vector3d::UnitX()));
    t = t * step.matrix();
  }
  return t;
}

inline double difference(const Matrix4d& a, const Matrix4d& b) { return (a - b).cwiseAbs().maxCoeff(); }
inline double distance(const Joints& a, const Joints& b) {
  double most = 0;
  for (int k = 0; k < 6; ++k) most = std::max(most, std::fabs(std::remainder(a[k] - b[k], 2 * M_PI)));
  return most;
}

struct Pose {
  std::vector<symbolic::Expression> position;
  Rotation orientation;
};
inline symbolic::Expression exact(double x) { return symbolic::Expression(ExactNumber::dyadic(x).text()); }
inline Pose pose_of(const Matrix4d& t) {
  const Eigen::Quaterniond q(Eigen::Matrix3d(t.topLeftCorner<3, 3>()));
  return {{exact(t(0, 3)), exact(t(1, 3)), exact(t(2, 3))},
          rotation_of({ExactNumber::dyadic(q.w()), ExactNumber::dyadic(q.x()), ExactNumber::dyadic(q.y()),
                       ExactNumber::dyadic(q.z())})};
}

inline PostureFinder finder_of(const study::Question& question) {
  return PostureFinder({.question = question, .given = {"tool_x", "tool_y", "tool_z"}, .orientation = true});
}
inline Joints joints_of(const Posture& posture) {
  Joints q;
  for (int k = 0; k < 6; ++k) q[k] = posture.values.at(static_cast<std::size_t>(k)).value.mid();
  return q;
}

}  // namespace corank::analyze
