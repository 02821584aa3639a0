#include "corank/app/output.h"

#include <fmt/format.h>

#include "corank/result/result_file.h"

namespace corank::app {

void give_back_model(QuestionOptions& question, JsonPath& json) {
  if (question.file.empty() && json && !json->empty()) question.file.swap(*json);
}

bool say_json(const JsonPath& json, const std::function<std::string()>& text) {
  if (!json) return true;
  if (json->empty()) {
    fmt::print("{}\n", text());
    return false;
  }
  result::write_text(*json, text() + "\n");
  return true;
}

ExitStatus stopped_early(const solve::Control& control) {
  fmt::print(stderr, "corank: stopped by {}; what is said is proven, but more could be\n", to_string(*control.ending()));
  return kIncomplete;
}

}  // namespace corank::app
