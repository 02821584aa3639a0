// What corank report, sweep and path share: sets of a mechanism that are searched for a page, with the same options.
#pragma once

#include <functional>

#include "corank/app/question.h"
#include "corank/app/shared_options.h"
#include "corank/report/html/set_view.h"
#include "corank/solve/search/solve.h"

namespace corank::app {

struct SetSearch {
  double coarser = 1;  ///< the default of sigma, multiplied
  std::vector<std::string> sets;
  std::optional<double> sigma{}, cspace_sigma{};
  SearchLimits limits{};
  bool proof = false;

  /// --sets, --sigma, --cspace-sigma.
  void add_sets(CLI::App& command);

  /// Throws UsageError where an option is given that concerns none of the sets.
  void check_effect(const CLI::App& command) const;
  /// Throws solve::OptionError where a number is out of its range, whatever the system.
  void validate() const;
  /// For the system of a set. Throws solve::OptionError.
  solve::Options options(const System& system, symbolic::SingularitySet set) const;
  /// What is to end the search of one more set whose boxes come on a page, where others take `taken` bytes.
  solve::Control::Limits limits_beside(const solve::Options& options, std::uint64_t taken) const;

  /// What a user types for sets of this size: "corank report dextar.cuik --sigma 0.1 -D 'l2=1'".
  std::string command_line(const std::string& subcommand, const QuestionOptions& question) const;

 private:
  solve::Options options_of(symbolic::SingularitySet set) const;
};

/// report::say_cut, also on standard error where it does not show them cut.
void note_cut(std::size_t uncut, report::SetView& view);

/// Searches set `index` of those that `search` names, showing its progress; others on the page take `taken` bytes. Nothing
/// where the set has many parts and time ran out, or a signal came, before the equations of all were derived. `found` gets
/// the result with its proven sheets whole, unless σ is asked for, before they are cut for the page.
std::optional<report::SetView> solve_view(const SetSearch& search, study::Question question, std::size_t index,
                                          std::uint64_t taken, const std::function<void(const result::Result&)>& found = {});

}  // namespace corank::app
