#include <fmt/format.h>
#include <fmt/ranges.h>

#include "corank/analyze/clearance/json.h"
#include "corank/analyze/postures/postures.h"

namespace corank::analyze {
namespace {

std::string value_text(const Interval& x) { return fmt::format("{:.9g}", x.mid()); }

}  // namespace

std::string to_table(const PostureFinder& finder, const Postures& postures) {
  const int least = postures.at_least();
  const auto most = postures.at_most();
  std::string text = finder.question().question.model.name() + ": ";
  if (most == least)
    text += fmt::format("{} posture{}, proven to be all\n", least, least == 1 ? "" : "s");
  else
    text += fmt::format("at least {} posture{}{}\n", least, least == 1 ? "" : "s",
                        most ? fmt::format(", at most {}", *most) : "");
  std::vector<std::vector<std::string>> rows;
  const std::vector<std::string> names = finder.names();
  std::vector<std::string> head{""};
  for (const std::string& name : names) head.push_back(name);
  rows.push_back(head);
  for (std::size_t k = 0; k < postures.found.size(); ++k) {
    const Posture& posture = postures.found[k];
    std::vector<std::string> row{fmt::format("{}{}", k + 1, posture.proven ? "" : " (at the end of a range)")};
    for (const std::string& name : names) {
      const auto at = std::ranges::find(posture.values, name, &CoordinateValue::name);
      row.push_back(at == posture.values.end() ? "" : value_text(at->value));
    }
    rows.push_back(std::move(row));
  }
  std::vector<std::size_t> widths(head.size(), 0);
  for (const auto& row : rows)
    for (std::size_t j = 0; j < row.size(); ++j) widths[j] = std::max(widths[j], row[j].size());
  if (!postures.found.empty())
    for (const auto& row : rows) {
      std::string line = " ";
      for (std::size_t j = 0; j < row.size(); ++j) line += fmt::format(" {:>{}} ", row[j], widths[j]);
      text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
    }
  for (const PostureFamily& family : postures.families) {
    text += family.proven ? fmt::format("  a set of dimension {}, with\n", family.dimension)
                          : "  not decided: a set of postures, double ones, or some at the end of a range, may be in\n";
    for (const CoordinateValue& v : family.values)
      text += fmt::format("    {} in [{:.9g}, {:.9g}]\n", v.name, v.value.lo(), v.value.hi());
  }
  if (!postures.stopped.empty()) text += fmt::format("  stopped by {}: there may be more\n", postures.stopped);
  return text + fmt::format("{} boxes processed, {:.3f} s\n", postures.processed, postures.seconds);
}

std::string to_json(const PostureFinder& finder, const Postures& postures) {
  Json json = {{"model", finder.question().question.model.name()}, {"given", finder.question().given}};
  json["postures"] = Json::array();
  json["proven"] = Json::array();
  for (const Posture& posture : postures.found) {
    json["postures"].push_back(ends_of(posture.values));
    json["proven"].push_back(posture.proven);
  }
  json["at_least"] = postures.at_least();
  json["at_most"] = or_null(postures.at_most());
  json["families"] = Json::array();
  for (const PostureFamily& family : postures.families)
    json["families"].push_back(
        {{"dimension", family.dimension}, {"proven", family.proven}, {"values", ends_of(family.values)}});
  json["complete"] = postures.complete;
  json["stopped"] = or_null(postures.stopped);
  json["processed"] = postures.processed;
  json["seconds"] = postures.seconds;
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace corank::analyze
