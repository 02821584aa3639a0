// How much memory this process may take.
#pragma once

#include <cstdint>
#include <filesystem>

namespace corank::solve {

/// In bytes: the machine's main memory, or what the control groups of the process or its resource limits grant where that is
/// less; 0 where nothing is known. The folders are Linux's; others are for tests.
std::uint64_t machine_memory(const std::filesystem::path& proc = "/proc",
                             const std::filesystem::path& control_groups = "/sys/fs/cgroup");

}  // namespace corank::solve
