#include "corank/check/linking.h"

#include <algorithm>
#include <cmath>

#include "corank/check/krawczyk.h"
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
    const auto r = static_cast<std::size_t>(box.region);
    if (!free_[r].empty() && free_[r] != box.free) {
      contradiction_[r] = "its boxes have not the same free variables";
      continue;
    }
    if (free_[r].empty()) contradiction_[r].clear();
    free_[r] = box.free;
    const bool all = std::all_of(box.free.begin(), box.free.end(), [&](int f) {
      return box.box[static_cast<std::size_t>(f)].contains(cover.regions[r][static_cast<std::size_t>(f)]);
    });
    if (all) checked_by_its_box_[r] = 1;
  }
  for (const SheetBridge& bridge : bridges) free_.push_back(bridge.free);
}

const Box& Linking::region(std::size_t sheet) const {
  return sheet < cover_.regions.size() ? cover_.regions[sheet] : bridges_[sheet - cover_.regions.size()].region;
}

std::string Linking::sheet_fault(std::size_t sheet) const {
  if (sheet < cover_.regions.size()) return region_fault(sheet);
  CoverBox box;
  box.box = region(sheet);
  box.verdict = Verdict::regular;
  box.free = free_[sheet];
  return check_sheet(whole_, whole_.equations(), box, region(sheet));
}

std::string Linking::region_fault(std::size_t sheet) const {
  constexpr double kAnywhere = 1e300;
  if (!contradiction_[sheet].empty() || checked_by_its_box_[sheet]) return contradiction_[sheet];
  CoverBox box;
  box.box = region(sheet);
  box.verdict = Verdict::regular;
  box.free = free_[sheet];
  for (int j = 0; j < system_.size(); ++j)
    if (problem_.place(j) < 0) box.box[static_cast<std::size_t>(j)] = Interval(-kAnywhere, kAnywhere);
  return check_sheet(problem_, problem_.equations(), box, box.box);
}

bool Linking::contains(std::size_t sheet, const Sides& x) const {
  const Box& r = region(sheet);
  for (int j = 0; j < system_.size(); ++j)
    if (sheet >= cover_.regions.size() || problem_.place(j) >= 0)
      if (!x[static_cast<std::size_t>(j)].inside(r[static_cast<std::size_t>(j)])) return false;
  return true;
}

bool Linking::holds(std::size_t sheet, const Box& box) const {
  Sides x;
  for (int j = 0; j < system_.size(); ++j) x.emplace_back(box[static_cast<std::size_t>(j)]);
  return contains(sheet, x);
}

// Theorem (Krawczyk, Brouwer): where the image of a box lies strictly inside of it, the box holds a solution with the held
// variables' values; it lies in every further image, too.
std::string Linking::link_fault(const SheetLink& link) const {
  constexpr int kInflations = 12, kSteps = 3;
  const std::size_t n = system_.variables.size();
  const auto is_sheet = [&](int k) { return k >= 0 && static_cast<std::size_t>(k) < sheets(); };
  if (!is_sheet(link.first) || !is_sheet(link.second)) return "it names a sheet that is none";
  if (link.point.size() != n ||
      !std::all_of(link.point.begin(), link.point.end(), [](double x) { return std::isfinite(x); }))
    return "its point is none";
  std::vector<unsigned char> held(n, 0);
  for (const int j : link.held) {
    if (j < 0 || j >= static_cast<int>(n) || held[static_cast<std::size_t>(j)]) return "it holds what is no variable";
    held[static_cast<std::size_t>(j)] = 1;
  }
  std::vector<int> dependent;
  Sides x;
  for (std::size_t j = 0; j < n; ++j) {
    const double c = link.point[j], radius = held[j] ? 0 : 1e-10 * std::max(1.0, std::fabs(c));
    x.emplace_back(c - radius, c + radius);
    if (!held[j]) dependent.push_back(static_cast<int>(j));
  }
  Krawczyk newton(whole_.equations(), static_cast<int>(n));
  if (dependent.size() != whole_.equations().size()) return "it holds not as many variables as the set has dimensions";
  bool exists = false;
  for (int step = 0; !exists && step < kInflations; ++step) {
    problem_.stop().poll();
    if (!newton.set(dependent, x, Krawczyk::Center::polished)) return "its equations are singular";
    const Sides image = newton.image(x);
    exists = true;
    for (std::size_t a = 0; a < image.size(); ++a)
      exists = exists && image[a].strictly_inside(x[static_cast<std::size_t>(dependent[a])]);
    for (std::size_t a = 0; a < image.size(); ++a) {
      if (!image[a].is_bounded()) return "no solution is shown near its point";
      Enclosure& side = x[static_cast<std::size_t>(dependent[a])];
      const double margin = 0.2 * image[a].width() + 1e-15 * image[a].mag() + 1e-300;
      if (!exists) side = Enclosure(image[a].lo() - margin, image[a].hi() + margin);
      if (exists) side = image[a];
    }
  }
  if (!exists) return "no solution is shown near its point";
  for (int step = 0; step < kSteps; ++step) {
    if (!newton.set(dependent, x, Krawczyk::Center::refined)) break;
    const Sides image = newton.image(x);
    for (std::size_t a = 0; a < image.size(); ++a)
      if (!x[static_cast<std::size_t>(dependent[a])].intersect(image[a])) return "no solution is shown near its point";
  }
  for (const int k : {link.first, link.second})
    if (!contains(static_cast<std::size_t>(k), x)) return "its solution is not shown to lie in both sheets";
  return "";
}

}  // namespace corank::check
