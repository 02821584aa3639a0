// Result files, RESULT.h5: a result in HDF5, every double bit for bit:
//
//   /                   attributes format = "corank result", format_version, version, model, set, complete, stopped,
//                       sigma_length …
//   /model/text         the model file as read
//   /model/system       the solved system in the model language
//   /variables/…        names, kinds, domain (n×2)
//   /angles/…           names, cosine, sine (indices), range (k×2)
//   /boxes/…            lower, upper (N×n), verdict, reason (enumerations), free (N×n mask)
//   /points/…           likewise
//   /boxes/types_proven, types_excluded (N bytes), likewise of /points: bits of the types of singularity, in the order of
//                       the attribute types of /boxes; attributes types_asked, types_of_set, types_left_out. Absent where
//                       none were asked for
//   /boxes              attributes regular, isolated … wider_than_sigma: numbers of boxes
//   /certificates/…     what `corank verify` needs, see result/files/cover_group.h
//   /parts/0, /parts/1 …   where the set consists of parts: each as the root, but for model and set, with the attribute
//                       part; the root's boxes are theirs, and /boxes/part says whose
//   /outputs, /boxes/passage, /boxes/side   of a workspace boundary
//   /options, /statistics   attributes; /options/constants/… names, expressions
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>

#include "corank/result/files/hdf5_file.h"
#include "corank/result/values/result.h"

namespace corank::result {

/// The layout that write_result writes; read_result reads this one and version 3, which had one sigma for all variables,
/// kernel vectors of unscaled norm and no reasons.
inline constexpr int kFormatVersion = 4;

/// Throws ResultFileError where no file can be written at `path` (result/files/output_file.h): to be asked before a long
/// computation.
void check_writable(const std::filesystem::path& path);

/// Writes a new file beside `path` and renames it, so that `path` never holds half a result. Once `in_haste` says so, what
/// is left is not compressed. Throws ResultFileError.
void write_result(const std::filesystem::path& path, const Result& result, const Ended& in_haste = {});

/// The result that write_result was given, bit for bit (free variables in ascending order; control characters in names made
/// visible). The file may be a stranger's: throws ResultFileError, a printable line, for one that is missing, foreign, cut
/// short, damaged or inconsistent, or that takes another file's contents for its own.
Result read_result(const std::filesystem::path& path);

/// What may be left out, since it takes memory for each box.
struct Reading {
  bool free = true;  ///< CoverBox::free; kept all the same where the result has parts
  /// Where given: the variables whose sides are kept, in ascending order, called when the result's variables and angles are
  /// known. What comes back knows only these and the angles made of them, and has neither certificates nor parts.
  std::function<std::vector<int>(const Result&)> sides{};
};
Result read_result(const std::filesystem::path& path, const Reading& reading);
/// The same from items in memory (result/files/plain_items.h); `name` is for messages.
Result read_result(const std::string& name, std::span<const std::byte> items);

/// Writes a text in the same way. Throws ResultFileError.
void write_text(const std::filesystem::path& path, const std::string& text);

/// All of a file; empty where it cannot be read.
std::string file_bytes(const std::filesystem::path& path);

}  // namespace corank::result
