#include "corank/app/box_files.h"

#include <fmt/format.h>

#include <algorithm>

#include "corank/result/files/result_file.h"
#include "corank/result/values/words.h"

namespace corank::app {

result::SolFile read_boxes(const std::string& path) {
  if (std::filesystem::path(path).extension() == ".h5") return result::boxes_of(result::read_result(path));
  return result::read_sol(path);
}

int variable_index(const result::SolFile& boxes, const std::string& file, const std::string& name_or_number) {
  const int index = boxes.find(name_or_number);
  if (index >= 0) return index;
  throw UsageError(
      fmt::format("{} has no variable '{}'; expected a number from 1 to {}{}", file, name_or_number, boxes.size(),
                  boxes.variables.empty() ? "" : fmt::format(" or one of {}", fmt::join(boxes.variables, ", "))));
}

ExitStatus completeness(const result::SolFile& boxes, const std::string& file) {
  const auto pending = [](const result::SolBox& box) { return box.verdict == Verdict::pending; };
  return completeness(std::ranges::none_of(boxes.boxes, pending), file);
}

ExitStatus completeness(bool complete, const std::string& file) {
  if (complete) return kDone;
  fmt::print(stderr, "corank: {} is incomplete: its search had ended early\n", result::printable_line(file));
  return kIncomplete;
}

void check_output(const std::string& path) {
  if (path.empty()) return;
  std::error_code ignored;
  for (const std::filesystem::path& name : {std::filesystem::path(path), std::filesystem::weakly_canonical(path, ignored)}) {
    if (name.extension() == ".cuik") throw UsageError(path + ": not overwritten, because it looks like a model");
    if (name.extension() == ".param") throw UsageError(path + ": not overwritten, because it looks like a parameter file");
  }
  result::check_writable(path);
}

void check_folder(const std::filesystem::path& folder) {
  const std::filesystem::path figures = folder / "figures";
  std::error_code error;
  std::filesystem::create_directories(figures, error);
  if (error)
    throw result::ResultFileError(fmt::format("{}: no folder can be made there: {}", figures.string(), error.message()));
  result::check_writable(folder / "index.html");
}

}  // namespace corank::app
