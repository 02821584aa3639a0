// Into how many pieces do functions divide a solution set, at least? Found anew, on cells of the checker's own.
//
// Theorem: let a cover hold all solutions in the domain, its boxes confirmed (check/checker.h); let each box be divided over
// its free variables into cells, closed boxes that hold its solutions there, and cells without a solution in the domain be
// left out. Two solutions that a path joins in the set, on which no function is 0, have the same signs, and cells along
// the path follow each other that touch and in which these signs are possible. So members that hang together in no such
// way are in different pieces. A member is a solution, within the ends of the domain, where each function has the sign
// that is claimed.
//
// Requirements are met on a whole piece or nowhere in it (doc/theory.md, "Requirements"): a member says which. Pieces whose
// members do not show that requirements are met are not counted from below; those whose members show that one is not met
// are not counted from above, either.
//
// at_most, that no further piece hides about the functions' zeros, is checked where the file says where to look: see
// check/pieces_bound.h.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "corank/check/checker.h"
#include "corank/core/pieces.h"
#include "corank/core/requirement.h"

namespace corank::check {

/// Over the variables of the system. The matrices are square: L_y, L_z.
struct PieceFunctions {
  std::vector<Polynomial> functions;  ///< as the file names them, which fixes their signs
  std::vector<Polynomial> factors;    ///< as the model gives them: the same, but for their order and rational multiples
  std::array<PolynomialMatrix, 2> matrices;
  std::vector<Requirement> requirements{};  ///< their variables are indices into these functions
  std::vector<Polynomial> requirement_functions{};
};

struct PieceReport {
  std::size_t members = 0;     ///< that are confirmed
  int at_least = 0;            ///< pieces that are confirmed, those that meet the requirements
  std::optional<int> at_most;  ///< likewise; nothing: `unbounded` says why
  std::string unbounded;
  bool bounded = false;  ///< the upper bound that is claimed is confirmed
  std::size_t cells = 0, cells_of_bound = 0, links = 0;
  std::vector<std::string> failures;
};

struct PiecesReport : Findings {
  Report space;
  std::vector<PieceReport> lists;

  /// Every lower bound and every member is confirmed, as far as the boxes go that the file has.
  bool verified() const;
  /// verified(), and the boxes are proven to hold the whole set.
  bool covered() const;
  /// covered(), and every upper bound is confirmed.
  bool complete() const;
};

/// `claims` and `functions`: as many lists of pieces, of one cover. Never throws for what a claim says.
PiecesReport check_pieces(const System& system, const Cover& cover, const std::vector<PieceClaims>& claims,
                          const std::vector<PieceFunctions>& functions, const Options& options = {});

}  // namespace corank::check
