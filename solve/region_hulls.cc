#include "corank/solve/region_hulls.h"

#include "corank/core/box.h"

namespace corank::solve {

std::vector<Box> hulls_by_region(const Cover& cover) {
  std::vector<Box> hulls(cover.regions.size());
  std::vector<int> pieces(cover.regions.size(), 0);
  for (const CoverBox& box : cover.boxes)
    if (box.region >= 0) ++pieces[static_cast<std::size_t>(box.region)];
  for (const CoverBox& box : cover.boxes) {
    if (box.region < 0 || pieces[static_cast<std::size_t>(box.region)] < 2) continue;
    Box& hull = hulls[static_cast<std::size_t>(box.region)];
    if (hull.empty()) hull = box.box;
    include(hull, box.box);
  }
  return hulls;
}

}  // namespace corank::solve
