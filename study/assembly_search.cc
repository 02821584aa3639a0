#include "corank/study/search_steps.h"

#include <algorithm>
#include <optional>

#include "corank/solve/search/solve.h"
#include "corank/symbolic/model/set_definition.h"

namespace corank::study {
namespace {

constexpr std::uint64_t kMostBoxes = 200'000;     // of each search for a configuration
constexpr std::uint64_t kMostBoxesNear = 20'000;  // of that with rounded coefficients
constexpr double kFine = 0.01;                // of the default sigma: a box that is not proven at this size may be far off
constexpr std::uint64_t kSheets[] = {1, 64};  // the first one may leave the ranges

// By one thread, whose answer is always the same.
Cover search(const System& system, const solve::Options& options, solve::Control& control) {
  return solve::solve(solve::prepare(system, options, control), control);
}

bool is_inside(const CoverBox& box) { return box.verdict == Verdict::regular || box.verdict == Verdict::isolated; }

// The sheet's solution over the middle of its free variables, by a proof of its own: a narrow box.
std::optional<Cover> at_its_middle(const System& system, const CoverBox& sheet, solve::Control& control) {
  solve::Options options{.sigma = solve::kWhole, .roots = {sheet.box}};
  for (const int v : sheet.free) {
    Interval& side = options.roots.front()[v];
    side = Interval(side.mid());
  }
  Cover cover = search(system, options, control);
  if (!std::ranges::any_of(cover.boxes, is_inside)) return std::nullopt;
  return cover;
}

// A cover of one configuration's neighbourhood; or of all C-space, without a box where that is proven empty.
Cover find_configuration(const System& system, solve::Control& control) {
  Cover cover;
  for (const std::uint64_t sheets : kSheets) {
    solve::Options options{.sigma = solve::kWhole, .max_solutions = sheets, .proof = system.coefficient_tolerance == 0};
    cover = search(system, options, control);
    for (const CoverBox& box : cover.boxes) {
      if (!is_inside(box) && box.verdict != Verdict::boundary) continue;
      if (std::optional<Cover> middle = at_its_middle(system, box, control)) return std::move(*middle);
    }
    if (cover.complete() || control.search_ended()) break;
  }
  return cover;
}

// Are there solutions once the coefficients that are no integers are taken within a rounding of their size?
bool has_nearly_a_solution(System system, solve::Control& control) {
  if (system.coefficient_tolerance > 0) return false;
  system.coefficient_tolerance = result::kRounding;
  const Cover cover = search(system, {.coarser = kFine, .max_solutions = 1}, control);
  const auto ending = control.ending();  // by the first proven sheet, which then is not cut
  return (ending && ending->by == solve::Limit::solutions) || std::ranges::any_of(cover.boxes, [](const CoverBox& box) {
           return box.verdict == Verdict::partial || holds_a_solution(box);
         });
}

}  // namespace

void search_assembly(const Question& question, solve::Control& control, result::Result& result) {
  if (!result.cover.complete() || !result.cover.boxes.empty() || control.ended()) return;
  Question asked{.model = question.model,
                 .set = question.set ? std::optional(symbolic::SingularitySet::cspace) : std::nullopt,
                 .constants = question.constants,
                 .tolerance = question.tolerance};
  const System system = study::system(asked);
  bool empty = true;
  const auto note = [&](const solve::Control& part) {
    const auto ending = part.ending();
    if (ending && part.ended() && result.stopped.empty()) result.stopped = to_string(*ending);
  };
  if (!symbolic::definition(question.set).is_cspace() && question.set) {
    solve::Control part(control.rest(0, kMostBoxes));
    Cover cover = find_configuration(system, part);
    empty = cover.complete() && cover.boxes.empty();
    std::optional<solve::Ending> ending = part.ending();
    if (ending && ending->by == solve::Limit::solutions) ending.reset();  // the search's own
    result.assembly = {describe(asked, system, {.search = {.max_boxes = part.limits().boxes}}, std::move(cover), ending)};
    note(part);
  }
  if (!empty || control.ended()) return;
  solve::Control part(control.rest(0, kMostBoxesNear));
  result.nearly_solved = has_nearly_a_solution(system, part);
  note(part);
}

}  // namespace corank::study
