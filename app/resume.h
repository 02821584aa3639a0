// From the command line of a run to its checkpoints, and back.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "corank/app/solve_command.h"
#include "corank/result/checkpoint.h"

namespace corank::app {

/// What a checkpoint says of a run besides its states: the options that were given, but for limits, and the files they name.
result::Checkpoint checkpoint_of(const CLI::App& sub, const SolveCommand& command);

/// A run that goes on from a former one. The files that it was about are those of the checkpoint: where they are as they
/// were, themselves, else copies that live as long as this object.
class Resumed {
 public:
  /// `sub` and `now`: the command line with --resume or --refine. Throws ResultFileError, UsageError.
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
