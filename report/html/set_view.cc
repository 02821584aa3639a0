#include "corank/report/html/set_view.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "corank/core/box_tree.h"
#include "corank/report/pictures/drawn_boxes.h"
#include "corank/result/files/hdf5_file.h"
#include "corank/result/files/verification.h"
#include "corank/result/values/tallies.h"
#include "corank/result/values/words.h"
#include "corank/symbolic/model/model_error.h"

namespace corank::report {

Components components(const result::Result& result, const Ended& ended) {
  return components(result.cover.boxes, result.configuration_size, ended);
}

Components components(const std::vector<CoverBox>& boxes, std::size_t configuration_size, const Ended& ended) {
  const Components none{.counted = false};
  if (is_over(ended)) return none;
  std::vector<const Box*> sides;
  sides.reserve(boxes.size());
  for (const CoverBox& b : boxes) sides.push_back(&b.box);
  const BoxTree tree(std::move(sides), configuration_size, ended);
  Components found;
  found.of_box = tree.groups(0, ended);
  if (is_over(ended)) return none;
  std::vector<bool> proven(boxes.empty() ? 0 : std::ranges::max(found.of_box) + 1);
  for (std::size_t i = 0; i < boxes.size(); ++i)
    if (result::is_surely_within(boxes[i].verdict)) proven[found.of_box[i]] = true;
  found.count = proven.size();
  found.with_proven_solution = result::how_many(proven, std::identity());
  return found;
}

bool say_cut(std::size_t uncut, SetView& view) {
  view.uncut = uncut;
  const bool is_cut = std::isfinite(view.result.cover.sigma.largest());
  view.words.meaning += "; drawn here: its " + grouped(uncut) + " " + result::noun(uncut, "box");
  view.words.meaning += is_cut ? ", cut to σ" : " uncut, since cut ones are too many for the page, or take too long";
  return is_cut;
}

SetView set_view(result::Result result, System system, bool given_velocity_equation, const Ended& ended) {
  Components found = components(result, ended);
  return set_view(std::move(result), std::move(system), given_velocity_equation, std::move(found));
}

SetView set_view(result::Result result, System system, bool given_velocity_equation, Components found) {
  const symbolic::SetDefinition& set = symbolic::definition(result.set);
  SetWords words = set_words(result, found, given_velocity_equation);
  std::vector<CoverBox> hulls;
  if (const std::size_t in_one = boxes_in_one(result, found); in_one > 1) hulls = hulls_of(result, in_one);
  return {std::move(result), &set, std::move(system), std::move(found), std::move(words), std::move(hulls)};
}

SetView set_view(const symbolic::Mechanism& mechanism, result::Result result) {
  if (!symbolic::singularity_set_from_string(result.set))
    throw result::ResultFileError("the result's set '" + result.set + "' is not a set of a mechanism");
  System system;
  try {
    system = result::system_of(mechanism, result);
  } catch (const symbolic::ModelError& error) {  // scales that are none of this model
    throw result::ResultFileError(std::string("the result's system: ") + error.what());
  }
  const auto same = [](const Variable& a, const result::ResultVariable& b) { return a.name == b.name; };
  if (!std::equal(system.variables.begin(), system.variables.end(), result.variables.begin(), result.variables.end(), same))
    throw result::ResultFileError("the result of the set '" + result.set + "' has other variables than the model " +
                                  mechanism.name());
  return set_view(std::move(result), std::move(system), mechanism.has_own_velocity_equation());
}

}  // namespace corank::report
