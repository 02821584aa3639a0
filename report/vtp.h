// Pictures for ParaView and other programs built on VTK: the boxes of a picture in two or three coordinates as VTK PolyData
// (.vtp, XML; "VTK File Formats", Kitware). For looking at, not for proofs, though coordinates are doubles.
//
// A box is 4 points and a face, or with three axes 8 points and 6 faces; a face is a cell. Cell data: `box`, the box's
// number in its result, from 0; `verdict`, −1 where there is none; `set`, the number of the layer. Field data hold the
// names: `verdict_names`, `set_names`, `axes`.
#pragma once

#include <string>

#include "corank/report/picture.h"

namespace corank::report {

/// Data arrays are compressed by zlib. Throws std::invalid_argument where there is no box.
std::string to_vtp(const Picture& picture);

}  // namespace corank::report
