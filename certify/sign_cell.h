// Parts of a cell of a proven sheet on which given functions have given signs: which of them are connected, which empty.
//
// A cell is the part of a proven sheet over a box X_F of its free variables; g_1 … g_r are functions on it. Its *parts*
// are the sets of its points where the g_k have given signs, none 0. Proofs: doc/theory.md, "Pieces between singularities".
//   Lemma 1: where every g_k has one sign all over the cell, its one part is the cell, which is connected.
//   Lemma 2: let one function g have both signs, and s·∂g/∂f > 0 all over the cell (derivatives along the sheet), or < 0,
// for a free variable f. Then the part of sign s is connected, or empty, where its part on the face of X_F at f's end where
// s·g is larger is: a cell with a free variable less.
//   Lemma 3: let there be a direction d of free variables with s_k·∂g_k/∂d > 0 all over the cell for each g_k that has both
// signs. Then the part of signs s adds no piece: each of its points is joined in it to one of another cell.
//   Lemma 4: let the dimension be 2 and d as in lemma 3. The sides of X_F through which d points out of it are one arc: the
// part of signs s is connected where its points on the arc are, and empty where there are none.
//   Lemma 5: let the dimension be 2, and e be a limit, of which only the sign 1 counts. Let no function but e and h have
// both signs, and T(T e) > 0 all over the cell, where T = (∂h/∂f_2, −∂h/∂f_1) is along the level lines of h; where e alone
// has both signs, h may be linear in the f's: T is a constant direction. Then the parts add no piece, nor do neighbouring
// cells of one sheet that share e and h. Where e is critical, it is all one whether it is positive, 0 or negative there.
#pragma once

#include <optional>
#include <vector>

#include "corank/certify/compiled_system.h"
#include "corank/certify/newton.h"
#include "corank/certify/second_order.h"
#include "corank/core/cover.h"

namespace corank::certify {

/// The part of a sheet over other free sides, with what is known of the functions on it.
struct SheetCell {
  std::vector<int> free{};        ///< variables of the sheet
  Box sides{};                    ///< all variables; the free ones' are X_F, the others' hold the sheet's solutions over it
  std::vector<Interval> range{};  ///< of each function
  std::vector<int> mixed{};       ///< functions that have not one sign, as far as is known
};

/// Every function requires UpwardRounding::active(), and a cell whose sides hold for each value of X_F the one solution that
/// the sheet has there.
class SignCellTest {
 public:
  /// Of each mixed function by each free variable.
  using Slopes = std::vector<std::vector<Interval>>;

  SignCellTest(const System& system, const std::vector<Polynomial>& functions);

  int functions() const { return compiled_.values(); }
  const CompiledSystem& compiled() const { return compiled_; }

  /// Shrinks the dependent sides so many times, and bounds every function over the sheet's solutions. Theorem: tighten_sheet
  /// loses none of them, and NewtonStep::value_at_zeros and the natural extension both enclose the function there.
  void bound(SheetCell& cell, int steps);
  /// Lemma 1: all of the cell is in the part of these signs (1), nothing of it is (−1); 0: not known. After bound().
  static int holds(const SheetCell& cell, const std::vector<int>& signs);
  /// Encloses the derivatives along the sheet over the cell; false: not known. Theorem: at a solution the sheet's tangent
  /// space is the kernel of the equations' Jacobian J; with V its basis whose free block is the identity
  /// (certify::kernel_basis), ∂g/∂f along the sheet is ∇g·V_f.
  bool slopes(const SheetCell& cell, Slopes& result) const;
  /// Hypothesis of lemma 3: s_k·∂g_k/∂d > 0 for each mixed function (1), or < 0 for each, so that −d does (−1); or neither
  /// (0). `signs`: of all functions; `direction`: of the free variables.
  static int growth(const SheetCell& cell, const Slopes& slopes, const std::vector<double>& direction,
                    const std::vector<int>& signs);
  /// Lemma 2 for the one mixed function of a cell and a sign: is the part proven to be connected and not empty (1), empty
  /// (−1), or neither (0)?
  int part_of_one(const SheetCell& cell, int sign);
  /// Lemma 4 for the part of these signs, one of each function, likewise; of the directions a few are tried.
  int part_by_outflow(const SheetCell& cell, const std::vector<int>& signs,
                      const std::vector<std::vector<double>>& directions);
  /// The first and second derivatives of each mixed function over the cell; nothing: not known.
  std::optional<std::vector<SheetDerivatives>> second_order(const SheetCell& cell) const;
  /// Hypothesis of lemma 5, with the level lines of h, or with a constant direction.
  static bool convex_on_levels(const SheetDerivatives& e, const SheetDerivatives& h);
  static bool convex_on_lines(const SheetDerivatives& e, const std::vector<double>& direction);
  /// Where the free sides are points of X_F: encloses the sheet's solution over them narrowly; `region`: the sheet's.
  /// Theorem: what newton_prove finds there is the sheet's solution if it lies in the region, which holds no other one.
  Box solution_over(const SheetCell& cell, const Box& region, Box sides);
  /// Narrows the dependent sides to those of a sheet over X_F that is proven anew, about the solution over the middle;
  /// false: none was. Where the sides are too wide for `bound`, whose steps contract only near a solution.
  /// Theorem: one that newton_prove finds over X_F is the cell's if it lies in the region, which holds no other one.
  bool narrow(SheetCell& cell, const Box& region);
  /// newton_prove over all of the cell's sides.
  Sheet sheet_over(const SheetCell& cell);
  /// Signs ±1 of the functions in the box; 0 where one is not known.
  std::vector<int> signs(const Box& box) const;
  /// A sheet about a point, over these sides of the variables `free`, whose region holds the point. Not proven: no claim.
  Sheet graph_over(const Box& point, const std::vector<int>& free, const std::vector<Interval>& over);

 private:
  struct Arc;

  Preconditioner preconditioner(const std::vector<int>& free, const Box& sides) const;
  // A few chord steps in doubles towards a zero of the equations; false: they do not end there.
  bool chord_steps(const Preconditioner& p, std::vector<double>& point) const;
  Interval range(const SheetCell& cell, int function, Box& sides);
  // Lemma 2, from the whole of X_F to its faces. `open`: the free variables that still have their sides.
  int connected(const SheetCell& cell, int function, int sign, const std::vector<Interval>& slope, Box sides,
                std::vector<int> open);
  // The part of these signs on a segment of a side of X_F; false: not known.
  bool add_segment(const SheetCell& cell, const std::vector<int>& signs, int along, bool upwards, int depth, Arc& arc);
  SheetCell over(const SheetCell& cell, Box sides);

  System system_;
  std::vector<Polynomial> functions_;
  CompiledSystem compiled_;  // value rows: the functions
  NewtonWorkspace workspace_;
};

}  // namespace corank::certify
