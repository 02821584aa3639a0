#include "corank/check/pieces_bound.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <functional>
#include <iterator>
#include <map>
#include <set>

#include "corank/check/classes.h"
#include "corank/check/distinct.h"
#include "corank/check/growing_parts.h"
#include "corank/check/parallel.h"
#include "corank/check/piece_sheets.h"
#include "corank/check/sheets.h"
#include "corank/check/sign_parts.h"
#include "corank/core/box.h"

namespace corank::check {
namespace {

constexpr std::size_t kMostPieceCells = 400'000, kMostOpen = 3, kMostPairs = 20'000'000;

// Bit k: function k is positive.
using Mask = std::uint32_t;

struct PieceOf {
  Mask signs = 0;
  bool connected = false;              // else a passage
  SignParts::Directions directions{};  // of a passage
  bool grows = false;                  // likewise
};

struct CellOfPiece {
  std::size_t sheet = 0;
  FreeSides over;
  SignCell cell;
  Box hull;  // in doubles
  std::vector<PieceOf> parts;
};

class Bound {
 public:
  Bound(const Problem& whole, const Problem& reduced, const Cover& cover, const std::vector<Row>& functions,
        const PieceProof& proof, int threads)
      : whole_(whole),
        cover_(cover),
        proof_(proof),
        functions_(functions.size()),
        rows_(functions),
        sheets_(whole, reduced, cover, proof.bridges),
        arena_(threads) {
    for (const Condition& c : whole.conditions())
      if (whole.is_end(c)) rows_.push_back(c.row);
  }

  PieceBound run() {
    // What a step finds wrong is why nothing is confirmed.
    for (const auto& step :
         {&Bound::check_bridges, &Bound::check_cells, &Bound::examine_all, &Bound::check_cover, &Bound::divide_passages}) {
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
  void for_each(std::size_t n, const std::function<void(std::size_t)>& work) {
    if (!parallel(arena_, n, work)) throw Stopped{};
  }

  std::string check_bridges() {
    for (std::size_t k = 0; k < proof_.bridges.size(); ++k) {
      const SheetBridge& bridge = proof_.bridges[k];
      if (static_cast<int>(bridge.region.size()) != whole_.size() || bridge.free.empty())
        return "a sheet of its own has no box or no free variable";
      if (const std::string fault = sheets_.bridge_fault(k); !fault.empty())
        return "sheet " + std::to_string(k + 1) + " of its own: " + fault;
    }
    return "";
  }

  std::string check_cells() {
    if (proof_.cells.size() > kMostPieceCells) return "there are too many cells";
    cells_of_.resize(sheets_.size());
    for (const PieceCell& cell : proof_.cells) {
      if (cell.sheet < 0 || cell.sheet >= static_cast<int>(sheets_.size())) return "a cell does not belong to a sheet";
      const FreeSides over = sheets_.over(cell.sheet);
      if (cell.sides.size() != over.size()) return "a cell does not have one side for each free variable";
      if (!contains(over, cell.sides)) return "a cell is not within its sheet";
      cells_of_[cell.sheet].push_back(&cell.sides);
    }
    return "";
  }

  std::vector<SignParts::Direction> directions(std::size_t sheet) const {
    std::vector<double> widths;
    for (const Interval& side : sheets_.over(sheet)) widths.push_back(side.width());
    return SignParts::directions(widths);
  }

  // Is nothing of the cell in S? An end of the domain or an inequality says so.
  bool is_outside(const SignCell& cell) const {
    return std::any_of(cell.range.begin() + functions_, cell.range.end(),
                       [](const Enclosure& e) { return (-e).is_nonnegative(); });
  }

  // Of each function and each end.
  std::vector<int> list(Mask signs) const {
    std::vector<int> result(rows_.size(), 1);
    for (std::size_t k = 0; k < functions_; ++k) result[k] = (signs >> k & 1) != 0 ? 1 : -1;
    return result;
  }

  bool find_directions(PieceOf& part, const SignCell& cell, const std::vector<SignParts::Direction>& tried) const {
    const std::vector<int> signs = list(part.signs);
    part.directions = parts_.passages(cell, signs, tried);
    part.grows = part.directions.any() || parts_.grow_together(cell, cell.mixed, signs);
    return part.grows;
  }

  // False: a part of it is not known.
  bool find_parts(CellOfPiece& c) const {
    std::vector<std::size_t> open;
    for (const std::size_t k : c.cell.mixed)
      if (k < functions_) open.push_back(k);
    if (open.size() > kMostOpen) return false;
    const std::vector<SignParts::Direction> tried = directions(c.sheet);
    Mask known_signs = 0;
    for (std::size_t k = 0; k < functions_; ++k) known_signs |= Mask{c.cell.range[k].is_positive()} << k;
    for (Mask choice = 0; choice < Mask{1} << open.size(); ++choice) {
      PieceOf part{known_signs};
      for (std::size_t i = 0; i < open.size(); ++i) part.signs |= (choice >> i & 1) << open[i];
      const std::vector<int> signs = list(part.signs);
      const SignParts::Part known = parts_.part(c.cell, signs, tried);
      if (known == SignParts::Part::empty) continue;
      part.connected = known == SignParts::Part::connected;
      if (!part.connected && !find_directions(part, c.cell, tried)) return false;
      c.parts.push_back(part);
    }
    return true;
  }

  // Divides the cell further where need be; false: parts stay unknown.
  bool examine(std::size_t sheet, const FreeSides& over, int halvings, std::vector<CellOfPiece>& result) const {
    whole_.stop().poll();
    CellOfPiece c;
    c.sheet = sheet;
    c.over = over;
    c.cell = parts_.cell(sheets_.free(sheet), sheets_.start(sheet, over));
    if (!parts_.bound(c.cell, kSteps)) return false;
    if (is_outside(c.cell)) return true;
    bool found = find_parts(c);
    if (!found) {
      narrow(sheet, over, c.cell);
      if (!parts_.bound(c.cell, 1)) return false;
      if (is_outside(c.cell)) return true;
      c.parts.clear();
      found = find_parts(c);
    }
    if (found) {
      c.hull = Box(c.cell.sides.begin(), c.cell.sides.end());
      result.push_back(std::move(c));
      return true;
    }
    return halvings > 0 &&
           in_halves(sheet, over, [&](const FreeSides& half) { return examine(sheet, half, halvings - 1, result); });
  }

  template <class Visit>
  bool in_halves(std::size_t sheet, const FreeSides& over, const Visit& visit) const {
    const FreeSides all = sheets_.over(sheet);
    std::size_t along = over.size();
    double most = 0;
    for (std::size_t k = 0; k < over.size(); ++k)
      if (const double share = over[k].width() / all[k].width(); share > most) most = share, along = k;
    if (along == over.size()) return false;
    const double cut = over[along].mid();
    return is_within(over[along], cut) && in_two(over, along, cut, visit);
  }

  static bool is_within(const Interval& side, double cut) { return side.lo() < cut && cut < side.hi(); }

  template <class Visit>
  static bool in_two(const FreeSides& over, std::size_t along, double cut, const Visit& visit) {
    FreeSides part = over;
    part[along] = Interval(over[along].lo(), cut);
    if (!visit(part)) return false;
    part[along] = Interval(cut, over[along].hi());
    return visit(part);
  }

  std::string examine_all() {
    std::vector<std::vector<CellOfPiece>> found(proof_.cells.size());
    std::atomic<std::size_t> unknown = 0;
    for_each(found.size(), [&](std::size_t i) {
      const PieceCell& cell = proof_.cells[i];
      if (!examine(cell.sheet, cell.sides, kHalvings, found[i])) ++unknown;
    });
    for (std::vector<CellOfPiece>& list : found) std::move(list.begin(), list.end(), std::back_inserter(cells_));
    result_.cells = cells_.size();
    return unknown == 0 ? "" : std::to_string(unknown) + " cells have parts that are not known";
  }

  // Encloses the sheet's solutions over these sides anew, about the one over their middle, where steps of `bound` are of no
  // use since the sheet's region is wide. Theorem: what is found there in the region is the sheet's, which holds no other.
  void narrow(std::size_t sheet, const FreeSides& over, SignCell& cell) const {
    std::vector<double> point;
    for (const Enclosure& side : cell.sides) point.push_back(side.mid());
    std::string fault;
    Sides x = solution_near(whole_, point, sheets_.free(sheet), fault, over);
    if (fault.empty() && sheets_.holds(sheet, over, x)) cell.sides = std::move(x);
  }

  // Do all points of S on the sheet over these sides lie in cells of other sheets? `via`: over how many sheets, each of
  // which holds the points but leaves some of them to the next one.
  bool is_elsewhere(std::size_t sheet, const FreeSides& over, int halvings, int via) const {
    whole_.stop().poll();
    SignCell cell = parts_.cell(sheets_.free(sheet), sheets_.start(sheet, over));
    for (int step = 0; step < kSteps; ++step)
      if (!parts_.bound(cell, 1)) return false;
    if (is_outside(cell)) return true;
    if (halvings % 4 == 0 && halvings < kHalvingsElsewhere) {
      narrow(sheet, over, cell);
      if (!parts_.bound(cell, 1)) return false;
      if (is_outside(cell)) return true;
    }
    std::vector<std::pair<std::size_t, std::vector<FreeSides>>> left;
    for (std::size_t other = 0; other < sheets_.size(); ++other) {
      if (other == sheet || !sheets_.holds(other, sheets_.over(other), cell.sides)) continue;
      FreeSides there;
      for (const int f : sheets_.free(other)) there.emplace_back(cell.sides[f]);
      left.emplace_back(other, open_parts(there, cells_of_[other], whole_.stop()));
      if (left.back().second.empty()) return true;
    }
    for (const auto& [other, parts] : left)
      if (via > 1 && std::ranges::all_of(
                         parts, [&](const FreeSides& part) { return is_elsewhere(other, part, kHalvingsVia, via - 1); }))
        return true;
    return halvings > 0 && in_parts(sheet, over, cell.sides,
                                    [&](const FreeSides& part) { return is_elsewhere(sheet, part, halvings - 1, via); });
  }

  // Cut at an end of another sheet that the place goes across, where there is one: no halving comes to that. Else in halves.
  template <class Visit>
  bool in_parts(std::size_t sheet, const FreeSides& over, const Sides& at, const Visit& visit) const {
    const std::vector<int>& own = sheets_.free(sheet);
    for (std::size_t other = 0; other < sheets_.size(); ++other) {
      const std::vector<int>& free = sheets_.free(other);
      const FreeSides there = sheets_.over(other);
      bool meets = other != sheet;
      for (std::size_t f = 0; meets && f < free.size(); ++f) meets = at[free[f]].overlaps(there[f]);
      for (std::size_t f = 0; meets && f < free.size(); ++f)
        for (std::size_t k = 0; k < own.size(); ++k)
          for (const double cut : {there[f].lo(), there[f].hi()}) {
            if (own[k] == free[f] && is_within(over[k], cut)) return in_two(over, k, cut, visit);
          }
    }
    return in_halves(sheet, over, visit);
  }

  std::string check_cover() {
    std::atomic<std::size_t> left = 0;
    for_each(cover_.boxes.size(), [&](std::size_t b) {
      for (const FreeSides& part : open_parts(sheets_.over(b), cells_of_[b], whole_.stop()))
        if (!is_elsewhere(b, part, kHalvingsElsewhere, kVia)) ++left;
    });
    return left == 0 ? "" : "its cells are not shown to cover all sheets";
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
    const std::vector<int> signs = list(cells_[cluster.front().first].parts[cluster.front().second].signs);
    Cluster result;
    for (const std::size_t i : in_the_way(parts_, passages, signs)) result.push_back(cluster[i]);
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
                              find_directions(part, cells_[c].cell, directions(cells_[c].sheet));
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
        const auto examine_half = [&](const FreeSides& half) { return examine(cell.sheet, half, kHalvings, cells); };
        const std::size_t before = cells.size();
        if (open.contains(c) && in_halves(cell.sheet, cell.over, examine_half)) continue;
        cells.resize(before);
        cells.push_back(std::move(cell));
      }
      cells_ = std::move(cells);
      result_.cells = cells_.size();
      if (cells_.size() > kMostPieceCells) return "there are too many cells";
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
    for (std::size_t k = 0; k < result.size(); ++k)
      if (!result[k].intersect(cells_[d].over[k])) return std::nullopt;
    return result;
  }

  // Of a solution in S; nothing: a sign is not known, or it is not in S.
  std::optional<Mask> signs_of(const std::vector<Enclosure>& values) const {
    Mask signs = 0;
    for (std::size_t k = 0; k < values.size(); ++k) {
      if (k < functions_ ? values[k].has_zero() : !values[k].is_positive()) return std::nullopt;
      if (k < functions_ && values[k].is_positive()) signs |= Mask{1} << k;
    }
    return signs;
  }

  void join_by_links() {
    std::vector<Sides> solutions(proof_.links.size());
    for_each(solutions.size(), [&](std::size_t i) {
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
    for (const Row& row : rows_) values.push_back(row.value(x));
    const std::optional<Mask> signs = signs_of(values);
    if (!signs) return;
    std::vector<std::size_t> at;
    for (const std::size_t c : cells)
      for (std::size_t p = 0; p < cells_[c].parts.size(); ++p)
        if (cells_[c].parts[p].connected && cells_[c].parts[p].signs == *signs &&
            sheets_.holds(cells_[c].sheet, cells_[c].over, x))
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
        SignCell at = parts_.cell(sheets_.free(a.sheet), a.cell.sides);
        for (std::size_t k = 0; k < both->size(); ++k) {
          const Interval& side = (*both)[k];
          at.sides[(*at.free)[k]] = Enclosure(std::clamp(side.lo() + share * side.width(), side.lo(), side.hi()));
        }
        if (!parts_.bound(at, kSteps) || signs_of(at.range) != std::optional(a.parts[p].signs)) continue;
        classes_.unite(first_[c] + p, first_[d] + q);
        return;
      }
    });
  }

  static constexpr int kSteps = 3, kHalvings = 10, kHalvingsElsewhere = 16, kHalvingsVia = 2, kVia = 3;

  const Problem& whole_;
  const Cover& cover_;
  const PieceProof& proof_;
  std::size_t functions_;  // then come the ends
  std::vector<Row> rows_;
  PieceSheets sheets_;
  SignParts parts_{whole_, rows_};
  ThreadArena arena_;
  std::vector<std::vector<const FreeSides*>> cells_of_;  // of each sheet
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
