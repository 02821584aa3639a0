// Any bytes may come as a robot: parse_parts either returns one that validates or throws ModelError, in one line, with a
// place.
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string_view>

#include "corank/kinematics/language/part_file.h"
#include "corank/symbolic/model/model_file.h"

namespace {

using corank::kinematics::Joint;
using corank::kinematics::JointEnd;
using corank::kinematics::Link;
using corank::kinematics::Robot;
using corank::kinematics::Shape;
using corank::kinematics::Vector;
using corank::symbolic::Expression;

void require(bool condition, const char* what) {
  if (!condition) throw std::logic_error(what);
}

void round_trip(const Expression& e) {
  require(same_tree(corank::symbolic::parse_expression(e.text()), e), "a printed expression parses to another tree");
}

void round_trip(const Vector& v) {
  for (const Expression& e : v) round_trip(e);
}

void check(const Robot& robot) {
  for (const Link& link : robot.links) {
    for (const Shape& shape : link.shapes) {
      for (const Vector& point : shape.points) round_trip(point);
    }
  }
  for (const Joint& joint : robot.joints) {
    for (const JointEnd& end : joint.ends) {
      require(end.link < robot.links.size(), "a joint of a link that is not there");
      round_trip(end.point);
      round_trip(end.axis);
    }
    for (const Vector& row : joint.pose.rotation) round_trip(row);
  }
  robot.validate();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  corank::kinematics::has_parts(text);
  for (const char* const name : {"fuzzed.cuik", "fuzzed.world"}) {
    Robot robot;
    try {
      robot = corank::kinematics::parse_parts(text, name);
    } catch (const corank::symbolic::ModelError& error) {
      const std::string_view message = error.what();
      require(message.starts_with("fuzzed."), "an error without its place");
      require(message.find('\n') == std::string_view::npos, "a message of more than one line");
      continue;
    }
    check(robot);
  }
  return 0;
}
