// Runs corank again, as a process of its own: a command of the gallery, with a limit of time.
#pragma once

#include <atomic>
#include <filesystem>
#include <string>
#include <vector>

#include "corank/report/gallery/comparison.h"

namespace corank::app {

/// The file of the program that runs.
std::filesystem::path own_program();

/// Runs `program ARGS` in a folder to its end. Once the limit is over (0: there is none), or `stop` is set, it is asked to
/// end (SIGINT), and after a few seconds more it is ended. Its standard output and standard error are those of the run.
report::GalleryRun run_child(const std::filesystem::path& program, const std::vector<std::string>& args,
                             const std::filesystem::path& folder, double seconds, const std::atomic<bool>& stop);

}  // namespace corank::app
