// A mechanism as Python holds it: with what it takes to make it anew with other constants, or in another process.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "corank/study/model.h"

namespace corank::python {

struct Origin {
  study::ModelText model;
  std::optional<study::ModelText> loops;  ///< of a URDF file: its companion
};

struct Model {
  std::optional<Origin> origin;  ///< nothing: built, or changed, by the functions of Mechanism
  study::Model value;
  std::vector<result::ConstantOverride> constants;  ///< that were put in

  const symbolic::Mechanism& mechanism() const { return value.mechanism; }
  /// For a change. Throws ModelError where the equations come from a robot's parts.
  symbolic::Mechanism& changed();
};

Model make_model(Origin origin, std::vector<result::ConstantOverride> constants);

}  // namespace corank::python
