#include "corank/study/cut.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include "corank/core/box.h"
#include "corank/result/files/hdf5_file.h"
#include "corank/result/files/verification.h"
#include "corank/result/values/sentences.h"
#include "corank/result/values/tallies.h"
#include "corank/solve/search/box_labels.h"
#include "corank/solve/search/passes.h"
#include "corank/solve/search/recut.h"
#include "corank/study/images.h"
#include "corank/study/search_steps.h"
#include "corank/symbolic/model/set_definition.h"
#include "corank/symbolic/sets/set_parts.h"

namespace corank::study {
namespace {

// Is some part about an arm's joints alone, and can each such part have outputs? A picture of others beside it would show
// whole ranges.
bool lacks_outputs(const symbolic::Mechanism& model, const result::Result& result) {
  bool lacks = false;
  for (const result::Result& part : result.parts) {
    if (left_out(part).empty() || part.cover.boxes.empty()) continue;
    if (result::has_outputs(model, part)) continue;
    std::vector<std::string> own;
    for (const symbolic::Coordinate& c : model.coordinates())
      if (has_coordinate(part, c.name)) own.push_back(c.name);
    if (!symbolic::can_have_outputs(model, own)) return false;
    lacks = true;
  }
  return lacks;
}

// Has the run ended? Then the sheets stay as they are, and the result says so.
bool left_whole(const solve::Control& control, result::Result& result) {
  if (!control.ended()) return false;
  result.stopped = to_string(*control.ending());
  return true;
}

// The options, with the default of a σ that is not asked for: boxes that are no wider then need no search.
solve::Options with_sigma(solve::Options options, const System& system, const Cover& cover) {
  Box hull;
  for (const CoverBox& box : cover.boxes) {
    include(hull, box.box);
    if (hull.empty()) hull = box.box;
  }
  const Sigma sigma = solve::chosen_sigma(options, system, hull, cover.dimension);
  options.sigma_length = sigma.length;
  options.sigma_angle = sigma.angle;
  options.surfaces_whole = true;
  return options;
}

// A part in an arm's joints alone is searched anew, with all coordinates that the outputs depend on, since a product knows
// nothing of them. False where it is none; where the control ends the run, it stays.
bool search_with_outputs(const symbolic::Mechanism& model, const solve::Options& options, solve::Control& control,
                         result::Result& part) {
  if (left_out(part).empty() || part.cover.boxes.empty()) return false;
  Question question{.model = model,
                    .set = symbolic::singularity_set_from_string(part.set),
                    .constants = part.options.constants,
                    .outputs = part.options.outputs,
                    .part = result::part_of(model, part)};
  if (!symbolic::add_outputs(model, *question.part)) return false;
  const System system = study::system(question);
  Options all{options};
  all.search.surfaces_whole = false;
  Asked asked = prepare(question, system, all, control);
  Cover cover = solve::solve(asked.prepared, control);
  solve::settle(asked.prepared, asked.settling, cover, control);
  if (left_whole(control, part)) return true;
  result::Result found = describe(question, system, all, std::move(cover), {});
  found.part = part.part;
  found.condition = part.condition;
  part = std::move(found);
  return true;
}

// Of a result without parts, or a part.
void cut_one(const symbolic::Mechanism& model, solve::Options options, solve::Control& control, result::Result& result) {
  if (left_whole(control, result)) return;
  const System system = result::system_of(model, result);
  if (result::parts_of_sheets(result) > 0) options = with_sigma(std::move(options), system, result.cover);
  const solve::Prepared prepared = solve::prepare(system, options, control);
  if (left_whole(control, result)) return;  // the reduction was perhaps given up, and is not the cover's
  const auto blocks = result::blocks_of(result);
  const CoverTypes types = result.cover.types;
  Cover& cover = result.cover;
  try {
    cover = solve::recut(prepared, std::move(cover), control);
  } catch (const std::invalid_argument& error) {
    throw result::ResultFileError(std::string("its boxes cannot be cut: ") + error.what());
  }
  solve::bound_kernel_dimensions(prepared, cover, control);
  solve::prove_passages(prepared, cover, control);
  if (blocks) solve::label_types(prepared, {*blocks, symbolic::definition(result.set).type}, cover, control);
  cover.types.left_out += types.left_out;
  if (const auto ending = control.ending()) result.stopped = to_string(*ending);
  result.options.sigma = cover.sigma;
  result::describe_in_words(model, system, result);
}

void cut_all(const solve::Options& options, solve::Control& control, result::Result& result) {
  const symbolic::Mechanism model = result::model_of(result);
  if (result.parts.empty()) return cut_one(model, options, control, result);
  const bool lacks = lacks_outputs(model, result);
  for (result::Result& part : result.parts)
    if (!lacks || !search_with_outputs(model, options, control, part)) cut_one(model, options, control, part);
  result::merge_parts(result);
  result::describe_in_words(model, result::system_of(model, result), result);
}

}  // namespace

bool is_whole(const result::Result& result) {
  if (lacks_sides(result) && lacks_outputs(result::model_of(result), result)) return true;
  const auto is_sheet = [](const CoverBox& box) {
    return box.verdict == Verdict::regular || box.verdict == Verdict::boundary;
  };
  return std::isinf(result.cover.sigma.largest()) && result.cover.dimension > 0 && result.options.tolerance == 0 &&
         std::ranges::any_of(result.cover.boxes, is_sheet);
}

result::Result cut(result::Result result, const solve::Options& options, solve::Control& control) {
  if (result.options.tolerance > 0)
    throw result::ResultFileError(
        "the search itself depends on sigma here, since coefficients have a tolerance; expected a new search");
  const solve::InStage stage(control, solve::Stage::search);  // of all parts: what is cut was found before
  result.search.clear();
  cut_all(options, control, result);
  return result;
}

result::Result cut_for_page(const result::Result& whole, solve::Options options, std::uint64_t most,
                            const solve::Control::Limits& limits,
                            const std::function<void(const solve::SearchProgress&)>& progress) {
  constexpr double kCoarser = 2;
  constexpr int kTries = 6;
  if (most > 0) {
    most = std::max<std::uint64_t>(most, whole.cover.boxes.size() / 4 * 5);
    options.max_found = most + 1;
  }
  const solve::Control all(limits);
  const auto tried = [&](const auto& attempt) {
    solve::Control control(all.rest(0, 0));
    control.search_progress = progress;
    attempt(control);
    return control.ending();
  };
  for (int tries = 0; tries < kTries && (tries == 0 || !all.ended()); ++tries, options.coarser *= kCoarser) {
    result::Result result;
    const std::optional<solve::Ending> ending =
        tried([&](solve::Control& control) { result = cut(whole, options, control); });
    const bool fits = !ending && (most == 0 || result.cover.boxes.size() <= most);
    if (fits || (ending && ending->by == solve::Limit::interrupt)) return result;
  }
  return whole;
}

}  // namespace corank::study
