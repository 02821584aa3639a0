// The parts language: the CUIK suite's .world files, all of their geometry, and corank's additions to it (named points and
// joints, actuated joints, limits, outputs). doc/parts.md describes it for users.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "corank/kinematics/robot/robot.h"

namespace corank::kinematics {

/// Has the text a section [LINKS] or [INCLUDE] outside its comments? Then it is in the parts language; else, in a .cuik
/// file, in the model language of equations.
bool has_parts(std::string_view text);

/// Parses a robot and validates it (Robot::validate). `file` is the name that messages show. Other files that the text
/// names (INCLUDE, EQFILE, bodies) are looked for in `folder`, those of an included file in its own folder; without a
/// folder INCLUDE is refused, and the others count as missing. Throws ModelError with file, line and column at the first
/// fault; never crashes or recurses without bound, whatever the text (tests/fuzz).
///
/// Where both ends' axes of a prismatic joint differ, a file that is called .world keeps the links parallel, as the suite
/// does, and slides along the first; any other is refused.
Robot parse_parts(std::string_view text, const std::string& file,
                  const std::optional<std::filesystem::path>& folder = std::nullopt);

/// Adds what a text says to a robot that another reader has begun, and validates it: links, joints (also in a section called
/// [LOOPS]), inputs, outputs. The first link may be called ground. INCLUDE is refused, other files count as missing.
void parse_more(Robot& robot, std::string_view text, const std::string& file);

}  // namespace corank::kinematics
