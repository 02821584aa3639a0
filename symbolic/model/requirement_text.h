// A requirement as its author writes it (doc/as_built.md):
//   amplification(outputs) <= 2
//   amplification(inputs) <= 3 metric x: 1 mm, phi: 1 deg
//   torque(theta2) <= 3 N m under force(x, y) <= 50 N, moment(phi) <= 2 N m
//   tension(d1, d2, d3) in [5 N, 200 N] under force(y) = -98 N, force(x, y) <= 20 N
//   error(x, y) <= 0.1 mm under inputs <= 0.01 deg
//   distance(A B radius 3 mm, rod) >= 5 mm
//   pressure_angle(A B, P Q) <= 45 deg
//   transmission_angle(A B C) >= 45 deg
//   x^2 + y^2 <= 4
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "corank/symbolic/model/expression.h"
#include "corank/symbolic/model/set_definition.h"

namespace corank::symbolic {

struct Quantity {
  Expression value;
  std::string unit = {};  ///< "mm", "deg", "N", "N m" …; empty: the model's own
};

struct NamedQuantity {
  std::string name;
  Quantity quantity;
};

/// The largest ‖rates of this role‖ / ‖rates of the other‖ over the feasible velocities.
struct AmplificationLimit {
  Role role = Role::output;  ///< or input
  Quantity most;
  std::vector<NamedQuantity> metric;  ///< of a column: so much of it counts as 1
};

struct Load {
  bool moment = false;             ///< else a force
  std::vector<std::string> names;  ///< of the rates that it works on: any vector of that length at most
  Quantity most;
  bool constant = false;  ///< of one rate, always that
};

/// The largest torque or force of one motor under any of the loads, each at its worst.
struct EffortLimit {
  bool torque = true;
  std::string motor;
  Quantity most;
  std::vector<Load> loads;
};

/// What each cable pulls with: under any of the loads together, they can be chosen between these.
struct TensionLimit {
  std::vector<std::string> cables;  ///< all inputs
  Quantity least, most;
  std::vector<Load> loads;
};

/// The largest ‖change of these‖, to first order, where each input errs by its own bound at most.
struct ErrorLimit {
  std::vector<std::string> names;
  Quantity most;
  std::vector<NamedQuantity> inputs;  ///< the name "inputs" stands for all of them
};

/// The least distance of two bodies of the drawing (drawn_bodies.h).
struct DistanceLimit {
  struct Body {
    std::vector<std::string> names;    ///< of points whose hull it is, or its own
    std::optional<Quantity> radius{};  ///< around that
  };
  std::vector<Body> bodies;  ///< two
  Quantity least;
};

/// The largest angle between two lines through two points of the drawing each, from 0 to 90 degrees: one along which a force
/// acts, and one along which the point moves that it drives. least: the angle at the middle of three points is at least that
/// far from 0 and from 180 degrees.
struct LineAngleLimit {
  std::vector<std::vector<std::string>> points;
  bool least = false;
  Quantity limit;
};

struct RequirementText {
  std::variant<AmplificationLimit, EffortLimit, TensionLimit, ErrorLimit, DistanceLimit, LineAngleLimit, Relation> limit;
};

/// `begin`: where the text does. Throws ModelError, with the place, where the text is no requirement.
RequirementText parse_requirement(std::string_view text, const SourceLocation& begin = {"requirement", 1, 1});

}  // namespace corank::symbolic
