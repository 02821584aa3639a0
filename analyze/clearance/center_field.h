// The distance of the nearest singularity as a function of the ball's centre, which moves in a region: some of the ball's
// coordinates, lengths, each in an interval. The others keep their values.
//
// Theorem: |r(a) − r(b)| ≤ |a − b| for the distance r(a) of a set S from a. So one value bounds r all about it:
// r(a) − |a − b| ≤ r(b) ≤ r(a) + |a − b|. It holds for any a, whether the robot has a configuration there or not.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "corank/analyze/clearance/ball.h"
#include "corank/analyze/sets/nearest.h"

namespace corank::analyze {

class CenterField {
 public:
  /// `region`: coordinates of `ball.in`; clipped to the model's ranges. Throws ModelError.
  CenterField(const study::Question& question, BallOptions ball, const std::vector<NamedRange>& region,
              const solve::Options& search, solve::Control& control);

  const std::vector<std::string>& names() const { return names_; }
  const Box& region() const { return region_; }
  const Ball& ball() const { return ball_; }
  const System& system() const { return prepared_.system; }

  /// As nearest() returns it; `upper` may be that of a singularity which was found from another centre. Those spare most of
  /// the search: it has to look for nearer ones only.
  Nearest distance(const std::vector<double>& center, const NearestOptions& options);

  /// Does the robot have a configuration whose ball's coordinates are in these intervals?
  struct Configurations {
    bool proven = false;         ///< it has one
    bool excluded = false;       ///< proven: none
    std::vector<double> near{};  ///< where one seems to be
  };
  Configurations configurations(std::span<const Interval> centers) const;

 private:
  solve::Options search_;
  solve::Control& control_;
  std::vector<std::string> names_;
  Box region_;
  Ball ball_;
  solve::Prepared prepared_;
  std::vector<Polynomial> differences_;  ///< from 0 in the region's coordinates, which come first
  std::vector<Nearest> known_;           ///< one proven singularity each
  std::optional<System> assembled_;      ///< the configurations; of a plain system nothing, where any centre will do
};

/// The distance from `center` of the point of the box that is farthest from it, or more.
double reach(std::span<const Interval> box, const std::vector<double>& center);

/// The region's intervals, clipped to the model's ranges. Throws ModelError where one is empty or not bounded.
Box bounded_region(const study::Question& question, const std::vector<NamedRange>& region);

/// The ranges that the model declares for these coordinates. Throws ModelError where one has none or is an angle.
std::vector<NamedRange> declared_ranges(const study::Question& question, const std::vector<std::string>& names);

}  // namespace corank::analyze
