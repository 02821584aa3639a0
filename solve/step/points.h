// From boxes to distinct solutions.
#pragma once

#include <vector>

#include "corank/core/ended.h"
#include "corank/solve/step/problem.h"

namespace corank::solve {

/// Of a set of dimension 0: removes every isolated box that holds the same solution as another (certify::compare_isolated)
/// and every undecided box that holds nothing but a proven solution. Where identity cannot be decided, the boxes lose their
/// verdict: both become undecided. So does each box that is not compared with all others once `ended` is true.
void merge_isolated(std::vector<Found*>& found, const Ended& ended = {});

/// The connected groups of the boxes whose sides overlap when widened by their gaps (of the first sides, as many as there
/// are gaps); each as its indices, ascending; in the order of their first. Once `ended` is true the groups are parts of
/// these.
std::vector<std::vector<std::size_t>> clusters(const std::vector<const Box*>& boxes, const std::vector<double>& gaps,
                                               const Ended& ended = {});

/// Makes one box, their hull, of the undecided boxes about each isolated degenerate solution (Reason::degenerate_point):
/// those that are no farther apart than `gap`, a share of the typical sizes, unless they reach farther than boxes about one
/// point.
void merge_degenerate(const Problem& problem, std::vector<Found*>& found, double gap, const Ended& ended = {});

/// Of a set of dimension 0 the distinct solutions: each isolated or boundary box, and the hull of each cluster of undecided
/// boxes that are no farther apart than their gaps; pending ones, and what lies along a larger set, left out (the hull is no
/// claim, so the gaps are free to choose). Where `ended` is true before the clusters are known, all undecided boxes are one.
/// `parameters`: how many the system has.
std::vector<CoverBox> collect_points(const std::vector<Found*>& found, const std::vector<double>& gaps,
                                     const Ended& ended = {}, std::size_t parameters = 0);

}  // namespace corank::solve
