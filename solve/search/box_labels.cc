#include "corank/solve/search/box_labels.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <chrono>

#include "corank/certify/kernel_bound.h"
#include "corank/certify/passage.h"
#include "corank/certify/type_bounds.h"
#include "corank/core/box.h"
#include "corank/core/rounding.h"
#include "corank/core/threads.h"
#include "corank/solve/step/box_order.h"

namespace corank::solve {
namespace {

constexpr int kKernelDepth = 6;  // halvings of a box in which the kernel's dimension is bounded

// What is said of a box is said of the point that it is; `say` of the other points, which are hulls of boxes.
template <class Say>
void say_of_points(Cover& cover, Say say) {
  std::unordered_multimap<std::size_t, std::size_t> places;
  for (std::size_t i = 0; i < cover.boxes.size(); ++i) places.emplace(hash(cover.boxes[i].box), i);
  for (CoverBox& point : cover.points) {
    const auto [first, last] = places.equal_range(hash(point.box));
    const auto same = std::find_if(first, last, [&](const auto& at) { return cover.boxes[at.second].box == point.box; });
    if (same == last) {
      say(point);
    } else {
      point.kernel_at_most = cover.boxes[same->second].kernel_at_most;
      point.point = cover.boxes[same->second].point;
    }
  }
}

constexpr int kDepth = 4;        // halvings of a box in which not all was settled
constexpr int kRegionDepth = 6;  // of a region's boxes at once, which is wide; less where they are few
constexpr int kSmall = 12;       // rows of L

// Is the box's only solution the exact point that it names?
bool is_its_point(const CoverBox& box, const Cover& cover) {
  if (box.point < 0 || (box.verdict != Verdict::exact && box.verdict != Verdict::isolated)) return false;
  const auto& coordinates = cover.exact_points[box.point].coordinates;
  return std::ranges::none_of(coordinates, [](const RationalPolynomial& x) { return x.empty(); });
}

// Of each of Cover::regions the hull of the boxes that were cut from it, where there are two or more, else an empty box:
// what is shown all over it holds in each of them.
std::vector<Box> hulls_by_region(const Cover& cover) {
  std::vector<Box> hulls(cover.regions.size());
  std::vector<int> pieces(cover.regions.size(), 0);
  for (const CoverBox& box : cover.boxes)
    if (box.region >= 0) ++pieces[box.region];
  for (const CoverBox& box : cover.boxes) {
    if (box.region < 0 || pieces[box.region] < 2) continue;
    Box& hull = hulls[box.region];
    if (hull.empty()) hull = box.box;
    include(hull, box.box);
  }
  return hulls;
}

// label(box, what `bound` says of its region) for every box, on all threads; Known{} where nothing is said. What is shown
// all over the boxes that were cut from a region is shown in each: most need no look of their own.
template <class Known, class Bound, class Label>
void label_by_region(ThreadArena& arena, Cover& cover, const Ended& stopped, Bound bound, Label label) {
  std::vector<Box> hulls = hulls_by_region(cover);
  std::vector<Known> of_regions(hulls.size());
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, hulls.size(), [&](std::size_t r) {
      const UpwardRounding rounding;
      if (!hulls[r].empty() && !stopped()) of_regions[r] = bound(hulls[r]);
    });
    hulls = {};
    tbb::parallel_for(std::size_t{0}, cover.boxes.size(), [&](std::size_t i) {
      CoverBox& box = cover.boxes[i];
      label(box, box.region < 0 ? Known{} : of_regions[box.region]);
    });
  });
}

void add_labels(const Prepared& prepared, const VelocityBlocks& blocks, Cover& cover, Control& control) {
  const System& system = prepared.system;
  if (system.coefficient_tolerance > 0) return;
  const InStage stage(control, Stage::kernel);
  const auto start = std::chrono::steady_clock::now();
  cover.types = {blocks.asked, blocks.of_set, 0};
  const certify::TypeBounds bounds(system, blocks);
  const auto stopped = [&control] { return control.ended(); };
  for (ExactPoint& point : cover.exact_points) {
    const UpwardRounding rounding;
    point.types = bounds.at(point, stopped);
  }
  const std::size_t shared = cover.regions.empty() ? 0 : cover.boxes.size() / cover.regions.size();
  const int depth = std::min(kRegionDepth, static_cast<int>(std::bit_width(shared)));
  // Where L is large a rank takes longer than the search takes for a box: then only the types that make up the set.
  const TypeSet wanted = blocks.matrices[static_cast<std::size_t>(Block::all)].rows > kSmall ? blocks.of_set : blocks.asked;
  const auto label = [&](CoverBox& box, certify::RankBounds known) {
    const UpwardRounding rounding;
    if (box.verdict == Verdict::pending || stopped()) return;
    if (is_its_point(box, cover)) box.types = cover.exact_points[box.point].types;
    if (box.types != TypeLabels{}) return;
    box.types = bounds.labels(known);
    if (!box.types.settle(wanted)) box.types = bounds.labels(known = bounds.ranks(box.box, 0, known, wanted));
    if (!box.types.settle(blocks.of_set)) box.types = bounds.labels(bounds.ranks(box.box, kDepth, known, wanted));
  };
  ThreadArena arena(prepared.options.threads);
  label_by_region<certify::RankBounds>(
      arena, cover, stopped, [&](const Box& hull) { return bounds.ranks(hull, depth, {}, wanted); }, label);
  // A point may be the hull of several boxes, which no region holds.
  arena.execute(
      [&] { tbb::parallel_for(std::size_t{0}, cover.points.size(), [&](std::size_t i) { label(cover.points[i], {}); }); });
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  cover.statistics.seconds_total += seconds;
  cover.statistics.seconds_certify += seconds;
}

void keep_only(SingularityType type, Cover& cover) {
  const auto excluded = [type](const CoverBox& box) { return (box.types.excluded & bit(type)) != 0; };
  cover.types.left_out = std::erase_if(cover.boxes, excluded);
  std::erase_if(cover.points, excluded);
  if (cover.types.left_out == 0) return;
  std::erase_if(cover.points, [&](const CoverBox& point) {  // clusters of which no box is left
    return point.verdict == Verdict::undecided &&
           std::ranges::none_of(cover.boxes, [&](const CoverBox& box) { return contains(point.box, box.box); });
  });
  cover.proof.reset();
  std::vector<int> place(cover.regions.size(), -1);
  std::vector<Box> regions;
  for (CoverBox& box : cover.boxes)
    if (box.region >= 0 && place[box.region] < 0) {
      place[box.region] = static_cast<int>(regions.size());
      regions.push_back(std::move(cover.regions[box.region]));
    }
  for (std::vector<CoverBox>* list : {&cover.boxes, &cover.points})
    for (CoverBox& box : *list)
      if (box.region >= 0) box.region = place[box.region];
  cover.regions = std::move(regions);
}

}  // namespace

void label_types(const Prepared& prepared, const Labelling& labelling, Cover& cover, Control& control) {
  add_labels(prepared, labelling.blocks, cover, control);
  if (labelling.only) keep_only(*labelling.only, cover);
}

void bound_kernel_dimensions(const Prepared& prepared, Cover& cover, Control& control) {
  const InStage stage(control, Stage::kernel);
  const System& system = prepared.system;
  const auto stopped = [&control] { return control.ended(); };
  const certify::KernelBound bound(system);
  if (!bound.applies()) return;
  const std::vector<certify::PointLocation> places(cover.exact_points.begin(), cover.exact_points.end());
  const auto bound_in = [&](CoverBox& box, int known) {  // 0: not known
    const UpwardRounding rounding;
    if (box.verdict == Verdict::pending || stopped()) return;
    box.kernel_at_most = known > 0 && known <= system.kernel_vectors ? known : bound.at_most(box.box);
  };
  ThreadArena arena(prepared.options.threads);
  label_by_region<int>(
      arena, cover, stopped, [&](const Box& hull) { return bound.at_most(hull); }, bound_in);
  // Hulls of boxes are held by no region.
  if (!cover.points.empty()) say_of_points(cover, [&](CoverBox& point) { bound_in(point, 0); });
  // Few: one after the other, since a point's number is narrowed while it is compared.
  const auto explain = [&](CoverBox& box) {
    const UpwardRounding rounding;
    if (box.kernel_at_most <= system.kernel_vectors || stopped()) return;
    for (std::size_t i = 0; i < cover.exact_points.size() && box.point < 0; ++i)
      if (cover.exact_points[i].corank >= box.kernel_at_most && places[i].in(box.box)) box.point = static_cast<int>(i);
    if (box.point < 0) box.kernel_at_most = bound.at_most(box.box, kKernelDepth);
  };
  for (CoverBox& box : cover.boxes) explain(box);
  if (!cover.points.empty()) say_of_points(cover, explain);
}

void prove_passages(const Prepared& prepared, Cover& cover, Control& control) {
  constexpr int kHalvings = 6;  // of a box, one after the other
  if (!prepared.system.passage) return;
  const InStage stage(control, Stage::kernel);
  const certify::PassageTest test(prepared.system);
  if (!test.applies()) return;
  ThreadArena arena(prepared.options.threads);
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, cover.boxes.size(), [&](std::size_t i) {
      CoverBox& box = cover.boxes[i];
      if (box.verdict == Verdict::pending || control.ended()) return;
      const UpwardRounding rounding;
      certify::PassageTest::Finding found = test.of(box.box, kHalvings);
      box.passage = found.passage;
      box.side = std::move(found.side);
    });
  });
}

}  // namespace corank::solve
