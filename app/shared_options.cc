#include "corank/app/shared_options.h"

#include <fmt/format.h>

#include "corank/app/box_files.h"
#include "corank/app/exit_status.h"
#include "corank/result/files/result_file.h"
#include "corank/solve/store/memory.h"
#include "corank/symbolic/model/model_file.h"

namespace corank::app {

std::vector<std::string> parts_of(const std::vector<std::string>& texts) {
  std::vector<std::string> parts;
  for (const std::string& text : texts) {
    int depth = 0;
    parts.emplace_back();
    for (const char c : text) {
      depth += c == '(' || c == '[' ? 1 : c == ')' || c == ']' ? -1 : 0;
      if (c == ',' && depth == 0) {
        parts.emplace_back();
      } else {
        parts.back() += c;
      }
    }
  }
  return parts;
}

std::pair<std::string, std::string> split_at_equals(const std::string& text, const std::string& option,
                                                    const std::string& expected) {
  const std::size_t equals = text.find('=');
  if (equals == 0 || equals == std::string::npos || equals + 1 == text.size())
    throw UsageError(fmt::format("{} {}: expected {}", option, text, expected));
  return {text.substr(0, equals), text.substr(equals + 1)};
}

symbolic::Expression expression(const std::string& text, const std::string& option) {
  return symbolic::parse_expression(text, option + " " + text);
}

std::vector<analyze::NamedValue> named_values(const std::vector<std::string>& texts, const std::string& option) {
  std::vector<analyze::NamedValue> values;
  for (const std::string& part : parts_of(texts)) {
    const auto [name, value] = split_at_equals(part, option, "NAME=VALUE");
    values.push_back({name, expression(value, option)});
  }
  expect_each_once(values, option);
  return values;
}

namespace {

CLI::Validator in_words(const CLI::Validator& check, const std::string& expected) {
  return {[check, expected](std::string& text) { return check(text).empty() ? "" : text + " is not " + expected; }, ""};
}

}  // namespace

CLI::Validator not_negative() { return in_words(CLI::NonNegativeNumber, "a number of 0 or more"); }
CLI::Validator positive() { return in_words(CLI::PositiveNumber, "a positive number"); }

void OrientationOptions::add_options(CLI::App& sub, const std::string& what_for, const std::string& of_what) {
  add_option(sub, "--orientation R", turns, what_for);
  add_option(sub, "--orientation-of NAME", of, of_what + " that --orientation is for, if there are several");
}

std::optional<analyze::Rotation> OrientationOptions::rotation() const {
  if (!turns.empty()) return analyze::parse_rotation(turns);
  if (!of.empty()) throw UsageError("--orientation-of: without effect; expected --orientation beside it");
  return std::nullopt;
}

void SearchLimits::add_options(CLI::App& sub, const std::string& search) {
  const auto default_text = [](double value) {
    return value > 0 ? fmt::format("0: no limit; default: {:.15g}", value) : std::string("0: no limit (default)");
  };
  sub.add_option("--threads", threads, "Number of threads; 0: one for each core")->capture_default_str();
  add_option(sub, "--max-boxes N", max_boxes,
             fmt::format("End {} after N processed boxes; {}", search, default_text(static_cast<double>(max_boxes))))
      ->check(not_negative());
  add_option(sub, "--max-found N", max_found,
             fmt::format("End {} when it has found N boxes, proven or undecided; {}", search,
                         default_text(static_cast<double>(max_found))))
      ->check(not_negative());
  add_option(sub, "--time-limit SECONDS", time_limit,
             fmt::format("After SECONDS, end {} and the work that follows it; {}", search, default_text(time_limit)));
  add_option(sub, "--memory-limit BYTES", memory_limit,
             fmt::format("End {} when its boxes take BYTES of memory, such as 800M or 8G; 0: no limit;\n"
                         "default: three quarters of the machine's memory",
                         search))
      ->transform(CLI::AsSizeValue(false));
}

void SearchLimits::apply(solve::Options& options) const {
  options.threads = threads;
  options.max_boxes = max_boxes;
  options.max_found = max_found;
  options.time_limit = time_limit;
  options.memory_limit = memory_limit.value_or(solve::machine_memory() / 4 * 3);
}

void add_threads(CLI::App& sub, int& threads) {
  sub.add_option("--threads", threads, "Number of threads; 0: one for each core")
      ->check(CLI::Range(0, solve::kMostThreads))
      ->capture_default_str();
}

void add_time_limit(CLI::App& sub, double& seconds, const std::string& end) {
  add_option(sub, "--time-limit SECONDS", seconds, end + "; 0: no limit (default)")->check(not_negative());
}

void add_analysis_limits(CLI::App& sub, int& threads, double& seconds) {
  add_threads(sub, threads);
  add_time_limit(sub, seconds, "End after SECONDS with what is proven by then");
}

void refuse_without_effect(const CLI::App& sub, const std::vector<std::string>& options, const std::string& expected) {
  for (const std::string& name : options)
    if (sub.get_option(name)->count() > 0) throw UsageError(fmt::format("{}: without effect; expected {}", name, expected));
}

void JsonOption::add(CLI::App& sub, const std::string& what, const std::string& table) {
  option_ =
      sub.add_option_function<std::vector<std::string>>(
             "--json",
             [this](const std::vector<std::string>& words) { path_ = words.empty() || words[0] == "-" ? "" : words[0]; },
             fmt::format("Write {} as JSON to PATH or, without PATH, to standard output instead of {}", what, table))
          ->type_name("[PATH]")
          ->expected(0, 1);
}

void JsonOption::begin(std::string& input, const std::string& name) {
  if (input.empty() && path_ && !path_->empty()) input.swap(*path_);
  if (input.empty()) throw UsageError(name + " is required; corank --help tells more");
  check();
}

void JsonOption::check() const {
  if (given()) check_output(path());
}

bool JsonOption::say(const std::function<std::string()>& text) const {
  if (takes_standard_output())
    fmt::print("{}\n", text());
  else if (given())
    result::write_text(path(), text() + "\n");
  return !takes_standard_output();
}

}  // namespace corank::app
