#include "corank/certify/solution_count.h"

#include <algorithm>

#include "corank/core/box.h"
#include "corank/core/check.h"
#include "corank/core/rounding.h"

namespace corank::certify {
namespace {

constexpr int kNewtonSteps = 4;  // until an image over one value is small

bool is_dependent(const Sheet& sheet, std::size_t j) {
  return std::ranges::find(sheet.dependent, static_cast<int>(j)) != sheet.dependent.end();
}

// Shrinks the dependent sides of x, which hold the sheet's zeros over its free sides.
NewtonStep tighten(const CompiledSystem& system, const Sheet& sheet, std::span<Interval> x, NewtonWorkspace& w) {
  return tighten_sheet(system, midpoint_preconditioner(system, midpoint(x), sheet.dependent), x, w);
}

// Encloses the sheet's zero over the middle of its parameters.
std::vector<Interval> image_at_middle(const CompiledSystem& system, const Sheet& sheet, NewtonWorkspace& w) {
  std::vector<Interval> x = sheet.image;
  for (std::size_t j = 0; j < x.size(); ++j)
    if (!is_dependent(sheet, j)) x[j] = Interval(x[j].mid());
  for (int step = 0; step < kNewtonSteps; ++step) tighten(system, sheet, x, w);
  return x;
}

}  // namespace

Identity compare_over(const CompiledSystem& system, const Sheet& a, const Sheet& b, NewtonWorkspace& w) {
  CORANK_CHECK(UpwardRounding::active() && a.proven && b.proven && a.dependent.size() == b.dependent.size());
  CORANK_CHECK(static_cast<int>(a.equations.size()) == system.equations() && a.equations.size() == a.dependent.size() &&
               a.equations.size() == b.equations.size());
  for (std::size_t j = 0; j < a.image.size(); ++j)
    CORANK_CHECK(is_dependent(a, j) == is_dependent(b, j) && (is_dependent(a, j) || a.image[j] == b.image[j]));
  if (!overlap(a.image, b.image)) return Identity::different;
  if (contains(a.region, b.image) || contains(b.region, a.image)) return Identity::same;
  const std::vector<Interval> at_a = image_at_middle(system, a, w), at_b = image_at_middle(system, b, w);
  if (!overlap(at_a, at_b)) return Identity::different;
  if (contains(a.region, at_b) || contains(b.region, at_a)) return Identity::same;
  return Identity::unknown;
}

Sheet restricted(const CompiledSystem& system, const Sheet& sheet, std::span<const Interval> box, NewtonWorkspace& w) {
  CORANK_CHECK(UpwardRounding::active() && sheet.proven);
  Sheet part = sheet;
  for (std::size_t j = 0; j < part.region.size(); ++j) {
    if (is_dependent(sheet, j)) continue;
    CORANK_CHECK(sheet.region[j].contains(box[j]));
    part.region[j] = part.image[j] = box[j];
  }
  tighten(system, part, part.image, w);
  return part;
}

bool lies_on(const Sheet& sheet, std::span<const Interval> box) { return sheet.proven && contains(sheet.region, box); }

bool keep_distinct(const CompiledSystem& system, std::vector<Sheet>& sheets, NewtonWorkspace& w) {
  bool known = true;
  std::vector<Sheet> kept;
  for (Sheet& sheet : sheets) {
    bool is_new = true;
    for (std::size_t k = 0; k < kept.size() && is_new; ++k) {
      const Identity identity = compare_over(system, kept[k], sheet, w);
      is_new = identity != Identity::same;
      known = known && identity != Identity::unknown;
    }
    if (is_new) kept.push_back(std::move(sheet));
  }
  sheets = std::move(kept);
  return known;
}

std::optional<std::vector<std::size_t>> sheets_inside(const CompiledSystem& system, const DomainTest& domain,
                                                      const std::vector<Sheet>& sheets, NewtonWorkspace& w) {
  CORANK_CHECK(UpwardRounding::active());
  std::vector<std::size_t> inside;
  for (std::size_t k = 0; k < sheets.size(); ++k) {
    std::vector<Interval> x = sheets[k].image;
    const NewtonStep step = tighten(system, sheets[k], x, w);
    switch (domain.locate_zeros(step, x)) {
      case Location::inside: inside.push_back(k); break;
      case Location::outside: break;
      case Location::across: return std::nullopt;
    }
  }
  return inside;
}

}  // namespace corank::certify
