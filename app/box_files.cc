#include "corank/app/box_files.h"

#include <fmt/format.h>

#include <filesystem>

#include "corank/report/printable.h"
#include "corank/report/result_file.h"

namespace corank::app {

report::SolFile read_boxes(const std::string& path) {
  if (std::filesystem::path(path).extension() == ".h5") return report::boxes_of(report::read_result(path));
  return report::read_sol(path);
}

int variable_index(const report::SolFile& boxes, const std::string& file, const std::string& name_or_number) {
  const int index = boxes.find(name_or_number);
  if (index >= 0) return index;
  throw UsageError(
      fmt::format("{} has no variable '{}'; expected a number from 1 to {}{}", file, name_or_number, boxes.size(),
                  boxes.variables.empty() ? "" : fmt::format(" or one of {}", fmt::join(boxes.variables, ", "))));
}

ExitStatus completeness(const report::SolFile& boxes, const std::string& file) {
  for (const report::SolBox& box : boxes.boxes) {
    if (box.verdict != certify::Verdict::pending) continue;
    fmt::print(stderr, "corank: {} is incomplete: its search ended before its end\n", report::printable_line(file));
    return kIncomplete;
  }
  return kDone;
}

void check_output(const std::string& path) {
  if (path.empty()) return;
  std::error_code ignored;
  for (const std::filesystem::path& name : {std::filesystem::path(path), std::filesystem::weakly_canonical(path, ignored)}) {
    if (name.extension() == ".cuik") throw UsageError(path + ": not written over, it looks like a model");
    if (name.extension() == ".param") throw UsageError(path + ": not written over, it looks like a parameter file");
  }
  report::check_writable(path);
}

}  // namespace corank::app
