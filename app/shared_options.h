// What the command lines of several subcommands have: values and ranges by name, what ends a search or an analysis, --json.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "corank/analyze/clearance/ball.h"
#include "corank/app/exit_status.h"
#include "corank/solve/step/options.h"

namespace corank::app {

/// "a=1,b=[2,3]" in its parts, at commas outside of parentheses and brackets.
std::vector<std::string> parts_of(const std::vector<std::string>& texts);
/// Throws UsageError, with what was expected.
std::pair<std::string, std::string> split_at_equals(const std::string& text, const std::string& option,
                                                    const std::string& expected);
/// An expression of the model language, in which 15deg is an angle of 15 degrees.
symbolic::Expression expression(const std::string& text, const std::string& option);
/// Throws UsageError where two of the list have one name.
template <class Named>
void expect_each_once(const std::vector<Named>& list, const std::string& option) {
  for (const Named& one : list)
    if (std::ranges::count(list, one.name, &Named::name) > 1)
      throw UsageError(fmt::format("{}: '{}' is given twice; expected each name once", option, one.name));
}
/// NAME=VALUE, comma by comma, each name once.
std::vector<analyze::NamedValue> named_values(const std::vector<std::string>& texts, const std::string& option);

/// An option and what a help calls its value: add_option(sub, "--at NAME=VALUE,...", at, "The values"). Of a list one word
/// each time it is given.
template <class Value>
CLI::Option* add_option(CLI::App& sub, const std::string& words, Value& value, const std::string& text) {
  const std::size_t blank = words.find(' ');
  CLI::Option* const option = sub.add_option(words.substr(0, blank), value, text)->type_name(words.substr(blank + 1));
  if constexpr (std::is_same_v<Value, std::vector<std::string>>) option->allow_extra_args(false);
  return option;
}

/// As CLI::NonNegativeNumber and CLI::PositiveNumber, whose messages give the largest double in 309 digits.
CLI::Validator not_negative();
CLI::Validator positive();

/// --orientation and --orientation-of, which may be without effect.
struct OrientationOptions {
  std::string turns, of;

  /// `what_for`: "Orientation of a spatial robot", `of_what`: "The link".
  void add_options(CLI::App& sub, const std::string& what_for, const std::string& of_what = "The link");
  /// Nothing, unless it is given. Throws UsageError where only the link is, symbolic::ModelError.
  std::optional<analyze::Rotation> rotation() const;
};

/// What ends a search; solve::Options::validate() says which numbers make sense.
struct SearchLimits {
  int threads = 0;
  std::uint64_t max_boxes = 0, max_found = 0;
  double time_limit = 0;
  std::optional<std::uint64_t> memory_limit{};  ///< bytes; nothing: three quarters of what the machine grants

  /// --threads, --max-boxes, --max-found, --time-limit, --memory-limit. `search`: "the search" or "each search".
  void add_options(CLI::App& sub, const std::string& search);
  /// Puts them into the options, which are not validated.
  void apply(solve::Options& options) const;
};

/// --threads and --time-limit, of an analysis that says what is proven by then.
void add_analysis_limits(CLI::App& sub, int& threads, double& seconds);
/// --threads alone.
void add_threads(CLI::App& sub, int& threads);
/// --time-limit alone, of a command that gives the whole of its output or none.
void add_time_limit(CLI::App& sub, double& seconds, const std::string& end = "End after SECONDS, without output");

/// Throws UsageError where one of the options is given, which another one or the input leaves without effect: "--grid:
/// without effect; expected REASON".
void refuse_without_effect(const CLI::App& sub, const std::vector<std::string>& options, const std::string& expected);

/// --json [PATH]: the result as JSON, to PATH or to standard output, in every subcommand that gives a result.
class JsonOption {
 public:
  /// `what`: of what the JSON is, `table`: what stands on standard output without it.
  void add(CLI::App& sub, const std::string& what = "the result", const std::string& table = "the table");

  bool given() const { return option_ && option_->count() > 0; }
  /// Standard output holds the JSON, and nothing else.
  bool takes_standard_output() const { return given() && path().empty(); }
  /// Of the file, "" for standard output. Requires that it is given.
  std::string path() const { return path_.value_or(""); }

  /// check(), once the input is known: in `--json FILE` without another file CLI11 took it for the path. `name`: "FILE".
  /// Throws UsageError where there is no input either way.
  void begin(std::string& input, const std::string& name = "FILE");
  /// Throws as check_output() does.
  void check() const;
  /// Writes or prints the text, where it is asked for. True: the table is to be printed, too.
  bool say(const std::function<std::string()>& text) const;

 private:
  const CLI::Option* option_ = nullptr;
  std::optional<std::string> path_;
};

}  // namespace corank::app
