#include "corank/app/set_search.h"

#include <fmt/format.h>

#include <algorithm>

#include "corank/app/limited_run.h"
#include "corank/app/progress.h"
#include "corank/app/watch.h"
#include "corank/report/html/page.h"
#include "corank/result/files/verification.h"
#include "corank/study/answer.h"
#include "corank/study/cut.h"
#include "corank/study/images.h"

namespace corank::app {
using symbolic::SingularitySet;
namespace {

// Errors of σ by the name that it has on the command line.
template <class F>
void name_errors(SingularitySet set, F validate) {
  try {
    validate();
  } catch (const solve::OptionError& error) {
    if (set == SingularitySet::cspace && error.option() == "sigma") throw solve::OptionError("cspace_sigma", error.reason());
    throw;
  }
}

}  // namespace

void SetSearch::add_sets(CLI::App& command) {
  command.add_option("--sets", sets, "The sets to solve, with commas")
      ->type_name("SET[,SET...]")
      ->delimiter(',')
      ->check(CLI::IsMember(set_names()))
      ->capture_default_str();
  command.add_option("--sigma", sigma,
                     "Largest edge of a box in sets of singularities; default: a share of the size of the set found");
  command.add_option("--cspace-sigma", cspace_sigma, "The same in C-space");
}

solve::Control::Limits SetSearch::limits_beside(const solve::Options& options, std::uint64_t taken) const {
  solve::Control::Limits result = of_command(limits_of(options));
  result.later_bytes = solve::kPageBytes;
  if (result.memory > 0) result.memory = result.memory > taken ? result.memory - taken : 1;
  return result;
}

solve::Options SetSearch::options_of(SingularitySet set) const {
  solve::Options options;
  options.sigma = symbolic::definition(set).is_cspace() ? cspace_sigma : sigma;
  options.coarser = coarser;
  limits.apply(options);
  options.proof = proof;
  return options;
}

void SetSearch::check_effect(const CLI::App& command) const {
  const auto any = [this](auto is) {
    return std::ranges::any_of(sets, [&](const std::string& s) { return is(symbolic::definition(s)); });
  };
  if (!any([](const symbolic::SetDefinition& d) { return d.is_cspace(); }))
    refuse_without_effect(command, {"--cspace-sigma"}, "cspace among --sets");
  if (!any([](const symbolic::SetDefinition& d) { return !d.is_cspace(); }))
    refuse_without_effect(command, {"--sigma"}, "--cspace-sigma, or another set than cspace among --sets");
}

void SetSearch::validate() const {
  options_of(SingularitySet::forward).validate();
  name_errors(SingularitySet::cspace, [this] { options_of(SingularitySet::cspace).validate(); });
}

solve::Options SetSearch::options(const System& system, SingularitySet set) const {
  const solve::Options options = options_of(set);
  name_errors(set, [&] { options.validate(system); });
  return options;
}

std::string SetSearch::command_line(const std::string& subcommand, const QuestionOptions& question) const {
  std::string text = question.command_line(subcommand);
  if (sigma) text += fmt::format(" --sigma {:g}", *sigma);
  if (cspace_sigma) text += fmt::format(" --cspace-sigma {:g}", *cspace_sigma);
  return text;
}

void note_cut(std::size_t uncut, report::SetView& view) {
  if (!report::say_cut(uncut, view))
    fmt::print(stderr, "corank: {}: its boxes are shown uncut: cut ones are too many for the page, or take too long\n",
               view.result.set);
}

std::optional<report::SetView> solve_view(const SetSearch& search, study::Question question, std::size_t index,
                                          std::uint64_t taken, const std::function<void(const result::Result&)>& found) {
  const std::vector<std::string>& sets = search.sets;
  question.set = symbolic::singularity_set_from_string(sets[index]);
  if (!symbolic::definition(question.set).has_kernel()) question.corank = 1;
  solve::Options limits;
  search.limits.apply(limits);
  const solve::Control::Limits limits_of_set = search.limits_beside(limits, taken);
  solve::Control control(limits_of_set);
  study::Systems systems = study::systems_of(question, control, false);
  if (systems.of_parts.size() < systems.parts.size()) return std::nullopt;
  study::Options options{search.options(systems.of_parts.front(), *question.set), report::kPageDigits};
  options.search.surfaces_whole = true;  // where no sigma is given
  ProgressLine line(fmt::format("{} ({} of {})", sets[index], index + 1, sets.size()));
  line.follow(control);
  result::Result result = study::answer(systems, options, control);
  line.clear();
  if (found) found(result);
  const std::size_t uncut = study::is_whole(result) ? result.cover.boxes.size() : 0;
  if (uncut > 0) {
    solve::Options page = options.search;
    page.surfaces_whole = page.proof = false;
    result = study::cut_for_page(result, page, search.limits.max_found, limits_of_set, control.search_progress);
  }
  if (auto images = study::with_images(result, report::kPageBoxes)) result = std::move(*images);
  System system =
      systems.parts.front().part ? result::system_of(question.model, result) : std::move(systems.of_parts.front());
  const solve::Control of_view(limits_of_set);
  report::SetView view = report::set_view(question.model, std::move(result), std::move(system),
                                          [&] { return of_view.overdue() || Interrupt::stop(); });
  if (uncut > 0) note_cut(uncut, view);
  return view;
}

}  // namespace corank::app
