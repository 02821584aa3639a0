#include "corank/study/cost.h"

#include <fmt/format.h>

#include <cmath>

#include "corank/result/values/summary.h"
#include "corank/result/values/words.h"

namespace corank::study {
namespace {

using solve::CostRange;

void add(CostRange& sum, const CostRange& part) {
  sum.low += part.low;
  sum.likely += part.likely;
  sum.high += part.high;
}

std::string range_text(const CostRange& range, double unit, const char* name) {
  return fmt::format("{:.2g}{}  ({:.2g} to {:.2g})", range.likely / unit, name, range.low / unit, range.high / unit);
}

std::string count_text(const CostRange& range) {
  const auto text = [](double count) { return count < 1e5 ? fmt::format("{:.0f}", count) : fmt::format("{:.2g}", count); };
  return fmt::format("{}  ({} to {})", text(range.likely), text(range.low), text(range.high));
}

std::string bytes_text(const CostRange& range) {
  if (range.likely >= 1e9) return range_text(range, 1e9, " GB");
  return range_text(range, 1e6, " MB");
}

std::string time_text(const CostRange& range) {
  if (range.likely >= 7200) return range_text(range, 3600, " h");
  if (range.likely >= 120) return range_text(range, 60, " min");
  return range_text(range, 1, " s");
}

std::string json_of(const CostRange& range) {
  return fmt::format("{{\"low\": {:.6g}, \"likely\": {:.6g}, \"high\": {:.6g}}}", range.low, range.likely, range.high);
}

}  // namespace

solve::CostEstimate estimate(const std::vector<System>& systems, const solve::Options& options, solve::Control& control,
                             double seconds) {
  solve::CostEstimate sum;
  sum.whole_tree = true;
  double postponed = 0;
  for (const System& system : systems) {
    const solve::Prepared prepared = solve::prepare(system, options, control);
    const solve::CostEstimate cost = solve::estimate(prepared, control, seconds / static_cast<double>(systems.size()));
    add(sum.processed, cost.processed);
    add(sum.sheets, cost.sheets);
    add(sum.boxes, cost.boxes);
    add(sum.seconds, cost.seconds);
    add(sum.memory, cost.memory);
    add(sum.file, cost.file);
    postponed += cost.postponed * cost.processed.likely;
    sum.sigma = cost.sigma;
    sum.whole_tree = sum.whole_tree && cost.whole_tree;
    sum.trial_seconds += cost.trial_seconds;
  }
  if (systems.size() > 1)
    add(sum.file, solve::CostRange(sum.file));  // twice: the boxes stand in the whole and in their parts
  if (sum.processed.likely > 0) sum.postponed = postponed / sum.processed.likely;
  return sum;
}

std::string to_table(const solve::CostEstimate& cost, int threads) {
  constexpr double kManyPostponed = 0.01;
  std::string text =
      fmt::format("estimate by a trial of {:.1f} s, for {}\n\n", cost.trial_seconds, result::sigma_text(cost.sigma));
  text += "boxes to process    " + count_text(cost.processed) + "\n";
  text += "boxes returned      " + count_text(cost.boxes) + "\n";
  text += fmt::format("time                {}, with {}\n", time_text(cost.seconds), result::counted(threads, "thread"));
  text += "memory              " + bytes_text(cost.memory) + "\n";
  text += "result file         " + bytes_text(cost.file) + "\n\n";
  if (cost.whole_tree) {
    text += "the trial was a complete first pass: its number of processed boxes is exact, except for later passes\n";
  } else {
    text += "in brackets: two standard errors of the trial; likely ranges, not bounds\n";
  }
  if (cost.postponed > kManyPostponed)
    text += fmt::format(
        "{:.1f} % of the boxes are next to degenerate solutions; what dividing them further takes is not in these numbers\n",
        100 * cost.postponed);
  return text;
}

std::string to_json(const solve::CostEstimate& cost, int threads) {
  const auto sigma = [](double value) { return std::isinf(value) ? "null" : fmt::format("{:.17g}", value); };
  return fmt::format(
      "{{\n  \"processed\": {},\n  \"sheets\": {},\n  \"boxes\": {},\n  \"seconds\": {},\n  \"memory_bytes\": {},\n"
      "  \"file_bytes\": {},\n  \"sigma_length\": {},\n  \"sigma_angle\": {},\n  \"threads\": {},\n"
      "  \"whole_tree\": {},\n  \"postponed\": {:.6g},\n  \"trial_seconds\": {:.6g}\n}}",
      json_of(cost.processed), json_of(cost.sheets), json_of(cost.boxes), json_of(cost.seconds), json_of(cost.memory),
      json_of(cost.file), sigma(cost.sigma.length), sigma(cost.sigma.angle), threads, cost.whole_tree, cost.postponed,
      cost.trial_seconds);
}

}  // namespace corank::study
