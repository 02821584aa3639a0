#include "corank/report/pictures/drawn_boxes.h"

#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "corank/core/box.h"
#include "corank/core/spread.h"

namespace corank::report {
namespace {

class Hulls {
 public:
  Hulls(const std::vector<CoverBox>& boxes, std::size_t sides, std::size_t in_one)
      : boxes_(boxes), sides_(sides), in_one_(in_one) {}

  std::vector<CoverBox> run() {
    std::map<std::pair<Verdict, int>, std::vector<std::uint32_t>> alike;
    for (std::size_t i = 0; i < boxes_.size(); ++i)
      alike[{boxes_[i].verdict, boxes_[i].motion}].push_back(static_cast<std::uint32_t>(i));
    for (auto& [what, list] : alike) split(list.begin(), list.end());
    return std::move(hulls_);
  }

 private:
  using Place = std::vector<std::uint32_t>::iterator;

  double middle(std::uint32_t i, std::size_t side) const { return boxes_[i].box[side].mid(); }

  // Halves along the side in which the middles spread most.
  void split(Place begin, Place end) {
    if (static_cast<std::size_t>(end - begin) <= in_one_) return add(begin, end);
    const auto along = widest_side(std::span<const std::uint32_t>(begin, end), sides_,
                                   [&](std::uint32_t i, std::size_t side) { return middle(i, side); });
    const Place half = begin + (end - begin) / 2;
    halve(
        std::span(begin, end), [&](std::uint32_t i) { return middle(i, along); }, std::less(), room_);
    split(begin, half);
    split(half, end);
  }

  void add(Place begin, Place end) {
    const CoverBox& first = boxes_[*begin];
    CoverBox hull;
    hull.box = first.box;
    hull.verdict = first.verdict;
    hull.motion = first.motion;
    hull.types = first.types;
    for (Place k = begin + 1; k != end; ++k) {
      const CoverBox& b = boxes_[*k];
      include(hull.box, b.box);
      hull.types.proven &= b.types.proven;
      hull.types.excluded &= b.types.excluded;
    }
    hulls_.push_back(std::move(hull));
  }

  const std::vector<CoverBox>& boxes_;
  const std::size_t sides_, in_one_;
  std::vector<CoverBox> hulls_;
  std::vector<std::pair<double, std::uint32_t>> room_;
};

}  // namespace

std::size_t boxes_in_one(const result::Result& result, const Components& found) {
  const std::size_t n = result.cover.boxes.size(), most = found.counted ? kMostDrawn : kMostDrawnAtTheEnd;
  return result.outputs.empty() && n > most ? 4 * ((n + most - 1) / most) : 1;
}

std::vector<CoverBox> hulls_of(const result::Result& result, std::size_t in_one) {
  return Hulls(result.cover.boxes, result.configuration_size, in_one).run();
}

}  // namespace corank::report
