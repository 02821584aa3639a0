// Small boxes that resist proof next to degenerate solutions: those on self-motions are proven as such, and which of the
// others are worth dividing further. Heuristic but for the proofs, which are certify/self_motion.h's.
#pragma once

#include <vector>

#include "corank/core/cover.h"
#include "corank/solve/store/self_motion_search.h"
#include "corank/solve/store/shard.h"

namespace corank::solve {

/// The self-motions that a search has met.
class SelfMotions {
 public:
  /// To be called when a search begins or goes on: the first motions are the strata that the problem knows.
  void begin(const Problem& problem);
  /// Looks for self-motions through the boxes, all of about `share` of the typical sizes, and proves what it can:
  /// Postponed::proof. Returns for each other box Reason::none where it is to be divided further, else why not. Around an
  /// isolated degenerate solution a few boxes stay at each size, so those are divided on, down to a share of about 1e-7
  /// where the set is to have dimension 0, and 1/400 else. Along a curve or a larger set of degenerate solutions their
  /// number grows without end: what is not proven there stays as it is.
  std::vector<Reason> prove(const Problem& problem, const System& system, std::vector<Postponed>& boxes, double share);
  /// The largest dimension of a set that was met, as its samples show; 0: none is larger than expected. No claim.
  int observed_dimension() const { return observed_; }
  /// In the order of CoverBox::motion.
  const std::vector<Stratum>& known() const { return known_; }
  /// From what restored() makes the same again, with the same reduced system.
  struct Stored {
    std::vector<SelfMotionRecord> motions;  ///< in the kept variables
    int observed = 0;
    std::uint64_t former = 0;
  };
  Stored stored() const;
  /// Throws std::invalid_argument where a record is none of a self-motion of the system.
  static SelfMotions restored(const System& system, Stored stored);
  /// In all variables.
  std::vector<SelfMotionRecord> records(const certify::Reduction& reduction) const;

 private:
  // Those of the cluster that lie on a known self-motion; all, where there is none yet: looks for one.
  void prove_cluster(const Problem& problem, const System& system, std::vector<Postponed>& boxes,
                     const std::vector<std::size_t>& cluster, double share);
  // Is the box on a known one, as far as doubles tell? Proves it, if it can.
  bool prove_on_known(const Problem& problem, Postponed& box);
  void prove_on(std::size_t motion, const Problem& problem, Postponed& box);

  std::vector<Stratum> known_;
  int observed_ = 0;
  std::size_t former_ = 0;  // the number of boxes at the last call
};

}  // namespace corank::solve
