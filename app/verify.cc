// corank verify: re-checks a result file against the model that it holds, with the independent checker.
#include <fmt/format.h>

#include <chrono>
#include <memory>

#include "corank/app/interrupt.h"
#include "corank/app/progress.h"
#include "corank/app/subcommands.h"
#include "corank/report/result_file.h"
#include "corank/report/verification.h"

namespace corank::app {
namespace {

constexpr auto kInterval = std::chrono::milliseconds(100);  // between two pictures of the progress

struct VerifyCommand {
  std::string input;
  bool json = false;
  int threads = 1;
};

report::Verification check(const report::Result& result, int threads) {
  using Clock = std::chrono::steady_clock;
  const Interrupt interrupt;
  ProgressLine line;
  certify::checker::Options options;
  options.threads = threads;
  options.stop = &Interrupt::stop();
  if (line.visible()) {
    options.progress = [&line, next = Clock::now()](const certify::checker::Progress& p) mutable {
      if (Clock::now() < next) return;
      next = Clock::now() + kInterval;
      line.show(p.steps == 0 ? fmt::format("{} of {} boxes", p.boxes, p.all_boxes)
                             : fmt::format("step {} of {}", p.steps, p.all_steps));
    };
  }
  return report::verify(result, options);
}

ExitStatus verify(const VerifyCommand& command) {
  const report::Result result = report::read_result(command.input);
  const report::Verification verification = check(result, command.threads);
  fmt::print("{}", command.json ? report::to_json(verification) + "\n" : report::to_table(verification, result));
  if (verification.verified()) return kDone;
  return verification.report.interrupted ? kIncomplete : kBadInput;
}

}  // namespace

void add_verify(CLI::App& program, Action& action) {
  CLI::App* sub =
      program.add_subcommand("verify", "Check a result against its model, with code that shares nothing with the solver");
  const auto command = std::make_shared<VerifyCommand>();
  sub->add_option("RESULT", command->input, "The result (.h5)")->required();
  sub->add_flag("--json", command->json, "Print JSON instead of the table");
  sub->add_option("--threads", command->threads, "Threads; 0: one for each core")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  sub->footer(
      "Every box is proven again from the model in the file: with intervals of 160 bits where its verdict is regular,\n"
      "isolated or boundary, in exact arithmetic where it is exact or has an exact point. An undecided box without one,\n"
      "a partial and a pending box are not checkable. Where the file holds a proof that the cover is complete, it is "
      "replayed.\n\n"
      "Exit status: 0 all verified, 1 something failed or is not checkable, 2 usage, 3 interrupted.\n\n"
      "Example:\n  corank solve models/dextar.cuik --set forward -o forward.h5\n  corank verify forward.h5");
  sub->callback([command, &action] { action = [command] { return verify(*command); }; });
}

}  // namespace corank::app
