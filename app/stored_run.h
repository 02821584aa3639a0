// Runs of the gallery's commands, kept in its folder so that they need not be run again. A run belongs to a key: what it is
// made of, which is the program, the model and the command. What is stored of another key, or is not what was stored, counts
// as nothing.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "corank/report/gallery/comparison.h"

namespace corank::app {

/// A text's SHA-1, in the form of a name-based UUID: it tells texts apart, and is no protection against whoever can change
/// both the text and the hash.
std::string hash_of(const std::string& text);

/// NAME.json holds standard output, NAME.run the rest.
class StoredRun {
 public:
  StoredRun(std::filesystem::path folder, std::string name, std::string key);

  /// The run, if it was stored by this key, and no file has been changed since. `files`: others that the command wrote.
  std::optional<report::GalleryRun> read(const std::vector<std::filesystem::path>& files = {}) const;
  /// Throws ResultFileError.
  void write(const report::GalleryRun& run, const std::vector<std::filesystem::path>& files = {}) const;

 private:
  std::filesystem::path output_, record_;
  std::string key_;
};

}  // namespace corank::app
