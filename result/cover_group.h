// A cover with its certificates below any group of an HDF5 file, for files that hold several (result/shape_file.h).
#pragma once

#include <string>

#include "corank/core/cover.h"
#include "corank/result/hdf5_file.h"

namespace corank::result {

/// `lower`, `upper`, `verdict` and `free` of boxes with n sides each, row by row.
void write_boxes(Hdf5Writer& file, const std::string& group, const std::vector<CoverBox>& boxes, std::size_t n);
/// Where `sides` are given, those alone; without `free` they have no free variables.
std::vector<CoverBox> read_boxes(Hdf5Reader& file, const std::string& group, std::size_t n,
                                 const std::vector<int>* sides = nullptr, bool with_free = true);

/// Boxes, points, σ, dimension; certificates as in result/certificate_file.h. The writer's prefix is `group` then.
void write_cover(Hdf5Writer& file, const std::string& group, const Cover& cover, std::size_t variables);
/// Throws ResultFileError where something is missing, has other sizes, or is out of range. The reader's prefix is "" then.
Cover read_cover(Hdf5Reader& file, const std::string& group, std::size_t variables);

}  // namespace corank::result
