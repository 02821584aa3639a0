// Are two convex bodies as far apart as required at every zero for which forms hold, or at none? The theorems are those of
// certify/distance.h and doc/theory.md ("Requirements"); the code is the checker's own.
#pragma once

#include "corank/check/requirement.h"
#include "corank/check/stop.h"

namespace corank::check {

/// Do bodies keep their distances all over boxes of the system's variables? A function is f(c) + s·(x − c) there.
class DistanceCheck {
 public:
  DistanceCheck(const System& system, const KeptDistances& distances, const StopFlag& stop);
  /// Divides the box where need be; false: not shown.
  bool holds(const Sides& box) const;

 private:
  bool holds_in_one(const Sides& x) const;

  StopFlag stop_;
  std::vector<DistanceTest> tests_;
  std::vector<Row> functions_;
  std::vector<int> arguments_;
  std::vector<double> lengths_;
};

Standing standing(const DistanceTest& test, const FormOfVariable& form, const Sides& offsets);

}  // namespace corank::check
