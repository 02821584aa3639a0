// corank verify: re-checks a result file against the model that it holds, with the independent checker.

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <random>

#include "corank/app/subcommands.h"
#include "corank/result/files/verification.h"
#include "corank/result/values/claim_files.h"

namespace corank::app {
namespace {

struct VerifyCommand {
  std::string input;
  JsonOption json;
  bool require_proof = false;
  int threads = 0;
  double time_limit = 0;
  std::size_t sample = 0;
};

result::Verification check(const result::Result& result, const System& system, const VerifyCommand& command,
                           const Ended& ended) {
  using Clock = std::chrono::steady_clock;
  ProgressLine line;
  check::Options options{.threads = command.threads, .progress = {}, .ended = ended, .sample = command.sample};
  if (command.sample > 0) options.seed = std::random_device()();  // nobody can have prepared the file for it
  if (line.visible()) {
    options.progress = [&line, next = Clock::now()](const check::Progress& p) mutable {
      if (Clock::now() < next) return;
      next = Clock::now() + ProgressLine::kRefreshInterval;
      line.show(p.steps == 0 ? fmt::format("{} of {} boxes", p.boxes, p.all_boxes)
                             : fmt::format("step {} of {}", p.steps, p.all_steps));
    };
  }
  return result::verify(result, system, options);
}

// Called where the work does not end although it was asked to; the other threads still run.
[[noreturn]] void give_up(const VerifyCommand& command, const std::string& stage) {
  if (command.json.say([&] { return result::ended_early_json(stage); }))
    fmt::print("{}: interrupted in {}: it is not known what was checked, so nothing is said about the file\n",
               result::printable_line(command.input), stage);
  std::fflush(nullptr);
  std::_Exit(kIncomplete);
}

// `complete`: nothing is missing either; `open`: the check ended early, and had found nothing wrong.
ExitStatus status(const VerifyCommand& command, bool complete, bool verified, bool open) {
  if (complete) return kDone;
  if (verified) return command.require_proof ? kBadInput : kNotShownComplete;
  return open ? kIncomplete : kBadInput;
}

ExitStatus status(const result::Verification& verification, const VerifyCommand& command) {
  const check::Report& report = verification.report;
  const bool good_sample = report.left_out > 0 && verification.contradictions.empty() && report.confirmed();
  return status(command, verification.complete(), verification.verified(),
                good_sample || (report.interrupted && report.failures.empty()));
}

// Reads a certificate, checks it, and prints what comes of it.
template <auto kRead>
ExitStatus verify_certificate(const VerifyCommand& command, Watch& watch, const Ended& ended) {
  const auto file = kRead(command.input);
  watch.enter("the check");
  const auto report = result::verify(file, {.threads = command.threads, .progress = {}, .ended = ended});
  watch.done();
  if (command.json.say([&] { return result::to_json(report, file); })) fmt::print("{}", result::to_table(report, file));
  return status(command, report.complete(), report.verified(), report.interrupted && report.failures.empty());
}

// The table and JSON name the stage of the check; what ended it is said here.
ExitStatus say_ending(ExitStatus status, const solve::Control& control) {
  if (status == kIncomplete && control.ended())
    fmt::print(stderr, "corank: stopped by {}\n", to_string(control.ending()->by));
  return status;
}

struct Certificate {
  const char* format;
  ExitStatus (*verify)(const VerifyCommand& command, Watch& watch, const Ended& ended);
};

constexpr std::array kCertificates{Certificate{result::kPathKind.format, &verify_certificate<&result::read_path>},
                                   Certificate{result::kShapeKind.format, &verify_certificate<&result::read_shape>},
                                   Certificate{result::kPiecesKind.format, &verify_certificate<&result::read_pieces>},
                                   Certificate{result::kMapKind.format, &verify_certificate<&result::read_map>}};

ExitStatus verify(VerifyCommand command) {
  command.json.begin(command.input, "RESULT");
  const Interrupt interrupt;
  Watch watch(command.time_limit, Interrupt::stop(), [&command](const std::string& stage) { give_up(command, stage); });
  const solve::Control control(of_command({.time = command.time_limit}));
  const Ended ended = [&] { return watch.stop() || control.ended(); };
  watch.enter("reading the file");
  const std::string format = result::format_of(command.input);
  const auto certificate =
      std::ranges::find(kCertificates, format, [](const Certificate& c) { return std::string(c.format); });
  if (certificate != kCertificates.end()) {
    if (command.sample > 0)
      throw UsageError(
          fmt::format("--sample: without effect; expected the result of a search, which {} is not", command.input));
    return say_ending(certificate->verify(command, watch, ended), control);
  }
  const result::Result result = result::read_result(command.input);
  watch.enter("deriving the equations from the model");
  const System system = result::system_of(result);
  watch.enter("the check");
  const result::Verification verification = check(result, system, command, ended);
  watch.done();
  if (command.json.say([&] { return result::to_json(verification); }))
    fmt::print("{}", result::to_table(verification, result));
  const ExitStatus result_status = status(verification, command);
  if (verification.verified() && result_status == kBadInput)
    fmt::print(stderr, "corank: --require-proof: this file does not prove that its boxes hold all solutions\n");
  return say_ending(result_status, control);
}

}  // namespace

void add_verify(CLI::App& program, Action& action) {
  CLI::App* sub =
      program.add_subcommand("verify", "Check a result against its model, with code that shares nothing with the solver");
  const auto command = std::make_shared<VerifyCommand>();
  sub->add_option("RESULT", command->input, "The result file (.h5)");
  command->json.add(*sub, "what it finds");
  sub->add_flag("--require-proof", command->require_proof,
                "Fail unless the file proves that its boxes hold all solutions in the search domain");
  add_threads(*sub, command->threads);
  add_option(*sub, "--sample N", command->sample,
             "Check only N boxes, chosen at random each time, and leave out the proof that no solution is missing;\n"
             "for files that take too long to check completely; 0: check all (default)")
      ->check(not_negative())
      ->excludes("--require-proof");
  add_time_limit(*sub, command->time_limit, "End the check after SECONDS");
  sub->footer(
      "corank verify proves again, from the model in the file, every box that claims something. It proves regular,\n"
      "isolated and boundary boxes with intervals of 160 bits. Exact boxes and points have coordinates that are known\n"
      "exactly, and it proves them in exact arithmetic. Pending boxes were not searched when the search ended early. They\n"
      "claim nothing, and neither do undecided boxes without an exact point. Partial boxes are proven for some of the\n"
      "equations only. They cannot be checked, so a file that has any is not verified (exit status 1). If the file holds\n"
      "a proof that no solution is missing (corank solve --proof), the proof is replayed.\n\n"
      "It also checks what these commands write:\n"
      "  corank path      the tube: the boxes that prove the path\n"
      "  corank topology  components, Euler characteristic and genus\n"
      "  corank aspects   a configuration of each aspect, assembly mode and working mode, the signs of the\n"
      "                   determinants there, and the bounds of how many of each there are\n"
      "  corank map       the number of solutions over each proven cell\n"
      "  corank clearance the files of --proof: a ball without a singularity, and a singularity near it\n\n"
      "Exit status:\n"
      "  0  every claim is verified, and it is proven that nothing is missing\n"
      "  1  a claim about a box, a point or a number is false or cannot be checked, or the file cannot\n"
      "     be read\n"
      "  2  wrong usage\n"
      "  3  ended early by a limit, an interrupt or --sample; nothing wrong was found until then\n"
      "  4  these claims are verified, but it is not proven that no solution, aspect or mode is missing:\n"
      "     the file has no proof of that, or its search had ended early, or a part of the proof could not\n"
      "     be checked near a self-motion (a set of larger dimension than the count of equations says);\n"
      "     if you give --require-proof, the status is 1 instead\n\n"
      "Examples:\n  corank solve models/dextar.cuik --set forward --proof -o forward.h5\n  corank verify forward.h5\n"
      "  corank topology models/dextar.cuik -o shape.h5\n  corank verify shape.h5");
  sub->callback([command, &action] { action = [command] { return verify(*command); }; });
}

}  // namespace corank::app
