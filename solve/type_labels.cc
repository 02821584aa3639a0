#include "corank/solve/type_labels.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <chrono>

#include "corank/certify/type_bounds.h"
#include "corank/core/box.h"
#include "corank/core/rounding.h"
#include "corank/core/threads.h"
#include "corank/solve/region_hulls.h"

namespace corank::solve {
namespace {

constexpr int kDepth = 4;        // halvings of a box in which not all was settled
constexpr int kRegionDepth = 6;  // of a region's boxes at once, which is wide; less where they are few

constexpr int kSmall = 12;  // rows of L

// Is the box's only solution the exact point that it names?
bool is_its_point(const CoverBox& box, const Cover& cover) {
  if (box.point < 0 || (box.verdict != Verdict::exact && box.verdict != Verdict::isolated)) return false;
  const auto& coordinates = cover.exact_points[static_cast<std::size_t>(box.point)].coordinates;
  return std::none_of(coordinates.begin(), coordinates.end(), [](const RationalPolynomial& x) { return x.empty(); });
}

}  // namespace

void label_types(const Prepared& prepared, const VelocityBlocks& blocks, Cover& cover, Control& control) {
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
  // A rank that is shown all over the boxes that were cut from a region is shown in each: most need no look of their own.
  std::vector<Box> hulls = hulls_by_region(cover);
  const std::size_t shared = cover.regions.empty() ? 0 : cover.boxes.size() / cover.regions.size();
  const int depth = std::min(kRegionDepth, static_cast<int>(std::bit_width(shared)));
  // Where L is large a rank takes longer than the search takes for a box: then only the types that make up the set.
  const TypeSet wanted = blocks.matrices[static_cast<std::size_t>(Block::all)].rows > kSmall ? blocks.of_set : blocks.asked;
  std::vector<certify::RankBounds> of_regions(cover.regions.size());
  const auto label = [&](CoverBox& box, certify::RankBounds known) {
    const UpwardRounding rounding;
    if (box.verdict == Verdict::pending || stopped()) return;
    if (is_its_point(box, cover)) box.types = cover.exact_points[static_cast<std::size_t>(box.point)].types;
    if (box.types != TypeLabels{}) return;
    box.types = bounds.labels(known);
    if (!box.types.settle(wanted)) box.types = bounds.labels(known = bounds.ranks(box.box, 0, known, wanted));
    if (!box.types.settle(blocks.of_set)) box.types = bounds.labels(bounds.ranks(box.box, kDepth, known, wanted));
  };
  ThreadArena arena(prepared.options.threads);
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, hulls.size(), [&](std::size_t r) {
      const UpwardRounding rounding;
      if (!hulls[r].empty() && !stopped()) of_regions[r] = bounds.ranks(hulls[r], depth, {}, wanted);
    });
    hulls = {};
    tbb::parallel_for(std::size_t{0}, cover.boxes.size(), [&](std::size_t i) {
      CoverBox& box = cover.boxes[i];
      label(box, box.region < 0 ? certify::RankBounds{} : of_regions[static_cast<std::size_t>(box.region)]);
    });
    // A point may be the hull of several boxes, which no region holds.
    tbb::parallel_for(std::size_t{0}, cover.points.size(), [&](std::size_t i) { label(cover.points[i], {}); });
  });
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  cover.statistics.seconds_total += seconds;
  cover.statistics.seconds_certify += seconds;
}

void keep_only(SingularityType type, Cover& cover) {
  const auto excluded = [type](const CoverBox& box) { return (box.types.excluded & bit(type)) != 0; };
  cover.types.left_out = static_cast<std::size_t>(std::count_if(cover.boxes.begin(), cover.boxes.end(), excluded));
  std::erase_if(cover.boxes, excluded);
  std::erase_if(cover.points, excluded);
  if (cover.types.left_out == 0) return;
  std::erase_if(cover.points, [&](const CoverBox& point) {  // clusters of which no box is left
    return point.verdict == Verdict::undecided &&
           std::none_of(cover.boxes.begin(), cover.boxes.end(),
                        [&](const CoverBox& box) { return contains(point.box, box.box); });
  });
  cover.proof.reset();
  std::vector<int> place(cover.regions.size(), -1);
  std::vector<Box> regions;
  for (CoverBox& box : cover.boxes)
    if (box.region >= 0 && place[static_cast<std::size_t>(box.region)] < 0) {
      place[static_cast<std::size_t>(box.region)] = static_cast<int>(regions.size());
      regions.push_back(std::move(cover.regions[static_cast<std::size_t>(box.region)]));
    }
  for (std::vector<CoverBox>* list : {&cover.boxes, &cover.points})
    for (CoverBox& box : *list)
      if (box.region >= 0) box.region = place[static_cast<std::size_t>(box.region)];
  cover.regions = std::move(regions);
}

}  // namespace corank::solve
