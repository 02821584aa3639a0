// Names and colours of the sets in a picture.
#pragma once

#include "corank/report/picture.h"

namespace corank::report {

/// What the layers of a source are called and coloured where colours tell sets apart.
struct SetStyle {
  std::string label;
  Color color;
  double opacity = 1;
};

/// Several sources of one set get their files' names and shades of its colour; several of other sets, colours of their own.
std::vector<SetStyle> set_styles(const std::vector<const PictureSource*>& sources);

}  // namespace corank::report
