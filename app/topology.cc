// corank topology: the shape of a C-space, or of the solutions of a plain system.
#include "corank/analyze/topology/topology.h"

#include "corank/app/subcommands.h"
#include "corank/result/values/claim_files.h"

namespace corank::app {
namespace {

struct TopologyCommand {
  QuestionOptions question;
  analyze::TopologyOptions options;
  double time_limit = 0;
  JsonOption json;
  std::string output;
};

ExitStatus topology(TopologyCommand command) {
  command.json.begin(command.question.file);
  if (!command.output.empty() && !command.output.ends_with(".h5"))
    throw UsageError(fmt::format("-o {}: expected a file name that ends in .h5", command.output));
  if (!command.output.empty()) result::check_writable(command.output);
  command.options.certificate = !command.output.empty();
  LimitedRun run({.time = command.time_limit});
  solve::Control& control = run.control();
  const study::Question question = load(command.question);
  ProgressLine line;
  line.follow(control);
  const analyze::Topology result = analyze::topology(question, command.options, control);
  line.clear();
  if (command.json.say([&] { return to_json(question, result); }))
    fmt::print("{}", result::printable(to_text(question, result)));
  if (!result.stopped.empty()) return stopped_early(result.stopped);
  if (command.output.empty()) return kDone;
  if (!result.certificate) {
    fmt::print(stderr,
               "corank: {} is not written: expected a set that is proven to be smooth, of dimension 1 or more and without "
               "ends\n",
               result::printable_line(command.output));
    return kBadInput;
  }
  result::write_shape(command.output, to_file(question, result), [&control] { return control.ended(); });
  return kDone;
}

}  // namespace

void add_topology(CLI::App& program, Action& action) {
  CLI::App* sub =
      program.add_subcommand("topology",
                             "Find the pieces, the Euler characteristic and the genus of C-space (the set of all "
                             "configurations) or, if the model has no inputs and outputs, of its set of solutions");
  const auto command = std::make_shared<TopologyCommand>();
  command->question.add_model(*sub);
  command->question.add_definitions(*sub);
  add_analysis_limits(*sub, command->options.threads, command->time_limit);
  sub->add_option(
         "-o,--output", command->output,
         "Write a certificate that corank verify checks: boxes, links and critical points; only for a set without ends")
      ->type_name("FILE.h5");
  command->json.add(*sub);
  sub->footer(
      "Every number is proven. If corank cannot prove the exact number, it prints proven bounds and says what stands in\n"
      "the way.\n\n"
      "Exit status: 0 done, 1 bad input or no certificate to write, 2 wrong usage, 3 stopped by a limit or an interrupt.\n\n"
      "Examples:\n  corank topology models/dextar.cuik\n  corank topology models/dextar.cuik -o shape.h5\n  corank verify "
      "shape.h5");
  sub->callback([command, &action] { action = [command] { return topology(*command); }; });
}

}  // namespace corank::app
