#include "corank/solve/kernel_dimensions.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "corank/certify/blow_up.h"
#include "corank/certify/kernel_bound.h"
#include "corank/core/rounding.h"
#include "corank/core/threads.h"
#include "corank/solve/box_hash.h"
#include "corank/solve/region_hulls.h"

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

}  // namespace

void bound_kernel_dimensions(const Prepared& prepared, Cover& cover, Control& control) {
  const InStage stage(control, Stage::kernel);
  const System& system = prepared.system;
  const auto stopped = [&control] { return control.ended(); };
  const certify::KernelBound bound(system);
  if (!bound.applies()) return;
  const std::vector<certify::PointLocation> places(cover.exact_points.begin(), cover.exact_points.end());
  std::vector<Box> hulls = hulls_by_region(cover);
  std::vector<int> of_regions(hulls.size(), 0);  // 0: not known
  const auto bound_in = [&](CoverBox& box, int known) {
    const UpwardRounding rounding;
    if (box.verdict == Verdict::pending || stopped()) return;
    box.kernel_at_most = known > 0 && known <= system.kernel_vectors ? known : bound.at_most(box.box);
  };
  ThreadArena arena(prepared.options.threads);
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, hulls.size(), [&](std::size_t r) {
      const UpwardRounding rounding;
      if (!hulls[r].empty() && !stopped()) of_regions[r] = bound.at_most(hulls[r]);
    });
    hulls = {};
    tbb::parallel_for(std::size_t{0}, cover.boxes.size(), [&](std::size_t i) {
      CoverBox& box = cover.boxes[i];
      bound_in(box, box.region < 0 ? 0 : of_regions[static_cast<std::size_t>(box.region)]);
    });
  });
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

}  // namespace corank::solve
