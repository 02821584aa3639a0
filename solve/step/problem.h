// What all threads of a search share, and what each of them finds.
#pragma once

#include <boost/container/deque.hpp>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>

#include "corank/certify/domain.h"
#include "corank/certify/newton.h"
#include "corank/certify/reduction.h"
#include "corank/core/cover.h"
#include "corank/solve/step/branching.h"
#include "corank/solve/step/heuristics.h"
#include "corank/solve/step/recorder.h"
#include "corank/solve/step/sigma.h"
#include "corank/solve/step/stratum.h"

namespace corank::solve {

/// Of the eliminated variables, in the kept ones.
std::vector<Polynomial> values_of(const certify::Reduction& reduction);

/// Constant during a search.
struct Problem {
  /// `ended` tells, from any thread, that a limit or a stop has ended the search.
  Problem(const System& system, const certify::Reduction& reduction, std::function<bool()> ended);

  /// To be called before pieces are cut.
  void set_sigma(const Sigma& sigma);
  /// The largest ratio of a side's width to the σ of its variable: above 1 a piece is to be cut. For the sides of the kept
  /// variables, with or without those of the eliminated ones behind them.
  double excess(const Box& sides) const { return excess(sides, sigma); }
  /// The same for another σ of each variable.
  static double excess(const Box& sides, const std::vector<double>& sigma);
  /// The largest ratio of a kept variable's side to its typical size.
  double relative_width(std::span<const Interval> x) const;

  /// Of each kept variable: as wide as an unproven box may be when it is given up for small; a share of twice its typical
  /// size. Where coefficients carry a tolerance, below which nothing can be proven, no more than σ.
  std::vector<double> limits(double share) const;

  /// Have the solutions two or more degrees of freedom?
  bool has_surfaces() const { return compiled.unknowns() > compiled.equations() + 1; }
  /// Are the sheet's proofs about an independent subset of the equations only?
  bool is_partial(const certify::Sheet& sheet) const {
    return subset || (sheet.motion < 0 && static_cast<int>(sheet.equations.size()) < compiled.equations());
  }
  /// Is a part of a sheet in x as good as a whole sheet, since it would not be cut?
  bool may_be_part(std::span<const Interval> x) const;
  /// Of these variables those that may be divided.
  std::vector<int> without_parameters(std::vector<int> variables) const;
  /// Appends the eliminated variables' sides over x to the n sides of x (what follows those is renewed).
  void append_values(Box& sides) const;
  /// The same of the zeros of the step's rows in the sides, a part of its box.
  void append_values_at_zeros(const certify::NewtonStep& step, Box& sides) const;

  certify::CompiledSystem compiled;  ///< value rows: the eliminated variables
  certify::RedundantEquations
      redundant;  ///< applies(): a proof may speak of an independent subset of the equations (`partial`)
  certify::DomainTest domain;
  bool subset;    ///< certify::Reduction::subset
  bool tolerant;  ///< coefficients carry a tolerance, or equations may hold within one only
  /// Of the typical sizes: how much parameters within their tolerances change the equations. Bisecting narrower boxes
  /// decides nothing; 0 where there are no parameters.
  double tolerance_width = 0;
  double rank_tolerance;  ///< pivots below count as zero where equations may be redundant
  BranchingRule branching;
  Heuristics heuristics;
  /// A box no wider than σ of which all is proven but that its sheet stays inside is done (certify::newton_prove_in_part).
  /// Where sheets are not to be cut solids have a tenth of the boxes then, surfaces half of them.
  bool parts_of_sheets = false;
  /// Of the kept variables, then of the eliminated ones: the σ that applies to it; infinite where none does (kernel vectors,
  /// auxiliaries).
  std::vector<double> sigma;
  std::vector<double> equation_sizes;  ///< TypicalSizes::equations
  std::vector<Stratum> strata;         ///< known before the search (solve/store/strata.h)
  std::function<bool()> ended;

 private:
  double change_by_parameters(const Box& whole) const;

  std::vector<SigmaClass> classes_;  // in the order of `sigma`
};

/// A box of the result and, for an isolated solution, its sheet. The sides of the eliminated variables follow those of the
/// others, as certify::Reduction::lift takes them; the sheet and `free` know only the others.
struct Found {
  CoverBox box;
  std::unique_ptr<const certify::Sheet> sheet;  ///< of an isolated solution
  std::shared_ptr<const Box> region;  ///< that of the proof, as `box` has its sides; one for all boxes cut from a sheet
  std::vector<LeafId> leaves;         ///< of a recorded search: those whose solutions are in the box (solve/step/recorder.h)
  static constexpr std::uint32_t kNowhere = 0xffffffff;
  std::uint32_t place = kNowhere;  ///< in the cover, once the boxes are sorted
};
/// Growing moves none of them, and what is taken from the front gives its memory back in whole pages: a large search holds
/// each box once.
using FoundList =
    boost::container::deque<Found, void,
                            boost::container::deque_options_t<boost::container::block_bytes<std::size_t{1} << 16>>>;

}  // namespace corank::solve
