#include <fmt/format.h>

#include <array>

#include "corank/analyze/clearance/json.h"
#include "corank/analyze/robots/robots_words.h"
#include "corank/analyze/topology/topology.h"
#include "corank/core/check.h"
#include "corank/result/values/claim_files.h"
#include "corank/result/values/words.h"

namespace corank::analyze {
namespace {

using result::counted;

std::string components_text(const Components& c) {
  if (c.exact()) return counted(c.at_least, "component");
  return c.at_most ? fmt::format("from {} to {} components ({})", c.at_least, *c.at_most, c.reason)
                   : fmt::format("at least {} ({})", counted(c.at_least, "component"), c.reason);
}

const char* surface_name(int genus) {
  constexpr std::array kNames{"sphere", "torus", "double torus"};
  return genus < 3 ? kNames[genus] : "closed surface";
}

// "2 tori (genus 1)": of equal ones together.
std::string shapes(const std::vector<int>& genus) {
  std::string text;
  for (std::size_t i = 0, j = 0; i < genus.size(); i = j) {
    while (j < genus.size() && genus[j] == genus[i]) ++j;
    text += (i == 0 ? "" : ", ") + fmt::format("{} × {} (genus {})", j - i, surface_name(genus[i]), genus[i]);
  }
  return text;
}

// "2 circles", "1 arc, 1 circle": each arc has the characteristic 1.
std::string curves(int components, int arcs) {
  std::vector<std::string> parts;
  if (arcs > 0) parts.push_back(counted(arcs, "arc"));
  if (components > arcs) parts.push_back(counted(components - arcs, "closed curve"));
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string bounded_surface(int genus, int curves) {
  if (curves == 0) return fmt::format("1 × {} (genus {})", surface_name(genus), genus);
  if (genus == 0 && curves <= 2)
    return curves == 1 ? "1 × disk (genus 0, 1 boundary curve)" : "1 × annulus (genus 0, 2 boundary curves)";
  return fmt::format("1 × {} with {} (genus {}, {})", surface_name(genus), counted(curves, "hole"), genus,
                     counted(curves, "boundary curve"));
}

}  // namespace

result::ShapeFile to_file(const study::Question& question, const Topology& topology) {
  CORANK_CHECK(topology.certificate != nullptr);
  auto file = file_about<result::ShapeFile>(question);
  file.shape = *topology.certificate;
  return file;
}

std::string to_text(const study::Question& question, const Topology& t) {
  const bool is_plain = question.model.is_plain_system();
  std::string text = fmt::format("{}, {}\n", question.model.name(), is_plain ? "solutions of the system" : "C-space");
  if (t.robots) text += robots_text(*t.robots);
  if (t.components.at_most == 0)
    return text + fmt::format("  there is no {} in the search domain\n", is_plain ? "solution" : "configuration") +
           stopped_line(t.stopped);
  text += fmt::format("  dimension             {}\n", t.dimension);
  text += fmt::format("  components            {}\n", components_text(t.components));
  if (t.dimension > 0 && t.ends.empty())
    text += fmt::format("  smooth, without ends  {}\n", t.smooth ? "proven" : "not shown");
  if (!t.ends.empty()) text += fmt::format("  smooth, with ends     {}\n", t.with_ends ? "proven" : "not shown");
  if (!t.ends.empty()) text += fmt::format("  ends                  {}\n", fmt::join(t.ends, ", "));
  if (t.euler_characteristic) text += fmt::format("  Euler characteristic  {}\n", *t.euler_characteristic);
  if (t.dimension == 1 && t.euler_characteristic && t.components.exact())
    text += fmt::format("  shape                 {}\n", curves(t.components.at_least, *t.euler_characteristic));
  if (t.boundary) text += fmt::format("  boundary              {}\n", counted(*t.boundary, "closed curve"));
  if (!t.genus.empty())
    text += fmt::format("  shape                 {}\n",
                        t.boundary ? bounded_surface(t.genus.front(), *t.boundary) : shapes(t.genus));
  for (std::size_t k = 0; k < t.heights.size(); ++k) {
    const HeightCount& h = t.heights[k];
    text += fmt::format("  {} height         {} critical points, by index: {}\n", k == 0 ? "one    " : "another", h.points(),
                        fmt::join(h.by_index, ", "));
    if (t.with_ends) text.insert(text.size() - 1, fmt::format("; {} more on the ends do not count", h.uncounted));
  }
  if (!t.reason.empty()) text += fmt::format("  not known             {}\n", t.reason);
  return text + stopped_line(t.stopped);
}

std::string to_json(const study::Question& question, const Topology& t) {
  Json json{{"model", question.model.name()},
            {"dimension", t.dimension},
            {"components", {{"at_least", t.components.at_least}, {"at_most", or_null(t.components.at_most)}}},
            {"smooth", t.smooth},
            {"ends", t.ends},
            {"smooth_with_ends", t.with_ends},
            {"euler_characteristic", or_null(t.euler_characteristic)},
            {"boundary_curves", or_null(t.boundary)},
            {"genus", t.genus},
            {"critical_points", t.heights.empty() ? Json() : Json(t.heights.front().points())}};
  json["heights"] = Json::array();
  for (const HeightCount& h : t.heights)
    json["heights"].push_back({{"critical_points", h.points()}, {"by_index", h.by_index}, {"uncounted", h.uncounted}});
  if (t.robots) json["robots"] = robots_json(*t.robots);
  json["reason"] = t.reason.empty() ? t.components.reason : t.reason;
  json["processed"] = t.processed;
  json["complete"] = t.stopped.empty();
  json["stopped"] = or_null(t.stopped);
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace corank::analyze
