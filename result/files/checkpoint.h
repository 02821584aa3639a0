// Checkpoints: what a run can go on from, in a file of its own or in the result of a run that was ended early.
//
//   corank checkpoint, version 0.1.0 (search 3f9a01c2b7d4)     one line; another version's is refused
//   arguments, files, states, the number of the search         each text behind its length, 8 bytes, little-endian
//   that is under way, its state
//   CRC-32 of all that, 4 bytes, little-endian
// The states are solve/store/shard_bytes.h's. In a result file all this is the array /search/state.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

#include "corank/result/files/hdf5_file.h"

namespace corank::result {

struct Checkpoint {
  /// As it was read; `path` is what it was called then.
  struct File {
    std::string option, path, text;
  };
  std::vector<std::string> arguments;  ///< of the command line, without files and limits
  std::vector<File> files;
  std::vector<std::string> states;  ///< the last ones of the run's searches, in their order; empty: it has not begun
  std::size_t under_way = 0;        ///< the search whose turn it was
};

using StateWriter = std::function<void(std::ostream&)>;

/// Writes a new file, has the disk take it, and only then gives it its name: at every moment `path` holds this checkpoint or
/// the one before. `state` writes that of the search that is under way. Throws ResultFileError.
void write_checkpoint(const std::filesystem::path& path, const std::string& version, const Checkpoint& checkpoint,
                      const StateWriter& state);
/// The same as Result::search. Room for `expected` bytes is made at once.
std::string checkpoint_bytes(const std::string& version, const Checkpoint& checkpoint, const StateWriter& state,
                             std::uint64_t expected = 0);

/// Of a checkpoint's file, or of a result's. Throws ResultFileError where there is none, where it is damaged, or where
/// another version has written it.
Checkpoint read_checkpoint(const std::filesystem::path& path, const std::string& version);

/// Puts Result::search into a file.
void write_search(Hdf5Writer& file, const std::string& bytes);

}  // namespace corank::result
