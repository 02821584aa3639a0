#include "corank/app/exit_status.h"

#include <fmt/format.h>

#include "corank/result/values/sentences.h"
#include "corank/result/values/words.h"

namespace corank::app {

bool warn_of_assembly(const result::Result& result) {
  if (result::assembled(result) != std::optional(false) && !result.nearly_solved) return false;
  for (const std::string& sentence : result::assembly_sentences(result))
    fmt::print(stderr, "corank: warning: {}\n", result::printable_line(sentence));
  return true;
}

ExitStatus stopped_early(const std::string& stopped) {
  fmt::print(stderr, "corank: stopped by {}; what is printed is proven, but more could have been\n", stopped);
  return kIncomplete;
}

ExitStatus not_close(const std::string& stopped) {
  fmt::print(stderr, "corank: {}the bounds hold, but are not as close as asked for\n",
             stopped.empty() ? "" : "stopped by " + stopped + "; ");
  return kIncomplete;
}

std::string ending_words(const solve::Control& control) {
  const std::string stopped = stopped_by(control);
  return stopped.empty() ? "" : ", stopped by " + stopped;
}

}  // namespace corank::app
