#include "corank/analyze/pieces/pieces.h"

#include <algorithm>
#include <map>

#include "corank/analyze/pieces/cell_parts.h"
#include "corank/core/rounding.h"
#include "corank/symbolic/model/expression_words.h"

namespace corank::analyze {
namespace {

// Bounds of the number of pieces that the parts of cells make.
class PieceCounter {
 public:
  PieceCounter(SignCells& cells, solve::Control& control) : parts_(cells, control), control_(control) {}

  Pieces count() {
    Pieces result;
    result.cells = parts_.cells().cells().size();
    if (result.cells == 0) {
      result.at_most = 0;
      return result;
    }
    parts_.join();
    upper_bound(result);
    lower_bound(result);
    if (result.at_most && !result.exact() && join_by_climbs()) upper_bound(result);
    if (result.exact()) result.reason.clear();
    result.proof = parts_.proof();
    return result;
  }

 private:
  // Those that count, with their members.
  std::map<std::size_t, std::vector<std::size_t>> classes(const std::vector<bool>& passes) {
    std::map<std::size_t, std::vector<std::size_t>> result;
    for (std::size_t p = 0; p < parts_.size(); ++p)
      if (!passes[p]) result[parts_.class_of(p)].push_back(p);
    return result;
  }

  bool join_by_climbs() {
    bool hidden = false;
    return parts_.join_by_climbs(classes(passages(hidden)));
  }

  // Which parts are passages, in as large classes as add no piece: those that are nothing else, and those of a class of
  // connected parts that is joined to no cell without mixed functions, such as a corner that no link was found to.
  // `hidden`: a piece may lie in some that are nothing else.
  std::vector<bool> passages(bool& hidden) {
    std::vector<bool> result;
    std::map<std::size_t, bool> passes;  // of each class of connected parts
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      result.push_back(parts_[p].kind == CellParts::Kind::passage);
      if (parts_[p].kind != CellParts::Kind::connected) continue;
      bool& all = passes.emplace(parts_.class_of(p), true).first->second;
      all = all && !parts_.cell_of(p).mixed.empty() && parts_.cells().is_passage(parts_[p].cell);
    }
    for (bool found = true; found;) {
      for (std::size_t p = 0; p < parts_.size(); ++p)
        if (parts_[p].kind == CellParts::Kind::connected) result[p] = passes.at(parts_.class_of(p));
      found = hidden = false;
      for (const std::vector<std::size_t>& cluster : clusters(result)) {
        const std::vector<std::size_t> open = in_the_way(cluster);
        hidden = hidden || !open.empty();
        const auto is_connected = [&](std::size_t p) { return parts_[p].kind == CellParts::Kind::connected; };
        const bool any = std::ranges::any_of(open, is_connected);
        for (const std::size_t p : any || open.empty() ? open : cluster)
          if (is_connected(p)) found = true, passes[parts_.class_of(p)] = false;
      }
    }
    return result;
  }

  // Passages that touch: a piece may hide in them together.
  std::vector<std::vector<std::size_t>> clusters(const std::vector<bool>& passes) {
    boost::disjoint_sets_with_storage<> joined(parts_.size());
    parts_.for_each_pair([&](std::size_t p, std::size_t q) {
      if (passes[p] && passes[q]) joined.union_set(p, q);
    });
    std::map<std::size_t, std::vector<std::size_t>> members;
    for (std::size_t p = 0; p < parts_.size(); ++p)
      if (passes[p]) members[joined.find_set(p)].push_back(p);
    std::vector<std::vector<std::size_t>> result;
    for (auto& [root, list] : members) result.push_back(std::move(list));
    return result;
  }

  // Members that stand in the way of a proof that no piece lies in the cluster alone.
  std::vector<std::size_t> in_the_way(const std::vector<std::size_t>& cluster) const {
    std::map<std::size_t, std::size_t> part_in;
    std::vector<std::size_t> cells, result;
    for (const std::size_t p : cluster) part_in.emplace(parts_[p].cell, p), cells.push_back(parts_[p].cell);
    for (const std::size_t c : parts_.cells().hiding_places(cells, parts_[cluster.front()].signs))
      result.push_back(part_in.at(c));
    return result;
  }

  void upper_bound(Pieces& result) {
    const bool ended = control_.ended();
    const auto unresolved =
        std::ranges::count_if(parts_.cells().cells(), [](const SignCell& cell) { return !cell.resolved; });
    if (unresolved > 0) {
      result.reason = symbolic::counted(unresolved, "cell") + " next to singularities that are not resolved";
      return;
    }
    bool hidden = false;
    const std::vector<bool> passes = passages(hidden);
    hidden = hidden || ended;
    const auto found = classes(passes);
    if (!hidden) result.at_most = static_cast<int>(found.size());
    if (hidden) result.reason = "cells about a crossing of singularity loci in which a piece might hide";
  }

  void lower_bound(Pieces& result) {
    boost::disjoint_sets_with_storage<> classes(parts_.size());
    std::map<std::size_t, std::size_t> first;
    for (std::size_t p = 0; p < parts_.size(); ++p) classes.union_set(p, first.emplace(parts_.class_of(p), p).first->second);
    parts_.for_each_pair([&](std::size_t p, std::size_t q) { classes.union_set(p, q); });
    std::map<std::size_t, std::size_t> known;  // a part of each class, one without mixed functions where there is one
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      if (!parts_[p].holds_solution) continue;
      const auto [place, fresh] = known.emplace(classes.find_set(p), p);
      if (!fresh && parts_.cell_of(p).mixed.size() < parts_.cell_of(place->second).mixed.size()) place->second = p;
    }
    if (control_.ended() || parts_.crowded()) {
      // What was not joined yet may be one piece: one of them is shown.
      if (control_.ended()) result.reason = "the analysis was ended by a limit";
      if (control_.ended() && known.size() > 1) known.erase(std::next(known.begin()), known.end());
      result.at_least = known.empty() ? 0 : 1;
    } else {
      result.at_least = static_cast<int>(known.size());
    }
    if (result.at_most && !result.exact()) result.reason = "links or gaps between cells that could not be shown";
    const UpwardRounding rounding;
    std::map<std::size_t, int> numbers;
    for (const auto& [root, p] : known) numbers.emplace(root, static_cast<int>(numbers.size()));
    for (std::size_t p = 0; p < parts_.size(); ++p)
      if (const auto n = numbers.find(classes.find_set(p)); n != numbers.end())
        result.parts.push_back({parts_[p].cell, parts_[p].signs, n->second});
    for (const auto& [root, p] : known) {
      const SignCell& cell = parts_.cell_of(p);
      const std::optional<Box> point =
          cell.mixed.empty() ? parts_.cells().solution_over_middle(cell, cell.sides) : parts_[p].solution;
      result.representatives.push_back(point.value_or(cell.sides));
      result.free.push_back(cell.mixed.empty() || !parts_[p].solution ? cell.free : parts_[p].held);
      result.signs.emplace_back(parts_[p].signs.begin(), parts_[p].signs.end() - parts_.cells().limits());
    }
  }

  CellParts parts_;
  solve::Control& control_;
};

}  // namespace

Pieces pieces(SignCells& cells, solve::Control& control) { return PieceCounter(cells, control).count(); }

}  // namespace corank::analyze
