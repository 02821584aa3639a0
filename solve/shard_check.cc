#include "corank/solve/shard_check.h"

#include <cmath>

#include "corank/solve/shard_bytes.h"

namespace corank::solve {
namespace {

void expect(bool fits) {
  if (!fits) throw ShardError("a part of a search cannot be read: it does not fit the system");
}

struct Sizes {
  explicit Sizes(const Prepared& prepared)
      : variables(prepared.reduction.kept.size()),
        sides(variables + prepared.reduction.definitions.size()),
        equations(prepared.reduction.system.equations.size()) {}
  std::size_t variables, sides, equations;
};

void check_indices(const std::vector<int>& indices, std::size_t below) {
  for (const int i : indices) expect(i >= 0 && static_cast<std::size_t>(i) < below);
}

void check_waiting(const Waiting& box, const Sizes& sizes) { expect(box.x.size() == sizes.variables); }

void check_sheet(const certify::Sheet& sheet, const Sizes& sizes) {
  expect(sheet.region.size() == sizes.variables && sheet.image.size() == sizes.variables &&
         sheet.dependent.size() <= sizes.variables);
  check_indices(sheet.dependent, sizes.variables);
  check_indices(sheet.equations, sizes.equations);
}

void check_kind(const CoverBox& box, const Sizes& sizes) {
  expect(static_cast<int>(box.verdict) < kVerdicts && static_cast<int>(box.reason) < kReasons);
  check_indices(box.free, sizes.variables);
}

void check_found(const Found& found, const Sizes& sizes) {
  expect(found.box.box.size() == sizes.sides && (!found.region || found.region->size() == sizes.sides));
  check_kind(found.box, sizes);
  if (found.sheet) check_sheet(*found.sheet, sizes);
}

}  // namespace

void check(const Work& work, const Prepared& prepared) {
  const Sizes sizes(prepared);
  for (const Waiting& box : work.boxes) check_waiting(box, sizes);
  expect(work.postpone >= 0 && std::isfinite(work.postpone));
}

namespace {

void check_but_found(const Shard& shard, std::size_t found, const Prepared& prepared) {
  const Sizes sizes(prepared);
  for (const Waiting& box : shard.left) check_waiting(box, sizes);
  for (const Proven& proven : shard.sheets) {
    expect(proven.x.size() == sizes.variables);
    check_sheet(proven.sheet, sizes);
  }
  for (const Postponed& postponed : shard.postponed) {
    check_waiting(postponed.box, sizes);
    expect(postponed.near.x.size() == sizes.variables);
    if (postponed.proof.proven) check_sheet(postponed.proof, sizes);
  }
  expect(shard.script.has_value() == prepared.options.proof || found + shard.sheets.size() == 0);
}

}  // namespace

void check(const Shard& shard, const Prepared& prepared) {
  const Sizes sizes(prepared);
  check_but_found(shard, shard.found.size(), prepared);
  for (const Found& found : shard.found) check_found(found, sizes);
}

void check(const Received::Part& part, const Prepared& prepared) {
  const Sizes sizes(prepared);
  check_but_found(part.shard, part.found.size(), prepared);
  expect(part.found.size() == 0 || part.found.sides() == sizes.sides);
  for (const CoverBox& kind : part.found.kinds()) check_kind(kind, sizes);
  for (const auto& [box, sheet] : part.found.sheets()) check_sheet(sheet, sizes);
}

void check(const Unit& unit, const Prepared& prepared) {
  const Sizes sizes(prepared);
  check(unit.work, prepared);
  for (const Proven& proven : unit.sheets) {
    expect(proven.x.size() == sizes.variables);
    check_sheet(proven.sheet, sizes);
  }
}

void check(const SearchState& state, const Prepared& prepared) {
  check(state.first, prepared);
  check(state.pass, prepared);
  for (const Shard& shard : state.shards) check(shard, prepared);
}

}  // namespace corank::solve
