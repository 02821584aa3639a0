#include "corank/solve/exactness/exactness.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <unordered_map>
#include <utility>

#include "corank/certify/algebraic_number.h"
#include "corank/certify/blow_up.h"
#include "corank/certify/distinct.h"
#include "corank/certify/domain.h"
#include "corank/certify/exact_verification.h"
#include "corank/certify/polynomial_algebra.h"
#include "corank/certify/reduction.h"
#include "corank/certify/refinement.h"
#include "corank/core/box.h"
#include "corank/core/rounding.h"
#include "corank/solve/exactness/exact_points.h"
#include "corank/solve/search/box_labels.h"
#include "corank/solve/search/cover_edit.h"
#include "corank/solve/search/solve.h"
#include "corank/solve/step/box_order.h"
#include "corank/solve/step/points.h"
#include "corank/solve/store/memory.h"

namespace corank::solve {
namespace {

constexpr std::uint64_t kFaceBoxes = 200'000;  // to search in one face of a blow-up
constexpr std::size_t kMostOpenBoxes = 3000;   // beyond, clusters are no longer sought
constexpr int kMostVariables = 150;            // exact points of larger systems take too long
constexpr int kMostFutile = 16;                // attempts, before a kind of point is no longer sought
constexpr int kCoreAttempts = 6;
constexpr std::uint64_t kSearchedAgain = 20'000;  // boxes, or half of the search's: what lies around points is worth no more

class Prover {
 public:
  Prover(const Prepared& prepared, Cover& cover, Control& control) : prepared_(prepared), cover_(cover), control_(control) {}

  void points() {
    const InStage stage(control_, Stage::exact);
    const std::unordered_multimap<std::size_t, std::size_t> isolated = isolated_boxes();
    int futile = 0;  // in a row: then the other points are hardly of small degree either
    std::size_t done = 0;
    for (CoverBox& point : cover_.points) {
      control_.report(done++, cover_.points.size());
      if (point.verdict != Verdict::isolated || stopped() || futile >= kMostFutile) continue;
      const std::optional<int> exact = exact_.solution_in(point.box);
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
    const PolynomialMatrix matrix = certify::kernel_matrix(system_);
    if (matrix.rows == 0) return;
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < cover_.boxes.size(); ++i)
      if (cover_.boxes[i].verdict == Verdict::undecided) open.push_back(i);
    const std::uint64_t before = cover_.statistics.processed, most = before + std::max(kSearchedAgain, before / 2);
    for_each_larger_kernel(matrix, open, [&](int point, const Box& hull, const std::vector<std::size_t>& cluster) {
      search_around(point, hull, cluster);
      return cover_.statistics.processed <= most;
    });
    edit_.finish();
  }

  // An equation in place of the kernel vector leaves no box undecided where the kernel is larger: the bound on its dimension
  // says where that may be.
  void coranks_of_part() {
    const InStage stage(control_, Stage::exact);
    const auto is_open = [&](const CoverBox& box) { return box.kernel_at_most > system_.kernel_vectors && box.point < 0; };
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < cover_.boxes.size(); ++i)
      if (is_open(cover_.boxes[i])) open.push_back(i);
    for_each_larger_kernel(*system_.singular, open, [&](int point, const Box&, const std::vector<std::size_t>& cluster) {
      const certify::PointLocation place(cover_.exact_points[point]);
      for (const std::size_t i : cluster)
        if (CoverBox& box = cover_.boxes[i]; cover_.exact_points[point].corank >= box.kernel_at_most && place.in(box.box))
          box.point = point;
      return true;
    });
  }

 private:
  // In groups of these boxes that touch: visit(its place, the group's hull, the group) where an exact point is found. Until
  // that says no.
  template <class Visit>
  void for_each_larger_kernel(const PolynomialMatrix& matrix, const std::vector<std::size_t>& open, const Visit& visit) {
    if (open.empty() || open.size() > kMostOpenBoxes) return;
    std::vector<const Box*> open_sides;
    for (const std::size_t i : open) open_sides.push_back(&cover_.boxes[i].box);
    std::vector<std::vector<std::size_t>> groups =
        clusters(open_sides, std::vector<double>(system_.variables.size(), 0.0), ended_);
    int futile = 0;
    std::size_t done = 0;
    for (std::vector<std::size_t>& cluster : groups) {
      control_.report(done++, groups.size());
      if (stopped() || futile >= kMostFutile) return;
      for (std::size_t& i : cluster) i = open[i];
      Box hull = cover_.boxes[cluster[0]].box;
      for (const std::size_t i : cluster) include(hull, cover_.boxes[i].box);
      const std::optional<int> point = exact_.with_kernel(matrix, hull, system_.kernel_vectors + 1);
      if (!point) {
        ++futile;
      } else if (!visit(*point, hull, cluster)) {
        return;
      }
    }
  }

  // The gauge of several kernel vectors makes their entries numbers of large degree. The configuration may be one that is
  // found all the same: then the box is known to hold it, and that the kernel has the dimension asked for.
  void configurations() {
    const PolynomialMatrix matrix = certify::kernel_matrix(system_);
    int futile = 0;
    std::vector<int> found;
    for (const CoverBox& point : cover_.points) {
      if (stopped() || futile >= kMostFutile) break;
      if (point.verdict != Verdict::undecided || point.point >= 0) continue;
      const std::optional<int> exact = exact_.with_kernel(matrix, point.box, system_.kernel_vectors);
      futile = exact ? 0 : futile + 1;
      if (exact && std::ranges::find(found, *exact) == found.end()) found.push_back(*exact);
    }
    for (const int index : found) {
      const certify::PointLocation place(cover_.exact_points[index]);
      for (std::vector<CoverBox>* list : {&cover_.boxes, &cover_.points})
        for (CoverBox& box : *list)
          if (box.verdict == Verdict::undecided && box.point < 0 && place.in(box.box)) box.point = index;
    }
  }

  // Proves an undecided cluster. True: it holds nothing but the solution of another box.
  bool settle(CoverBox& cluster) {
    const std::optional<int> exact = exact_.solution_in(cluster.box);
    if (!exact || !is_only_solution(*exact, cluster.box)) return false;
    const auto same = [&](const CoverBox& b) {  // known as an isolated one, or from the cluster next to this
      return (b.verdict == Verdict::isolated || b.verdict == Verdict::exact) && b.point == *exact;
    };
    const auto known = std::ranges::find_if(cover_.boxes, same);
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

  std::unordered_multimap<std::size_t, std::size_t> isolated_boxes() const {
    std::unordered_multimap<std::size_t, std::size_t> result;
    for (std::size_t i = 0; i < cover_.boxes.size(); ++i)
      if (cover_.boxes[i].verdict == Verdict::isolated) result.emplace(hash(cover_.boxes[i].box), i);
    return result;
  }

  bool is_only_solution(int index, const Box& box) {
    ExactPoint& point = cover_.exact_points[index];
    if (certify::holds_nothing_else(point, box)) return true;
    // A power of two that is large enough: a double as well as a rational number.
    double radius = std::ldexp(1.0, -60);
    const ExactNumber needed = certify::reach(point, box);
    while ((ExactNumber::dyadic(radius) - needed).sign() != 1) radius *= 2;
    const auto faces = certify::blow_up(system_, point, ExactNumber::dyadic(radius), ended_);
    if (!faces) return false;
    // Whether there is any box is asked, not how many.
    try {
      for (const System& face : *faces) {
        const Options options{.sigma = kWhole, .threads = prepared_.options.threads};
        const Cover solutions = solve(prepare(face, options, control_), control_, kFaceBoxes);
        if (!solutions.complete() || !solutions.boxes.empty()) return false;
      }
    } catch (const std::invalid_argument&) {  // elimination has made coefficients that no double holds
      return false;
    }
    point.sole_within = radius;
    return certify::holds_nothing_else(point, box);
  }

  // The search again, in the hull without a core about the point's known coordinates; then the core itself. Nothing changes
  // where even large cores leave boxes undecided around them.
  void search_around(int index, const Box& hull, const std::vector<std::size_t>& cluster) {
    const ExactPoint& point = cover_.exact_points[index];
    double half = 0.25 * width_of(point, hull);
    for (int attempt = 0; attempt < kCoreAttempts; ++attempt, half *= 2) {
      Box core = hull, all = hull;
      const certify::AlgebraicNumber t(point.polynomial, point.lower, point.upper);
      for (const int kept : reduction_.kept) {
        const std::size_t j = kept;
        if (point.coordinates[j].empty()) continue;
        const auto bounds = t.bounds(point.coordinates[j], ExactNumber::dyadic(half / 64));
        core[j] = Interval(bounds.lower.enclose().lo() - half, bounds.upper.enclose().hi() + half);
        all[j] = Interval::hull(hull[j], core[j]);
      }
      const Partition partition = difference(all, core);
      if (partition.parts.empty()) return;
      Prepared parts = prepared_;
      parts.options.roots = partition.parts;
      parts.options.max_found = parts.options.max_solutions = 0;
      parts.options.sigma_length = cover_.sigma.length;
      parts.options.sigma_angle = cover_.sigma.angle;
      Cover around = solve(parts, control_);
      cover_.statistics.processed += around.statistics.processed;
      cover_.statistics.newton_steps += around.statistics.newton_steps;
      cover_.statistics.proofs_tried += around.statistics.proofs_tried;
      if (!around.complete()) return;
      if (around.count(Verdict::undecided) > 0) continue;
      core = with_values(core);
      if (!certify::PointLocation(point).in(core)) return;
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
    for (const int j : reduction_.kept) sides.push_back(box[j]);
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
      const std::size_t j = reduction_.kept[k];
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

  const Prepared& prepared_;
  const System& system_ = prepared_.system;
  const certify::Reduction& reduction_ = prepared_.reduction;
  Cover& cover_;
  Control& control_;
  const Ended ended_ = [this] { return control_.ended(); };
  ExactPoints exact_{system_, cover_, control_};
  CoverEdit edit_{cover_, reduction_};
};

}  // namespace

void prove_exactly(const System& system, const Options& options, Cover& cover) {
  Control control(limits_of(options));
  prove_exactly(prepare(system, options, control), cover, control);
}

void prove_exactly(const Prepared& prepared, Cover& cover, Control& control) {
  if (prepared.system.coefficient_tolerance > 0) return;
  if (control.ended()) return;  // the reduction may not be the search's
  const auto start = std::chrono::steady_clock::now();
  // With parameters a point would be one robot's.
  const bool has_points = prepared.system.size() <= kMostVariables && prepared.system.parameters() == 0;
  if (has_points) {
    Prover prover(prepared, cover, control);
    // Its searches are a part of this stage, and say nothing of themselves.
    const auto progress = std::exchange(control.search_progress, nullptr);
    if (cover.dimension == 0) {
      prover.points();
    } else if (cover.complete()) {
      prover.coranks();
    }
    control.search_progress = progress;
  }
  bound_kernel_dimensions(prepared, cover, control);
  if (has_points && cover.dimension > 0 && prepared.system.singular) Prover(prepared, cover, control).coranks_of_part();
  prove_passages(prepared, cover, control);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  cover.statistics.seconds_total += seconds;
  cover.statistics.seconds_certify += seconds;
}

void settle(const Prepared& prepared, const Settling& settling, Cover& cover, Control& control) {
  cover.statistics.processed += settling.processed_before;
  control.keep(static_cast<std::int64_t>(bytes_of(cover, control.limits().later_bytes)));
  prove_exactly(prepared, cover, control);
  if (settling.labelling) label_types(prepared, *settling.labelling, cover, control);
  if (settling.digits > 0 && cover.dimension == 0) prove_decimals(prepared, settling.digits, cover, control);
}

void prove_decimals(const Prepared& prepared, int digits, Cover& cover, Control& control) {
  constexpr int kMostBits = 8192;
  const InStage stage(control, Stage::decimals);
  const Ended ended = [&control] { return control.ended(); };
  cover.decimals.clear();
  if (prepared.system.parameters() > 0) return;
  const certify::Reduction& reduction = prepared.reduction;
  for (const CoverBox& point : cover.points) {
    control.report(cover.decimals.size(), cover.points.size());
    std::vector<std::string>& decimals = cover.decimals.emplace_back();
    if (point.verdict == Verdict::undecided || control.ended()) continue;
    if (point.point >= 0) {
      const ExactPoint& exact = cover.exact_points[point.point];
      const certify::AlgebraicNumber t(exact.polynomial, exact.lower, exact.upper);
      const ExactNumber width = pow(ExactNumber(10), -digits - 2);
      for (const auto& x : exact.coordinates) {
        const auto bounds = t.bounds(x, width);
        decimals.push_back(certify::proven_decimal(bounds.lower, bounds.upper, digits));
      }
    } else if (point.verdict == Verdict::isolated) {
      std::vector<ExactNumber> start;
      for (const int j : reduction.kept) start.push_back(ExactNumber::dyadic(point.box[j].mid()));
      const auto zero = certify::prove_zero(reduction.system, start, digits + 2, kMostBits, ended);
      const Box& region = point.region >= 0 ? cover.regions[point.region] : point.box;
      if (!zero || !certify::is_solution_of_region(*zero, reduction, region)) continue;
      decimals.resize(prepared.system.variables.size());
      for (std::size_t j = 0; j < reduction.kept.size(); ++j)
        decimals[reduction.kept[j]] = certify::proven_decimal(zero->sides[j].first, zero->sides[j].second, digits);
      for (const auto& definition : reduction.definitions) {
        const auto value = certify::bounds(definition.value, zero->sides, zero->bits);
        decimals[definition.variable] = certify::proven_decimal(value.first, value.second, digits);
      }
    }
  }
}

}  // namespace corank::solve
