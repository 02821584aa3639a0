#include "corank/app/solve_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "corank/report/domain_notes.h"
#include "corank/report/motion_words.h"
#include "corank/solve/exactness.h"
#include "corank/symbolic/model_error.h"
#include "corank/symbolic/printer.h"

namespace corank::app {
namespace {

std::string kernel_of(const Question& question, std::optional<symbolic::SingularitySet> set) {
  using symbolic::SingularitySet;
  if (!set || *set == SingularitySet::cspace) return "";
  if (!question.kernel.empty()) return question.kernel;
  return to_string(*set == SingularitySet::cspace_singular ? symbolic::KernelSide::left : symbolic::KernelSide::right);
}

void mark_auxiliary(const symbolic::Mechanism& mechanism, report::Result& result) {
  std::set<std::string> names;
  for (const symbolic::Coordinate& c : mechanism.coordinates()) {
    if (c.auxiliary) names.insert(c.name);
  }
  for (report::ResultVariable& v : result.variables)
    v.auxiliary = names.contains(v.name) || v.kind == certify::VariableKind::auxiliary;
  for (const certify::Angle& a : result.angles) {
    for (const int v : {a.cosine, a.sine})
      result.variables.at(static_cast<std::size_t>(v)).auxiliary = names.contains(a.name);
  }
}

certify::Reduction reduced(const certify::System& system, solve::Control& control) {
  const solve::InStage stage(control, solve::Stage::reduction);
  return certify::reduce(system, [&control] { return control.ended(); });
}

}  // namespace

std::string stopped_words(const report::Result& result) {
  return "stopped by " + (result.stopped.empty() ? "a limit" : result.stopped);
}

report::Result solve_set(const Question& question, const symbolic::Mechanism& mechanism,
                         std::optional<symbolic::SingularitySet> set, const certify::System& system,
                         const std::vector<std::string>& kernel_scales, const solve::Options& options,
                         solve::Control& control, int digits) {
  const certify::Reduction reduction = reduced(system, control);
  solve::Options governed = options;
  governed.control = &control;
  governed.reduction = &reduction;
  governed.max_boxes = 0;  // the control's
  report::Result result;
  result.model = mechanism.name();
  result.model_text = mechanism.source_text();
  result.set = set ? to_string(*set) : "system";
  result.system_text = symbolic::to_cuik(system);
  result.cover = solve::solve(system, governed);
  control.keep(static_cast<std::int64_t>(solve::bytes_of(result.cover, control.limits().later_bytes)));
  solve::prove_exactly(system, governed, result.cover);
  if (digits > 0 && result.cover.dimension == 0) solve::prove_decimals(system, digits, result.cover, governed);
  if (const auto ending = control.ending()) result.stopped = to_string(*ending);
  report::describe_system(system, result);
  report::describe_domain(mechanism, system, result);
  report::describe_motions(mechanism, system, result);
  mark_auxiliary(mechanism, result);
  result.options = {kernel_of(question, set),     result.cover.sigma, kernel_scales,
                    system.coefficient_tolerance, options.threads,    options.max_boxes,
                    options.max_solutions,        options.time_limit, overrides(question)};
  result.options.corank = system.kernel_vectors;
  report::describe_corank(system, result);
  return result;
}

}  // namespace corank::app
