#include "corank/study/question.h"

#include <algorithm>
#include <cmath>

#include "corank/core/check.h"
#include "corank/solve/reduction/implied_equations.h"
#include "corank/solve/reduction/reducer.h"
#include "corank/solve/search/solve.h"
#include "corank/solve/step/propagation.h"
#include "corank/symbolic/model/expression_words.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/symbolic/sets/free_coordinates.h"

namespace corank::study {

namespace {

// The power of 1000 that is a unit for lengths of such a typical size: models in metres and in millimetres have the same
// sizes but for that factor, and lengths from 0.1 to 100 count as they are.
double unit_of(double length) {
  constexpr double kLeast = 0.1;
  return length > 0 ? std::pow(1000.0, std::floor(std::log10(length / kLeast) / 3)) : 1;
}

void settle_sizes(System& system) {
  const std::vector<double> typical = solve::typical_sizes(certify::CompiledSystem(system), system.domain()).variables;
  double length = 0;
  for (std::size_t j = 0; j < typical.size(); ++j)
    if (system.variables[j].is_plain_length()) length = std::max(length, typical[j]);
  for (std::size_t j = 0; j < typical.size(); ++j) {
    Variable& v = system.variables[j];
    if (v.is_parameter()) continue;
    if (v.kind == VariableKind::length && !v.direction) v.size = unit_of(v.auxiliary ? typical[j] : length);
    if (v.kind == VariableKind::auxiliary) v.size = unit_of(typical[j]);
  }
}

enum class Components { no, if_simple, yes };

// `free`: of the model, if it was asked for.
Components components_wanted(const Question& q, std::optional<std::optional<symbolic::FreeCoordinates>>& free) {
  const symbolic::SetDefinition& set = definition(q.set);
  if (set.is_cspace()) {
    constexpr long kManyJoints = 5;
    return q.in_parts.value_or(true) && symbolic::mobility(q.model) >= kManyJoints ? Components::yes : Components::no;
  }
  if (!set.has_kernel() || set.locked.empty() || set.type || q.kernel || q.corank != 1) return Components::no;
  if (q.in_parts) return *q.in_parts ? Components::yes : Components::no;
  // These can be assembled in several ways, which meet at configurations whose kernels have larger dimensions.
  if (q.assembly && (!q.assembly->parallelograms.empty() || q.assembly->has_universal_rods)) return Components::yes;
  constexpr long kMobilityOfCurves = 2, kLongKernel = 10, kLongKernelOfAnArm = 6;
  const long mobility = symbolic::mobility(q.model);
  if (mobility > kMobilityOfCurves) return Components::yes;
  const long rows =
      q.model.has_own_velocity_equation() ? std::ssize(q.model.velocity_equations()) : std::ssize(q.model.equations());
  if (rows >= kLongKernelOfAnArm && rows < kLongKernel) free = symbolic::free_coordinates(q.model);
  const bool is_long = rows >= kLongKernel || (free && *free);
  return is_long || mobility == kMobilityOfCurves ? Components::if_simple : Components::no;
}

bool has_kernel(const Question& q) {
  const symbolic::Component* component = component_of(*q.part);
  return component && component->block;
}

// Is the only part of a set, or all of a boundary, found sooner than the set as a whole? An equation in place of the kernel
// vector is: two to forty times where the kernel's dimension jumps, and never later. So is a block of a platform on
// universal rods: its kernel has the platform's rates only (HISTORY, "Legs in one piece").
bool is_better_than_whole(const Question& part) {
  return !has_kernel(part) || component_of(*part.part)->factor || (part.assembly && part.assembly->has_universal_rods);
}

}  // namespace

void require_exact_constants(const symbolic::Mechanism& model, const std::string& asker) {
  for (const symbolic::Constant& c : model.constants())
    if (c.tolerance)
      throw symbolic::ModelError(
          c.where.line > 0 ? c.where : symbolic::SourceLocation{model.name(), 0, 0},
          "the constant " + symbolic::in_quotes(c.name) + " has a tolerance, but " + asker + " answers for one robot",
          "one value, for example -D " + c.name + "=" + c.value.text());
}

void require_exact_value(const symbolic::Mechanism& model, const symbolic::Expression& value, const std::string& what) {
  if (const std::string name = model.toleranced_in(value); !name.empty())
    throw symbolic::ModelError(
        {model.name(), 0, 0},
        what + ", " + value.text() + ", depends on " + symbolic::in_quotes(name) + ", which has a tolerance",
        "the same value for all robots");
}

std::vector<Question> parts_of(const Question& question, const Ended& ended) {
  if (!question.set) return {question};
  if (question.assembly && question.model.constraints().empty() && question.model.outputs().empty())
    throw symbolic::ModelError({question.model.name(), 0, 0},
                               "the robot has no loops and no outputs: every value of its joints is a configuration",
                               "a line [OUTPUTS], or a joint that closes a loop");
  if (!question.model.toleranced().empty()) {  // a factor, and what meets at a limit, is one robot's
    if (definition(question.set).of_parts) require_exact_constants(question.model, "a workspace's boundary");
    if (question.in_parts.value_or(false)) require_exact_constants(question.model, "a set that is solved in parts");
    return {question};
  }
  std::optional<std::optional<symbolic::FreeCoordinates>> free;
  const Components wanted = components_wanted(question, free);
  const bool of_requirements = definition(question.set).of_requirements;
  if (of_requirements ? question.kernel || question.corank != 1 || !question.in_parts.value_or(true)
                      : !definition(question.set).of_parts && wanted == Components::no)
    return {question};
  std::vector<Question> parts;
  for (symbolic::SetPart& part : symbolic::set_parts(question.model, *question.set, ended, free ? &*free : nullptr)) {
    parts.push_back(question);
    parts.back().part = std::move(part);
  }
  if (parts.empty() || (of_requirements && parts.size() == 1)) return {question};
  if (wanted == Components::if_simple) return std::ranges::any_of(parts, has_kernel) ? std::vector{question} : parts;
  if (parts.size() == 1 && !question.in_parts.value_or(false) && !is_better_than_whole(parts[0])) return {question};
  return parts;
}

symbolic::TrigonometricSystem equations(const Question& q) {
  if (!q.set) return symbolic::plain_system(q.model);
  CORANK_CHECK(q.part || !definition(q.set).of_parts);
  symbolic::SetEquations set =
      q.part ? symbolic::SetEquations(q.model, *q.set, *q.part) : symbolic::SetEquations(q.model, *q.set, q.kernel);
  if (!q.part) set.eliminate_passive_rates();
  return set.system(set.scales(), q.part ? 1 : q.corank);
}

std::vector<symbolic::TrigonometricSystem> equations_of_parts(Question question, const Ended& ended) {
  question.in_parts = question.in_parts.value_or(false);
  std::vector<symbolic::TrigonometricSystem> systems;
  for (const Question& part : parts_of(question, ended)) {
    if (is_over(ended)) break;
    systems.push_back(equations(part));
    if (!systems.back().claimed.empty()) static_cast<void>(system(part, systems.back()));
    if (part.part && std::holds_alternative<symbolic::Component>(*part.part)) systems.back().name += ": " + text(*part.part);
  }
  return systems;
}

System system(const Question& question) { return system(question, equations(question)); }

System system(const Question& question, const symbolic::TrigonometricSystem& equations) {
  System system = symbolic::algebrize(equations);
  if (!system.claimed.empty()) {
    certify::Reduction reduction = solve::reduce(system);
    for (const std::size_t k : solve::add_implied_equations(system.claimed, reduction))
      throw symbolic::ModelError(equations.claimed[k].where,
                                 "corank found no identity that derives this equation from the model's equations",
                                 "a sum of the equations times polynomials, with rational coefficients; or leave it out, "
                                 "since it only serves to shorten the search");
  }
  if (question.part) symbolic::add_claims(question.model, *question.set, *question.part, equations, system);
  settle_sizes(system);
  if (system.parameters() > 0 && question.tolerance.value_or(0) > 0)
    require_exact_constants(question.model, "a system whose coefficients have a tolerance");
  system.coefficient_tolerance =
      question.tolerance.value_or(question.set || system.parameters() > 0 ? 0 : solve::printed_tolerance(system));
  return system;
}

Systems systems_of(const Question& question, solve::Control& control, bool whole) {
  const solve::InStage stage(control, solve::Stage::model);
  Systems systems{parts_of(question, [&control] { return control.ended(); }), {}};
  for (const Question& part : systems.parts) {
    systems.of_parts.push_back(system(part));
    if (!whole && control.ended()) break;
  }
  control.ended();  // notes the stage
  return systems;
}

}  // namespace corank::study
