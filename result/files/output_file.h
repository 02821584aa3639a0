// A file that is written beside its place and takes it in one step, so that nobody ever sees half of it and nothing is left
// where writing ends early.
#pragma once

#include <filesystem>

#include "corank/result/files/hdf5_file.h"

namespace corank::result {

/// Makes the empty file part(), "NAME.HOST.PID.part" beside the final one, which is removed at the end of this object's
/// life, or at the end of the process by SIGINT, SIGTERM or SIGHUP, unless finish() has given it its name. Part files of the
/// same name that belong to no process of this machine any more are removed, too.
///
/// A symbolic link keeps being one: its target is written. Throws ResultFileError where there is something that is no
/// regular file, where the file is read-only, or where no file can be made.
class OutputFile {
 public:
  explicit OutputFile(const std::filesystem::path& path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  const std::filesystem::path& part() const { return part_; }
  /// The part takes its place, with the permissions of the file that was there.
  void finish() const;

 private:
  std::filesystem::path path_, target_, part_;
};

/// Removes the part files of all OutputFiles that live. May be called in a signal handler before the process ends.
void remove_part_files() noexcept;

}  // namespace corank::result
