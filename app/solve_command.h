// What the command line of corank solve says; from it to a run's checkpoints, and back.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>

#include "corank/app/question.h"
#include "corank/app/shared_options.h"
#include "corank/result/files/checkpoint.h"

namespace corank::app {

struct SolveCommand {
  QuestionOptions question;
  std::optional<double> sigma, sigma_length, sigma_angle, tolerance;
  SearchLimits limits{};
  std::optional<std::uint64_t> max_solutions;
  int digits = 0;
  bool proof = false, area = false;
  std::string param_path, result_path;
  JsonOption json;
  std::string checkpoint_path, resume_path, refine_path;
  double every = 60;  ///< seconds
  bool estimate = false;
};

/// Adds the options, which write to `command`.
void add_solve_options(CLI::App& sub, SolveCommand& command);

/// What a checkpoint says of a run besides its states: the options that were given, but for limits, and the files they name.
result::Checkpoint checkpoint_of(const CLI::App& sub, const SolveCommand& command);

/// Throws UsageError where an option does not go with --refine, or -o is not given.
void check_refine(const CLI::App& sub);

/// A run that goes on from a former one. The files that it was about are those of the checkpoint: where they are as they
/// were, themselves, else copies that live as long as this object.
class Resumed {
 public:
  /// `sub` and `now`: the command line with --resume. Throws ResultFileError, UsageError.
  Resumed(const CLI::App& sub, const SolveCommand& now);
  ~Resumed();
  Resumed(const Resumed&) = delete;
  Resumed& operator=(const Resumed&) = delete;

  SolveCommand command;
  result::Checkpoint checkpoint;

 private:
  void restore();
  std::string file_of(const result::Checkpoint::File& file);

  std::string path_;
  std::optional<std::filesystem::path> copies_;
};

}  // namespace corank::app
