// The question about a ball: which coordinates it lies in, where its centre is, and what the others may do meanwhile. It
// makes the model that has the configurations in question and no others; a singularity keeps its meaning there.
//
// Distance: sqrt of the sum of (x_i − a_i)², a_i the centre; an angle counts in radians, and the shorter way round. So
// that the distance is an expression in coordinates, such an angle becomes a length in [a_i − pi, a_i + pi], of which the
// equations take the sine and cosine as before.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "corank/study/question.h"

namespace corank::analyze {

struct NamedValue {
  std::string name;
  symbolic::Expression value;
};
struct NamedRange {
  std::string name;
  symbolic::Expression lower, upper;
};
/// Of what was asked about a model, without a place in its text.
symbolic::ModelError question_error(const study::Question& question, const std::string& problem,
                                    const std::string& expectation);
symbolic::ModelError unknown_coordinate(const study::Question& question, const std::string& name);

/// Row by row, in constants or coordinates.
using Rotation = std::array<std::array<symbolic::Expression, 3>, 3>;

/// "Rz(1/5)*Ry(pi/10)": a product of turns about the axes x, y, z. Throws ModelError.
Rotation parse_rotation(const std::string& text);

struct BallOptions {
  std::vector<NamedValue> at{};      ///< those of `in`, and others that keep their value, or stay near it
  std::vector<std::string> in{};     ///< the ball's coordinates
  std::vector<NamedRange> ranges{};  ///< coordinates that are kept within another range than the model's
  /// Angles among the outputs that have a value and are not in the ball stay within so much of it; likewise the orientation.
  std::optional<symbolic::Expression> orientation_range{};
  std::optional<Rotation> orientation{};  ///< of a spatial robot
  std::string orientation_of{};           ///< its link or rotation matrix; empty: the one there is
};

struct Ball {
  /// Its model has the configurations in question; without constants put in and assembly, which are in the model.
  study::Question question;
  std::vector<NamedValue> center;  ///< of the ball's coordinates, in the order of BallOptions::in

  std::string set_name() const;
  std::vector<std::string> names() const;  ///< of the ball's coordinates
  /// x_i − a_i.
  std::vector<symbolic::Expression> differences() const;
  /// The same model with the inequality that the distance is `radius` at most.
  symbolic::Mechanism within(const symbolic::Expression& radius) const;
  symbolic::Mechanism assembled;  ///< the model where all that has a value has that value
  /// How far the ball may reach without leaving the range, or the limits, of one of its coordinates; infinite where none has
  /// one. Beyond, nothing is searched.
  double room = 0;
  std::string end;  ///< that it meets there: "the upper limit of theta2", "the lower end of the range of x"
};

/// Throws ModelError where a name is none, a value is missing or outside the model's range, or the robot has no orientation.
Ball make_ball(const study::Question& question, const BallOptions& options);

}  // namespace corank::analyze
