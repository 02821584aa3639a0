// What knows a font: widths of texts for every picture, and the formats that are drawn with it, .pdf and .png.
//
// Cairo does that (canvas_cairo.cc). Without it (canvas_missing.cc) widths are those of Helvetica, the font that pictures
// ask for, and .svg is the only format; CMake chooses.
#pragma once

#include <string>

#include "corank/report/layout.h"

namespace corank::report {

/// Widths at any size, whatever the resolution.
TextWidth font_widths();

/// The bytes of the file `name`. Throw ResultFileError where they cannot be made.
std::string to_pdf(const Layout& drawing, const std::string& title, const std::string& name);
std::string to_png(const Layout& drawing, double dots_per_inch, const std::string& name);

}  // namespace corank::report
