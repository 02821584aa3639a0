// How a name of a model is shown: theta2 → θ with the subscript 2, J3x → J with 3x, y_A → y with A.
#pragma once

#include <string>
#include <string_view>

namespace corank::symbolic {

struct DisplayName {
  std::string base;       ///< UTF-8; a Greek letter where the name's letters spell one
  std::string subscript;  ///< parts with commas between them; empty where there is none
};

DisplayName display_name(const std::string& name);

/// a to z, A to Z.
bool is_letter(char c);
/// "theta": does the word spell one?
bool is_greek_letter(std::string_view word);

/// & < > " as HTML entities.
std::string html_text(const std::string& text);
/// `<i>θ</i><sub>2</sub>`.
std::string html_name(const std::string& name);

}  // namespace corank::symbolic
