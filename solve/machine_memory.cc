#include "corank/solve/machine_memory.h"

#include <sys/resource.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

namespace corank::solve {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kUnknown = std::numeric_limits<std::uint64_t>::max();

// The number in a file; kUnknown for "max", or where there is none.
std::uint64_t number_in(const fs::path& path) {
  std::uint64_t value = 0;
  std::ifstream file(path);
  return file >> value ? value : kUnknown;
}

// "MemTotal:  16384 kB"
std::uint64_t main_memory(const fs::path& meminfo) {
  std::ifstream file(meminfo);
  for (std::string word; file >> word;)
    if (std::uint64_t value = 0; word == "MemTotal:" && file >> value) return value * 1024;
  return kUnknown;
}

// The least limit of a group and those that it is in.
std::uint64_t granted(const fs::path& root, const fs::path& group, const char* name) {
  std::uint64_t least = number_in(root / name);
  fs::path folder = root;
  for (const fs::path& part : group.relative_path()) {
    folder /= part;
    least = std::min(least, number_in(folder / name));
  }
  return least;
}

}  // namespace

std::uint64_t machine_memory(const fs::path& proc, const fs::path& control_groups) {
  std::uint64_t least = main_memory(proc / "meminfo");
  // "0::/user.slice" (version 2), "7:memory:/user.slice" (version 1)
  std::ifstream file(proc / "self" / "cgroup");
  for (std::string line; std::getline(file, line);) {
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    const std::string controllers = "," + line.substr(first + 1, second - first - 1) + ",", group = line.substr(second + 1);
    if (controllers == ",,") {
      least = std::min(least, granted(control_groups, group, "memory.max"));
    } else if (controllers.find(",memory,") != std::string::npos) {
      least = std::min(least, granted(control_groups / "memory", group, "memory.limit_in_bytes"));
    }
  }
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
    least = std::min(least, static_cast<std::uint64_t>(limit.rlim_cur));
  return least == kUnknown ? 0 : least;
}

}  // namespace corank::solve
