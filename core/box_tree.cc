#include "corank/core/box_tree.h"

#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>
#include <limits>
#include <numeric>

#include "corank/core/box.h"
#include "corank/core/spread.h"

namespace corank {
namespace {

constexpr std::size_t kLeaf = 8, kManyBoxes = 1'000'000, kLeafOfMany = 32;  // fewer nodes, whose bounds take memory
constexpr std::size_t kBetweenChecks = 256;

}  // namespace

BoxTree::BoxTree(std::vector<const Box*> boxes, std::size_t sides, const Ended& ended)
    : boxes_(std::move(boxes)), sides_(sides), order_(boxes_.size()) {
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  Room room;
  if (!boxes_.empty()) build(0, boxes_.size(), room, ended);
}

std::size_t BoxTree::build(std::size_t begin, std::size_t end, Room& room, const Ended& ended) {
  const std::size_t node = nodes_.size();
  nodes_.push_back({begin, end});
  bounds_.resize(bounds_.size() + sides_);
  const auto hull = [&] { return bounds_.data() + node * sides_; };
  const auto box = [&](std::size_t k) { return boxes_[order_[k]]->data(); };
  const bool is_leaf = end - begin <= (boxes_.size() < kManyBoxes ? kLeaf : kLeafOfMany);
  if (is_leaf || (end - begin >= kBetweenChecks && is_over(ended))) {
    std::copy_n(box(begin), sides_, hull());
    for (std::size_t k = begin + 1; k < end; ++k) include({hull(), sides_}, {box(k), sides_});
    return node;
  }
  // Halves by the midpoints along the side in which they spread most.
  const std::span<std::size_t> members = std::span(order_).subspan(begin, end - begin);
  const auto middle_of = [&](std::size_t k, std::size_t j) { return (*boxes_[k])[j].mid(); };
  const std::size_t along = widest_side(std::span<const std::size_t>(members), sides_, middle_of);
  halve(
      members, [&](std::size_t k) { return middle_of(k, along); },
      [](const auto& a, const auto& b) { return a.first < b.first; }, room);
  const std::size_t middle = begin + (end - begin) / 2;
  build(begin, middle, room, ended);
  const std::size_t right = build(middle, end, room, ended);
  nodes_[node].right = right;
  std::copy_n(bounds(node + 1), sides_, hull());
  include({hull(), sides_}, {bounds(right), sides_});
  return node;
}

// A node all of whose boxes are one group stays so, and need not be entered for a box of that group: boxes that all overlap
// each other cost no more than others.
class BoxTree::Grouping {
 public:
  Grouping(const BoxTree& tree, double gap) : tree_(tree), gap_(gap), sets_(tree.size()), is_one_(tree.nodes_.size(), 0) {}

  void join(std::size_t i) { walk(0, i, *tree_.boxes_[i]); }
  std::size_t of(std::size_t i) { return sets_.find_set(i); }

 private:
  void walk(std::size_t node, std::size_t i, const Box& x) {
    if (!tree_.overlap(tree_.bounds(node), x, gap_)) return;
    const Node& n = tree_.nodes_[node];
    if (is_one_[node] && of(tree_.order_[n.begin]) == of(i)) return;
    if (n.right == 0) {
      for (std::size_t k = n.begin; k < n.end; ++k)
        if (const std::size_t other = tree_.order_[k];
            of(other) != of(i) && tree_.overlap(tree_.boxes_[other]->data(), x, gap_))
          sets_.union_set(other, i);
    } else {
      walk(node + 1, i, x);
      walk(n.right, i, x);
    }
    if (is_one_[node]) return;
    const std::size_t first = of(tree_.order_[n.begin]);
    bool one = n.right == 0 || (is_one_[node + 1] && is_one_[n.right]);
    for (std::size_t k = n.begin; n.right == 0 && k < n.end && one; ++k) one = of(tree_.order_[k]) == first;
    is_one_[node] = one && (n.right == 0 || of(tree_.order_[tree_.nodes_[n.right].begin]) == first);
  }

  const BoxTree& tree_;
  const double gap_;
  boost::disjoint_sets_with_storage<> sets_;
  std::vector<std::uint8_t> is_one_;
};

std::vector<std::size_t> BoxTree::groups(double gap, const Ended& ended) const {
  constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  Grouping grouping(*this, gap);
  for (std::size_t k = 0; k < order_.size(); ++k) {  // neighbours follow each other
    if (k % kBetweenChecks == 0 && is_over(ended)) break;
    grouping.join(order_[k]);
  }
  std::vector<std::size_t> numbers(size(), kNone), result(size());
  std::size_t next = 0;
  for (std::size_t i = 0; i < size(); ++i) {
    std::size_t& number = numbers[grouping.of(i)];
    if (number == kNone) number = next++;
    result[i] = number;
  }
  return result;
}

void GrowingBoxTree::add(const Box& box) {
  std::vector<const Box*> boxes{&box};
  std::size_t first = size_++;
  while (!subtrees_.empty() && subtrees_.back().boxes.size() <= boxes.size()) {
    std::vector<const Box*>& older = subtrees_.back().boxes;
    older.insert(older.end(), boxes.begin(), boxes.end());
    boxes = std::move(older);
    first = subtrees_.back().first;
    subtrees_.pop_back();
  }
  subtrees_.push_back({first, boxes, BoxTree(boxes, sides_)});
}

}  // namespace corank
