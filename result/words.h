// Words and numbers for people: what terminals, pages and JSON texts are put together from.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "corank/core/interval.h"

namespace corank::result {

/// "box" of 1, else "boxes": the plural of an English noun, by its last letter.
std::string noun(std::size_t n, const std::string& word);
/// "1 box", "2 inequalities".
std::string counted(std::size_t n, const std::string& word);

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
/// "x, y and z".
std::string listed(const std::vector<std::string>& names);

/// The sentence with a capital letter.
std::string capitalized(std::string sentence);

/// "[0.59999999, 0.60000001]" with at most so many significant digits, rounded outward (below 1e-12 to 0 or
/// ±1e-12); one number where both ends agree.
std::string outward_text(const Interval& x, int digits);

}  // namespace corank::result
