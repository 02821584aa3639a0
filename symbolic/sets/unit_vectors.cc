#include "corank/symbolic/sets/unit_vectors.h"

#include <algorithm>
#include <map>
#include <vector>

#include "corank/symbolic/algebra/remembered.h"
#include "corank/symbolic/velocity/exact_matrix.h"

namespace corank::symbolic {
namespace {

// By equations, and by constants' values, whose squares may be rational; wherever the ranges are.
bool has_same_vectors(const Mechanism& a, const Mechanism& b) {
  const auto coordinates = [](const Coordinate& x, const Coordinate& y) {
    return x.name == y.name && x.kind == y.kind && x.auxiliary == y.auxiliary;
  };
  const auto constants = [](const Constant& x, const Constant& y) {
    return x.name == y.name && same_tree(x.value, y.value);
  };
  return std::ranges::equal(a.coordinates(), b.coordinates(), coordinates) &&
         std::ranges::equal(a.constants(), b.constants(), constants) &&
         std::ranges::equal(residuals(a), residuals(b), same_tree);
}

std::set<std::string> find_components(const Mechanism& mechanism) {
  std::map<std::string, std::vector<std::string>> vectors;  // "u_link2": "u_link2_x" …
  for (const Coordinate& c : mechanism.coordinates())
    if (c.auxiliary && c.kind == CoordinateKind::length) vectors[c.name.substr(0, c.name.rfind('_'))].push_back(c.name);
  if (vectors.empty()) return {};
  // The squares' sums less 1, on a diagonal.
  ExpressionMatrix sums;
  for (const auto& [vector, components] : vectors) {
    Expression& sum = sums.rows.emplace_back(vectors.size(), Expression(0))[sums.columns.size()];
    sum = Expression(-1);
    for (const std::string& name : components) sum = sum + pow(Expression::symbol(name), 2);
    sums.columns.push_back(vector);
  }
  const ExactMatrix matrix(mechanism, sums, residuals(mechanism));
  std::set<std::string> result;
  for (std::size_t k = 0; k < sums.columns.size(); ++k)
    if (matrix.in_free_coordinates(matrix.determinant({{k}, {k}})).is_zero())
      result.insert(vectors[sums.columns[k]].begin(), vectors[sums.columns[k]].end());
  return result;
}

}  // namespace

std::set<std::string> unit_vector_components(const Mechanism& mechanism) {
  static Remembered<Mechanism, std::set<std::string>> remembered(2);
  return remembered.of(mechanism, has_same_vectors, find_components);
}

}  // namespace corank::symbolic
