// The postures that a cover's boxes hold: the values of their joints.
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "corank/analyze/postures/posture_parts.h"
#include "corank/certify/angle.h"
#include "corank/symbolic/algebra/exact_value.h"

namespace corank::analyze {
namespace {

using symbolic::Expression;

constexpr double kFine = 1e-10;  // σ of a posture: what follows from it is to have many digits
constexpr std::uint64_t kMostToNarrow = 10'000;

// Boxes that hold one solution each, as narrow as doubles make them, or nearly; as they are where that search says anything
// else.
std::vector<CoverBox> narrowed(solve::Prepared prepared, const std::vector<CoverBox>& isolated,
                               const solve::Control& control) {
  if (isolated.empty()) return isolated;  // no roots would be all of the domain
  prepared.options.sigma = std::max(kFine, solve::smallest_sigma(prepared.system).largest());
  for (const CoverBox& point : isolated) prepared.options.roots.push_back(point.box);
  solve::Control own(control.rest(0, kMostToNarrow));
  Cover cover = solve::solve(prepared, own);
  const bool same = cover.points.size() == isolated.size() && std::ranges::all_of(cover.points, [](const CoverBox& point) {
                      return point.verdict == Verdict::isolated;
                    });
  return same ? std::move(cover.points) : isolated;
}

Interval whole_turn() { return {-std::numbers::pi, std::nextafter(std::numbers::pi, 4.0)}; }

}  // namespace

Interval range_of(const symbolic::Mechanism& model, const std::string& name, const Expression& lower,
                  const Expression& upper) {
  return Interval::hull(symbolic::exact_value(model, lower, name).enclose(),
                        symbolic::exact_value(model, upper, name).enclose());
}

std::vector<CoordinateValue> PostureFinder::Parts::values_of(const System& system, const Box& box) const {
  const std::vector<CoordinateValue> all = coordinate_values(system, box);
  if (!six) {
    std::vector<CoordinateValue> values;
    for (const std::string& name : names) {
      const auto found = std::ranges::find(all, name, &CoordinateValue::name);
      values.push_back({name, found == all.end() ? Interval::whole() : found->value});
    }
    return values;
  }
  std::vector<CoordinateValue> joints;
  for (const kinematics::SixJoints::Angle& angle : six->angles) {
    if (!angle.coordinate.empty()) {
      joints.push_back(*std::ranges::find(all, angle.coordinate, &CoordinateValue::name));
      continue;
    }
    const Interval range =
        angle.range ? range_of(six->mechanism, angle.joint, angle.range->lower, angle.range->upper) : whole_turn();
    joints.push_back(
        {angle.joint, certify::angle_enclosure(box[system.find(angle.cosine)], box[system.find(angle.sine)], range)});
  }
  std::ranges::sort(joints, {}, [&](const CoordinateValue& v) { return std::ranges::find(names, v.name) - names.begin(); });
  return joints;
}

void PostureFinder::Parts::include(const System& system, const Box& box, PostureFamily& family) const {
  const std::vector<CoordinateValue> at = values_of(system, box);
  if (family.values.empty()) family.values = at;
  for (std::size_t k = 0; k < at.size(); ++k) family.values[k].value = Interval::hull(family.values[k].value, at[k].value);
}

void PostureFinder::Parts::take(const solve::Prepared& prepared, const Cover& cover, const solve::Control& control,
                                Postures& result) const {
  const System& system = prepared.system;
  std::vector<CoverBox> isolated;
  for (const CoverBox& point : cover.points) {
    if (point.verdict == Verdict::isolated) {
      isolated.push_back(point);
    } else if (point.verdict == Verdict::exact || point.verdict == Verdict::boundary) {
      result.found.push_back({values_of(system, point.box), point.verdict == Verdict::exact});
    } else {
      include(system, point.box, result.families.emplace_back());
    }
  }
  for (const CoverBox& point : narrowed(prepared, isolated, control)) result.found.push_back({values_of(system, point.box)});
  std::ranges::sort(result.found, {}, [](const Posture& posture) {
    std::vector<double> middle;
    for (const CoordinateValue& v : posture.values) middle.push_back(v.value.mid());
    return middle;
  });
  // Undecided boxes along a set are no points.
  const bool in_points =
      std::ranges::any_of(cover.points, [](const CoverBox& point) { return point.verdict == Verdict::undecided; });
  std::map<int, PostureFamily> families;  // by their self-motion
  std::optional<PostureFamily> undecided;
  for (const CoverBox& box : cover.boxes) {
    if (!in_points && (box.verdict == Verdict::undecided || box.verdict == Verdict::partial)) {
      if (!undecided) undecided.emplace().dimension = cover.observed_dimension;
      include(system, box.box, *undecided);
    }
    if (box.free.empty()) continue;
    PostureFamily& family = families[box.motion];
    family.dimension = static_cast<int>(box.free.size());
    family.proven = family.proven || box.verdict == Verdict::regular || box.verdict == Verdict::exact;
    include(system, box.box, family);
  }
  for (auto& [motion, family] : families) result.families.push_back(std::move(family));
  if (undecided) result.families.push_back(std::move(*undecided));
}

}  // namespace corank::analyze
