// Found boxes as bytes are the same boxes again, whatever they share; what is damaged is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <sstream>

#include "corank/solve/store/byte_archive.h"
#include "corank/solve/store/packed_found.h"

namespace corank::solve {
namespace {

constexpr std::size_t kSides = 5;

std::string packed(const FoundList& found, std::size_t count) {
  std::ostringstream stream(std::ios::binary);
  ByteOutput archive(stream);
  pack(archive, found, count);
  return std::move(stream).str();
}

// Throws where the bytes are damaged.
FoundList unpacked(const std::string& bytes) {
  ByteInput archive(bytes);
  FoundList found;
  const PackedFound read = packed_in(archive);
  EXPECT_TRUE(archive.at_end());
  read.unpack(found);
  EXPECT_EQ(found.size(), read.size());
  return found;
}

Box random_box(std::mt19937& random) {
  const double special[] = {0.0, -0.0, 1e-310, -5e-324, HUGE_VAL, -HUGE_VAL};
  Box box;
  for (std::size_t j = 0; j < kSides; ++j) {
    double ends[2];
    for (double& end : ends)
      end = random() % 4 == 0 ? special[random() % 6] : std::uniform_real_distribution(-9.0, 9.0)(random);
    box.emplace_back(std::min(ends[0], ends[1]), std::max(ends[0], ends[1]));
  }
  return box;
}

// Regions and kinds come back after others, as nested sheets have it.
FoundList random_list(std::mt19937& random, std::size_t count) {
  std::vector<std::shared_ptr<const Box>> regions{nullptr};
  for (int i = 0; i < 3; ++i) regions.push_back(std::make_shared<const Box>(random_box(random)));
  regions.push_back(std::make_shared<const Box>(*regions[1]));  // equal, and another
  FoundList list;
  for (std::size_t i = 0; i < count; ++i) {
    Found& f = list.emplace_back();
    f.box.box = random_box(random);
    f.box.verdict = static_cast<Verdict>(random() % kVerdicts);
    if (random() % 2 == 0) f.box.free = {1, 3};
    f.box.reason = static_cast<Reason>(random() % kReasons);
    f.box.motion = static_cast<int>(random() % 3) - 1;
    f.region = regions[random() % regions.size()];
    if (random() % 5 != 0) continue;
    certify::Sheet sheet;
    sheet.proven = true;
    sheet.dependent = {static_cast<int>(random() % kSides)};
    sheet.region = sheet.image = random_box(random);
    f.sheet = std::make_unique<const certify::Sheet>(sheet);
  }
  return list;
}

void expect_same_packed(const Box& a, const Box& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t j = 0; j < a.size(); ++j) {
    EXPECT_EQ(std::signbit(a[j].neg_lo()), std::signbit(b[j].neg_lo()));  // zeros, too
    EXPECT_EQ(std::signbit(a[j].hi()), std::signbit(b[j].hi()));
    EXPECT_EQ(a[j], b[j]);
  }
}

TEST(PackedFound, IsTheSameListAgainAndSharesWhatWasShared) {
  std::mt19937 random(1);
  for (const std::size_t count : {0u, 1u, 2u, 40u, 400u}) {
    const FoundList list = random_list(random, count + 3);
    const FoundList again = unpacked(packed(list, count));
    ASSERT_EQ(again.size(), count);
    for (std::size_t i = 0; i < count; ++i) {
      const Found &a = list[i], &b = again[i];
      expect_same_packed(a.box.box, b.box.box);
      EXPECT_EQ(a.box.verdict, b.box.verdict);
      EXPECT_EQ(a.box.free, b.box.free);
      EXPECT_EQ(a.box.reason, b.box.reason);
      EXPECT_EQ(a.box.motion, b.box.motion);
      ASSERT_EQ(a.region == nullptr, b.region == nullptr);
      if (a.region) expect_same_packed(*a.region, *b.region);
      ASSERT_EQ(a.sheet == nullptr, b.sheet == nullptr);
      if (a.sheet) {
        EXPECT_EQ(a.sheet->dependent, b.sheet->dependent);
        expect_same_packed(a.sheet->image, b.sheet->image);
      }
      if (i > 0) {
        EXPECT_EQ(a.region == list[i - 1].region, b.region == again[i - 1].region) << i;
      }
    }
    EXPECT_EQ(packed(again, count), packed(list, count));
  }
}

TEST(PackedFound, ThatIsCutShortOrHoldsNoIntervalIsRefused) {
  std::mt19937 random(2);
  const std::string bytes = packed(random_list(random, 30), 30);
  for (std::size_t length = 0; length < bytes.size(); length += 5) {
    std::string shorter = bytes.substr(0, length);
    EXPECT_THROW(unpacked(shorter), ShardError) << length;
    if (length < 8) continue;
    const std::uint64_t fewer = length - 8;  // says itself how long it is
    shorter.replace(0, 8, reinterpret_cast<const char*>(&fewer), 8);
    EXPECT_THROW(unpacked(shorter), ShardError) << length;
  }
  std::string damaged = bytes;
  const double none = std::nan("");
  damaged.replace(damaged.size() - 8, 8, reinterpret_cast<const char*>(&none), 8);
  EXPECT_THROW(unpacked(damaged), ShardError);
}

TEST(PackedFound, WithAnyByteChangedIsRefusedOrIsAListOfIntervals) {
  std::mt19937 random(3);
  const std::string bytes = packed(random_list(random, 6), 6);
  int refused = 0;
  for (std::size_t at = 0; at < bytes.size(); ++at)
    for (const char change : {'\x01', '\x80', '\xff'}) {
      std::string damaged = bytes;
      damaged[at] = static_cast<char>(damaged[at] ^ change);
      try {
        for (const Found& f : unpacked(damaged))
          for (const Interval& side : f.box.box) EXPECT_LE(side.lo(), side.hi());
      } catch (const ShardError&) {
        ++refused;
      } catch (const cereal::Exception&) {
        ++refused;
      }
    }
  EXPECT_GT(refused, 50);
}

}  // namespace
}  // namespace corank::solve
