#include "corank/app/path_report.h"

#include <algorithm>
#include <filesystem>

#include "corank/app/set_search.h"
#include "corank/report/pictures/set_look.h"
#include "corank/result/files/result_file.h"

namespace corank::app {
namespace {

// What is not found goes to `missing`.
std::vector<report::SetView> portrayed_sets(const study::Question& question, int threads, const solve::Control& control,
                                            std::vector<std::string>& missing) {
  constexpr double kTimeOfEach = 4, kCoarserBackground = 3;
  constexpr std::uint64_t kMostBoxes = 100'000;
  std::vector<report::SetView> views;
  for (const char* name : {"cspace", "forward", "inverse"}) {
    const symbolic::SetDefinition& set = symbolic::definition(std::string(name));
    if (control.ended()) {
      missing.emplace_back(report::look(set).title);
      continue;
    }
    const SetSearch search{
        .coarser = set.is_cspace() ? kCoarserBackground : 1,
        .sets = {name},
        .limits = {
            .threads = threads, .max_found = kMostBoxes, .time_limit = std::min(kTimeOfEach, control.seconds_left())}};
    try {
      std::optional<report::SetView> view = solve_view(search, question, 0, 0);
      if (view && view->result.cover.complete())
        views.push_back(std::move(*view));
      else
        missing.emplace_back(report::look(set).title);
    } catch (const symbolic::ModelError&) {  // the model does not answer such a question
      missing.emplace_back(report::look(set).title);
    }
  }
  return views;
}

}  // namespace

void write_path_page(const std::string& file, const study::Question& question, const report::PathView& view,
                     const std::string& line, const std::string& tube, int threads, const solve::Control& control) {
  report::PathPageOptions options{.command = line, .file = std::filesystem::path(tube).filename().string()};
  const std::vector<report::SetView> sets = portrayed_sets(question, threads, control, options.missing);
  result::write_text(file, report::path_page(question.model, view, sets, options));
}

}  // namespace corank::app
