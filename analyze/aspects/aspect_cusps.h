// Aspects about cusps: two configurations with the same inputs (assembly modes), or with the same outputs (postures), that a
// motion about a cusp joins without a singularity lie in one aspect. In which, and what lies between them.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "corank/analyze/pieces/pieces.h"
#include "corank/study/question.h"

namespace corank::analyze {

struct AspectEquations;

/// Near a cusp of a locus' image among the locked coordinates three configurations come together; the locus divides C-space
/// there in two sides. The outer two of the three lie on one of them, where a path about the cusp joins them, the third on
/// the other (doc/theory.md, "Cusps and nodes").
struct AspectCusp {
  bool forward = true;  ///< of the forward locus, or of the inverse one
  Box at{};             ///< the configuration over the cusp, in C-space's variables
  /// Aspects, as indices of Pieces::representatives: of the outer two, and of the third. Nothing: not known.
  std::optional<int> around{}, between{};
};

struct AspectCusps {
  std::vector<AspectCusp> list;
  std::vector<std::string> reasons;  ///< what is not known, and why; empty: these are all cusps in the search domain
  std::array<bool, 2> looked_for{};  ///< those of the forward, of the inverse locus; a locus that is empty has none
  std::array<bool, 2> all{};         ///< and there are no others in the search domain: proven
  /// Of C-space, where it is proven to be a closed surface; the number of cusps of a locus that are all has its parity
  /// (R. Thom 1956; doc/theory.md). Where one had not, a reason would say so.
  std::optional<int> euler_characteristic;
};

/// "forward", "inverse": the loci in the order of AspectCusps::all.
const char* locus_name(std::size_t locus);

/// Of pieces that are exact, of cells whose functions are all the loci's factors. The cusps are searched for
/// (symbolic/sets/cusps_and_nodes.h). Theorem: let one function g of the locus alone be 0 at the cusp. All points of C-space
/// near it lie in the cells that its box meets; where all parts of these with the signs of one side are of one piece, that
/// side is of it. Which side is which says the sign of symbolic::cusp_sides().
AspectCusps aspect_cusps(const AspectEquations& asked, SignCells& cells, const Pieces& pieces, int threads,
                         solve::Control& control);

/// Looks at the parity of their numbers, where C-space, of two dimensions, comes to no end, and its Euler characteristic is
/// found with few boxes. A locus whose number has the other one is no longer known as a whole.
/// `system`: study::system(question).
void check_parity(const study::Question& question, const System& system, int threads, solve::Control& control,
                  AspectCusps& cusps);

}  // namespace corank::analyze
