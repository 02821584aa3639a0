#include "corank/solve/distribution/pace.h"

#include <algorithm>

namespace corank::solve {
namespace {

constexpr std::size_t kAhead = 2;  // units for each thread: the next one is there when one is done
constexpr std::size_t kParts = 8;  // for each thread, of sheets: parts take their time differently
constexpr std::size_t kFirstBoxes = 16, kUnitsPerBox = 8;

// Dask takes 2 ms of one thread for each unit: the more threads there are, the longer units have to be, and boxes that would
// make a short one wait for others.
constexpr double kLeastSeconds = 0.05, kSecondsPerUnit = 5e-3;

constexpr double kOfElapsed = 0.1, kOfRemaining = 0.5;

}  // namespace

Pace::Units Pace::next(std::size_t threads, double longest, const Progress& now) {
  if (now.pass != pass_) {
    pass_ = now.pass;
    begun_ = now.time;
    waited_ = now.waits;
  }
  const double elapsed = now.time - begun_, done = waited_ - now.waits;
  const double remaining = done > 0 ? elapsed * (now.waits / done) : elapsed;
  const double wished = std::max(kLeastSeconds, std::min(kOfElapsed * elapsed, kOfRemaining * remaining));
  const double seconds = std::max(kSecondsPerUnit * static_cast<double>(threads), std::min(longest, wished));
  if (now.units_under_way == 0) return {threads, kFirstBoxes, seconds};
  return {kAhead * threads, now.units_under_way / kUnitsPerBox, seconds};
}

Pace::Units Pace::of_sheets(std::size_t threads, double longest) { return {kParts * threads, 1, longest}; }

}  // namespace corank::solve
