#include "corank/analyze/aspects/aspects.h"

#include <algorithm>

#include "corank/analyze/aspects/aspect_product.h"
#include "corank/analyze/aspects/aspects_of_robots.h"
#include "corank/analyze/aspects/divided_space.h"
#include "corank/analyze/clearance/ball.h"
#include "corank/analyze/sets/standing.h"
#include "corank/certify/inertia.h"
#include "corank/core/rounding.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/symbolic/sets/determinant_factors.h"
#include "corank/symbolic/sets/required_space.h"

namespace corank::analyze {
namespace {

// Of the determinant of a square matrix at each of the boxes.
std::vector<int> signs_of_determinant(const symbolic::TrigonometricSystem& equations, const System& system,
                                      const symbolic::ExpressionMatrix& matrix, const std::vector<Box>& boxes) {
  std::vector<symbolic::Expression> entries;
  for (const auto& row : matrix.rows) entries.insert(entries.end(), row.begin(), row.end());
  const certify::CompiledSystem compiled(system, symbolic::polynomials(equations, entries));
  const int n = static_cast<int>(matrix.rows.size());
  const UpwardRounding rounding;
  std::vector<int> result;
  for (const Box& box : boxes) {
    certify::IntervalMatrix values(n, n);
    for (int k = 0; k < n * n; ++k) values.entries[k] = compiled.evaluate(compiled.value_row(k), box);
    result.push_back(sign_of(certify::determinant(values)));
  }
  return result;
}

void add_determinant_signs(const symbolic::TrigonometricSystem& equations, const symbolic::Loci& loci, Aspects& result) {
  const std::vector<Box>& at = result.aspects.representatives;
  const std::vector<int> y = signs_of_determinant(equations, result.system, loci.matrices[0], at);
  const std::vector<int> z = signs_of_determinant(equations, result.system, loci.matrices[1], at);
  for (std::size_t k = 0; k < at.size(); ++k) result.determinant_signs.push_back({y[k], z[k]});
}

Aspects aspects_of_one(study::Question question, const AspectsOptions& options, solve::Control& control) {
  Aspects result;
  question.set = symbolic::SingularitySet::cspace;
  symbolic::TrigonometricSystem equations = study::equations(question);
  const Ended ended = [&control] { return control.ended(); };
  symbolic::Loci loci;
  try {
    loci = symbolic::singularity_loci(question.model, ended);
    if (options.requirements && !question.model.requirements().empty()) {
      if (options.cusps) throw question_error(question, "cusps are asked for, and requirements are there", "one of both");
      result.required = question.model.requirement_texts();
      const symbolic::RequiredSpace required = symbolic::required_space(question.model, ended);
      for (const auto& e : required.functions) result.further_factors.push_back(e.text());
      loci.add(required.functions);
      equations.inequalities.insert(equations.inequalities.end(), required.inequalities.begin(),
                                    required.inequalities.end());
    }
  } catch (const symbolic::DeterminantTooLarge& error) {
    result.reason = error.what();
    return result;
  }
  result.system = study::system(question, equations);
  for (const auto& e : loci.factors[0]) result.forward_factors.push_back(e.text());
  for (const auto& e : loci.factors[1]) result.inverse_factors.push_back(e.text());

  if (result.required.empty() && count_in_free_coordinates(question, equations, loci, options, control, result)) {
    add_determinant_signs(equations, loci, result);
    return result;
  }

  const DividedSpace space = divided_space(std::move(result.system), options, control);
  result.system = space.system;
  result.reason = space.reason;
  result.limits = space.limits;
  if (!result.reason.empty()) return result;
  if (options.certificate) result.cover = space.cover;
  const int dimension = space.cover->dimension;
  const auto lists = loci.lists();
  const auto count = [&](std::size_t list) {
    const bool first = list == 0;
    if (control.ended()) {
      Pieces unknown;
      unknown.reason = "the analysis was ended by a limit";
      return unknown;
    }
    std::vector<symbolic::Expression> functions;
    for (const std::size_t i : lists[list]) functions.push_back(loci.all_factors[i]);
    SignCells cells = cells_of(space, symbolic::polynomials(equations, functions), options, control);
    Pieces found = pieces(cells, control);
    if (!result.required.empty())
      keep_required(found, [&](const Box& box) { return standing_in(question.model, equations, box); });
    const bool plane = dimension == 2 && options.images.size() == 2 && found.exact();
    const int x = plane ? result.system.find(options.images[0]) : -1, y = plane ? result.system.find(options.images[1]) : -1;
    if (first && x >= 0 && y >= 0) result.images = images(cells, found, x, y, options.rows, control);
    if (first && !options.drawn.empty()) result.drawing = draw(cells, found, options.drawn, ended);
    if (first && options.cusps) result.cusps = aspect_cusps(question, loci, cells, found, options.threads, control);
    if (first && options.placed) result.places = piece_places(cells, found, options.placed->boxes, control);
    return found;
  };
  result.aspects = count(0);
  if (result.cusps && dimension == 2 && result.limits.empty())
    check_parity(question, options.threads, control, *result.cusps);
  add_determinant_signs(equations, loci, result);
  result.assembly_modes = count(1);
  result.working_modes = count(2);
  return result;
}

}  // namespace

Aspects aspects(study::Question question, const AspectsOptions& options, solve::Control& control) {
  if (question.model.toleranced().empty()) return aspects_of_one(std::move(question), options, control);
  return aspects_of_robots(std::move(question), options, &aspects_of_one, control);
}

}  // namespace corank::analyze
