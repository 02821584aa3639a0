// The boxes that wait in a search, newest last: depth first, so that memory grows with the depth; or the oldest first, so
// that there soon are many.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "corank/core/interval.h"
#include "corank/solve/recorder.h"

namespace corank::solve {

// Boxes waiting, each with its share of the search domain: 1 for all of it, a part's share by the lengths of the parts.
class WorkList {
 public:
  explicit WorkList(std::size_t n, bool oldest_first = false) : n_(n), oldest_first_(oldest_first) {}
  bool empty() const { return size() == 0; }
  std::size_t size() const { return shares_.size() - first_; }
  void push(std::span<const Interval> x, double share, NodeId node) {
    sides_.insert(sides_.end(), x.begin(), x.begin() + n_);
    shares_.push_back(share);
    nodes_.push_back(node);
  }
  NodeId node() const { return oldest_first_ ? nodes_[first_] : nodes_.back(); }  // of the next
  // Copies the next box to x and removes it; returns its share.
  double pop(std::span<Interval> x) {
    if (oldest_first_) {
      const auto at = sides_.begin() + static_cast<std::ptrdiff_t>(first_ * n_);
      std::copy(at, at + static_cast<std::ptrdiff_t>(n_), x.begin());
      return shares_[first_++];
    }
    nodes_.pop_back();
    std::copy(sides_.end() - static_cast<std::ptrdiff_t>(n_), sides_.end(), x.begin());
    sides_.resize(sides_.size() - n_);
    const double share = shares_.back();
    shares_.pop_back();
    return share;
  }
  // Gives away the older half: the larger boxes. Of a list that is depth first.
  WorkList split_off() {
    WorkList older(n_);
    const std::size_t half = size() / 2;
    older.sides_.assign(sides_.begin(), sides_.begin() + static_cast<std::ptrdiff_t>(half * n_));
    older.shares_.assign(shares_.begin(), shares_.begin() + static_cast<std::ptrdiff_t>(half));
    older.nodes_.assign(nodes_.begin(), nodes_.begin() + static_cast<std::ptrdiff_t>(half));
    nodes_.erase(nodes_.begin(), nodes_.begin() + static_cast<std::ptrdiff_t>(half));
    sides_.erase(sides_.begin(), sides_.begin() + static_cast<std::ptrdiff_t>(half * n_));
    shares_.erase(shares_.begin(), shares_.begin() + static_cast<std::ptrdiff_t>(half));
    return older;
  }

 private:
  std::size_t n_;
  bool oldest_first_;
  std::size_t first_ = 0;  // of those that wait: others were taken before
  std::vector<Interval> sides_;
  std::vector<double> shares_;
  std::vector<NodeId> nodes_;
};

}  // namespace corank::solve
