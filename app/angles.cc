// corank angles: from sines and cosines to angles, in the boxes of a result.

#include <algorithm>
#include <set>

#include "corank/app/box_files.h"
#include "corank/app/subcommands.h"
#include "corank/certify/angle.h"

namespace corank::app {
namespace {

struct Pair {
  int sine, cosine;
};

std::vector<Pair> pairs_of(const std::vector<std::string>& words, const result::SolFile& boxes) {
  std::vector<Pair> pairs;
  std::set<int> seen;
  for (std::size_t i = 1; i + 2 < words.size(); i += 2) {
    const Pair pair{variable_index(boxes, words[0], words[i]), variable_index(boxes, words[0], words[i + 1])};
    for (const int v : {pair.sine, pair.cosine}) {
      if (!seen.insert(v).second) throw UsageError(fmt::format("variable {} occurs twice in the pairs", v + 1));
    }
    pairs.push_back(pair);
  }
  return pairs;
}

// "atan2_st4_ct4", longer where a variable has that name.
std::string angle_name(const result::SolFile& boxes, const Pair& pair) {
  const auto name = [&boxes](int v) { return boxes.variables.at(v); };
  std::string text = "atan2_" + name(pair.sine) + "_" + name(pair.cosine);
  while (std::ranges::find(boxes.variables, text) != boxes.variables.end()) text += "_";
  return text;
}

// A regular or isolated box makes a claim about the solutions with these sines and cosines, and none about the angles' whole
// intervals: its verdict does not pass over. The lack of a claim does.
std::optional<Verdict> verdict_in_angles(const std::optional<Verdict>& verdict) {
  const bool claims_nothing = verdict == Verdict::undecided || verdict == Verdict::pending;
  return claims_nothing ? verdict : std::nullopt;
}

result::SolFile in_angles(const result::SolFile& boxes, const std::vector<Pair>& pairs) {
  std::set<std::size_t> replaced;
  for (const Pair& p : pairs)
    for (const int v : {p.sine, p.cosine}) replaced.insert(v);
  result::SolFile out;
  for (std::size_t i = 0; i < boxes.variables.size(); ++i) {
    if (!replaced.contains(i)) out.variables.push_back(boxes.variables[i]);
  }
  for (const Pair& p : pairs) {
    if (!boxes.variables.empty()) out.variables.push_back(angle_name(boxes, p));
  }
  // Wide enough for atan2 itself and for its going on beyond π where a box crosses the negative axis: no turn is ever added.
  const Interval range(-4, 7);
  for (const result::SolBox& from : boxes.boxes) {
    result::SolBox& box = out.boxes.emplace_back();
    for (std::size_t i = 0; i < from.box.size(); ++i) {
      if (!replaced.contains(i)) box.box.push_back(from.box[i]);
    }
    const auto at = [&from](int v) { return from.box[v]; };
    for (const Pair& p : pairs) box.box.push_back(certify::angle_enclosure(at(p.cosine), at(p.sine), range));
    box.verdict = verdict_in_angles(from.verdict);
  }
  return out;
}

ExitStatus angles(const std::vector<std::string>& words, double time_limit) {
  if (words.size() < 4 || words.size() % 2 != 0)
    throw UsageError("expected RESULT, pairs of a sine and a cosine, and OUTPUT.sol; corank angles --help tells more");
  WholeRun run(time_limit);
  run.enter("reading the boxes");
  const result::SolFile boxes = read_boxes(words.front());
  const std::vector<Pair> pairs = pairs_of(words, boxes);
  check_output(words.back());
  run.enter("computing the angles");
  const std::string text = result::to_sol(in_angles(boxes, pairs));
  run.enter("writing the boxes");
  result::write_text(words.back(), text);
  return completeness(boxes, words.front());
}

}  // namespace

void add_angles(CLI::App& program, Action& action) {
  CLI::App* sub =
      program.add_subcommand("angles", "Replace pairs of a sine and a cosine by angles, in the boxes of a result");
  const auto words = std::make_shared<std::vector<std::string>>();
  sub->add_option("WORDS", *words,
                  "The result (.sol or .h5), pairs of variables by name or by number from 1, and the new file (.sol)")
      ->type_name("RESULT SINE COSINE [SINE COSINE ...] OUTPUT.sol")
      ->required();
  const auto time_limit = std::make_shared<double>(0);
  add_time_limit(*sub, *time_limit);
  sub->footer(
      "An angle is an interval in radians that encloses all angles of its box. The angles come after the other variables, "
      "in the\n"
      "order of the pairs. An interval that crosses pi goes on beyond it: it does not start again at -pi.\n\n"
      "Exit status: 0 done, 1 bad input, 2 wrong usage, 3 stopped by the limit or an interrupt, or done,\n"
      "but the search of the result had ended early.\n\n"
      "Example:\n  corank angles forward.sol st4 ct4 st2 ct2 forward_angles.sol");
  sub->callback([=, &action] { action = [=] { return angles(*words, *time_limit); }; });
}

}  // namespace corank::app
