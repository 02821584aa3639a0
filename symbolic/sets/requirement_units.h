// Units in which requirements are given.
#pragma once

#include <string>

#include "corank/symbolic/model/mechanism.h"
#include "corank/symbolic/sets/requirement_fault.h"

namespace corank::symbolic {

enum class Dimension { number, length, angle, force, moment };
const char* word(Dimension dimension);  ///< "a number", "a length" …

/// Of a rate, or of a coordinate's velocity.
Dimension dimension_of(const Mechanism& mechanism, const std::string& name);

/// How many of the model's units one of these is: its unit of lengths, radians, newtons. `length`: that unit of lengths,
/// "mm" …; it may be empty. Throws RequirementFault for a unit of another dimension, and where one of lengths is not known.
Expression size_of_unit(const std::string& unit, Dimension wanted, const std::string& length);

}  // namespace corank::symbolic
