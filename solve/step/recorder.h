// Keeps the script of a search (core/proof.h): each thread records what it does to its boxes, in the end the parts are
// put together in preorder. It decides nothing and costs nothing where there is none.
#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "corank/certify/newton.h"
#include "corank/core/proof.h"

namespace corank::solve {

/// Differs between the shards of one search (solve/store/shard.h).
using ShardNumber = std::uint64_t;

/// A box of the search: which of those that a shard has made.
struct NodeId {
  ShardNumber shard = 0;
  std::uint64_t place = 0;
  auto operator<=>(const NodeId&) const = default;
  void serialize(auto& archive) { archive(shard, place); }
};
/// A leaf `box i` of a script: which of the boxes that a shard has found.
using LeafId = NodeId;

/// How many integers and reals belong to a step of a script. `integers`: where its own begin.
struct StepSize {
  std::size_t integers, reals;
};
StepSize size_of_step(Proof::Step kind, const std::int32_t* integers);

/// What an allocation takes beside what is asked for, nearly.
inline constexpr int kAllocationBytes = 16;

/// What it takes in memory, nearly.
std::uint64_t bytes_of(const Proof::Combination& c);

class Recorder {
 public:
  Recorder() = default;
  explicit Recorder(ShardNumber shard) : shard_(shard) {}

  /// What it keeps, nearly.
  std::uint64_t bytes() const;

  /// How much has been recorded: a moment between two boxes.
  struct Mark {
    std::uint64_t step = 0, integer = 0, real = 0, combinations = 0, nodes = 0;
  };
  Mark mark() const;
  /// As it was then, but that no identifier is given out twice.
  void go_back_to(const Mark& mark);

  NodeId new_node() { return {shard_, next_++}; }
  LeafId leaf(std::size_t found) const { return {shard_, found}; }

  /// What follows is done to this box, until it is split or ends in a leaf.
  void begin(NodeId node, std::span<const Interval> x, int variables);
  /// −1 − k names implied equation k.
  void row(int row);
  /// A step with p about the midpoint of x, the box as it is before. Nothing is kept of a p that floats cannot hold.
  void newton(const certify::Preconditioner& p, std::span<const Interval> x);
  void keep(std::span<const Interval> x);
  void split(int variable, double where, NodeId lower, NodeId upper);
  /// What becomes of the box, as it is now, will be recorded under the node that is returned, by this recorder or another.
  NodeId go_on_later();
  void cut(int variable, const std::vector<double>& places);
  void leaf_box(std::size_t found);
  void leaf_empty() { step(Proof::Step::empty); }
  void leaf_elsewhere() { step(Proof::Step::elsewhere); }

  /// What has been recorded, for an archive (solve/store/shard_bytes.h): it is between two boxes.
  void serialize(auto& archive) {
    archive(shard_, next_, script_, combination_bytes_, nodes_);
    open_ = nullptr;
  }

  /// Script by script, from the roots' nodes on. `place` gives the place in the cover of each LeafId.
  static Proof assemble(const std::vector<const Recorder*>& recorders, std::vector<std::vector<Interval>> roots,
                        const std::vector<NodeId>& nodes, const std::map<LeafId, int>& place);

 private:
  struct Cursor {
    std::uint64_t step = 0, integer = 0, real = 0;
    void serialize(auto& archive) { archive(step, integer, real); }
  };
  struct Node {
    Cursor begin, end;
    NodeId lower{}, upper{};  // where it was split; upper alone: where its script goes on
    bool is_split = false, goes_on = false;
    std::uint64_t number = 0;  // how many were begun before
    void serialize(auto& archive) { archive(begin, end, lower, upper, is_split, goes_on, number); }
  };
  void step(Proof::Step s);
  void close();

  ShardNumber shard_ = 0;
  std::uint64_t next_ = 1;
  Proof script_;
  std::uint64_t combination_bytes_ = 0;
  std::map<NodeId, Node> nodes_;
  Node* open_ = nullptr;
  std::vector<Interval> kept_;
};

/// Makes Y's entries floats, which scripts hold, where all are of a size that floats keep to 24 bits. Any Y is valid.
void round_to_floats(certify::Preconditioner& p);

}  // namespace corank::solve
