// What is drawn of a mechanism's aspects, and what a report's page has of them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "corank/analyze/aspects/aspects.h"
#include "corank/report/pictures/region_map.h"

namespace corank::report {

struct PageAspects {
  std::string summary;              ///< in words
  std::string picture;              ///< an SVG; empty: none
  std::vector<std::string> labels;  ///< of the aspects, in their order
  std::vector<int> places;          ///< of the boxes of C-space: in which aspect, −1: not known. Empty: of none
};

/// Searches for the aspects of curves and surfaces, where the results hold their C-space as a whole. Nothing of others, of
/// matrices that are not square, and where a signal has ended the search. `limit`: what the page says has ended it else.
std::optional<PageAspects> page_aspects(const study::Question& question, const std::vector<const result::Result*>& results,
                                        int threads, const std::string& limit, solve::Control& control);

/// For the page's script: of each aspect its label and its colour, and two bytes for each box of C-space, its aspect's
/// number from 1; 0: none. "null" without places.
std::string aspects_json(const PageAspects& aspects);

/// The first two outputs, and the first two inputs, that are not held.
std::vector<std::string> drawn_coordinates(const symbolic::Mechanism& model);

/// The aspects in the plane of the first two of these coordinates and in that of the others. Requires aspects.drawing.
RegionMap aspects_picture(const std::string& model, const analyze::Aspects& aspects);

}  // namespace corank::report
