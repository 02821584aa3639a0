// Chunks of an array as HDF5's filters "shuffle" and "deflate" make them, by several threads at a time: the library itself
// filters them one after the other.
#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "corank/core/ended.h"

namespace corank::result {

/// An array of elements of `width` bytes each, which is cut into chunks of `chunk` elements.
struct ChunkedArray {
  std::span<const std::byte> bytes;
  std::size_t width = 1, chunk = 1;
  int level = 1;  ///< of deflate, 1 to 9
};

/// Calls use(k, bytes, true) for chunk k = 0, 1, …, in order, always by the calling thread: the elements k·chunk, …, those
/// behind the last one 0; first the first byte of each, then the second, and so on (shuffle); as a zlib stream (deflate).
/// Once `in_haste` says so, use(k, bytes, false) with the elements as they are, which takes a tenth of the time.
/// Reads and holds no more than a few chunks for each thread at a time. threads: 0 for one on each core. Throws
/// std::bad_alloc where zlib has no memory.
using UseChunk = std::function<void(std::size_t k, std::span<const std::byte> bytes, bool packed)>;
void for_each_packed_chunk(const ChunkedArray& array, int threads, const Ended& in_haste, const UseChunk& use);

}  // namespace corank::result
