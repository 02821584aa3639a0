#include "corank/analyze/clearance/clearance.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>

#include "corank/analyze/sets/components.h"
#include "corank/certify/angle.h"
#include "corank/core/rounding.h"
#include "corank/result/files/verification.h"
#include "corank/result/values/sentences.h"
#include "corank/solve/search/solve.h"
#include "corank/solve/step/preconditioner.h"
#include "corank/solve/step/problem.h"
#include "corank/solve/step/propagation.h"
#include "corank/study/answer.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/symbolic/writing/printer.h"

namespace corank::analyze {
namespace {

constexpr double kNothing = 1e-9;     // of the ball's room
constexpr double kRoundings = 1e-12;  // of a radius, more than its square and root are off

Clearance::Center center_of(const study::Question& question, const Ball& ball, const solve::Options& search,
                            const solve::Control& control) {
  if (control.ended()) return Clearance::Center::unknown;
  study::Question at = question;
  at.model = ball.assembled;
  if (at.set) at.set = symbolic::SingularitySet::cspace;
  constexpr std::uint64_t kSolutions = 64;  // a proven sheet may pass by its box: one of them need not hold a configuration
  const Cover cover = search_briefly(study::system(at), kSolutions, 0, search.threads, control);
  if (cover.complete() && cover.boxes.empty()) return Clearance::Center::not_assembled;
  const bool holds_one = std::ranges::any_of(cover.boxes, [](const auto& b) { return is_proven(b.verdict); });
  return holds_one ? Clearance::Center::assembled : Clearance::Center::unknown;
}

constexpr double kGivenAway = 1e-6;  // of the radius: the share that the claims give away for their own rounding
constexpr double kSigma = 1e-3;      // a witness is far narrower

// The number as a decimal, which a model's text shows.
symbolic::Expression decimal(double x) { return symbolic::parse_expression(fmt::format("{:.17g}", x), "radius"); }

// The configurations of all robots: a parameter is a variable like any other, and may be divided.
System of_any_robot(System system) {
  for (Variable& v : system.variables) {
    if (!v.is_parameter()) continue;
    v.kind = VariableKind::length;
    v.auxiliary = false;
    v.lower_implied = v.upper_implied = false;  // what becomes of a variable that is eliminated has to keep to its domain
  }
  return system;
}

// The robot that a box in the system's variables belongs to.
void choose_robot(const System& system, const Box& box, symbolic::Mechanism& model) {
  for (int j = 0; j < system.size(); ++j)
    if (const Variable& v = system.variables[j]; v.is_parameter()) model.set_constant(v.name, decimal(box[j].mid()));
  model.set_source_text(symbolic::to_model(model));
}

// Of an infinite radius, all of the question.
study::Question within(const Clearance& clearance, double radius) {
  study::Question question = clearance.ball.question;
  if (std::isfinite(radius)) question.model = clearance.ball.within(decimal(radius));
  return question;
}

// The same about one requirement alone.
study::Question about(study::Question question, std::size_t requirement) {
  question.model.keep_requirements({question.model.requirements().at(requirement)});
  question.model.set_source_text(symbolic::to_model(question.model));
  return question;
}

// What is found of one set, in the variables of its system.
struct FoundOf {
  System system;
  Nearest nearest;
};

// Of the union of sets.
Nearest together(const std::vector<FoundOf>& sets, const FoundOf& best) {
  Nearest all = best.nearest;
  all.empty = std::ranges::all_of(sets, [](const FoundOf& f) { return f.nearest.empty; });
  all.complete = std::ranges::all_of(sets, [](const FoundOf& f) { return f.nearest.complete; });
  all.statistics = {};
  for (const FoundOf& f : sets) {
    all.lower = std::min(all.lower, f.nearest.lower);
    all.statistics.processed += f.nearest.statistics.processed;
  }
  return all;
}

}  // namespace

std::vector<CoordinateValue> coordinate_values(const System& system, const Box& box) {
  std::vector<CoordinateValue> values;
  for (int j = 0; j < system.configuration_size; ++j) {
    const auto side = [&](int v) { return box[v]; };
    const Variable& v = system.variables[j];
    const auto angle = std::ranges::find_if(system.angles, [j](const Angle& a) { return a.cosine == j || a.sine == j; });
    if (angle == system.angles.end()) {
      if (!v.auxiliary) values.push_back({v.name, side(j)});
    } else if (angle->cosine == j) {
      values.push_back({angle->name, certify::angle_enclosure(side(angle->cosine), side(angle->sine), angle->range)});
    }
  }
  return values;
}

Clearance clearance(const study::Question& question, const BallOptions& options, const ClearanceOptions& wanted,
                    const solve::Options& search, solve::Control& control) {
  const auto start = std::chrono::steady_clock::now();
  Clearance result;
  std::optional<solve::InStage> stage(std::in_place, control, solve::Stage::model);
  result.ball = make_ball(question, options);
  result.precision = wanted.precision;
  // Each requirement by itself: what all of them ask of one kernel vector takes longer.
  std::vector<study::Question> questions;
  const bool by_requirement = symbolic::definition(question.set).of_requirements;
  for (std::size_t k = 0; by_requirement && k < question.model.requirements().size(); ++k)
    questions.push_back(about(result.ball.question, k));
  if (questions.size() < 2) questions = {result.ball.question};
  if (wanted.check_center && question.set) {
    result.center = center_of(question, result.ball, search, control);
    if (result.center == Clearance::Center::not_assembled)
      throw question_error(question, "the robot has no configuration at the centre of the ball",
                           "values that it can take, within the ranges of the model and those that are given");
  }
  stage.reset();
  // A singularity at the centre itself, but for rounding: no share of such a distance is to be had.
  const double nothing = kNothing * (std::isfinite(result.ball.room) ? result.ball.room : 1.0);
  NearestOptions wanted_of_nearest{.precision = wanted.keep > 0 ? kRoundings : wanted.precision,
                                   .at_most = wanted.keep * (1 + kRoundings),
                                   .enough = wanted.keep > 0 ? std::nextafter(wanted.keep, 0) : nothing,
                                   .progress = wanted.progress};
  std::vector<FoundOf> sets;
  std::size_t best = 0;
  for (const study::Question& part : questions) {
    const symbolic::TrigonometricSystem equations = study::equations(part);
    System system = study::system(part, equations);
    const solve::Prepared prepared = solve::prepare(of_any_robot(system), search, control);
    const std::vector<Polynomial> differences = symbolic::polynomials(equations, result.ball.differences());
    Nearest found = nearest(prepared, differences, wanted_of_nearest, control);
    sets.push_back({std::move(system), std::move(found)});
    const std::optional<double> upper = sets.back().nearest.upper, least = sets[best].nearest.upper;
    if (!upper || (least && *least < *upper)) continue;
    best = sets.size() - 1;
    double& at_most = wanted_of_nearest.at_most;  // no other part is searched farther away
    at_most = at_most > 0 ? std::min(at_most, *upper) : *upper;
    if (*upper <= wanted_of_nearest.enough) break;
  }
  const System& system = sets[best].system;
  result.nearest = together(sets, sets[best]);
  if (sets.size() < questions.size()) result.nearest.lower = 0;  // the others were not searched
  if (result.nearest.upper && *result.nearest.upper <= nothing) result.nearest.complete = true;
  if (result.nearest.upper) {
    if (questions.size() > 1) result.requirement = best;
    result.values = coordinate_values(system, result.nearest.box);
    for (int j = 0; j < system.size(); ++j)
      if (system.variables[j].is_parameter()) result.robot.push_back({system.variables[j].name, result.nearest.box[j]});
  }
  result.nearest.unproven.clear();
  double least = result.nearest.upper.value_or(std::numeric_limits<double>::infinity());
  for (const auto& [of_part, found] : sets) {
    if (found.unproven.empty() || !(found.unproven_distance < least)) continue;
    least = result.nearest.unproven_distance = found.unproven_distance;
    result.nearest.unproven = found.unproven;
    result.seemingly.clear();
    const Box point(found.unproven.begin(), found.unproven.end());
    for (const CoordinateValue& v : coordinate_values(of_part, point)) result.seemingly.emplace_back(v.name, v.value.mid());
  }
  if (!result.nearest.complete) result.stopped = solve::stopped_by(control);
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

result::Result claim_free(const Clearance& clearance, const solve::Options& search, solve::Control& control) {
  const study::Question question = within(clearance, clearance.nearest.lower * (1 - kGivenAway));
  study::Options options{search, 0};
  options.search.proof = true;
  if (question.model.toleranced().empty() && symbolic::definition(question.set).of_requirements)
    return study::answer(study::systems_of(question, control), options, control);
  const System system = study::system(question);
  // Pieces of the set just outside the ball, of robots just outside their tolerances, have to be told from those inside.
  if (system.parameters() > 0 && clearance.nearest.upper && *clearance.nearest.upper > clearance.nearest.lower)
    options.search.sigma = 0.5 * (*clearance.nearest.upper - clearance.nearest.lower);
  result::Result result = study::answer(question, of_any_robot(system), options, control);
  if (system.parameters() == 0) return result;
  result::describe_system(system, result);
  result.system_text = symbolic::to_cuik(system);
  result.cover.dimension = std::max(0, result.cover.dimension - system.parameters());
  for (CoverBox& box : result.cover.boxes) {  // of some robots only: where some are left, nothing is claimed of them
    box.verdict = Verdict::undecided;
    box.free.clear();
    box.region = box.kernel_at_most = -1;
    box.types = {};
  }
  result.cover.regions.clear();
  return result;
}

std::optional<result::Result> claim_nearest(const Clearance& clearance, solve::Control& control) {
  if (!clearance.nearest.upper) return std::nullopt;
  study::Question question = within(clearance, *clearance.nearest.upper * (1 + kGivenAway));
  study::Question asked = clearance.ball.question;
  if (clearance.requirement)
    for (study::Question* q : {&question, &asked}) *q = about(*q, *clearance.requirement);
  // Narrower ranges would scale the kernel vector otherwise; the point that is known is in the scales of the search.
  const System searched = study::system(asked);
  choose_robot(searched, clearance.nearest.box, question.model);
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
  for (const int v : reduction.kept)
    point.push_back(clearance.nearest.box.at(searched.find(system.variables[v].name)).mid());
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
