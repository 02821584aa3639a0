// What corank derive says of a model, for programs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "corank/symbolic/left_out.h"
#include "corank/symbolic/mechanism.h"
#include "corank/symbolic/singularity_system.h"

namespace corank::result {

/// {"model", "robot", "constants", "coordinates", "inputs", "outputs", "constraints", "velocity", "left_out", "set",
/// "systems"}: the constraints, velocity equation and systems of a set, each expression in the model language. `robot`: of
/// parts, what they make. Without systems only the model's own members. `left_out`: what a robot's equations go without;
/// each follows from the constraints and rows with these numbers, from 1.
std::string derivation_json(const symbolic::Mechanism& mechanism, const std::optional<std::string>& robot,
                            const std::vector<symbolic::LeftOut>& left_out, const std::string& set,
                            const std::vector<symbolic::TrigonometricSystem>& systems);

}  // namespace corank::result
