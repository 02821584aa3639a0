#include "corank/result/cuik/cuik_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cfenv>
#include <cstdio>
#include <cstdlib>

#include "corank/result/values/tallies.h"

namespace corank::result {
namespace {

const std::string kRule(74, '=');

// glibc's printf rounds decimals in the current rounding mode (exactly, at any number of digits). 17 digits to the nearest
// read back as the same double, but rounded outward they may lie beyond the middle to the next one; 18 never do.
std::string bound_text(double x, int rounding_mode) {
  const int former = std::fegetround();
  std::array<char, 64> text;
  for (int digits = 17;; ++digits) {
    std::fesetround(rounding_mode);
    std::snprintf(text.data(), text.size(), "%.*g", digits, x);
    std::fesetround(FE_TONEAREST);
    if (digits == 18 || std::strtod(text.data(), nullptr) == x) break;
  }
  std::fesetround(former);
  return text.data();
}

// No brace outside boxes: to CUIK's reader each one begins a box.
std::string without_braces(std::string text) {
  std::ranges::replace(text, '{', '(');
  std::ranges::replace(text, '}', ')');
  return text;
}

void append_box(std::string& out, const std::vector<std::string>& names, const SolBox& box) {
  out += fmt::format("{{ {}  ", box.box.size());
  for (std::size_t i = 0; i < box.box.size(); ++i)
    out += (names.empty() ? "" : names[i]) + outward_interval_text(box.box[i]) + " ";
  out += "}";
  if (box.verdict) out += fmt::format(" % {}", to_string(*box.verdict));
  for (std::size_t i = 0; box.verdict && i < box.free.size(); ++i) out += (i == 0 ? ", free " : " ") + box.free[i];
  out += "\n";
}

std::string statistics(const Result& result) {
  const Cover& cover = result.cover;
  std::string out = "STATISTICS FOR corank:\n\n";
  out += fmt::format("Time: {:.2f} seg\n", cover.statistics.seconds_total);
  out += fmt::format("Box level information:\n  N processed boxes : {:6}\n", cover.statistics.processed);
  const std::size_t proven = std::ranges::count_if(cover.boxes, is_surely_within, &CoverBox::verdict);
  out += fmt::format("    N solution boxes: {:6} ({})\n", cover.boxes.size(), proven);
  for (int v = 0; v < kVerdicts; ++v) {
    const auto verdict = static_cast<Verdict>(v);
    if (const std::size_t n = cover.count(verdict); n > 0) out += fmt::format("      {:<16}: {:6}\n", to_string(verdict), n);
  }
  out += cover.complete() ? "Complete: every solution in the search domain is in a box\n"
                          : "Incomplete: the search ended early; pending boxes were not searched\n";
  return out;
}

}  // namespace

std::string outward_interval_text(const Interval& x) {
  return "[" + bound_text(x.lo(), FE_DOWNWARD) + "," + bound_text(x.hi(), FE_UPWARD) + "]";
}

SolFile boxes_of(const Result& result, bool with_auxiliary) {
  SolFile out;
  std::vector<std::size_t> listed;
  for (std::size_t i = 0; i < result.variables.size(); ++i) {
    if (result.variables[i].auxiliary && !with_auxiliary) continue;
    listed.push_back(i);
    out.variables.push_back(result.variables[i].name);
  }
  for (const CoverBox& from : result.cover.boxes) {
    SolBox& box = out.boxes.emplace_back();
    for (const std::size_t i : listed) box.box.push_back(from.box.at(i));
    box.verdict = from.verdict;
    for (const int v : from.free) {
      const ResultVariable& variable = result.variables.at(v);
      if (with_auxiliary || !variable.auxiliary) box.free.push_back(variable.name);
    }
  }
  return out;
}

std::string to_sol(const SolFile& boxes) {
  std::string out;
  for (const SolBox& box : boxes.boxes) append_box(out, boxes.variables, box);
  return out;
}

std::string to_sol(const Result& result) {
  const SolFile boxes = boxes_of(result, false);
  std::string out = fmt::format("\n{}\nWritten by corank {}\n{}\n% PARAMETERS:\n", kRule, result.version, kRule);
  const std::string model = without_braces(result.model);
  out += fmt::format("   SIGMA = {}\n", result.cover.sigma.largest());
  if (result.options.max_solutions > 0) out += fmt::format("   N_SOLUTIONS = {}\n", result.options.max_solutions);
  out += fmt::format("\n{}\nEquations from file: {}.cuik\n", kRule, model);
  out += fmt::format("% the set solved: {}\n", result.set);
  if (result.options.tolerance > 0)
    out += fmt::format("% coefficients that are not integers: within {} of their size\n", result.options.tolerance);
  for (const ConstantOverride& c : result.options.constants)
    out += without_braces(fmt::format("% with {} = {}\n", c.name, c.expression));
  out += fmt::format("{}\n\n{}\nSOLUTIONS (to input file {}.cuik):\n\n", without_braces(result.model_text), kRule, model);
  for (std::size_t i = 0; i < boxes.boxes.size(); ++i) {
    const SolBox& box = boxes.boxes[i];
    out += fmt::format("{:4} :{}", i + 1, is_surely_within(*box.verdict) ? " <S> " : " ");
    append_box(out, boxes.variables, box);
  }
  return out + fmt::format("{}\n\n{}\n\nEND OF THE SOLUTION FILE\n", statistics(result), kRule);
}

}  // namespace corank::result
