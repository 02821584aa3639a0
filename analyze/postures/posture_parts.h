// What a question about postures is asked of, prepared once: in what equations, and what its solutions are called.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "corank/analyze/postures/postures.h"
#include "corank/kinematics/equations/six_joints.h"
#include "corank/solve/search/solve.h"

namespace corank::analyze {

struct PostureFinder::Parts {
  PostureQuestion question;
  std::optional<std::size_t> hand;  // the link whose orientation is given, in the robot
  std::size_t turned = 0;           // the output that has it
  // Of an output of the hand: the components of its position among the given coordinates, and its point in the hand's frame.
  std::optional<std::array<std::size_t, 3>> position;
  std::array<symbolic::Expression, 3> hand_point{0, 0, 0};
  std::vector<std::pair<std::size_t, std::size_t>> locked;  // joints with values, beside a whole pose; which given ones
  std::optional<kinematics::SixJoints> six;                 // of locked joints where their values are known
  std::vector<std::string> names;
  int freedom = 0;  // by the numbers of coordinates, equations and values

  const kinematics::Robot* robot() const {
    return question.question.assembly ? question.question.assembly->robot.get() : nullptr;
  }
  bool is_whole_pose() const { return hand && position && question.given.size() == 3 + locked.size(); }
  /// With these values of locked joints.
  kinematics::Robot robot_at(const std::vector<symbolic::Expression>& values) const;
  symbolic::ModelError error(const std::string& problem, const std::string& expected) const {
    return question_error(question.question, problem, expected);
  }
  void find_hand();
  void find_position();
  void find_locked();
  void find_names();

  using Values = std::vector<symbolic::Expression>;
  std::array<symbolic::Expression, 3> origin_at(const Values& values, const Rotation& orientation) const;
  symbolic::Mechanism six_held(const Values& values, const Rotation& orientation) const;
  symbolic::Mechanism hand_held(const Values& values, const Rotation& orientation) const;
  /// Nothing where a value is outside its range.
  std::optional<symbolic::Mechanism> coordinates_held(const Values& values,
                                                      const std::optional<Rotation>& orientation) const;
  /// With these values. Nothing where one is outside its range.
  std::optional<symbolic::Mechanism> model_at(const Values& asked, const std::optional<Rotation>& turn) const;
  std::vector<CoordinateValue> values_of(const System& system, const Box& box) const;
  void include(const System& system, const Box& box, PostureFamily& family) const;
  void take(const solve::Prepared& prepared, const Cover& cover, const solve::Control& control, Postures& result) const;
  static bool is_in_range(const symbolic::Mechanism& model, const std::string& name, const symbolic::Expression& value);
};

/// A coordinate's range, enclosed; its ends are expressions in the model's constants.
Interval range_of(const symbolic::Mechanism& model, const std::string& name, const symbolic::Expression& lower,
                  const symbolic::Expression& upper);

}  // namespace corank::analyze
