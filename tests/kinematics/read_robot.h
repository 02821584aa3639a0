// Robots from files, before they are assembled.
#pragma once

#include "corank/kinematics/language/part_file.h"
#include "corank/kinematics/urdf/urdf.h"
#include "corank/symbolic/model/model_file.h"

namespace corank::kinematics {

inline Robot read_part_file(const std::filesystem::path& path) {
  return parse_parts(symbolic::read_text(path), path.string(), path.parent_path());
}

inline Robot read_urdf(const std::filesystem::path& urdf, const std::optional<std::filesystem::path>& loops = {}) {
  std::optional<UrdfLoops> companion;
  if (loops) companion = {symbolic::read_text(*loops), loops->string()};
  return parse_urdf(symbolic::read_text(urdf), urdf.string(), companion);
}

}  // namespace corank::kinematics
