// The part of a command line that subcommands share: which model, which of its sets, which kernel, which constants.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "corank/study/question.h"

namespace corank::app {

/// The sets of a mechanism, in the order in which a report has them; `usual`: those that it has unless it is told which.
std::vector<std::string> set_names(bool usual = false);

/// What --set calls symbolic::nodes_of().
inline constexpr const char* kNodes = "nodes";

/// What the options say, not yet checked.
struct QuestionOptions {
  std::string file, set, kernel, loops;
  std::vector<std::string> definitions;  ///< each "NAME=EXPR"
  std::vector<std::string> outputs;      ///< in place of the model's, for the workspace's boundary
  std::vector<std::string> require;      ///< requirements, beside the model's own
  int corank = 1;                        ///< of the sets with a kernel

  /// FILE, --loops, --set, --kernel, --corank, --require and -D. `of_set`: what the set is for, before the words that choose
  /// it. `boundary`: may it be the workspace's boundary, for which there is --outputs then?
  void add_options(CLI::App& sub, const std::string& of_set = "Which configurations of a mechanism",
                   const std::string& of_requirements = "For --set requirements", bool boundary = true);
  /// FILE and --loops.
  void add_model(CLI::App& sub);
  void add_corank(CLI::App& sub);
  void add_outputs(CLI::App& sub);
  /// --require. `what_for`: what the command does with them.
  void add_require(CLI::App& sub, const std::string& what_for);
  /// -D alone.
  void add_definitions(CLI::App& sub);
  /// What a user types for this model: "corank path dextar.cuik -D 'l2=1'".
  std::string command_line(const std::string& subcommand) const;
};

/// Reads the model and puts the constants of the options in: the question, but for its set. Tells the notices about the
/// file, without those that were `said` before. Throws ModelError, UsageError.
study::Question load(const QuestionOptions& options, std::set<std::string>* said = nullptr);

/// The set that is asked for: nothing for a plain system. Throws UsageError where a mechanism is given and no set, or a set
/// of a plain system is asked for.
std::optional<symbolic::SingularitySet> chosen_set(const QuestionOptions& options, const symbolic::Mechanism& mechanism);

}  // namespace corank::app
