// Pictures for Geomview: the boxes of a picture in two or three coordinates as a .gcl file (its command language, with the
// boxes as OFF meshes of OOGL), in the manner of the CUIK suite's cuikplot3d. For looking at, not for proofs: coordinates
// have 9 digits.
#pragma once

#include <string>

#include "corank/report/picture.h"

namespace corank::report {

struct GclOptions {
  /// The name that Geomview shows.
  std::string name = "boxes";
  /// A line for the comment at the file's head, such as the command that makes it.
  std::string comment;
};

/// All that Geomview needs; it scales the picture to its window. With two axes the picture is flat, z = 0. Throws
/// ResultFileError where there are no boxes to show.
std::string to_gcl(const Picture& picture, const GclOptions& options);

}  // namespace corank::report
