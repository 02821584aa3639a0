// A smooth set in cells on which given functions have known signs or are monotone: the pieces of the set without the
// functions' zeros are counted on them.
//
// A cell is the part of a proven sheet over a box X_F of its free variables; g_1 … g_r are functions on it. Its *parts*
// are the sets of its points where the g_k have given signs, none 0.
//   Lemma 1: where every g_k has one sign all over the cell, its one part is the cell, which is connected.
//   Lemma 2: let one function g have both signs, s be one of them, and s·∂g/∂f > 0 all over the cell (derivatives
// along the sheet) for a free variable f or < 0. Then the part of sign s is connected or empty where its part on the
// face of X_F at f's end where s·g is larger is; and each of its points is joined to one of that face. Proof: along
// f from any point s·g grows until the face. So the part contracts onto its part on the face. On the face the lemma
// may be used again, with its other free variables; a face where s·g > 0 all over is connected.
//   Lemma 3: let there be a direction d of free variables with s_k·∂g_k/∂d > 0 all over the cell for each g_k that
// has not one sign there. Then each point of the part of signs s is joined in it to a point on the cell's border,
// which is another cell's, too: the part adds no piece.
//   Lemma 4: let the dimension be 2 and d as in lemma 3, with s_k·∂g_k/∂d > 0. The sides of X_F through which d points out
// of it are one arc. Along d every point of the part of signs s comes to that arc without leaving the part: so the part is
// connected where its points on the arc are, and empty where there are none.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "corank/analyze/components.h"
#include "corank/certify/compiled_system.h"
#include "corank/certify/meeting.h"
#include "corank/certify/newton.h"

namespace corank {
class BoxTree;
}

namespace corank::analyze {

struct SignCell {
  int box = 0;                  ///< of the cover
  Box sides;                    ///< all variables; the free ones' are X_F
  std::vector<Interval> range;  ///< of each function
  std::vector<int> mixed;       ///< functions that have not one sign, as far as is known
  bool resolved = false;        ///< one of the lemmas holds for each choice of signs; of one mixed function the second
  /// The directions of lemma 3, as bits, for each choice of signs (SignCells::choice). They are the same for all cells of
  /// one box of the cover: where neighbours share one, no piece hides in them together.
  std::array<std::uint64_t, 4> directions{};
  std::optional<bool> known_parts{};  ///< does lemma 4 hold for each choice of signs? Once it was asked
};

/// Cells of a complete cover all of whose boxes are `regular` or `boundary`. Where the set ends, its limits (limits.h) are
/// functions, too, of which only the positive sign counts: the pieces are those strictly within. Lemma 3 holds there as
/// well: along d the limits grow, so that the border of X_F is reached strictly within them, where S goes on.
class SignCells {
 public:
  /// `functions`: in the system's variables; so are the limits', which follow them in every list of signs.
  SignCells(const System& system, const Cover& cover, const std::vector<Polynomial>& functions,
            const std::vector<Polynomial>& limits = {});

  /// Divides cells until they are resolved, or the number of halvings of a box is reached; then, so many times, those that
  /// the third lemma resolves and that touch others of their kind with which they share no direction: a sheet of their own
  /// is put over them where one is proven, as where loci cross on a border between sheets.
  void refine(int halvings, int rounds, solve::Control& control);

  const std::vector<SignCell>& cells() const { return cells_; }
  /// The one given, and sheets that were put over parts of it.
  const Cover& cover() const { return cover_; }
  const System& system() const { return system_; }
  int functions() const { return compiled_.values(); }  ///< with the limits
  int limits() const { return limits_; }
  bool is_limit(int function) const { return function >= functions() - limits_; }
  /// Those signs of a cell's mixed functions that are free to choose, as bits: all but the limits'.
  std::size_t choice(const SignCell& cell, const std::vector<int>& signs) const;
  /// Of each choice that there is the signs of all functions. Nothing: more than two of them have both signs.
  std::vector<std::vector<int>> choices(const SignCell& cell) const;
  const std::vector<int>& free(const SignCell& cell) const { return cover_.boxes[static_cast<std::size_t>(cell.box)].free; }
  const Box& region(const SignCell& cell) const;

  /// The part of a cell's sheet over other free sides, with its ranges.
  SignCell cell_over(const SignCell& cell, Box sides) const;
  /// 1: all of the cell is in the part of these signs; −1: nothing of it is; 0: not known.
  static int holds(const SignCell& cell, const std::vector<int>& signs);
  /// Where the free sides are points of X_F: encloses the sheet's solution over them, as narrow as a few steps make it.
  Box solution_over(const SignCell& cell, Box sides);
  /// Signs ±1 of the functions in the box, in which the solutions are meant; 0 where one is not known.
  std::vector<int> signs(const Box& box) const;
  /// Is there for every value in `over` of the variables `free` exactly one solution in some region on which the functions
  /// have these signs, and one of them in `at`, a part of a cell?
  bool has_graph_over(const Box& at, const std::vector<int>& free, const std::vector<Interval>& over,
                      const std::vector<int>& signs);
  /// Lemma 2 for the one mixed function of a cell and a sign: is the part proven to be connected and not empty (1), empty
  /// (−1), or neither (0)?
  int part_of_one(const SignCell& cell, int sign);
  /// Lemma 4 for the part of these signs, one of each function: likewise.
  int part_by_outflow(const SignCell& cell, const std::vector<int>& signs);

 private:
  struct Arc;
  struct Slopes {
    std::vector<std::vector<Interval>> of;  // of each mixed function by each free variable
  };

  std::vector<int> dependent_of(const std::vector<int>& free) const;
  void evaluate(SignCell& cell);
  void widen_region(const SignCell& cell);
  bool is_outside(const SignCell& cell) const;
  // False: nothing is known.
  bool slopes(const SignCell& cell, Slopes& result);
  bool resolve(SignCell& cell);
  std::optional<std::vector<SignCell>> halves(const SignCell& cell);
  bool is_covered_before(const SignCell& cell) const;
  std::vector<std::vector<std::size_t>> touching_passages();
  std::optional<SignCell> sheet_over(const std::vector<std::size_t>& cells);
  void index_boxes();
  bool has_known_parts(SignCell& cell);
  // The part of these signs on a segment of a side of X_F; false: not known.
  bool add_segment(const SignCell& cell, const std::vector<int>& signs, int along, bool upwards, int depth, Arc& arc);
  bool find_directions(SignCell& cell);
  std::vector<std::vector<double>> directions(const SignCell& cell) const;
  int connected(const SignCell& cell, int function, int sign, const std::vector<Interval>& slope, Box sides,
                std::vector<int> open);
  Interval range(const SignCell& cell, int function, Box& sides);
  certify::Preconditioner preconditioner(const SignCell& cell, const Box& sides) const;

  const System& system_;
  Cover cover_;
  std::size_t given_;  // boxes of the cover that was given
  int limits_;
  certify::CompiledSystem compiled_;  // value rows: the functions
  certify::NewtonWorkspace workspace_;
  certify::MeetingTest test_;
  std::vector<SignCell> cells_;
  std::shared_ptr<const BoxTree> boxes_;  // of the cover
  bool comes_before(int a, int b) const;  // of two boxes: the later one's cells may leave solutions to the other's
};

}  // namespace corank::analyze
