// Files that are read as text: models, and the CUIK suite's.
#pragma once

#include <filesystem>
#include <limits>
#include <stdexcept>
#include <string>

namespace corank::symbolic {

/// Why nothing is read from the path, "there is no such file", "is a directory", "is no regular file"; empty: it may be
/// read. Opens nothing: a pipe would wait for its writer, and a device may have no end.
std::string reading_fault(const std::filesystem::path& path);

/// reading_fault(), or that the file cannot be opened or read.
class ReadingError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The first bytes of a regular file, `most` at most. Throws ReadingError.
std::string read_bytes(const std::filesystem::path& path, std::size_t most = std::numeric_limits<std::size_t>::max());

}  // namespace corank::symbolic
