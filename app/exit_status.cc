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

ExitStatus stopped_early(const solve::Control& control) {
  // A part with a control of its own may have seen the time limit first.
  const auto ending = control.ended() ? control.ending() : std::nullopt;
  fmt::print(stderr, "corank: stopped by {}; what is printed is proven, but more could have been\n",
             ending ? to_string(*ending) : "a limit");
  return kIncomplete;
}

std::string ending_words(const solve::Control& control) {
  return control.ended() ? ", stopped by " + to_string(*control.ending()) : "";
}

}  // namespace corank::app
