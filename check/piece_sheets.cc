#include "corank/check/piece_sheets.h"

#include <algorithm>

#include "corank/check/sheets.h"
#include "corank/core/box.h"

namespace corank::check {

PieceSheets::PieceSheets(const Problem& whole, const Problem& reduced, const Cover& cover,
                         const std::vector<SheetBridge>& bridges)
    : whole_(whole), reduced_(reduced), cover_(cover), bridges_(bridges) {}

std::string PieceSheets::bridge_fault(std::size_t bridge) const {
  // Where it leaves the domain the ends of the domain say so.
  const CoverBox box{.box = bridges_[bridge].region, .verdict = Verdict::boundary, .free = bridges_[bridge].free};
  return check_sheet(whole_, whole_.equations(), box, box.box);
}

const std::vector<int>& PieceSheets::free(std::size_t sheet) const {
  return is_box(sheet) ? cover_.boxes[sheet].free : bridges_[sheet - cover_.boxes.size()].free;
}

const Box& PieceSheets::region(std::size_t sheet) const {
  return is_box(sheet) ? cover_.regions[cover_.boxes[sheet].region] : bridges_[sheet - cover_.boxes.size()].region;
}

FreeSides PieceSheets::over(std::size_t sheet) const {
  const Box& box = is_box(sheet) ? cover_.boxes[sheet].box : region(sheet);
  FreeSides result;
  for (const int f : free(sheet)) result.push_back(box[f]);
  return result;
}

// The region speaks of the variables that were kept; the others' values follow from those.
Sides PieceSheets::start(std::size_t sheet, const FreeSides& over) const {
  const Box& r = region(sheet);
  Sides x(r.begin(), r.end());
  const std::vector<int>& frees = free(sheet);
  for (std::size_t k = 0; k < frees.size(); ++k) x[frees[k]] = Enclosure(over[k]);
  if (!is_box(sheet)) return x;
  Sides kept;
  for (const int j : reduced_.kept()) kept.push_back(x[j]);
  for (const Problem::Value& v : reduced_.values()) x[v.variable] = v.row.value(kept);
  return x;
}

bool PieceSheets::holds(std::size_t sheet, const FreeSides& over, const Sides& x) const {
  const Box& r = region(sheet);
  const std::vector<int>& frees = free(sheet);
  for (std::size_t k = 0; k < frees.size(); ++k)
    if (!x[frees[k]].inside(over[k])) return false;
  for (std::size_t j = 0; j < r.size(); ++j)
    if ((!is_box(sheet) || reduced_.place(static_cast<int>(j)) >= 0) && !x[j].inside(r[j])) return false;
  return true;
}

namespace {

// Have they more in common than their borders?
bool overlap_inside(const FreeSides& x, const FreeSides& other) {
  for (std::size_t k = 0; k < x.size(); ++k) {
    const bool point = x[k].lo() == x[k].hi();
    if (point ? !other[k].contains(x[k]) : !(other[k].lo() < x[k].hi() && x[k].lo() < other[k].hi())) return false;
  }
  return true;
}

void add_open(const FreeSides& x, const std::vector<const FreeSides*>& others, const StopFlag& stop,
              std::vector<FreeSides>& open) {
  stop.poll();
  std::vector<const FreeSides*> near;
  for (const FreeSides* other : others) {
    if (contains(*other, x)) return;
    if (overlap_inside(x, *other)) near.push_back(other);
  }
  // Where most of their sides end within x, at the middle one of these ends.
  std::size_t along = 0;
  std::vector<double> cuts;
  for (std::size_t k = 0; k < x.size(); ++k) {
    std::vector<double> ends;
    for (const FreeSides* other : near)
      for (const double end : {(*other)[k].lo(), (*other)[k].hi()})
        if (x[k].lo() < end && end < x[k].hi()) ends.push_back(end);
    if (ends.size() > cuts.size()) along = k, cuts = std::move(ends);
  }
  if (cuts.empty()) {
    open.push_back(x);
    return;
  }
  const auto middle = cuts.begin() + cuts.size() / 2;
  std::nth_element(cuts.begin(), middle, cuts.end());
  FreeSides first = x, second = x;
  first[along] = Interval(x[along].lo(), *middle);
  second[along] = Interval(*middle, x[along].hi());
  add_open(first, near, stop, open);
  add_open(second, near, stop, open);
}

}  // namespace

std::vector<FreeSides> open_parts(const FreeSides& x, const std::vector<const FreeSides*>& others, const StopFlag& stop) {
  std::vector<FreeSides> open;
  add_open(x, others, stop, open);
  return open;
}

}  // namespace corank::check
