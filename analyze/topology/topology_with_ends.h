// The shape of a set with ends: Morse theory on its strata (certify/stratum.h), and the curves that bound a surface.
#pragma once

#include "corank/analyze/sets/limits.h"
#include "corank/analyze/topology/topology.h"

namespace corank::analyze {

inline constexpr int kHeights = 6;  ///< that are tried for two which say something

/// Why nothing follows from a search for critical points: it was ended, or some box may be part of a larger set, and is not
/// counted among the cover's points. Else empty.
std::string problem_of_points(const Cover& cover);

/// Without those ends at which a search finds no solution: all solutions are strictly within them.
std::vector<Limit> without_unreached(const System& system, std::vector<Limit> ends, const TopologyOptions& options,
                                     std::uint64_t& processed, solve::Control& control);

/// Adds to result, whose components are known, what two heights say: with_ends, the characteristic, its critical points;
/// of a connected surface the number of curves that bound it, and so its genus.
///
/// The boundary curves: each end's part of the boundary, one-dimensional, is counted strictly within the other ends by cells
/// (sign_cells.h). In a cell on which one end alone has both signs, and on which that end's function is monotone, the part
/// that is strictly within is an interval that ends at the corner where the function is 0; so a corner that is proven to
/// lie there joins two such pieces. All pieces and corners together are the boundary: its components are the classes.
void find_shape_with_ends(const System& system, int dimension, const std::vector<Limit>& ends,
                          const TopologyOptions& options, Topology& result, solve::Control& control);

}  // namespace corank::analyze
