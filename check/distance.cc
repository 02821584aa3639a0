#include "corank/check/distance.h"

#include <algorithm>
#include <cmath>

#include "corank/core/closest_points.h"

namespace corank::check {
namespace {

using PointForm = std::array<Form, 3>;
using BodyForm = std::vector<PointForm>;

std::array<double, 3> values(const PointForm& p, const auto& value) { return {value(p[0]), value(p[1]), value(p[2])}; }

PointsOfBodies values(const std::array<BodyForm, 2>& bodies, const auto& value) {
  PointsOfBodies result;
  for (std::size_t b = 0; b < 2; ++b)
    for (const PointForm& p : bodies[b]) result[b].push_back(values(p, value));
  return result;
}

Form dot(const PointForm& x, const PointForm& y, const Sides& offsets) {
  Form sum = product(x[0], y[0], offsets);
  for (std::size_t i = 1; i < 3; ++i) sum.add_multiple(Enclosure(1.0), product(x[i], y[i], offsets));
  return sum;
}

PointForm minus(PointForm x, const PointForm& y) {
  for (std::size_t i = 0; i < 3; ++i) x[i].add_multiple(Enclosure(-1.0), y[i]);
  return x;
}

// Is ‖V‖ below least for the difference V of two points of the hulls, given by weights?
bool meet(const std::array<BodyForm, 2>& bodies, const ClosestPoints& at, const Enclosure& least, const Sides& offsets) {
  PointForm v;
  for (Form& component : v) component = {Enclosure(0.0), Sides(offsets.size())};
  for (std::size_t b = 0; b < 2; ++b) {
    Enclosure all;
    for (const double w : at.weights[b]) {
      if (!(w >= 0) || !std::isfinite(w)) return false;
      all += Enclosure(w);
    }
    if (!all.is_positive()) return false;
    for (std::size_t i = 0; i < bodies[b].size(); ++i) {
      const Enclosure share = quotient(Enclosure(at.weights[b][i]), all);
      for (std::size_t k = 0; k < 3; ++k) v[k].add_multiple(b == 0 ? share : -share, bodies[b][i][k]);
    }
  }
  // ‖V‖² = (e·V)² (2 − ‖e‖²) + ‖V − (e·V) e‖² for any e.
  Form along{Enclosure(0.0), Sides(offsets.size())};
  Enclosure length, square;
  for (std::size_t k = 0; k < 3; ++k) {
    along.add_multiple(Enclosure(at.direction[k]), v[k]);
    length += power(Enclosure(at.direction[k]), 2);
  }
  for (std::size_t k = 0; k < 3; ++k) {
    Form rest = v[k];
    rest.add_multiple(Enclosure(-at.direction[k]), along);
    square += power(rest.range(offsets), 2);
  }
  square += power(along.range(offsets), 2) * (Enclosure(2.0) - length);
  return square.below(power(least, 2));
}

// Is e·(a − b) at least least·‖e‖ > 0 for each two points of the hulls, e a direction that turns with the offsets?
bool separates(const PointForm& e, const std::array<BodyForm, 2>& bodies, const Enclosure& least, const Sides& offsets) {
  const Enclosure square = dot(e, e, offsets).range(offsets);
  if (!square.is_bounded() || !square.may_be_nonnegative()) return false;
  const Enclosure gap = least * square_root(square).upper_end();
  if (!gap.is_positive()) return false;  // e = 0 separates nothing
  for (const PointForm& a : bodies[0])
    for (const PointForm& b : bodies[1])
      if (!gap.at_most(dot(e, minus(a, b), offsets).range(offsets))) return false;
  return true;
}

}  // namespace

Standing standing(const DistanceTest& test, const FormOfVariable& form, const Sides& offsets) {
  std::array<BodyForm, 2> bodies;
  for (std::size_t b = 0; b < 2; ++b)
    for (const auto& p : test.hulls[b]) {
      PointForm& forms = bodies[b].emplace_back();
      for (std::size_t i = 0; i < 3; ++i)
        forms[i] = p[i].variable < 0 ? Form{Enclosure(p[i].number), Sides(offsets.size())} : form(p[i].variable);
    }
  const PointsOfBodies middle = values(bodies, [](const Form& f) { return f.constant.mid(); });
  for (const auto& body : middle)
    for (const auto& p : body)
      if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2])) return Standing::open;
  const ClosestPoints at = closest_points(middle);
  for (const double x : at.direction)
    if (!std::isfinite(x)) return Standing::open;
  const Enclosure least(test.least);
  if (meet(bodies, at, least, offsets)) return Standing::violated;
  std::vector<PointsOfBodies> slopes;
  for (std::size_t k = 0; k < offsets.size(); ++k)
    slopes.push_back(values(bodies, [k](const Form& f) { return f.slopes[k].mid(); }));
  const std::vector<std::array<double, 3>> turns = turn_of_direction(middle, at, slopes);
  PointForm e;
  for (std::size_t i = 0; i < 3; ++i) {
    e[i].constant = Enclosure(at.direction[i]);
    for (const std::array<double, 3>& turn : turns) e[i].slopes.push_back(Enclosure(std::isfinite(turn[i]) ? turn[i] : 0.0));
  }
  return separates(e, bodies, least, offsets) ? Standing::satisfied : Standing::open;
}

DistanceCheck::DistanceCheck(const System& system, const KeptDistances& distances, const StopFlag& stop)
    : stop_(stop),
      tests_(distances.tests),
      functions_(rows_of(distances.functions, system.size())),
      arguments_(variables_of({functions_})),
      lengths_(domain_lengths(system)) {}

bool DistanceCheck::holds(const Sides& box) const {
  constexpr int kMostParts = 256;
  return shown_in_parts(box, arguments_, lengths_, kMostParts, stop_, [&](Sides& x) { return holds_in_one(x); });
}

bool DistanceCheck::holds_in_one(const Sides& x) const {
  Sides center, offsets;
  for (const Enclosure& side : x) center.emplace_back(side.mid());
  for (const int j : arguments_) offsets.push_back(x[j] - center[j]);
  const auto form = [&](int function) {
    const Row& f = functions_[function];
    Form result{f.value(center), Sides(arguments_.size())};
    Sides slopes;
    f.slopes(x, center, slopes);
    for (std::size_t k = 0; k < slopes.size(); ++k)
      result.slopes[std::ranges::lower_bound(arguments_, f.columns()[k]) - arguments_.begin()] = slopes[k];
    return result;
  };
  return std::ranges::all_of(tests_,
                             [&](const DistanceTest& test) { return standing(test, form, offsets) == Standing::satisfied; });
}

}  // namespace corank::check
