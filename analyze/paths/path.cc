#include "corank/analyze/paths/path.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <numbers>

#include "corank/analyze/paths/path_graph.h"
#include "corank/analyze/paths/path_space.h"
#include "corank/analyze/paths/tube_builder.h"
#include "corank/analyze/sets/standing.h"
#include "corank/certify/meeting.h"
#include "corank/core/rounding.h"
#include "corank/result/values/words.h"
#include "corank/solve/exactness/exactness.h"
#include "corank/solve/search/solve.h"
#include "corank/symbolic/algebra/exact_value.h"

namespace corank::analyze {
namespace {

constexpr int kMostOfGraph = 3;        // dimensions
constexpr int kLevels = 4;             // of covers
constexpr int kTubeTries = 5;          // on one cover
constexpr double kNearBoundary = 0.3;  // a shortcut keeps so much of the way's least margin

// Coarse enough that a cover has a few thousand boxes.
double first_sigma(int dimension) { return dimension <= 1 ? 0.1 : dimension == 2 ? 0.2 : 0.5; }

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
    study::require_exact_value(space.question().model, v.value, v.name);
    const ExactNumber value = symbolic::exact_value(space.question().model, v.value, v.name);
    const auto angle = std::ranges::find_if(system.angles, [&](const Angle& a) { return a.name == v.name; });
    const int length = system.find(v.name);
    if (angle != system.angles.end()) {
      const auto circle = std::ranges::find_if(system.equations, [&](const Polynomial& f) { return is_circle(f, *angle); });
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

// Behind PathFinder.
class PathFinder::Search {
 public:
  Search(const study::Question& question, const PathOptions& options)
      : space_(nominal(question), options.avoid, options.factors_up_to), options_(options), planner_(space_) {
    if (!question.model.toleranced().empty()) all_.emplace(question, options.avoid);
    builder_.emplace(space());
  }

  /// Of all robots: where ends are, and tubes.
  const PathSpace& space() const { return all_ ? *all_ : space_; }
  const PathOptions& options() const { return options_; }
  Path find(const Box& from, const Box& to, solve::Control& control);

 private:
  struct Ends {
    Box from, to;
    PathSpace::Point a, b;   // of the robot as drawn
    PathSpace::State state;  // at the start
    std::vector<int> signs;  // likewise, proven
  };
  static study::Question nominal(study::Question question) {
    question.model = question.model.nominal();
    return question;
  }
  /// Of the robot as drawn, a configuration in the box or near it, and the other way round.
  PathSpace::Point drawn(const Box& box) const;
  PathSpace::Point of_all(const PathSpace::Point& x) const;

  bool try_way(const Ends& ends, const TubeBuilder::Points& points, const std::string& method, Path& path,
               const solve::Control& control, std::size_t* failed = nullptr);
  void find_by_graph(const Ends& ends, Path& path, solve::Control& control);
  /// `shares` of the ends' margin that a way is to keep, one after the other.
  void find_by_sampling(const Ends& ends, const std::vector<double>& shares, double seconds, Path& path,
                        const solve::Control& control);

  PathSpace space_;               // of the robot as drawn, in which ways are sought
  std::optional<PathSpace> all_;  // where constants have tolerances
  PathOptions options_;
  TubeBuilder planner_;
  std::optional<TubeBuilder> builder_;
  std::deque<PathGraph> graphs_;
};

PathSpace::Point PathFinder::Search::drawn(const Box& box) const {
  if (!all_) return space_.middle(box);
  PathSpace::Point x(space_.size());
  for (int j = 0; j < space_.size(); ++j)
    x(j) = box[all_->system().find(space_.system().variables[j].name)].mid() / space_.sizes()[j];
  space_.project(x);
  return x;
}

PathSpace::Point PathFinder::Search::of_all(const PathSpace::Point& x) const {
  if (!all_) return x;
  PathSpace::Point result(all_->size());
  for (int j = 0; j < all_->size(); ++j) {
    const Variable& v = all_->system().variables[j];
    const int own = space_.system().find(v.name);
    const double value = own < 0 ? v.domain.mid() : x(own) * space_.sizes()[own];
    result(j) = value / all_->sizes()[j];
  }
  return result;
}

bool PathFinder::Search::try_way(const Ends& ends, const TubeBuilder::Points& points, const std::string& method, Path& path,
                                 const solve::Control& control, std::size_t* failed) {
  std::vector<double> radii{0.0};
  if (options_.radius > 0) radii = {options_.radius, 0.0};
  const TubeBuilder::Points shorter = planner_.shortcut(points, kNearBoundary, control);
  for (const double radius : radii)
    for (const TubeBuilder::Points* way : {&shorter, &points}) {
      TubeBuilder::Points of_each;
      for (const PathSpace::Point& x : *way) of_each.push_back(of_all(x));
      TubeBuilder::Outcome outcome = builder_->build(ends.from, of_each, ends.to, radius, control);
      if (failed) *failed = outcome.failed;
      if (!outcome.tube) continue;
      path.status = Path::Status::path;
      path.method = method;
      path.tube = std::move(outcome.tube);
      path.reason.clear();
      if (path.tube->radius() < options_.radius) path.reason = "no path with the requested radius was found";
      return true;
    }
  return false;
}

void PathFinder::Search::find_by_graph(const Ends& ends, Path& path, solve::Control& control) {
  for (std::size_t level = 0; level < kLevels && !control.ended(); ++level) {
    if (level == graphs_.size()) {
      if (!graphs_.empty() && !graphs_.back().ready()) break;
      const double sigma = first_sigma(space_.dimension()) / std::pow(2.0, static_cast<double>(level));
      graphs_.emplace_back(space_, sigma, options_.threads, options_.max_boxes, control);
    }
    PathGraph& graph = graphs_[level];
    if (!graph.ready()) break;
    path.resolution = graph.sigma();
    if (!all_ && space_.sign_functions() > 0 && graph.apart(ends.from, ends.to, ends.signs)) {
      path.status = Path::Status::separated;
      path.reason = fmt::format("no chain of boxes of a cover with edges of {:g} joins the ends without {}", graph.sigma(),
                                options_.avoid == Avoid::requirements ? "a limit of a requirement" : "a singularity");
      return;
    }
    PathGraph::Blocked blocked;
    for (int k = 0; k < kTubeTries && !control.ended(); ++k) {
      const auto way = graph.way(ends.a, ends.b, ends.state.signs, planner_, blocked, control);
      if (!way) break;
      std::size_t failed = 0;
      if (try_way(ends, *way, "graph", path, control, &failed)) return;
      if (failed == 0 || failed + 2 >= way->size()) break;
      graph.block(failed, blocked);
    }
  }
  path.reason = control.ended() ? "stopped by " + solve::stopped_by(control)
                : !graphs_.empty() && !graphs_.back().ready()
                    ? "no path was found, and a finer cover would have too many boxes"
                    : "no path was found, and no cover separates the ends";
}

void PathFinder::Search::find_by_sampling(const Ends& ends, const std::vector<double>& shares, double seconds, Path& path,
                                          const solve::Control& control) {
  const double least = std::min(ends.state.margin, space_.state(ends.b).margin);
  for (const double share : shares) {
    const auto way = sampled_way(space_, ends.a, ends.b, share * least, seconds, control);
    if (way && try_way(ends, *way, "sampling", path, control)) return;
    if (control.ended()) break;
  }
  path.reason = control.ended() ? "stopped by " + solve::stopped_by(control) : "no path was found by sampling";
}

Path PathFinder::Search::find(const Box& from, const Box& to, solve::Control& control) {
  const auto start = std::chrono::steady_clock::now();
  Path path;
  path.from = from;
  path.to = to;
  Ends ends{from, to, drawn(from), drawn(to), {}, {}};
  ends.state = space_.state(ends.a);
  std::vector<int> there;
  {
    const UpwardRounding rounding;
    ends.signs = space().signs(from);
    there = space().signs(to);
  }
  const auto known = [](const std::vector<int>& signs) { return std::ranges::find(signs, 0) == signs.end(); };
  const PathSpace::State goal = space_.state(ends.b);
  const bool of_requirements = options_.avoid == Avoid::requirements;
  if (!known(ends.signs) || !known(there)) {
    path.reason = of_requirements ? "an end is at a limit of a requirement, or too near one to be distinguished from it"
                                  : "an end is singular, or too near a singularity to be distinguished from one";
  } else if (ends.signs != there) {
    path.status = Path::Status::separated;
    path.reason = of_requirements ? "a function that is 0 only at limits of requirements has opposite signs at the ends"
                                  : "a determinant, or a factor of it, has opposite signs at the ends";
  } else if (!ends.state.inside || !goal.inside) {
    path.reason =
        space_.distances().tests.empty()
            ? "an end is on the border of the ranges, the limits or the inequalities"
            : "an end is on the border of the ranges, the limits or the inequalities, or bodies are too near there";
  } else {
    const double step = std::max(1e-3, (ends.b - ends.a).norm() / 200);
    const double least = kNearBoundary * std::min(ends.state.margin, goal.margin);
    const auto accept = [&](const PathSpace::Point& x) { return space_.admits(x, ends.state.signs, least); };
    const auto between = planner_.follow(ends.a, ends.b, step, accept);
    if (!between || !try_way(ends, {ends.a, ends.b}, "direct", path, control)) {
      // A cover of three dimensions is dear: samples, which may find a way but never that there is none, come first.
      const int dimension = space_.dimension();
      if (dimension >= kMostOfGraph) {
        const bool all = dimension > kMostOfGraph;
        find_by_sampling(ends, all ? std::vector<double>{0.3, 0.1, 0.03} : std::vector<double>{0.1},
                         options_.sampling_seconds * (all ? 1 : 0.25), path, control);
      }
      if (dimension <= kMostOfGraph && !path.tube) find_by_graph(ends, path, control);
    }
  }
  if (path.tube) {
    std::vector<std::string> names;
    const auto values = node_values(space().system(), *path.tube, names);
    for (std::size_t k = 1; k < values.size(); ++k) {
      double squares = 0;
      for (std::size_t j = 0; j < names.size(); ++j) {
        const int length = space().system().find(names[j]);  // an angle is no variable
        const double size = length < 0 ? 1 : space().sizes()[length];
        squares += std::pow((values[k][j] - values[k - 1][j]) / size, 2);
      }
      path.length += std::sqrt(squares);
    }
  }
  // A finer cover that would have had too many boxes has ended itself, not the run.
  if (path.status != Path::Status::separated && control.ended()) path.stopped = solve::stopped_by(control);
  path.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return path;
}

PathFinder::PathFinder(const study::Question& question, const PathOptions& options)
    : search_(std::make_unique<Search>(question, options)) {}
PathFinder::~PathFinder() = default;

const study::Question& PathFinder::question() const { return search_->space().question(); }
const PathOptions& PathFinder::options() const { return search_->options(); }
const System& PathFinder::system() const { return search_->space().system(); }
const std::vector<PolynomialMatrix>& PathFinder::matrices() const { return search_->space().matrices(); }
const std::vector<int>& PathFinder::ranks() const { return search_->space().ranks(); }

std::vector<Box> PathFinder::ends(const std::vector<NamedValue>& values, solve::Control& control) const {
  const PathSpace& space = search_->space();
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
  if (!cover.complete()) throw EndError("the search for the configurations was stopped by " + solve::stopped_by(control));
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
    return std::ranges::any_of(further, [&](const NamedValue& v) {
      const double asked = symbolic::exact_value(space.question().model, v.value, v.name).enclose().mid();
      const auto at = std::ranges::find_if(there, [&](const CoordinateValue& c) { return c.name == v.name; });
      if (at == there.end()) return false;
      const auto& angles = space.system().angles;
      const bool angle = std::ranges::any_of(angles, [&](const Angle& a) { return a.name == v.name; });
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

std::vector<PathFinder::Sign> PathFinder::signs(const Box& box) const {
  const UpwardRounding rounding;
  const std::vector<int> signs = search_->space().signs(box);
  std::vector<Sign> result;
  for (const PathSpace::SignFunction& f : search_->space().sign_names())
    result.push_back({f.of, f.factor, signs[result.size()]});
  return result;
}

Path PathFinder::find(const Box& from, const Box& to, solve::Control& control) {
  Path path = search_->find(from, to, control);
  if (options().avoid == Avoid::requirements && question().model.toleranced().empty()) path.standing = standing(from);
  return path;
}

Standing PathFinder::standing(const Box& end) const {
  if (!question().model.toleranced().empty()) return Standing::open;
  return Standings(question().model, study::equations(question())).of(end);
}

Box PathFinder::end(const std::vector<NamedValue>& values, int mode, const std::string& option,
                    solve::Control& control) const {
  std::vector<Box> found;
  try {
    found = ends(values, control);
  } catch (const EndError& e) {
    throw EndError(option + ": " + e.what());
  }
  if (found.empty()) throw EndError(option + ": there is no configuration with these values");
  if (mode == 0 && found.size() == 1) return found.front();
  if (mode >= 1 && mode <= static_cast<int>(found.size())) return found[mode - 1];
  std::string text = fmt::format("{}: {} {} these values; choose with {}-mode or by more coordinates:", option,
                                 result::counted(found.size(), "configuration"), found.size() == 1 ? "has" : "have", option);
  for (std::size_t k = 0; k < found.size(); ++k) {
    text += fmt::format("\n  {}:", k + 1);
    for (const CoordinateValue& c : coordinate_values(system(), found[k]))
      text += fmt::format(" {}={:.4g}", c.name, c.value.mid());
  }
  throw EndError(text);
}

std::vector<std::vector<double>> node_values(const System& system, const Tube& tube, std::vector<std::string>& names) {
  std::vector<std::vector<double>> result;
  for (const TubeNode& node : tube.nodes) {
    names.clear();
    std::vector<double> row;
    for (const CoordinateValue& v : coordinate_values(system, node.box)) {
      double value = v.value.mid();
      const bool angle = std::ranges::any_of(system.angles, [&](const Angle& a) { return a.name == v.name; });
      if (angle && !result.empty())
        value = result.back()[row.size()] + std::remainder(value - result.back()[row.size()], 2 * std::numbers::pi);
      names.push_back(v.name);
      row.push_back(value);
    }
    result.push_back(std::move(row));
  }
  return result;
}

}  // namespace corank::analyze
