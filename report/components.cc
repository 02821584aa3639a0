#include "corank/report/components.h"

#include <algorithm>
#include <functional>

#include "corank/core/box_tree.h"
#include "corank/result/tallies.h"

namespace corank::report {

Components components(const result::Result& result, const Ended& ended) {
  return components(result.cover.boxes, result.configuration_size, ended);
}

Components components(const std::vector<CoverBox>& boxes, std::size_t configuration_size, const Ended& ended) {
  const Components none{.counted = false};
  if (is_over(ended)) return none;
  std::vector<const Box*> sides;
  sides.reserve(boxes.size());
  for (const CoverBox& b : boxes) sides.push_back(&b.box);
  const BoxTree tree(std::move(sides), configuration_size);
  Components found;
  found.of_box = tree.groups(0, ended);
  if (is_over(ended)) return none;
  std::vector<bool> proven(boxes.empty() ? 0 : std::ranges::max(found.of_box) + 1);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const Verdict verdict = boxes[i].verdict;
    if (verdict == Verdict::regular || verdict == Verdict::isolated || verdict == Verdict::exact)
      proven[found.of_box[i]] = true;
  }
  found.count = proven.size();
  found.with_proven_solution = result::how_many(proven, std::identity());
  return found;
}

}  // namespace corank::report
