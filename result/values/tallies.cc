#include "corank/result/values/tallies.h"

#include <functional>
#include <iterator>

#include "corank/certify/angle.h"

namespace corank::result {

std::map<Reason, std::size_t> undecided_reasons(const Cover& cover) {
  std::map<Reason, std::size_t> reasons;
  for (const CoverBox& box : cover.boxes)
    if (box.verdict == Verdict::undecided) ++reasons[box.reason];
  return reasons;
}

std::array<std::size_t, kPassages> passages(const Cover& cover) {
  std::array<std::size_t, kPassages> result{};
  for (const CoverBox& box : cover.boxes) ++result[static_cast<std::size_t>(box.passage)];
  return result;
}

std::vector<bool> on_parts_of_sheets(const Result& result) {
  std::vector<bool> list;
  list.reserve(result.cover.boxes.size());
  for (const Result& part : result.parts) std::ranges::copy(on_parts_of_sheets(part), std::back_inserter(list));
  if (result.parts.empty())
    for (const CoverBox& b : result.cover.boxes)
      list.push_back((b.verdict == Verdict::regular || b.verdict == Verdict::boundary) && !spans(result.cover, b));
  list.resize(result.cover.boxes.size());  // a stranger's parts may have any number
  return list;
}

std::size_t parts_of_sheets(const Result& result) { return how_many(on_parts_of_sheets(result), std::identity()); }

std::size_t boxes_on(const Cover& cover, std::size_t motion) {
  return how_many(cover.boxes, [motion](const CoverBox& box) { return box.motion == static_cast<int>(motion); });
}

TypeTally type_tally(const Cover& cover) {
  TypeTally tally;
  for (const SingularityType type : kSingularityTypes)
    if (cover.types.asked & bit(type)) tally.proven[type] = 0;
  if (tally.proven.empty()) return tally;
  for (const CoverBox& box : cover.boxes) {
    if (!holds_a_solution(box)) {
      ++tally.unproven;
      continue;
    }
    for (auto& [type, n] : tally.proven) n += (box.types.proven & bit(type)) != 0;
    tally.unproven += !box.types.settle(cover.types.of_set);
  }
  return tally;
}

std::vector<std::string> type_names(TypeSet types) {
  std::vector<std::string> names;
  for (const SingularityType type : kSingularityTypes)
    if (types & bit(type)) names.emplace_back(to_string(type));
  return names;
}

const ExactPoint* exact_point(const Result& result, const CoverBox& box) {
  return box.point < 0 ? nullptr : &result.cover.exact_points[box.point];
}

std::vector<Value> own_coordinates(const Result& result, int variables) {
  std::vector<Value> list;
  for (int i = 0; i < variables; ++i) {
    if (result.variables[i].kind == VariableKind::parameter) continue;  // it has its whole domain everywhere
    const auto has = [i](const Angle& a) { return a.cosine == i || a.sine == i; };
    const auto angle = std::ranges::find_if(result.angles, has);
    if (angle == result.angles.end()) {
      list.push_back({result.variables[i].name, {}, i});
    } else if (i == std::min(angle->cosine, angle->sine)) {
      list.push_back({angle->name, {}, -1, &*angle});
    }
  }
  return list;
}

std::vector<Value> values(const Result& result, const CoverBox& box, int variables) {
  std::vector<Value> list = own_coordinates(result, variables);
  const auto at = [&box](int v) { return box.box[v]; };
  for (Value& v : list)
    v.value = v.angle ? certify::angle_enclosure(at(v.angle->cosine), at(v.angle->sine), v.angle->range) : at(v.variable);
  return list;
}

std::vector<const ResultVariable*> parameters_of(const Result& result) {
  std::vector<const ResultVariable*> list;
  for (const ResultVariable& v : result.variables)
    if (v.kind == VariableKind::parameter) list.push_back(&v);
  return list;
}

KernelTally kernel_tally(const Result& result) {
  KernelTally tally;
  for (const CoverBox& box : result.cover.boxes) {
    const ExactPoint* point = exact_point(result, box);
    if (box.kernel_at_most < 0 || (box.verdict == Verdict::undecided && !point)) continue;
    ++tally.at_most[box.kernel_at_most];
    const bool larger = box.kernel_at_most > result.options.corank;
    tally.larger += larger;
    if (point && point->corank > 1) ++(larger ? tally.explained : tally.known);
  }
  return tally;
}

}  // namespace corank::result
