#include "corank/symbolic/model/drawing.h"

#include <algorithm>
#include <array>
#include <set>

#include "corank/symbolic/model/expression_words.h"

namespace corank::symbolic {
namespace {

struct KindOfPart {
  DrawingPart::Kind kind;
  const char* word;
  std::size_t fewest;  // points
  bool is_solid = false;
  const char* form = nullptr;  // the statement, of a part that has exactly as many points
};

constexpr std::array<KindOfPart, 10> kKinds{{{DrawingPart::Kind::link, "link", 2, true},
                                             {DrawingPart::Kind::platform, "platform", 3, true},
                                             {DrawingPart::Kind::joint, "joint", 1},
                                             {DrawingPart::Kind::slider, "slider", 3, false, "slider P along A B"},
                                             {DrawingPart::Kind::ground, "ground", 1},
                                             {DrawingPart::Kind::effector, "effector", 1},
                                             {DrawingPart::Kind::hinge, "hinge", 2, false, "hinge A B"},
                                             {DrawingPart::Kind::ball, "ball", 1},
                                             {DrawingPart::Kind::sphere, "sphere", 1, true, "sphere A radius r"},
                                             {DrawingPart::Kind::cylinder, "cylinder", 2, true, "cylinder A B radius r"}}};

const KindOfPart& row_of(DrawingPart::Kind kind) {
  return *std::ranges::find_if(kKinds, [kind](const KindOfPart& k) { return k.kind == kind; });
}

void validate_colour(const DrawingPart& part) {
  if (part.colour.empty()) return;
  const std::string& colour = part.colour;
  const bool is_colour =
      colour.size() == 7 && colour[0] == '#' && colour.find_first_not_of("0123456789abcdefABCDEF", 1) == std::string::npos;
  if (!is_colour) throw ModelError(part.where, in_quotes(colour) + " is not a colour", "#rrggbb, in hexadecimal digits");
  if (row_of(part.kind).is_solid) return;
  throw ModelError(part.where, std::string("a ") + to_string(part.kind) + " has no colour of its own",
                   "a colour after a link, platform, sphere or cylinder only");
}

void validate_name(const DrawingPart& part) {
  if (part.name.empty() || row_of(part.kind).is_solid) return;
  throw ModelError(part.where, std::string("a ") + to_string(part.kind) + " is no body that has a name",
                   "a name before the points of a link, platform, sphere or cylinder only");
}

void validate(const DrawingPart& part, const std::set<std::string>& known) {
  const std::string kind = to_string(part.kind);
  std::set<std::string> seen;
  for (const std::string& name : part.points) {
    if (!known.contains(name))
      throw ModelError(part.where, "the " + kind + " names " + in_quotes(name) + ", which is not a point of the drawing",
                       "the name of a point, declared as point " + shortened(name) + " = (x, y)");
    if (!seen.insert(name).second)
      throw ModelError(part.where, "the " + kind + " names the point " + in_quotes(name) + " twice", "each point once");
  }
  const KindOfPart& row = row_of(part.kind);
  if (part.points.size() < row.fewest || (row.form && part.points.size() > row.fewest))
    throw ModelError(part.where, "the " + kind + " has " + counted(part.points.size(), "point"),
                     row.form ? row.form : counted(row.fewest, "point") + " or more");
  validate_colour(part);
  validate_name(part);
}

}  // namespace

const char* to_string(DrawingPart::Kind kind) { return row_of(kind).word; }

DrawingPart::Kind drawing_part_of(std::string_view word) {
  return std::ranges::find_if(kKinds, [word](const KindOfPart& k) { return k.word == word; })->kind;
}

int Drawing::find(const std::string& point) const {
  const auto found = std::ranges::find_if(points, [&](const DrawingPoint& p) { return p.name == point; });
  return found == points.end() ? -1 : static_cast<int>(found - points.begin());
}

void Drawing::validate() const {
  std::set<std::string> known;
  for (const DrawingPoint& point : points) {
    if (!known.insert(point.name).second)
      throw ModelError(point.where, "the point " + in_quotes(point.name) + " is already declared", "another name");
    const std::size_t n = point.coordinates.size();
    if (n < 2 || n > 3 || static_cast<int>(n) != dimension())
      throw ModelError(point.where, "the point " + in_quotes(point.name) + " has " + std::to_string(n) + " coordinates",
                       point.name == points.front().name ? "2 or 3" : std::to_string(dimension()) + ", as the first point");
    if (!point.velocity.empty() && point.velocity.size() != n)
      throw ModelError(
          point.where,
          "the velocity of the point " + in_quotes(point.name) + " has " + counted(point.velocity.size(), "component"),
          std::to_string(n) + ", as the point itself");
  }
  for (const DrawingPart& part : parts) {
    corank::symbolic::validate(part, known);
    if (part.kind == DrawingPart::Kind::hinge && dimension() == 2)
      throw ModelError(part.where, "the hinge is in a drawing whose points have 2 coordinates",
                       "joint " + shortened(part.points[0]) + ": in the plane every axis is at right angles to it");
  }
}

}  // namespace corank::symbolic
