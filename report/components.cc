#include "corank/report/components.h"

#include <algorithm>

#include "corank/core/box_tree.h"

namespace corank::report {

Components components(const result::Result& result, const Ended& ended) {
  return components(result.cover.boxes, static_cast<std::size_t>(result.configuration_size), ended);
}

Components components(const std::vector<CoverBox>& boxes, std::size_t configuration_size, const Ended& ended) {
  Components none;
  none.counted = false;
  if (is_over(ended)) return none;
  std::vector<const Box*> sides;
  sides.reserve(boxes.size());
  for (const CoverBox& b : boxes) sides.push_back(&b.box);
  const BoxTree tree(std::move(sides), configuration_size);
  Components found;
  found.of_box.reserve(boxes.size());
  for (const std::size_t group : tree.groups(0, ended)) found.of_box.push_back(static_cast<int>(group));
  if (is_over(ended)) return none;
  const int last = boxes.empty() ? -1 : *std::max_element(found.of_box.begin(), found.of_box.end());
  std::vector<bool> proven(static_cast<std::size_t>(last + 1));
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const Verdict verdict = boxes[i].verdict;
    if (verdict == Verdict::regular || verdict == Verdict::isolated || verdict == Verdict::exact)
      proven[static_cast<std::size_t>(found.of_box[i])] = true;
  }
  found.count = static_cast<int>(proven.size());
  found.with_proven_solution = static_cast<int>(std::count(proven.begin(), proven.end(), true));
  return found;
}

}  // namespace corank::report
