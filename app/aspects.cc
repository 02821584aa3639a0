// corank aspects: the pieces into which its singularities divide a mechanism's C-space.
#include "corank/analyze/aspects/aspects.h"

#include "corank/analyze/maps/area_by_boundary.h"
#include "corank/app/subcommands.h"
#include "corank/report/html/page_aspects.h"
#include "corank/result/values/claim_files.h"

namespace corank::app {
namespace {

struct AspectsCommand {
  QuestionOptions question;
  analyze::AspectsOptions options;
  double time_limit = 0;
  JsonOption json;
  bool areas = false;
  std::string output;
};

ExitStatus aspects(AspectsCommand command) {
  command.json.begin(command.question.file);
  const bool drawn = command.output.ends_with(".svg");
  command.options.certificate = command.output.ends_with(".h5");
  if (!command.output.empty() && !drawn && !command.options.certificate)
    throw UsageError(fmt::format("-o {}: expected a file name that ends in .svg or .h5", command.output));
  LimitedRun run({.time = command.time_limit});
  solve::Control& control = run.control();
  const study::Question question = load(command.question);
  if (question.model.is_plain_system())
    throw UsageError(fmt::format("{} names no inputs and outputs: a plain system has no aspects", command.question.file));
  if (drawn) command.options.drawn = report::drawn_coordinates(question.model);
  if (command.areas && !analyze::is_plane_of_lengths(question.model, question.model.outputs()))
    throw UsageError(fmt::format("--areas: without effect; expected two outputs that are lengths, which {} does not have",
                                 command.question.file));
  if (command.areas) command.options.images = question.model.outputs();
  ProgressLine line;
  line.follow(control);
  const analyze::Aspects result = analyze::aspects(question, command.options, control);
  line.clear();
  if (drawn && result.stopped.empty()) {
    if (!result.drawing || result.drawing->pieces.empty())
      throw UsageError(fmt::format("{}: a picture needs aspects of two dimensions, with two outputs or two inputs",
                                   command.question.file));
    result::write_text(command.output, to_svg(report::aspects_picture(question.model.name(), result)));
  }
  if (command.json.say([&] { return to_json(question, result); }))
    fmt::print("{}", result::printable(to_text(question, result)));
  if (!result.stopped.empty()) return stopped_early(result.stopped);
  if (!command.options.certificate) return kDone;
  if (!result.cover) {
    fmt::print(stderr, "corank: {} is not written: nothing was found that it could prove\n",
               result::printable_line(command.output));
    return kBadInput;
  }
  result::write_pieces(command.output, to_file(question, result), [&control] { return control.ended(); });
  return kDone;
}

}  // namespace

void add_aspects(CLI::App& program, Action& action) {
  CLI::App* sub = program.add_subcommand(
      "aspects", "Find the pieces into which singularities divide a C-space: aspects, assembly modes, working modes");
  const auto command = std::make_shared<AspectsCommand>();
  command->question.add_model(*sub);
  command->question.add_require(*sub, "Only pieces in which all of them are met count");
  command->question.add_definitions(*sub);
  add_analysis_limits(*sub, command->options.threads, command->time_limit);
  sub->add_option(
         "-o", command->output,
         "A picture of the aspects over two outputs and over two inputs (.svg), or a certificate for corank verify (.h5)")
      ->type_name("FILE.svg|FILE.h5");
  sub->add_flag(
      "--areas", command->areas,
      "If the model has two outputs, both lengths: bound the area of the outputs that each aspect reaches, and say\n"
      "which aspects have outputs in common");
  sub->add_flag(
      "--cusps", command->options.cusps,
      "Find the cusps of the forward and of the inverse singularities. For each cusp, find the aspect in which the robot\n"
      "can move around the cusp from one configuration to another. Both have the same inputs if it is a cusp of the "
      "forward\n"
      "singularities, and the same outputs if it is a cusp of the inverse singularities");
  command->json.add(*sub);
  sub->footer(
      "C-space is the set of all configurations. Its pieces without forward and inverse singularities are the aspects. Its\n"
      "pieces without forward singularities are the assembly modes, those without inverse singularities are the working\n"
      "modes. corank proves the number of each, or bounds of it. Where something is required of the robot, by the model or\n"
      "by --require, the limits of the requirements are borders, too, and only pieces in which they are met count.\n\n"
      "Exit status: 0 done; 1 bad input, or there is nothing to write to the file of -o; 2 wrong usage; 3 stopped by a\n"
      "limit or an interrupt.\n\n"
      "Examples:\n  corank aspects models/dextar.cuik\n  corank aspects models/dextar.cuik -o aspects.svg\n"
      "  corank aspects models/dextar.cuik --require 'amplification(outputs) <= 2'\n"
      "  corank aspects models/dextar.cuik -o aspects.h5\n  corank verify aspects.h5");
  sub->callback([command, &action] { action = [command] { return aspects(*command); }; });
}

}  // namespace corank::app
