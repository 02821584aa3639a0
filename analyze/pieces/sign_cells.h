// A smooth set in cells on which given functions have known signs or are monotone (certify/sign_cell.h): the pieces of the
// set without the functions' zeros are counted on them. Here cells are divided until one of the lemmas holds.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "corank/certify/meeting.h"
#include "corank/certify/sign_cell.h"
#include "corank/core/box_tree.h"
#include "corank/solve/step/control.h"

namespace corank::analyze {

/// All of its solutions lie on one sheet, which may go on beyond the domain.
inline bool is_sheet(const CoverBox& b) { return b.verdict == Verdict::regular || b.verdict == Verdict::boundary; }

/// Of these variables alone: each side of `inner` is in that of `outer`.
inline bool contains_over(const std::vector<int>& variables, const Box& outer, const Box& inner) {
  return std::ranges::all_of(variables, [&](int j) { return outer[j].contains(inner[j]); });
}

/// The free sides are X_F.
struct SignCell : certify::SheetCell {
  int box = 0;            ///< of the cover
  bool resolved = false;  ///< one of the lemmas holds for each choice of signs; of one mixed function the second
  /// The directions of lemma 3, as bits, for each choice of signs (SignCells::choice). They are the same for all cells of
  /// one box of the cover. Likewise those of lemma 5.
  std::array<std::uint64_t, 8> directions{};
  std::uint8_t ascends = 0;           ///< bit k: for choice k there is some direction of lemma 3
  std::optional<bool> known_parts{};  ///< does lemma 4 hold for each choice of signs? Once it was asked
};

/// Cells of a complete cover all of whose boxes are sheets. Where the set ends, its limits (limits.h) are
/// functions, too, of which only the positive sign counts: the pieces are those strictly within. Lemma 3 holds there as
/// well: along d the limits grow, so that the border of X_F is reached strictly within them, where S goes on.
class SignCells {
 public:
  /// `functions`: in the system's variables; so are the limits', which follow them in every list of signs. Once `control`
  /// has ended, the cells that are left are not examined: each of their signs is open.
  SignCells(const System& system, const Cover& cover, const std::vector<Polynomial>& functions,
            const std::vector<Polynomial>& limits, const solve::Control& control);

  /// Divides cells until they are resolved, or the number of halvings of a box is reached; then, so many times, those that
  /// the third lemma resolves and in which a piece might hide (hiding_places): a sheet of their own is put over them where
  /// one is proven.
  void refine(int halvings, int rounds, solve::Control& control);

  const std::vector<SignCell>& cells() const { return cells_; }
  /// The one given, and sheets that were put over parts of it.
  const Cover& cover() const { return cover_; }
  std::size_t given() const { return given_; }  ///< how many boxes of the cover are those of the one given
  const System& system() const { return system_; }
  const certify::CompiledSystem& compiled() const { return proof_.compiled(); }  ///< value rows: the functions
  int functions() const { return proof_.functions(); }                           ///< with the limits
  int limits() const { return limits_; }
  bool is_limit(int function) const { return function >= functions() - limits_; }
  /// Those signs of a cell's mixed functions that are free to choose, as bits: all but the limits'.
  std::size_t choice(const SignCell& cell, const std::vector<int>& signs) const;
  /// Of each choice that there is the signs of all functions. Nothing: more than three of them have both signs,
  /// in the plane two.
  std::vector<std::vector<int>> choices(const SignCell& cell) const;
  /// Of passages of these signs that hang together, the cells that stand in the way of a proof that no piece lies in them
  /// alone; none: it is proven. Theorem: doc/theory.md, "Passages that hang together".
  std::vector<std::size_t> hiding_places(const std::vector<std::size_t>& cells, const std::vector<int>& signs) const;
  const Box& region(const SignCell& cell) const;
  /// Is there a direction of lemma 3 for each choice of signs? Looked for where the cell is resolved without.
  bool is_passage(std::size_t cell);

  /// The part of a cell's sheet over other free sides, with its ranges.
  SignCell cell_over(const SignCell& cell, Box sides);
  /// Where the free sides are points of X_F: encloses the sheet's solution over them narrowly.
  Box solution_over(const SignCell& cell, Box sides) { return proof_.solution_over(cell, region(cell), std::move(sides)); }
  /// The same over the middles of a box's free sides.
  Box solution_over_middle(const SignCell& cell, const Box& box);
  /// Signs ±1 of the functions in the box, in which the solutions are meant; 0 where one is not known.
  std::vector<int> signs(const Box& box) const { return proof_.signs(box); }
  /// Is there for every value in `over` of the variables `free` exactly one solution in some region on which the functions
  /// have these signs, and one of them in `at`, a part of a cell?
  bool has_graph_over(const Box& at, const std::vector<int>& free, const std::vector<Interval>& over,
                      const std::vector<int>& signs);
  /// Lemma 2 for the one mixed function of a cell and a sign: is the part proven to be connected and not empty (1), empty
  /// (−1), or neither (0)?
  int part_of_one(const SignCell& cell, int sign) { return proof_.part_of_one(cell, sign); }
  /// Lemma 4 for the part of these signs, one of each function: likewise.
  int part_by_outflow(const SignCell& cell, const std::vector<int>& signs) {
    return proof_.part_by_outflow(cell, signs, directions(cell));
  }

 private:
  void evaluate(SignCell& cell);
  void widen_region(const SignCell& cell);
  bool is_outside(const SignCell& cell) const;
  bool resolve(SignCell& cell);
  std::optional<std::vector<SignCell>> halves(const SignCell& cell);
  bool is_covered_before(const SignCell& cell) const;
  template <class Choice>
  std::uint64_t common_directions(const std::vector<std::size_t>& cells, const Choice& choice) const;
  bool differ_in_directions(const std::vector<std::size_t>& cells) const;
  std::vector<std::vector<std::size_t>> touching_passages();
  std::optional<SignCell> sheet_over(const std::vector<std::size_t>& cells);
  bool has_known_parts(SignCell& cell);
  bool find_directions(SignCell& cell, bool any);
  bool grows(const SignCell& cell, const certify::SignCellTest::Slopes& slopes, const std::vector<int>& signs) const;
  bool climbs(const SignCell& cell, const std::map<int, double>& sizes, const std::vector<int>& signs) const;
  void add_convex_limits(SignCell& cell, const certify::SignCellTest::Slopes& slopes);
  // Of a cell with one mixed function: does lemma 5 hold?
  static bool has_convex_limit(const SignCell& cell) { return cell.free.size() == 2 && cell.directions[0] >> kLines != 0; }
  // Bits of SignCell::directions: lemma 5 on lines, one for each direction; on the level lines of the other function.
  static constexpr int kLines = 16, kLevels = 60;
  std::vector<std::vector<double>> directions(const SignCell& cell) const;

  const System& system_;
  Cover cover_;
  std::size_t given_;  // boxes of the cover that was given
  int limits_;
  std::vector<double> sizes_;  // of the functions
  certify::SignCellTest proof_;
  certify::MeetingTest test_;
  std::vector<SignCell> cells_;
  BoxTree boxes_{{}, 0};                  // of the cover
  bool comes_before(int a, int b) const;  // of two boxes: the later one's cells may leave solutions to the other's
};

}  // namespace corank::analyze
