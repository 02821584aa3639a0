// Answers what a page of the studio asks for, one line of JSON after the other, without any network: the model and its
// constants, then pictures of the sets, coarse ones at once and finer ones later.
//
//   studio::answer(request, [](const std::string& line) { std::puts(line.c_str()); }, stop);
//
// Each line is an object with "event" and the request's "number":
//
//   begun     first of all; a process that reads requests says `bad`, with a "message", of one that makes no sense
//   model     "name", "constants", "sets" (those that may be asked for), "notices", "dimension" of the drawing
//   error     "message", "line", "column" (0: unknown), instead of all that follows
//   refused   "set", "message": this set is none of the model's
//   progress  "set", "stage", "share" of the search domain that is done with, "boxes" processed
//   picture   "pass" (0: coarse), "model": as report::live_model() gives it, with the sets that are new
//   colours   "colours": of the boxes of the last picture's C-space, as report::aspects_json() gives them, or null;
//             "summary": what is known, in words
//   report    "html": the page of corank report
//   done      "complete": no limit has ended a search, "seconds"
#pragma once

#include <atomic>
#include <functional>
#include <string>

#include "corank/studio/request.h"

namespace corank::studio {

using Emit = std::function<void(const std::string& line)>;

struct SessionLimits {
  double coarse_seconds = 0.5;           ///< of each search of the first pass
  double seconds = 8;                    ///< of each finer one
  double analysis_seconds = 30;          ///< of the aspects
  std::uint64_t boxes = 60'000;          ///< that are found of each set: a browser draws them
  std::uint64_t memory = 1'500'000'000;  ///< bytes that a search may take
  int threads = 0;                       ///< 0: one for each core
};

/// Ends soon after `stop` is true, without `done`. Never throws for what is wrong with a request or a model: that is an
/// event. GiNaC is not thread-safe: a process has one answer at a time.
void answer(const Request& request, const Emit& emit, const std::atomic<bool>& stop, const SessionLimits& limits = {});

}  // namespace corank::studio
