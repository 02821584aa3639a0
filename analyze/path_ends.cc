#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "corank/analyze/path_space.h"
#include "corank/certify/meeting.h"
#include "corank/core/rounding.h"
#include "corank/solve/exactness.h"
#include "corank/solve/solve.h"
#include "corank/symbolic/evaluate.h"

namespace corank::analyze {
namespace {

Polynomial equals(int variable, const ExactNumber& value) {
  Polynomial f{{Monomial(ExactNumber(1), {Factor{variable}})}, ""};
  if (!value.is_zero()) f.monomials.emplace_back(-value, std::vector<Factor>{});
  return f;
}

// c² + s² − 1 alone: the equation that a fixed angle has no more use for.
bool is_circle(const Polynomial& f, const Angle& angle) {
  int squares = 0;
  for (const Monomial& m : f.monomials) {
    if (m.factors.empty()) continue;
    if (m.factors.size() != 1 || m.factors[0].power != 2 || m.factors[0].function != Function::identity) return false;
    if (m.factors[0].variable != angle.cosine && m.factors[0].variable != angle.sine) return false;
    ++squares;
  }
  return squares == 2;
}

// The space's system with these values, exactly.
System fixed(const PathSpace& space, const std::vector<NamedValue>& values) {
  System system = space.system();
  for (const NamedValue& v : values) {
    const ExactNumber value = symbolic::exact_value(space.question().model, v.value, v.name);
    const auto angle =
        std::find_if(system.angles.begin(), system.angles.end(), [&](const Angle& a) { return a.name == v.name; });
    const int length = system.find(v.name);
    if (angle != system.angles.end()) {
      const auto circle = std::find_if(system.equations.begin(), system.equations.end(),
                                       [&](const Polynomial& f) { return is_circle(f, *angle); });
      if (circle == system.equations.end())
        throw question_error(space.question(), "'" + v.name + "' has one value by its range", "no other");
      system.equations.erase(circle);
      system.equations.push_back(equals(angle->cosine, ExactNumber::apply(ConstantFunction::cos, value)));
      system.equations.push_back(equals(angle->sine, ExactNumber::apply(ConstantFunction::sin, value)));
    } else if (length >= 0 && length < system.configuration_size) {
      system.equations.push_back(equals(length, value));
    } else {
      throw unknown_coordinate(space.question(), v.name);
    }
  }
  system.name += " end";
  return system;
}

}  // namespace

std::vector<Box> find_ends(const PathSpace& space, const std::vector<NamedValue>& values, solve::Control& control) {
  const std::size_t needed = std::max(space.dimension(), 0);
  std::vector<NamedValue> exact, further;
  for (const NamedValue& v : values) {
    const int index = space.question().model.find_coordinate(v.name);
    const bool moves = index < 0 || !is_fixed(space.question().model.coordinates()[index]);
    (moves && exact.size() < needed ? exact : further).push_back(v);
  }
  if (exact.size() < needed)
    throw EndError(fmt::format("{} of the {} values that are needed: the mechanism can still move", exact.size(), needed));
  const System system = fixed(space, exact);
  for (const NamedValue& v : further)
    if (space.question().model.find_coordinate(v.name) < 0) fixed(space, {v});  // throws
  const solve::Prepared prepared = solve::prepare(system, {}, control);
  Cover cover = solve::solve(prepared, control);
  if (!cover.complete()) throw EndError("the search for the configurations was ended by a limit");
  if (cover.dimension == 0) solve::prove_exactly(prepared, cover, control);
  std::vector<Box> result;
  certify::MeetingTest test(system);
  for (const CoverBox& point : cover.points) {
    if (point.verdict == Verdict::boundary) throw EndError("one of the configurations may be outside the ranges");
    if (point.verdict != Verdict::isolated && point.verdict != Verdict::exact)
      throw EndError(
          "with these values there are configurations that are not isolated, or not proven to be; other values may help");
    // The solution that the box holds, as narrow as doubles prove it.
    const UpwardRounding rounding;
    result.push_back(test.solution_in(point.box, point.box).value_or(point.box));
  }
  if (cover.points.empty() && !cover.boxes.empty()) throw EndError("with these values the mechanism can still move");
  const auto is_far = [&](const Box& box) {
    const std::vector<CoordinateValue> there = coordinate_values(space.system(), box);
    return std::any_of(further.begin(), further.end(), [&](const NamedValue& v) {
      const double asked = symbolic::exact_value(space.question().model, v.value, v.name).enclose().mid();
      const auto at = std::find_if(there.begin(), there.end(), [&](const CoordinateValue& c) { return c.name == v.name; });
      if (at == there.end()) return false;
      const auto& angles = space.system().angles;
      const bool angle = std::any_of(angles.begin(), angles.end(), [&](const Angle& a) { return a.name == v.name; });
      double distance = at->value.mid() - asked;
      if (angle) distance = std::remainder(distance, 2 * std::numbers::pi);
      const int length = space.system().find(v.name);
      const double size = angle || length < 0 ? 1 : space.sizes()[length];
      return std::fabs(distance) > PathFinder::kNear * (angle ? 1 : std::max(size, std::fabs(asked)));
    });
  };
  std::erase_if(result, is_far);
  return result;
}

}  // namespace corank::analyze
