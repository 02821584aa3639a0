// The postures of an arm of six revolute joints whose hand has a given pose, in the fewest unknowns.
//
// With its hand held, the arm is one closed loop of six joints. Three neighbouring ones, a, b and c, carry two links, in
// each of which the two axes are not parallel. Let z_a, z_b, z_c be the unit vectors along the axes and O_a, O_c the joints'
// points. The first link says P_b − P_a = α z_a + β z_b + γ z_a × z_b, the second one P_c − P_b = α' z_b + β' z_c +
// γ' z_b × z_c, with constants. The angles of the other three joints give z_a, O_a, z_c and O_c. So the loop closes where
//
//   O_c − O_a = α z_a + (β + α') z_b + γ z_a × z_b + β' z_c + γ' z_b × z_c,
//   z_a · z_b = k_ab,  z_b · z_c = k_bc,  |z_b| = 1,
//
// six equations in three angles and z_b. Theorem: the solutions are the arm's postures, one for each. Given such z_b, there
// is one angle of a that turns its link's axis to z_b, since both have the same angle with z_a, and are no multiples of it;
// likewise for b and c; and the vectors between the points are those of the links.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "corank/kinematics/robot/robot.h"

namespace corank::kinematics {

/// Constants of a model that say where the hand is: x ↦ R x + p, R row by row. R has to be a rotation.
inline constexpr std::array<const char*, 12> kHandPose{"hand_R11", "hand_R12", "hand_R13", "hand_R21",
                                                       "hand_R22", "hand_R23", "hand_R31", "hand_R32",
                                                       "hand_R33", "hand_p1",  "hand_p2",  "hand_p3"};

struct SixJoints {
  struct Angle {
    std::string joint;
    /// A coordinate of the mechanism; or the names of those that are the angle's cosine and sine.
    std::string coordinate{}, cosine{}, sine{};
    std::optional<Range> range{};
  };
  symbolic::Mechanism mechanism;  ///< a plain system with the constants kHandPose; the joints' ranges are in it
  std::vector<Angle> angles;      ///< from the ground to the hand
};

/// Nothing where the link is not carried by a single chain of six revolute joints from the ground, one of them is led by
/// another or has a range of one value, or where each three neighbours have two parallel axes that follow one another.
/// Throws ModelError where the robot is faulty.
std::optional<SixJoints> six_joints(const Robot& robot, std::size_t hand);

/// Arms of six revolute joints of which three signs tell all postures of a pose apart, whereas none of these changes without
/// a singularity. So no motion without a singularity leads from one posture to another: they are not cuspidal. Theorem and
/// proof: doc/theory.md, "Arms that are not cuspidal".
enum class SignedArm {
  spherical_wrist,     ///< axes 4, 5 and 6 meet in a point, 1 ⟂ 2, 2 ∥ 3
  three_parallel_axes  ///< 2 ∥ 3 ∥ 4, 1 ⟂ 2, 4 ⟂ 5, axes 5 and 6 meet
};
/// Nothing for other robots, or if it is not known. Throws ModelError where the robot is faulty.
std::optional<SignedArm> signed_arm(const Robot& robot, std::size_t hand);

}  // namespace corank::kinematics
