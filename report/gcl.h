// Pictures for Geomview: the boxes of a cover in two or three coordinates as a .gcl file (its command language, with the boxes as OFF
// meshes of OOGL), in the manner of the CUIK suite's cuikplot3d. For looking at, not for proofs: coordinates have 9 digits.
#pragma once

#include <string>
#include <vector>

#include "corank/report/cuik_sol.h"

namespace corank::report {

struct GclOptions {
  /// Indices into a box; two or three of them, need not be distinct. With two, z = 0: the picture is flat.
  std::vector<int> axes;
  /// 0: boxes as they are; else cubes (squares) with that edge about the centres of the boxes.
  double size = 0;
  /// Else all are blue, as the CUIK suite draws them.
  bool color_by_verdict = false;
  /// The name that Geomview shows.
  std::string name = "boxes";
  /// A line for the comment at the file's head, such as the command that makes it.
  std::string comment;
};

/// The red, green and blue of a verdict, each from 0 to 1.
struct Color {
  double red, green, blue;
};
Color verdict_color(std::optional<certify::Verdict> verdict);

/// All that Geomview needs; it scales the picture to its window. Throws ResultFileError where there are no boxes to show. Requires valid
/// axes.
std::string to_gcl(const SolFile& boxes, const GclOptions& options);

}  // namespace corank::report
