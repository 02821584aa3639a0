#include "corank/analyze/topology/topology.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "corank/analyze/pieces/pieces.h"
#include "corank/analyze/robots/same_strata.h"
#include "corank/analyze/topology/topology_with_ends.h"
#include "corank/certify/compiled_system.h"
#include "corank/certify/inertia.h"
#include "corank/core/box.h"
#include "corank/core/check.h"
#include "corank/core/rounding.h"
#include "corank/solve/exactness/exactness.h"
#include "corank/solve/search/solve.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/symbolic/sets/critical_points.h"

namespace corank::analyze {
namespace {

constexpr int kUnknown = -1;

struct Solved {
  System system;
  Cover cover;
};

// The search ends after `most` boxes; 0: never.
Cover solved(const System& system, std::optional<double> sigma, const TopologyOptions& how, solve::Control& control,
             std::uint64_t most = 0) {
  const solve::Options options{.sigma = sigma, .threads = how.threads, .proof = how.certificate, .proof_of_parts = false};
  const solve::Prepared prepared = solve::prepare(system, options, control);
  Cover cover = solve::solve(prepared, control, most);
  if (cover.dimension == 0) solve::prove_exactly(prepared, cover, control);
  return cover;
}

// Signs of the second-order form of h at the critical points.
class Indices {
 public:
  Indices(const symbolic::CriticalPoints& critical, const System& system)
      : n_(static_cast<int>(critical.names.size())),
        m_(static_cast<int>(critical.jacobian.rows.size())),
        compiled_(system, symbolic::polynomials(critical.system, entries(critical))) {}

  /// kUnknown where no inertia, or no sign of μ, is proven in the box.
  int index(const Box& box) const {
    const Interval mu = value(n_ * n_ + m_ * n_, box);
    if (mu.contains_zero()) return kUnknown;
    certify::IntervalMatrix hessian(n_, n_), jacobian(m_, n_);
    for (int k = 0; k < n_ * n_; ++k) hessian.entries[k] = value(k, box);
    for (int k = 0; k < m_ * n_; ++k) jacobian.entries[k] = value(n_ * n_ + k, box);
    const std::optional<certify::Inertia> inertia = certify::inertia_on_kernel(hessian, jacobian);
    if (!inertia) return kUnknown;
    return mu.lo() > 0 ? inertia->negative : inertia->positive;
  }

 private:
  static std::vector<symbolic::Expression> entries(const symbolic::CriticalPoints& critical) {
    std::vector<symbolic::Expression> list;
    for (const auto* matrix : {&critical.hessian, &critical.jacobian})
      for (const auto& row : matrix->rows) list.insert(list.end(), row.begin(), row.end());
    list.push_back(critical.multiplier);
    return list;
  }
  Interval value(int k, const Box& box) const { return compiled_.evaluate(compiled_.value_row(k), box); }

  int n_, m_;
  certify::CompiledSystem compiled_;
};

// The piece on whose region the configuration at a critical point lies, −1 where none is known to. The variables that both
// systems have are found by their names: auxiliary ones stand between them.
int piece_of(const Box& critical_point, const System& critical, const Solved& space, const Components& components) {
  const std::optional<Box> point = same_configuration(critical, critical_point, space.system);
  if (!point) return kUnknown;
  for (std::size_t i = 0; i < space.cover.boxes.size(); ++i) {
    const CoverBox& box = space.cover.boxes[i];
    if (box.verdict == Verdict::regular && contains(space.cover.regions[box.region], *point))
      return components.piece_of_box[i];
  }
  return kUnknown;
}

HeightCount count_critical_points(const study::Question& question, int height, const Solved& space,
                                  const Components& components, const TopologyOptions& options, std::uint64_t& processed,
                                  solve::Control& control) {
  HeightCount result;
  result.by_index.assign(space.cover.dimension + 1, 0);
  const symbolic::CriticalPoints critical = symbolic::critical_points(question.model, height);
  System system;
  std::optional<Indices> indices;
  try {
    system = study::system(question, critical.system);
    indices.emplace(critical, system);
  } catch (const symbolic::ModelError&) {  // no polynomials: sines of lengths
    result.problem = "the equations of critical points are not polynomials";
    return result;
  }
  Cover cover = solved(system, std::nullopt, options, control, options.most_for_a_height);
  processed += cover.statistics.processed;
  result.problem = problem_of_points(cover);
  if (!result.problem.empty()) return result;
  const UpwardRounding rounding;
  // −ξ is no solution where a·ξ > 0: where it is 0, a point may be counted twice.
  const certify::CompiledSystem compiled(system);
  std::vector<int> euler(components.pieces, 0);
  bool placed = true;
  for (const CoverBox& point : cover.points) {
    const bool proven = point.verdict == Verdict::isolated || point.verdict == Verdict::exact;
    const int index = proven ? indices->index(point.box) : kUnknown;
    bool apart = true;
    for (int row = compiled.equations(); row < compiled.rows(); ++row)
      apart = apart && compiled.evaluate(row, point.box).lo() > 0;
    if (index == kUnknown || !apart) {
      result.problem = proven ? "a critical point that may be degenerate" : "a critical point that is not proven";
      return result;
    }
    ++result.by_index[index];
    const int piece = piece_of(point.box, system, space, components);
    placed = placed && piece >= 0;
    if (piece >= 0 && piece < components.pieces) euler[piece] += index % 2 == 0 ? 1 : -1;
  }
  if (placed) result.euler_of_piece = euler;
  if (options.certificate) result.cover = HeightCover{height, std::move(cover), result.by_index};
  return result;
}

// Components with σ as fine as it takes, from whole sheets on.
Components refined_components(Solved& space, const TopologyOptions& options, std::uint64_t& processed,
                              solve::Control& control) {
  double widest = 1;
  for (const Interval& side : space.system.domain()) widest = std::max(widest, side.width());
  Components best;
  for (int k = 0; k <= options.refinements; ++k) {
    Cover cover = solved(space.system, k == 0 ? solve::kWhole : widest / std::exp2(k + 3), options, control);
    processed += cover.statistics.processed;
    const Components found = components(space.system, cover, control);
    if (k > 0 && !cover.complete()) break;
    const bool better =
        k == 0 || found.exact() ||
        (found.at_most.value_or(1 << 30) <= best.at_most.value_or(1 << 30) && found.at_least >= best.at_least);
    if (better) {
      best = found;
      space.cover = std::move(cover);
    }
    if (best.exact() || !best.at_most || best.piece_of_box.empty() || control.ended()) break;
  }
  return best;
}

void find_shape(const study::Question& question, const Solved& space, const TopologyOptions& options, Topology& result,
                solve::Control& control) {
  const bool odd = space.cover.dimension % 2 != 0;
  if (odd) result.euler_characteristic = 0;  // Poincaré duality
  std::string problem;
  for (int height = 0; height < kHeights && result.heights.size() < 2 && !control.ended(); ++height) {
    HeightCount count =
        count_critical_points(question, height, space, result.components, options, result.processed, control);
    problem = count.problem;
    if (count.problem.empty()) result.heights.push_back(std::move(count));
    if (odd && !problem.empty()) break;  // nothing but the number of critical points is left to know
  }
  if (result.heights.empty()) {
    result.reason = problem;
    return;
  }
  // Both are proven: they cannot differ.
  for (const HeightCount& h : result.heights)
    CORANK_CHECK(h.euler_characteristic() == result.heights.front().euler_characteristic());
  result.euler_characteristic = result.heights.front().euler_characteristic();
  Components& components = result.components;
  for (const HeightCount& h : result.heights)
    if (components.at_most) {
      components.at_most = std::min(*components.at_most, h.by_index.front());
      CORANK_CHECK(components.at_least <= *components.at_most);
    }
  if (space.cover.dimension != 2 || !components.exact()) return;
  if (components.at_least == 1) {
    result.genus = {1 - *result.euler_characteristic / 2};
  } else if (const auto& euler = result.heights.front().euler_of_piece;
             static_cast<int>(euler.size()) == components.at_least) {
    for (const int chi : euler) result.genus.push_back(1 - chi / 2);
    std::ranges::sort(result.genus);
  } else {
    result.reason = "a critical point on no known component";
  }
}

}  // namespace

int HeightCount::points() const { return std::accumulate(by_index.begin(), by_index.end(), 0); }

int HeightCount::euler_characteristic() const {
  int sum = 0;
  for (std::size_t k = 0; k < by_index.size(); ++k) sum += k % 2 == 0 ? by_index[k] : -by_index[k];
  return sum;
}

namespace {

// Of a set that comes to ends of its domain: of what is strictly within (sign_cells.h).
Components components_within(const System& system, const Cover& cover, const std::vector<Limit>& ends,
                             const TopologyOptions& options, solve::Control& control) {
  std::vector<Polynomial> functions;
  for (const Limit& end : ends) functions.push_back(end.function);
  const System whole = with_single_values(system);
  Components result;
  if (!is_square_over(whole, cover.dimension) || !std::ranges::all_of(cover.boxes, is_sheet)) {
    result.reason = "boxes that are neither regular nor at an end";
    return result;
  }
  SignCells cells(whole, cover, {}, functions, control);
  cells.refine(options.halvings, options.rounds, control);
  const Pieces found = pieces(cells, control);
  result.at_least = found.at_least;
  result.at_most = found.at_most;
  result.reason = found.reason;
  return result;
}

Topology found(const study::Question& question, Solved& space, const TopologyOptions& options, solve::Control& control) {
  Topology result;
  Cover whole = solved(space.system, solve::kWhole, options, control);
  result.dimension = whole.dimension;
  if (whole.complete() && whole.dimension > 0) {
    const std::vector<Limit> touched = limits(space.system, whole);
    if (!touched.empty()) {
      result.processed = whole.statistics.processed;
      const std::vector<Limit> ends = without_unreached(space.system, touched, options, result.processed, control);
      for (const Limit& end : ends) result.ends.push_back(end.name);
      // All that are touched: sheets of `boundary` boxes may go on beyond each of them.
      result.components = components_within(space.system, whole, touched, options, control);
      result.reason = result.components.reason;
      if (!ends.empty()) {
        find_shape_with_ends(space.system, result.dimension, ends, options, result, control);
        return result;
      }
      // Whole sheets are wide: smaller ones keep clear of ends that are not reached.
      space.cover = solved(space.system, std::nullopt, options, control);
      result.processed += space.cover.statistics.processed;
      result.components.piece_of_box.assign(space.cover.boxes.size(), -1);
    }
  }
  if (space.cover.boxes.empty()) result.components = refined_components(space, options, result.processed, control);
  result.dimension = space.cover.dimension;
  result.smooth = result.dimension > 0 && space.cover.count(Verdict::regular) == space.cover.boxes.size();
  if (space.cover.boxes.empty() && space.cover.complete()) {
    result.smooth = true;
    result.euler_characteristic = 0;
    return result;
  }
  if (!result.smooth) {
    const bool points = result.dimension == 0 && result.components.at_most;
    result.reason = points ? "a set of points" : "not shown to be a manifold: " + result.components.reason;
    if (result.dimension == 0 && result.components.at_most) result.euler_characteristic = result.components.at_least;
    return result;
  }
  find_shape(question, space, options, result, control);
  return result;
}

std::shared_ptr<const Shape> certificate(const Topology& result, Solved& space, solve::Control& control) {
  if (!result.smooth || !result.ends.empty() || result.dimension < 1 || control.ended() ||
      !is_square_over(space.system, result.dimension))
    return nullptr;
  std::vector<HeightCover> heights;
  for (const HeightCount& h : result.heights) heights.push_back(h.cover.value());
  const Components& counted = result.components;
  // They may have been counted on cells.
  Components linked = counted.pieces > 0 ? counted : components(space.system, space.cover, control);
  return std::make_shared<const Shape>(Shape{std::move(space.cover), std::move(linked.bridges), std::move(linked.links),
                                             std::move(heights), counted.at_least, counted.at_most,
                                             result.euler_characteristic, result.genus});
}

ExactNumbers exact_numbers(const Topology& t) {
  ExactNumbers numbers;
  if (t.components.exact()) numbers.emplace_back("components", t.components.at_least);
  if (t.euler_characteristic) numbers.emplace_back("euler_characteristic", *t.euler_characteristic);
  if (t.boundary) numbers.emplace_back("boundary_curves", *t.boundary);
  return numbers;
}

Topology of_robots(study::Question question, const TopologyOptions& options, solve::Control& control) {
  if (options.certificate) study::require_exact_constants(question.model, "a certificate of a shape");
  std::vector<std::string> own_ends;
  question = with_common_ranges(std::move(question), own_ends);
  study::Question drawn = question;
  drawn.model = question.model.nominal();
  Topology result = topology_of_one(drawn, study::system(drawn), options, control);
  const System system = study::system(question);
  const auto obstacle = [&](int parts) {
    return obstacle_to_same_strata(system, {}, own_ends, {.threads = options.threads, .parts = parts}, control);
  };
  const auto numbers = [&](const study::Question& one) {
    return exact_numbers(topology_of_one(one, study::system(one), options, control));
  };
  result.robots = examine(question, exact_numbers(result), obstacle, numbers, control);
  return result;
}

}  // namespace

Topology topology_of_one(const study::Question& question, const System& system, const TopologyOptions& options,
                         solve::Control& control) {
  Solved space{system, {}};
  Topology result = found(question, space, options, control);
  if (options.certificate) result.certificate = certificate(result, space, control);
  return result;
}

Topology topology(study::Question question, const TopologyOptions& options, solve::Control& control) {
  question.set = question.model.is_plain_system() ? std::nullopt : std::optional(symbolic::SingularitySet::cspace);
  question.corank = 1;
  question.tolerance = 0;
  Topology result = question.model.toleranced().empty()
                        ? topology_of_one(question, study::system(question), options, control)
                        : of_robots(std::move(question), options, control);
  result.stopped = solve::stopped_by(control);
  return result;
}

}  // namespace corank::analyze
