#include "corank/check/linking.h"

#include <algorithm>

#include "corank/check/sheets.h"

namespace corank::check {

Linking::Linking(const System& system, const Problem& problem, const Cover& cover, const std::vector<SheetBridge>& bridges)
    : system_(system), problem_(problem), cover_(cover), bridges_(bridges), whole_(system, {}, problem.stop()) {
  const std::size_t regions = cover.regions.size();
  free_.resize(regions);
  contradiction_.assign(regions, "it belongs to no box");
  checked_by_its_box_.assign(regions, 0);
  for (const CoverBox& box : cover.boxes) {
    if (box.region < 0) continue;
    const std::size_t r = box.region;
    if (!free_[r].empty() && free_[r] != box.free) {
      contradiction_[r] = "its boxes do not have the same free variables";
      continue;
    }
    if (free_[r].empty()) contradiction_[r].clear();
    free_[r] = box.free;
    const bool all = std::ranges::all_of(box.free, [&](int f) { return box.box[f].contains(cover.regions[r][f]); });
    if (all) checked_by_its_box_[r] = 1;
  }
  for (const SheetBridge& bridge : bridges) free_.push_back(bridge.free);
}

const Box& Linking::region(std::size_t sheet) const {
  return sheet < cover_.regions.size() ? cover_.regions[sheet] : bridges_[sheet - cover_.regions.size()].region;
}

std::string Linking::sheet_fault(std::size_t sheet) const {
  if (sheet < cover_.regions.size()) return region_fault(sheet);
  const CoverBox box{.box = region(sheet), .verdict = Verdict::regular, .free = free_[sheet]};
  return check_sheet(whole_, whole_.equations(), box, region(sheet));
}

std::string Linking::region_fault(std::size_t sheet) const {
  constexpr double kAnywhere = 1e300;
  if (!contradiction_[sheet].empty() || checked_by_its_box_[sheet]) return contradiction_[sheet];
  CoverBox box{.box = region(sheet), .verdict = Verdict::regular, .free = free_[sheet]};
  for (int j = 0; j < system_.size(); ++j)
    if (problem_.place(j) < 0) box.box[j] = Interval(-kAnywhere, kAnywhere);
  return check_sheet(problem_, problem_.equations(), box, box.box);
}

bool Linking::contains(std::size_t sheet, const Sides& x) const {
  const Box& r = region(sheet);
  for (int j = 0; j < system_.size(); ++j)
    if (sheet >= cover_.regions.size() || problem_.place(j) >= 0)
      if (!x[j].inside(r[j])) return false;
  return true;
}

bool Linking::holds(std::size_t sheet, const Box& box) const {
  return contains(sheet, Sides(box.begin(), box.begin() + system_.size()));
}

std::string Linking::link_fault(const SheetLink& link) const {
  const auto is_sheet = [&](int k) { return k >= 0 && static_cast<std::size_t>(k) < sheets(); };
  if (!is_sheet(link.first) || !is_sheet(link.second)) return "it names a sheet that does not exist";
  std::string fault;
  const Sides x = solution_near(whole_, link.point, link.held, fault);
  if (!fault.empty()) return fault;
  for (const int k : {link.first, link.second})
    if (!contains(k, x)) return "its solution is not shown to lie in both sheets";
  return "";
}

}  // namespace corank::check
