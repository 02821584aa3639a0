// The configurations of a mechanism as equations.
#include <algorithm>
#include <filesystem>
#include <set>

#include "corank/symbolic/sets/limits.h"
#include "corank/symbolic/sets/singularity_system.h"
#include "corank/symbolic/sets/unit_vectors.h"

namespace corank::symbolic {

bool are_alike(const TrigonometricSystem& a, const TrigonometricSystem& b) {
  const auto same = [](const auto& x, const auto& y, const auto& alike) {
    return std::equal(x.begin(), x.end(), y.begin(), y.end(), alike);
  };
  const auto constants = [](const Constant& x, const Constant& y) {
    if (x.tolerance && y.tolerance &&
        (!same_tree(x.tolerance->lower, y.tolerance->lower) || !same_tree(x.tolerance->upper, y.tolerance->upper)))
      return false;
    return x.name == y.name && same_tree(x.value, y.value) && x.tolerance.has_value() == y.tolerance.has_value();
  };
  const auto coordinates = [](const Coordinate& x, const Coordinate& y) {
    return x.name == y.name && x.kind == y.kind && same_tree(x.lower, y.lower) && same_tree(x.upper, y.upper) &&
           x.auxiliary == y.auxiliary && x.has_range == y.has_range && x.direction == y.direction &&
           x.within_one == y.within_one;
  };
  const auto relations = [](const TrigonometricSystem::Equation& x, const TrigonometricSystem::Equation& y) {
    return same_relation(x.relation, y.relation);
  };
  return same(a.constants, b.constants, constants) && same(a.coordinates, b.coordinates, coordinates) &&
         same(a.equations, b.equations, relations) && same(a.inequalities, b.inequalities, relations) &&
         same(a.claimed, b.claimed, relations);
}

TrigonometricSystem plain_system(const Mechanism& mechanism) {
  mechanism.validate();
  TrigonometricSystem system;
  system.name = mechanism.name();
  system.constants = mechanism.constants();
  system.coordinates = mechanism.coordinates();
  const std::set<std::string> units = unit_vector_components(mechanism);
  for (Coordinate& c : system.coordinates) c.within_one = units.contains(c.name);
  keep_limits(mechanism, system.coordinates);
  const auto add = [](std::vector<TrigonometricSystem::Equation>& list, const Constraint& constraint,
                      const std::string& word) {
    const std::string number = word + " " + std::to_string(list.size() + 1);
    // The file without its folders: results must not depend on where a model lies.
    const SourceLocation line{std::filesystem::path(constraint.where.file).filename().string(), constraint.where.line, 0};
    const std::string note = constraint.note.empty() ? "" : " (" + constraint.note + ")";
    list.push_back({constraint.relation, (line.line > 0 ? line.text() : number) + note, constraint.where, false});
  };
  for (const Constraint& constraint : mechanism.constraints()) {
    if (constraint.relation.kind == Relation::Kind::equal) {
      add(system.equations, constraint, "equation");
    } else {
      add(system.inequalities, constraint, "inequality");
    }
  }
  for (const Constraint& constraint : mechanism.implied()) add(system.claimed, constraint, "implied equation");
  find_ranges(system);
  return system;
}

}  // namespace corank::symbolic
