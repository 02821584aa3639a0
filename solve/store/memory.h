// What a search keeps until its result is written, in bytes: an estimate that counts what there are many of.
#pragma once

#include <cstdint>
#include <filesystem>

#include "corank/solve/store/packed_found.h"

namespace corank::solve {

class MemoryEstimate {
 public:
  /// `later_bytes`: what later stages take for a side of a box.
  MemoryEstimate(const certify::Reduction& reduction, std::uint64_t later_bytes);

  /// A found box: itself and its place in the sorted list, or what becomes of it in the cover and later, whichever is more;
  /// its region where it is not that of the box found before.
  std::int64_t of(const Found& found, const Found* former) const;
  /// The same of all boxes of a list.
  std::int64_t of(const PackedFound& found) const;
  /// A sheet that waits to be cut: itself, or the `pending` box that a limit makes of it, whichever is more.
  std::int64_t of_sheet(const certify::Sheet& sheet) const;
  /// A part of the script: itself, the copy in the cover, and the file's.
  std::int64_t of_script(std::uint64_t bytes) const { return 3 * static_cast<std::int64_t>(bytes); }
  /// Boxes that will be found before anybody looks again.
  std::int64_t of_found(std::size_t boxes) const { return box_ * static_cast<std::int64_t>(boxes); }
  /// Boxes that wait: a limit would leave them, and make `pending` ones of them.
  std::int64_t of_waiting(std::size_t boxes) const { return (waiting_ + box_) * static_cast<std::int64_t>(boxes); }
  /// The matrices that a thread works with.
  std::int64_t of_thread() const { return thread_; }

 private:
  std::int64_t box_, region_, sheet_, thread_, waiting_;
};

/// What this process may take, in bytes: the machine's main memory, or what the control groups of the process or its
/// resource limits grant where that is less; 0 where nothing is known. The folders are Linux's; others are for tests.
std::uint64_t machine_memory(const std::filesystem::path& proc = "/proc",
                             const std::filesystem::path& control_groups = "/sys/fs/cgroup");

}  // namespace corank::solve
