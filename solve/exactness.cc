#include "corank/solve/exactness.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <boost/functional/hash.hpp>
#include <chrono>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <unordered_map>

#include "corank/certify/domain.h"
#include "corank/certify/exact_verification.h"
#include "corank/certify/isolation.h"
#include "corank/certify/kernel_bound.h"
#include "corank/certify/polynomial_algebra.h"
#include "corank/certify/reduction.h"
#include "corank/certify/refinement.h"
#include "corank/core/rounding.h"
#include "corank/solve/corank_system.h"
#include "corank/solve/cover_edit.h"
#include "corank/solve/exact_guess.h"
#include "corank/solve/points.h"
#include "corank/solve/polish.h"

namespace corank::solve {
namespace {

constexpr int kBits = 512;                     // of the arithmetic of guesses
constexpr int kGuessBits = 220;                // that are right in what it finds, also at double solutions
constexpr int kDegree = 4;                     // of algebraic numbers
constexpr std::uint64_t kFaceBoxes = 200'000;  // to search in one face of a blow-up
constexpr double kSmallSingularValue = 0.2;    // relative to the largest: worth a try
constexpr std::size_t kMostOpenBoxes = 3000;   // beyond, clusters are no longer sought
constexpr int kMostVariables = 150;            // exact points of larger systems take too long
constexpr int kMostFutile = 16;                // attempts, before a kind of point is no longer sought
constexpr int kCoreAttempts = 6;
constexpr double kNextToHull = 3;  // of its width
constexpr int kKernelDepth = 6;    // halvings of a box in which the kernel's dimension is bounded

bool contains(const Box& outer, const Box& inner) {
  for (std::size_t j = 0; j < outer.size(); ++j)
    if (!outer[j].contains(inner[j])) return false;
  return true;
}

std::vector<double> midpoint(const Box& box) {
  std::vector<double> x;
  for (const Interval& side : box) x.push_back(side.mid());
  return x;
}

std::vector<ExactNumber> dyadic(const std::vector<double>& x) {
  std::vector<ExactNumber> result;
  for (const double c : x) result.push_back(ExactNumber::dyadic(c));
  return result;
}

class Prover {
 public:
  /// The options have a control.
  Prover(const System& system, const Options& options, Cover& cover)
      : system_(system), cover_(cover), options_(options), reduction_(*options.reduction) {
    options_.progress = nullptr;
    options_.max_boxes = options_.max_found = options_.max_solutions = 0;
    options_.sigma_length = cover.sigma.length;
    options_.sigma_angle = cover.sigma.angle;
  }

  void points() {
    const InStage stage(control_, Stage::exact);
    const std::unordered_multimap<std::size_t, std::size_t> isolated = isolated_boxes();
    int futile = 0;  // in a row: then the other points are hardly of small degree either
    std::size_t done = 0;
    for (CoverBox& point : cover_.points) {
      control_.report(done++, cover_.points.size());
      if (point.verdict != Verdict::isolated || stopped() || futile >= kMostFutile) continue;
      const std::optional<int> exact = exact_point(point.box);
      futile = exact ? 0 : futile + 1;
      if (!exact) continue;
      point.point = *exact;
      const auto [first, last] = isolated.equal_range(hash(point.box));
      for (auto i = first; i != last; ++i)
        if (CoverBox& box = cover_.boxes[i->second]; box.box == point.box) box.point = *exact;
    }
    std::vector<CoverBox> points;
    done = 0;
    for (CoverBox& point : cover_.points) {
      control_.report(done++, cover_.points.size());
      if (point.verdict == Verdict::undecided && !stopped() && settle(point)) continue;
      points.push_back(std::move(point));
    }
    cover_.points = std::move(points);
    edit_.finish();
    if (system_.kernel_vectors > 1) configurations();
  }

  void coranks() {
    const InStage stage(control_, Stage::exact);
    const certify::KernelMatrix matrix = certify::kernel_matrix(system_);
    if (matrix.rows.empty()) return;
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < cover_.boxes.size(); ++i)
      if (cover_.boxes[i].verdict == Verdict::undecided) open.push_back(i);
    if (open.empty() || open.size() > kMostOpenBoxes) return;
    std::vector<const Box*> open_sides;
    for (const std::size_t i : open) open_sides.push_back(&cover_.boxes[i].box);
    std::vector<std::vector<std::size_t>> groups =
        clusters(open_sides, std::vector<double>(system_.variables.size(), 0.0), ended_);
    int futile = 0;
    std::size_t done = 0;
    for (std::vector<std::size_t>& cluster : groups) {
      control_.report(done++, groups.size());
      if (stopped() || futile >= kMostFutile) break;
      for (std::size_t& i : cluster) i = open[i];
      Box hull = cover_.boxes[cluster[0]].box;
      for (const std::size_t i : cluster)
        for (std::size_t j = 0; j < hull.size(); ++j) hull[j] = Interval::hull(hull[j], cover_.boxes[i].box[j]);
      const std::optional<int> point = corank_point(matrix, hull, system_.kernel_vectors + 1);
      if (!point) {
        ++futile;
        continue;
      }
      search_around(*point, hull, cluster);
    }
    edit_.finish();
  }

  void kernel_dimensions() {
    const InStage stage(control_, Stage::kernel);
    const certify::KernelBound bound(system_);
    if (!bound.applies()) return;
    const std::vector<certify::PointLocation> places(cover_.exact_points.begin(), cover_.exact_points.end());
    const auto bound_in = [&](CoverBox& box) {
      const UpwardRounding rounding;
      if (box.verdict != Verdict::pending && !stopped()) box.corank = bound.at_most(box.box);
    };
    tbb::task_arena arena(options_.threads > 0 ? options_.threads : tbb::this_task_arena::max_concurrency());
    arena.execute(
        [&] { tbb::parallel_for(std::size_t{0}, cover_.boxes.size(), [&](std::size_t i) { bound_in(cover_.boxes[i]); }); });
    if (!cover_.points.empty()) bound_points(bound_in);
    // Few: one after the other, since a point's number is narrowed while it is compared.
    const auto explain = [&](CoverBox& box) {
      const UpwardRounding rounding;
      if (box.corank <= system_.kernel_vectors || stopped()) return;
      for (std::size_t i = 0; i < cover_.exact_points.size() && box.point < 0; ++i)
        if (cover_.exact_points[i].corank >= box.corank && places[i].in(box.box)) box.point = static_cast<int>(i);
      if (box.point < 0) box.corank = bound.at_most(box.box, kKernelDepth);
    };
    for (CoverBox& box : cover_.boxes) explain(box);
    if (!cover_.points.empty()) bound_points(explain);
  }

 private:
  // The gauge of several kernel vectors makes their entries numbers of large degree. The configuration may be one that is
  // found all the same: then the box is known to hold it, and that the kernel has the dimension asked for.
  void configurations() {
    const certify::KernelMatrix matrix = certify::kernel_matrix(system_);
    int futile = 0;
    std::vector<int> found;
    for (const CoverBox& point : cover_.points) {
      if (stopped() || futile >= kMostFutile) break;
      if (point.verdict != Verdict::undecided || point.point >= 0) continue;
      const std::optional<int> exact = corank_point(matrix, point.box, system_.kernel_vectors);
      futile = exact ? 0 : futile + 1;
      if (exact && std::find(found.begin(), found.end(), *exact) == found.end()) found.push_back(*exact);
    }
    for (const int index : found) {
      const certify::PointLocation place(cover_.exact_points[static_cast<std::size_t>(index)]);
      for (std::vector<CoverBox>* list : {&cover_.boxes, &cover_.points})
        for (CoverBox& box : *list)
          if (box.verdict == Verdict::undecided && box.point < 0 && place.in(box.box)) box.point = index;
    }
  }

  // Proves an undecided cluster. True: it holds nothing but the solution of another box.
  bool settle(CoverBox& cluster) {
    const std::optional<int> exact = exact_point(cluster.box);
    if (!exact || !is_only_solution(*exact, cluster.box)) return false;
    const auto same = [&](const CoverBox& b) {  // known as an isolated one, or from the cluster next to this
      return (b.verdict == Verdict::isolated || b.verdict == Verdict::exact) && b.point == *exact;
    };
    const auto known = std::find_if(cover_.boxes.begin(), cover_.boxes.end(), same);
    const bool is_known = known != cover_.boxes.end();
    const int by = static_cast<int>(known - cover_.boxes.begin());
    for (std::size_t i = 0; i < cover_.boxes.size(); ++i)
      if (cover_.boxes[i].verdict == Verdict::undecided && contains(cluster.box, cover_.boxes[i].box))
        edit_.replace(static_cast<int>(i), by);
    if (is_known) return true;
    cluster.verdict = Verdict::exact;
    cluster.point = *exact;
    cover_.boxes.push_back(cluster);
    return false;
  }

  bool stopped() const { return control_.ended(); }

  // What is said of a box is said of the point that it is; `say` of the other points, which are hulls of boxes.
  template <class Say>
  void bound_points(Say say) {
    std::unordered_multimap<std::size_t, std::size_t> places;
    for (std::size_t i = 0; i < cover_.boxes.size(); ++i) places.emplace(hash(cover_.boxes[i].box), i);
    for (CoverBox& point : cover_.points) {
      const auto [first, last] = places.equal_range(hash(point.box));
      const auto same = std::find_if(first, last, [&](const auto& at) { return cover_.boxes[at.second].box == point.box; });
      if (same == last) {
        say(point);
      } else {
        point.corank = cover_.boxes[same->second].corank;
        point.point = cover_.boxes[same->second].point;
      }
    }
  }

  // Isolated boxes by their sides.
  static std::size_t hash(const Box& box) {
    std::size_t seed = 0;
    for (const Interval& side : box) {
      boost::hash_combine(seed, side.lo());
      boost::hash_combine(seed, side.hi());
    }
    return seed;
  }
  std::unordered_multimap<std::size_t, std::size_t> isolated_boxes() const {
    std::unordered_multimap<std::size_t, std::size_t> result;
    for (std::size_t i = 0; i < cover_.boxes.size(); ++i)
      if (cover_.boxes[i].verdict == Verdict::isolated) result.emplace(hash(cover_.boxes[i].box), i);
    return result;
  }

  int add(ExactPoint point) {
    const auto same = [&](const ExactPoint& p) {  // whatever is known of what lies around it
      point.sole_within = p.sole_within;
      return p == point;
    };
    const auto known = std::find_if(cover_.exact_points.begin(), cover_.exact_points.end(), same);
    point.sole_within = 0;
    if (known != cover_.exact_points.end()) return static_cast<int>(known - cover_.exact_points.begin());
    cover_.exact_points.push_back(std::move(point));
    return static_cast<int>(cover_.exact_points.size()) - 1;
  }

  // A verified solution in the box.
  std::optional<int> exact_point(const Box& box) {
    const std::vector<double> start = polish(system_, box, ended_).value_or(midpoint(box));
    const auto zero = certify::approximate_zero(system_, dyadic(start), kBits, ended_);
    if (!zero) return std::nullopt;
    auto point = guess_exactly({zero->begin(), zero->end()}, kGuessBits, kDegree, ended_);
    if (!point) return std::nullopt;
    const certify::ExactVerification verified = certify::verify_exactly(system_, *point, ended_);
    if (!verified.holds || !certify::lies_in(*point, box)) return std::nullopt;
    point->corank = verified.corank;
    return add(std::move(*point));
  }

  bool is_only_solution(int index, const Box& box) {
    ExactPoint& point = cover_.exact_points[static_cast<std::size_t>(index)];
    if (certify::holds_nothing_else(point, box)) return true;
    // A power of two that is large enough: a double as well as a rational number.
    double radius = std::ldexp(1.0, -60);
    const ExactNumber needed = certify::reach(point, box);
    while ((ExactNumber::dyadic(radius) - needed).sign() != 1) radius *= 2;
    const auto faces = certify::blow_up(system_, point, ExactNumber::dyadic(radius), ended_);
    if (!faces) return false;
    Options options;
    options.threads = options_.threads;
    options.control = &control_;
    options.max_boxes = kFaceBoxes;
    try {
      for (const System& face : *faces) {
        const Cover solutions = solve(face, options);
        if (!solutions.complete() || !solutions.boxes.empty()) return false;
      }
    } catch (const std::invalid_argument&) {  // elimination has made coefficients that no double holds
      return false;
    }
    point.sole_within = radius;
    return certify::holds_nothing_else(point, box);
  }

  // A verified configuration in or next to the box where the kernel has that dimension at least.
  std::optional<int> corank_point(const certify::KernelMatrix& matrix, const Box& hull, int least) {
    const std::vector<double> x = midpoint(hull);
    const std::vector<double> s = singular_values(matrix, x);
    const int k = static_cast<int>(s.size());
    for (int c = least; c <= k && s[static_cast<std::size_t>(k - c)] < kSmallSingularValue * s[0]; ++c) {
      const CorankSystem extended = corank_system(system_, matrix, x, c);
      const auto zero = certify::approximate_zero(extended.system, dyadic(extended.start), kBits, ended_);
      if (!zero) continue;
      std::vector<std::optional<ExactNumber>> coordinates(x.size());
      for (std::size_t j = 0; j < extended.configuration.size(); ++j)
        coordinates[static_cast<std::size_t>(extended.configuration[j])] = (*zero)[j];
      auto point = guess_exactly(coordinates, kGuessBits, kDegree, ended_);
      if (!point) continue;
      const certify::ExactVerification verified = certify::verify_exactly(system_, *point, ended_);
      if (!verified.holds || verified.corank < least) continue;
      point->corank = verified.corank;
      // Next to the boxes: no farther than they are wide together.
      const ExactNumber far = certify::reach(*point, hull);
      if ((far - ExactNumber::dyadic(kNextToHull * width_of(*point, hull))).sign() == 1) continue;
      return add(std::move(*point));
    }
    return std::nullopt;
  }

  // The widest side of the hull in the coordinates that the point has.
  static double width_of(const ExactPoint& point, const Box& hull) {
    double width = 0;
    for (std::size_t j = 0; j < hull.size(); ++j)
      if (!point.coordinates[j].empty()) width = std::max(width, hull[j].width());
    return width;
  }

  // The search again, in the hull without a core about the point's known coordinates; then the core itself. Nothing changes
  // where even large cores leave boxes undecided around them.
  void search_around(int index, const Box& hull, const std::vector<std::size_t>& cluster) {
    const ExactPoint& point = cover_.exact_points[static_cast<std::size_t>(index)];
    double half = 0.25 * width_of(point, hull);
    for (int attempt = 0; attempt < kCoreAttempts; ++attempt, half *= 2) {
      Box core = hull, all = hull;
      const certify::AlgebraicNumber t(point.polynomial, point.lower, point.upper);
      for (const int kept : reduction_.kept) {
        const std::size_t j = static_cast<std::size_t>(kept);
        if (point.coordinates[j].empty()) continue;
        const auto bounds = t.bounds(point.coordinates[j], ExactNumber::dyadic(half / 64));
        core[j] = Interval(bounds.lower.enclose().lo() - half, bounds.upper.enclose().hi() + half);
        all[j] = Interval::hull(hull[j], core[j]);
      }
      Options options = options_;
      const Partition partition = difference(all, core);
      if (partition.parts.empty()) return;
      options.roots = partition.parts;
      Cover around = solve(system_, options);
      cover_.statistics.processed += around.statistics.processed;
      cover_.statistics.newton_steps += around.statistics.newton_steps;
      cover_.statistics.proofs_tried += around.statistics.proofs_tried;
      if (!around.complete()) return;
      if (around.count(Verdict::undecided) > 0) continue;
      core = with_values(core);
      if (!certify::lies_in(point, core)) return;
      if (cover_.proof && !around.proof) return;
      CoverBox middle{std::move(core), Verdict::undecided, {}};
      middle.point = index;
      middle.reason = Reason::degenerate_point;
      edit_.replace(cluster, partition, std::move(around), std::move(middle));
      return;
    }
  }

  // The box with the sides of eliminated variables that those of the others imply.
  Box with_values(const Box& box) const {
    const UpwardRounding rounding;
    Box sides;
    for (const int j : reduction_.kept) sides.push_back(box[static_cast<std::size_t>(j)]);
    const Box kept = sides;
    for (const auto& definition : reduction_.definitions) sides.push_back(certify::evaluate(definition.value, kept));
    Box result = reduction_.lift(sides);
    certify::clip_to_domain(system_, result);
    return result;
  }

  // What `all` is beside the core. No parts where it misses the domain.
  Partition difference(Box all, const Box& core) const {
    Partition partition;
    partition.whole = all;
    for (std::size_t k = 0; k < reduction_.kept.size(); ++k) {
      const std::size_t j = static_cast<std::size_t>(reduction_.kept[k]);
      Interval side = all[j], inner = core[j];
      if (!side.intersect(reduction_.system.variables[k].domain) || !inner.intersect(side)) return {};
      if (side.lo() < inner.lo()) {
        partition.parts.push_back(all);
        partition.parts.back()[j] = Interval(side.lo(), inner.lo());
        partition.splits.push_back({static_cast<int>(k), inner.lo(), true});
      }
      if (inner.hi() < side.hi()) {
        partition.parts.push_back(all);
        partition.parts.back()[j] = Interval(inner.hi(), side.hi());
        partition.splits.push_back({static_cast<int>(k), inner.hi(), false});
      }
      all[j] = inner;
    }
    return partition;
  }

  const System& system_;
  Cover& cover_;
  Options options_;
  Control& control_ = *options_.control;
  const Ended ended_ = [this] { return control_.ended(); };
  const certify::Reduction& reduction_;  // what solve() searches
  CoverEdit edit_{cover_, reduction_};
};

}  // namespace

void prove_exactly(const System& system, const Options& given, Cover& cover) {
  if (system.coefficient_tolerance > 0) return;
  Options options = given;
  std::optional<Control> control;
  if (!options.control) {
    Control::Limits limits = limits_of(given);
    constexpr double kLeast = 1e-9;  // 0 is no limit
    if (limits.time > 0) limits.time = std::max(kLeast, limits.time - cover.statistics.seconds_total);
    control.emplace(limits);
    control->count_boxes(cover.statistics.processed);
    options.control = &*control;
  }
  std::optional<certify::Reduction> reduction;
  if (!options.reduction) {
    const InStage stage(*options.control, Stage::reduction);
    options.reduction = &reduction.emplace(certify::reduce(system, [&options] { return options.control->ended(); }));
  }
  if (options.control->ended()) return;  // the reduction may not be the search's
  const auto start = std::chrono::steady_clock::now();
  Prover prover(system, options, cover);
  if (system.size() <= kMostVariables) {
    if (cover.dimension == 0) {
      prover.points();
    } else if (cover.complete()) {
      prover.coranks();
    }
  }
  prover.kernel_dimensions();
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  cover.statistics.seconds_total += seconds;
  cover.statistics.seconds_certify += seconds;
}

}  // namespace corank::solve
