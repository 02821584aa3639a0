// Boxes in a tree of bounding boxes: which of many boxes overlap a given one, and which hang together, in a time that is
// near-linear in their number.
#pragma once

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "corank/core/cover.h"
#include "corank/core/ended.h"

namespace corank {

class BoxTree {
 public:
  /// The boxes are referred to; their first `sides` sides count (all have at least these). Once `ended` is true, the tree is
  /// divided no further: it finds the same, more slowly.
  BoxTree(std::vector<const Box*> boxes, std::size_t sides, const Ended& ended = {});

  std::size_t size() const { return boxes_.size(); }
  /// Calls visit(index) for each box whose sides all overlap those of x when widened by gap ≥ 0, in no particular order.
  template <class Visit>
  void for_each_overlapping(const Box& x, double gap, Visit visit) const {
    if (!nodes_.empty()) walk(0, x, gap, visit);
  }

  /// The connected groups of the boxes, two being connected where they overlap when widened by gap: the number of each box's
  /// group, numbered from 0 by their first boxes. Once `ended` is true the groups are those found so far, parts of the true
  /// ones.
  std::vector<std::size_t> groups(double gap, const Ended& ended) const;

 private:
  // Its boxes are order_[begin … end); an inner node's children are the next node and `right`.
  struct Node {
    std::size_t begin, end, right = 0;  // right = 0: a leaf
  };
  class Grouping;

  using Room = std::vector<std::pair<double, std::size_t>>;
  std::size_t build(std::size_t begin, std::size_t end, Room& room, const Ended& ended);
  // The bounds of a node: sides_ intervals from here on.
  const Interval* bounds(std::size_t node) const { return bounds_.data() + node * sides_; }
  bool overlap(const Interval* a, const Box& x, double gap) const {
    for (std::size_t j = 0; j < sides_; ++j)
      if (!(a[j].lo() <= x[j].hi() + gap && x[j].lo() <= a[j].hi() + gap)) return false;
    return true;
  }
  template <class Visit>
  void walk(std::size_t node, const Box& x, double gap, Visit& visit) const {
    if (!overlap(bounds(node), x, gap)) return;
    const Node& n = nodes_[node];
    if (n.right == 0) {
      for (std::size_t k = n.begin; k < n.end; ++k)
        if (overlap(boxes_[order_[k]]->data(), x, gap)) visit(order_[k]);
      return;
    }
    walk(node + 1, x, gap, visit);
    walk(n.right, x, gap, visit);
  }

  std::vector<const Box*> boxes_;
  std::size_t sides_;
  std::vector<std::size_t> order_;
  std::vector<Node> nodes_;
  std::vector<Interval> bounds_;
};

/// Of the boxes that belong to some things, each with all its sides. `box_of` returns a reference, or is a member.
template <class Things, class BoxOf>
BoxTree box_tree(const Things& things, BoxOf box_of) {
  std::vector<const Box*> boxes;
  for (const auto& thing : things) boxes.push_back(&std::invoke(box_of, thing));
  const std::size_t sides = boxes.empty() ? 0 : boxes.front()->size();
  return BoxTree(std::move(boxes), sides);
}

/// Boxes that come one by one: trees of 1, 2, 4 … boxes, joined as the digits of a binary counter.
class GrowingBoxTree {
 public:
  explicit GrowingBoxTree(std::size_t sides) : sides_(sides) {}
  std::size_t size() const { return size_; }
  /// The box is referred to; it gets the next index.
  void add(const Box& box);
  template <class Visit>
  void for_each_overlapping(const Box& x, Visit visit) const {
    for (const Subtree& s : subtrees_) s.tree.for_each_overlapping(x, 0.0, [&](std::size_t k) { visit(s.first + k); });
  }

 private:
  struct Subtree {
    std::size_t first;
    std::vector<const Box*> boxes;
    BoxTree tree;
  };
  std::size_t sides_, size_ = 0;
  std::vector<Subtree> subtrees_;
};

}  // namespace corank
