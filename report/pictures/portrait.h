// Flat pictures for papers, .svg, .pdf and .png: the boxes of a picture with two axes, on axes with ticks and names, with a
// legend.
//
// Boxes that cannot be told apart at 1200 dots per inch become one shape: each box is rounded outward to cells of that size,
// and the union of the cells is drawn as few polygons. So a box is never left out, and what is drawn sticks out of the boxes
// by one cell at most, but for the thin outline and the marks that make points and thin boxes visible.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "corank/report/pictures/picture.h"

namespace corank::report {

struct PortraitOptions {
  std::string title;
  bool legend = true;
  double width_mm = 85;        ///< of the whole picture, 20 to 1000; 85 is a column of a paper
  double dots_per_inch = 300;  ///< of a .png
  /// In points (1/72 inch): the width of the line about a shape, and the radius of the disc on what is smaller than the
  /// disc. 0: none.
  double outline = 0.5, mark = 1.5;
  /// Of the axes, for pictures that are to be compared; nothing: what the boxes need.
  std::optional<std::array<Interval, 2>> ranges;
};

/// True for the names that write_portrait knows: .svg, .pdf, .png.
bool is_portrait_format(const std::filesystem::path& path);

/// False where corank was built without Cairo, which draws .pdf and .png.
bool can_write_pdf();

/// Throws ResultFileError, which says what is missing, for a .pdf or .png where can_write_pdf() is false.
void check_can_draw(const std::filesystem::path& path);

/// Writes the picture in the format that the name ends in. Lengths on both axes have one scale, and so have angles. Throws
/// std::invalid_argument where the format is unknown, the width is out of range, there are not two axes, or there is no box
/// and no range; ResultFileError where the file cannot be written, as check_can_draw() does.
void write_portrait(const std::filesystem::path& path, const Picture& picture, const PortraitOptions& options);

/// Small multiples: each picture as member-1.svg …, with its title and the same axes as the others, and all side by side as
/// family.svg. The pictures have the same two axes. Returns the names of the files, none where no picture has a box. Throws
/// ResultFileError where one cannot be written.
std::vector<std::string> write_small_multiples(const std::filesystem::path& folder, const std::vector<Picture>& pictures,
                                               const std::vector<std::string>& titles);

}  // namespace corank::report
