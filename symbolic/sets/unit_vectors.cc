#include "corank/symbolic/sets/unit_vectors.h"

#include <algorithm>
#include <deque>
#include <map>
#include <utility>
#include <vector>

#include "corank/symbolic/algebra/ginac_lock.h"
#include "corank/symbolic/velocity/exact_matrix.h"

namespace corank::symbolic {
namespace {

std::set<std::string> found_in(const Mechanism& mechanism, const std::vector<Expression>& phi) {
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
  const ExactMatrix matrix(mechanism, sums, phi);
  std::set<std::string> result;
  for (std::size_t k = 0; k < sums.columns.size(); ++k)
    if (matrix.in_free_coordinates(matrix.determinant({{k}, {k}})).is_zero())
      result.insert(vectors[sums.columns[k]].begin(), vectors[sums.columns[k]].end());
  return result;
}

}  // namespace

// One model is asked about many times, at other ranges.
std::set<std::string> unit_vector_components(const Mechanism& mechanism) {
  struct Known {
    std::vector<std::string> names;
    std::vector<Expression> phi, constants;
    std::set<std::string> components;
  };
  constexpr std::size_t kRemembered = 2;
  const GinacLock lock;  // of what is remembered, too
  static std::deque<Known> remembered;
  Known asked{{}, residuals(mechanism), {}, {}};
  for (const Coordinate& c : mechanism.coordinates()) asked.names.push_back(c.name + (c.auxiliary ? " auxiliary" : ""));
  for (const Constant& c : mechanism.constants()) {
    asked.names.push_back(c.name);
    asked.constants.push_back(c.value);
  }
  for (const Known& known : remembered)
    if (known.names == asked.names && std::ranges::equal(known.phi, asked.phi, same_tree) &&
        std::ranges::equal(known.constants, asked.constants, same_tree))
      return known.components;
  asked.components = found_in(mechanism, asked.phi);
  remembered.push_front(std::move(asked));
  if (remembered.size() > kRemembered) remembered.pop_back();
  return remembered.front().components;
}

}  // namespace corank::symbolic
