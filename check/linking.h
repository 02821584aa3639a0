// Sheets that solutions join to pieces.
//
// Theorem: a sheet holds, for every value of its free variables, exactly one solution: a graph over a box, which is
// connected. A solution in two sheets is on both graphs, so they are parts of one component.
#pragma once

#include <string>
#include <vector>

#include "corank/check/problem.h"
#include "corank/core/shape.h"

namespace corank::check {

class Linking {
 public:
  /// `problem`: of the cover's reduction, whose boxes are `regular` and confirmed. All have to outlive this.
  Linking(const System& system, const Problem& problem, const Cover& cover, const std::vector<SheetBridge>& bridges);

  std::size_t sheets() const { return free_.size(); }
  /// The box's region; −1 where it is none.
  int sheet_of_box(std::size_t box) const { return cover_.boxes[box].region; }
  /// What is wrong with the sheet as a whole, or nothing; it has to keep to the domain and the inequalities, too, since
  /// what it joins is to lie there.
  std::string sheet_fault(std::size_t sheet) const;
  /// Is there a solution in both sheets, near the point that the link names? Else why not.
  std::string link_fault(const SheetLink& link) const;
  /// Does the sheet hold a solution that lies in the box?
  bool holds(std::size_t sheet, const Box& box) const;

 private:
  const Box& region(std::size_t sheet) const;
  std::string region_fault(std::size_t sheet) const;
  // In its variables that were kept, which determine the others.
  bool contains(std::size_t sheet, const Sides& x) const;

  const System& system_;
  const Problem& problem_;
  const Cover& cover_;
  const std::vector<SheetBridge>& bridges_;
  Problem whole_;  // without a reduction
  std::vector<std::vector<int>> free_;
  std::vector<std::string> contradiction_;         // of each region
  std::vector<unsigned char> checked_by_its_box_;  // of each region
};

}  // namespace corank::check
