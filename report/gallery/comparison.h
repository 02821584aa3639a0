// How an answer of corank compares with a published number, and whether it is proven.
//
// What is proven is what the answer's JSON says:
//
//  - bounds {"at_least", "at_most"} of a number prove it where they are equal;
//  - bounds {"lo", "hi"} of a value prove it within their width;
//  - a list stands for the number of its items;
//  - nothing is proven of an answer that says "complete": false or "proven": false; nor of the number of its boxes or
//    points where boxes are undecided, pending, partial or may reach beyond the search domain, or where pairs of
//    configurations that are near to each other were not searched for ("node_distance").
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "corank/report/gallery/entry.h"

namespace corank::report {

/// A command that was run, or whose run was stored.
struct GalleryRun {
  int status = 0;  ///< the exit status; 1000 + signal where a signal ended it
  double seconds = 0, processor_seconds = 0;
  std::string output, errors;  ///< standard output, standard error
  bool timed_out = false, stored = false;
};

enum class Standing {
  proven,         ///< the published number, with proof
  agrees,         ///< the published number; the entry says that there is no proof
  contradiction,  ///< proven, and not the published number: the entry says why
  open,           ///< the entry, or the expectation, says why it is not reached
  surprise,       ///< the entry says that it is open, but it is proven by now
  unproven,       ///< the published number, but the proof is missing
  missed,         ///< another number
};
/// "proven", "agrees, not proven", …
std::string to_string(Standing standing);
/// The entry does not hold what it says.
inline bool is_failure(Standing s) { return s == Standing::unproven || s == Standing::missed; }

struct GalleryFinding {
  std::string found;  ///< what corank says, as text: "8", "2 to 4", "0.64395"
  Standing standing = Standing::missed;
};

/// Of each expectation of the question. `open`: the whole entry is.
std::vector<GalleryFinding> compare(const GalleryQuestion& question, const GalleryRun& run, bool open);

/// The boxes that the run processed, as its JSON says; 0: it does not say.
std::uint64_t boxes_processed(const GalleryRun& run);

}  // namespace corank::report
