// Boxes of a cover taken out and others put in their place, its proof along with them. The caller sees to it that the cover
// stays one of the same solutions; the checker of the proof does not take that on trust.
#pragma once

#include <memory>
#include <vector>

#include "corank/certify/reduction.h"
#include "corank/core/cover.h"

namespace corank::solve {

/// A box and its parts: each split leaves one part, which goes to a search of its own, and what goes on to the next split;
/// the core is what remains. Splits number the variables that are kept.
struct Partition {
  struct Split {
    int variable;
    double where;
    bool part_is_lower;
  };
  Box whole;  ///< in all variables
  std::vector<Box> parts;
  std::vector<Split> splits;
};

class CoverEdit {
 public:
  CoverEdit(Cover& cover, const certify::Reduction& reduction) : cover_(cover), reduction_(reduction) {}

  /// Box i goes; its solutions are in box `by`.
  void replace(int i, int by);
  /// The boxes go; their solutions are in the whole, of which `around` covers the parts, searched in that order, and `core`
  /// the core.
  void replace(const std::vector<std::size_t>& boxes, const Partition& partition, Cover around, CoverBox core);
  /// Removes what was replaced, sorts the boxes as solve() does, and renumbers them in the proof. Ends the edit.
  void finish();

 private:
  // Of each box: it stays; the box that takes its place; or kInRoot − the root of the proof that does.
  static constexpr int kStays = -1, kInRoot = -2;
  Proof& proof();  // the edit's own copy
  // Adds a root for the whole; returns its number.
  int append(const Partition& partition, Proof around, int first_box);

  Cover& cover_;
  const certify::Reduction& reduction_;
  std::vector<int> fate_;
  std::shared_ptr<Proof> proof_;  // takes the cover's place at the end
};

}  // namespace corank::solve
