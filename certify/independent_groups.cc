#include "corank/certify/independent_groups.h"

#include <algorithm>
#include <map>
#include <numeric>

#include "corank/certify/polynomial_algebra.h"
#include "corank/core/check.h"

namespace corank::certify {

std::vector<EquationGroup> independent_groups(const System& system, const std::vector<int>& parameters) {
  const auto is_parameter = [&](int v) { return std::ranges::find(parameters, v) != parameters.end(); };
  std::vector<int> group(system.variables.size());  // of each variable: another one of its group, itself for the first
  std::iota(group.begin(), group.end(), 0);
  const auto first = [&](int v) {
    while (group[v] != v) v = group[v] = group[group[v]];
    return v;
  };
  const auto unknowns_of = [&](const Polynomial& f) {
    std::vector<int> unknowns = variables_of(f);
    std::erase_if(unknowns, is_parameter);
    return unknowns;
  };
  EquationGroup all;
  for (int v = 0; v < system.size(); ++v) all.variables.push_back(v);
  for (int row = 0; row < static_cast<int>(system.equations.size()); ++row) all.equations.push_back(row);

  if (all.equations.empty()) return {all};
  for (const Polynomial& f : system.equations) {
    const std::vector<int> unknowns = unknowns_of(f);
    if (unknowns.empty()) return {all};
    for (const int v : unknowns) group[first(v)] = first(unknowns[0]);
  }
  std::map<int, EquationGroup> groups;
  for (const int v : all.variables)
    if (!is_parameter(v)) groups[first(v)].variables.push_back(v);
  for (const int row : all.equations) groups[first(unknowns_of(system.equations[row])[0])].equations.push_back(row);
  std::vector<EquationGroup> result;
  for (auto& [name, g] : groups) {
    if (g.variables.size() != g.equations.size()) return {all};
    g.variables.insert(g.variables.end(), parameters.begin(), parameters.end());
    std::ranges::sort(g.variables);
    result.push_back(std::move(g));
  }
  return result;
}

System system_of(const System& system, const EquationGroup& group) {
  System part;
  part.name = system.name;
  part.coefficient_tolerance = system.coefficient_tolerance;
  std::vector<int> place(system.variables.size(), -1);
  for (const int v : group.variables) {
    place[v] = part.size();
    part.variables.push_back(system.variables[v]);
    part.variables.back().within_one = false;  // by equations of other groups, too
    if (v < system.configuration_size) ++part.configuration_size;
  }
  const auto add = [&](const Polynomial& f, std::vector<Polynomial>& to) {
    to.push_back(f);
    for (Monomial& m : to.back().monomials)
      for (Factor& x : m.factors) x.variable = place[x.variable];
  };
  const auto is_about_it = [&](const Polynomial& f) {
    return std::ranges::all_of(variables_of(f), [&](int v) { return place[v] >= 0; });
  };
  for (const int row : group.equations) add(system.equations[row], part.equations);
  for (const Polynomial& g : system.inequalities)
    if (is_about_it(g)) add(g, part.inequalities);
  for (const Polynomial& h : system.implied)
    if (is_about_it(h)) add(h, part.implied);
  return part;
}

Sheet product(const CompiledSystem& system, const std::vector<EquationGroup>& groups,
              const std::vector<const Sheet*>& sheets) {
  CORANK_CHECK(sheets.size() == groups.size());
  Sheet all;
  all.proven = true;
  all.region.resize(system.variables());
  all.image.resize(system.variables());
  for (int row = 0; row < system.equations(); ++row) all.equations.push_back(row);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const std::vector<int>& variables = groups[g].variables;
    const Sheet& sheet = *sheets[g];
    CORANK_CHECK(sheet.proven && sheet.motion < 0 && sheet.equations.size() == groups[g].equations.size());
    for (std::size_t k = 0; k < variables.size(); ++k) {
      all.region[variables[k]] = sheet.region[k];
      all.image[variables[k]] = sheet.image[k];
    }
    for (const int d : sheet.dependent) all.dependent.push_back(variables[d]);
  }
  for (std::size_t g = 0; g < groups.size(); ++g)  // of the same parameters
    for (std::size_t k = 0; k < groups[g].variables.size(); ++k)
      CORANK_CHECK(all.region[groups[g].variables[k]] == sheets[g]->region[k]);
  return all;
}

}  // namespace corank::certify
