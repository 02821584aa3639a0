// The sheets of a cover and those beside it, over parts of their free variables: what solutions they hold, and whether cells
// leave some of them out.
#pragma once

#include <string>
#include <vector>

#include "corank/check/problem.h"
#include "corank/core/pieces.h"

namespace corank::check {

/// Of a sheet's free variables, in their order.
using FreeSides = std::vector<Interval>;

class PieceSheets {
 public:
  /// `whole`: without a reduction; `reduced`: by the cover's, whose boxes are confirmed. All have to outlive this.
  PieceSheets(const Problem& whole, const Problem& reduced, const Cover& cover, const std::vector<SheetBridge>& bridges);

  std::size_t size() const { return cover_.boxes.size() + bridges_.size(); }
  /// What is wrong with a sheet that is no box's, or nothing.
  std::string bridge_fault(std::size_t bridge) const;
  const std::vector<int>& free(std::size_t sheet) const;
  FreeSides over(std::size_t sheet) const;
  /// A box, in all variables, that holds the sheet's solutions over these sides.
  Sides start(std::size_t sheet, const FreeSides& over) const;
  /// Is a solution in x, where there is one, the sheet's over `over`?
  bool holds(std::size_t sheet, const FreeSides& over, const Sides& x) const;

 private:
  bool is_box(std::size_t sheet) const { return sheet < cover_.boxes.size(); }
  const Box& region(std::size_t sheet) const;

  const Problem& whole_;
  const Problem& reduced_;
  const Cover& cover_;
  const std::vector<SheetBridge>& bridges_;
};

/// The parts of x that the others leave open but for their borders; the union of all is x.
std::vector<FreeSides> open_parts(const FreeSides& x, const std::vector<const FreeSides*>& others, const StopFlag& stop);

}  // namespace corank::check
