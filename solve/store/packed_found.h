// Boxes that were found, as bytes of which little is said twice: what boxes that were cut from one sheet share is there
// once, and their sides stand one after the other. Whoever only passes them on need not take them apart.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "corank/solve/step/problem.h"

namespace corank::solve {

class ByteInput;
class ByteOutput;
class PackedFound;

/// Of the first boxes of a list, all of which have equally many sides. None of them has leaves yet.
void pack(ByteOutput& archive, const FoundList& found, std::size_t count);
/// The same bytes again.
void pack(ByteOutput& archive, const PackedFound& found);
/// What comes next was written by pack(): it stays where the archive has its bytes. Throws ShardError.
PackedFound packed_in(ByteInput& archive);

class PackedFound {
 public:
  PackedFound() = default;
  /// The bytes stay where they are. Every side is looked at: throws ShardError where they are no list of boxes.
  explicit PackedFound(std::string_view bytes);

  std::string_view bytes() const { return bytes_; }
  std::size_t size() const { return size_; }
  std::size_t sides() const { return sides_; }
  std::size_t regions() const { return regions_.size() / region_bytes(); }
  /// All that is said of boxes but their sides, each once.
  const std::vector<CoverBox>& kinds() const { return kinds_; }
  const std::vector<std::pair<std::uint64_t, certify::Sheet>>& sheets() const { return sheets_; }
  /// Adds the boxes to the list.
  void unpack(FoundList& found) const;

  // Boxes in a row that share a kind and a region, 0: none, else the number of one plus 1.
  struct Run {
    std::uint32_t kind = 0, region = 0, count = 0;
    void serialize(auto& archive) { archive(kind, region, count); }
  };

 private:
  std::size_t region_bytes() const { return std::max<std::size_t>(1, sides_ * sizeof(Interval)); }

  std::string_view bytes_;
  std::size_t size_ = 0, sides_ = 0;
  std::vector<CoverBox> kinds_;
  std::vector<Run> runs_;
  std::vector<std::pair<std::uint64_t, certify::Sheet>> sheets_;  // of which box
  std::string_view regions_, boxes_;
};

}  // namespace corank::solve
