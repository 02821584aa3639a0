#include "corank/analyze/clearance.h"

#include <chrono>
#include <cmath>
#include <limits>

#include "corank/analyze/components.h"
#include "corank/certify/angle.h"
#include "corank/solve/solve.h"
#include "corank/symbolic/algebrizer.h"

namespace corank::analyze {
namespace {

constexpr double kNothing = 1e-9;  // of the ball's room

Clearance::Center center_of(const study::Question& question, const Ball& ball, const solve::Options& search,
                            const solve::Control& control) {
  if (control.ended()) return Clearance::Center::unknown;
  study::Question at = question;
  at.model = ball.assembled;
  if (at.set) at.set = symbolic::SingularitySet::cspace;
  constexpr std::uint64_t kSolutions = 64;  // a proven sheet may pass by its box: one of them need not hold a configuration
  const Cover cover = search_briefly(study::system(at), kSolutions, 0, search.threads, control);
  if (cover.complete() && cover.boxes.empty()) return Clearance::Center::not_assembled;
  const bool holds_one =
      std::any_of(cover.boxes.begin(), cover.boxes.end(), [](const auto& b) { return is_proven(b.verdict); });
  return holds_one ? Clearance::Center::assembled : Clearance::Center::unknown;
}

}  // namespace

std::vector<CoordinateValue> coordinate_values(const System& system, const Box& box) {
  std::vector<CoordinateValue> values;
  for (int j = 0; j < system.configuration_size; ++j) {
    const auto side = [&](int v) { return box[v]; };
    const Variable& v = system.variables[j];
    const auto angle = std::find_if(system.angles.begin(), system.angles.end(),
                                    [j](const Angle& a) { return a.cosine == j || a.sine == j; });
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
  const symbolic::TrigonometricSystem equations = study::equations(result.ball.question);
  const System system = study::system(result.ball.question, equations);
  if (wanted.check_center && question.set) {
    result.center = center_of(question, result.ball, search, control);
    if (result.center == Clearance::Center::not_assembled)
      throw question_error(question, "the robot has no configuration at the centre of the ball",
                           "values that it can take, within the ranges of the model and those that are given");
  }
  stage.reset();
  const solve::Prepared prepared = solve::prepare(system, search, control);
  const std::vector<Polynomial> differences = symbolic::polynomials(equations, result.ball.differences());
  // A singularity at the centre itself, but for rounding: no share of such a distance is to be had.
  const double nothing = kNothing * (std::isfinite(result.ball.room) ? result.ball.room : 1.0);
  result.nearest = nearest(prepared, differences,
                           {.precision = wanted.precision, .enough = nothing, .progress = wanted.progress}, control);
  if (result.nearest.upper && *result.nearest.upper <= nothing) result.nearest.complete = true;
  if (result.nearest.upper) result.values = coordinate_values(system, result.nearest.box);
  if (!result.nearest.unproven.empty()) {
    const Box point(result.nearest.unproven.begin(), result.nearest.unproven.end());
    for (const CoordinateValue& v : coordinate_values(system, point)) result.seemingly.emplace_back(v.name, v.value.mid());
  }
  if (const auto ending = control.ending()) result.stopped = to_string(*ending);
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace corank::analyze
