#include "corank/symbolic/node_system.h"

#include <algorithm>
#include <map>

#include "corank/symbolic/kernel_vector.h"
#include "corank/symbolic/locus_by_coordinates.h"
#include "corank/symbolic/model_file.h"

namespace corank::symbolic {
namespace {

using Names = std::map<std::string, Expression>;
using Equations = std::vector<TrigonometricSystem::Equation>;

// Those that are about y, for y′.
void add_second(Equations& list, const Names& names) {
  const std::size_t n = list.size();
  for (std::size_t i = 0; i < n; ++i) {
    const auto in = [&](const auto& name) {
      return list[i].relation.lhs.mentions(name.first) || list[i].relation.rhs.mentions(name.first);
    };
    if (!std::any_of(names.begin(), names.end(), in)) continue;
    TrigonometricSystem::Equation copy = list[i];
    copy.relation = copy.relation.substituted(names);
    copy.source += ", second configuration";
    list.push_back(std::move(copy));
  }
}

// M ξ = 0, ‖ξ‖ = 1, a·ξ ≥ 0.
void add_kernel(TrigonometricSystem& system, const LocusByCoordinates& locus, const Names& names,
                const std::vector<std::string>& unknowns, const std::string& vector, const SourceLocation& where) {
  const ExpressionMatrix& m = locus.kernel.matrix;
  const std::vector<Expression> rates = scaled(unknowns, locus.scales);
  for (std::size_t i = 0; i < m.rows.size(); ++i) {
    std::vector<Expression> row;
    for (const Expression& entry : m.rows[i]) row.push_back(entry.substituted(names));
    if (const auto lhs = kernel_row(row, rates))
      system.equations.push_back({*lhs == Expression(0),
                                  "row " + std::to_string(i + 1) + " of " + locus.kernel.name + " " + vector + " = 0",
                                  locus.kernel.where[i], true});
  }
  const std::vector<Expression> xi = symbols(unknowns);
  system.equations.push_back({square_of(xi) == Expression(1), "norm of " + vector, where, true});
  system.inequalities.push_back({generic_form(xi) >= Expression(0), "half-space of " + vector, where, true});
}

}  // namespace

std::string second_name(const Mechanism& mechanism, const std::string& coordinate) {
  std::string name = coordinate + "_2";
  while (mechanism.has(name)) name.insert(coordinate.size(), "_");
  return name;
}

TrigonometricSystem node_system(const Mechanism& mechanism, SingularitySet set, const std::vector<std::string>& scales) {
  const LocusByCoordinates locus = locus_by_coordinates(mechanism, set, scales);
  const std::vector<std::string>& columns = locus.kernel.matrix.columns;
  const SourceLocation where = model_place(mechanism);
  TrigonometricSystem system = plain_system(locus.mechanism);
  system.name += std::string(" ") + locus.kernel.set.name;
  system.kernel_scales = scales;

  Names names;
  const std::size_t n_q = system.coordinates.size();
  for (std::size_t c = 0; c < n_q; ++c) {
    Coordinate copy = system.coordinates[c];
    if (std::find(columns.begin(), columns.end(), copy.name) == columns.end()) continue;
    const std::string second = second_name(mechanism, copy.name);
    names[copy.name] = Expression::symbol(second);
    copy.name = second;
    system.coordinates.push_back(std::move(copy));
  }
  for (Equations* list : {&system.equations, &system.inequalities, &system.claimed}) add_second(*list, names);

  const std::vector<std::string> unknowns = kernel_names(mechanism, columns.size(), 2);
  for (const std::string& name : unknowns) system.further_unknowns.push_back({name});
  const auto half = unknowns.begin() + static_cast<std::ptrdiff_t>(columns.size());
  add_kernel(system, locus, {}, {unknowns.begin(), half}, "xi1", where);
  add_kernel(system, locus, names, {half, unknowns.end()}, "xi2", where);

  std::vector<Expression> difference;
  for (std::size_t c = 0; c < n_q; ++c) {
    const Coordinate& coordinate = system.coordinates[c];
    const auto column = std::find(columns.begin(), columns.end(), coordinate.name);
    if (column == columns.end()) continue;
    const Expression y = Expression::symbol(coordinate.name), other = names.at(coordinate.name);
    if (coordinate.kind == CoordinateKind::angle) {
      difference.insert(difference.end(), {cos(y) - cos(other), sin(y) - sin(other)});
    } else {
      const std::string& scale = locus.scales[column - columns.begin()];
      difference.push_back((y - other) /
                           (positive_number(scale, y.name()) * positive_number(locus.size_per_scale, "a size")));
    }
  }
  system.inequalities.push_back({square_of(difference) >= pow(parse_expression(kNodeDistance, ""), 2),
                                 "distance of the two configurations", where, true});
  system.inequalities.push_back({generic_form(difference) >= Expression(0), "order of the two configurations", where, true});
  return system;
}

}  // namespace corank::symbolic
