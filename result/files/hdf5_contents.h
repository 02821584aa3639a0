// From an HDF5 file of a stranger to plain items: checks the structure before it reads, and reads nothing but what the file
// itself holds.
//
// Refused: links but hard ones, external storage, virtual and compact arrays, filters but deflate and shuffle, types that
// corank does not write, more than two dimensions, arrays that declare more than is stored, more than half of the machine's
// memory, too many or too deep groups.
#pragma once

#include <string>

#include "corank/core/guarded_process.h"

namespace corank::result {

/// What of a file is wanted: the result, or the state of its search (result/files/checkpoint.h), which lies in a group of
/// its own.
enum class Contents : bool { result, search };
inline constexpr const char* kSearchGroup = "search";

/// Writes all groups, arrays and attributes of the file as items (result/files/plain_items.h). To be called where a crash or
/// a hang of the HDF5 library does no harm: it has both in store for damaged files. Throws std::runtime_error that names the
/// item, not the file.
void copy_contents(const std::string& path, ByteSink& sink, Contents wanted = Contents::result);

}  // namespace corank::result
