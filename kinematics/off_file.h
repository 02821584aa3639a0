// Bodies in Geomview's OFF and COFF formats, as far as a robot needs them: vertices, which joints may name by number, and faces.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "corank/kinematics/robot.h"

namespace corank::kinematics {

struct OffBody {
  std::vector<Vector> vertices;  ///< exactly as written
  std::vector<std::vector<std::size_t>> faces;
};

/// Throws ModelError with the line where the text is no such body, or is longer than a model may be.
OffBody parse_off(std::string_view text, const std::string& file);

}  // namespace corank::kinematics
