// A file of the pieces into which singularities divide a C-space: members of aspects, assembly modes and working modes
// (core/pieces.h), the cover and the model, as HDF5; and its verification by check/, which shares nothing with what made it.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "corank/check/pieces.h"
#include "corank/core/ended.h"
#include "corank/core/pieces.h"
#include "corank/result/source_group.h"

namespace corank::result {

struct PiecesFile : ModelSource {
  Cover space;
  std::array<PieceClaims, 3> lists;  ///< aspects, assembly modes, working modes
};

inline constexpr CertificateKind kPiecesKind{"corank aspects", 1};

/// Layout: doc/certificates.md. Throw ResultFileError; writing, symbolic::ModelError where the model has no such pieces.
/// Once `in_haste` says so, what is left is written as it is.
void write_pieces(const std::filesystem::path& path, const PiecesFile& file, const Ended& in_haste = {});
PiecesFile read_pieces(const std::filesystem::path& path);

/// Rebuilds C-space and the factors of the determinants from the model's text, and checks the claims. Throws
/// symbolic::ModelError where the text is no model of a mechanism with such singularities.
check::PiecesReport verify(const PiecesFile& file, const check::Options& options = {});

std::string to_table(const check::PiecesReport& report, const PiecesFile& file);
/// {"verified", "complete", "interrupted", "aspects": {"claimed", "at_least", "at_most", "members"} …}: doc/certificates.md.
std::string to_json(const check::PiecesReport& report, const PiecesFile& file);

}  // namespace corank::result
