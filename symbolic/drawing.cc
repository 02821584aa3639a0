#include "corank/symbolic/drawing.h"

#include <algorithm>
#include <set>
#include <stdexcept>

#include "corank/symbolic/expression_words.h"

namespace corank::symbolic {
namespace {

using Kind = DrawingPart::Kind;

std::size_t fewest_points(Kind kind) {
  switch (kind) {
    case Kind::link:
    case Kind::hinge:
    case Kind::cylinder: return 2;
    case Kind::platform:
    case Kind::slider: return 3;
    case Kind::joint:
    case Kind::ground:
    case Kind::effector:
    case Kind::ball:
    case Kind::sphere: return 1;
  }
  throw std::logic_error("no such part of a drawing");
}

/// The statement of a part that has exactly as many points as fewest_points says; null where it may have more.
const char* fixed_form(Kind kind) {
  switch (kind) {
    case Kind::slider: return "slider P along A B";
    case Kind::hinge: return "hinge A B";
    case Kind::sphere: return "sphere A radius r";
    case Kind::cylinder: return "cylinder A B radius r";
    default: return nullptr;
  }
}

bool may_be_coloured(Kind kind) {
  return kind == Kind::link || kind == Kind::platform || kind == Kind::sphere || kind == Kind::cylinder;
}

void validate_colour(const DrawingPart& part) {
  if (part.colour.empty()) return;
  const std::string& colour = part.colour;
  const bool is_colour =
      colour.size() == 7 && colour[0] == '#' && colour.find_first_not_of("0123456789abcdefABCDEF", 1) == std::string::npos;
  if (!is_colour) throw ModelError(part.where, in_quotes(colour) + " is not a colour", "#rrggbb, in hexadecimal digits");
  if (may_be_coloured(part.kind)) return;
  throw ModelError(part.where, std::string("a ") + to_string(part.kind) + " has no colour of its own",
                   "a colour after a link, platform, sphere or cylinder only");
}

std::string count_of(std::size_t n) { return std::to_string(n) + (n == 1 ? " component" : " components"); }

std::string count(std::size_t n) { return std::to_string(n) + (n == 1 ? " point" : " points"); }

void validate(const DrawingPart& part, const std::set<std::string>& known) {
  const std::string kind = to_string(part.kind);
  std::set<std::string> seen;
  for (const std::string& name : part.points) {
    if (!known.contains(name)) {
      throw ModelError(part.where, "the " + kind + " names " + in_quotes(name) + ", which is not a point of the drawing",
                       "the name of a point, declared as point " + shortened(name) + " = (x, y)");
    }
    if (!seen.insert(name).second) {
      throw ModelError(part.where, "the " + kind + " names the point " + in_quotes(name) + " twice", "each point once");
    }
  }
  const std::size_t fewest = fewest_points(part.kind);
  const char* const form = fixed_form(part.kind);
  if (part.points.size() < fewest || (form && part.points.size() > fewest)) {
    throw ModelError(part.where, "the " + kind + " has " + count(part.points.size()),
                     form ? form : count(fewest) + " or more");
  }
  validate_colour(part);
}

}  // namespace

const char* to_string(Kind kind) {
  switch (kind) {
    case Kind::link: return "link";
    case Kind::platform: return "platform";
    case Kind::joint: return "joint";
    case Kind::slider: return "slider";
    case Kind::ground: return "ground";
    case Kind::effector: return "effector";
    case Kind::hinge: return "hinge";
    case Kind::ball: return "ball";
    case Kind::sphere: return "sphere";
    case Kind::cylinder: return "cylinder";
  }
  throw std::logic_error("no such part of a drawing");
}

int Drawing::find(const std::string& point) const {
  const auto found = std::find_if(points.begin(), points.end(), [&](const DrawingPoint& p) { return p.name == point; });
  return found == points.end() ? -1 : static_cast<int>(found - points.begin());
}

void Drawing::validate() const {
  std::set<std::string> known;
  for (const DrawingPoint& point : points) {
    if (!known.insert(point.name).second) {
      throw ModelError(point.where, "the point " + in_quotes(point.name) + " is already declared", "another name");
    }
    const std::size_t n = point.coordinates.size();
    if (n < 2 || n > 3 || static_cast<int>(n) != dimension()) {
      throw ModelError(point.where, "the point " + in_quotes(point.name) + " has " + std::to_string(n) + " coordinates",
                       point.name == points.front().name ? "2 or 3" : std::to_string(dimension()) + ", as the first point");
    }
    if (!point.velocity.empty() && point.velocity.size() != n)
      throw ModelError(point.where,
                       "the velocity of the point " + in_quotes(point.name) + " has " + count_of(point.velocity.size()),
                       std::to_string(n) + ", as the point itself");
  }
  for (const DrawingPart& part : parts) {
    corank::symbolic::validate(part, known);
    if (part.kind == Kind::hinge && dimension() == 2) {
      throw ModelError(part.where, "the hinge is in a drawing whose points have 2 coordinates",
                       "joint " + shortened(part.points[0]) + ": in the plane every axis is at right angles to it");
    }
  }
}

}  // namespace corank::symbolic
