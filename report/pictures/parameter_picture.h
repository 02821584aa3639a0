// A number over a plane of two parameters as regions in colours: one for each number, what is known of single points only as
// dots, what is not known grey, with the curve between them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "corank/core/interval.h"

namespace corank::report {

struct ParameterPicture {
  struct Cell {
    Interval x, y;
    std::optional<int> number;
    bool proven = false;  ///< for the whole cell; else for its centre alone
  };
  struct CurveBox {
    Interval x, y;
    bool proven = false;
  };
  std::string title, what;           ///< the model; what is counted, "forward-cusps"
  std::vector<std::string> words{};  ///< what the numbers 0, 1 … stand for; empty: themselves
  std::string x_name, y_name;
  Interval x_range, y_range;
  std::vector<Cell> cells;
  std::vector<CurveBox> boundary;
  std::vector<CurveBox> cusps{}, nodes{};  ///< of that curve
};

/// In a format of is_portrait_format(). Throws ResultFileError where the file cannot be written.
void write_picture(const std::filesystem::path& path, const ParameterPicture& picture);

}  // namespace corank::report
