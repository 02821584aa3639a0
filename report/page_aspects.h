// What a report's page has of a mechanism's aspects.
#pragma once

#include <string>
#include <vector>

#include "corank/analyze/aspects.h"

namespace corank::report {

struct PageAspects {
  std::string summary;              ///< in words
  std::string picture;              ///< an SVG; empty: none
  std::vector<std::string> labels;  ///< of the aspects, in their order
  std::vector<int> places;          ///< of the boxes of C-space: in which aspect, −1: not known. Empty: of none
};

/// Requires that something is known.
PageAspects page_aspects(const std::string& model, const analyze::Aspects& aspects);

/// What the page says where nothing is known.
PageAspects no_page_aspects(const std::string& why);

/// For the page's script: of each aspect its label and its colour, and two bytes for each box of C-space, its aspect's
/// number from 1; 0: none. "null" without places.
std::string aspects_json(const PageAspects& aspects);

}  // namespace corank::report
