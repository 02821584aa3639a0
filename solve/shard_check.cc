#include <cmath>
#include <utility>

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
  for (const int i : indices) expect(i >= 0 && std::cmp_less(i, below));
}

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

void check_proven(const Proven& proven, const Sizes& sizes) {
  expect(proven.x.size() == sizes.variables);
  check_sheet(proven.sheet, sizes);
}

void check_but_found(const Shard& shard, std::size_t found, const Prepared& prepared) {
  const Sizes sizes(prepared);
  for (const Waiting& box : shard.left) expect(box.x.size() == sizes.variables);
  for (const Proven& proven : shard.sheets) check_proven(proven, sizes);
  for (const Postponed& postponed : shard.postponed) {
    expect(postponed.box.x.size() == sizes.variables);
    expect(postponed.near.x.size() == sizes.variables);
    if (postponed.proof.proven) check_sheet(postponed.proof, sizes);
  }
  expect(shard.script.has_value() == prepared.options.proof || found + shard.sheets.size() == 0);
}

}  // namespace

void check(const Work& work, const Prepared& prepared) {
  const Sizes sizes(prepared);
  for (const Waiting& box : work.boxes) expect(box.x.size() == sizes.variables);
  expect(work.postpone >= 0 && std::isfinite(work.postpone));
}

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
  for (const Proven& proven : unit.sheets) check_proven(proven, sizes);
}

void check(const SearchState& state, const Prepared& prepared) {
  check(state.first, prepared);
  check(state.pass, prepared);
  for (const Shard& shard : state.shards) check(shard, prepared);
}

}  // namespace corank::solve
