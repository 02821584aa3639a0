// The checker's own look at self-motions: linear relations on which the other equations become dependent. Theorem:
// doc/theory.md ("Self-motions").
#pragma once

#include <string>
#include <vector>

#include "corank/check/problem.h"

namespace corank::check {

class MotionCheck {
 public:
  /// Substitutes the relations R exactly into the reduced equations F.
  MotionCheck(const Problem& problem, const SelfMotionRecord& record);

  /// Why the record claims what is not so: nothing where {R = 0, g = 0} solves all of F, g the rows of F that the
  /// substitution leaves, up to rational factors, these are as many as its dimension asks for, and that is larger than the
  /// count of F says.
  const std::string& fault() const { return fault_; }
  /// R and g.
  const std::vector<Row>& rows() const { return rows_; }

  /// Do some of F's equations have at most one zero in `region` for every value of the free variables in the box? With
  /// exactly one zero of rows() there, that is the one solution of F. Returns what could not be shown.
  std::string unique(const CoverBox& box, const Box& region) const;

 private:
  const Problem& problem_;
  std::vector<Row> rows_;
  std::string fault_;
};

}  // namespace corank::check
