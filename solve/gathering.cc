#include "corank/solve/gathering.h"

#include <malloc.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <ranges>
#include <unordered_map>
#include <utility>

#include "corank/certify/domain.h"
#include "corank/core/check.h"
#include "corank/core/rounding.h"
#include "corank/solve/box_order.h"

namespace corank::solve {
namespace {

// f(i) for every index below `count`, on all threads.
template <class F>
void for_each_index(std::size_t count, F f) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count), [&](const tbb::blocked_range<std::size_t>& part) {
    const UpwardRounding rounding;
    for (std::size_t i = part.begin(); i < part.end(); ++i) f(i);
  });
}

// Most comparisons end at the first sides, kept here, without a look at the boxes: lower and upper end of each. Of very many
// boxes only the lowest is kept, since here the search needs most memory.
constexpr std::size_t kKeyEnds = 4, kKeyEndsOfMany = 1, kManyBoxes = 4'000'000;
template <std::size_t Ends>
struct Key {
  std::array<double, Ends> ends{};
  Found* found = nullptr;
};

// Of boxes that claim the same, as overlapping roots have them.
bool region_before(const Found& a, const Found& b) {
  if (!a.region || !b.region) return !a.region && b.region;
  return before(*a.region, *b.region);
}

template <std::size_t Ends>
void sort_by_keys(std::vector<Found*>& found) {
  std::vector<Key<Ends>> keys(found.size());
  const std::size_t n = found.empty() ? 0 : found[0]->box.box.size();
  for_each_index(found.size(), [&](std::size_t i) {
    const Box& box = found[i]->box.box;
    keys[i].found = found[i];
    for (std::size_t e = 0; e < std::min(2 * n, Ends); ++e) keys[i].ends[e] = e % 2 == 0 ? box[e / 2].lo() : box[e / 2].hi();
  });
  const auto others = std::views::iota(std::min(n, Ends / 2), n);
  tbb::parallel_sort(keys.begin(), keys.end(), [&](const Key<Ends>& a, const Key<Ends>& b) {
    for (std::size_t e = 0; e < Ends; ++e)
      if (a.ends[e] != b.ends[e]) return a.ends[e] < b.ends[e];
    if (before(a.found->box, b.found->box, others)) return true;
    return !before(b.found->box, a.found->box, others) && region_before(*a.found, *b.found);
  });
  for (std::size_t i = 0; i < keys.size(); ++i) found[i] = keys[i].found;
}

// Whole pages in the midst of what is in use, which the C library keeps otherwise.
constexpr std::size_t kBetweenTrims = std::size_t{1} << 19;
void give_memory_back() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

}  // namespace

void sort(std::vector<Found*>& found) {
  if (found.size() < kManyBoxes)
    sort_by_keys<kKeyEnds>(found);
  else
    sort_by_keys<kKeyEndsOfMany>(found);
}

std::vector<Box> number_regions(const certify::Reduction& reduction, const std::vector<Found*>& found) {
  std::vector<const Box*> region(found.size());
  for_each_index(found.size(), [&](std::size_t i) { region[i] = found[i]->region.get(); });
  std::vector<int> number(found.size(), -1);
  std::unordered_map<const Box*, int> numbers;
  std::vector<Box> regions;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (region[i] == nullptr) continue;
    const auto [at, is_new] = numbers.try_emplace(region[i], static_cast<int>(regions.size()));
    if (is_new) regions.push_back(reduction.lift(*region[i]));
    number[i] = at->second;
  }
  for_each_index(found.size(), [&](std::size_t i) { found[i]->box.region = number[i]; });
  return regions;
}

CoverBox lifted(const System& system, const certify::Reduction& reduction, CoverBox box) {
  box.box = reduction.lift(box.box);
  box.box.shrink_to_fit();  // there may be many
  if (box.verdict == Verdict::undecided || box.verdict == Verdict::pending) certify::clip_to_domain(system, box.box);
  for (int& j : box.free) j = reduction.kept[j];
  return box;
}

std::vector<CoverBox> take_lifted(const System& system, const certify::Reduction& reduction, std::vector<Found*> found,
                                  const std::vector<FoundList*>& lists) {
  CORANK_CHECK(found.size() < Found::kNowhere);
  for_each_index(found.size(), [&](std::size_t i) { found[i]->place = static_cast<std::uint32_t>(i); });
  std::vector<CoverBox> boxes;
  std::vector<std::uint32_t> places;
  boxes.reserve(found.size());
  places.reserve(found.size());
  std::vector<Found*>().swap(found);
  for (FoundList* list : lists)
    for (; !list->empty(); list->pop_front()) {
      if (list->front().place == Found::kNowhere) continue;  // merged into another
      boxes.push_back(std::move(list->front().box));
      places.push_back(list->front().place);
      if (boxes.size() % kBetweenTrims == 0) give_memory_back();
    }
  for (std::size_t i = 0; i < boxes.size(); ++i)
    while (places[i] != i) {
      const std::size_t to = places[i];
      std::swap(boxes[i], boxes[to]);
      std::swap(places[i], places[to]);
    }
  for_each_index(boxes.size(), [&](std::size_t i) { boxes[i] = lifted(system, reduction, std::move(boxes[i])); });
  return boxes;
}

}  // namespace corank::solve
