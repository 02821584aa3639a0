// corank sweep: solves the sets of a family of mechanisms that differ in one constant and writes one HTML page about them,
// with the result files and small multiples for a paper beside it.

#include <filesystem>
#include <set>

#include "corank/app/box_files.h"
#include "corank/app/family.h"
#include "corank/app/set_search.h"
#include "corank/app/subcommands.h"
#include "corank/report/html/family_page.h"
#include "corank/report/pictures/figures.h"
#include "corank/study/answer.h"
#include "corank/study/early_searches.h"
#include "corank/study/model.h"
#include "corank/symbolic/model/model_error.h"

namespace corank::app {
namespace {

struct SweepCommand {
  QuestionOptions question;
  SetSearch search{report::kFamilyCoarser, {"cspace", "forward", "inverse"}};
  std::string folder;
  JsonOption json;
};

/// A member before it is solved.
struct Plan {
  std::string value;
  study::Question question;
  std::vector<System> systems;                              ///< of the sets
  std::vector<std::optional<solve::Labelling>> labellings;  ///< likewise
};

/// A robot's equations depend on its constants: at special values its axes are parallel, and it has other coordinates.
void check_alike(const std::string& constant, const Plan& first, const Plan& other) {
  const auto names = [](const Plan& p) {
    std::vector<std::string> list;
    for (const symbolic::Coordinate& c : p.question.model.coordinates()) list.push_back(c.name);
    return list;
  };
  if (names(first) == names(other)) return;
  const auto words = [](const Plan& p) {
    return p.question.assembly ? study::describe(*p.question.assembly)
                               : fmt::format("{} coordinates", p.question.model.coordinates().size());
  };
  throw UsageError(
      fmt::format("at {} = {} the mechanism has other coordinates ({}) than at {} ({}); expected the same coordinates",
                  constant, other.value, words(other), first.value, words(first)));
}

/// All of them before the first search, so that a value that makes no mechanism is known at once.
std::vector<Plan> plan_all(const SweepCommand& command, const Family& family) {
  std::vector<Plan> plans;
  std::set<std::string> said;
  for (std::size_t k = 0; k < family.values.size(); ++k) {
    QuestionOptions options = command.question;
    options.definitions = definitions_of(family, k, command.question.definitions);
    Plan& p = plans.emplace_back(Plan{family.values[k], load(options, &said), {}, {}});
    check_alike(family.constant, plans.front(), p);
    for (const std::string& name : command.search.sets) {
      if (symbolic::definition(name).of_parts)
        throw UsageError(
            fmt::format("--sets {}: corank sweep cannot draw this set; corank solve computes it for one mechanism", name));
      p.question.set = symbolic::singularity_set_from_string(name);
      p.systems.push_back(study::system(p.question));
      p.labellings.push_back(study::labelling(p.question, p.systems.back()));
    }
  }
  return plans;
}

study::Options options_of(const SweepCommand& command, const Plan& plan, std::size_t set) {
  return {command.search.options(plan.systems[set], *symbolic::singularity_set_from_string(command.search.sets[set]))};
}

/// In the order in which solve_all() comes to them; `found` takes how their boxes hang together.
std::vector<study::EarlyTask> early_tasks(const SweepCommand& command, const std::vector<Plan>& plans,
                                          std::vector<report::Components>& found) {
  const std::size_t sets = command.search.sets.size();
  found.resize(plans.size() * sets);
  std::vector<study::EarlyTask> tasks;
  for (const Plan& plan : plans) {
    for (std::size_t s = 0; s < sets; ++s) {
      const study::Options options = options_of(command, plan, s);
      tasks.push_back({symbolic::singularity_set_from_string(command.search.sets[s]), plan.systems[s], plan.labellings[s],
                       options, command.search.limits_beside(options.search, 0), s});
      tasks.back().then = [&to = found[tasks.size() - 1], size = plan.systems[s].configuration_size](const Cover& cover) {
        to = report::components(cover.boxes, size);
      };
    }
  }
  return tasks;
}

/// The searches of all members, some ahead of their turn.
class Searches {
 public:
  Searches(const SweepCommand& command, const std::vector<Plan>& plans)
      : command_(command), plans_(plans), early_(early_tasks(command, plans, components_), command.search.limits.threads) {}

  /// `taken`: bytes of those before.
  report::SetView solve(std::size_t member, std::size_t set, const std::string& task, std::uint64_t taken) {
    const Plan& plan = plans_[member];
    study::Question question = plan.question;
    question.set = symbolic::singularity_set_from_string(command_.search.sets[set]);
    const System& system = plan.systems[set];
    const study::Options options = options_of(command_, plan, set);
    ProgressLine line(task);
    line.show(task);  // searches may be too short to tell more
    const std::size_t number = member * command_.search.sets.size() + set;
    std::optional<Cover> early = early_.take(number);
    const solve::Control::Limits limits = command_.search.limits_beside(options.search, taken);
    const bool has_room = limits.memory == 0 || limits.memory > study::EarlySearches::kBytes;  // or it may have been ended
    if (early && has_room)
      return report::set_view(question.model, study::describe(question, system, options, std::move(*early), {}), system,
                              std::move(components_[number]));
    solve::Control control(limits);
    line.follow(control);
    return report::set_view(question.model, study::answer(question, system, options, control), system,
                            [&control] { return control.overdue(); });
  }

 private:
  const SweepCommand& command_;
  const std::vector<Plan>& plans_;
  std::vector<report::Components> components_;  ///< of what is found ahead
  study::EarlySearches early_;
};

/// Describes member after member and writes each result at once. An interrupt ends the searches that are on. The one whose
/// turn it is leaves what is not searched pending; so do the member's sets behind it, and further members are left out. The
/// first one is there in any case.
std::vector<report::FamilyMember> solve_all(const SweepCommand& command, const std::vector<Plan>& plans,
                                            const std::string& constant) {
  std::vector<report::FamilyMember> members;
  std::uint64_t taken = 0;
  Searches searches(command, plans);
  for (std::size_t k = 0; k < plans.size() && (k == 0 || !Interrupt::stop()); ++k) {
    report::FamilyMember member{plans[k].value, plans[k].question.model, {}, {}};
    for (std::size_t s = 0; s < command.search.sets.size(); ++s) {
      const std::string task =
          fmt::format("{} = {} ({} of {}), {}", constant, plans[k].value, k + 1, plans.size(), command.search.sets[s]);
      member.sets.push_back(searches.solve(k, s, task, taken));
      const result::Result& result = member.sets.back().result;
      taken += solve::bytes_of(result.cover, solve::kPageBytes);
      member.files.push_back(report::member_file(k, plans.size(), command.search.sets[s]));
      result::write_result(std::filesystem::path(command.folder) / member.files.back(), result,
                           [] { return Interrupt::stop().load(); });
    }
    members.push_back(std::move(member));
  }
  return members;
}

report::Figures draw_members(const std::filesystem::path& folder, const std::vector<report::FamilyMember>& members,
                             const report::FamilyOptions& options) {
  ProgressLine line;
  std::vector<std::vector<report::PictureSource>> sources;
  std::vector<std::string> titles;
  for (const report::FamilyMember& member : members) {
    titles.push_back(options.constant + " = " + member.value);
    sources.emplace_back();
    for (const report::SetView& view : member.sets)
      sources.back().push_back(report::picture_view(view.result, view.result.set));
  }
  return report::write_family_figures(folder, sources, {options.axes.begin(), options.axes.end()}, titles,
                                      {&Interrupt::stop(), [&line](const std::string& text) { line.show(text); }});
}

ExitStatus write_sweep(const CLI::App& sub, SweepCommand command) {
  command.search.check_effect(sub);
  command.json.begin(command.question.file);
  command.search.validate();
  const Family family = family_of(command.question.definitions);
  const std::vector<Plan> plans = plan_all(command, family);
  const symbolic::Mechanism& first = plans.front().question.model;
  const std::vector<std::string> axes = report::portrait_axes(first, first.outputs());
  if (axes.size() < 2) throw UsageError(fmt::format("{}: a portrait needs two coordinates that vary", first.name()));
  if (command.folder.empty()) command.folder = first.name() + "-sweep";
  const std::filesystem::path folder = command.folder;
  check_folder(folder);

  LimitedRun run({});
  const solve::InStage stage(run.control(), solve::Stage::page);
  const std::vector<report::FamilyMember> members = solve_all(command, plans, family.constant);
  report::FamilyOptions options;
  options.constant = family.constant;
  options.axes = {axes[0], axes[1]};
  options.asked = plans.size();
  options.command = command.search.command_line("sweep", command.question);
  QuestionOptions first_member = command.question;
  first_member.definitions = definitions_of(family, 0, command.question.definitions);
  options.report_command = command.search.command_line("report", first_member);
  const report::Figures figures = draw_members(folder, members, options);
  options.figures = figures.files;
  result::write_text(folder / "index.html", family_page(members, options));

  bool complete = members.size() == plans.size() && !figures.stopped;
  for (const report::FamilyMember& member : members) {
    for (const report::SetView& view : member.sets) {
      const result::Result& result = view.result;
      if (!result.stopped.empty())
        fmt::print(stderr, "corank: {} = {}, {}: {}\n", family.constant, member.value, result.set,
                   study::stopped_words(result));
      complete = complete && result.cover.complete() && result.stopped.empty();
    }
  }
  if (command.json.say([&] {
        return report::family_summary(first.name(), family.constant, (folder / "index.html").string(), members, complete);
      })) {
    for (const report::FamilyMember& member : members)
      for (const report::SetView& view : member.sets)
        fmt::print("{} = {}, {}: {}\n", family.constant, member.value, view.words.title, view.words.finding);
    fmt::print("{}\n", (folder / "index.html").string());
  }
  if (complete) return kDone;
  fmt::print(stderr, "corank: {} of {} mechanisms are on the page{}, which says what is incomplete\n", members.size(),
             plans.size(), Interrupt::stop() ? ", stopped by an interrupt," : "");
  return kIncomplete;
}

}  // namespace

void add_sweep(CLI::App& program, Action& action) {
  CLI::App* sub = program.add_subcommand(
      "sweep", "Solve a family of mechanisms that differ in one constant, and write one page about it");
  const auto command = std::make_shared<SweepCommand>();
  command->question.add_model(*sub);
  add_option(*sub, "-D NAME=FROM:TO:COUNT|NAME=EXPR", command->question.definitions,
             "NAME=FROM:TO:COUNT: give one constant COUNT equally spaced values from FROM to TO;\n"
             "NAME=EXPR: give another constant the same new value in all mechanisms; may be repeated");
  command->search.add_sets(*sub);
  command->search.limits.add_options(*sub, "each search");
  command->json.add(*sub, "the contents of the page");
  add_option(*sub, "-o FOLDER", command->folder, "Folder for index.html, the results and the figures; default: MODEL-sweep");
  sub->footer(
      "Exit status: 0 done and complete, 1 bad input, 2 wrong usage, 3 incomplete (a limit or an interrupt).\n\n"
      "Example: a link of Dextar shrinks from 1.6 to 0.9\n"
      "  corank sweep models/dextar.cuik -D l2=1.6:0.9:8 -o family");
  sub->callback([command, sub, &action] { action = [command, sub] { return write_sweep(*sub, *command); }; });
}

}  // namespace corank::app
