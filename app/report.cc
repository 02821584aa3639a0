// corank report: solves all sets of a mechanism and writes one HTML page about them, with the result files beside it.

#include <filesystem>
#include <list>
#include <map>

#include "corank/app/box_files.h"
#include "corank/app/set_search.h"
#include "corank/app/subcommands.h"
#include "corank/report/html/page.h"
#include "corank/report/pictures/figures.h"
#include "corank/result/files/verification.h"
#include "corank/result/values/sentences.h"
#include "corank/study/answer.h"
#include "corank/study/cut.h"
#include "corank/study/images.h"
#include "corank/symbolic/sets/set_parts.h"

namespace corank::app {
namespace {

struct ReportCommand {
  QuestionOptions question;
  SetSearch search{1, set_names(true), {}, {}, {.max_found = report::kPageBoxes, .time_limit = report::kPageSeconds}};
  std::vector<std::string> results;
  std::string folder;
  JsonOption json;
};

/// The robot as drawn, without its tolerances.
study::Question as_drawn(study::Question question) {
  for (const symbolic::Constant& c : question.model.constants()) {
    if (!c.tolerance) continue;
    std::erase_if(question.constants, [&](const result::ConstantOverride& own) { return own.name == c.name; });
    question.constants.push_back({c.name, c.value.text()});
  }
  question.model = question.model.nominal();
  return question;
}

/// Writes each set's file, too, with `suffix` behind its name. `left_out`: sets of very many parts whose equations took
/// longer than their search may.
std::vector<report::SetView> solve_all(const ReportCommand& command, const study::Question& question,
                                       std::vector<std::string>& files, std::vector<std::string>& left_out,
                                       const std::string& suffix = "") {
  std::vector<report::SetView> views;
  std::uint64_t taken = 0;
  // After an interrupt the searches left end at once, with all of their domain pending.
  for (std::size_t i = 0; i < command.search.sets.size(); ++i) {
    const auto write = [&](const result::Result& result) {
      ProgressLine line;
      files.push_back(result.set + suffix + ".h5");
      line.show("writing " + files.back());
      result::write_result(std::filesystem::path(command.folder) / files.back(), result,
                           [] { return Interrupt::stop().load(); });
    };
    std::optional<report::SetView> view = solve_view(command.search, question, i, taken, write);
    if (!view) {
      left_out.push_back(command.search.sets[i]);
      continue;
    }
    views.push_back(std::move(*view));
    taken += solve::bytes_of(views.back().result.cover, solve::kPageBytes);
  }
  return views;
}

/// Aspects of curves and surfaces, within the time that a search may take.
std::optional<report::PageAspects> aspects_of(const ReportCommand& command, const study::Question& question,
                                              const std::vector<report::SetView>& views) {
  const SearchLimits& limits = command.search.limits;
  solve::Control control(of_command({.time = limits.time_limit}));
  ProgressLine line("aspects");
  line.follow(control);
  std::vector<const result::Result*> results;
  for (const report::SetView& view : views) results.push_back(&view.result);
  return report::page_aspects(question, results, limits.threads,
                              fmt::format("{} s, which --time-limit sets", limits.time_limit), control);
}

struct ReadView {
  std::string path;
  symbolic::Mechanism model;
  report::SetView view;
};

ReadView read_one(const std::string& path) {
  auto [result, model, system] = result::read_to_show(path);
  const std::size_t uncut = study::is_whole(result) ? result.cover.boxes.size() : 0;
  if (uncut > 0) result = study::cut_for_page(result, {.threads = 0}, report::kPageBoxes, {});
  if (auto images = study::with_images(result, report::kPageBoxes)) result = std::move(*images);
  report::SetView view = report::set_view(model, std::move(result), std::move(system));
  ReadView read{path, std::move(model), std::move(view)};
  if (uncut > 0) note_cut(uncut, read.view);
  return read;
}

/// Reads results of one model, and brings them and their paths into the order of the sets' definitions. Returns the model,
/// that of the first.
symbolic::Mechanism read_all(std::vector<std::string>& paths, std::vector<report::SetView>& views) {
  std::map<const symbolic::SetDefinition*, ReadView> by_set;
  for (const std::string& path : paths) {
    ReadView read = read_one(path);
    const symbolic::SetDefinition* set = read.view.set;
    const auto [place, added] = by_set.try_emplace(set, std::move(read));
    if (!added)
      throw result::ResultFileError(
          fmt::format("{}: holds the set {}, which {} holds already", path, set->name, place->second.path));
    const ReadView& other = (place == by_set.begin() ? *by_set.rbegin() : *by_set.begin()).second;
    const result::Result &a = place->second.view.result, &b = other.view.result;
    if (a.model_text != b.model_text || a.options.constants != b.options.constants)
      throw result::ResultFileError(
          fmt::format("{} and {} are results of different models, or with different constants", path, other.path));
  }
  paths.clear();
  for (auto& [set, read] : by_set) {
    paths.push_back(read.path);
    views.push_back(std::move(read.view));
  }
  return std::move(by_set.begin()->second.model);
}

// To the sets, where nobody chose others.
void add_requirements(const CLI::App& sub, ReportCommand& command, const symbolic::Mechanism& mechanism) {
  const std::string set = symbolic::to_string(symbolic::SingularitySet::requirements);
  const bool chosen = sub.count("--sets") > 0, asked = !command.question.require.empty();
  if (chosen && asked && std::ranges::find(command.search.sets, set) == command.search.sets.end())
    throw UsageError(fmt::format("--require: without effect; expected --sets {}", set));
  if (chosen || mechanism.requirements().empty() || !command.results.empty()) return;
  try {
    constexpr auto kSet = symbolic::SingularitySet::requirements;
    for (const symbolic::SetPart& part : symbolic::set_parts(mechanism, kSet))
      static_cast<void>(symbolic::SetEquations(mechanism, kSet, part));
    command.search.sets.push_back(set);
  } catch (const symbolic::ModelError& error) {
    if (asked) throw;
    fmt::print(stderr, "corank: the page is without the set {}: {}\n", set, result::printable(error.what()));
  }
}

ExitStatus write_report(const CLI::App& sub, ReportCommand command) {
  if (!command.results.empty())
    refuse_without_effect(sub,
                          {"--loops", "--sets", "--corank", "--require", "-D", "--sigma", "--cspace-sigma", "--threads",
                           "--max-boxes", "--max-found", "--time-limit", "--memory-limit", "--proof"},
                          "a model in place of --results, whose sets are not solved again");
  command.search.check_effect(sub);
  command.results.empty() ? command.json.begin(command.question.file) : command.json.check();
  if (!command.results.empty() && !command.question.file.empty())
    throw UsageError("--results: expected no FILE beside it: the results hold their model");
  command.search.validate();
  static auto* const kept = new std::list<std::vector<report::SetView>>;  // not freed: the process ends with the command
  std::vector<report::SetView>& views = kept->emplace_back();
  std::vector<report::SetView>& drawn = kept->emplace_back();  // of the robot as drawn, where constants have tolerances
  const study::Question question =
      command.results.empty() ? load(command.question) : study::Question{.model = read_all(command.results, views)};
  const symbolic::Mechanism& mechanism = question.model;
  if (mechanism.is_plain_system())
    throw symbolic::ModelError({mechanism.name(), 0, 0}, "the model names no inputs and outputs",
                               "a mechanism, with [INPUTS] and [OUTPUTS]");
  add_requirements(sub, command, mechanism);
  if (command.folder.empty()) command.folder = mechanism.name() + "-report";
  const std::filesystem::path folder = command.folder;
  check_folder(folder);

  LimitedRun run({});
  const solve::InStage stage(run.control(), solve::Stage::page);
  report::PageOptions options;
  std::vector<std::string> left_out;
  if (views.empty()) {
    views = solve_all(command, question, options.files, left_out);
    for (const std::string& set : left_out)
      fmt::print(stderr, "corank: {}: its equations were not derived in time; it is left out\n", set);
    if (views.empty()) return kIncomplete;
    std::vector<std::string> files;
    if (!mechanism.toleranced().empty()) drawn = solve_all(command, as_drawn(question), files, left_out, "-as-drawn");
    options.command = command.search.command_line("report", command.question);
  } else {
    options.command = "corank report --results " + fmt::format("{}", fmt::join(command.results, " "));
    for (const std::string& path : command.results) options.files.push_back(std::filesystem::path(path).filename().string());
  }
  if (command.results.empty()) options.aspects = aspects_of(command, question, views);
  report::Figures figures;
  {
    ProgressLine line;
    std::vector<report::PictureSource> sources;
    for (const report::SetView& view : views)
      sources.push_back(report::picture_view(view.result, drawn.empty() ? view.result.set : "every robot"));
    for (const report::SetView& view : drawn) sources.push_back(report::picture_view(view.result, "as drawn"));
    figures = report::write_figures(folder, mechanism, std::move(sources),
                                    {&Interrupt::stop(), [&line](const std::string& text) { line.show(text); }});
    options.figures = figures.files;
    line.show("page");
    result::write_text(folder / "index.html", report_page(mechanism, views, options));
  }

  bool complete = !figures.stopped && left_out.empty();
  for (const auto* list : {&views, &drawn})
    for (const auto& view : *list) complete = complete && view.result.cover.complete() && view.result.stopped.empty();
  const bool table = command.json.say(
      [&] { return report::page_summary(mechanism.name(), (folder / "index.html").string(), options, views, complete); });
  if (table)
    for (const auto& view : views) fmt::print("{}: {}\n", view.words.title, view.words.finding);
  for (const auto& view : views)
    if (warn_of_assembly(view.result)) break;  // it is the same of the others
  if (table) fmt::print("{}\n", result::printable_line((folder / "index.html").string()));
  if (complete) return kDone;
  for (const auto* list : {&views, &drawn})
    for (const auto& view : *list)
      if (!view.result.cover.complete() || !view.result.stopped.empty())
        fmt::print(stderr, "corank: {}: {}\n", view.result.set, study::stopped_words(view.result));
  if (figures.stopped) fmt::print(stderr, "corank: stopped by an interrupt, in the stage figures\n");
  fmt::print(stderr, "corank: the report is incomplete, and says what is missing\n");
  return kIncomplete;
}

}  // namespace

void add_report(CLI::App& program, Action& action) {
  CLI::App* sub = program.add_subcommand("report", "Solve several sets of a mechanism and write a web page about them");
  const auto command = std::make_shared<ReportCommand>();
  command->question.add_model(*sub);
  command->search.add_sets(*sub);
  command->question.add_corank(*sub);
  command->question.add_require(*sub, "The page shows where one of them reaches its limit");
  command->question.add_definitions(*sub);
  command->search.limits.add_options(*sub, "each search");
  sub->add_flag("--proof", command->search.proof,
                "Record each search in its result file, so that corank verify can check that no solution is missing");
  sub->add_option("--results", command->results, "Write the page about these results of one model, instead of solving")
      ->type_name("RESULT.h5...");
  command->json.add(*sub, "the contents of the page");
  add_option(*sub, "-o FOLDER", command->folder,
             "Folder for index.html, the results and the figures; default: MODEL-report");
  sub->footer(
      "Each search ends after 8 seconds or 200000 boxes, unless you give other limits. So the page is there within a\n"
      "minute. It says which sets are incomplete. Result files of surfaces keep proven sheets whole, unless you give\n"
      "--sigma; the page shows them cut.\n\n"
      "Exit status: 0 done and complete, 1 bad input, 2 wrong usage, 3 incomplete (a limit or an interrupt).\n\n"
      "Example:\n  corank report models/dextar.cuik -o dextar");
  sub->callback([command, sub, &action] { action = [command, sub] { return write_report(*sub, *command); }; });
}

}  // namespace corank::app
