#include "corank/result/files/packed_chunks.h"

#include <tbb/parallel_for.h>
#include <zlib.h>

#include <algorithm>
#include <new>
#include <vector>

#include "corank/core/threads.h"

namespace corank::result {
namespace {

constexpr std::size_t kChunksPerThread = 4;

std::vector<std::byte> packed_chunk(const ChunkedArray& array, std::size_t k) {
  const std::size_t w = array.width, n = array.chunk, from = k * n, there = std::min(n, array.bytes.size() / w - from);
  std::vector<std::byte> shuffled(n * w);
  const std::byte* const elements = array.bytes.data() + from * w;
  for (std::size_t b = 0; b < w; ++b)
    for (std::size_t i = 0; i < there; ++i) shuffled[b * n + i] = elements[i * w + b];
  uLong size = compressBound(shuffled.size());
  std::vector<std::byte> packed(size);
  if (compress2(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(shuffled.data()),
                shuffled.size(), array.level) != Z_OK)
    throw std::bad_alloc();  // the only other reason were too little room
  packed.resize(size);
  return packed;
}

void use_plain_chunk(const ChunkedArray& array, std::size_t k, const UseChunk& use) {
  const std::size_t size = array.chunk * array.width;
  const std::span<const std::byte> rest = array.bytes.subspan(k * size);
  if (rest.size() >= size) return use(k, rest.first(size), false);
  std::vector<std::byte> last(size);
  std::copy(rest.begin(), rest.end(), last.begin());
  use(k, last, false);
}

}  // namespace

void for_each_packed_chunk(const ChunkedArray& array, int threads, const Ended& in_haste, const UseChunk& use) {
  const std::size_t elements = array.bytes.size() / array.width, chunks = (elements + array.chunk - 1) / array.chunk;
  ThreadArena arena(threads);
  std::vector<std::vector<std::byte>> packed(kChunksPerThread * arena.threads());
  for (std::size_t from = 0; from < chunks; from += packed.size()) {
    const std::size_t count = std::min(packed.size(), chunks - from);
    if (is_over(in_haste)) {
      for (std::size_t k = 0; k < count; ++k) use_plain_chunk(array, from + k, use);
      continue;
    }
    arena.execute([&] {
      tbb::parallel_for(std::size_t{0}, count, [&](std::size_t k) { packed[k] = packed_chunk(array, from + k); });
    });
    for (std::size_t k = 0; k < count; ++k) use(from + k, packed[k], true);
  }
}

}  // namespace corank::result
