#include "corank/analyze/topology/topology_with_ends.h"

#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>
#include <limits>
#include <memory>
#include <set>

#include "corank/analyze/pieces/pieces.h"
#include "corank/certify/stratum.h"
#include "corank/core/box.h"
#include "corank/core/check.h"
#include "corank/core/rounding.h"
#include "corank/solve/exactness/exactness.h"
#include "corank/solve/search/solve.h"

namespace corank::analyze {
namespace {

struct Corner {
  int first, second;  // ends
  Box point;          // in the set's variables
};

struct StrataCount {
  HeightCount height;
  std::vector<Corner> corners;  // of a surface
  int boundary_minima = 0;      // of a surface: of the height on its boundary
  int boundary_index = 0;       // minima less maxima: 0
};

// A minimum (1) or a maximum (−1) of the height on a surface's boundary, or neither. At a corner the height grows along the
// one edge as it grows inward across the other.
int sign_on_boundary(const certify::StratumTest::Kind& kind) {
  if (kind.inward.size() == 1) return kind.index == 0 ? 1 : -1;
  if (kind.inward.size() == 2 && kind.inward[0] == kind.inward[1]) return kind.inward[0];
  return 0;
}

StrataCount count_on_strata(const certify::Strata& strata, const TopologyOptions& options, std::uint64_t& processed,
                            solve::Control& control) {
  StrataCount result;
  HeightCount& height = result.height;
  height.by_index.assign(strata.dimension() + 1, 0);
  const solve::Options search{.threads = options.threads};
  for (const std::vector<int>& ends : strata.strata()) {
    const auto stratum = [&] {
      const UpwardRounding rounding;
      return strata.stratum(ends);
    }();
    const solve::Prepared prepared = solve::prepare(stratum.system, search, control);
    Cover cover = solve::solve(prepared, control, options.most_for_a_height);
    processed += cover.statistics.processed;
    if (cover.complete()) solve::prove_exactly(prepared, cover, control);
    height.problem = problem_of_points(cover);
    if (!height.problem.empty()) return result;
    const UpwardRounding rounding;
    const certify::StratumTest test(strata, stratum);
    for (const CoverBox& point : cover.points) {
      const bool proven = point.verdict == Verdict::isolated || point.verdict == Verdict::exact;
      const auto kind = proven ? test.kind(point.box) : std::nullopt;
      if (!kind) {
        height.problem = proven ? "a critical point that may be degenerate, or where more ends meet"
                                : "a critical point that is not proven";
        return result;
      }
      if (kind->counted())
        ++height.by_index[kind->index];
      else
        ++height.uncounted;
      const int on_boundary = sign_on_boundary(*kind);
      result.boundary_index += on_boundary;
      result.boundary_minima += on_boundary > 0;
      if (ends.size() == 2 && strata.dimension() == 2)
        result.corners.push_back({ends[0], ends[1], Box(point.box.begin(), point.box.begin() + strata.variables())});
    }
  }
  return result;
}

bool same(const Polynomial& f, const Polynomial& g) {
  return std::equal(
      f.monomials.begin(), f.monomials.end(), g.monomials.begin(), g.monomials.end(),
      [](const Monomial& a, const Monomial& b) { return a.factors == b.factors && a.coefficient == b.coefficient; });
}

// The pieces of an end's part of a surface's boundary, and to which of them corners belong.
class EdgePieces {
 public:
  EdgePieces(const certify::Strata& strata, int end, const std::vector<Limit>& ends, const TopologyOptions& options,
             std::uint64_t& processed, solve::Control& control)
      : system_(with_single_values(strata.edge(end))) {
    const solve::Options search{.sigma = solve::kWhole, .threads = options.threads};
    const Cover cover = solve::solve(solve::prepare(strata.edge(end), search, control), control);
    processed += cover.statistics.processed;
    if (!cover.complete() || (!cover.boxes.empty() && cover.dimension != 1) || !std::ranges::all_of(cover.boxes, is_sheet))
      return;
    std::vector<Polynomial> functions;
    for (int k = 0; k < static_cast<int>(ends.size()); ++k)
      if (k != end) others_.push_back(k), functions.push_back(ends[k].function);
    // Beyond whatever end this cover's boxes touch a `boundary` box's sheet may go on.
    for (Limit& limit : limits(strata.edge(end), cover))
      if (std::ranges::none_of(functions, [&](const Polynomial& f) { return same(f, limit.function); }))
        functions.push_back(std::move(limit.function));
    if (cover.boxes.empty()) {
      count_ = 0;
      return;
    }
    if (!is_square_over(system_, 1)) return;
    cells_.emplace(system_, cover, std::vector<Polynomial>{}, functions, control);
    cells_->refine(options.halvings, options.rounds, control);
    pieces_ = pieces(*cells_, control);
    if (pieces_.exact()) count_ = pieces_.at_least;
  }

  std::optional<int> count() const { return count_; }

  /// The piece that ends at the corner of this end and another.
  std::optional<int> piece_at(const Box& corner, int other) {
    if (!cells_) return std::nullopt;
    const UpwardRounding rounding;
    const auto place = std::ranges::find(others_, other) - others_.begin();
    for (const Pieces::CellPart& part : pieces_.parts) {
      const SignCell& cell = cells_->cells()[part.cell];
      if (cell.mixed != std::vector<int>{static_cast<int>(place)}) continue;
      const bool inside = contains(cells_->region(cell), corner) && contains_over(cell.free, cell.sides, corner);
      if (inside && cells_->part_of_one(cell, part.signs[place]) == 1) return part.piece;
    }
    return std::nullopt;
  }

 private:
  System system_;
  std::vector<int> others_;
  std::optional<SignCells> cells_;
  Pieces pieces_;
  std::optional<int> count_;
};

std::optional<int> boundary_curves(const certify::Strata& strata, const std::vector<Limit>& ends,
                                   const std::vector<Corner>& corners, const TopologyOptions& options,
                                   std::uint64_t& processed, std::string& reason, solve::Control& control) {
  std::vector<std::unique_ptr<EdgePieces>> edges;
  std::vector<std::size_t> first;
  std::size_t all = 0;
  for (int k = 0; k < static_cast<int>(ends.size()); ++k) {
    edges.push_back(std::make_unique<EdgePieces>(strata, k, ends, options, processed, control));
    if (!edges.back()->count()) {
      reason = "the boundary's pieces at the " + ends[k].name + " could not be counted";
      return std::nullopt;
    }
    first.push_back(all);
    all += *edges.back()->count();
  }
  boost::disjoint_sets_with_storage<> classes(all);
  for (const Corner& corner : corners) {
    const std::size_t a = corner.first, b = corner.second;
    const auto p = edges[a]->piece_at(corner.point, corner.second), q = edges[b]->piece_at(corner.point, corner.first);
    if (!p || !q) {
      reason = "a corner on no known piece of the boundary";
      return std::nullopt;
    }
    classes.union_set(first[a] + *p, first[b] + *q);
  }
  std::set<std::size_t> found;
  for (std::size_t p = 0; p < all; ++p) found.insert(classes.find_set(p));
  return static_cast<int>(found.size());
}

// Where only one number b of curves is possible for a connected surface: b ≥ 1 and even or odd as the characteristic 2 − 2g
// − b is, at most 2 − χ, and each of the curves has a minimum of the height.
std::optional<int> only_possible(int euler, int minima) {
  const int most = std::min(2 - euler, minima), least = euler % 2 == 0 ? 2 : 1;
  return minima > 0 && most < least + 2 ? std::optional(least) : std::nullopt;
}

}  // namespace

std::string problem_of_points(const Cover& cover) {
  if (!cover.complete()) return "the search for critical points was ended by a limit";
  const auto is_point = [](const CoverBox& b) {
    return b.motion < 0 && b.free.empty() && b.reason != Reason::degenerate_set;
  };
  const bool points = cover.dimension == 0 && std::ranges::all_of(cover.boxes, is_point);
  return points ? "" : "critical points that are not isolated";
}

std::vector<Limit> without_unreached(const System& system, std::vector<Limit> ends, const TopologyOptions& options,
                                     std::uint64_t& processed, solve::Control& control) {
  constexpr std::uint64_t kMost = 20'000;  // boxes of a search: an end that takes more counts as reached
  const certify::Strata strata(system, {ends.begin(), ends.end()}, 0);
  std::vector<Limit> reached;
  const solve::Options search{.sigma = solve::kWhole, .threads = options.threads};
  for (std::size_t k = 0; k < ends.size(); ++k) {
    const Cover cover = solve::solve(solve::prepare(strata.edge(static_cast<int>(k)), search, control), control, kMost);
    processed += cover.statistics.processed;
    if (!cover.complete() || !cover.boxes.empty() || !cover.points.empty()) reached.push_back(std::move(ends[k]));
  }
  return reached;
}

void find_shape_with_ends(const System& system, int dimension, const std::vector<Limit>& ends,
                          const TopologyOptions& options, Topology& result, solve::Control& control) {
  const std::vector<certify::End> plain(ends.begin(), ends.end());
  std::optional<certify::Strata> strata;
  std::vector<Corner> corners;
  std::string problem;
  int minima = std::numeric_limits<int>::max();  // of the heights on the boundary
  for (int height = 0; height < kHeights && result.heights.size() < 2 && !control.ended(); ++height) {
    strata.emplace(system, plain, height);
    problem = strata->problem();
    if (problem.empty() && strata->dimension() != dimension) problem = "equations that depend on each other";
    if (!problem.empty()) break;
    StrataCount count = count_on_strata(*strata, options, result.processed, control);
    problem = count.height.problem;
    if (!problem.empty()) continue;
    CORANK_CHECK(dimension != 2 || count.boundary_index == 0);  // of closed curves
    result.heights.push_back(std::move(count.height));
    corners = std::move(count.corners);
    minima = std::min(minima, count.boundary_minima);
  }
  if (result.heights.empty()) {
    if (!problem.empty()) result.reason += (result.reason.empty() ? "" : "; ") + problem;
    return;
  }
  result.with_ends = true;
  Components& components = result.components;
  for (const HeightCount& h : result.heights) {
    CORANK_CHECK(h.euler_characteristic() == result.heights.front().euler_characteristic());
    // A manifold with corners has the components of its interior.
    if (!components.at_most || *components.at_most > h.by_index.front()) components.at_most = h.by_index.front();
    CORANK_CHECK(components.at_least <= *components.at_most);
  }
  if (components.exact()) components.reason.clear(), result.reason.clear();
  result.euler_characteristic = result.heights.front().euler_characteristic();
  if (dimension != 2 || control.ended()) return;
  const bool connected = components.exact() && components.at_least == 1;
  std::string reason;
  result.boundary = boundary_curves(*strata, ends, corners, options, result.processed, reason, control);
  if (connected && !result.boundary) result.boundary = only_possible(*result.euler_characteristic, minima);
  CORANK_CHECK(!result.boundary || *result.boundary <= minima);
  if (!result.boundary) {
    if (result.reason.empty()) result.reason = reason;
    return;
  }
  if (connected) {
    const int twice = 2 - *result.euler_characteristic - *result.boundary;
    CORANK_CHECK(twice >= 0 && twice % 2 == 0);
    result.genus = {twice / 2};
  }
}

}  // namespace corank::analyze
