// The certificates of a cover in a result file, the group /certificates:
//
//   reduction/variable, equation, other, factor (−1: none; texts)     region_lower, region_upper (R×n)
//   box_region, box_point, box_corank (N; −1: none)
//   point_region, point_point, point_corank                             of the entries of /points
//   decimals                            of each of these points and variable; empty texts where nothing is proven
//   exact_points/polynomial, lower, upper, coordinates (texts; coefficients of 1, t, t² … with commas between), corank,
//   sole_within
//   proof/…                             the vectors of core/proof.h, compressed; missing where the cover has no proof
#pragma once

#include "corank/core/cover.h"
#include "corank/result/hdf5_file.h"

namespace corank::result {

void write_certificates(Hdf5Writer& file, const Cover& cover, std::size_t variables);

/// Into a cover that has its boxes and points. Throws ResultFileError where an index is out of range or a number is none.
void read_certificates(const Hdf5Reader& file, Cover& cover, std::size_t variables);

}  // namespace corank::result
