#include "corank/check/piece_cells.h"

#include <algorithm>
#include <atomic>
#include <iterator>
#include <utility>

#include "corank/check/sheets.h"
#include "corank/core/box.h"

namespace corank::check {
namespace {

constexpr std::size_t kMostOpen = 3;
constexpr int kHalvings = 10, kHalvingsElsewhere = 16, kHalvingsVia = 2, kVia = 3;

bool is_within(const Interval& side, double cut) { return side.lo() < cut && cut < side.hi(); }

template <class Visit>
bool in_two(const FreeSides& over, std::size_t along, double cut, const Visit& visit) {
  FreeSides part = over;
  part[along] = Interval(over[along].lo(), cut);
  if (!visit(part)) return false;
  part[along] = Interval(cut, over[along].hi());
  return visit(part);
}

// `all`: the sheet's sides.
template <class Visit>
bool in_halves(const FreeSides& all, const FreeSides& over, const Visit& visit) {
  std::size_t along = over.size();
  double most = 0;
  for (std::size_t k = 0; k < over.size(); ++k)
    if (const double share = over[k].width() / all[k].width(); share > most) most = share, along = k;
  if (along == over.size()) return false;
  const double cut = over[along].mid();
  return is_within(over[along], cut) && in_two(over, along, cut, visit);
}

}  // namespace

PieceCells::PieceCells(const Problem& whole, const Problem& reduced, const Cover& cover, const std::vector<Row>& functions,
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

void PieceCells::for_each(std::size_t n, const std::function<void(std::size_t)>& work) {
  if (!parallel(arena_, n, work)) throw Stopped{};
}

std::string PieceCells::check_bridges() {
  for (std::size_t k = 0; k < proof_.bridges.size(); ++k) {
    const SheetBridge& bridge = proof_.bridges[k];
    if (static_cast<int>(bridge.region.size()) != whole_.size() || bridge.free.empty())
      return "a sheet of its own has no box or no free variable";
    if (const std::string fault = sheets_.bridge_fault(k); !fault.empty())
      return "sheet " + std::to_string(k + 1) + " of its own: " + fault;
  }
  return "";
}

std::string PieceCells::check_cells() {
  if (proof_.cells.size() > kMost) return "there are too many cells";
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

std::vector<SignParts::Direction> PieceCells::directions(std::size_t sheet) const {
  std::vector<double> widths;
  for (const Interval& side : sheets_.over(sheet)) widths.push_back(side.width());
  return SignParts::directions(widths);
}

// Is nothing of the cell in S? An end of the domain or an inequality says so.
bool PieceCells::is_outside(const SignCell& cell) const {
  return std::any_of(cell.range.begin() + functions_, cell.range.end(),
                     [](const Enclosure& e) { return (-e).is_nonnegative(); });
}

std::vector<int> PieceCells::list(std::uint32_t signs) const {
  std::vector<int> result(rows_.size(), 1);
  for (std::size_t k = 0; k < functions_; ++k) result[k] = (signs >> k & 1) != 0 ? 1 : -1;
  return result;
}

bool PieceCells::find_directions(PieceOf& part, const SignCell& cell, std::size_t sheet) const {
  const std::vector<int> signs = list(part.signs);
  part.directions = parts_.passages(cell, signs, directions(sheet));
  part.grows = part.directions.any() || parts_.grow_together(cell, cell.mixed, signs);
  return part.grows;
}

bool PieceCells::find_parts(CellOfPiece& c) const {
  std::vector<std::size_t> open;
  for (const std::size_t k : c.cell.mixed)
    if (k < functions_) open.push_back(k);
  if (open.size() > kMostOpen) return false;
  const std::vector<SignParts::Direction> tried = directions(c.sheet);
  std::uint32_t known_signs = 0;
  for (std::size_t k = 0; k < functions_; ++k) known_signs |= std::uint32_t{c.cell.range[k].is_positive()} << k;
  for (std::uint32_t choice = 0; choice < std::uint32_t{1} << open.size(); ++choice) {
    PieceOf part{known_signs};
    for (std::size_t i = 0; i < open.size(); ++i) part.signs |= (choice >> i & 1) << open[i];
    const std::vector<int> signs = list(part.signs);
    const SignParts::Part known = parts_.part(c.cell, signs, tried);
    if (known == SignParts::Part::empty) continue;
    part.connected = known == SignParts::Part::connected;
    if (!part.connected && !find_directions(part, c.cell, c.sheet)) return false;
    c.parts.push_back(part);
  }
  return true;
}

bool PieceCells::examine(std::size_t sheet, const FreeSides& over, int halvings, std::vector<CellOfPiece>& result) const {
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
  return halvings > 0 && in_halves(sheets_.over(sheet), over,
                                   [&](const FreeSides& half) { return examine(sheet, half, halvings - 1, result); });
}

std::string PieceCells::examine_all(std::vector<CellOfPiece>& cells) {
  for (const auto& step : {&PieceCells::check_bridges, &PieceCells::check_cells})
    if (std::string fault = (this->*step)(); !fault.empty()) return fault;
  std::vector<std::vector<CellOfPiece>> found(proof_.cells.size());
  std::atomic<std::size_t> unknown = 0;
  for_each(found.size(), [&](std::size_t i) {
    const PieceCell& cell = proof_.cells[i];
    if (!examine(cell.sheet, cell.sides, kHalvings, found[i])) ++unknown;
  });
  for (std::vector<CellOfPiece>& list : found) std::move(list.begin(), list.end(), std::back_inserter(cells));
  return unknown == 0 ? check_cover() : std::to_string(unknown) + " cells have parts that are not known";
}

bool PieceCells::examine_halves(const CellOfPiece& cell, std::vector<CellOfPiece>& result) const {
  return in_halves(sheets_.over(cell.sheet), cell.over,
                   [&](const FreeSides& half) { return examine(cell.sheet, half, kHalvings, result); });
}

// Encloses the sheet's solutions over these sides anew, about the one over their middle, where steps of `bound` are of no
// use since the sheet's region is wide. Theorem: what is found there in the region is the sheet's, which holds no other.
void PieceCells::narrow(std::size_t sheet, const FreeSides& over, SignCell& cell) const {
  std::vector<double> point;
  for (const Enclosure& side : cell.sides) point.push_back(side.mid());
  std::string fault;
  Sides x = solution_near(whole_, point, sheets_.free(sheet), fault, over);
  if (fault.empty() && sheets_.holds(sheet, over, x)) cell.sides = std::move(x);
}

// Cut at an end of another sheet that the place goes across, where there is one: no halving comes to that. Else in halves.
template <class Visit>
bool PieceCells::in_parts(std::size_t sheet, const FreeSides& over, const Sides& at, const Visit& visit) const {
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
  return in_halves(sheets_.over(sheet), over, visit);
}

// Do all points of S on the sheet over these sides lie in cells of other sheets? `via`: over how many sheets, each of
// which holds the points but leaves some of them to the next one.
bool PieceCells::is_elsewhere(std::size_t sheet, const FreeSides& over, int halvings, int via) const {
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
    if (via > 1 &&
        std::ranges::all_of(parts, [&](const FreeSides& part) { return is_elsewhere(other, part, kHalvingsVia, via - 1); }))
      return true;
  return halvings > 0 && in_parts(sheet, over, cell.sides,
                                  [&](const FreeSides& part) { return is_elsewhere(sheet, part, halvings - 1, via); });
}

std::string PieceCells::check_cover() {
  std::atomic<std::size_t> left = 0;
  for_each(cover_.boxes.size(), [&](std::size_t b) {
    for (const FreeSides& part : open_parts(sheets_.over(b), cells_of_[b], whole_.stop()))
      if (!is_elsewhere(b, part, kHalvingsElsewhere, kVia)) ++left;
  });
  return left == 0 ? "" : "its cells are not shown to cover all sheets";
}

}  // namespace corank::check
