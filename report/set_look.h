// How reports call and show the sets of symbolic/set_definition.h: in words, in colours, in which order.
#pragma once

#include <array>
#include <optional>

#include "corank/symbolic/set_definition.h"

namespace corank::report {

struct SetLook {
  std::optional<symbolic::SingularitySet> set;  ///< nothing: the solutions of a plain system

  const char* title;      ///< "Forward singularities"
  const char* member;     ///< one of them, "Forward singularity"
  const char* label;      ///< in a picture's legend, "forward locus"; empty: the file's name
  const char* meaning;    ///< one clause
  const char* of_corank;  ///< the same of a corank {} of 2 or more
  const char* none;       ///< what it says of the mechanism that there is none
  /// The last three where the mechanism brings its own velocity equation and that makes a difference; else null.
  const char *given_meaning = nullptr, *given_of_corank = nullptr, *given_none = nullptr;

  std::array<double, 3> print;     ///< colour on paper: red, green and blue, each from 0 to 1
  const char *on_light, *on_dark;  ///< on a page, in CSS
  int layer = 0;                   ///< higher ones are drawn over lower ones
  double dot = 0;                  ///< radius of an isolated point on a page, in pixels
};

const SetLook& look(const symbolic::SetDefinition& set);

}  // namespace corank::report
