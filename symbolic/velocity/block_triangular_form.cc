#include "corank/symbolic/velocity/block_triangular_form.h"

#include <algorithm>
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/max_cardinality_matching.hpp>
#include <boost/graph/strong_components.hpp>

namespace corank::symbolic {

namespace {

using Bipartite = boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS>;
using Vertex = boost::graph_traits<Bipartite>::vertex_descriptor;

// Of each vertex its partner in a matching that is as large as possible: row i is vertex i, column j vertex n + j, n rows.
std::vector<Vertex> matching(const std::vector<std::vector<std::size_t>>& filled, std::size_t columns) {
  const std::size_t n = filled.size();
  Bipartite pattern(n + columns);
  for (std::size_t i = 0; i < n; ++i)
    for (const std::size_t j : filled[i]) boost::add_edge(i, n + j, pattern);
  std::vector<Vertex> partner(n + columns);
  boost::edmonds_maximum_cardinality_matching(pattern, partner.data());
  return partner;
}

bool is_alone(Vertex partner) { return partner == boost::graph_traits<Bipartite>::null_vertex(); }

}  // namespace

std::size_t term_rank(const std::vector<std::vector<std::size_t>>& filled, std::size_t columns) {
  const std::vector<Vertex> partner = matching(filled, columns);
  return filled.size() - std::count_if(partner.begin(), partner.begin() + filled.size(), is_alone);
}

std::optional<std::vector<SquareBlock>> block_triangular_form(const std::vector<std::vector<std::size_t>>& filled) {
  const std::size_t n = filled.size();
  const std::vector<Vertex> partner = matching(filled, n);
  if (std::ranges::any_of(partner, is_alone)) return std::nullopt;

  // An arrow from row i to the row whose partner is a column that i fills: rows of one block reach each other.
  using Directed = boost::adjacency_list<boost::vecS, boost::vecS, boost::directedS>;
  Directed arrows(n);
  for (std::size_t i = 0; i < n; ++i)
    for (const std::size_t j : filled[i]) boost::add_edge(i, partner[n + j], arrows);
  std::vector<std::size_t> component(n);
  const std::size_t count = boost::strong_components(
      arrows, boost::make_iterator_property_map(component.begin(), boost::get(boost::vertex_index, arrows)));
  std::vector<SquareBlock> blocks(count);
  for (std::size_t i = 0; i < n; ++i) {
    blocks[component[i]].rows.push_back(i);
    blocks[component[i]].columns.push_back(partner[i] - n);
  }
  for (SquareBlock& block : blocks) std::ranges::sort(block.columns);
  std::ranges::sort(blocks, [](const SquareBlock& a, const SquareBlock& b) { return a.rows.front() < b.rows.front(); });
  return blocks;
}

}  // namespace corank::symbolic
