#include "corank/analyze/maps/critical_points.h"

#include <algorithm>

#include "corank/analyze/aspects/aspects.h"
#include "corank/analyze/clearance/clearance.h"
#include "corank/analyze/maps/area_by_boundary.h"
#include "corank/study/answer.h"

namespace corank::analyze {
namespace {

using symbolic::SingularitySet;

constexpr std::uint64_t kMostForPoints = 20'000, kMostForAspects = 100'000;

bool are_same(std::vector<std::string> a, std::vector<std::string> b) {
  std::ranges::sort(a);
  std::ranges::sort(b);
  return a == b;
}

// Over the inputs the forward locus, over the outputs the inverse one.
bool is_over_inputs(const study::Question& question, const std::vector<std::string>& names) {
  const symbolic::Mechanism& model = question.model;
  const bool inputs = are_same(model.inputs(), names);
  if ((!inputs && !are_same(model.outputs(), names)) || !is_plane_of_lengths(model, names))
    throw question_error(question, "cusps and nodes are those of a curve over two outputs or two inputs",
                         "a map over all outputs, or all inputs, of a mechanism that has two, both lengths");
  return inputs;
}

// Those of the set in the region; are there no others?
bool find_points(study::Question question, SingularitySet set, const std::vector<std::string>& names, const Box& region,
                 int threads, const solve::Control& control, std::vector<CriticalPoint>& points) {
  question.set = set;
  study::Options options;
  options.search.threads = threads;
  solve::Control own(control.rest(0, kMostForPoints));
  const System system = study::system(question, study::equations(question));
  const Cover cover = study::answer(question, system, options, own).cover;
  for (const CoverBox& point : cover.points) {
    const std::vector<CoordinateValue> values = coordinate_values(system, point.box);
    CriticalPoint found{{}, point.verdict == Verdict::isolated};
    for (std::size_t k = 0; k < names.size(); ++k) {
      const Interval at = std::ranges::find(values, names[k], &CoordinateValue::name)->value;
      found.sides.push_back(at);
      found.proven = found.proven && region[k].contains(at);
    }
    if (found.sides[0].overlaps(region[0]) && found.sides[1].overlaps(region[1])) points.push_back(std::move(found));
  }
  return cover.complete() && cover.points.size() == cover.boxes.size() &&
         std::ranges::all_of(points, &CriticalPoint::proven);
}

}  // namespace

CriticalPoints critical_points(const study::Question& question, const std::vector<std::string>& names, const Box& region,
                               int threads, solve::Control& control) {
  study::require_exact_constants(question.model, "a map with cusps");
  CriticalPoints result{.forward = is_over_inputs(question, names)};
  study::Question in_region = question;  // as the map's, its ranges replace those that the model declares
  for (std::size_t k = 0; k < names.size(); ++k)
    in_region.model.set_range(names[k], symbolic::Expression(ExactNumber::dyadic(region[k].lo()).text()),
                              symbolic::Expression(ExactNumber::dyadic(region[k].hi()).text()));
  const bool forward = result.forward;
  result.cusps_known = find_points(in_region, forward ? SingularitySet::forward_cusps : SingularitySet::inverse_cusps, names,
                                   region, threads, control, result.cusps);
  result.nodes_known = find_points(in_region, forward ? SingularitySet::forward_nodes : SingularitySet::inverse_nodes, names,
                                   region, threads, control, result.nodes);
  if (control.ended()) return result;
  solve::Control own(control.rest(0, kMostForAspects));
  const Aspects pieces = aspects(question, {.threads = threads}, own);
  if (pieces.reason.empty() && !own.ended()) result.aspects = summary(pieces);
  if (result.aspects.ends_with('.')) result.aspects.pop_back();
  return result;
}

}  // namespace corank::analyze
