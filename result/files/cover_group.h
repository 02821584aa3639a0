// A cover with its certificates below any group of an HDF5 file. The group /certificates:
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
#include "corank/result/files/hdf5_file.h"

namespace corank::result {

/// `lower`, `upper`, `verdict` and `free` of boxes with n sides each, row by row.
void write_boxes(Hdf5Writer& file, const std::string& group, const std::vector<CoverBox>& boxes, std::size_t n);
/// Where `sides` are given, those alone; without `free` they have no free variables.
std::vector<CoverBox> read_boxes(Hdf5Reader& file, const std::string& group, std::size_t n,
                                 const std::vector<int>* sides = nullptr, bool with_free = true);

void write_certificates(Hdf5Writer& file, const Cover& cover, std::size_t variables);
/// Into a cover that has its boxes and points. Throws ResultFileError where an index is out of range or a number is none.
void read_certificates(const Hdf5Reader& file, Cover& cover, std::size_t variables);

/// Boxes, points, σ, dimension, certificates. The writer's prefix is `group` then.
void write_cover(Hdf5Writer& file, const std::string& group, const Cover& cover, std::size_t variables);
/// Throws ResultFileError where something is missing, has other sizes, or is out of range. The reader's prefix is "" then.
Cover read_cover(Hdf5Reader& file, const std::string& group, std::size_t variables);

}  // namespace corank::result
