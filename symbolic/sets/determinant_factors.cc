#include "corank/symbolic/sets/determinant_factors.h"

#include <algorithm>
#include <numeric>

#include "corank/symbolic/algebra/exact_value.h"
#include "corank/symbolic/model/expression_words.h"
#include "corank/symbolic/velocity/known_values.h"

namespace corank::symbolic {
namespace {

// Among the first `known` of the list; else it is appended.
std::size_t place_of(const Expression& e, std::size_t known, std::vector<Expression>& list) {
  const auto begin = list.begin(), end = begin + static_cast<std::ptrdiff_t>(known);
  const std::size_t place = std::find_if(begin, end, [&](const Expression& f) { return same_tree(e, f); }) - begin;
  if (place < known) return place;
  list.push_back(e);
  return list.size() - 1;
}

// Of a factor without a coordinate: is it 0, or can its value not be told from 0? Within tolerances it is no one robot's.
bool may_be_zero(const Mechanism& mechanism, const Expression& constant) {
  return mechanism.toleranced_in(constant).empty() &&
         exact_value(mechanism, constant, constant.text()).sign().value_or(0) == 0;
}

std::vector<Expression> factors_of(const Mechanism& mechanism, const ExpressionMatrix& matrix,
                                   const std::vector<Expression>& phi, const Ended& ended,
                                   std::vector<Expression>* constants) {
  ExactMatrix m(mechanism, matrix, phi);
  m.put_into_free_coordinates(ended);
  m.eliminate_numbers();
  const auto vanishing = [&]() -> DeterminantVanishes {
    return {{mechanism.name(), 0, 0},
            "the determinant vanishes everywhere",
            "a mechanism with configurations that are not singular"};
  };
  const auto blocks = m.blocks();
  if (!blocks) throw vanishing();
  std::vector<RationalPolynomial> factors;
  for (const SquareBlock& block : *blocks) {
    const RationalPolynomial value = m.is_explicit() ? m.modulo_circles(m.determinant(block)) : m.determinant(block);
    if (value.is_zero()) throw vanishing();
    for (const RationalPolynomial& factor : value.factors(ended).value_or(std::vector{value})) {
      const RationalPolynomial on_cspace = m.is_explicit() ? m.in_free_coordinates(factor, ended) : factor;
      if (on_cspace.is_zero()) throw vanishing();
      for (RationalPolynomial& f : on_cspace.factors(ended).value_or(std::vector{on_cspace})) {
        const RationalPolynomial shortest = m.modulo_circles(f);
        if (shortest.is_zero()) throw vanishing();
        const bool is_one = shortest.is_number();  // cos² + sin²
        if (!is_one && std::ranges::find(factors, f) == factors.end()) factors.push_back(std::move(f));
      }
    }
  }
  std::vector<Expression> result;
  for (const RationalPolynomial& factor : factors) {
    if (std::optional<Expression> condition = m.condition(factor)) {
      result.push_back(std::move(*condition));
      continue;
    }
    Expression constant = m.expression(factor);
    if (may_be_zero(mechanism, constant)) throw vanishing();
    if (constants != nullptr && !factor.is_number()) constants->push_back(std::move(constant));
  }
  std::ranges::sort(result, [](const Expression& a, const Expression& b) { return a.text() < b.text(); });
  return result;
}

}  // namespace

std::vector<Expression> determinant_factors(const Mechanism& mechanism, const ExpressionMatrix& matrix, const Ended& ended,
                                            std::vector<Expression>* constants) {
  std::vector<Expression> phi = residuals(mechanism);
  try {
    return factors_of(mechanism, matrix, phi, ended, constants);
  } catch (const DeterminantTooLarge&) {
    ExpressionMatrix known = matrix;
    put_in_known_values(mechanism, known, phi);
    return factors_of(mechanism, known, phi, ended, constants);
  }
}

ExpressionMatrix locked_matrix(const Mechanism& mechanism, SingularitySet set) {
  return kernel_question(mechanism, set, KernelSide::left).matrix;
}

std::array<std::vector<std::size_t>, 3> Loci::lists() const {
  std::vector<std::size_t> all(all_factors.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  std::array<std::vector<std::size_t>, 3> result{all, places[0], places[1]};
  for (std::vector<std::size_t>* list : {&result[1], &result[2]})
    for (const std::size_t place : further)
      if (std::find(list->begin(), list->end(), place) == list->end()) list->push_back(place);
  return result;
}

void Loci::add(const std::vector<Expression>& functions) {
  for (const Expression& e : functions) further.push_back(place_of(e, all_factors.size(), all_factors));
}

Loci singularity_loci(const Mechanism& mechanism, const Ended& ended) {
  Loci loci;
  loci.matrices = {locked_matrix(mechanism, SingularitySet::forward), locked_matrix(mechanism, SingularitySet::inverse)};
  for (std::size_t k = 0; k < 2; ++k) {
    const std::size_t rows = loci.matrices[k].rows.size(), columns = loci.matrices[k].columns.size();
    if (rows != columns)
      throw ModelError({mechanism.name(), 0, 0},
                       std::string(k == 0 ? "L_y" : "L_z") + " has " + counted(rows, "row") + " and " +
                           counted(columns, "column") + ", and so no determinant, whose sign tells aspects apart",
                       k == 0 ? "as many inputs as the mobility" : "as many outputs as the mobility");
    loci.factors[k] = determinant_factors(mechanism, loci.matrices[k], ended, &loci.constants);
    const std::size_t known = loci.all_factors.size();
    for (const Expression& e : loci.factors[k]) loci.places[k].push_back(place_of(e, known, loci.all_factors));
  }
  return loci;
}

}  // namespace corank::symbolic
