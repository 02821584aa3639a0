#include "corank/solve/step/product_search.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "corank/core/box.h"
#include "corank/core/check.h"
#include "corank/core/rounding.h"

namespace corank::solve {
namespace {

// Nothing is left to do for it.
certify::Reduction unreduced(System system, int kernel_vectors) {
  certify::Reduction same;
  same.given_equations = static_cast<int>(system.equations.size());
  same.kept.resize(system.variables.size());
  std::iota(same.kept.begin(), same.kept.end(), 0);
  same.origins.resize(system.equations.size());
  std::iota(same.origins.begin(), same.origins.end(), 0);
  system.kernel_vectors = kernel_vectors;
  same.system = std::move(system);
  return same;
}

bool is_empty(const ParameterCell& cell) { return cell.sheets.empty() && cell.open.empty(); }

}  // namespace

ProductProblem::ProductProblem(const certify::Reduction& reduction, const std::vector<int>& given, int kernel_vectors)
    : groups(certify::independent_groups(reduction.system, given)) {
  for (const certify::EquationGroup& group : groups) {
    std::vector<int>& places = parameters.emplace_back();
    for (const int p : given)
      places.push_back(static_cast<int>(std::ranges::find(group.variables, p) - group.variables.begin()));
    const certify::Reduction own = unreduced(certify::system_of(reduction.system, group), kernel_vectors);
    problems.push_back(std::make_unique<const Problem>(own.system, own, [] { return false; }));
  }
}

ProductSearch::ProductSearch(const ProductProblem& product, const Problem& whole) : product_(product), whole_(whole) {
  for (std::size_t g = 0; g < product.groups.size(); ++g)
    searches_.emplace_back(*product.problems[g], product.parameters[g]);
}

ProductCell ProductSearch::whole(const Box& sides, const Box& domain) const {
  ProductCell cell{sides, {}};
  for (std::size_t g = 0; g < searches_.size(); ++g) {
    Box own;
    for (const int v : product_.groups[g].variables) own.push_back(domain[v]);
    cell.parts.push_back(searches_[g].whole(sides, own));
  }
  return cell;
}

ProductCell ProductSearch::part(const ProductCell& cell, const Box& sides) {
  ProductCell part{sides, {}};
  for (std::size_t g = 0; g < searches_.size(); ++g) part.parts.push_back(searches_[g].part(cell.parts[g], sides));
  return part;
}

bool ProductSearch::refine(ProductCell& cell, double share, std::uint64_t most, Control& control) {
  for (std::size_t g = 0; g < searches_.size(); ++g) {
    if (!searches_[g].refine(cell.parts[g], share, most, control)) return false;
    if (is_empty(cell.parts[g])) break;  // no combination
  }
  return true;
}

std::optional<std::vector<certify::Sheet>> ProductSearch::solutions(ProductCell& cell) {
  CORANK_CHECK(UpwardRounding::active());
  std::vector<std::vector<const certify::Sheet*>> combinations{{}};
  bool known = true, none = false;
  for (std::size_t g = 0; g < searches_.size(); ++g) {
    const auto inside = searches_[g].solutions(cell.parts[g]);
    known = known && inside;
    none = none || (inside && inside->empty());
    std::vector<std::vector<const certify::Sheet*>> longer;
    for (const auto& combination : combinations)
      for (const std::size_t k : inside.value_or(std::vector<std::size_t>{})) {
        longer.push_back(combination);
        longer.back().push_back(&cell.parts[g].sheets[k]);
      }
    combinations = std::move(longer);
  }
  if (none) return std::vector<certify::Sheet>{};
  if (!known) return std::nullopt;
  std::vector<certify::Sheet> all;
  for (const auto& combination : combinations)
    all.push_back(certify::product(whole_.compiled, product_.groups, combination));
  if (searches_.size() == 1) return all;
  const auto inside = certify::sheets_inside(whole_.compiled, whole_.domain, all, workspace_);
  if (!inside) return std::nullopt;
  std::vector<certify::Sheet> solutions;
  for (const std::size_t k : *inside) solutions.push_back(std::move(all[k]));
  return solutions;
}

std::vector<Box> ProductSearch::open(const ProductCell& cell) const {
  std::vector<Box> boxes;
  for (std::size_t g = 0; g < searches_.size(); ++g)
    for (const Box& x : cell.parts[g].open) {
      Box& box = boxes.emplace_back(whole_.compiled.variables());
      for (std::size_t other = 0; other < searches_.size(); ++other) {
        Box own = x;
        if (other != g) {
          const ParameterCell& c = cell.parts[other];
          if (is_empty(c)) return {};
          own = c.open.empty() ? c.sheets[0].image : c.open[0];
          for (const Box& y : c.open) include(own, y);
          for (const certify::Sheet& sheet : c.sheets) include(own, sheet.image);
        }
        for (std::size_t k = 0; k < own.size(); ++k) box[product_.groups[other].variables[k]] = own[k];
      }
    }
  return boxes;
}

std::uint64_t ProductSearch::processed() const {
  std::uint64_t sum = 0;
  for (const CellSearch& search : searches_) sum += search.processed();
  return sum;
}

}  // namespace corank::solve
