// Work on data that may make a library crash, hang or fill the memory: in a child process with limits, whose results come
// back as bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>

#include "corank/core/ended.h"

namespace corank {

struct ProcessLimits {
  std::uint64_t memory = 0;       ///< bytes beyond those that the process has
  std::uint64_t cpu_seconds = 0;  ///< of the child
};

/// The work did not come to its end. what() is one line.
class GuardedWorkError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Bytes in memory that belong to no file system; unmapped at the end.
class SharedBytes {
 public:
  /// All that the descriptor holds. Throws GuardedWorkError.
  explicit SharedBytes(int descriptor);
  ~SharedBytes();
  SharedBytes(SharedBytes&& other) noexcept;
  SharedBytes(const SharedBytes&) = delete;
  SharedBytes& operator=(const SharedBytes&) = delete;
  std::span<const std::byte> bytes() const { return {data_, size_}; }
  /// Gives the memory of these back, which have to be part of bytes() and read as zeros from now on; whole pages only.
  void forget(std::span<const std::byte> part);

 private:
  const std::byte* data_ = nullptr;
  std::size_t size_ = 0;
  int descriptor_ = -1;
};

/// Where the child puts its results. Throws std::runtime_error where there is no room left.
class ByteSink {
 public:
  explicit ByteSink(int descriptor) : descriptor_(descriptor) {}
  void write(std::span<const std::byte> bytes);
  void write(const std::string& bytes) { write(std::as_bytes(std::span(bytes))); }

 private:
  int descriptor_;
};

/// Runs `work` in a child process and returns what it wrote. An exception of `work` comes back as a GuardedWorkError with
/// its text; so does the child's end by a signal, a limit or otherwise, whose `work` this process has then not felt, and its
/// end because `ended` said so. The child is a copy of this thread alone: `work` must not wait for others.
SharedBytes run_guarded(const ProcessLimits& limits, const std::function<void(ByteSink&)>& work, const Ended& ended = {});

}  // namespace corank
