// A C-space of low dimension as a graph of the boxes of its cover: what the boxes keep apart is apart, and what they join
// may be joined.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "corank/analyze/paths/path_space.h"
#include "corank/analyze/paths/tube_builder.h"
#include "corank/solve/step/control.h"

namespace corank::analyze {

class PathGraph {
 public:
  /// A cover of the space with edges of `sigma` at most, a share of the lengths' sizes. Ready where it is complete.
  PathGraph(const PathSpace& space, double sigma, int threads, std::uint64_t most_boxes, solve::Control& control);
  ~PathGraph();

  bool ready() const { return ready_; }
  double sigma() const { return sigma_; }

  /// Theorem: on a path without singularities all sign functions (PathSpace::signs) keep their signs. Each of its points is
  /// in a box of the cover whose signs do not contradict them. Those boxes are finitely many closed sets; a path, which is
  /// connected, stays in one group of boxes that hang together. True: no group meets both ends, so there is no such path.
  bool apart(const Box& from, const Box& to, const std::vector<int>& signs) const;

  /// A way in doubles over boxes that touch, along which the signs are those; shortest but for a price of narrow places.
  /// Calls of one query share `blocked`, to which steps are added that turn out to be none.
  using Blocked = std::vector<std::pair<std::size_t, std::size_t>>;
  std::optional<TubeBuilder::Points> way(const PathSpace::Point& from, const PathSpace::Point& to,
                                         const std::vector<int>& signs, const TubeBuilder& builder, Blocked& blocked,
                                         const solve::Control& control);
  /// Blocks the step k of the last way().
  void block(std::size_t step, Blocked& blocked) const;

 private:
  struct Graph;

  std::vector<std::size_t> compatible(const std::vector<int>& signs) const;
  void prepare_points(const std::vector<int>& signs);

  const PathSpace& space_;
  double sigma_;
  bool ready_ = false;
  std::unique_ptr<Graph> graph_;
  std::vector<std::size_t> last_way_;
};

}  // namespace corank::analyze
