// The ways in which a written-out parallelogram closes, taken apart: as a parallelogram, and crosswise.
//
// Where such a loop is flat both ways meet, C-space has branches that cross, and no box about them can be certified. An
// angle τ tells them apart: each branch has equations of its own, and with τ they are one system, whose solutions are
// isolated from those of the other branch. A configuration on both branches is a solution for both values of τ.
//
// Theorem (doc/theory.md, "Branches of parallelograms"). Let A + B = C + D be the loop, |A| = |C| = a, |B| = |D| = b, in the
// plane, as complex numbers. Its solutions are those of the branches
//   parallelogram:     C and A point the same way, D and B do;
//   crosswise, a < b:  Im A C B̄ D̄ = 0, Re A C B̄ D̄ ≥ 0, Im (A B̄ + A D̄ − D B̄) = 0, Re D B̄ + a² ≥ 0
//                      (a > b: the pairs change places);
//   crosswise, a = b:  C = B, D = A; or B = −A, D = −C.
// Where C is a rod, whose direction is no coordinate, there is no condition on A C B̄ D̄, and for a > b the others are
//   Im A² B̄ D̄ / b² = Im (A B̄ − A D̄), Re A² B̄ D̄ / b² + b² ≥ 0.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "corank/kinematics/loops/parallelograms.h"
#include "corank/kinematics/loops/plane.h"

namespace corank::kinematics {

/// The branches of one loop: as many equations each as the loop has.
struct LoopBranches {
  struct Branch {
    std::vector<ex> zero, not_negative;
  };
  std::vector<Branch> list;       ///< two, or of a rhombus three; the parallelogram first
  std::size_t parallelogram = 0;  ///< which one of those that were looked for
};

class BranchFinder {
 public:
  /// Not `enabled`, it finds no branches.
  BranchFinder(std::vector<Parallelogram> parallelograms, const Algebra& algebra, bool enabled)
      : parallelograms_(std::move(parallelograms)), algebra_(algebra), enabled_(enabled) {}

  const std::vector<Parallelogram>& parallelograms() const { return parallelograms_; }

  /// Of the loop whose gap is `open`, where a parallelogram closes it.
  std::optional<LoopBranches> of_loop(const PlanePoint& open, const Plane& plane) const;
  /// Of the loop that a rod closes, the joint in Bodies::joints; `gap`: the way along it.
  std::optional<LoopBranches> of_rod(std::size_t rod, const PlanePoint& gap, const Plane& plane) const;

  /// A, B, C, D in the plane; that of a rod is not known.
  using Sides = std::array<std::optional<Turn>, 4>;

 private:
  LoopBranches branches_of(const Sides& sides, std::size_t number) const;
  bool are_equal(const PlanePoint& a, const PlanePoint& b) const;
  bool are_opposite_or_equal(const PlanePoint& a, const PlanePoint& b) const;

  const std::vector<Parallelogram> parallelograms_;
  const Algebra& algebra_;
  const bool enabled_;
};

}  // namespace corank::kinematics
