#include "corank/analyze/aspects/aspects.h"

#include <cmath>

#include "corank/analyze/aspects/aspect_product.h"
#include "corank/analyze/aspects/divided_space.h"
#include "corank/analyze/robots/same_strata.h"
#include "corank/certify/inertia.h"
#include "corank/core/rounding.h"
#include "corank/symbolic/sets/determinant_factors.h"

namespace corank::analyze {
namespace {

void add_determinant_signs(const AspectEquations& equations, Aspects& result) {
  const std::vector<Box>& at = result.aspects.representatives;
  result.determinant_signs.resize(at.size());
  for (std::size_t k = 0; k < 2; ++k) {
    const certify::CompiledSystem compiled(result.system, equations.matrices[k]);
    const int n = static_cast<int>(std::lround(std::sqrt(compiled.values())));
    const UpwardRounding rounding;
    certify::IntervalMatrix values(n, n);
    for (std::size_t i = 0; i < at.size(); ++i) {
      for (int e = 0; e < n * n; ++e) values.entries[e] = compiled.evaluate(compiled.value_row(e), at[i]);
      result.determinant_signs[i][k] = certify::determinant_sign(values);
    }
  }
}

void count_on_cells(const AspectEquations& equations, const AspectsOptions& options, solve::Control& control,
                    Aspects& result) {
  const DividedSpace space = divided_space(equations.system, options, control);
  result.system = space.system;
  result.reason = space.reason;
  result.limits = space.limits;
  if (!result.reason.empty()) return;
  if (options.certificate) result.cover = space.cover;
  const int dimension = space.cover->dimension;
  const auto count = [&](std::size_t list) {
    const bool first = list == 0;
    if (control.ended()) {
      Pieces unknown;
      unknown.reason = "the analysis was ended by a limit";
      return unknown;
    }
    SignCells cells = cells_of(space, equations.functions[list], options, control);
    Pieces found = pieces(cells, control);
    if (equations.standings) keep_required(found, equations.standings->of(found.representatives));
    const bool plane = dimension == 2 && options.images.size() == 2 && found.exact();
    const int x = plane ? result.system.find(options.images[0]) : -1, y = plane ? result.system.find(options.images[1]) : -1;
    if (first && x >= 0 && y >= 0) result.images = images(cells, found, x, y, options.rows, control);
    if (first && !options.drawn.empty()) result.drawing = draw(cells, found, options.drawn, control);
    if (first && options.cusps) result.cusps = aspect_cusps(equations, cells, found, options.threads, control);
    if (first && options.placed) result.places = piece_places(cells, found, options.placed->boxes, control);
    return found;
  };
  result.aspects = count(0);
  if (result.cusps && dimension == 2 && result.limits.empty())
    check_parity(equations.question, equations.system, options.threads, control, *result.cusps);
  result.assembly_modes = count(1);
  result.working_modes = count(2);
}

// Of a robot without tolerances.
Aspects count(const AspectEquations& equations, const AspectsOptions& options, solve::Control& control) {
  Aspects result;
  result.required = equations.required;
  result.further_factors = equations.further;
  result.reason = equations.reason;
  if (!result.reason.empty()) return result;
  result.forward_factors = equations.factors[0];
  result.inverse_factors = equations.factors[1];
  result.system = equations.system;
  if (equations.product && equations.product->counts)
    count_in_free_coordinates(equations, options, control, result);
  else
    count_on_cells(equations, options, control, result);
  add_determinant_signs(equations, result);  // none where nothing is known
  return result;
}

// Why not every robot has as many. A determinant vanishes for a robot of which a constant factor does. Parts of a C-space
// that is a product over the same tolerances: if each is, up to a homeomorphism, the same for all robots, the product is.
std::string obstacle_of(const AspectEquations& robots, const std::vector<std::string>& own_ends,
                        const SameStrataOptions& how, solve::Control& control) {
  std::string obstacle = robots.reason;
  const certify::CompiledSystem compiled(robots.system, robots.constants);
  for (std::size_t k = 0; k < robots.constants.size() && obstacle.empty(); ++k) {
    const UpwardRounding rounding;
    if (compiled.evaluate(compiled.value_row(static_cast<int>(k)), robots.system.domain()).contains_zero())
      obstacle = "a determinant has the factor " + robots.constants[k].source + ", which may be 0";
  }
  if (!obstacle.empty()) return obstacle;
  if (!robots.product) return obstacle_to_same_strata(robots.system, robots.functions[0], own_ends, how, control);
  for (const PartEquations& part : robots.product->parts)
    if (obstacle = obstacle_to_same_strata(part.system, part.functions[0], own_ends, how, control); !obstacle.empty()) break;
  return obstacle;
}

// Those of the robot that was drawn, and whether every robot has as many.
Aspects aspects_of_robots(study::Question question, const AspectsOptions& options, solve::Control& control) {
  const auto refuse = [&](bool asked, const char* what) {
    if (asked) study::require_exact_constants(question.model, what);
  };
  refuse(options.requirements && !question.model.requirements().empty(), "the count of aspects with requirements");
  refuse(options.cusps, "the search for cusps");
  refuse(!options.images.empty(), "the area of aspects");
  refuse(options.certificate, "a certificate of aspects");
  refuse(options.placed != nullptr, "the places of boxes in aspects");
  question.set = symbolic::SingularitySet::cspace;
  std::vector<std::string> own_ends;
  question = with_common_ranges(std::move(question), own_ends);
  study::Question drawn = question;
  drawn.model = question.model.nominal();
  const Ended ended = [&control] { return control.ended(); };
  Aspects result = count(aspect_equations(std::move(drawn), false, false, ended), options, control);
  std::optional<AspectEquations> robots;
  const auto obstacle = [&](int parts) {
    if (!result.reason.empty()) return result.reason;
    if (!robots) robots = aspect_equations(question, false, false, ended);
    return obstacle_of(*robots, own_ends, {.threads = options.threads, .parts = parts}, control);
  };
  const AspectsOptions counting{.threads = options.threads, .halvings = options.halvings, .rounds = options.rounds};
  const auto numbers = [&](const study::Question& one) -> ExactNumbers {
    try {
      return exact_numbers_of(count(aspect_equations(one, false, false, ended), counting, control));
    } catch (const symbolic::DeterminantVanishes&) {  // of this robot
      return {};
    }
  };
  result.robots = examine(question, exact_numbers_of(result), obstacle, numbers, control);
  return result;
}

}  // namespace

ExactNumbers exact_numbers_of(const Aspects& a) {
  ExactNumbers numbers;
  for (const auto& [name, p] : {std::pair("aspects", &a.aspects), std::pair("assembly_modes", &a.assembly_modes),
                                std::pair("working_modes", &a.working_modes)})
    if (a.reason.empty() && p->exact()) numbers.emplace_back(name, p->at_least);
  return numbers;
}

Aspects aspects(study::Question question, const AspectsOptions& options, solve::Control& control) {
  const auto one = [&] {
    const Ended ended = [&control] { return control.ended(); };
    return count(aspect_equations(std::move(question), options.requirements, options.cusps, ended), options, control);
  };
  Aspects result = question.model.toleranced().empty() ? one() : aspects_of_robots(std::move(question), options, control);
  result.stopped = solve::stopped_by(control);
  return result;
}

}  // namespace corank::analyze
