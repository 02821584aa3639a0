#include "corank/analyze/pieces/cell_parts.h"

#include <algorithm>

#include "corank/core/box.h"
#include "corank/core/rounding.h"
#include "corank/solve/step/problem.h"

namespace corank::analyze {
namespace {

constexpr int kFewestInRow = 4;

PieceLink link(const Box& point, const std::vector<int>& held) { return {midpoint(point), held}; }

}  // namespace

CellParts::CellParts(SignCells& cells, solve::Control& control)
    : cells_(cells), test_(cells.system()), control_(control), tree_(box_tree(cells.cells(), &SignCell::sides)) {
  add_parts();
  proven_ = boost::disjoint_sets_with_storage<>(parts_.size());
}

// Connected parts in cells of one sheet that have a point of X_F in common, and so a solution, of which one cell is a
// part by itself: they are of one piece.
template <class Visit>
void CellParts::for_each_pair_of_one_sheet(const Visit& visit) const {
  for_each_pair([&](std::size_t p, std::size_t q) {
    const SignCell &a = cell_of(p), &b = cell_of(q);
    if (parts_[p].kind != Kind::connected || parts_[q].kind != Kind::connected || a.box != b.box) return;
    if (!a.mixed.empty() && !b.mixed.empty()) return;
    if (std::ranges::all_of(a.free, [&](int f) { return a.sides[f].overlaps(b.sides[f]); })) visit(p, q);
  });
}

void CellParts::join() {
  for_each_pair_of_one_sheet([&](std::size_t p, std::size_t q) { proven_.union_set(p, q); });
  for (std::size_t c = 0; c < cells_.cells().size() && !control_.ended(); ++c) {
    join_over_border(c);
    control_.report(c, cells_.cells().size());
  }
  join_touching();
  join_at_ends();
}

void CellParts::add_parts() {
  const UpwardRounding rounding;
  part_of_.resize(cells_.cells().size());
  for (std::size_t c = 0; c < cells_.cells().size(); ++c) {
    const SignCell& cell = cells_.cells()[c];
    if (!cell.mixed.empty() && control_.ended()) {
      crowded_ = true;
      continue;
    }
    const std::vector<Signs> choices = cells_.choices(cell);
    crowded_ = crowded_ || choices.empty();
    for (const Signs& signs : choices) {
      int part = 0;
      if (cell.mixed.empty()) part = 1;
      if (cell.mixed.size() == 1) part = cells_.part_of_one(cell, signs[cell.mixed.front()]);
      if (part == 0) part = cells_.part_by_outflow(cell, signs);
      if (part < 0) continue;
      part_of_[c].emplace(signs, parts_.size());
      parts_.push_back({c, signs, part > 0 ? Kind::connected : cell.resolved ? Kind::passage : Kind::unknown, part > 0});
    }
  }
}

bool CellParts::is_in(const Box& point, std::size_t c) const {
  const SignCell& cell = cells_.cells()[c];
  return contains(cells_.region(cell), point) && contains_over(cell.free, cell.sides, point);
}

// By roundings.
Box CellParts::widened(Box box) const {
  constexpr double kRounding = 1e-9;
  for (std::size_t j = 0; j < box.size(); ++j)
    box[j] += Interval(-kRounding, kRounding) * Interval(cells_.system().variables[j].size);
  return box;
}

// All parts that hold the point, a solution over values of the variables `held`, are of one piece. Those of cells that end
// there, but for rounding, may be.
void CellParts::join_at(const Box& point, const std::vector<int>& held) {
  const Signs signs = cells_.signs(point);
  if (std::ranges::find(signs, 0) != signs.end()) return;
  std::optional<std::size_t> first;
  std::vector<std::size_t> near;
  tree_.for_each_overlapping(widened(point), 0, [&](std::size_t c) {
    const auto part = part_of_[c].find(signs);
    if (part == part_of_[c].end()) return;
    Part& p = parts_[part->second];
    const bool inside = is_in(point, c);
    if (inside) p.holds_solution = true;
    if (inside && !p.solution) p.solution = point, p.held = held;
    if (p.kind != Kind::connected) return;
    if (!inside) {
      near.push_back(part->second);
      return;
    }
    if (first && proven_.find_set(*first) != proven_.find_set(part->second)) {
      proven_.union_set(*first, part->second);
      joined_.push_back({*first, part->second, {link(point, held)}, {}});
    }
    first = part->second;
  });
  if (!first) return;
  for (const std::size_t q : near)
    if (proven_.find_set(*first) != proven_.find_set(q)) ends_.push_back({*first, q, point});
}

// Points on the border of X_F: the middles of its faces and, where a function is mixed, its corners and a row of points
// on each face.
void CellParts::join_over_border(std::size_t c) {
  const UpwardRounding rounding;
  const SignCell& cell = cells_.cells()[c];
  const std::vector<int>& frees = cell.free;
  std::vector<double> along{0.5};
  if (!cell.mixed.empty() && frees.size() > 1) along = {0.5, 0, 0.02, 0.1, 0.3, 0.7, 0.9, 0.98, 1};
  Box at = cell.sides;
  for (std::size_t face = 0; face < frees.size(); ++face)
    for (const bool upper : {false, true}) {
      if (cell.mixed.empty()) {
        Box border = cell.sides;
        Interval& side = border[frees[face]];
        side = Interval(upper ? side.hi() : side.lo());
        if (is_joined_over(c, border)) continue;
      }
      for (const double share : along) {
        for (std::size_t f = 0; f < frees.size(); ++f) {
          const Interval& side = cell.sides[frees[f]];
          const double inside = std::clamp(side.lo() + share * (side.hi() - side.lo()), side.lo(), side.hi());
          at[frees[f]] = Interval(f != face ? inside : upper ? side.hi() : side.lo());
        }
        join_at(cells_.solution_over(cell, at), frees);
      }
    }
}

// Where two cells end at one point, a small piece about it may meet both.
void CellParts::join_at_ends() {
  constexpr int kTries = 8;  // for two pieces
  const UpwardRounding rounding;
  std::map<std::pair<std::size_t, std::size_t>, int> tries;
  for (const End& end : ends_) {
    const std::size_t a = proven_.find_set(end.part), b = proven_.find_set(end.other);
    if (a == b || control_.ended() || ++tries[std::minmax(a, b)] > kTries) continue;
    for (const double radius : {1e-3, 1e-5, 1e-7}) {
      const certify::Sheet piece = test_.sheet_about(end.point, radius);
      if (!piece.proven || cells_.signs(piece.region) != parts_[end.part].signs) continue;
      const std::optional<PieceLink> here = meeting(piece.region, cell_of(end.part));
      const std::optional<PieceLink> there = meeting(piece.region, cell_of(end.other));
      if (!here || !there) continue;
      proven_.union_set(end.part, end.other);
      joined_.push_back({end.part, end.other, {*here, *there}, {SheetBridge{free_of(piece), piece.region}}});
      break;
    }
  }
}

// Connected parts of like signs that touch and are not joined yet: points of the one's X_F next to the other, more and
// more of them.
void CellParts::join_touching() {
  constexpr int kRows = 4;
  for (int row = 0; row < kRows; ++row)
    for_each_pair([&](std::size_t p, std::size_t q) {
      if (parts_[p].kind != Kind::connected || parts_[q].kind != Kind::connected) return;
      const UpwardRounding rounding;
      for (const auto& [from, to] : {std::pair(p, q), std::pair(q, p)})
        if (proven_.find_set(p) != proven_.find_set(q))
          join_next_to(parts_[from].cell, parts_[to].cell, kFewestInRow << row);
    });
}

// At `count` + 1 points along each free side that the cells share, those on the other free sides' ends and middles. Half
// of the points were tried with half of the count.
void CellParts::join_next_to(std::size_t c, std::size_t d, int count) {
  const SignCell& cell = cells_.cells()[c];
  Box near = cell.sides, at = cell.sides;
  if (!intersect(near, cells_.cells()[d].sides)) return;
  std::vector<int> shared;  // where the cells have more in common than a point
  for (const int f : cell.free)
    if (near[f].width() > 0) shared.push_back(f);
  const auto join_over = [&](int along, double share, double others) {
    for (const int f : cell.free)
      at[f] =
          Interval(std::clamp(near[f].lo() + (f == along ? share : others) * near[f].width(), near[f].lo(), near[f].hi()));
    join_at(cells_.solution_over(cell, at), cell.free);
  };
  const bool first = count == kFewestInRow;
  if (shared.empty() && first) join_over(-1, 0, 0);
  for (const int along : shared)
    for (int k = first ? 0 : 1; k <= count; k += first ? 1 : 2)
      for (const double others : {0.0, 0.5, 1.0}) {
        join_over(along, static_cast<double>(k) / count, others);
        if (shared.size() == 1) break;
      }
}

bool CellParts::join_by_climbs(const std::map<std::size_t, std::vector<std::size_t>>& classes) {
  const UpwardRounding rounding;
  bool joined = false;
  std::map<Signs, std::size_t> largest;
  for (const auto& [root, parts] : classes) {
    const auto [place, fresh] = largest.emplace(parts_[root].signs, root);
    if (!fresh && classes.at(place->second).size() < parts.size()) place->second = root;
  }
  Climber climber(cells_);
  for (const auto& [root, parts] : classes) {
    if (largest[parts_[root].signs] == root) continue;
    for (const std::size_t p : parts)
      if (control_.ended() || climb_from(p, climber)) break;
    joined = joined || proven_.find_set(root) == proven_.find_set(largest[parts_[root].signs]);
  }
  return joined;
}

// A solution in the part, if possible within the cell: over the middle of X_F, or towards its corners.
std::optional<Box> CellParts::solution_of(const Part& part) {
  const SignCell& cell = cells_.cells()[part.cell];
  constexpr double kMiddle = 0.5;  // is the same towards each corner
  for (const double inset : {kMiddle, 0.1, 0.02, 0.004, 0.0})
    for (std::size_t corner = 0; corner < (inset == kMiddle ? 1 : std::size_t{1} << cell.free.size()); ++corner) {
      Box at = cell.sides;
      for (std::size_t f = 0; f < cell.free.size(); ++f) {
        const Interval& side = cell.sides[cell.free[f]];
        const double share = (corner >> f & 1) != 0 ? 1 - inset : inset;
        at[cell.free[f]] = Interval(std::clamp(side.lo() + share * side.width(), side.lo(), side.hi()));
      }
      Box solution = cells_.solution_over(cell, std::move(at));
      if (cells_.signs(solution) == part.signs) return solution;
    }
  return part.solution;
}

bool CellParts::climb_from(std::size_t p, Climber& climber) {
  const SignCell& cell = cell_of(p);
  const std::optional<Box> start = solution_of(parts_[p]);
  if (!start) return false;
  Box from = cells_.region(cell);
  for (const int f : cell.free) from[f] = cell.sides[f];
  std::optional<std::size_t> other;
  const auto arrived = [&](const SheetBridge& sheet) {
    std::optional<PieceLink> last;
    tree_.for_each_overlapping(sheet.region, 0, [&](std::size_t d) {
      const auto part = part_of_[d].find(parts_[p].signs);
      if (last || part == part_of_[d].end() || parts_[part->second].kind != Kind::connected ||
          !cells_.cells()[d].mixed.empty() || proven_.find_set(part->second) == proven_.find_set(p))
        return;
      last = meeting(sheet.region, cells_.cells()[d]);
      if (last) other = part->second;
    });
    return last;
  };
  std::optional<Climb> way = climber.climb(from, midpoint(*start), parts_[p].signs, arrived);
  if (!way) return false;
  proven_.union_set(p, *other);
  joined_.push_back({p, *other, std::move(way->links), std::move(way->sheets)});
  return true;
}

// A solution that is proven to be in the piece and in the cell.
std::optional<PieceLink> CellParts::meeting(const Box& piece, const SignCell& cell) {
  Box common = cells_.region(cell);
  for (const int f : cell.free) common[f] = cell.sides[f];
  if (!intersect(common, piece)) return std::nullopt;
  const std::optional<certify::Sheet> at = test_.sheet_in(common, common);
  return at ? std::optional(link(at->image, free_of(*at))) : std::nullopt;
}

std::vector<int> CellParts::free_of(const certify::Sheet& sheet) const {
  return all_but(sheet.dependent, cells_.system().size());
}

// Of the links those that join what cells of one sheet do not join by themselves: where one of two that meet is all of one
// part, no solution needs to be named.
PieceProof CellParts::proof() {
  PieceProof result;
  const auto sides = [&](const std::vector<int>& free, const Box& box) {
    std::vector<Interval> list;
    for (const int f : free) list.push_back(box[f]);
    return list;
  };
  const std::vector<CoverBox>& boxes = cells_.cover().boxes;
  for (std::size_t b = cells_.given(); b < boxes.size(); ++b)
    result.bridges.push_back({boxes[b].free, cells_.cover().regions[boxes[b].region]});
  for (const SignCell& cell : cells_.cells()) result.cells.push_back({cell.box, sides(cell.free, cell.sides)});
  boost::disjoint_sets_with_storage<> known(parts_.size());
  for_each_pair_of_one_sheet([&](std::size_t p, std::size_t q) { known.union_set(p, q); });
  for (const Joined& joined : joined_) {
    if (known.find_set(joined.part) == known.find_set(joined.other)) continue;
    known.union_set(joined.part, joined.other);
    result.links.insert(result.links.end(), joined.links.begin(), joined.links.end());
    for (const SheetBridge& bridge : joined.bridges) {
      result.cells.push_back({static_cast<int>(cells_.given() + result.bridges.size()), sides(bridge.free, bridge.region)});
      result.bridges.push_back(bridge);
    }
  }
  return result;
}

// Of a cell without mixed functions: are all connected parts that the box touches, and that its own may be joined with,
// joined with it?
bool CellParts::is_joined_over(std::size_t c, const Box& box) {
  const auto& [signs, part] = *part_of_[c].begin();
  const std::size_t own = proven_.find_set(part);
  bool joined = true;
  tree_.for_each_overlapping(widened(box), 0, [&](std::size_t d) {
    const auto other = part_of_[d].find(signs);
    joined = joined && (other == part_of_[d].end() || parts_[other->second].kind != Kind::connected ||
                        proven_.find_set(other->second) == own);
  });
  return joined;
}

}  // namespace corank::analyze
