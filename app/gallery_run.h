// Runs the commands of an entry of the gallery, or takes what is stored of them, and compares.
#pragma once

#include <atomic>
#include <filesystem>
#include <string>

#include "corank/report/gallery/outcome.h"

namespace corank::app {

struct GalleryOptions {
  std::filesystem::path program;  ///< corank
  std::string build;              ///< what tells this build of it from others
  std::filesystem::path folder;   ///< of the page; an entry's files are in FOLDER/NAME
  bool fresh = false;             ///< nothing stored is taken
  int threads = 1;                ///< of each command
  double time_limit = 0;          ///< of each command, in seconds
};

/// Throws ResultFileError where a file cannot be written. Once `stop` is set, what is left is not run, and nothing of it is
/// stored.
report::GalleryResult run_entry(const report::GalleryEntry& entry, const GalleryOptions& options,
                                const std::atomic<bool>& stop);

}  // namespace corank::app
