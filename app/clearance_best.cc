// corank clearance --best: the centre of the largest ball in a region.
#include <fmt/format.h>

#include "corank/analyze/best_center.h"
#include "corank/app/box_files.h"
#include "corank/app/clearance_command.h"
#include "corank/app/limited_run.h"
#include "corank/app/output.h"
#include "corank/app/progress.h"
#include "corank/result/printable.h"
#include "corank/result/result_file.h"

namespace corank::app {

ExitStatus run_best(ClearanceCommand command) {
  command.json.give_back(command.question.file);
  const solve::Options search = options_of(command);
  search.validate();
  LimitedRun run(limits_of(search, nullptr));
  solve::Control& control = run.control();
  const analyze::BallOptions ball = ball_of(command);
  const study::Question question = question_of(command);
  const std::vector<analyze::NamedRange> region = region_of(command.best, "--best", question);
  command.json.check();
  ProgressLine line;
  analyze::BestOptions options{.precision = command.precision};
  options.progress = [&line](double lower, std::optional<double> upper, std::uint64_t cells) {
    line.show(upper ? fmt::format("radius in [{:.5g}, {:.5g}], {} cells", lower, *upper, cells)
                    : fmt::format("radius at least {:.5g}, {} cells", lower, cells));
  };
  const analyze::Best best = analyze::best_center(question, ball, region, options, search, control);
  line.clear();
  if (command.json.say([&] { return to_json(best); })) fmt::print("{}", result::printable(to_table(best)));
  if (best.complete) return kDone;
  fmt::print(stderr, "corank: {}the bounds hold, but are not as close as asked for\n",
             best.stopped.empty() ? "" : "stopped by " + best.stopped + "; ");
  return kIncomplete;
}

}  // namespace corank::app
