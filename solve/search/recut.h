// Cuts a cover's proven boxes to another σ: a picture of a surface asks for narrow boxes, a proof does not.
#pragma once

#include "corank/core/cover.h"
#include "corank/solve/step/control.h"
#include "corank/solve/step/options.h"

namespace corank::solve {

/// The same set in boxes no wider than the prepared options' σ, by default a share of the set's size. A `regular` or
/// `boundary` box that spans() its free variables is a sheet: it has exactly one solution for every value of theirs, so the
/// parts that it is cut into along these inherit its proof. One that does not stays as it is where options.surfaces_whole
/// allows that, σ is asked for and the box is no wider; else it is searched. Other boxes stay as they are, and so do sets of
/// points. Labels of boxes are to be found anew (solve/search/box_labels.h), and there is no script: the cover that was cut
/// keeps it. Throws std::invalid_argument where the cover is of another system, or of one that was reduced in another way.
Cover recut(const Prepared& prepared, Cover cover, Control& control);

}  // namespace corank::solve
