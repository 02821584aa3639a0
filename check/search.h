// The checker's own contraction and bounded bisection: to show that a box holds no solution, or none outside another box.
#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "corank/check/problem.h"

namespace corank::check {

/// A real linear combination Y·F of equations; row a is solved for dependent[a].
struct LinearCombination {
  std::vector<int> equations, dependent;
  Eigen::MatrixXd y;  ///< r×r
};

/// One for each thread.
class Search {
 public:
  static constexpr std::size_t kMostParts = 3000;

  explicit Search(const Problem& problem) : problem_(problem) {}

  /// Shrinks x to a box that holds its solutions (equations, domain, inequalities). False: it has none.
  /// Row: an equation; −1 − k: implied equation k; from equations().size() on: all that is neither.
  bool project(Sides& x, int row) const;
  /// A Hansen–Sengupta step: a zero z of F in X satisfies Y·F(c) + Y·S·(z − c) ∋ 0 row by row, for any c and Y
  /// (HansenSengupta1981): a row may be solved for its dependent variable, and for each free one.
  bool newton(Sides& x, const LinearCombination& p, const std::vector<double>& center);
  bool contract(Sides& x);

  /// Is there no solution in x? Bisects it where need be; false: not shown within the bounds.
  bool is_empty(Sides x, std::size_t most_parts = kMostParts);
  using Known = std::function<bool(const Sides&)>;
  /// Does every part of the boxes hold no solution, or none but those that are known, as `known` says of some box that holds
  /// the part's solutions? `parts`: counts those that were bisected, of all calls. False: not shown.
  bool has_none_but(std::vector<Sides> open, const Known& known, std::size_t most_parts, std::size_t& parts);
  /// Boxes that hold all solutions of those given: contracted, and bisected in turn until `narrow` says of each that it need
  /// be no further, or so many were.
  std::vector<Sides> sift(std::vector<Sides> open, const Known& narrow, std::size_t most_parts, std::size_t& parts);
  /// Do all solutions in x lie between the bounds? Shrinks x to a part that holds them and lies there. False: not shown;
  /// then x means nothing. `empty`: x was found to have none.
  bool confine(Sides& x, const std::vector<Interval>& bounds, bool& empty);

  std::uint64_t searched() const { return searched_; }  ///< boxes that took a bisection

 private:
  // Preconditioner at the middle of x: complete pivoting picks the dependent variables.
  bool own_combination(const Sides& x, LinearCombination& p, std::vector<double>& center);
  int widest(const Sides& x) const;  // measured by what the equations make of it; −1: none can be cut
  // Both parts of x, the lower one first; nothing where it cannot be cut.
  std::optional<std::array<Sides, 2>> halves(const Sides& x) const;

  const Problem& problem_;
  std::uint64_t searched_ = 0;
};

}  // namespace corank::check
