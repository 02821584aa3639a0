#include "corank/analyze/aspects/aspect_equations.h"

#include <algorithm>

#include "corank/analyze/clearance/ball.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/symbolic/sets/cusps_and_nodes.h"
#include "corank/symbolic/sets/determinant_factors.h"
#include "corank/symbolic/sets/free_coordinates.h"
#include "corank/symbolic/sets/kernel_scale.h"
#include "corank/symbolic/sets/required_space.h"

namespace corank::analyze {
namespace {

std::vector<Polynomial> functions_of(const symbolic::TrigonometricSystem& equations,
                                     const std::vector<symbolic::Expression>& expressions) {
  std::vector<Polynomial> result = symbolic::polynomials(equations, expressions);
  for (std::size_t k = 0; k < result.size(); ++k) result[k].source = expressions[k].text();
  return result;
}

std::vector<Polynomial> entries_of(const symbolic::TrigonometricSystem& equations,
                                   const symbolic::ExpressionMatrix& matrix) {
  std::vector<symbolic::Expression> entries;
  for (const auto& row : matrix.rows) entries.insert(entries.end(), row.begin(), row.end());
  return symbolic::polynomials(equations, entries);
}

PartEquations part_equations(const symbolic::IndependentPart& part, const symbolic::Loci& loci) {
  PartEquations result;
  for (const symbolic::Coordinate& c : part.system.coordinates) result.coordinates.push_back(c.name);
  result.system = symbolic::algebrize(part.system);
  const auto lists = loci.lists();
  for (std::size_t k = 0; k < lists.size(); ++k) {
    std::vector<symbolic::Expression> own;
    for (std::size_t i = 0; i < lists[k].size(); ++i) {
      if (std::ranges::find(part.functions, lists[k][i]) == part.functions.end()) continue;
      result.places[k].push_back(i);
      own.push_back(loci.all_factors[lists[k][i]]);
    }
    result.functions[k] = functions_of(part.system, own);
  }
  return result;
}

std::optional<ProductEquations> product_equations(const symbolic::Mechanism& model,
                                                  const symbolic::TrigonometricSystem& equations, const System& system,
                                                  const symbolic::Loci& loci) {
  const std::optional<symbolic::FreeCoordinates> free = symbolic::free_coordinates(model);
  if (!free) return std::nullopt;
  const auto parts = symbolic::independent_parts(*free, loci.all_factors);
  if (!parts) return std::nullopt;
  ProductEquations result;
  const auto fixed = static_cast<std::size_t>(std::ranges::count_if(model.coordinates(), symbolic::is_fixed));
  result.counts = model.coordinates().size() - fixed > model.equations().size() + 2;
  for (const symbolic::IndependentPart& part : *parts) result.parts.push_back(part_equations(part, loci));
  std::vector<symbolic::Expression> values;
  for (const symbolic::Relation& r : free->given) {
    result.given.push_back(system.find(r.lhs.name()));
    values.push_back(r.rhs);
  }
  result.values = symbolic::polynomials(equations, values);
  return result;
}

CuspEquations cusp_equations(study::Question question, std::size_t locus, const symbolic::Loci& loci) {
  const auto set = locus == 0 ? symbolic::SingularitySet::forward_cusps : symbolic::SingularitySet::inverse_cusps;
  question.set = set;
  CuspEquations result{.question = std::move(question), .places = loci.places[locus]};
  try {
    const symbolic::TrigonometricSystem equations = study::equations(result.question);
    const symbolic::Mechanism& model = result.question.model;
    result.sides = symbolic::polynomials(
        equations, symbolic::cusp_sides(model, set, symbolic::kernel_scales(model, set), loci.factors[locus]));
    result.system = study::system(result.question, equations);
  } catch (const symbolic::ModelError& error) {
    result.reason = error.what();
  }
  return result;
}

}  // namespace

AspectEquations aspect_equations(study::Question question, bool requirements, bool cusps, const Ended& ended) {
  question.set = symbolic::SingularitySet::cspace;
  AspectEquations result{.question = std::move(question)};
  const symbolic::Mechanism& model = result.question.model;
  symbolic::TrigonometricSystem equations =
      symbolic::singularity_system(model, symbolic::SingularitySet::cspace, {}, {}, result.question.corank);
  symbolic::Loci loci;
  try {
    loci = symbolic::singularity_loci(model, ended);
    if (requirements && !model.requirements().empty()) {
      if (cusps) throw question_error(result.question, "cusps are asked for, and requirements are there", "one of both");
      result.required = model.requirement_texts();
      const symbolic::RequiredSpace required = symbolic::required_space(model, ended);
      for (const auto& e : required.functions) result.further.push_back(e.text());
      loci.add(required.functions);
      equations.inequalities.insert(equations.inequalities.end(), required.inequalities.begin(),
                                    required.inequalities.end());
      result.standings.emplace(model, equations);
    }
  } catch (const symbolic::DeterminantTooLarge& error) {
    result.reason = error.what();
    return result;
  }
  const std::vector<Polynomial> all = functions_of(equations, loci.all_factors);
  const auto lists = loci.lists();
  for (std::size_t k = 0; k < lists.size(); ++k)
    for (const std::size_t i : lists[k]) result.functions[k].push_back(all[i]);
  result.constants = functions_of(equations, loci.constants);
  for (std::size_t k = 0; k < 2; ++k) {
    for (const auto& e : loci.factors[k]) result.factors[k].push_back(e.text());
    result.matrices[k] = entries_of(equations, loci.matrices[k]);
    // Cusps are those of the derivative of Φ; another L may be singular elsewhere.
    if (cusps && !loci.factors[k].empty() && !model.has_own_velocity_equation())
      result.cusps[k] = cusp_equations(result.question, k, loci);
  }
  result.system = study::system(result.question, equations);
  if (result.required.empty() && result.system.dimension() > 2)
    result.product = product_equations(model, equations, result.system, loci);
  return result;
}

}  // namespace corank::analyze
