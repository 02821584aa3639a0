#include "corank/check/pieces_bound.h"

#include <algorithm>
#include <map>
#include <set>

#include "corank/check/classes.h"
#include "corank/check/distinct.h"
#include "corank/check/growing_parts.h"
#include "corank/check/piece_cells.h"
#include "corank/check/sheets.h"
#include "corank/core/box.h"

namespace corank::check {
namespace {

constexpr std::size_t kMostPairs = 20'000'000;

class Bound {
 public:
  Bound(const Problem& whole, const Problem& reduced, const Cover& cover, const std::vector<Row>& functions,
        const PieceProof& proof, int threads)
      : pieces_(whole, reduced, cover, functions, proof, threads), whole_(whole), proof_(proof) {}

  PieceBound run() {
    // What a step finds wrong is why nothing is confirmed.
    for (const auto& step : {&Bound::find_cells, &Bound::divide_passages}) {
      result_.reason = (this->*step)();
      if (!result_.reason.empty()) return std::move(result_);
    }
    join_whole_cells();
    join_by_links();
    join_along_borders();
    result_.reason = check_passages();
    if (!result_.reason.empty()) return std::move(result_);
    std::set<std::size_t> classes;
    for (std::size_t c = 0; c < cells_.size(); ++c)
      for (std::size_t p = 0; p < cells_[c].parts.size(); ++p)
        if (cells_[c].parts[p].connected) classes.insert(classes_.of(first_[c] + p));
    result_.at_most = static_cast<int>(classes.size());
    return std::move(result_);
  }

 private:
  std::string find_cells() {
    std::string fault = pieces_.examine_all(cells_);
    result_.cells = cells_.size();
    return fault;
  }

  std::string number_parts() {
    std::size_t parts = 0;
    std::vector<const Box*> hulls;
    first_.clear();
    for (const CellOfPiece& c : cells_) {
      first_.push_back(parts);
      parts += c.parts.size();
      hulls.push_back(&c.hull);
    }
    classes_ = Classes(parts);
    touching_ = meeting_pairs(
        hulls, [this](std::size_t, std::size_t) { return whole_.stop().poll(), false; }, kMostPairs);
    return touching_.size() < kMostPairs ? "" : "too many cells touch";
  }

  // Calls visit(c, p, d, q) for parts of like signs in cells c and d whose boxes touch.
  template <class Visit>
  void for_each_pair(const Visit& visit) const {
    for (const auto& [c, d] : touching_) {
      whole_.stop().poll();
      for (std::size_t p = 0; p < cells_[c].parts.size(); ++p)
        for (std::size_t q = 0; q < cells_[d].parts.size(); ++q)
          if (cells_[c].parts[p].signs == cells_[d].parts[q].signs) visit(c, p, d, q);
    }
  }

  // Parts that hang together and are passages, each by the numbers of its cell and of the part in the cell.
  using Cluster = std::vector<std::pair<std::size_t, std::size_t>>;
  std::vector<Cluster> clusters() const {
    Classes together(cells_.empty() ? 0 : first_.back() + cells_.back().parts.size());
    for_each_pair([&](std::size_t c, std::size_t p, std::size_t d, std::size_t q) {
      if (!cells_[c].parts[p].connected && !cells_[d].parts[q].connected) together.unite(first_[c] + p, first_[d] + q);
    });
    std::map<std::size_t, Cluster> members;
    for (std::size_t c = 0; c < cells_.size(); ++c)
      for (std::size_t p = 0; p < cells_[c].parts.size(); ++p)
        if (!cells_[c].parts[p].connected) members[together.of(first_[c] + p)].emplace_back(c, p);
    std::vector<Cluster> result;
    for (auto& [root, cluster] : members) result.push_back(std::move(cluster));
    return result;
  }

  // Members that stand in the way of a proof that no piece lies in the cluster alone.
  Cluster in_the_way_of(const Cluster& cluster) const {
    std::vector<GrowingPart> passages;
    for (const auto& [c, p] : cluster)
      passages.push_back({&cells_[c].cell, cells_[c].sheet, cells_[c].parts[p].directions, cells_[c].parts[p].grows});
    const std::vector<int> signs = pieces_.list(cells_[cluster.front().first].parts[cluster.front().second].signs);
    Cluster result;
    for (const std::size_t i : in_the_way(pieces_.parts(), passages, signs)) result.push_back(cluster[i]);
    return result;
  }

  // Connected parts of a class without a cell that is all of one part, such as the finder takes for passages, are passages,
  // too, where they have directions; but for those with which a cluster might hide a piece.
  std::string check_passages() {
    std::map<std::size_t, Cluster> small;
    std::set<std::size_t> large;
    for (std::size_t c = 0; c < cells_.size(); ++c)
      for (std::size_t p = 0; p < cells_[c].parts.size(); ++p) {
        PieceOf& part = cells_[c].parts[p];
        if (!part.connected) continue;
        const std::size_t own = classes_.of(first_[c] + p);
        const bool may_pass = !large.contains(own) && !cells_[c].cell.mixed.empty() &&
                              pieces_.find_directions(part, cells_[c].cell, cells_[c].sheet);
        if (may_pass)
          small[own].emplace_back(c, p);
        else
          large.insert(own);
      }
    const auto set_connected = [&](std::size_t own, bool connected) {
      for (const auto& [c, p] : small.at(own)) cells_[c].parts[p].connected = connected;
    };
    std::erase_if(small, [&](const auto& entry) { return large.contains(entry.first); });
    for (const auto& [own, cluster] : small) set_connected(own, false);
    for (;;) {
      bool changed = false;
      for (const Cluster& cluster : clusters()) {
        whole_.stop().poll();
        if (in_the_way_of(cluster).empty()) continue;
        bool had_connected = false;
        for (const auto& [c, p] : cluster) {
          const std::size_t own = classes_.of(first_[c] + p);
          if (small.contains(own)) set_connected(own, true), small.erase(own);
          had_connected = had_connected || cells_[c].parts[p].connected;
        }
        if (!had_connected) return "a piece might hide in cells about a crossing";
        changed = true;
      }
      if (!changed) return "";
    }
  }

  // Divides cells in which passages stand in the way of each other, so many times at most.
  std::string divide_passages() {
    constexpr int kRounds = 8;
    for (int round = 0;; ++round) {
      if (const std::string fault = number_parts(); !fault.empty()) return fault;
      std::set<std::size_t> open;
      for (const Cluster& cluster : clusters())
        for (const auto& [c, p] : in_the_way_of(cluster)) open.insert(c);
      if (open.empty() || round == kRounds) return "";
      std::vector<CellOfPiece> cells;
      for (std::size_t c = 0; c < cells_.size(); ++c) {
        CellOfPiece& cell = cells_[c];
        const std::size_t before = cells.size();
        if (open.contains(c) && pieces_.examine_halves(cell, cells)) continue;
        cells.resize(before);
        cells.push_back(std::move(cell));
      }
      cells_ = std::move(cells);
      result_.cells = cells_.size();
      if (cells_.size() > PieceCells::kMost) return "there are too many cells";
    }
  }

  void join_whole_cells() {
    for_each_pair([&](std::size_t c, std::size_t p, std::size_t d, std::size_t q) {
      if (cells_[c].sheet != cells_[d].sheet || !cells_[c].parts[p].connected || !cells_[d].parts[q].connected) return;
      if ((cells_[c].cell.mixed.empty() || cells_[d].cell.mixed.empty()) && common(c, d))
        classes_.unite(first_[c] + p, first_[d] + q);
    });
  }

  std::optional<FreeSides> common(std::size_t c, std::size_t d) const {
    FreeSides result = cells_[c].over;
    return intersect(result, cells_[d].over) ? std::optional(result) : std::nullopt;
  }

  // Of a solution in S; nothing: a sign is not known, or it is not in S.
  std::optional<std::uint32_t> signs_of(const std::vector<Enclosure>& values) const {
    std::uint32_t signs = 0;
    for (std::size_t k = 0; k < values.size(); ++k) {
      if (k < pieces_.functions() ? values[k].has_zero() : !values[k].is_positive()) return std::nullopt;
      if (k < pieces_.functions() && values[k].is_positive()) signs |= std::uint32_t{1} << k;
    }
    return signs;
  }

  void join_by_links() {
    std::vector<Sides> solutions(proof_.links.size());
    pieces_.for_each(solutions.size(), [&](std::size_t i) {
      std::string fault;
      Sides x = solution_near(whole_, proof_.links[i].point, proof_.links[i].held, fault);
      if (fault.empty()) solutions[i] = std::move(x);
    });
    std::vector<Box> near(solutions.size());
    std::vector<const Box*> boxes;
    for (const CellOfPiece& c : cells_) boxes.push_back(&c.hull);
    std::vector<std::size_t> link_of;
    for (std::size_t i = 0; i < solutions.size(); ++i) {
      if (solutions[i].empty()) continue;
      near[i] = Box(solutions[i].begin(), solutions[i].end());
      boxes.push_back(&near[i]);
      link_of.push_back(i);
    }
    std::vector<std::vector<std::size_t>> cells_at(solutions.size());
    const auto note = [&](std::size_t a, std::size_t b) {
      whole_.stop().poll();
      if (const auto [cell, link] = std::minmax(a, b); cell < cells_.size() && link >= cells_.size())
        cells_at[link_of[link - cells_.size()]].push_back(cell);
      return true;
    };
    meeting_pairs(boxes, note, 1);
    for (std::size_t i = 0; i < solutions.size(); ++i) join_at(solutions[i], cells_at[i]);
  }

  void join_at(const Sides& x, const std::vector<std::size_t>& cells) {
    if (cells.empty()) return;
    std::vector<Enclosure> values;
    for (const Row& row : pieces_.rows()) values.push_back(row.value(x));
    const std::optional<std::uint32_t> signs = signs_of(values);
    if (!signs) return;
    std::vector<std::size_t> at;
    for (const std::size_t c : cells)
      for (std::size_t p = 0; p < cells_[c].parts.size(); ++p)
        if (cells_[c].parts[p].connected && cells_[c].parts[p].signs == *signs &&
            pieces_.sheets().holds(cells_[c].sheet, cells_[c].over, x))
          at.push_back(first_[c] + p);
    for (const std::size_t part : at) classes_.unite(at.front(), part);
    result_.links += at.size() > 1;
  }

  // Cells of one sheet that meet: the sheet's solutions over some points that they have in common.
  void join_along_borders() {
    for_each_pair([&](std::size_t c, std::size_t p, std::size_t d, std::size_t q) {
      const CellOfPiece &a = cells_[c], &b = cells_[d];
      if (a.sheet != b.sheet || !a.parts[p].connected || !b.parts[q].connected) return;
      if (classes_.of(first_[c] + p) == classes_.of(first_[d] + q)) return;
      const auto both = common(c, d);
      if (!both) return;
      for (const double share : {0.5, 0.0, 1.0, 0.1, 0.9, 0.3, 0.7, 0.02, 0.98}) {
        SignCell at = pieces_.parts().cell(pieces_.sheets().free(a.sheet), a.cell.sides);
        for (std::size_t k = 0; k < both->size(); ++k) {
          const Interval& side = (*both)[k];
          at.sides[(*at.free)[k]] = Enclosure(std::clamp(side.lo() + share * side.width(), side.lo(), side.hi()));
        }
        if (!pieces_.parts().bound(at, PieceCells::kSteps) || signs_of(at.range) != std::optional(a.parts[p].signs))
          continue;
        classes_.unite(first_[c] + p, first_[d] + q);
        return;
      }
    });
  }

  PieceCells pieces_;
  const Problem& whole_;
  const PieceProof& proof_;
  std::vector<CellOfPiece> cells_;
  std::vector<std::size_t> first_;  // of each cell the number of its first part
  std::vector<std::pair<std::size_t, std::size_t>> touching_;
  Classes classes_{0};
  PieceBound result_;
};

}  // namespace

PieceBound bound_pieces(const Problem& whole, const Problem& reduced, const Cover& cover, const std::vector<Row>& functions,
                        const PieceProof& proof, int threads) {
  return Bound(whole, reduced, cover, functions, proof, threads).run();
}

}  // namespace corank::check
