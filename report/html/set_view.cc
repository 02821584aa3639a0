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
#include "corank/symbolic/sets/velocity_blocks.h"

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

namespace {

// Without those in variables that the set's boxes have no sides for, such as multipliers.
std::vector<Polynomial> conditions_of(const System& part, const System& whole) {
  std::vector<Polynomial> list;
  for (Polynomial f : part.equations) {
    bool is_of_whole = true;
    for (Monomial& m : f.monomials)
      for (Factor& x : m.factors) {
        x.variable = whole.find(part.variables[x.variable].name);
        is_of_whole = is_of_whole && x.variable >= 0;
      }
    const auto same = [&](const Polynomial& g) { return g.source == f.source; };
    if (is_of_whole && std::ranges::none_of(whole.equations, same)) list.push_back(std::move(f));
  }
  return list;
}

// What draws a set in parts as other sets are drawn: on the set, with the velocity that is left.
void add_conditions(const symbolic::Mechanism& mechanism, SetView& view) {
  if (view.result.parts.empty()) return;
  try {
    for (const System& part : result::systems_of_parts(mechanism, view.result))
      view.conditions.push_back(conditions_of(part, view.system));
    if (view.set->has_kernel() && !view.set->of_parts && !view.set->of_requirements)
      view.locked = symbolic::locked_polynomials(mechanism, *view.set->set);
  } catch (const symbolic::ModelError&) {  // a picture without them is one as well
    view.conditions.clear();
  }
}

}  // namespace

SetView set_view(const symbolic::Mechanism& mechanism, result::Result result, System system, const Ended& ended) {
  Components found = components(result, ended);
  return set_view(mechanism, std::move(result), std::move(system), std::move(found));
}

SetView set_view(const symbolic::Mechanism& mechanism, result::Result result, System system, Components found) {
  const symbolic::SetDefinition& set = symbolic::definition(result.set);
  SetWords words = set_words(result, found, mechanism.has_own_velocity_equation());
  std::vector<CoverBox> hulls;
  if (const std::size_t in_one = boxes_in_one(result, found); in_one > 1) hulls = hulls_of(result, in_one);
  SetView view{std::move(result), &set, std::move(system), std::move(found), std::move(words), {}, {}, std::move(hulls)};
  add_conditions(mechanism, view);
  return view;
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
  return set_view(mechanism, std::move(result), std::move(system));
}

}  // namespace corank::report
