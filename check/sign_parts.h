// Parts of a cell on which functions have given signs: which are connected, which empty. The checker's own.
//
// A cell is the part of a sheet over a box X_F of its free variables: a graph, at whose solutions the Jacobian in the
// dependent variables is regular. Its part of the signs s is the set of its points where s_k·g_k > 0 for each function.
//   Lemma 1: where every g_k has one sign on the cell, the part is the cell, or empty.
//   Arcs: where the cell has one free variable, and along it each g_k is monotone or has one sign, the part is an interval
// or empty: empty where some s_k·g_k ≤ 0 at the end at which it is largest, not empty where an end is in it. On arcs that
// follow each other it is at most so many intervals as begin on one whose first point is not shown to be in the part, the
// first arc's own among them.
//   Outflow (lemmas 2 and 4 of doc/theory.md): let d be a direction of free variables with s_k·∂g_k/∂d > 0 all over the
// cell for each g_k that has both signs. From a point of the part one comes along d to the faces of X_F through which d
// leaves it, and does not leave the part: the part contracts onto its points there. So it is connected, or empty, where they
// are. For two free variables the faces are one arc; for more, d is one variable, and there is one face.
//   Passages (lemma 3): with such a d the part adds nothing of its own to what it meets at the border of X_F.
#pragma once

#include <bitset>
#include <vector>

#include "corank/check/krawczyk.h"
#include "corank/check/problem.h"

namespace corank::check {

/// Its sides are of all variables; those that are not free hold the sheet's solutions over the others.
struct SignCell {
  const std::vector<int>* free = nullptr;
  Sides sides;
  std::vector<Enclosure> range;    ///< of each function
  std::vector<std::size_t> mixed;  ///< functions whose sign is not known; at first all
};

class SignParts {
 public:
  enum class Part { unknown, connected, empty };
  static constexpr std::size_t kMostDirections = 128;
  using Directions = std::bitset<kMostDirections>;
  /// Of the free variables.
  using Direction = std::vector<double>;

  /// `problem`: without a reduction, as many equations as the sheets have dependent variables. Both have to outlive this.
  SignParts(const Problem& problem, const std::vector<Row>& functions) : problem_(problem), functions_(functions) {}

  SignCell cell(const std::vector<int>& free, Sides sides) const;
  /// Shrinks the dependent sides, so many times at most, and bounds the mixed functions.
  /// False: no solution is over X_F, which no sheet says.
  bool bound(SignCell& cell, int steps) const;
  /// The part of these signs, one of each function.
  Part part(const SignCell& cell, const std::vector<int>& signs, const std::vector<Direction>& directions) const;
  /// Which of the directions are a passage of that part.
  Directions passages(const SignCell& cell, const std::vector<int>& signs, const std::vector<Direction>& directions) const;
  /// Is there a direction along which s_k·g_k grows all over the cell for each of these functions, mixed or not?
  bool grow_together(SignCell cell, std::vector<std::size_t> functions, const std::vector<int>& signs) const;
  /// Directions worth a try, for a sheet of these widths; both ways.
  static std::vector<Direction> directions(const std::vector<double>& widths);

 private:
  using Slopes = std::vector<Sides>;  // of each mixed function by each free variable
  struct Arc;

  // Lemma 1.
  Part whole(const SignCell& cell, const std::vector<int>& signs) const;
  // Theorem: the sheet's tangent space is the kernel of the Jacobian; with V its basis whose block of the free variables is
  // the identity (check/inertia.h), ∂g/∂f along the sheet is ∇g·V_f.
  bool slopes(const SignCell& cell, Slopes& result) const;
  static bool grows(const SignCell& cell, const Slopes& slopes, const Direction& d, const std::vector<int>& signs);
  SignCell face(const SignCell& cell, std::size_t f, bool upper, int steps) const;
  // `open`: the free variables, by their places, that are not fixed.
  Part part(const SignCell& cell, std::vector<std::size_t> open, const std::vector<int>& signs,
            const std::vector<Direction>& directions) const;
  Part outflow(const SignCell& cell, const std::vector<std::size_t>& open, const std::vector<int>& signs,
               const Direction& d) const;
  bool add_segment(SignCell cell, std::size_t along, bool upwards, const std::vector<int>& signs, int depth, Arc& arc) const;

  const Problem& problem_;
  const std::vector<Row>& functions_;
};

}  // namespace corank::check
