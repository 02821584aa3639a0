// The words of the model language: which names are functions, which are reserved, what a number may look like.
#pragma once

#include <string>
#include <string_view>

#include "corank/symbolic/model_error.h"

namespace corank::symbolic {

/// Letters, digits and _ (ASCII), beginning with no digit.
bool is_identifier(std::string_view name);
/// sin, cos, tan, asin, acos, atan, sqrt, exp, log, abs.
bool is_function_name(std::string_view name);
/// "sin, cos, …", for messages.
std::string function_names();
/// The functions and pi: no constant and no variable may be called so.
bool is_reserved(std::string_view name);

/// An unsigned decimal as the language keeps it: "0.90" and "1e-6" as they are; ".5", "5.", "1E+3" as "0.5", "5", "1e3".
/// Throws ModelError where the text is no number, has more than 10,000 digits, or an exponent of ten beyond ±400.
std::string normal_decimal(std::string_view text, const SourceLocation& where);

/// At most 40 bytes of a text, "…" behind them where it is longer; and the same in quotes. For messages.
std::string shortened(std::string_view text);
std::string in_quotes(std::string_view text);
/// "1 point", "2 points".
std::string counted(std::size_t n, const std::string& noun);

}  // namespace corank::symbolic
