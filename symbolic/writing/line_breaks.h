// Long lines of formulas, broken at their operators so that people can read them.
//
// Example: "a + b - c" at a width of 6 becomes "a + b" and, on a line of its own, "- c".
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace corank::symbolic {

inline constexpr std::size_t kLineWidth = 100;  ///< columns; a single term may be longer

/// The characters of UTF-8.
std::size_t columns(std::string_view text);
/// With blanks behind it, in bytes.
std::string padded(std::string text, std::size_t width);
/// A comment must stay on its line: line ends become blanks.
std::string one_line(std::string text);

/// A formula whose first line begins behind `first` columns. Lines that do not fit end before " + ", " - ", " & " or a
/// relation, or behind a comma; those that follow are indented by `indent`.
std::string broken(const std::string& formula, std::size_t first, std::size_t indent);

/// A text in the model language, which says the same: lines end where its grammar lets them, and a constant's value is put
/// in parentheses, in which they may. Comments stay whole.
std::string broken_model(const std::string& text);

/// LaTeX, line by line. Comments stay whole.
std::string broken_latex(const std::string& text);

}  // namespace corank::symbolic
