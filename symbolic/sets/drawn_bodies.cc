#include "corank/symbolic/sets/drawn_bodies.h"

#include <algorithm>

#include "corank/symbolic/model/expression_words.h"

namespace corank::symbolic {
namespace {

std::vector<std::string> names_of_bodies(const Drawing& drawing) {
  std::vector<std::string> names;
  for (const DrawingPart& part : drawing.parts)
    if (!part.name.empty() && std::ranges::find(names, part.name) == names.end()) names.push_back(part.name);
  return names;
}

void add_points(const Drawing& drawing, const std::vector<std::string>& names, RoundedHull& hull) {
  for (const std::string& name : names) hull.points.push_back(drawn_point(drawing, name));
  if (hull.points.size() > kMostPointsOfBody)
    throw RequirementFault("a body has " + counted(hull.points.size(), "point"),
                           "at most " + std::to_string(kMostPointsOfBody));
}

}  // namespace

std::array<Expression, 3> drawn_point(const Drawing& drawing, const std::string& name) {
  const int found = drawing.find(name);
  if (found < 0) {
    std::vector<std::string> known = names_of_bodies(drawing);
    for (const DrawingPoint& p : drawing.points) known.push_back(p.name);
    throw RequirementFault(in_quotes(name) + " is no body or point of the drawing" + suggestion(name, known),
                           known.empty() ? "a model with a section [DRAWING]" : "one of " + joined(known));
  }
  const std::vector<Expression>& at = drawing.points[found].coordinates;
  return {at[0], at[1], at.size() > 2 ? at[2] : Expression(0)};
}

std::vector<RoundedHull> drawn_body(const Drawing& drawing, const std::vector<std::string>& names) {
  std::vector<RoundedHull> result;
  RoundedHull faces;
  for (const DrawingPart& part : drawing.parts) {
    if (names.size() != 1 || part.name != names[0]) continue;
    if (part.kind == DrawingPart::Kind::platform) {
      add_points(drawing, part.points, faces);
      continue;
    }
    add_points(drawing, part.points, result.emplace_back());
    if (part.has_radius()) result.back().radius = part.radius;
  }
  if (!faces.points.empty()) result.push_back(std::move(faces));
  if (result.empty()) add_points(drawing, names, result.emplace_back());
  return result;
}

}  // namespace corank::symbolic
