#include "corank/kinematics/denavit_hartenberg.h"

#include "corank/kinematics/vectors.h"

namespace corank::kinematics {
namespace {

Pose about_x(const DhRow& row) { return translation({row.a, 0, 0}) * rotation(0, row.alpha); }
Pose about_z(const DhRow& row) { return translation({0, 0, row.d}) * rotation(2, row.theta); }

/// A joint about the z axis of a frame, its angle counted from x.
JointEnd end_at(const Pose& frame, int sense) {
  const auto column = [&](std::size_t i) {
    return Vector{frame.rotation[0][i], frame.rotation[1][i], frame.rotation[2][i]};
  };
  JointEnd end;
  end.point = frame.translation;
  end.axis = sense > 0 ? column(2) : Vector{0, 0, 0} - column(2);
  end.zero = column(0);
  return end;
}

}  // namespace

Pose dh_pose(DhConvention convention, const DhRow& row) {
  return convention == DhConvention::standard ? about_z(row) * about_x(row) : about_x(row) * about_z(row);
}

std::array<JointEnd, 2> dh_ends(DhConvention convention, const DhRow& row, int sense) {
  if (convention == DhConvention::standard) return {end_at(about_z(row), sense), end_at(inverse(about_x(row)), sense)};
  return {end_at(about_x(row) * about_z(row), sense), end_at(Pose{}, sense)};
}

}  // namespace corank::kinematics
