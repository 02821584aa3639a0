#include "corank/analyze/sets/limits.h"

#include <set>
#include <utility>

#include "corank/certify/contact.h"

namespace corank::analyze {

std::vector<Limit> limits(const System& system, const Cover& cover) {
  using With = certify::Contact::With;
  std::set<std::pair<With, int>> found;
  certify::visit_contacts(system, cover, [&](const CoverBox&, const std::vector<certify::Contact>& contacts) {
    for (const certify::Contact& c : contacts) found.emplace(c.with, c.index);
  });
  std::set<int> of_angles;
  for (const Angle& angle : system.angles) of_angles.insert({angle.cosine, angle.sine});
  std::vector<Limit> result;
  for (const auto& [with, index] : found) {
    if (with == With::inequality) {
      const Polynomial& g = system.inequalities[index];
      result.push_back({{g, with, index}, g.source});
      continue;
    }
    if (of_angles.contains(index)) continue;
    const Variable& v = system.variables[index];
    const bool lower = with == With::lower_end;
    const std::string name = (lower ? "lower end of " : "upper end of ") + v.name;
    const ExactNumber one = ExactNumber::rational("1");
    Polynomial g{{Monomial(lower ? one : -one, {Factor{index}}), Monomial(lower ? -v.lower : v.upper, {})}, name};
    if (g.monomials.back().coefficient.is_zero()) g.monomials.pop_back();
    result.push_back({{std::move(g), with, index}, name});
  }
  return result;
}

System with_single_values(System system) {
  for (std::size_t j = 0; j < system.variables.size(); ++j) {
    const Variable& v = system.variables[j];
    if (v.kind != VariableKind::length || !(v.lower == v.upper)) continue;
    Polynomial value{{Monomial(ExactNumber::rational("1"), {Factor{static_cast<int>(j)}})}, "value of " + v.name};
    if (!v.lower.is_zero()) value.monomials.emplace_back(-v.lower, std::vector<Factor>{});
    system.equations.push_back(std::move(value));
  }
  return system;
}

std::optional<Box> same_configuration(const System& from, const Box& box, const System& to) {
  Box result;
  for (const Variable& v : to.variables) {
    const int j = from.find(v.name);
    if (j < 0) return std::nullopt;
    result.push_back(box[j]);
  }
  return result;
}

}  // namespace corank::analyze
