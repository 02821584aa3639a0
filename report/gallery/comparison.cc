#include "corank/report/gallery/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

namespace corank::report {
namespace {

using nlohmann::json;

const json* member(const json& object, const char* name) {
  const auto found = object.is_object() ? object.find(name) : object.end();
  return found == object.end() ? nullptr : &*found;
}

bool says_no(const json& answer, const char* name) {
  const json* found = member(answer, name);
  return found && found->is_boolean() && !found->get<bool>();
}

/// Of an answer in boxes: may there be more or fewer solutions than it lists?
bool has_doubtful_boxes(const json& answer) {
  if (const json* apart = member(answer, "node_distance"); apart && !apart->is_null()) return true;
  const json* boxes = member(answer, "boxes");
  if (!boxes) return false;
  return std::ranges::any_of(std::vector{"undecided", "pending", "partial", "boundary"}, [&](const char* name) {
    const json* count = member(*boxes, name);
    return count && count->is_number() && count->get<double>() > 0;
  });
}

/// What is at the pointer: as text, between which bounds if it is a number, and whether these are what is proven.
struct Said {
  std::string text;
  std::optional<double> low{}, high{};
  bool proven = true;
};

constexpr const char *kYes = "yes", *kNo = "no";

std::string number_text(double x) {
  return x == std::round(x) && std::abs(x) < 1e15 ? fmt::format("{:.0f}", x) : fmt::format("{:.9g}", x);
}

Said said_of(const json& found) {
  if (found.is_array()) {
    const auto count = static_cast<double>(found.size());
    return {number_text(count), count, count};
  }
  if (found.is_number()) {
    const double x = found.get<double>();
    return {number_text(x), x, x};
  }
  const json *least = member(found, "at_least"), *most = member(found, "at_most");
  if (least && most && least->is_number()) {
    const double low = least->get<double>();
    if (!most->is_number()) return {number_text(low) + " or more", low, HUGE_VAL, false};
    const double high = most->get<double>();
    if (low == high) return {number_text(low), low, high};
    return {number_text(low) + " to " + number_text(high), low, high, false};
  }
  const json *lo = member(found, "lo"), *hi = member(found, "hi");
  if (lo && hi && lo->is_number() && hi->is_number()) {
    const double low = lo->get<double>(), high = hi->get<double>();
    return {number_text(0.5 * (low + high)), low, high};
  }
  if (found.is_string()) return {found.get<std::string>()};
  if (found.is_boolean()) return {found.get<bool>() ? kYes : kNo};
  return {found.is_null() ? "not known" : "no number", {}, {}, false};
}

bool agrees(const Said& said, const Expectation& e) {
  if (const double* x = std::get_if<double>(&e.value))
    return said.low && *said.low >= *x - e.tolerance && *said.high <= *x + e.tolerance;
  if (const bool* flag = std::get_if<bool>(&e.value)) return said.text == (*flag ? kYes : kNo);
  return said.text == std::get<std::string>(e.value);
}

Standing standing_of(const Expectation& e, bool met, bool proven, bool open) {
  if (open) return met && proven ? Standing::surprise : Standing::open;
  if (!met) return Standing::missed;
  if (!proven) return e.proven ? Standing::unproven : Standing::agrees;
  return e.contradiction.empty() ? Standing::proven : Standing::contradiction;
}

/// Of a run without an answer.
std::string why_nothing(const GalleryRun& run) {
  if (run.timed_out) return fmt::format("nothing within {:.0f} s", run.seconds);
  if (run.status >= 1000) return fmt::format("ended by signal {}", run.status - 1000);
  return fmt::format("no answer, exit status {}", run.status);
}

}  // namespace

std::string to_string(Standing standing) {
  switch (standing) {
    case Standing::proven: return "proven";
    case Standing::agrees: return "agrees, not proven";
    case Standing::contradiction: return "contradicts the publication";
    case Standing::open: return "open";
    case Standing::surprise: return "proven, though the entry says open";
    case Standing::unproven: return "NOT PROVEN";
    default: return "MISSED";
  }
}

std::vector<GalleryFinding> compare(const GalleryQuestion& question, const GalleryRun& run, bool open) {
  std::vector<GalleryFinding> findings;
  const json answer = json::parse(run.output, nullptr, false);
  const bool whole = run.status == 0 && !says_no(answer, "complete") && !says_no(answer, "proven");
  const bool doubtful = has_doubtful_boxes(answer);
  for (const Expectation& e : question.expect) {
    const bool expected_open = open || !e.open.empty();
    const json::json_pointer pointer(e.at);
    if (!answer.is_object() || !answer.contains(pointer)) {
      const std::string found = answer.is_object() ? "nothing at " + e.at : why_nothing(run);
      findings.push_back({found, standing_of(e, false, false, expected_open)});
      continue;
    }
    const Said said = said_of(answer.at(pointer));
    const bool counts_boxes = e.at.starts_with("/boxes") || e.at.starts_with("/points");
    const bool proven = e.proven && whole && said.proven && !(counts_boxes && doubtful);
    findings.push_back({said.text, standing_of(e, agrees(said, e), proven, expected_open)});
  }
  return findings;
}

std::uint64_t boxes_processed(const GalleryRun& run) {
  const json answer = json::parse(run.output, nullptr, false);
  for (const char* at : {"/boxes/processed", "/processed"}) {
    const json::json_pointer pointer(at);
    if (answer.is_object() && answer.contains(pointer) && answer.at(pointer).is_number())
      return answer.at(pointer).get<std::uint64_t>();
  }
  return 0;
}

}  // namespace corank::report
