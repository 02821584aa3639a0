// Postures of one pose and of many, in words, as a table and as JSON.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "corank/analyze/clearance/json.h"
#include "corank/analyze/postures/posture_table.h"
#include "corank/result/values/words.h"

namespace corank::analyze {
namespace {

constexpr std::size_t kShown = 5;  // differences in a table

std::string value_text(const Interval& x) { return fmt::format("{:.9g}", x.mid()); }

Json json_about(const PostureFinder& finder) {
  return {{"model", finder.question().question.model.name()}, {"given", finder.question().given}};
}

void add_to(Json& json, const Postures& postures) {
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
}

Json differences(const PostureFinder& finder, const std::vector<Comparison::Difference>& list) {
  Json json = Json::array();
  const std::vector<std::string> names = finder.names();
  for (const Comparison::Difference& d : list) {
    Json values = Json::object();
    for (std::size_t k = 0; k < names.size(); ++k) values[names[k]] = d.values[k];
    json.push_back({{"pose", d.pose + 1}, {"values", values}});
  }
  return json;
}

std::string lines_of(const char* what, const PostureFinder& finder, const std::vector<Comparison::Difference>& list) {
  std::string text = fmt::format("  {:<9}{}\n", what, list.size());
  const std::vector<std::string> names = finder.names();
  for (std::size_t k = 0; k < std::min(list.size(), kShown); ++k) {
    text += fmt::format("    pose {}:", list[k].pose + 1);
    for (std::size_t j = 0; j < names.size(); ++j) text += fmt::format(" {} = {:.9g}", names[j], list[k].values[j]);
    text += "\n";
  }
  if (list.size() > kShown) text += fmt::format("    … and {} more\n", list.size() - kShown);
  return text;
}

}  // namespace

std::string to_table(const PostureFinder& finder, const Postures& postures) {
  const int least = postures.at_least();
  const auto most = postures.at_most();
  std::string text = finder.question().question.model.name() + ": ";
  if (most == least)
    text += fmt::format("{}, proven to be all\n", result::counted(least, "posture"));
  else
    text +=
        fmt::format("at least {}{}\n", result::counted(least, "posture"), most ? fmt::format(", at most {}", *most) : "");
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
  return text + fmt::format("{} processed, {:.3f} s\n", result::counted(postures.processed, "box"), postures.seconds);
}

std::string to_json(const PostureFinder& finder, const Postures& postures) {
  Json json = json_about(finder);
  add_to(json, postures);
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

std::string to_csv(const PostureFinder& finder, const std::vector<Postures>& postures) {
  std::string text = fmt::format("pose,at_least,at_most,posture,{}\n", fmt::join(finder.names(), ","));
  for (std::size_t p = 0; p < postures.size(); ++p) {
    const auto most = postures[p].at_most();
    const std::string start = fmt::format("{},{},{},", p + 1, postures[p].at_least(), most ? std::to_string(*most) : "");
    if (postures[p].found.empty()) text += start + std::string(finder.names().size(), ',') + "\n";
    for (std::size_t k = 0; k < postures[p].found.size(); ++k) {
      text += start + std::to_string(k + 1);
      for (const CoordinateValue& v : postures[p].found[k].values) text += fmt::format(",{:.17g}", v.value.mid());
      text += "\n";
    }
  }
  return text;
}

std::string to_json(const PostureFinder& finder, const std::vector<Postures>& postures, const Comparison* comparison) {
  Json json = json_about(finder);
  json["poses"] = Json::array();
  for (const Postures& p : postures) add_to(json["poses"].emplace_back(Json::object()), p);
  if (comparison)
    json["against"] = {{"agreed", comparison->agreed},
                       {"missing", differences(finder, comparison->missing)},
                       {"wrong", differences(finder, comparison->wrong)},
                       {"open", differences(finder, comparison->open)}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string to_table(const PostureFinder& finder, const std::vector<Postures>& postures, const Comparison* comparison) {
  std::string text =
      fmt::format("{}: {}\n", finder.question().question.model.name(), result::counted(postures.size(), "pose"));
  std::map<int, std::size_t> exactly;
  std::size_t open = 0;
  for (const Postures& p : postures) {
    const auto most = p.at_most();
    if (most && *most == p.at_least())
      ++exactly[*most];
    else
      ++open;
  }
  for (const auto& [count, poses] : exactly)
    text += fmt::format("  {:>2} {:<9} {}, proven to be all\n", count, result::noun(count, "posture"),
                        result::counted(poses, "pose"));
  if (open > 0) text += fmt::format("  not known    {}: bounds only, or sets of postures\n", result::counted(open, "pose"));
  text += stopped_line(stopped_by(postures));
  if (!comparison) return text;
  text += "compared with the others:\n";
  text += fmt::format("  {:<9}{}\n", "agreed", comparison->agreed);
  text += lines_of("missing", finder, comparison->missing);
  text += lines_of("wrong", finder, comparison->wrong);
  return text + lines_of("open", finder, comparison->open);
}

}  // namespace corank::analyze
