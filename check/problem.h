// What the checker knows of a system after the reduction: rows over the kept variables, and what its equations imply about
// its domain.
#pragma once

#include <optional>
#include <vector>

#include "corank/check/implied.h"
#include "corank/check/rows.h"
#include "corank/core/cover.h"

namespace corank::check {

/// Has the box this number of sides, all of them bounded?
bool is_box(const Box& box, std::size_t sides);

/// One side of a variable's domain as a condition: row(x) ≥ 0 at every point of the set.
struct Condition {
  Row row;
  bool implied = false;  ///< it holds at every solution of the equations
  int variable = -1;     ///< whose domain it is; −1: an inequality of the system
  /// Where the variable is eliminated and a·y + c with exact numbers, the same end of y, rounded outward: y ≥ it, or ≤ it.
  struct Image {
    int of;  ///< y
    double end;
    bool is_lower;
  };
  std::optional<Image> image{};
};

class Problem {
 public:
  /// Throws std::invalid_argument where a step of the reduction is not legal.
  Problem(const System& system, const std::vector<ReductionStep>& reduction, const StopFlag& stop = {});

  const System& system() const { return system_; }
  const StopFlag& stop() const { return stop_; }
  int size() const { return static_cast<int>(kept_.size()); }
  const std::vector<int>& kept() const { return kept_; }
  int place(int variable) const { return place_[variable]; }  ///< among the kept, −1: eliminated
  const std::vector<int>& places() const { return place_; }
  const std::vector<Row>& equations() const { return equations_; }
  const std::vector<Row>& implied() const { return implied_equations_; }  ///< rows that vanish where all equations do
  const std::vector<Terms>& terms() const { return terms_; }  ///< of the equations, by the variables' own indices
  /// Of a box in all variables, the sides that were kept.
  Sides kept(const Box& box) const;
  bool contradiction() const { return contradiction_; }
  /// Eliminated variables' values.
  struct Value {
    int variable;
    Row row;
  };
  const std::vector<Value>& values() const { return values_; }
  /// Both sides of every domain, then the inequalities.
  const std::vector<Condition>& conditions() const { return conditions_; }
  /// May a solution in the domain come to where its row is 0? Not where the equations imply it, nor at the ends of a length
  /// that has one value.
  bool is_end(const Condition& c) const;
  /// Intersects with the domains that the equations imply: no solution is lost. False: that is empty.
  bool clip_to_implied(Sides& x) const;
  /// The domain of the kept variables, enclosed.
  Sides domain() const;
  /// domain_lengths() of the kept variables.
  std::vector<double> lengths() const;

 private:
  void add_domain(int variable, const std::optional<Terms>& value, int sign);

  System system_;
  StopFlag stop_;
  Implied implied_;  // by the equations before and after the reduction
  std::vector<int> kept_, place_;
  std::vector<Row> equations_, implied_equations_;
  std::vector<Terms> terms_;
  std::vector<Value> values_;
  std::vector<Condition> conditions_;
  std::vector<unsigned char> implied_lower_, implied_upper_;  // of the kept
  bool contradiction_ = false;
};

}  // namespace corank::check
