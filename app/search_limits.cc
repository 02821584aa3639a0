#include "corank/app/search_limits.h"

#include <fmt/format.h>

#include "corank/solve/machine_memory.h"

namespace corank::app {

void SearchLimits::add_options(CLI::App& command, const std::string& search) {
  const auto default_text = [](double value) { return value > 0 ? fmt::format("{:g}", value) : std::string("none"); };
  command.add_option("--threads", threads, "Threads; 0: one for each core")->capture_default_str();
  command
      .add_option("--max-boxes", max_boxes,
                  fmt::format("End {} after so many processed boxes; 0: no limit; default: {}", search,
                              default_text(static_cast<double>(max_boxes))))
      ->check(CLI::NonNegativeNumber);
  command
      .add_option("--max-found", max_found,
                  fmt::format("End {} after so many found boxes, proven or undecided; 0: no limit; default: {}", search,
                              max_found > 0 ? std::to_string(max_found) : "none"))
      ->type_name("N")
      ->check(CLI::NonNegativeNumber);
  command
      .add_option("--time-limit", time_limit,
                  fmt::format("End {}, and what follows it, after so many seconds; 0: no limit; default: {}", search,
                              default_text(time_limit)))
      ->type_name("SECONDS");
  command
      .add_option("--memory-limit", memory_limit,
                  fmt::format("End {} when its boxes take so much memory, such as 800M or 8G; 0: no limit;\n"
                              "default: three quarters of the machine's",
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

}  // namespace corank::app
