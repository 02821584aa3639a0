#include "corank/analyze/sets/components.h"

#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>
#include <map>
#include <set>

#include "corank/analyze/sets/limits.h"
#include "corank/certify/meeting.h"
#include "corank/core/box.h"
#include "corank/core/box_tree.h"
#include "corank/core/rounding.h"
#include "corank/solve/search/solve.h"
#include "corank/solve/step/problem.h"

namespace corank::analyze {
namespace {

// Is it proven that two boxes that touch have no solution in common?
class Separation {
 public:
  Separation(const System& system, solve::Control& control)
      : control_(control), prepared_(solve::prepare(system, {}, control)) {}

  bool apart(const Box& a, const Box& b) {
    constexpr std::uint64_t kMost = 200;  // boxes of a search: what takes more is not known
    Box common = a;
    if (!intersect(common, b)) return true;
    prepared_.options.roots = {common};
    const Cover cover = solve::solve(prepared_, control_, kMost);
    return cover.boxes.empty() && cover.complete();
  }

 private:
  solve::Control& control_;
  solve::Prepared prepared_;
};

// The groups of boxes that may hang together, those with a proven solution.
int groups_with_solutions(const System& system, const Cover& cover, const std::vector<int>& piece_of_box,
                          solve::Control& control) {
  const std::size_t n = cover.boxes.size();
  if (n == 0) return 0;
  boost::disjoint_sets_with_storage<> groups(n);
  std::map<int, std::size_t> first;  // box of each piece
  for (std::size_t i = 0; i < n; ++i)
    if (piece_of_box[i] >= 0) groups.union_set(i, first.emplace(piece_of_box[i], i).first->second);
  Separation separation(system, control);
  const BoxTree tree = box_tree(cover.boxes, &CoverBox::box);
  for (std::size_t i = 0; i < n; ++i)
    tree.for_each_overlapping(cover.boxes[i].box, 0.0, [&](std::size_t k) {
      if (k <= i || groups.find_set(i) == groups.find_set(k)) return;
      if (control.ended() || !separation.apart(cover.boxes[i].box, cover.boxes[k].box)) groups.union_set(i, k);
    });
  std::set<std::size_t> proven;
  for (std::size_t i = 0; i < n; ++i)
    if (is_proven(cover.boxes[i].verdict)) proven.insert(groups.find_set(i));
  return static_cast<int>(proven.size());
}

std::string other_boxes(const Cover& cover) {
  std::string text;
  for (const Verdict v : {Verdict::boundary, Verdict::undecided, Verdict::exact, Verdict::partial, Verdict::pending})
    if (const std::size_t n = cover.count(v); n > 0)
      text += (text.empty() ? "" : ", ") + std::to_string(n) + " " + to_string(v);
  return text;
}

// The hull of the boxes that a region's proof speaks of.
Box hull(const std::vector<int>& boxes, const Cover& cover) {
  Box result = cover.boxes[boxes.front()].box;
  for (const int i : boxes) include(result, cover.boxes[i].box);
  return result;
}

// The pieces that the regions of regular boxes make.
class Linker {
 public:
  Linker(const System& system, const Cover& cover)
      : system_(system), cover_(cover), compiled_(system), test_(system), kept_(system.size(), true) {
    for (std::size_t i = 0; i < cover.boxes.size(); ++i)
      if (cover.boxes[i].verdict == Verdict::regular) boxes_of_[cover.boxes[i].region].push_back(static_cast<int>(i));
    for (const auto& [region, boxes] : boxes_of_) {
      index_[region] = regions_.size();
      region_numbers_.push_back(region);
      regions_.push_back(&cover.regions[region]);
      hulls_.push_back(hull(boxes, cover));
      free_.push_back(cover.boxes[boxes.front()].free);
    }
    sets_ = boost::disjoint_sets_with_storage<>(regions_.size());
    for (const ReductionStep& step : cover.reduction)
      if (const auto* taken = std::get_if<Elimination>(&step)) kept_[taken->variable] = false;
  }

  void link(solve::Control& control) {
    if (regions_.empty()) return;
    const BoxTree tree(regions_, regions_.front()->size());
    const UpwardRounding rounding;
    for (std::size_t r = 0; r < regions_.size() && !control.ended(); ++r) {
      link_over_faces(r, tree);
      control.report(r, 2 * regions_.size());
    }
    for (std::size_t r = 0; r < regions_.size() && !control.ended(); ++r) {
      link_where_they_overlap(r, tree);
      control.report(regions_.size() + r, 2 * regions_.size());
    }
  }

  void number(Components& result) {
    std::map<std::size_t, int> numbers;
    result.piece_of_box.assign(cover_.boxes.size(), -1);
    for (std::size_t i = 0; i < cover_.boxes.size(); ++i) {
      if (cover_.boxes[i].verdict != Verdict::regular) continue;
      const std::size_t set = sets_.find_set(index_.at(cover_.boxes[i].region));
      result.piece_of_box[i] = numbers.emplace(set, static_cast<int>(numbers.size())).first->second;
    }
    result.pieces = static_cast<int>(numbers.size());
    result.links = std::move(links_);
    result.bridges = std::move(bridges_);
  }

 private:
  // A point of the piece over the middle of a face of its free sides lies in some other box, whose region may hold it, too.
  void link_over_faces(std::size_t r, const BoxTree& tree) {
    for (const int face : free_[r])
      for (const bool upper : {false, true}) {
        Box at = *regions_[r];
        for (const int f : free_[r]) {
          const Interval& side = hulls_[r][f];
          at[f] = Interval(f != face ? side.mid() : upper ? side.hi() : side.lo());
        }
        const std::optional<certify::Sheet> point = test_.sheet_in(at, at);
        if (!point) continue;
        tree.for_each_overlapping(point->image, 0.0, [&](std::size_t s) {
          if (contains(*regions_[s], point->image) && sets_.find_set(r) != sets_.find_set(s)) join(r, s, *point);
        });
      }
  }

  void link_where_they_overlap(std::size_t r, const BoxTree& tree) {
    tree.for_each_overlapping(*regions_[r], 0.0, [&](std::size_t s) {
      if (s <= r || sets_.find_set(r) == sets_.find_set(s)) return;
      Box near = hulls_[r];
      for (std::size_t j = 0; j < near.size(); ++j)
        if (!near[j].intersect(hulls_[s][j])) near[j] = Interval::hull(hulls_[r][j], hulls_[s][j]);
      if (join_over(r, s, near) || join_over(s, r, near)) return;
      if (const auto point = test_.common(*regions_[r], *regions_[s], near)) {
        join(r, s, *point);
      } else {
        bridge(r, s, near);
      }
    });
  }

  // A point of the first piece over given values of its free variables. Where both regions end where they touch, it has
  // exactly the value at which they do: who solves for the other variables again, in other arithmetic, finds it in both.
  // Of variables that the reduction takes away, which are functions of the others, regions say nothing.
  bool join_over(std::size_t r, std::size_t s, const Box& near) {
    Box at = *regions_[r];
    for (std::size_t j = 0; j < at.size(); ++j)
      if (!kept_[j]) at[j] = Interval(at[j].lo() - compiled_.scales()[j], at[j].hi() + compiled_.scales()[j]);
    for (const int f : free_[r]) at[f] = Interval(near[f].mid());
    const std::optional<certify::Sheet> point = test_.sheet_in(at, near);
    if (!point) return false;
    for (std::size_t j = 0; j < at.size(); ++j)
      if (kept_[j] && !(*regions_[s])[j].contains(point->image[j])) return false;
    join(r, s, *point);
    return true;
  }

  // Where both regions end where they touch, a small piece about that place may meet both.
  // It has to stay in the domain: beyond it the set may join what it does not join inside.
  void bridge(std::size_t r, std::size_t s, const Box& near) {
    for (const double radius : {1e-2, 1e-4, 1e-6}) {
      const certify::Sheet piece = test_.sheet_about(near, radius);
      if (!piece.proven || !is_in_domain(piece.image)) continue;
      const auto first = test_.common(piece.region, *regions_[r], piece.region),
                 second = test_.common(piece.region, *regions_[s], piece.region);
      if (!first || !second) continue;
      sets_.union_set(r, s);
      const int number = static_cast<int>(cover_.regions.size() + bridges_.size());
      bridges_.push_back({all_but(piece.dependent, system_.size()), piece.region});
      links_.push_back(link(region_numbers_[r], number, *first));
      links_.push_back(link(region_numbers_[s], number, *second));
      return;
    }
  }

  bool is_in_domain(const Box& box) const {
    for (std::size_t j = 0; j < box.size(); ++j) {
      const Variable& v = system_.variables[j];
      if ((!v.lower_implied && !(box[j].lo() > v.domain.lo())) || (!v.upper_implied && !(box[j].hi() < v.domain.hi())))
        return false;
    }
    for (int row = compiled_.equations(); row < compiled_.rows(); ++row)
      if (!(compiled_.evaluate(row, box).lo() >= 0)) return false;
    return true;
  }

  SheetLink link(int a, int b, const certify::Sheet& point) const {
    return {a, b, all_but(point.dependent, system_.size()), midpoint(point.image)};
  }

  void join(std::size_t r, std::size_t s, const certify::Sheet& point) {
    sets_.union_set(r, s);
    links_.push_back(link(region_numbers_[r], region_numbers_[s], point));
  }

  const System& system_;
  const Cover& cover_;
  certify::CompiledSystem compiled_;
  certify::MeetingTest test_;
  std::vector<bool> kept_;           // of the variables, which the reduction does not take away
  std::vector<int> region_numbers_;  // in the cover
  std::vector<SheetLink> links_;
  std::vector<SheetBridge> bridges_;
  std::map<int, std::vector<int>> boxes_of_;  // of each region
  std::map<int, std::size_t> index_;          // of each region in the lists below
  std::vector<const Box*> regions_;
  std::vector<Box> hulls_;
  std::vector<std::vector<int>> free_;
  boost::disjoint_sets_with_storage<> sets_;
};

}  // namespace

Components components(const System& system, const Cover& cover, solve::Control& control) {
  Components result;
  if (cover.dimension == 0) {
    result.at_least =
        static_cast<int>(std::ranges::count_if(cover.points, [](const CoverBox& p) { return is_proven(p.verdict); }));
    result.pieces = result.at_least;
    result.piece_of_box.assign(cover.boxes.size(), -1);
    const auto undecided = std::ranges::count_if(cover.boxes, [](const CoverBox& b) { return !is_proven(b.verdict); });
    if (undecided > 0)  // along a set of larger dimension there are no points to list
      result.reason = "boxes that are not proven to hold one point";
    else if (std::cmp_equal(result.at_least, cover.points.size()) && cover.complete())
      result.at_most = result.at_least;
    else
      result.reason = "points that are not proven";
    return result;
  }
  Linker linker(system, cover);
  // Where there are more equations, or fewer, regions are not those of a square system's graphs.
  if (is_square_over(system, cover.dimension)) linker.link(control);
  linker.number(result);
  result.at_least = groups_with_solutions(system, cover, result.piece_of_box, control);
  const std::string others = other_boxes(cover);
  if (others.empty()) {
    result.at_most = result.pieces;
    if (!result.exact()) result.reason = "links or gaps between boxes that could not be shown";
  } else {
    result.reason = "boxes that are not regular: " + others;
  }
  return result;
}

}  // namespace corank::analyze
