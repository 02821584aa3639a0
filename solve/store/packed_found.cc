#include "corank/solve/store/packed_found.h"

#include <cstring>
#include <memory>
#include <sstream>
#include <unordered_map>
#include <utility>

#include "corank/core/check.h"
#include "corank/solve/store/search_archive.h"

namespace corank::solve {
namespace {

// Intervals are written as they are kept, (−lo, hi), as doubles of this machine's: those of all that corank runs on.
static_assert(sizeof(Interval) == 2 * sizeof(double) && std::is_trivially_copyable_v<Interval>);

bool same_kind(const CoverBox& a, const CoverBox& b) {
  return a.verdict == b.verdict && a.region == b.region && a.point == b.point && a.kernel_at_most == b.kernel_at_most &&
         a.motion == b.motion && a.reason == b.reason && a.free == b.free;
}

// Runs of boxes, and what they have in common.
struct Common {
  Common(const FoundList& found, std::size_t count) {
    std::unordered_map<const Box*, std::uint32_t> numbers{{nullptr, 0}};
    const Found* former = nullptr;
    for (std::size_t i = 0; i < count; ++i) {
      const Found& f = found[i];
      CORANK_CHECK(f.leaves.empty() && f.box.box.size() == found[0].box.box.size());
      if (f.sheet) sheets.push_back({i, f.sheet.get()});
      if (former && former->region == f.region && same_kind(former->box, f.box)) {
        ++runs.back().count;
      } else {
        const auto [at, is_new] = numbers.try_emplace(f.region.get(), static_cast<std::uint32_t>(numbers.size()));
        if (is_new) regions.push_back(f.region.get());
        runs.push_back({kind_of(f.box), at->second, 1});
      }
      former = &f;
    }
  }

  std::uint32_t kind_of(const CoverBox& box) {
    for (std::size_t k = kinds.size(); k-- > 0;)
      if (same_kind(kinds[k], box)) return static_cast<std::uint32_t>(k);
    CoverBox kind = box;
    kind.box.clear();
    kinds.push_back(std::move(kind));
    return static_cast<std::uint32_t>(kinds.size() - 1);
  }

  std::vector<CoverBox> kinds;
  std::vector<PackedFound::Run> runs;
  std::vector<const Box*> regions;
  std::vector<std::pair<std::uint64_t, const certify::Sheet*>> sheets;
};

void expect_undamaged(bool fits) {
  if (!fits) throw ShardError("a part of a search cannot be read: its boxes are damaged");
}

// No number that is none, and no lower end above the upper one.
bool are_intervals(std::string_view block) {
  bool all = true;
  for (std::size_t at = 0; at < block.size(); at += sizeof(Interval)) {
    double ends[2];
    std::memcpy(ends, block.data() + at, sizeof(ends));
    all = all && -ends[0] <= ends[1];
  }
  return all;
}

Box row(std::string_view block, std::size_t number, std::size_t sides) {
  Box box(sides);
  std::memcpy(static_cast<void*>(box.data()), block.data() + number * sides * sizeof(Interval), sides * sizeof(Interval));
  return box;
}

}  // namespace

void pack(ByteOutput& archive, const FoundList& found, std::size_t count) {
  const Common common(found, count);
  const std::size_t sides = count > 0 ? found[0].box.box.size() : 0;
  const std::size_t row = sides * sizeof(Interval);
  std::ostringstream beside(std::ios::binary);
  ByteOutput head(beside);
  head(static_cast<std::uint64_t>(count), static_cast<std::uint64_t>(sides), common.kinds, common.runs);
  head(cereal::make_size_tag(static_cast<cereal::size_type>(common.sheets.size())));
  for (const auto& [box, sheet] : common.sheets) head(box, *sheet);
  head(static_cast<std::uint64_t>(common.regions.size()));
  const std::string_view first = beside.view();
  archive(static_cast<std::uint64_t>(first.size() + (common.regions.size() + count) * row));
  archive.block(first.data(), first.size());
  for (const Box* region : common.regions) {
    CORANK_CHECK(region->size() == sides);
    archive.block(region->data(), row);
  }
  for (std::size_t i = 0; i < count; ++i) archive.block(found[i].box.box.data(), row);
}

void pack(ByteOutput& archive, const PackedFound& found) {
  archive(static_cast<std::uint64_t>(found.bytes().size()));
  archive.block(found.bytes().data(), found.bytes().size());
}

PackedFound packed_in(ByteInput& archive) {
  std::uint64_t size = 0;
  archive(size);
  return PackedFound(archive.take(size, 1));
}

PackedFound::PackedFound(std::string_view bytes) : bytes_(bytes) {
  ByteInput archive(bytes);
  std::uint64_t count = 0, sides = 0, sheets = 0, regions = 0;
  archive(count, sides, kinds_, runs_, cereal::make_size_tag(sheets));
  for (std::uint64_t i = 0; i < sheets; ++i) {
    auto& [box, sheet] = sheets_.emplace_back();
    archive(box, sheet);
    expect_undamaged(box < count && (i == 0 || sheets_[i - 1].first < box));
  }
  archive(regions);
  archive.need(sides);
  archive.need(regions);
  archive.need(count);
  size_ = count;
  sides_ = sides;
  const std::size_t row = sides * sizeof(Interval);
  regions_ = archive.take(regions, row);
  boxes_ = archive.take(count, row);
  std::uint64_t in_runs = 0;
  for (const Run& run : runs_) {
    expect_undamaged(run.kind < kinds_.size() && run.region <= regions && run.count > 0);
    in_runs += run.count;
  }
  expect_undamaged(archive.at_end() && in_runs == count && are_intervals(regions_) && are_intervals(boxes_));
}

void PackedFound::unpack(FoundList& found) const {
  std::vector<std::shared_ptr<const Box>> regions(1);
  for (std::size_t i = 0; i * sides_ * sizeof(Interval) < regions_.size(); ++i)
    regions.push_back(std::make_shared<const Box>(row(regions_, i, sides_)));
  auto sheet = sheets_.begin();
  std::size_t number = 0;
  for (const Run& run : runs_)
    for (std::uint32_t k = 0; k < run.count; ++k, ++number) {
      Found& f = found.emplace_back();
      f.box = kinds_[run.kind];
      f.box.box = row(boxes_, number, sides_);
      f.region = regions[run.region];
      if (sheet != sheets_.end() && sheet->first == number)
        f.sheet = std::make_unique<const certify::Sheet>((sheet++)->second);
    }
}

}  // namespace corank::solve
