// Can the output pass the configurations of a box of a workspace boundary, as the box says? (core/passage_form.h)
//
// Theorem: certify/passage.h; doc/theory.md, "Barriers". Here N is shown to be regular, and the form to be definite, by the
// pivots of eliminations (check/inertia.h), and the form to take both signs by its values at the unit vectors and at about
// its eigenvectors. A λ that the system does not have is found from N, with 1 as the multiplier of the row that N passes
// over.
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
  // x, and behind it of every solution in it a λ, where the system has none: in several ways, each of which holds.
  std::vector<Sides> with_multipliers(const Sides& x) const;
  // The reduced form S over x; nothing where the hypotheses about λ and N are not shown.
  std::optional<std::vector<Sides>> form(const Sides& x) const;
  bool holds(const CoverBox& box, const Sides& part) const;
  bool holds_with_multipliers(const CoverBox& box, const Sides& x) const;
  bool contract(Sides& x) const;

  StopFlag stop_;
  bool has_form_ = false, has_slacks_ = false;
  std::size_t columns_ = 0;
  RowMatrix jacobian_;
  std::vector<Row> hessian_, slack_, normal_, equations_, inequalities_;
  std::vector<int> multipliers_, arguments_;
  int variables_;                // of the system; multipliers from there on are no variables of it
  std::vector<double> lengths_;  // of the variables' domains
};

}  // namespace corank::check
