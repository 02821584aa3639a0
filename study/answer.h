// From a question to a certified result: solve, prove exactly what can be, describe. What the command line calls, and what
// C++ users do.
#pragma once

#include "corank/result/values/result.h"
#include "corank/solve/search/solve.h"
#include "corank/study/question.h"

namespace corank::study {

class RunJournal;

struct Options {
  solve::Options search;  ///< σ, limits, threads, progress
  int digits = 0;         ///< proven digits of isolated points after the decimal point; 0: none
  /// The parts of a set are searched in turns, so that one without an end leaves time to the others. In the first round all
  /// parts together process this many boxes, in each next round four times as many. 0: one part after the other.
  std::uint64_t boxes_of_first_turns = 1'000'000;
};

/// All that a result file holds (result::write_result). What a limit left undone is pending or undecided, and
/// Result::stopped says so.
/// Throws symbolic::ModelError where the model does not answer such a question, std::invalid_argument where solve::solve
/// does.
result::Result answer(const Question& question, const Options& options = {});

/// The same of system(question), made before; `control` takes the place of the options' limits. A journal, where one is
/// given, says from where the search goes on, and keeps it.
result::Result answer(const Question& question, const System& system, const Options& options, solve::Control& control,
                      RunJournal* journal = nullptr);

/// The same of all parts of a question (systems_of), in one run. Throws std::invalid_argument before the first is searched.
result::Result answer(const Systems& systems, const Options& options, solve::Control& control,
                      RunJournal* journal = nullptr);

/// "stopped by the time limit, in the stage search".
std::string stopped_words(const result::Result& result);

/// Sets Result::seems_of_corank, a hint, from the singular values in boxes that are undecided along a set of degenerate
/// solutions.
void describe_corank(const System& system, result::Result& result);

}  // namespace corank::study
