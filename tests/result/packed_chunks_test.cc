// Arrays that several threads compress are, chunk by chunk, what HDF5's own filters read.
#include "corank/result/files/packed_chunks.h"

#include <gtest/gtest.h>
#include <unistd.h>
#include <zlib.h>

#include <filesystem>
#include <random>

#include "corank/result/files/hdf5_file.h"

namespace corank::result {
namespace {

std::vector<std::byte> random_bytes(std::size_t size) {
  std::mt19937 random(static_cast<unsigned>(size) + 1);
  std::vector<std::byte> bytes(size);
  for (std::byte& b : bytes) b = static_cast<std::byte>(random() % 7);  // compressible
  return bytes;
}

// Inflated, and its bytes where they were.
std::vector<std::byte> unpacked(std::span<const std::byte> packed, const ChunkedArray& array) {
  std::vector<std::byte> shuffled(array.chunk * array.width), elements(shuffled.size());
  uLong size = shuffled.size();
  EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(shuffled.data()), &size, reinterpret_cast<const Bytef*>(packed.data()),
                       packed.size()),
            Z_OK);
  EXPECT_EQ(size, shuffled.size());
  for (std::size_t i = 0; i < array.chunk; ++i)
    for (std::size_t b = 0; b < array.width; ++b) elements[i * array.width + b] = shuffled[b * array.chunk + i];
  return elements;
}

TEST(PackedChunks, AreTheArrayInOrderWithZerosBehindIt) {
  for (const std::size_t width : {1, 4, 8})
    for (const std::size_t elements : {0, 1, 99, 100, 101, 1234, 5000})
      for (const int threads : {1, 2, 3}) {
        const std::vector<std::byte> bytes = random_bytes(elements * width);
        const ChunkedArray array{bytes, width, 100, 1};
        std::vector<std::byte> found;
        std::size_t next = 0;
        for_each_packed_chunk(array, threads, {}, [&](std::size_t k, std::span<const std::byte> packed, bool) {
          EXPECT_EQ(k, next++);
          const std::vector<std::byte> chunk = unpacked(packed, array);
          found.insert(found.end(), chunk.begin(), chunk.end());
        });
        ASSERT_EQ(next, (elements + 99) / 100);
        std::vector<std::byte> expected = bytes;
        expected.resize(next * 100 * width);
        EXPECT_EQ(found, expected) << width << ", " << elements << ", " << threads;
      }
}

TEST(PackedChunks, AreTheBytesAsTheyAreOnceThereIsHaste) {
  const std::vector<std::byte> bytes = random_bytes(4 * 2034);
  const ChunkedArray array{bytes, 4, 100, 1};
  int asked = 0;
  std::vector<std::byte> found;
  std::size_t plain = 0;
  for_each_packed_chunk(
      array, 1, [&] { return ++asked > 3; },
      [&](std::size_t, std::span<const std::byte> chunk, bool packed) {
        plain += !packed;
        const auto elements = packed ? unpacked(chunk, array) : std::vector<std::byte>(chunk.begin(), chunk.end());
        EXPECT_EQ(elements.size(), 400u);
        found.insert(found.end(), elements.begin(), elements.end());
      });
  EXPECT_GT(plain, 0u);
  EXPECT_LT(plain, 21u);
  std::vector<std::byte> expected = bytes;
  expected.resize(21 * 400);
  EXPECT_EQ(found, expected);
}

TEST(PackedChunks, EndWhereTheirUserFails) {
  const std::vector<std::byte> bytes = random_bytes(100'000);
  std::size_t used = 0;
  const auto use = [&](std::size_t k, std::span<const std::byte>, bool) {
    if (k == 5) throw std::runtime_error("disk full");
    ++used;
  };
  EXPECT_THROW(for_each_packed_chunk({bytes, 4, 100, 1}, 2, {}, use), std::runtime_error);
  EXPECT_EQ(used, 5);
}

template <class T>
void expect_read_back(Hdf5Reader& file, const std::string& name, const std::vector<T>& expected) {
  EXPECT_EQ(file.vector<T>(name), expected) << name;
}

TEST(PackedChunks, AreReadByTheLibraryWhateverTheThreadsAndTheHaste) {
  const std::filesystem::path path =
      std::filesystem::path(testing::TempDir()) / ("corank_packed_" + std::to_string(getpid()) + ".h5");
  std::mt19937 random(1);
  std::vector<double> doubles(200'001);
  for (double& x : doubles) x = static_cast<double>(random()) / 3;
  std::vector<std::int32_t> integers(65'536);
  for (std::int32_t& x : integers) x = static_cast<std::int32_t>(random());
  const std::vector<std::uint8_t> bytes{1, 2, 3}, none;
  for (const auto& [threads, unhurried] : {std::pair(0, 1000), {1, 1000}, {3, 1000}, {1, 1}, {1, 0}}) {
    int asked = 0;
    Hdf5Writer writer(path.string(), threads, [&asked, most = unhurried] { return ++asked > most; });
    writer.packed("/doubles", doubles);
    writer.packed("/integers", integers);
    writer.packed("/bytes", bytes);
    writer.packed("/none", none);
    writer.close();
    Hdf5Reader file(path.string());
    expect_read_back(file, "/doubles", doubles);
    expect_read_back(file, "/integers", integers);
    expect_read_back(file, "/bytes", bytes);
    expect_read_back(file, "/none", none);
  }
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace corank::result
