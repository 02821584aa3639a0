// What a check found, as a table and as JSON.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "corank/result/files/verification.h"
#include "corank/result/values/sentences.h"
#include "corank/result/values/summary.h"
#include "corank/result/values/words.h"

namespace corank::result {
namespace {
using check::Failure;
using check::Report;
using check::Tally;
using Json = nlohmann::ordered_json;

constexpr std::size_t kShownFailures = 10;

const char* word(Failure::Place place) {
  switch (place) {
    case Failure::Place::cover: return "cover";
    case Failure::Place::box: return "box";
    case Failure::Place::point: return "point";
    case Failure::Place::exact_point: return "exact point";
    case Failure::Place::step: return "step of the proof";
  }
  return "?";
}

bool any(const Tally& t) { return t.verified + t.failed + t.unchecked > 0; }

std::string row(const std::string& name, const Tally& t) {
  return any(t) ? fmt::format("  {:<12}  {:>9}  {:>9}  {:>13}\n", name, t.verified, t.failed, t.unchecked) : "";
}

std::string completeness(const Report& report, bool complete) {
  const check::ProofTally& proof = report.proof;
  if (!proof.present && (report.interrupted || report.left_out > 0)) return "";
  if (!proof.present) return "completeness: no proof in the file\n";
  const char* const shown = proof.verified ? "replayed" : report.interrupted ? "not shown yet" : "NOT SHOWN";
  std::string text = fmt::format("completeness: {}, {} steps, {} leaves, {} parts searched again\n", shown, proof.steps,
                                 proof.leaves, proof.searched);
  if (proof.open)
    text += "  it could not be shown next to a self-motion, where the equations say little; it may hold nevertheless\n";
  if (proof.verified && !complete) text += "  except for the pending boxes: the search ended early\n";
  return text;
}

// Of boxes that claim nothing, and what ends the table.
std::string conclusion(const Verification& verification, const Result& result) {
  const Report& report = verification.report;
  std::string text;
  const std::size_t open = report.boxes[static_cast<std::size_t>(Verdict::undecided)].unchecked,
                    pending = report.boxes[static_cast<std::size_t>(Verdict::pending)].unchecked;
  if (report.interrupted) {
    std::size_t checked = 0;
    for (const Tally& t : report.boxes) checked += t.verified + t.failed;
    return fmt::format("interrupted in {}: {} of {} boxes were checked{}; nothing is said about the rest\n", report.stage,
                       checked, result.cover.boxes.size(), report.failures.empty() ? "" : ", NOT VERIFIED");
  }
  if (report.left_out > 0) {
    constexpr double kSurely = 3;  // (1 − 3/n)^n < 5 %
    const std::size_t all = result.cover.boxes.size(), n = all - report.left_out;
    text = fmt::format("a sample: {} of {} boxes, chosen at random, were checked; nothing is said about the others{}\n", n,
                       all, result.cover.proof ? " or about completeness" : "");
    if (!verification.contradictions.empty() || !report.confirmed()) return text + "NOT VERIFIED\n";
    if (static_cast<double>(n) > kSurely)
      text += fmt::format(
          "if more than {:.2g} % of all boxes were wrong, at least 95 % of such samples would hold one of them\n",
          100 * kSurely / static_cast<double>(n));
    return text + "verified, but only the sample\n";
  }
  if (open > 0) text += fmt::format("{} undecided box{} nothing\n", open, open == 1 ? " claims" : "es claim");
  if (pending > 0) text += fmt::format("{} pending box{} not searched\n", pending, pending == 1 ? " was" : "es were");
  return text + (verification.complete()   ? "verified\n"
                 : verification.verified() ? "verified, except for completeness\n"
                                           : "NOT VERIFIED\n");
}

Json to_json(const Tally& t) { return {{"verified", t.verified}, {"failed", t.failed}, {"not_checkable", t.unchecked}}; }

// "the robot can be assembled: confirmed".
std::string assembly_text(const Verification& verification, const Result& result) {
  const std::optional<bool> claimed = assembled(result);
  if (result.assembly.empty() || !claimed) return "";
  return fmt::format("the robot {} within its ranges: {}\n", *claimed ? "can be assembled" : "cannot be assembled",
                     verification.assembled == claimed ? "confirmed" : "NOT CONFIRMED");
}

}  // namespace

std::string to_table(const Verification& verification, const Result& result) {
  const Report& report = verification.report;
  std::string text = fmt::format("{}, {}: checked against its model with intervals of 160 bits and exact numbers\n\n",
                                 result.model, symbolic::set_with_corank(result.set, result.options.corank));
  for (const std::string& c : verification.contradictions) text += "file: " + c + "\n";
  if (!verification.contradictions.empty()) return printable(text + "NOT VERIFIED: nothing else was checked\n");
  text += fmt::format("  {:<12}  {:>9}  {:>9}  {:>13}\n", "verdict", "verified", "failed", "not checkable");
  for (int v = 0; v < kVerdicts; ++v) text += row(to_string(static_cast<Verdict>(v)), report.boxes[v]);
  text += row("points", report.points) + row("exact points", report.exact_points);
  text += "\n" + completeness(report, result.cover.complete());
  text += assembly_text(verification, result);
  if (const auto& samples = verification.samples;
      samples && samples->failures.empty() && samples->of_set + samples->of_parts > 0)
    text += fmt::format("parts: {} of the set and {} of its parts, drawn at random, are in the others\n",
                        counted(samples->of_set, "solution"), samples->of_parts);
  if (!result.cover.decimals.empty()) text += "decimals: they lie in their boxes, but were not proven again\n";
  for (std::size_t i = 0; i < std::min(report.failures.size(), kShownFailures); ++i) {
    const Failure& f = report.failures[i];
    text += f.place == Failure::Place::cover ? fmt::format("cover: {}\n", f.reason)
                                             : fmt::format("{} {}: {}\n", word(f.place), f.index + 1, f.reason);
  }
  if (report.failures.size() > kShownFailures)
    text += fmt::format("… and {} more\n", report.failures.size() - kShownFailures);
  return printable(text + conclusion(verification, result));
}

std::string to_json(const Verification& verification) {
  const Report& report = verification.report;
  Json json;
  json["verified"] = verification.verified();
  json["complete"] = verification.complete();
  json["interrupted"] = report.interrupted;
  if (report.interrupted) json["stage"] = report.stage;
  if (report.left_out > 0) json["not_in_sample"] = report.left_out;
  for (int v = 0; v < kVerdicts; ++v) json["verdicts"][to_string(static_cast<Verdict>(v))] = to_json(report.boxes[v]);
  json["points"] = to_json(report.points);
  json["exact_points"] = to_json(report.exact_points);
  json["assembled"] = verification.assembled ? Json(*verification.assembled) : Json();
  const check::ProofTally& proof = report.proof;
  json["completeness"] = {{"proof", proof.present}, {"verified", proof.verified}, {"open", proof.open},
                          {"steps", proof.steps},   {"leaves", proof.leaves},     {"searched", proof.searched}};
  if (const auto& samples = verification.samples)
    json["samples"] = {{"of_set", samples->of_set}, {"of_parts", samples->of_parts}};
  json["contradictions"] = verification.contradictions;
  json["failures"] = Json::array();
  for (const Failure& f : report.failures)
    json["failures"].push_back({{"what", word(f.place)}, {"number", f.index + 1}, {"reason", f.reason}});
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

std::string ended_early_json(const std::string& stage) {
  return Json{{"verified", false}, {"complete", false}, {"interrupted", true}, {"stage", stage}}.dump(2);
}

}  // namespace corank::result
