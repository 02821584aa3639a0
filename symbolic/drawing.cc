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
    case Kind::link: return 2;
    case Kind::platform:
    case Kind::slider: return 3;
    case Kind::joint:
    case Kind::ground:
    case Kind::effector: return 1;
  }
  throw std::logic_error("no such part of a drawing");
}

std::string count_of(std::size_t n) { return std::to_string(n) + (n == 1 ? " component" : " components"); }

std::string count(std::size_t n) { return std::to_string(n) + (n == 1 ? " point" : " points"); }

void validate(const DrawingPart& part, const std::set<std::string>& known) {
  const std::string kind = to_string(part.kind);
  std::set<std::string> seen;
  for (const std::string& name : part.points) {
    if (!known.contains(name)) {
      throw ModelError(part.where, "the " + kind + " names " + in_quotes(name) + ", which is no point of the drawing",
                       "the name of a point, declared as point " + shortened(name) + " = (x, y)");
    }
    if (!seen.insert(name).second) {
      throw ModelError(part.where, "the " + kind + " names the point " + in_quotes(name) + " twice", "each point once");
    }
  }
  const std::size_t fewest = fewest_points(part.kind);
  const bool too_many = part.kind == Kind::slider && part.points.size() > fewest;
  if (part.points.size() >= fewest && !too_many) return;
  throw ModelError(part.where, "the " + kind + " has " + count(part.points.size()),
                   part.kind == Kind::slider ? "slider P along A B" : count(fewest) + " or more");
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
  for (const DrawingPart& part : parts) corank::symbolic::validate(part, known);
}

}  // namespace corank::symbolic
