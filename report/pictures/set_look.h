// How reports call and show the sets of symbolic/model/set_definition.h: in words, in colours, in which order.
#pragma once

#include <optional>
#include <span>

#include "corank/symbolic/model/set_definition.h"

namespace corank::report {

/// Red, green and blue, each from 0 to 1.
struct Color {
  double red = 0, green = 0, blue = 0;
  friend bool operator==(const Color&, const Color&) = default;
};
/// Between colours at equal distances, of which the first is at 0 and the last at 1.
Color between(std::span<const Color> stops, double at);

struct Paint {
  Color print;                     ///< on paper
  const char *on_light, *on_dark;  ///< on a page, in CSS
};

struct SetLook {
  std::optional<symbolic::SingularitySet> set;  ///< nothing: the solutions of a plain system

  const char* title;           ///< "Forward singularities"
  const char* member;          ///< one of them, "Forward singularity"
  const char* label;           ///< in a picture's legend, "forward locus"; empty: the file's name
  const char* meaning;         ///< one clause
  const char* of_corank = "";  ///< the same of a corank {} of 2 or more
  const char* none = "There are none in the search domain.";  ///< and what it says of the mechanism that there is none
  /// The last three where the mechanism brings its own velocity equation and that makes a difference; else null.
  const char *given_meaning = nullptr, *given_of_corank = nullptr, *given_none = nullptr;

  struct Drawn {
    Paint paint;
    int layer = 0;     ///< higher ones are drawn over lower ones
    double dot = 6.2;  ///< radius of an isolated point on a page, in pixels
  } drawn;
};

const SetLook& look(const symbolic::SetDefinition& set);

}  // namespace corank::report
