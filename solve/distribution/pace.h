/// \file
/// How much of a search is given out at a time. A heuristic: no box depends on it.
#pragma once

#include <cstddef>

namespace corank::solve {

/// Units are short where the search has just begun, since boxes have to become enough for all, and where it comes to its
/// end, since nobody can be given what another does; between, they are as long as they may be: each takes its time to send.
class Pace {
 public:
  /// So many units are to be under way, of so many boxes at least, each for so many seconds.
  struct Units {
    std::size_t most = 0;
    std::size_t fewest_boxes = 1;
    double seconds = 0;
  };

  /// Of the pass that is under way. waits: the share of the search domain that is not done yet. time: of any clock, in
  /// seconds.
  struct Progress {
    int pass = 0;
    double waits = 1;
    std::size_t units_under_way = 0;
    double time = 0;
  };

  /// threads: of all workers. longest: of a unit, in seconds; units are longer where threads are too many to be given units
  /// as fast.
  Units next(std::size_t threads, double longest, const Progress& now);

  /// Where sheets are cut, units are done to their end.
  static Units of_sheets(std::size_t threads, double longest);

 private:
  int pass_ = -1;
  double begun_ = 0;
  double waited_ = 1;  // then
};

}  // namespace corank::solve
