// Can the output pass the configurations of a box of a workspace boundary, as the box says? (core/passage_form.h)
//
// Theorem: certify/passage.h; doc/theory.md, "Barriers". Here N is shown to be regular by a spectral radius below 1, the
// form to be definite by the pivots of its elimination (a symmetric matrix is positive definite where all of them are
// positive), and to take both signs by the values in the directions of its elimination in doubles.
#pragma once

#include <optional>
#include <vector>

#include "corank/check/rows.h"
#include "corank/check/stop.h"
#include "corank/core/cover.h"

namespace corank::check {

class PassageCheck {
 public:
  explicit PassageCheck(const System& system, const StopFlag& stop = {});

  /// Is what the box says so, of every solution in it? Bisects the box where need be. Else why not.
  std::string fault(const CoverBox& box) const;

 private:
  struct Form {
    std::vector<Sides> s;  ///< reduced
    Sides slack;
  };
  std::optional<Form> form(const Sides& x) const;
  bool holds(const CoverBox& box, const Sides& x) const;
  bool contract(Sides& x) const;

  StopFlag stop_;
  std::size_t equations_ = 0, columns_ = 0;
  bool has_form_ = false;
  std::vector<Row> jacobian_, hessian_, slack_, normal_, rows_;
  std::size_t system_equations_ = 0;
  std::vector<int> multipliers_, arguments_;
  std::vector<double> lengths_;  // of the variables' domains
};

}  // namespace corank::check
