// Words and numbers for people: what terminals, pages and JSON texts are put together from.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "corank/core/exact_point.h"
#include "corank/core/interval.h"
#include "corank/core/system.h"
#include "corank/symbolic/model/expression_words.h"

namespace corank::result {

using symbolic::counted;
using symbolic::listed;
using symbolic::noun;

/// What is said of each item, with the text between them: "x, y, z".
template <class Items, class Text>
std::string joined(const Items& items, const Text& text, std::string_view between = ", ") {
  std::string all;
  bool first = true;
  for (const auto& item : items) {
    if (!first) all += between;
    all += std::invoke(text, item);
    first = false;
  }
  return all;
}
/// The sentence with a capital letter.
std::string capitalized(std::string sentence);

/// "[0.59999999, 0.60000001]" with at most `digits` significant digits, rounded outward (below 1e-12 to 0 or
/// ±1e-12); one number where both ends agree.
std::string outward_text(const Interval& x, int digits);

/// For text from files: nothing in it may steer a terminal. What a terminal may obey becomes visible, as "\x1b" or "\u202e":
/// control characters but line feeds and tabs, U+0080 to U+009F, the marks that turn the direction of text, and bytes that
/// are no UTF-8. Other text is returned as it is.
std::string printable(std::string_view text);

/// The same for a text within one line: line feeds and tabs are made visible, too.
std::string printable_line(std::string_view text);

/// "-3/5", "1/2*sqrt(3)": a coordinate of an exact point, where it has a short text; nothing, too, where what a file says of
/// the point defines no number.
std::optional<std::string> exact_coordinate(const ExactPoint& point, int variable);

/// "3*pi/4", where that is the angle, exactly, with `enclosure` to tell its turn. Nothing for other angles.
std::optional<std::string> multiple_of_pi(const ExactPoint& point, const Angle& angle, const Interval& enclosure);

/// That, or "atan2(4/5, 3/5)" with sine and cosine; nothing where these have no short text.
std::optional<std::string> exact_angle(const ExactPoint& point, const Angle& angle, const Interval& enclosure);

}  // namespace corank::result
