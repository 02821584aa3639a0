#include "corank/analyze/aspects/aspects_of_robots.h"

#include <algorithm>

#include "corank/analyze/clearance/ball.h"
#include "corank/analyze/robots/same_strata.h"
#include "corank/core/rounding.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/symbolic/sets/determinant_factors.h"
#include "corank/symbolic/sets/free_coordinates.h"

namespace corank::analyze {
namespace {

std::vector<DividingFunction> dividing(const symbolic::TrigonometricSystem& equations,
                                       const std::vector<symbolic::Expression>& functions) {
  std::vector<DividingFunction> result;
  const std::vector<Polynomial> compiled = symbolic::polynomials(equations, functions);
  for (std::size_t k = 0; k < functions.size(); ++k) result.push_back({compiled[k], functions[k].text()});
  return result;
}

// A determinant vanishes for a robot of which such a factor does.
std::string obstacle_of_constants(const symbolic::TrigonometricSystem& equations, const System& system,
                                  const symbolic::Loci& loci) {
  const certify::CompiledSystem compiled(system, symbolic::polynomials(equations, loci.constants));
  const UpwardRounding rounding;
  for (std::size_t k = 0; k < loci.constants.size(); ++k)
    if (compiled.evaluate(compiled.value_row(static_cast<int>(k)), system.domain()).contains_zero())
      return "a determinant has the factor " + loci.constants[k].text() + ", which may be 0";
  return "";
}

// Parts of a C-space that is a product over the same tolerances: if each is, up to a homeomorphism, the same for all
// robots, the product is.
std::string obstacle_in_free_coordinates(const std::vector<symbolic::IndependentPart>& parts, const symbolic::Loci& loci,
                                         const std::vector<std::string>& own_ends, const SameStrataOptions& how,
                                         solve::Control& control) {
  for (const symbolic::IndependentPart& part : parts) {
    std::vector<symbolic::Expression> functions;
    for (const std::size_t i : part.functions) functions.push_back(loci.all_factors[i]);
    std::string obstacle =
        obstacle_to_same_strata(symbolic::algebrize(part.system), dividing(part.system, functions), own_ends, how, control);
    if (!obstacle.empty()) return obstacle;
  }
  return "";
}

std::string obstacle_of(const study::Question& question, const std::vector<std::string>& own_ends,
                        const SameStrataOptions& how, solve::Control& control) {
  const symbolic::TrigonometricSystem equations = study::equations(question);
  const System system = study::system(question, equations);
  const symbolic::Loci loci = symbolic::singularity_loci(question.model, [&control] { return control.ended(); });
  std::string obstacle = obstacle_of_constants(equations, system, loci);
  if (!obstacle.empty()) return obstacle;
  if (system.dimension() > 2)
    if (const auto free = symbolic::free_coordinates(question.model))
      if (const auto parts = symbolic::independent_parts(*free, loci.all_factors))
        return obstacle_in_free_coordinates(*parts, loci, own_ends, how, control);
  return obstacle_to_same_strata(system, dividing(equations, loci.all_factors), own_ends, how, control);
}

}  // namespace

ExactNumbers exact_numbers_of(const Aspects& a) {
  ExactNumbers numbers;
  const auto add = [&](const char* name, const Pieces& p) {
    if (p.exact()) numbers.emplace_back(name, p.at_least);
  };
  if (!a.reason.empty()) return numbers;
  add("aspects", a.aspects);
  add("assembly_modes", a.assembly_modes);
  add("working_modes", a.working_modes);
  return numbers;
}

Aspects aspects_of_robots(study::Question question, const AspectsOptions& options, const AspectsOfOne& of_one,
                          solve::Control& control) {
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
  Aspects result = of_one(drawn, options, control);
  const auto obstacle = [&](int parts) {
    return !result.reason.empty() ? result.reason
                                  : obstacle_of(question, own_ends, {.threads = options.threads, .parts = parts}, control);
  };
  const AspectsOptions counting{.threads = options.threads, .halvings = options.halvings, .rounds = options.rounds};
  const auto numbers = [&](const study::Question& one) { return exact_numbers_of(of_one(one, counting, control)); };
  result.robots = examine(question, exact_numbers_of(result), obstacle, numbers, control);
  return result;
}

}  // namespace corank::analyze
