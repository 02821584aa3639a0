// A shape's file: components, links and critical points of a set (core/shape.h) with the model that they belong to, as HDF5;
// and its verification by check/, which shares nothing with what made it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "corank/check/shape.h"
#include "corank/core/ended.h"
#include "corank/core/shape.h"
#include "corank/result/source_group.h"

namespace corank::result {

struct ShapeFile : ModelSource {
  Shape shape;
};

inline constexpr CertificateKind kShapeKind{"corank topology", 1};

/// Layout: doc/certificates.md. Throw ResultFileError; writing, symbolic::ModelError where the model has no such heights.
/// Once `in_haste` says so, what is left is written as it is.
void write_shape(const std::filesystem::path& path, const ShapeFile& file, const Ended& in_haste = {});
ShapeFile read_shape(const std::filesystem::path& path);

/// Rebuilds the set and the critical points' systems from the model's text, and checks the shape. Throws
/// symbolic::ModelError where the text is no model.
check::ShapeReport verify(const ShapeFile& file, const check::Options& options = {});

std::string to_table(const check::ShapeReport& report, const ShapeFile& file);
/// {"verified", "complete", "interrupted", "components": {"at_least", "at_most"}, …}: doc/certificates.md.
std::string to_json(const check::ShapeReport& report, const ShapeFile& file);

}  // namespace corank::result
