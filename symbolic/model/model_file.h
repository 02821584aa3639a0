// The model language: CUIK's equation language and more sections, [INPUTS], [OUTPUTS], [RATES], [VELOCITY EQS], [DRAWING].
// doc/model_language.md describes it for users.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "corank/symbolic/model/mechanism.h"

namespace corank::symbolic {

/// Longer texts are refused.
inline constexpr std::size_t kMaxFileBytes = std::size_t{8} << 20;

/// Parses a model. `file` is the name that messages show. Throws ModelError with file, line and column at the first fault;
/// never crashes or recurses without bound, whatever the text (tests/fuzz).
Mechanism parse_model(std::string_view text, const std::string& file);

/// Reads a file; the mechanism is named after it ("models/dextar.cuik" → "dextar"). Throws ModelError where it can't be
/// read.
Mechanism read_model(const std::filesystem::path& path);

/// The sections of a text that need not be a whole model: it may lack variables or equations, and names are not checked.
Mechanism parse_fragment(std::string_view text, const std::string& file);

/// A file's bytes, at most kMaxFileBytes + 1 of them. Throws ModelError where it can't be read.
std::string read_text(const std::filesystem::path& path);

/// Parses one expression. Throws ModelError.
Expression parse_expression(std::string_view text, const std::string& file = "expression");

/// What stands behind := in a model, an expression that may have a tolerance. Throws ModelError.
Constant parse_constant(const std::string& name, std::string_view text, const std::string& file = "constant");

/// The same for a text in C++ code: messages show the text itself, and the tree has no places.
Expression parse_anonymous_expression(std::string_view text);

}  // namespace corank::symbolic
