// The model language: CUIK's equation language and more sections, [INPUTS], [OUTPUTS], [RATES], [VELOCITY EQS], [DRAWING].
// doc/model_language.md describes it for users.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "corank/symbolic/mechanism.h"

namespace corank::symbolic {

/// Parses a model. `file` is the name that messages show. Throws ModelError with file, line and column at the first fault;
/// never crashes or recurses without bound, whatever the text (tests/fuzz).
Mechanism parse_model(std::string_view text, const std::string& file);

/// Reads a file; the mechanism is named after it ("models/dextar.cuik" → "dextar"). Throws ModelError where it can't be
/// read.
Mechanism read_model(const std::filesystem::path& path);

/// Parses one expression. Throws ModelError.
Expression parse_expression(std::string_view text, const std::string& file = "expression");

/// The same for a text in C++ code: messages show the text itself, and the tree has no places.
Expression parse_anonymous_expression(std::string_view text);

}  // namespace corank::symbolic
