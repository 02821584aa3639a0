// The cells that a proof of pieces names (core/pieces.h), each with what is found of its parts; steps 1 and 2 of
// check/pieces_bound.h.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "corank/check/parallel.h"
#include "corank/check/piece_sheets.h"
#include "corank/check/sign_parts.h"
#include "corank/core/pieces.h"

namespace corank::check {

/// The points of a cell in S at which each function has one sign.
struct PieceOf {
  std::uint32_t signs = 0;             ///< bit k: function k is positive
  bool connected = false;              ///< else a passage
  SignParts::Directions directions{};  ///< of a passage
  bool grows = false;                  ///< likewise
};

struct CellOfPiece {
  std::size_t sheet = 0;
  FreeSides over;
  SignCell cell;
  Box hull;  ///< in doubles
  std::vector<PieceOf> parts;
};

class PieceCells {
 public:
  static constexpr std::size_t kMost = 400'000;
  static constexpr int kSteps = 3;  ///< that bound a cell

  /// As bound_pieces(), check/pieces_bound.h.
  PieceCells(const Problem& whole, const Problem& reduced, const Cover& cover, const std::vector<Row>& functions,
             const PieceProof& proof, int threads);

  /// Every point of S lies in a part of one of the cells; else returns what is wrong.
  std::string examine_all(std::vector<CellOfPiece>& cells);
  /// Of the cell's halves; false: parts stay unknown.
  bool examine_halves(const CellOfPiece& cell, std::vector<CellOfPiece>& result) const;
  /// Is the part a passage? Its directions.
  bool find_directions(PieceOf& part, const SignCell& cell, std::size_t sheet) const;

  std::size_t functions() const { return functions_; }
  const std::vector<Row>& rows() const { return rows_; }  ///< of the functions, then of the ends
  const PieceSheets& sheets() const { return sheets_; }
  const SignParts& parts() const { return parts_; }
  /// Of each function and each end.
  std::vector<int> list(std::uint32_t signs) const;
  void for_each(std::size_t n, const std::function<void(std::size_t)>& work);

 private:
  std::string check_bridges();
  std::string check_cells();
  std::string check_cover();
  std::vector<SignParts::Direction> directions(std::size_t sheet) const;
  bool is_outside(const SignCell& cell) const;
  // False: a part of it is not known.
  bool find_parts(CellOfPiece& c) const;
  // Divides the cell further where need be; false: parts stay unknown.
  bool examine(std::size_t sheet, const FreeSides& over, int halvings, std::vector<CellOfPiece>& result) const;
  void narrow(std::size_t sheet, const FreeSides& over, SignCell& cell) const;
  bool is_elsewhere(std::size_t sheet, const FreeSides& over, int halvings, int via) const;
  template <class Visit>
  bool in_parts(std::size_t sheet, const FreeSides& over, const Sides& at, const Visit& visit) const;

  const Problem& whole_;
  const Cover& cover_;
  const PieceProof& proof_;
  std::size_t functions_;  // then come the ends
  std::vector<Row> rows_;
  PieceSheets sheets_;
  SignParts parts_{whole_, rows_};
  ThreadArena arena_;
  std::vector<std::vector<const FreeSides*>> cells_of_;  // of each sheet
};

}  // namespace corank::check
