#include "corank/result/assembled.h"

#include <fmt/format.h>

#include <algorithm>

#include "corank/result/tallies.h"
#include "corank/result/words.h"
#include "corank/symbolic/set_definition.h"

namespace corank::result {
namespace {

// A solution within the ranges: a `boundary` box may hold one outside, a `partial` one none.
bool holds_a_configuration(const CoverBox& box) {
  return box.verdict == Verdict::regular || box.verdict == Verdict::isolated || box.verdict == Verdict::exact;
}

bool is_proven_empty(const Result& result) { return result.cover.boxes.empty() && result.cover.complete(); }

// The result that speaks of C-space.
const Result& of_configurations(const Result& result) { return result.assembly.empty() ? result : result.assembly.front(); }

std::string sample_text(const Sample& sample) {
  constexpr int kDigits = 6;
  constexpr std::size_t kMost = 8;
  std::vector<std::string> texts;
  for (const Value& v : values(*sample.of, *sample.box, sample.of->configuration_size)) {
    if (texts.size() == kMost) return fmt::format("{} … (all coordinates: --json)", fmt::join(texts, ", "));
    texts.push_back(fmt::format("{} = {:.{}g}", v.name, v.value.mid(), kDigits));
  }
  return fmt::format("{}", fmt::join(texts, ", "));
}

std::string unknown_text(const Result& result) {
  if (result.assembly.empty())
    return result.stopped.empty() ? "corank did not search for a configuration" : "stopped by " + result.stopped;
  const Result& search = result.assembly.front();
  if (!search.stopped.empty())
    return fmt::format("stopped by {}, after {} boxes", search.stopped, search.cover.statistics.processed);
  return "C-space is not proven to be empty, but no configuration is proven to exist";
}

}  // namespace

std::optional<Sample> sample(const Result& result) {
  if (result.set == symbolic::definition(std::nullopt).name) return std::nullopt;
  const Result& from = of_configurations(result);
  const auto found = std::find_if(from.cover.boxes.begin(), from.cover.boxes.end(), holds_a_configuration);
  if (found == from.cover.boxes.end()) return std::nullopt;
  return Sample{&from, &*found};
}

std::optional<bool> assembled(const Result& result) {
  if (sample(result)) return true;
  const Result& from = of_configurations(result);
  const bool of_cspace = !result.assembly.empty() || symbolic::definition(result.set).is_cspace();
  return of_cspace && is_proven_empty(from) ? std::optional(false) : std::nullopt;
}

std::vector<std::string> assembly_sentences(const Result& result) {
  std::vector<std::string> list;
  if (!is_proven_empty(result)) return list;
  if (result.set != symbolic::definition(std::nullopt).name) {
    const auto can = assembled(result);
    list.push_back(!can   ? "it is not known whether the robot can be assembled within its ranges: " + unknown_text(result)
                   : *can ? "the robot can be assembled within its ranges; this configuration is proven to exist: " +
                                sample_text(*sample(result))
                          : "the robot cannot be assembled within its ranges: it is proven that it has no configuration");
  }
  if (result.nearly_solved)
    list.push_back(fmt::format(
        "there are solutions if the coefficients may vary by {0:g} of their size: equations that depend on each other "
        "contradict each other once their decimals are rounded; use --tolerance {0:g}, or write exact numbers such as "
        "sqrt(3)/2",
        kRounding));
  return list;
}

}  // namespace corank::result
