#include "corank/solve/search/assembly.h"

#include <malloc.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <ranges>
#include <unordered_map>
#include <utility>

#include "corank/certify/domain.h"
#include "corank/core/box.h"
#include "corank/core/check.h"
#include "corank/core/rounding.h"
#include "corank/solve/step/box_order.h"
#include "corank/solve/step/heuristics.h"
#include "corank/solve/step/points.h"
#include "corank/solve/step/preconditioner.h"

namespace corank::solve {
namespace {

// Bytes of a script that is put together and written within a part of a second.
constexpr std::uint64_t kMostAfterEnd = std::uint64_t{1} << 28;

constexpr double kPointGap = 1e-6;  // of the typical sizes: closer undecided boxes are of one point

// What all shards have found; it stays theirs. Notes each box's leaf.
std::vector<Found*> gather(const std::vector<Shard*>& shards) {
  std::vector<Found*> all;
  for (Shard* shard : shards)
    for (std::size_t i = 0; i < shard->found.size(); ++i) {
      Found& found = shard->found[i];
      if (shard->script) found.leaves.push_back(shard->script->leaf(i));
      all.push_back(&found);
    }
  return all;
}

// `found` are the boxes as the cover has them.
std::shared_ptr<const Proof> script_of(const std::vector<Shard*>& shards, const Work& first_pass,
                                       const std::vector<Found*>& found) {
  std::map<LeafId, int> place;
  for (std::size_t i = 0; i < found.size(); ++i)
    for (const LeafId leaf : found[i]->leaves) place[leaf] = static_cast<int>(i);
  std::vector<const Recorder*> recorders;
  for (const Shard* shard : shards)
    if (shard->script) recorders.push_back(&*shard->script);
  std::vector<Box> boxes;
  std::vector<NodeId> nodes;
  for (const Waiting& root : first_pass.boxes) {
    boxes.push_back(root.x);
    nodes.push_back(root.node);
  }
  return std::make_shared<const Proof>(Recorder::assemble(recorders, std::move(boxes), nodes, place));
}

std::uint64_t script_bytes(const std::vector<Shard*>& shards) {
  std::uint64_t sum = 0;
  for (const Shard* shard : shards)
    if (shard->script) sum += shard->script->bytes();
  return sum;
}

Statistics statistics_of(const std::vector<Shard*>& shards) {
  Statistics sum;
  for (const Shard* shard : shards) {
    sum.processed += shard->statistics.processed;
    sum.newton_steps += shard->statistics.newton_steps;
    sum.proofs_tried += shard->statistics.proofs_tried;
    sum.seconds_certify += shard->statistics.seconds_certify;
  }
  return sum;
}

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
constexpr std::size_t kKeyEnds = 4, kKeyEndsOfMany = 1, kManyToSort = 4'000'000;
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

// By their sides in the variables that were kept, then by what is claimed of them (solve/step/box_order.h).
void sort(std::vector<Found*>& found) {
  if (found.size() < kManyToSort)
    sort_by_keys<kKeyEnds>(found);
  else
    sort_by_keys<kKeyEndsOfMany>(found);
}

// Numbers the regions of the boxes' proofs by the first box that has each, and returns them in all variables.
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

// The box in all variables of the system that was reduced.
CoverBox lifted(const System& system, const certify::Reduction& reduction, CoverBox box) {
  box.box = reduction.lift(box.box);
  box.box.shrink_to_fit();  // there may be many
  if (box.verdict == Verdict::undecided || box.verdict == Verdict::pending) certify::clip_to_domain(system, box.box);
  for (int& j : box.free) j = reduction.kept[j];
  return box;
}

// The same of those boxes of the lists that `found` names, in its order. The lists are emptied as their boxes are taken, so
// that no box is held twice.
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

class Merger {
 public:
  Merger(const Problem& problem, std::vector<Found*>& found, const Ended& ended)
      : problem_(problem),
        found_(found),
        ended_(ended),
        preconditioners_(problem.compiled, ended),
        removed_(found.size(), false) {}

  void run() {
    for (std::size_t i = 0; i < found_.size(); ++i)
      if (found_[i]->box.verdict == Verdict::regular &&
          found_[i]->box.free.size() == 1 + problem_.compiled.parameters().size() &&
          problem_.excess(found_[i]->box.box) <= kFragment)
        cells_.push_back({0, i});
    if (cells_.size() < 2) return;
    choose_axes();
    for (Cell& cell : cells_) cell.key = key_of(cell.index, 0, 0);
    std::ranges::sort(cells_,
                      [](const Cell& a, const Cell& b) { return a.key != b.key ? a.key < b.key : a.index < b.index; });
    std::vector<std::size_t> order;
    for (const Cell& cell : cells_) order.push_back(cell.index);
    std::ranges::sort(order);
    for (std::size_t i : order)
      while (!removed_[i] && grow(i)) {
      }
    std::size_t kept = 0;
    for (std::size_t i = 0; i < found_.size(); ++i)
      if (!removed_[i]) found_[kept++] = found_[i];
    found_.resize(kept);
  }

 private:
  struct Cell {
    long key;
    std::size_t index;
  };

  // The two variables that spread the boxes most, in their σ.
  void choose_axes() {
    const std::size_t n = problem_.compiled.variables();
    std::vector<double> spread(n);
    for (std::size_t j = 0; j < n; ++j) {
      double least = HUGE_VAL, greatest = -HUGE_VAL;
      for (const Cell& cell : cells_) {
        least = std::min(least, found_[cell.index]->box.box[j].lo());
        greatest = std::max(greatest, found_[cell.index]->box.box[j].lo());
      }
      spread[j] = (greatest - least) / problem_.sigma[j];
    }
    axes_[0] = std::ranges::max_element(spread) - spread.begin();
    spread[axes_[0]] = -1;
    axes_[1] = std::ranges::max_element(spread) - spread.begin();
  }

  // Boxes in one box of size σ have lower ends at most σ apart.
  long key_of(std::size_t i, long d0, long d1) const {
    constexpr long kStride = 1L << 30;
    const auto cell = [&](std::size_t axis) {
      return std::lround(std::floor(std::clamp(found_[i]->box.box[axis].lo() / problem_.sigma[axis], -5e8, 5e8)));
    };
    return (cell(axes_[0]) + d0) * kStride + cell(axes_[1]) + d1;
  }

  // Merges box i with one neighbour.
  bool grow(std::size_t i) {
    for (long d0 = -1; d0 <= 1; ++d0) {
      // Three neighbouring cells are one range of keys.
      const long first = key_of(i, d0, -1), last = key_of(i, d0, 1);
      auto at = std::lower_bound(cells_.begin(), cells_.end(), first, [](const Cell& c, long key) { return c.key < key; });
      for (; at != cells_.end() && at->key <= last; ++at) {
        const std::size_t j = at->index;
        if (is_over(ended_)) return false;
        if (j == i || removed_[j] || found_[i]->box.free != found_[j]->box.free) continue;
        if (!merge(*found_[i], found_[j]->box)) continue;
        found_[i]->leaves.insert(found_[i]->leaves.end(), found_[j]->leaves.begin(), found_[j]->leaves.end());
        removed_[j] = true;
        return true;
      }
    }
    return false;
  }

  // Puts the proven hull of both in a's place. False: there is none.
  bool merge(Found& found, const CoverBox& b) {
    const CoverBox& a = found.box;
    const auto& system = problem_.compiled;
    const std::size_t n = system.variables();
    Box hull(a.box.size());
    for (std::size_t j = 0; j < hull.size(); ++j) {
      if (!a.box[j].overlaps(b.box[j])) return false;
      hull[j] = Interval::hull(a.box[j], b.box[j]);
      if (hull[j].width() > problem_.sigma[j]) return false;
    }
    hull.resize(n);
    const std::vector<int> dependent = all_but(a.free, system.variables());
    const auto& p = preconditioners_.at_midpoint(hull, &dependent);
    if (p.rank() < system.equations()) return false;
    certify::Sheet sheet = certify::newton_prove(system, p, hull, workspace_);
    if (!sheet.proven) return false;
    Box& image = sheet.image;
    certify::NewtonStep step = certify::tighten_sheet(system, p, image, workspace_);
    for (int k = 1; k < kTightenings; ++k) step = certify::tighten_sheet(system, p, image, workspace_);
    if (problem_.domain.locate_zeros(step, image) != certify::Location::inside) return false;
    problem_.append_values_at_zeros(step, image);
    if (problem_.excess(image) > 1) return false;
    problem_.append_values(sheet.region);
    found.region = std::make_shared<const Box>(std::move(sheet.region));
    found.box.box = std::move(image);
    return true;
  }

  const Problem& problem_;
  std::vector<Found*>& found_;
  const Ended& ended_;
  PreconditionerFactory preconditioners_;
  certify::NewtonWorkspace workspace_;
  std::vector<bool> removed_;
  std::vector<Cell> cells_;
  std::size_t axes_[2] = {0, 0};
};

// Replaces pairs of touching regular boxes over the same free variables by one, again and again, where their hull can be
// proven as any box is (certify::newton_prove) and is no wider than σ. The proof's image holds every zero of the hull, so
// nothing is lost. The result depends on the boxes and their order only; once `ended` is true the other boxes stay as they
// are.
void merge_regular(const Problem& problem, std::vector<Found*>& found, const Ended& ended) {
  Merger(problem, found, ended).run();
}

}  // namespace

Cover assemble(const Prepared& prepared, const Problem& problem, const std::vector<Shard*>& shards, const Work& first_pass,
               const SelfMotions& motions, const Sigma& sigma, Control& control) {
  const certify::Reduction& reduction = prepared.reduction;
  Cover cover;
  cover.sigma = sigma;
  cover.dimension = reduction.system.dimension();
  cover.reduction = reduction.steps;
  cover.statistics = statistics_of(shards);
  std::vector<Found*> found = gather(shards);
  bool some_partial = false;
  for (const Found* f : found) {
    if (f->box.verdict != Verdict::partial) continue;
    some_partial = true;
    cover.dimension = std::max(cover.dimension, static_cast<int>(f->box.free.size()));
  }
  if (reduction.tolerant || some_partial) cover.tolerance = reduction.system.coefficient_tolerance * kPartialTolerance;
  const UpwardRounding rounding;  // and subnormal numbers stay
  const Ended overdue = [&control] { return control.overdue(); };
  sort(found);
  const std::size_t all = found.size();
  merge_degenerate(problem, found, cover.dimension == 0 ? kPointGap : kOtherShare, overdue);
  if (found.size() < all) sort(found);
  if (cover.dimension == 0) {
    const InStage stage(control, Stage::points);
    merge_isolated(found, overdue);
    cover.regions = number_regions(reduction, found);
    cover.points = collect_points(found, problem.limits(kPointGap), overdue, problem.compiled.parameters().size());
  } else {
    const InStage stage(control, Stage::merging);
    const std::size_t before = found.size();
    if (prepared.options.max_solutions == 0)  // it might leave fewer than were asked for
      merge_regular(problem, found, [&control] { return control.ended(); });
    if (found.size() < before) sort(found);  // merged boxes have other sides
    cover.regions = number_regions(reduction, found);
  }
  for (const Found* f : found) cover.wider_than_sigma += f->region != nullptr && problem.excess(f->box.box) > 1;
  // A replay would have to find the self-motions again.
  const bool replayable = reduction.consistent && !reduction.tolerant && !some_partial;
  const bool in_time = !control.ended() || (prepared.options.proof_of_parts && script_bytes(shards) < kMostAfterEnd);
  const bool is_asked = prepared.options.proof && in_time;
  if (is_asked && replayable) cover.proof = script_of(shards, first_pass, found);
  // The reduced equations contradict each other: nothing was searched, and a checker sees it without help.
  if (prepared.options.proof && !reduction.consistent && !reduction.tolerant)
    cover.proof = std::make_shared<const Proof>(
        Proof{{reduction.system.domain()}, {}, {static_cast<std::uint8_t>(Proof::Step::elsewhere)}, {}, {}});
  cover.self_motions = motions.records(reduction);
  if (std::ranges::any_of(found, [](const Found* f) { return f->box.reason == Reason::degenerate_set; }))
    cover.observed_dimension = motions.observed_dimension();
  for (CoverBox& point : cover.points) point = lifted(prepared.system, reduction, std::move(point));
  std::vector<FoundList*> lists;
  for (Shard* shard : shards) lists.push_back(&shard->found);
  cover.boxes = take_lifted(prepared.system, reduction, std::move(found), lists);
  return cover;
}

}  // namespace corank::solve
