#include "corank/analyze/clearance.h"

#include <fmt/format.h>

#include <cmath>

#include "corank/analyze/nearest.h"
#include "corank/core/rounding.h"
#include "corank/result/motion_words.h"
#include "corank/result/verification.h"
#include "corank/solve/problem.h"
#include "corank/solve/propagation.h"
#include "corank/study/answer.h"
#include "corank/symbolic/model_file.h"
#include "corank/symbolic/printer.h"

namespace corank::analyze {
namespace {

constexpr double kGivenAway = 1e-6;  // of the radius: so much of it the claims give away, for their own rounding
constexpr double kSigma = 1e-3;      // a witness is far narrower

// The number as a decimal, which a model's text shows.
symbolic::Expression decimal(double x) { return symbolic::parse_expression(fmt::format("{:.17g}", x), "radius"); }

study::Question within(const Clearance& clearance, double radius) {
  study::Question question = clearance.ball.question;
  question.model = clearance.ball.within(decimal(radius));
  return question;
}

}  // namespace

result::Result claim_free(const Clearance& clearance, const solve::Options& search, solve::Control& control) {
  const study::Question question = within(clearance, clearance.nearest.lower * (1 - kGivenAway));
  study::Options options{search, 0};
  options.search.proof = true;
  return study::answer(question, study::system(question), options, control);
}

std::optional<result::Result> claim_nearest(const Clearance& clearance, solve::Control& control) {
  if (!clearance.nearest.upper) return std::nullopt;
  const study::Question question = within(clearance, *clearance.nearest.upper * (1 + kGivenAway));
  // Narrower ranges would scale the kernel vector otherwise; the point that is known is in the scales of the search.
  const System searched = study::system(clearance.ball.question);
  result::Result result;
  result.model = question.model.name();
  result.model_text = question.model.source_text();
  const symbolic::SetDefinition& set = symbolic::definition(question.set);
  result.set = set.name;
  result.options.kernel = set.has_kernel() ? to_string(question.kernel.value_or(set.side)) : "";
  result.options.kernel_scales = searched.kernel_scales;
  result.options.tolerance = searched.coefficient_tolerance;
  result.options.corank = searched.kernel_vectors;
  result.options.passive_rates_eliminated = searched.passive_rates_eliminated;
  const System system = result::system_of(question.model, result);
  result.system_text = symbolic::to_cuik(system);
  const solve::Prepared prepared = solve::prepare(system, {}, control);
  const certify::Reduction& reduction = prepared.reduction;

  const UpwardRounding rounding;
  certify::CompiledSystem compiled(reduction.system, solve::values_of(reduction));
  compiled.set_scales(solve::typical_sizes(compiled, reduction.system.domain()).variables);
  std::vector<double> point;
  for (const int v : reduction.kept) point.push_back(clearance.nearest.box.at(v).mid());
  solve::PreconditionerFactory preconditioners(compiled);
  certify::NewtonWorkspace workspace;
  const auto witness = prove_near(compiled, certify::DomainTest(reduction.system), point, preconditioners, workspace);
  if (!witness) return std::nullopt;

  CoverBox box;
  box.box = lifted(compiled, reduction, witness->sheet.image);
  for (const int j : witness->free) box.free.push_back(reduction.kept[j]);
  box.verdict = box.free.empty() ? Verdict::isolated : Verdict::regular;
  box.region = 0;
  result.cover.sigma = result.options.sigma = {kSigma, kSigma};
  result.cover.boxes.push_back(box);
  result.cover.regions.push_back(lifted(compiled, reduction, witness->sheet.region));
  result.cover.reduction = reduction.steps;
  if (box.free.empty()) result.cover.points.push_back(box);
  result::describe_system(system, result);
  result.cover.dimension = reduction.system.dimension();
  result::describe_in_words(question.model, system, result);
  result.stopped = "the first solution that was requested";
  return result;
}

}  // namespace corank::analyze
