// Any bytes may come as a URDF file: parse_urdf either returns a robot or throws ModelError. What it returns holds numbers
// that parse back to the same expressions, and names that are identifiers.
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string_view>

#include "corank/kinematics/urdf/urdf.h"
#include "corank/symbolic/model/expression_words.h"
#include "corank/symbolic/model/model_file.h"

namespace {

using namespace corank::kinematics;
using corank::symbolic::ModelError;

void require(bool condition, const char* what) {
  if (!condition) throw std::logic_error(what);
}

void round_trip(const Vector& v) {
  for (const Expression& e : v)
    require(same_tree(corank::symbolic::parse_expression(e.text()), e), "a printed expression parses to another tree");
}

void check_name(const std::string& name) { require(corank::symbolic::is_identifier(name), "a name that is no identifier"); }

void check_message(std::string_view message) {
  for (const char c : message) require(static_cast<unsigned char>(c) >= ' ', "a message with control characters");
}

void check(const Robot& robot) {
  check_message(robot.name);
  for (const std::string& notice : robot.notices) check_message(notice);
  for (const Link& link : robot.links) {
    check_name(link.name);
    for (const Shape& shape : link.shapes)
      for (const Vector& point : shape.points) round_trip(point);
  }
  for (const Joint& joint : robot.joints) {
    check_name(joint.name);
    for (const JointEnd& end : joint.ends) {
      require(end.link < robot.links.size(), "an end on no link");
      round_trip(end.point);
      round_trip(end.axis);
      if (end.zero) round_trip(*end.zero);
    }
    for (const Vector& row : joint.pose.rotation) round_trip(row);
    round_trip(joint.pose.translation);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  Robot robot;
  try {
    robot = parse_urdf(text, "fuzzed.urdf");
  } catch (const ModelError& error) {
    require(std::string_view(error.what()).starts_with("fuzzed.urdf"), "an error without its place");
    check_message(error.what());
    return 0;
  }
  check(robot);
  return 0;
}
