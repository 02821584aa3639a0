#include "corank/app/search_limits.h"

#include <fmt/format.h>

#include "corank/app/exit_status.h"
#include "corank/solve/memory.h"

namespace corank::app {

void SearchLimits::add_options(CLI::App& command, const std::string& search) {
  const auto default_text = [](double value) {
    return value > 0 ? fmt::format("0: no limit; default: {:.15g}", value) : std::string("0: no limit (default)");
  };
  command.add_option("--threads", threads, "Number of threads; 0: one for each core")->capture_default_str();
  command
      .add_option("--max-boxes", max_boxes,
                  fmt::format("End {} after N processed boxes; {}", search, default_text(static_cast<double>(max_boxes))))
      ->type_name("N")
      ->check(CLI::NonNegativeNumber);
  command
      .add_option("--max-found", max_found,
                  fmt::format("End {} when it has found N boxes, proven or undecided; {}", search,
                              default_text(static_cast<double>(max_found))))
      ->type_name("N")
      ->check(CLI::NonNegativeNumber);
  command
      .add_option("--time-limit", time_limit,
                  fmt::format("After SECONDS, end {} and the work that follows it; {}", search, default_text(time_limit)))
      ->type_name("SECONDS");
  command
      .add_option("--memory-limit", memory_limit,
                  fmt::format("End {} when its boxes take BYTES of memory, such as 800M or 8G; 0: no limit;\n"
                              "default: three quarters of the machine's memory",
                              search))
      ->type_name("BYTES")
      ->transform(CLI::AsSizeValue(false));
}

void SearchLimits::apply(solve::Options& options) const {
  options.threads = threads;
  options.max_boxes = max_boxes;
  options.max_found = max_found;
  options.time_limit = time_limit;
  options.memory_limit = memory_limit.value_or(solve::machine_memory() / 4 * 3);
}

void add_threads(CLI::App& command, int& threads) {
  command.add_option("--threads", threads, "Number of threads; 0: one for each core")
      ->check(CLI::Range(0, solve::kMostThreads))
      ->capture_default_str();
}

void add_time_limit(CLI::App& command, double& seconds, const std::string& end) {
  command.add_option("--time-limit", seconds, end + "; 0: no limit (default)")
      ->type_name("SECONDS")
      ->check(CLI::NonNegativeNumber);
}

void add_analysis_limits(CLI::App& command, int& threads, double& seconds, const std::string& end) {
  add_threads(command, threads);
  add_time_limit(command, seconds, end);
}

void refuse_without_effect(const CLI::App& sub, const std::vector<std::string>& options, const std::string& expected) {
  for (const std::string& name : options)
    if (sub.get_option(name)->count() > 0) throw UsageError(fmt::format("{}: without effect; expected {}", name, expected));
}

}  // namespace corank::app
