// Exact rewriting of a system before it is solved, and the way back. solve/reduction/reducer.h chooses the steps.
//
// Variables that an equation defines are eliminated, equations that then hold identically or repeat another are dropped:
//   (a) a·x + b = 0 and a·x + b·y + c = 0 with rational a, b ≠ 0: x is replaced everywhere by its value;
//       Likewise a variable whose domain is one number;
//   (b) a·x + g = 0 with a rational a ≠ 0 and x in no other equation or inequality: x is g's image, whatever g is;
//   (c) f = 0 becomes f + q·g = 0 with any rational q and another equation g = 0.
// Theorem: let x_e = p_e(x') be the eliminated variables' values as polynomials in the variables x' that are kept. Then
// x' ↦ (x', p(x')) is a bijection from the reduced system's solutions to the system's, and keeps boxes of values of kept
// variables. Proof:
// (a) and (b) replace the pair {x = p, f = 0} by {x = p, f(p) = 0}, have p's range in x's domain as a condition (on the
// domain of y, or as an inequality), and multiply by no polynomial; (c) keeps g, so {f + q·g = 0, g = 0} ⇔ {f = 0, g = 0}. A
// dropped equation is 0 = 0 or a rational multiple of one that is kept, for every choice of coefficients within their
// tolerance (but see Reduction::subset). So exactly one solution of the reduced system for every value of some kept
// variables means exactly one of the system's.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "corank/core/reduction_step.h"
#include "corank/core/system.h"

namespace corank::certify {

struct Reduction {
  struct Definition {
    int variable;      ///< index in the original system
    Polynomial value;  ///< in the kept variables, by their indices in `system`
  };

  System system;                        ///< in the kept variables
  std::vector<int> kept;                ///< kept[j]: index in the original system of variable j of `system`
  std::vector<Definition> definitions;  ///< the others
  std::vector<int> origins;             ///< of each equation of `system`: its index in the original one
  int given_equations = 0;              ///< of the original system
  std::vector<ReductionStep> steps;     ///< in their order; those that eliminate are in the order of `definitions`
  bool tolerant = false;                ///< enclosures carry the coefficient tolerance
  /// An equation was dropped that holds for some choices of coefficients only, and for the others to kPartialTolerance · τ,
  /// relative to the sum of its |coefficients|: proofs about `system` are about a subset of the equations.
  bool subset = false;
  bool consistent = true;  ///< false: an equation became "a nonzero number = 0", the system has no solution

  /// The box of the original system whose kept sides are the first of `sides` and whose other sides are the rest, in the
  /// order of `definitions`.
  std::vector<Interval> lift(const std::vector<Interval>& sides) const;
};

/// A system to which steps are applied one by one. Every step is checked: the hypotheses of the theorem are on the lines
/// that do so, and a step that is not legal is a broken invariant. Which steps to take is not decided here
/// (solve/reduction/reducer.h). Every change requires UpwardRounding::active().
class Rewriting {
 public:
  /// `tolerant`: enclosures carry the coefficient tolerance; else all is about the exact coefficients.
  /// `parameters`, besides the system's own, are variables for each of whose values the question is asked: they stay, with
  /// their domains as they are.
  /// What a variable that is eliminated says about a parameter becomes an inequality. So for *every* value of the parameters
  /// there is the bijection of the theorem (read its proof for fixed parameters), and a range of the parameters may be put
  /// in their places in both systems.
  /// `poll` is called now and then; it may throw.
  explicit Rewriting(
      const System& system, bool tolerant, std::vector<int> parameters = {}, std::function<void()> poll = [] {});

  /// As it is now. Variables that are eliminated are in it, but in no equation and no inequality.
  const System& system() const { return system_; }
  int origin(std::size_t row) const { return origins_[row]; }  ///< of an equation: its index in the system as given
  /// The variables that are eliminated, by their indices in the system as given, with values in the others.
  const std::vector<std::pair<int, Polynomial>>& definitions() const { return definitions_; }
  bool consistent() const { return consistent_; }

  /// May the variable be eliminated: is it in no sine or cosine, no parameter, and still there?
  bool may_go(int variable) const { return !stays_[variable] && !gone_[variable]; }
  /// −g/a where that equation is a·x + g = 0 of (a) or (b): a rational a ≠ 0, x not in g, no tolerance.
  std::optional<Polynomial> value_of(int variable, std::size_t row) const;
  /// Its value where its domain is one number.
  std::optional<Polynomial> fixed_value(int variable) const;
  /// A tolerance is about the equations as given: what `partial` says of one does not hold of a sum.
  bool may_add() const { return system_.coefficient_tolerance == 0; }

  void apply(const Elimination& step);     ///< (a), (b)
  void apply(const SumOfEquations& step);  ///< (c)
  /// Drops what holds identically. False once the system is known to be inconsistent.
  bool drop_identities();
  /// Drops what repeats an equation before it; where it does so exactly, the step that makes it 0 = 0 is noted.
  void drop_repeated();

  Reduction result() const;

 private:
  // Is |f| within `partial`'s tolerance all over the domain, for an equation of that scale?
  bool within_tolerance(const Polynomial& f, double scale) const;
  // Is the equation 0 = 0 but for its tolerance, and that small?
  bool negligible(std::size_t row) const;
  std::size_t row_of(int equation) const;
  void erase_row(std::size_t row);
  void replace_everywhere(int variable, Polynomial value);
  // Narrows y's domain to where a·y + c lies in x's; or adds inequalities.
  void carry_domain(int x, const Polynomial& value);
  void refresh(Polynomial& f) const;

  System system_;
  const bool tolerant_;
  const std::function<void()> poll_;
  std::vector<int> parameters_;
  std::vector<bool> gone_, stays_;
  std::vector<std::pair<int, Polynomial>> definitions_;
  std::vector<ReductionStep> steps_;
  std::vector<int> origins_;
  int given_ = 0;               // equations
  std::vector<double> scales_;  // of each equation: the sum of its |coefficients| as given, rounded downward
  bool subset_ = false;
  bool consistent_ = true;
};

/// An equation that follows from others, h = Σ c·p·f with rational numbers c (factors), products p of powers of variables,
/// and equations f of the reduced system: `of` names those of `system` by their indices, then its implied ones; variables
/// are `system`'s. Requires UpwardRounding::active().
/// Theorem: where all f vanish, so does h. So boxes may be shrunk by h = 0 (certify/projection.h), and no solution is lost,
/// whatever the c and p are. It is no equation of the system: no statement about existence, uniqueness or rank rests on it.
/// Proof: put in. The c and p stand in the reduction's steps, so that a checker forms h itself.
Polynomial implied_equation(const System& system, const ImpliedEquation& of);

/// Adds the equation to reduction.system.implied and, by the names of the original system, to reduction.steps. Requires
/// UpwardRounding::active().
void add_implied(Reduction& reduction, const ImpliedEquation& of, const std::string& source);

}  // namespace corank::certify
