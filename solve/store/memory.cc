#include "corank/solve/store/memory.h"

#include <sys/resource.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

#include "corank/solve/step/control.h"
#include "corank/solve/step/recorder.h"
#include "corank/solve/store/shard.h"

namespace corank::solve {
namespace {

constexpr std::int64_t kSortedBytes = 6 * sizeof(double);  // pointers and keys

template <class T>
std::int64_t bytes(std::int64_t count) {
  return static_cast<std::int64_t>(sizeof(T)) * count;
}

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

MemoryEstimate::MemoryEstimate(const certify::Reduction& reduction, std::uint64_t later_bytes) {
  const auto sides = static_cast<std::int64_t>(reduction.kept.size() + reduction.definitions.size());
  const auto n = static_cast<std::int64_t>(reduction.kept.size());
  const auto m = static_cast<std::int64_t>(reduction.system.equations.size());
  const std::int64_t own = bytes<Interval>(sides) + kAllocationBytes;
  // Each box is there once: found, then in the cover.
  const std::int64_t found = bytes<Found>(1) + own + kAllocationBytes + kSortedBytes,
                     in_cover = bytes<CoverBox>(1) + own + kAllocationBytes + static_cast<std::int64_t>(later_bytes) * sides;
  box_ = std::max(found, in_cover);
  region_ = 2 * own + bytes<Box>(2) + 3 * kAllocationBytes + static_cast<std::int64_t>(kFileBytes) * sides;
  // Its region and image; a point of the cover beside the box.
  sheet_ = bytes<certify::Sheet>(1) + bytes<Interval>(2 * n) + bytes<int>(2 * m) + 5 * kAllocationBytes +
           bytes<CoverBox>(1) + own;
  // The tableau, Y (three times) and Y·S.
  waiting_ = bytes<Waiting>(1) + bytes<Interval>(n) + kAllocationBytes;
  thread_ = bytes<double>(m * n + 3 * m * m) + bytes<Interval>(m * n);
}

std::int64_t MemoryEstimate::of(const Found& found, const Found* former) const {
  std::int64_t sum = box_ + bytes<int>(static_cast<std::int64_t>(found.box.free.size()));
  if (found.region && !(former && former->region == found.region)) sum += region_;
  if (found.sheet) sum += sheet_;
  if (!found.leaves.empty()) sum += bytes<std::uint64_t>(1) + kAllocationBytes;
  return sum;
}

std::int64_t MemoryEstimate::of(const PackedFound& found) const {
  std::size_t most_free = 0;
  for (const CoverBox& kind : found.kinds()) most_free = std::max(most_free, kind.free.size());
  return (box_ + bytes<int>(static_cast<std::int64_t>(most_free))) * static_cast<std::int64_t>(found.size()) +
         region_ * static_cast<std::int64_t>(found.regions()) + sheet_ * static_cast<std::int64_t>(found.sheets().size());
}

std::int64_t MemoryEstimate::of_sheet(const certify::Sheet& sheet) const {
  const auto sides = static_cast<std::int64_t>(sheet.region.size()),
             numbers = static_cast<std::int64_t>(sheet.equations.size() + sheet.dependent.size());
  return std::max(bytes<Proven>(1) + bytes<Interval>(3 * sides) + bytes<int>(numbers) + 5 * kAllocationBytes, box_);
}

std::uint64_t bytes_of(const Cover& cover, std::uint64_t later_bytes) {
  std::uint64_t sum = 0;
  for (const CoverBox& box : cover.boxes)
    sum += sizeof(box) + box.box.size() * (sizeof(Interval) + later_bytes) + box.free.size() * sizeof(int) +
           2 * kAllocationBytes;
  for (const Box& region : cover.regions) sum += sizeof(region) + region.size() * sizeof(Interval) + kAllocationBytes;
  if (cover.proof) {
    for (const Proof::Combination& c : cover.proof->combinations) sum += bytes_of(c);
    sum += cover.proof->steps.size() + sizeof(std::int32_t) * cover.proof->integers.size() +
           sizeof(double) * cover.proof->reals.size();
  }
  return sum;
}

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
