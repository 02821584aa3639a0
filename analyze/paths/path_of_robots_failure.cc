// Which robots do not follow a path: sought in doubles, then proven.
#include <algorithm>
#include <cmath>
#include <random>

#include "corank/analyze/paths/path_of_robots.h"
#include "corank/analyze/sets/standing.h"
#include "corank/core/box.h"
#include "corank/core/rounding.h"
#include "corank/symbolic/model/model_file.h"

namespace corank::analyze {
namespace {

constexpr int kEffortOfSegment = 2000;
constexpr std::size_t kMostSamples = 240;  // of the path
constexpr std::size_t kAllCorners = 4;     // parameters, of which each corner is tried
constexpr int kSomeCorners = 24;

ExactNumber difference(const Variable& v, int corner, const ExactNumber& drawn) {
  return (corner > 0 ? v.upper : v.lower) - drawn;
}

double up(double share) { return std::min(1.0, std::nextafter(share, 2.0)); }

}  // namespace

// F(x, p) = 0, the section at t, p = v + λ (corner − v), λ the last variable: exactly these robots.
struct PathOfRobots::Segment {
  Segment(PathOfRobots& path, Place where)
      : place(std::move(where)), system(make(path, place)), lambda(system.size() - 1), family(system, {lambda}) {}

  static System make(const PathOfRobots& path, const Place& place) {
    System system = certify::piece_system(path.space_.system(), path.nodes_[place.piece], path.nodes_[place.piece + 1]);
    const int t = system.size() - 1, lambda = system.size();
    const auto at = [](int variable) { return Factors{{variable}}; };
    system.variables.emplace_back("share", VariableKind::auxiliary, ExactNumber(0), ExactNumber(1));
    const auto add = [&](int variable, const ExactNumber& constant, const ExactNumber& slope) {
      Polynomial f{{Monomial(ExactNumber(1), at(variable))}, ""};
      if (!constant.is_zero()) f.monomials.emplace_back(-constant, Factors{});
      if (!slope.is_zero()) f.monomials.emplace_back(-slope, at(lambda));
      system.equations.push_back(std::move(f));
    };
    add(t, ExactNumber::dyadic(place.t), ExactNumber(0));
    for (std::size_t k = 0; k < path.parameters_.size(); ++k) {
      Variable& v = system.variables[path.parameters_[k]];
      v.kind = VariableKind::auxiliary;
      add(path.parameters_[k], path.drawn_values_[k], difference(v, place.corner[k], path.drawn_values_[k]));
    }
    return system;
  }

  Box at(const Interval& share) const {
    Box box(system.size(), Interval());
    box.back() = share;
    return box;
  }

  Place place;
  System system;
  int lambda;
  SolutionFamily family;
};

// Along the path of the robot as drawn, then towards the corner, in steps that are halved where the solution moves far.
std::optional<PathOfRobots::Values> PathOfRobots::of_robot(const Place& place, double share) {
  constexpr double kFirst = 0.25, kShortest = 1.0 / 512, kFar = 0.25;
  SolutionFamily& solutions = family(place.piece);
  Values x = points_[place.piece];
  const auto go = [&](double t, double part) {
    Values next = x;
    next.back() = t;
    for (std::size_t j = 0; j < parameters_.size(); ++j) {
      const double end = place.corner[j] > 0 ? tolerances_[j].hi() : tolerances_[j].lo();
      next[parameters_[j]] = drawn_[j].mid() + part * (end - drawn_[j].mid());
    }
    const Values before = next;
    if (!solutions.approach(next)) return false;
    for (int j = 0; j < space_.size(); ++j)
      if (std::fabs(next[j] - before[j]) > kFar * space_.sizes()[j]) return false;
    x = std::move(next);
    return true;
  };
  for (const bool along : {true, false}) {
    double done = 0;
    for (double step = kFirst; done < 1 && (along ? place.t : share) > 0;) {
      const double next = std::min(1.0, done + step);
      if (along ? go(next * place.t, 0) : go(place.t, next * share)) {
        done = next;
      } else if ((step /= 2) < kShortest) {
        return std::nullopt;
      }
    }
  }
  return x;
}

bool PathOfRobots::fails(const Place& place, double share) {
  const std::optional<Values> x = of_robot(place, share);
  if (!x) return true;
  PathSpace::Point point(space_.size());
  for (int j = 0; j < space_.size(); ++j) point(j) = (*x)[j] / space_.sizes()[j];
  const PathSpace::State state = space_.state(point);
  return !state.inside || state.signs != signs_;
}

bool PathOfRobots::shrink(Place& place) {
  constexpr int kHalvings = 40;
  if (!fails(place, place.share)) return false;
  double low = 0;
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = (low + place.share) / 2;
    (fails(place, middle) ? place.share : low) = middle;
  }
  return true;
}

// All of them, or some at random.
std::vector<std::vector<int>> PathOfRobots::corners() const {
  const std::size_t m = parameters_.size();
  std::vector<std::vector<int>> result;
  std::mt19937 random(1);
  const int count = m <= kAllCorners ? 1 << m : kSomeCorners;
  for (int k = 0; k < count; ++k) {
    std::vector<int>& corner = result.emplace_back();
    for (std::size_t j = 0; j < m; ++j) {
      const bool upper = m <= kAllCorners ? (k >> j) % 2 != 0 : random() % 2 != 0;
      corner.push_back(upper ? 1 : -1);
    }
  }
  return result;
}

// Where the path of some robot fails at the least share: by samples of the path and corners; then other ends of single
// tolerances, and other places nearby, as long as they fail earlier.
std::optional<PathOfRobots::Place> PathOfRobots::worst(const solve::Control& control) {
  std::optional<Place> best;
  const auto better = [&](Place place) {
    if (best) place.share = best->share * (1 - 1e-6);
    if (!shrink(place)) return false;
    best = std::move(place);
    return true;
  };
  const std::size_t pieces = families_.size(),
                    each = std::max<std::size_t>(1, std::min<std::size_t>(4, kMostSamples / pieces));
  for (const std::vector<int>& corner : corners())
    for (std::size_t k = 0; k < pieces && !control.ended(); ++k)
      for (std::size_t i = 0; i < each + (k + 1 == pieces); ++i)
        better({k, static_cast<double>(i) / static_cast<double>(each), corner, 1});
  for (bool more = best && best->share > 0; more && !control.ended();) {
    more = false;
    for (std::size_t j = 0; j < parameters_.size(); ++j) {
      Place other = *best;
      other.corner[j] = -other.corner[j];
      more = better(std::move(other)) || more;
    }
    for (double step = 0.25; step > 1e-4; step /= 2)
      for (const double way : {-step, step}) {
        Place other = *best;
        other.t = std::clamp(other.t + way, 0.0, 1.0);
        if (other.t != best->t) better(std::move(other));
      }
  }
  return best;
}

symbolic::Expression PathOfRobots::constant_at(const Place& place, std::size_t parameter, double share) const {
  const auto& constants = space_.question().model.constants();
  const std::string& name = space_.system().variables[parameters_[parameter]].name;
  const symbolic::Constant& c = *std::ranges::find(constants, name, &symbolic::Constant::name);
  const symbolic::Expression part = symbolic::parse_expression(ExactNumber::dyadic(share).text(), "share");
  return c.value + part * ((place.corner[parameter] > 0 ? c.tolerance->upper : c.tolerance->lower) - c.value);
}

// A determinant's sign changes on the way there, or the configuration there is outside or violates what is required.
std::string PathOfRobots::what_differs(const Box& drawn, const Box& there, const Place& place, double share) const {
  {
    const UpwardRounding rounding;
    if (domain_.locate(compiled_, there) == certify::Location::outside)
      return "its path leaves the ranges or the limits there";
    const std::vector<int> here = space_.signs(drawn), signs = space_.signs(there);
    for (std::size_t k = 0; k < signs.size(); ++k)
      if (here[k] * signs[k] < 0)
        return avoid_ == Avoid::requirements ? "its path meets a limit of a requirement there"
                                             : "its path meets a singularity there";
  }
  if (avoid_ != Avoid::requirements) return "";
  study::Question one = space_.question();
  for (std::size_t k = 0; k < parameters_.size(); ++k)
    one.model.set_constant(space_.system().variables[parameters_[k]].name, constant_at(place, k, share));
  const symbolic::TrigonometricSystem equations = study::equations(one);
  Box own;
  for (const Variable& v : study::system(one, equations).variables) own.push_back(there[space_.system().find(v.name)]);
  return Standings(one.model, equations).of(own) == Standing::violated ? "there its path does not meet what is required"
                                                                       : "";
}

PathOfRobots::Failure PathOfRobots::failure_of(const Segment& segment, const Box& there, const Interval& shares,
                                               std::string what) const {
  const UpwardRounding rounding;
  Failure result{shares.hi(), {}, coordinate_values(space_.system(), configuration(there)), std::move(what)};
  for (std::size_t k = 0; k < parameters_.size(); ++k) {
    const Variable& v = space_.system().variables[parameters_[k]];
    result.robot.push_back(
        {v.name, drawn_[k] + shares * difference(v, segment.place.corner[k], drawn_values_[k]).enclose()});
  }
  return result;
}

std::optional<Box> PathOfRobots::drawn_at(const Place& place) {
  std::optional<Box> drawn = family(place.piece).solution(free_sides(drawn_, Interval(place.t)), points_[place.piece]);
  return drawn && holds(drawn_cells_[place.piece], *drawn) ? drawn : std::nullopt;
}

std::vector<SolutionFamily::Cell> PathOfRobots::from_drawn(Segment& segment, const Box& drawn, double share,
                                                           const solve::Control& control) {
  Values near = midpoint(drawn);
  near.push_back(0);
  std::vector<SolutionFamily::Cell> cells;
  int effort = kEffortOfSegment;
  const auto anything = [](const Box&) { return true; };
  if (!segment.family.cover(segment.at(Interval(0.0, share)), near, anything, cells, effort, control)) return {};
  Box start = drawn;
  start.emplace_back(0.0);
  return holds(cells, start) ? cells : std::vector<SolutionFamily::Cell>{};
}

// The segment's robots have one continuous function of configurations, from the drawn one's on, that keeps nothing. Where
// the robots of P follow, theirs is this function, since both have the drawn robot's. So where its configuration at the
// share is none that a path may have, or a determinant has the other sign there and was 0 on the way, they do not.
std::optional<PathOfRobots::Failure> PathOfRobots::prove_crossing(Segment& segment, double share,
                                                                  const solve::Control& control) {
  const Place& place = segment.place;
  const std::optional<Box> drawn = drawn_at(place);
  if (!drawn) return std::nullopt;
  const std::vector<SolutionFamily::Cell> cells = from_drawn(segment, *drawn, share, control);
  const std::optional<Values> there = of_robot(place, share);
  if (!there || cells.empty()) return std::nullopt;
  Values near = *there;
  near.push_back(share);
  const std::optional<Box> end = segment.family.solution(segment.at(Interval(share)), near);
  if (!end || !holds(cells, *end)) return std::nullopt;
  const std::string what = what_differs(configuration(*drawn), configuration(*end), place, share);
  if (what.empty()) return std::nullopt;
  // Just before, is all as at the start?
  for (const double less : {1e-6, 1e-4, 1e-2}) {
    const double before = share * (1 - less);
    near.back() = before;
    const std::optional<Box> earlier = segment.family.solution(segment.at(Interval(before)), near);
    if (!earlier || !holds(cells, *earlier)) continue;
    const UpwardRounding rounding;
    if (space_.signs(configuration(*earlier)) == signs_) return failure_of(segment, *end, Interval(before, share), what);
  }
  return failure_of(segment, *end, Interval(0.0, share), what);
}

std::optional<PathOfRobots::Failure> PathOfRobots::prove(const Place& place, const solve::Control& control) {
  Segment segment(*this, place);
  for (const double more : {1e-6, 1e-4, 1e-2}) {
    const double share = std::min(1.0, place.share * (1 + more));
    if (!of_robot(place, share)) break;
    if (auto result = prove_crossing(segment, share, control)) return result;
  }
  return prove_fold(segment, place.share, control);
}

std::optional<PathOfRobots::Failure> PathOfRobots::failure(const solve::Control& control) {
  const std::optional<Place> place = worst(control);
  if (!place || !(place->share > 0)) return std::nullopt;
  return prove(*place, control);
}

// Where the function cannot go on. Theorem: let an arc of solutions (x, λ), a function of one of the x_i with regular
// Jacobians, have 0 < λ < Λ all along, begin at a solution (x(λ_a), λ_a) of the function of λ, and have λ larger in its
// inside than at both its ends. Then that function does not reach Λ with regular Jacobians. Proof: about each of its points
// with 0 < λ < Λ all solutions are its own. So the arc, connected, would lie on it; λ is one-to-one on it, so monotone along
// the arc. ∎
std::optional<PathOfRobots::Failure> PathOfRobots::prove_fold(Segment& segment, double share,
                                                              const solve::Control& control) {
  const Place& place = segment.place;
  const std::optional<Box> drawn = drawn_at(place);
  if (!drawn) return std::nullopt;
  for (const double less : {1e-6, 1e-5, 1e-4, 1e-3, 1e-2}) {
    const double before = share * (1 - less);
    const std::optional<Values> point = of_robot(place, before);
    const std::optional<Values> earlier = of_robot(place, before * (1 - less));
    if (!point || !earlier) continue;
    const std::vector<SolutionFamily::Cell> cells = from_drawn(segment, *drawn, before, control);
    if (cells.empty()) continue;
    Values from = *point;
    from.push_back(before);
    const std::optional<Box> end = segment.family.solution(segment.at(Interval(before)), from);
    if (!end || !holds(cells, *end)) continue;
    // The variable that moves most, and which way.
    int i = 0;
    double most = 0;
    for (int j = 0; j < space_.size(); ++j) {
      const double move = ((*point)[j] - (*earlier)[j]) / space_.sizes()[j];
      const bool fixed = std::ranges::find(parameters_, j) != parameters_.end();
      if (!fixed && std::fabs(move) > std::fabs(most)) most = move, i = j;
    }
    if (most == 0) continue;
    SolutionFamily arc(segment.system, {i});
    const double way = most > 0 ? 1 : -1;
    for (double step = 1e-6 * space_.sizes()[i]; step < space_.sizes()[i]; step *= 1.9) {
      Values inside = from, beyond = from;
      inside[i] += way * step;
      beyond[i] += 2 * way * step;
      if (!arc.approach(inside) || !arc.approach(beyond)) break;
      if (!(inside.back() > before && beyond.back() < before)) continue;
      const Interval first = (*end)[i], last(beyond[i]);
      if (first.contains(inside[i]) || !Interval::hull(first, last).contains(inside[i])) continue;
      Box over(segment.system.size(), Interval());
      over[i] = Interval::hull(first, last);
      double largest = 0;
      const auto keeps = [&](const Box& image) {
        largest = std::max(largest, image.back().hi());
        return image.back().lo() > 0;
      };
      std::vector<SolutionFamily::Cell> along;
      int tries = kEffortOfSegment;
      if (!arc.cover(over, inside, keeps, along, tries, control)) continue;
      const auto solution = [&](const Values& x) {
        Box at(segment.system.size(), Interval());
        at[i] = Interval(x[i]);
        return arc.solution(at, x);
      };
      const std::optional<Box> top = solution(inside), other = solution(beyond);
      if (!top || !other || !holds(along, *end) || !holds(along, *top) || !holds(along, *other)) continue;
      const bool turns = top->back().lo() > before && other->back().hi() < top->back().lo();
      if (!turns || !(largest < 1)) continue;
      return failure_of(segment, *top, Interval(before, up(largest)),
                        "there its path cannot go on as a function of the tolerances");
    }
  }
  return std::nullopt;
}

}  // namespace corank::analyze
