// A mechanism as text of the model language, for people to read on: one thing to a line, names aligned.
#pragma once

#include <string>

#include "corank/symbolic/mechanism.h"

namespace corank::symbolic {

/// parse_model reads it back as an equal mechanism: the same names, kinds, ranges, trees of expressions and order of
/// everything, with the constants' values as they are now. What the language has no words for is left out or a comment: the
/// mechanism's name, notes of constraints, a unit of length that is no name. Requires what validate() asks for.
std::string to_model(const Mechanism& mechanism);

}  // namespace corank::symbolic
