#include "corank/symbolic/sets/left_out.h"

#include <filesystem>

namespace corank::symbolic {
namespace {

std::string list(const std::vector<std::size_t>& numbers, const std::string& of) {
  std::string text;
  for (const std::size_t number : numbers) text += (text.empty() ? "(" : ", (") + std::to_string(number) + ")";
  return text + " of " + of;
}

}  // namespace

std::string LeftOut::source() const {
  // The file without its folders, as in singularity_system.h.
  const std::string line = SourceLocation{std::filesystem::path(where.file).filename().string(), where.line, 0}.text();
  return note.empty() ? line : line + " (" + note + ")";
}

std::string LeftOut::reason() const {
  if (equations.empty() && rows.empty()) return "follows from sin^2 + cos^2 = 1";
  return "follows from " + (equations.empty() ? "" : list(equations, "Φ(q) = 0")) +
         (equations.empty() || rows.empty() ? "" : " and ") + (rows.empty() ? "" : list(rows, "L"));
}

}  // namespace corank::symbolic
