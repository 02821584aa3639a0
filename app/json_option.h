// --json [PATH]: the result as JSON, to PATH or to standard output, in every subcommand that gives a result.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <optional>
#include <string>

namespace corank::app {

class JsonOption {
 public:
  /// `what`: of what the JSON is, `table`: what stands on standard output without it.
  void add(CLI::App& sub, const std::string& what = "the result", const std::string& table = "the table");

  bool given() const { return option_ && option_->count() > 0; }
  /// Standard output holds the JSON, and nothing else.
  bool takes_standard_output() const { return given() && path().empty(); }
  /// Of the file, "" for standard output. Requires that it is given.
  std::string path() const { return path_.value_or(""); }

  /// `--json FILE` without another file: CLI11 took it for the path. `name`: "FILE". Throws UsageError where there is no
  /// input either way.
  void give_back(std::string& input, const std::string& name = "FILE");
  /// Throws as check_output() does.
  void check() const;
  /// Writes or prints the text, where it is asked for. True: the table is to be printed, too.
  bool say(const std::function<std::string()>& text) const;

 private:
  const CLI::Option* option_ = nullptr;
  std::optional<std::string> path_;
};

}  // namespace corank::app
