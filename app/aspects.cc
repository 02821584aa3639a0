// corank aspects: the pieces into which its singularities divide a mechanism's C-space.
#include "corank/analyze/aspects.h"

#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "corank/app/interrupt.h"
#include "corank/app/progress.h"
#include "corank/app/question.h"
#include "corank/app/subcommands.h"
#include "corank/certify/angle.h"
#include "corank/result/printable.h"

namespace corank::app {
namespace {

struct AspectsCommand {
  QuestionOptions question;
  analyze::AspectsOptions options;
  double time_limit = 0;
  bool json = false;
};

struct Value {
  std::string name;
  Interval value;
};

std::vector<Value> values(const System& system, const Box& box) {
  std::vector<Value> result;
  for (std::size_t j = 0; j < system.variables.size(); ++j)
    if (system.variables[j].kind == VariableKind::length) result.push_back({system.variables[j].name, box[j]});
  for (const Angle& a : system.angles)
    result.push_back({a.name, certify::angle_enclosure(box[static_cast<std::size_t>(a.cosine)],
                                                       box[static_cast<std::size_t>(a.sine)], a.range)});
  return result;
}

std::string bounds(const analyze::Pieces& p) {
  if (p.exact()) return std::to_string(p.at_least);
  return p.at_most ? fmt::format("from {} to {} ({})", p.at_least, *p.at_most, p.reason)
                   : fmt::format("at least {} ({})", p.at_least, p.reason);
}

std::string to_text(const study::Question& question, const analyze::Aspects& a) {
  std::string text = question.model.name() + "\n";
  if (!a.reason.empty()) return text + "  not known: " + a.reason + "\n";
  text += fmt::format("  aspects         {}\n  assembly modes  {}\n  working modes   {}\n", bounds(a.aspects),
                      bounds(a.assembly_modes), bounds(a.working_modes));
  text += fmt::format("  det L_y = 0 where {}\n",
                      a.forward_factors.empty() ? "never" : fmt::format("{} = 0", fmt::join(a.forward_factors, " = 0 or ")));
  text += fmt::format("  det L_z = 0 where {}\n",
                      a.inverse_factors.empty() ? "never" : fmt::format("{} = 0", fmt::join(a.inverse_factors, " = 0 or ")));
  text += "A configuration of each aspect:\n";
  for (std::size_t k = 0; k < a.aspects.representatives.size(); ++k) {
    text += fmt::format("  {:>3}", k + 1);
    for (const Value& v : values(a.system, a.aspects.representatives[k]))
      text += fmt::format("  {} {:.4f}", v.name, v.value.mid());
    text += "\n";
  }
  return text;
}

std::string to_json(const study::Question& question, const analyze::Aspects& a, bool complete) {
  using Json = nlohmann::ordered_json;
  const auto or_null = [](const std::optional<int>& x) { return x ? Json(*x) : Json(); };
  const auto bounds = [&](const analyze::Pieces& p) {
    return Json{{"at_least", p.at_least}, {"at_most", or_null(p.at_most)}};
  };
  const auto number = [](const analyze::Pieces& p) { return p.exact() ? Json(p.at_least) : Json(); };
  Json json;
  json["model"] = question.model.name();
  json["aspects"] = bounds(a.aspects);
  json["assembly_modes"] = number(a.assembly_modes);
  json["working_modes"] = number(a.working_modes);
  json["bounds"] = {{"assembly_modes", bounds(a.assembly_modes)}, {"working_modes", bounds(a.working_modes)}};
  json["factors"] = {{"forward", a.forward_factors}, {"inverse", a.inverse_factors}};
  json["representatives"] = Json::array();
  for (std::size_t k = 0; k < a.aspects.representatives.size(); ++k) {
    Json entry = {{"values", Json::object()}, {"signs", a.aspects.signs[k]}};
    for (const Value& v : values(a.system, a.aspects.representatives[k]))
      entry["values"][v.name] = {{"lo", v.value.lo()}, {"hi", v.value.hi()}};
    json["representatives"].push_back(entry);
  }
  json["reason"] = !a.reason.empty() ? a.reason : a.aspects.reason;
  json["complete"] = complete;
  return json.dump(2);
}

ExitStatus aspects(const AspectsCommand& command) {
  solve::Control control({.time = command.time_limit, .stop = &Interrupt::stop()});
  const study::Question question = load(command.question);
  if (question.model.is_plain_system())
    throw UsageError(fmt::format("{} names no inputs and outputs: a plain system has no aspects", command.question.file));
  const Interrupt interrupt;
  ProgressLine line;
  line.follow(control);
  const analyze::Aspects result = analyze::aspects(question, command.options, control);
  line.clear();
  const bool complete = !control.ended();
  fmt::print("{}", command.json ? to_json(question, result, complete) + "\n" : result::printable(to_text(question, result)));
  if (complete) return kDone;
  fmt::print(stderr, "corank: stopped by {}; what is said is proven, but more could be\n", to_string(*control.ending()));
  return kIncomplete;
}

}  // namespace

void add_aspects(CLI::App& program, Action& action) {
  CLI::App* sub = program.add_subcommand(
      "aspects", "The pieces into which singularities divide a C-space: aspects, assembly modes, working modes");
  const auto command = std::make_shared<AspectsCommand>();
  command->question.add_model(*sub);
  command->question.add_definitions(*sub);
  sub->add_option("--threads", command->options.threads, "Threads of the search; 0: one for each core")
      ->capture_default_str();
  sub->add_option("--time-limit", command->time_limit, "End after so many seconds with what is proven by then; 0: no limit")
      ->type_name("SECONDS")
      ->check(CLI::NonNegativeNumber);
  sub->add_flag("--json", command->json, "Print the result as JSON");
  sub->footer(
      "aspects: pieces of C-space without forward and inverse singularities; assembly modes: without forward ones;\n"
      "working modes: without inverse ones. Every number is proven; where one is not, bounds are given.\n\n"
      "Exit status: 0 done, 1 bad input, 2 usage, 3 stopped by a limit or an interrupt.\n\n"
      "Example:\n  corank aspects models/dextar.cuik");
  sub->callback([command, &action] { action = [command] { return aspects(*command); }; });
}

}  // namespace corank::app
