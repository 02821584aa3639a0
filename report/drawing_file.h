// Any layout as a file: .svg, .pdf or .png, which the name says.
#pragma once

#include <filesystem>
#include <string>

#include "corank/report/layout.h"

namespace corank::report {

/// Throws std::invalid_argument for another name, ResultFileError where the file cannot be written.
void write_drawing(const std::filesystem::path& path, const Layout& drawing, const std::string& title,
                   double dots_per_inch = 300);

/// A text's width in the font of these files.
double drawn_width(const Label& label, double size);

}  // namespace corank::report
