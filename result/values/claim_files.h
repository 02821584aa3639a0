// Files of what analyses claim: the shape of a set, the pieces of a C-space, a path, a map. Each holds the model that it
// speaks of, as HDF5, and is verified by check/, which shares nothing with what made it. Layouts: doc/certificates.md,
// doc/paths.md.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "corank/check/map.h"
#include "corank/check/pieces.h"
#include "corank/check/shape.h"
#include "corank/check/tube.h"
#include "corank/core/ended.h"
#include "corank/core/map_claims.h"
#include "corank/core/tube.h"
#include "corank/result/values/result.h"
#include "corank/symbolic/sets/parameters.h"

namespace corank::result {

/// A claim about more variables is refused.
inline constexpr int kMostVariables = 100'000;

/// What all of them begin with.
struct ModelSource {
  std::string version = result::version();  ///< of the corank that made it
  std::string model, model_text;            ///< as Result::model, model_text
  std::vector<ConstantOverride> constants{};
};
struct ShapeFile : ModelSource {
  Shape shape;
};
/// Of a C-space, or of a factor of one that is a product (analyze/aspects/aspect_product.h).
struct SpacePieces {
  std::vector<std::string> coordinates;  ///< of the factor; none: all of C-space
  Cover space;
  std::array<PieceClaims, 3> lists;  ///< aspects, assembly modes, working modes
};
/// Numbers of pieces of a product, at_least and at_most of each: what does not fit into an int is no bound.
template <class Bounds, class Other>
void multiply(Bounds& to, const Other& by) {
  constexpr std::int64_t kMost = std::numeric_limits<int>::max();
  const auto times = [](int a, int b) { return std::int64_t{a} * b; };
  to.at_least = static_cast<int>(std::min(kMost, times(to.at_least, by.at_least)));
  const bool fits = to.at_most && by.at_most && times(*to.at_most, *by.at_most) <= kMost;
  to.at_most = fits ? std::optional(*to.at_most * *by.at_most) : std::nullopt;
}
struct PiecesFile : ModelSource, SpacePieces {
  std::vector<SpacePieces> further;  ///< the product's other factors
};
struct PathFile : ModelSource {
  std::string avoid = "forward";       ///< which singularities it is without: "forward", "inverse", "both"
  std::vector<std::string> variables;  ///< of the system of C-space
  Tube tube;
};
struct MapFile : ModelSource {
  symbolic::FamilyQuestion family;
  MapClaims claims;
};

struct CertificateKind {
  const char* format;  ///< what format_of() says of the file
  int version = 1;
};
inline constexpr CertificateKind kShapeKind{"corank topology", 1}, kPiecesKind{"corank aspects", 3},
    kPathKind{"corank path", 2}, kMapKind{"corank map", 2};

/// Throw ResultFileError; symbolic::ModelError where the model has nothing of which this could be claimed. Once `in_haste`
/// says so, what is left is written as it is.
void write_shape(const std::filesystem::path& path, const ShapeFile& file, const Ended& in_haste = {});
void write_pieces(const std::filesystem::path& path, const PiecesFile& file, const Ended& in_haste = {});
void write_path(const std::filesystem::path& path, const PathFile& file, const Ended& in_haste = {});
void write_map(const std::filesystem::path& path, const MapFile& file, const Ended& in_haste = {});
ShapeFile read_shape(const std::filesystem::path& path);
PiecesFile read_pieces(const std::filesystem::path& path);
PathFile read_path(const std::filesystem::path& path);
MapFile read_map(const std::filesystem::path& path);

/// Rebuilds from the model's text what the claims are about, and checks them. Throws symbolic::ModelError where the text is
/// no model of which this could be claimed.
check::ShapeReport verify(const ShapeFile& file, const check::Options& options = {});
check::PiecesReport verify(const PiecesFile& file, const check::Options& options = {});
check::TubeReport verify(const PathFile& file, const check::Options& options = {});
check::MapReport verify(const MapFile& file, const check::Options& options = {});

std::string to_table(const check::ShapeReport& report, const ShapeFile& file);
std::string to_table(const check::PiecesReport& report, const PiecesFile& file);
std::string to_table(const check::TubeReport& report, const PathFile& file);
std::string to_table(const check::MapReport& report, const MapFile& file);

/// {"verified", "interrupted", …, "failures"}: doc/certificates.md.
std::string to_json(const check::ShapeReport& report, const ShapeFile& file);
std::string to_json(const check::PiecesReport& report, const PiecesFile& file);
std::string to_json(const check::TubeReport& report, const PathFile& file);
std::string to_json(const check::MapReport& report, const MapFile& file);

}  // namespace corank::result
