#include "corank/analyze/clearance/center_field.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "corank/analyze/sets/components.h"
#include "corank/certify/polynomial_algebra.h"
#include "corank/core/box.h"
#include "corank/core/rounding.h"
#include "corank/solve/search/solve.h"
#include "corank/symbolic/model/evaluate.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/sets/algebrizer.h"

namespace corank::analyze {
namespace {

constexpr std::uint64_t kBoxes = 20'000;  // for the question whether there is a configuration
constexpr std::uint64_t kPatience = 256;  // boxes: most searches that only have to exclude end before

using symbolic::Coordinate;
using symbolic::Expression;

const Coordinate& length(const study::Question& question, const std::string& name) {
  const int index = question.model.find_coordinate(name);
  if (index < 0) throw question_error(question, "there is no coordinate '" + name + "'", "one of the model's");
  const Coordinate& c = question.model.coordinates()[index];
  if (c.kind != symbolic::CoordinateKind::length)
    throw question_error(question, "'" + name + "' is an angle", "lengths as the coordinates in which the centre moves");
  return c;
}

// In doubles, and within the model's range.
Interval interval(const study::Question& question, const NamedRange& range) {
  const std::map<std::string, double> constants = symbolic::constant_values(question.model);
  const Coordinate& c = length(question, range.name);
  double lower = symbolic::evaluate(range.lower, constants), upper = symbolic::evaluate(range.upper, constants);
  if (c.has_range) {
    lower = std::max(lower, symbolic::evaluate(c.lower, constants));
    upper = std::min(upper, symbolic::evaluate(c.upper, constants));
  }
  if (!std::isfinite(lower) || !std::isfinite(upper) || !(lower <= upper))
    throw question_error(question, fmt::format("the region of '{}' is empty or not bounded", range.name),
                         "a lower and an upper end within the model's range");
  return {lower, upper};
}

Expression number(double x) { return symbolic::parse_expression(ExactNumber::dyadic(x).text(), "region"); }

// The region's coordinates first, then the others of the ball; the centre in the middle of the region.
BallOptions about_middle(BallOptions ball, const std::vector<std::string>& names, const Box& region) {
  std::vector<std::string> in = names;
  for (const std::string& name : ball.in)
    if (std::ranges::find(names, name) == names.end()) in.push_back(name);
  ball.in = in;
  for (std::size_t k = 0; k < names.size(); ++k) ball.at.push_back({names[k], number(region[k].mid())});
  return ball;
}

System assembled_system(const study::Question& question, const Ball& ball, const std::vector<std::string>& names,
                        const Box& region) {
  study::Question at = question;
  at.model = ball.assembled;
  at.set = symbolic::SingularitySet::cspace;
  for (std::size_t k = 0; k < names.size(); ++k)
    at.model.set_range(names[k], number(region[k].lo()), number(region[k].hi()));
  return study::system(at);
}

}  // namespace

CenterField::CenterField(const study::Question& question, BallOptions ball, const std::vector<NamedRange>& region,
                         const solve::Options& search, solve::Control& control)
    : search_(search), control_(control) {
  study::require_exact_constants(question.model, "a search over centres");
  for (const NamedRange& range : region) {
    if (std::ranges::find(names_, range.name) != names_.end())
      throw question_error(question, "'" + range.name + "' is twice in the region", "each once");
    if (!ball.in.empty() && std::ranges::find(ball.in, range.name) == ball.in.end())
      throw question_error(question, "'" + range.name + "' is not in the ball", "coordinates of the ball, as the centre's");
    if (std::ranges::any_of(ball.at, [&](const NamedValue& v) { return v.name == range.name; }))
      throw question_error(question, "'" + range.name + "' has a value and a region", "one of them");
    region_.push_back(interval(question, range));
    names_.push_back(range.name);
  }
  ball_ = make_ball(question, about_middle(std::move(ball), names_, region_));
  const symbolic::TrigonometricSystem equations = study::equations(ball_.question);
  std::vector<Expression> differences = ball_.differences();
  for (std::size_t k = 0; k < names_.size(); ++k) differences[k] = Expression::symbol(names_[k]);
  differences_ = symbolic::polynomials(equations, differences);
  prepared_ = solve::prepare(study::system(ball_.question, equations), search, control);
  if (question.set) assembled_ = assembled_system(question, ball_, names_, region_);
}

Nearest CenterField::distance(const std::vector<double>& center, const NearestOptions& options) {
  std::vector<Polynomial> differences = differences_;
  for (std::size_t k = 0; k < center.size(); ++k)
    if (center[k] != 0) differences[k].monomials.emplace_back(ExactNumber::dyadic(-center[k]), std::vector<Factor>{});
  const auto distance_of = [&](const Nearest& singularity) {
    const UpwardRounding rounding;
    Interval squares;
    for (const Polynomial& d : differences) squares += square(certify::evaluate(d, singularity.box));
    return root_above(squares.hi());
  };
  Nearest best;
  for (const Nearest& singularity : known_)
    if (const double upper = distance_of(singularity); !best.upper || upper < *best.upper) {
      best = singularity;
      best.upper = upper, best.lower = 0;
    }
  if (best.upper && *best.upper <= options.enough) return best;
  NearestOptions nearer = options;
  if (best.upper) {
    nearer.patience = kPatience;
    const double most = (1 - options.precision) * *best.upper;
    if (!(nearer.at_most > 0) || most < nearer.at_most) nearer.at_most = most;
    if (nearer.at_most <= 0) return best;
  }
  Nearest found = nearest(prepared_, differences, nearer, control_);
  if (found.upper) {
    known_.push_back(found);
    known_.back().statistics = {}, known_.back().unproven.clear(), known_.back().complete = false;
  }
  if (best.upper && (!found.upper || *best.upper < *found.upper)) {
    found.upper = best.upper, found.box = best.box, found.free = best.free;
    found.complete = found.lower >= (1 - options.precision) * *found.upper;
  }
  return found;
}

CenterField::Configurations CenterField::configurations(std::span<const Interval> centers) const {
  Configurations result;
  if (!assembled_) {
    return {.proven = true, .near = midpoint(centers)};
  }
  System system = *assembled_;
  std::vector<int> places;
  for (std::size_t k = 0; k < names_.size(); ++k) {
    places.push_back(system.find(names_[k]));
    Variable& v = system.variables.at(places[k]);
    v.lower = ExactNumber::dyadic(centers[k].lo()), v.upper = ExactNumber::dyadic(centers[k].hi());
    v.domain = centers[k];
  }
  const Cover cover = search_briefly(std::move(system), 1, kBoxes, search_.threads, control_);
  result.excluded = cover.complete() && cover.boxes.empty();
  const auto box = std::ranges::find_if(cover.boxes, [](const auto& b) { return is_proven(b.verdict); });
  result.proven = box != cover.boxes.end();
  for (std::size_t k = 0; result.proven && k < places.size(); ++k)
    result.near.push_back(std::clamp(box->box[places[k]].mid(), centers[k].lo(), centers[k].hi()));
  return result;
}

double reach(std::span<const Interval> box, const std::vector<double>& center) {
  const UpwardRounding rounding;
  Interval squares;
  for (std::size_t k = 0; k < center.size(); ++k) squares += square(box[k] - Interval(center[k]));
  return root_above(squares.hi());
}

Box bounded_region(const study::Question& question, const std::vector<NamedRange>& region) {
  Box box;
  for (const NamedRange& range : region) box.push_back(interval(question, range));
  return box;
}

std::vector<NamedRange> declared_ranges(const study::Question& question, const std::vector<std::string>& names) {
  std::vector<NamedRange> ranges;
  for (const std::string& name : names) {
    const Coordinate& c = length(question, name);
    if (!c.has_range)
      throw question_error(question, "'" + name + "' has no range", "one with it, as in --map " + name + "=[0,1],…");
    ranges.push_back({name, c.lower, c.upper});
  }
  return ranges;
}

}  // namespace corank::analyze
