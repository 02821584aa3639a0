// The words of the model language: which names are functions, which are reserved, what a number may look like.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "corank/symbolic/model/model_error.h"

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
/// "a, b, c"
std::string joined(const std::vector<std::string>& words, const std::string& between = ", ");
/// "x, y and z".
std::string listed(const std::vector<std::string>& words, const std::string& last = " and ");
/// "box" of 1, else "boxes": the plural of an English noun, by its last letter.
std::string noun(std::size_t n, const std::string& word);
/// "1 box", "2 inequalities".
std::string counted(std::size_t n, const std::string& word);
/// The text without the blanks around it.
std::string_view trimmed(std::string_view text);

/// The fewest letters to insert, delete or replace that turn a into b. Capital letters count as small ones.
std::size_t edit_distance(std::string_view a, std::string_view b);
/// The known name that an author may have meant: the one with the least edit_distance, where that is small for the length of
/// both. Empty where no known name is that near.
std::string nearest_name(const std::string& name, const std::vector<std::string>& known);
/// "; did you mean 'hand'?" or nothing.
std::string suggestion(const std::string& name, const std::vector<std::string>& known);

}  // namespace corank::symbolic
