// The pieces into which its singularities divide a C-space.
//
//   aspects         pieces of C-space without forward and inverse singularities (Wenger, Chablat 1997)
//   assembly modes  pieces of C-space without forward singularities
//   working modes   pieces of C-space without inverse singularities
//
// Counted on cells (sign_cells.h) of a C-space that is smooth in the search domain, strictly within its limits. In each
// piece the factors of the determinants of L_y and L_z keep their signs.
// Where the mechanism has requirements, only pieces in which they are met count: their limits divide C-space, too.
#pragma once

#include <array>
#include <memory>

#include "corank/analyze/aspects/aspect_cusps.h"
#include "corank/analyze/aspects/aspect_images.h"
#include "corank/analyze/robots/robots.h"

namespace corank::result {
struct PiecesFile;
}

namespace corank::analyze {

/// A factor of a C-space that is a product: what is said of some coordinates, to which the singularities do not tie others.
struct AspectsPart {
  std::vector<std::string> coordinates;
  System system;
  std::shared_ptr<const Cover> cover;               ///< with its proof, where AspectsOptions::certificate asks for it
  std::array<Pieces, 3> lists;                      ///< aspects, assembly modes, working modes
  std::array<std::vector<std::string>, 3> factors;  ///< of the determinants: the functions of each list
};

struct Aspects {
  Pieces aspects, assembly_modes, working_modes;
  /// Where C-space is the graph of a map over free coordinates, and of more than two dimensions: its factors that
  /// singularities divide. Their numbers of pieces are multiplied. What is drawn and asked of images and cusps is left out.
  std::vector<AspectsPart> product_of;
  std::vector<std::string> forward_factors, inverse_factors;  ///< of det L_y, det L_z
  std::vector<std::string> required;                          ///< that pieces meet
  std::vector<std::string> further_factors;                   ///< that divide C-space as well, of requirements' limits
  std::vector<std::string> limits;                            ///< to which C-space comes: pieces are strictly within
  System system;                                              ///< C-space: the variables of the boxes
  std::string reason;                                         ///< why nothing is known; empty where something is
  /// Of each aspect the signs of det L_y and det L_z, as `corank derive` prints the matrices; 0: not proven.
  std::vector<std::array<int, 2>> determinant_signs;
  std::optional<PieceImages> images;    ///< of the aspects, where AspectsOptions::images asks for them
  std::optional<PieceDrawing> drawing;  ///< of the aspects, in AspectsOptions::drawn
  std::optional<AspectCusps> cusps;     ///< and the aspects about them, where AspectsOptions::cusps asks for them
  /// Of C-space, or of the first factor, with its proof, where AspectsOptions::certificate asks for it.
  std::shared_ptr<const Cover> cover;
  std::vector<int> places;  ///< of the boxes of AspectsOptions::placed: in which aspect (piece_places)
  /// Where constants have tolerances: are the numbers those of every robot? All else is of the one that was drawn.
  std::optional<Robots> robots;
  std::string stopped;  ///< what ended the analysis early; empty: nothing
};

struct AspectsOptions {
  int threads = 1;
  int halvings = 26;                  ///< of a cover's box, at most
  int rounds = 16;                    ///< SignCells::refine
  std::vector<std::string> drawn{};   ///< coordinates
  std::vector<std::string> images{};  ///< two lengths, of a C-space of two dimensions
  int rows = 120;                     ///< of the images' grid
  bool cusps = false;                 ///< look for the cusps of both loci
  bool requirements = true;           ///< count pieces that meet the mechanism's requirements alone
  bool certificate = false;           ///< keep what it takes to check the result
  const Cover* placed = nullptr;      ///< of C-space, to be looked at
};

/// Throws symbolic::ModelError where the model has no inputs or outputs, L_y or L_z is not square, or requirements are none
/// that symbolic::required_space takes, or asked for beside cusps; and where requirements, images, cusps or a certificate
/// are asked for of constants with tolerances.
Aspects aspects(study::Question question, const AspectsOptions& options, solve::Control& control);

/// Those of aspects, assembly modes and working modes that are exact.
ExactNumbers exact_numbers_of(const Aspects& aspects);

/// "10 aspects, 2 assembly modes, 4 working modes", or bounds. Requires that something is known.
std::string summary(const Aspects& aspects);
/// What is written of it, for others to check. Requires its cover.
result::PiecesFile to_file(const study::Question& question, const Aspects& aspects);
/// A few lines for a terminal.
std::string to_text(const study::Question& question, const Aspects& aspects);
/// {"aspects": {"at_least", "at_most"}, "assembly_modes", "working_modes", "representatives" …}; doc/topology.md.
std::string to_json(const study::Question& question, const Aspects& aspects);

}  // namespace corank::analyze
