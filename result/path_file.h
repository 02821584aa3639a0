// A path's file: a tube and the model that it belongs to, as HDF5; and its verification by check/, which shares nothing with
// what made it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "corank/check/tube.h"
#include "corank/core/tube.h"
#include "corank/result/source_group.h"

namespace corank::result {

struct PathFile : ModelSource {
  std::string avoid = "forward";       ///< which singularities it is without: "forward", "inverse", "both"
  std::vector<std::string> variables;  ///< of the system of C-space
  Tube tube;
};

inline constexpr CertificateKind kPathKind{"corank path", 2};

/// Layout: doc/paths.md. Throw ResultFileError.
void write_path(const std::filesystem::path& path, const PathFile& file);
PathFile read_path(const std::filesystem::path& path);

/// Rebuilds C-space and the matrices from the model's text, and checks the tube. Throws symbolic::ModelError where the text
/// is no model of a mechanism with such singularities.
check::TubeReport verify(const PathFile& file, const check::Options& options = {});

std::string to_table(const check::TubeReport& report, const PathFile& file);
/// {"verified", "interrupted", "nodes", "pieces", "radius", "avoid", "failures"}.
std::string to_json(const check::TubeReport& report, const PathFile& file);

}  // namespace corank::result
