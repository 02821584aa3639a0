#include "corank/studio/session.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "corank/analyze/sets/standing.h"
#include "corank/core/requirement.h"
#include "corank/report/html/live_page.h"
#include "corank/report/html/page.h"
#include "corank/report/pictures/set_look.h"
#include "corank/result/files/verification.h"
#include "corank/solve/search/solve.h"
#include "corank/study/answer.h"
#include "corank/study/search_steps.h"
#include "corank/symbolic/model/evaluate.h"
#include "corank/symbolic/model/model_error.h"

namespace corank::studio {
namespace {

using Json = nlohmann::ordered_json;
using symbolic::SingularitySet;
using Clock = std::chrono::steady_clock;

/// The default of σ, multiplied: a first picture is coarse; the finer one has C-space in fewer boxes than a report, since
/// they are drawn while one looks.
constexpr double kCoarse = 6, kFine = 1, kFineCspace = 2.5;
/// The first picture goes out at once, another one when the last one is this old: sets that are found quickly come together.
constexpr std::chrono::milliseconds kBetweenPictures{25};

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

/// What is wrong, without the place before it, which the page shows at its line.
Json error_event(const symbolic::ModelError& error) {
  std::string text = error.what();
  const std::string place = error.where().text() + ": ";
  if (text.starts_with(place)) text.erase(0, place.size());
  const bool of_text = !error.where().file.starts_with("-D ") && error.where().file != "requirement";
  return {{"event", "error"},
          {"message", of_text ? text : error.where().file + ": " + text},
          {"line", of_text ? error.where().line : 0},
          {"column", of_text ? error.where().column : 0}};
}

class Answer {
 public:
  Answer(const Request& request, const Emit& emit, const std::atomic<bool>& stop, const SessionLimits& limits)
      : request_(request), emit_(emit), stop_(stop), limits_(limits) {}

  void run() {
    say({{"event", "begun"}});
    study::Model model = study::parse_model(request_.model, request_.constants, request_.loops);
    study::require(request_.require, model);
    if (stop_) return;
    if (model.mechanism.is_plain_system())
      throw symbolic::ModelError({model.mechanism.name(), 0, 0}, "the model names no inputs and outputs",
                                 "a mechanism, with [INPUTS] and [OUTPUTS]");
    say_model(model);
    question_ = {
        .model = std::move(model.mechanism), .constants = request_.constants, .assembly = std::move(model.assembly)};
    derivation_ = symbolic::derive(question_.model);
    const bool for_page = request_.want == Request::Want::report;
    if (!for_page) pass(0);
    if (for_page || request_.fine) pass(1);
    if (for_page) return make_report();
    if (request_.colours == Request::Colours::aspects && !stop_) say_aspects();
    if (request_.colours == Request::Colours::requirements && !stop_) say_requirements();
    if (!stop_) say({{"event", "done"}, {"complete", complete_}, {"seconds", seconds_since(begin_)}});
  }

  void say(Json event) const {
    event["number"] = request_.number;
    emit_(event.dump(-1, ' ', false, Json::error_handler_t::replace));
  }

 private:
  struct Found {
    study::Systems systems;
    std::optional<report::SetView> view;
  };

  void say_model(const study::Model& model) const {
    Json constants = Json::array(), sets = Json::array();
    const std::map<std::string, double> values = symbolic::constant_values(model.mechanism);
    for (const symbolic::Constant& c : model.mechanism.constants()) {
      Json entry = {{"name", c.name}, {"value", values.at(c.name)}, {"text", c.value.text()}};
      if (c.tolerance)
        entry["tolerance"] = {symbolic::evaluate(c.tolerance->lower, values),
                              symbolic::evaluate(c.tolerance->upper, values)};
      constants.push_back(std::move(entry));
    }
    for (const symbolic::SetDefinition& set : symbolic::set_definitions()) {
      if (set.of_requirements && model.mechanism.requirements().empty()) continue;
      sets.push_back({{"name", set.name}, {"title", report::look(set).member}, {"usual", set.is_usual()}});
    }
    say({{"event", "model"},
         {"name", model.mechanism.name()},
         {"constants", constants},
         {"sets", sets},
         {"notices", model.notices},
         {"dimension", model.mechanism.drawing().dimension()},
         {"requirements", model.mechanism.requirement_texts()}});
  }

  /// Loci before C-space, which takes longest.
  std::vector<std::string> order() const {
    std::vector<std::string> sets = request_.sets;
    std::ranges::stable_partition(sets, [](const std::string& s) { return !symbolic::definition(s).is_cspace(); });
    return sets;
  }

  void pass(int number) {
    for (const std::string& set : order()) {
      if (stop_) return;
      if (refused_.contains(set)) continue;
      try {
        search(set, number);
      } catch (const symbolic::ModelError& error) {
        refused_.insert(set);
        found_.erase(set);
        say({{"event", "refused"}, {"set", set}, {"message", error_event(error)["message"]}});
        continue;
      }
      if (!stop_ && Clock::now() - last_picture_ > kBetweenPictures) say_picture(number);
    }
    if (!stop_) say_picture(number);
  }

  void search(const std::string& set, int pass) {
    const bool coarse = pass == 0, seen = request_.want == Request::Want::picture;
    solve::Control control({.time = coarse ? limits_.coarse_seconds : limits_.seconds,
                            .memory = limits_.memory,
                            .stop = &stop_,
                            .later_bytes = solve::kPageBytes});
    control.search_progress = [&](const solve::SearchProgress& p) {
      say({{"event", "progress"},
           {"set", set},
           {"stage", to_string(control.stage())},
           {"pass", pass},
           {"share", p.excluded},
           {"boxes", p.processed}});
    };
    Found& found = found_[set];
    if (found.systems.of_parts.empty() || found.systems.of_parts.size() < found.systems.parts.size()) {
      study::Question question = question_;
      question.set = symbolic::singularity_set_from_string(set);
      found.systems = study::systems_of(question, control, false);
      if (found.systems.of_parts.size() < found.systems.parts.size()) {
        complete_ = complete_ && coarse && request_.fine;
        return;
      }
    }
    study::Options options;
    options.search.coarser = coarse ? kCoarse : symbolic::definition(set).is_cspace() && seen ? kFineCspace : kFine;
    options.search.threads = limits_.threads;
    options.search.max_found = (seen ? limits_.boxes : report::kPageBoxes) / found.systems.parts.size() + 1;
    options.digits = coarse ? 0 : report::kPageDigits;
    result::Result result =
        coarse ? searched_only(found.systems, options, control) : study::answer(found.systems, options, control);
    if (stop_) return;
    if (!coarse || !request_.fine) complete_ = complete_ && result.cover.complete();
    System system =
        found.systems.parts.front().part ? result::system_of(question_.model, result) : found.systems.of_parts.front();
    found.view = report::set_view(question_.model, std::move(result), std::move(system),
                                  [&] { return control.overdue() || stop_.load(); });
    news_.push_back(set);
  }

  /// As study::answer(), without what it proves exactly once the search is done: that takes longer than the search.
  static result::Result searched_only(const study::Systems& systems, const study::Options& options,
                                      solve::Control& control) {
    std::vector<result::Result> results;
    for (std::size_t i = 0; i < systems.parts.size(); ++i) {
      const study::Asked asked = study::prepare(systems.parts[i], systems.of_parts[i], options, control, false);
      Cover cover = solve::solve(asked.prepared, control);
      results.push_back(study::describe(systems.parts[i], systems.of_parts[i], options, std::move(cover), control.ending()));
    }
    return study::join(systems.parts, std::move(results));
  }

  void say_picture(int pass) {
    if (request_.want == Request::Want::report) return;
    std::vector<const report::SetView*> views;
    for (const std::string& set : request_.sets)
      if (std::ranges::find(news_, set) != news_.end()) views.push_back(&*found_.at(set).view);
    if (views.empty()) return;
    const std::string model = report::live_model(question_.model, derivation_, views);
    emit_(fmt::format(R"({{"event":"picture","number":{},"pass":{},"seconds":{:.4f},"model":{}}})", request_.number, pass,
                      seconds_since(begin_), model));
    news_.clear();
    last_picture_ = Clock::now();
  }

  std::optional<report::PageAspects> aspects_of(const std::vector<const result::Result*>& results) const {
    solve::Control control({.time = limits_.analysis_seconds, .memory = limits_.memory, .stop = &stop_});
    return report::page_aspects(question_, results, limits_.threads, fmt::format("{:g} seconds", limits_.analysis_seconds),
                                control);
  }

  void say_aspects() {
    std::vector<const result::Result*> results;
    for (const auto& [set, found] : found_)
      if (found.view) results.push_back(&found.view->result);
    const auto aspects = aspects_of(results);
    if (stop_) return;
    const std::string unknown =
        "Nothing is known of aspects: they need C-space as a whole, of dimension 1 or 2, and as many inputs as outputs.";
    say_colours(aspects ? aspects->summary : unknown, aspects ? report::aspects_json(*aspects) : "null");
  }

  void say_colours(const std::string& summary, const std::string& colours) const {
    say({{"event", "colours"}, {"summary", summary}, {"colours", Json::parse(colours)}});
  }

  /// Of each box of C-space: are the requirements met in all of it, in none of it, or is that open?
  void say_requirements() {
    const auto of = [](const auto& entry) { return symbolic::definition(entry.first).is_cspace() && entry.second.view; };
    const auto cspace = std::ranges::find_if(found_, of);
    if (question_.model.requirements().empty() || cspace == found_.end())
      return say_colours("There are no requirements, or no C-space.", "null");
    try {
      study::Question question = question_;
      question.set = SingularitySet::cspace;
      const analyze::Standings standings(question.model, study::equations(question));
      report::PageAspects shades;
      shades.labels = {"met", "not met", "open"};
      for (const CoverBox& b : cspace->second.view->drawn()) {
        if (stop_) return;
        shades.places.push_back(static_cast<int>(standings.of(b.box)));
      }
      Json colours = Json::parse(report::aspects_json(shades));
      colours["colours"] = {"#4f9f78", "#9a6a9f", "#dcae3a"};
      say_colours("Requirements, proven box by box:", colours.dump());
    } catch (const symbolic::ModelError& error) {
      say_colours(error.what(), "null");
    }
  }

  void make_report() {
    std::vector<report::SetView> views;
    for (const std::string& set : request_.sets) {
      const auto at = found_.find(set);
      if (at != found_.end() && at->second.view) views.push_back(std::move(*at->second.view));
    }
    if (stop_) return;
    report::PageOptions options{.command = request_.command, .figures = {}, .files = {}};
    std::vector<const result::Result*> results;
    for (const report::SetView& view : views) results.push_back(&view.result);
    options.aspects = aspects_of(results);
    if (stop_) return;
    say({{"event", "report"}, {"name", question_.model.name()}, {"html", report_page(question_.model, views, options)}});
    say({{"event", "done"}, {"complete", complete_}, {"seconds", seconds_since(begin_)}});
  }

  const Request& request_;
  const Emit& emit_;
  const std::atomic<bool>& stop_;
  const SessionLimits limits_;
  const Clock::time_point begin_ = Clock::now();
  Clock::time_point last_picture_{};
  study::Question question_{symbolic::Mechanism("")};
  symbolic::Derivation derivation_;
  std::map<std::string, Found> found_;
  std::set<std::string> refused_;
  std::vector<std::string> news_;  // sets found since the last picture
  bool complete_ = true;
};

}  // namespace

void answer(const Request& request, const Emit& emit, const std::atomic<bool>& stop, const SessionLimits& limits) {
  Answer answer(request, emit, stop, limits);
  const auto fail = [&](const std::string& message) {
    answer.say({{"event", "error"}, {"message", message}, {"line", 0}, {"column", 0}});
  };
  try {
    answer.run();
  } catch (const symbolic::ModelError& error) {
    answer.say(error_event(error));
  } catch (const std::bad_alloc&) {
    fail("out of memory");
  } catch (const std::exception& error) {
    fail(error.what());
  }
}

}  // namespace corank::studio
