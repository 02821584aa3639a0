#include "corank/python/box_arrays.h"

#include "corank/core/check.h"

namespace corank::python {

BoxArrays::BoxArrays(const std::vector<CoverBox>& boxes, std::size_t n) : size(boxes.size()), variables(n) {
  bounds.reserve(2 * size * n);
  free.assign(size * n, 0);
  for (auto* list : {&verdict, &reason, &types_proven, &types_excluded, &passage}) list->reserve(size);
  for (auto* list : {&kernel_at_most, &region, &point, &part}) list->reserve(size);
  for (std::size_t i = 0; i < size; ++i) {
    const CoverBox& b = boxes[i];
    CORANK_CHECK(b.box.size() == n);
    for (const Interval& side : b.box) {
      bounds.push_back(side.lo());
      bounds.push_back(side.hi());
    }
    for (const int j : b.free) free[i * n + static_cast<std::size_t>(j)] = 1;
    verdict.push_back(static_cast<std::uint8_t>(b.verdict));
    reason.push_back(static_cast<std::uint8_t>(b.reason));
    types_proven.push_back(b.types.proven);
    types_excluded.push_back(b.types.excluded);
    passage.push_back(static_cast<std::uint8_t>(b.passage));
    kernel_at_most.push_back(b.kernel_at_most);
    region.push_back(b.region);
    point.push_back(b.point);
    part.push_back(b.part);
  }
}

}  // namespace corank::python
