// A stored path, and the robots within tolerances: can every one follow it, or is there one that cannot?
//
// A stored tube (core/tube.h) has at its node k the section T_k·x = c_k, and between two nodes those that lie between. A
// robot's path x(t) solves its equations F(x, p) = 0 and the section at t. The path of the robot as drawn, p = v, begins in
// the tube's first node. The robots p ∈ P *follow* where there is one continuous function x(t, p) of solutions with regular
// Jacobians in x that has the drawn robot's path at p = v, within the domain and the inequalities, and at no x(t, p) one of
// the configurations that the path avoids. Where robots of a smaller box about v do not follow, those of P do not either.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "corank/analyze/paths/path_space.h"
#include "corank/analyze/paths/solution_family.h"
#include "corank/certify/domain.h"
#include "corank/certify/tube.h"
#include "corank/result/values/claim_files.h"

namespace corank::analyze {

class PathOfRobots {
 public:
  /// The question's robots. Throws ModelError as PathSpace does.
  PathOfRobots(const study::Question& question, Avoid avoid, const result::PathFile& file);

  /// Does the robot as drawn follow? From the tube's first node on. What is not proven, or nothing.
  std::string drawn(const solve::Control& control);
  /// Do all robots follow? False: not proven. Requires that drawn() has returned nothing, as does what comes below.
  bool all_follow(const solve::Control& control);

  /// Robots that do not all follow: those of the segment from the drawn one to a corner of the tolerances, up to a share
  /// of it.
  struct Failure {
    double share = 0;                    ///< in (0, 1]: so large a part of the tolerances holds them
    std::vector<CoordinateValue> robot;  ///< one of these has the configuration, or nearly
    std::vector<CoordinateValue> place;  ///< that configuration, of that robot
    std::string what;                    ///< "its path meets a singularity there"
  };
  /// One of a small share, proven; nothing: none was found, or none proven.
  std::optional<Failure> failure(const solve::Control& control);

 private:
  using Values = SolutionFamily::Values;
  struct Place {
    std::size_t piece = 0;
    double t = 0;
    std::vector<int> corner;  // of each parameter the end: −1 or 1
    double share = 1;
  };
  struct Segment;  // the robots towards a corner, at a place

  SolutionFamily& family(std::size_t piece);
  bool cover(const std::vector<Interval>& robots, std::vector<std::vector<SolutionFamily::Cell>>& cells,
             const solve::Control& control);
  Box free_sides(const std::vector<Interval>& robots, const Interval& t) const;
  Box configuration(const Box& solution) const { return {solution.begin(), solution.begin() + space_.size()}; }

  // In doubles.
  std::optional<Values> of_robot(const Place& place, double share);
  bool fails(const Place& place, double share);
  bool shrink(Place& place);  // its share, to where it fails first; false: it does not fail
  std::vector<std::vector<int>> corners() const;
  std::optional<Place> worst(const solve::Control& control);

  // The configuration there of the robot as drawn, on its path; nothing where that is not proven.
  std::optional<Box> drawn_at(const Place& place);
  // Of the segment's robots up to that share: the function that begins at the drawn one's configuration. Empty: not proven.
  std::vector<SolutionFamily::Cell> from_drawn(Segment& segment, const Box& drawn, double share,
                                               const solve::Control& control);
  std::optional<Failure> prove(const Place& place, const solve::Control& control);
  std::optional<Failure> prove_crossing(Segment& segment, double share, const solve::Control& control);
  std::optional<Failure> prove_fold(Segment& segment, double share, const solve::Control& control);
  std::string what_differs(const Box& drawn, const Box& there, const Place& place, double share) const;
  symbolic::Expression constant_at(const Place& place, std::size_t parameter, double share) const;
  Failure failure_of(const Segment& segment, const Box& there, const Interval& shares, std::string what) const;

  PathSpace space_;
  Avoid avoid_;
  certify::TubeProver prover_;
  certify::CompiledSystem compiled_;
  certify::DomainTest domain_;
  std::vector<TubeNode> nodes_;
  std::vector<Values> points_;   // the nodes, of the robot as drawn
  std::vector<int> parameters_;  // variables
  std::vector<ExactNumber> drawn_values_;
  std::vector<Interval> drawn_, tolerances_;  // of each parameter
  std::vector<std::unique_ptr<SolutionFamily>> families_;
  std::vector<std::vector<SolutionFamily::Cell>> drawn_cells_;
  std::vector<int> signs_;  // at the start
};

}  // namespace corank::analyze
