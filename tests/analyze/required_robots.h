// Robots of legs with kinematics of their own, and what is required of them.
#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <string>
#include <vector>

#include "corank/analyze/maps/parameter_map.h"
#include "corank/study/model.h"

namespace corank::analyze {

using Eigen::MatrixXd;
using Eigen::Vector2d;

// Legs of a crank and a rod each, from a ground joint to a point of the platform, which is at its origin + arm.
struct Leg {
  Vector2d ground, arm;
};

// Of each posture that puts the platform's origin at (x, y) without turning it: J with output rates = J · crank rates.
// Outputs are the position and, of three legs, the angle.
inline std::vector<MatrixXd> postures(const std::vector<Leg>& legs, double crank, double rod, double x, double y) {
  const auto n = static_cast<int>(legs.size());
  std::vector<MatrixXd> result;
  for (int branch = 0; branch < 1 << n; ++branch) {
    MatrixXd outputs(n, n), inputs = MatrixXd::Zero(n, n);
    for (int i = 0; i < n; ++i) {
      const Vector2d to = Vector2d(x, y) + legs[i].arm - legs[i].ground;
      const double cosine = (to.squaredNorm() + crank * crank - rod * rod) / (2 * crank * to.norm());
      if (!(std::fabs(cosine) <= 1)) return {};
      const double angle = std::atan2(to.y(), to.x()) + ((branch >> i & 1) != 0 ? 1 : -1) * std::acos(cosine);
      const Vector2d e = to - crank * Vector2d(std::cos(angle), std::sin(angle));
      outputs.row(i).head(2) = e.transpose();
      if (n == 3) outputs(i, 2) = e.y() * legs[i].arm.x() - e.x() * legs[i].arm.y();
      inputs(i, i) = crank * e.dot(Vector2d(-std::sin(angle), std::cos(angle)));
    }
    result.push_back(outputs.inverse() * inputs);
  }
  return result;
}

inline std::vector<MatrixXd> five_bar_postures(double x, double y, double l, double d) {
  return postures({{{d, 0}, {0, 0}}, {{0, 0}, {0, 0}}}, l, l, x, y);  // theta2 is the one at (d, 0)
}

inline double amplification(const MatrixXd& j) { return Eigen::JacobiSVD<MatrixXd>(j).singularValues()(0); }

inline study::Question required(study::Question question, const std::vector<std::string>& texts) {
  study::Model model{std::move(question.model), {}, {}};
  study::require(texts, model);
  question.model = std::move(model.mechanism);
  return question;
}

inline const MapCellAnswer* cell_at(const ParameterMap& map, double x, double y) {
  for (const MapCellAnswer& c : map.cells)
    if (c.sides[0].contains(x) && c.sides[1].contains(y)) return &c;
  return nullptr;
}

}  // namespace corank::analyze
