#include "corank/certify/type_bounds.h"

#include <algorithm>
#include <tuple>

#include "corank/core/check.h"
#include "corank/core/rounding.h"

namespace corank::certify {
namespace {

// Each rank is in lo … hi.
class RankRange {
 public:
  RankRange(const VelocityBlocks& blocks, const RankBounds& lo, const RankBounds& hi) : blocks_(blocks), lo_(lo), hi_(hi) {
    narrow();
  }

  const RankBounds& lower() const { return lo_; }
  int lo(Block block) const { return lo_[index(block)]; }
  int hi(Block block) const { return hi_[index(block)]; }
  void raise(Block block, int rank) {
    lo_[index(block)] = std::max(lo_[index(block)], rank);
    narrow();
  }

  // rk of `left` plus rk of the dependencies < rk of `right` plus n, where that is so for all, or for none.
  static void compare(SingularityType type, int lo_left, int hi_left, int lo_right, int hi_right, TypeLabels& labels) {
    if (hi_left < lo_right) labels.proven |= bit(type);
    if (lo_left >= hi_right) labels.excluded |= bit(type);
  }
  TypeLabels labels() const {
    using enum SingularityType;
    using enum Block;
    TypeLabels labels;
    compare(rpm, lo(passive), hi(passive), blocks_.passive, blocks_.passive, labels);
    compare(iim, lo(all), hi(all), blocks_.matrices[index(all)].rows, blocks_.matrices[index(all)].rows, labels);
    compare(ro, lo(forward), hi(forward), blocks_.outputs + lo(passive), blocks_.outputs + hi(passive), labels);
    compare(ri, lo(inverse), hi(inverse), blocks_.inputs + lo(passive), blocks_.inputs + hi(passive), labels);
    compare(ii, lo(forward) + lo(input_dependencies), hi(forward) + hi(input_dependencies), lo(all), hi(all), labels);
    compare(io, lo(inverse) + lo(output_dependencies), hi(inverse) + hi(output_dependencies), lo(all), hi(all), labels);
    labels.proven &= blocks_.asked;
    labels.excluded &= blocks_.asked;
    return labels;
  }

 private:
  void narrow() {
    using enum Block;
    const auto below = [this](Block small, int more, Block large, int room) {  // rk small + more ≤ rk large + room
      lo_[index(large)] = std::max(lo_[index(large)], lo_[index(small)] + more - room);
      hi_[index(small)] = std::min(hi_[index(small)], hi_[index(large)] + room - more);
    };
    for (int sweep = 0; sweep < 3; ++sweep) {
      for (const auto& [side, count, dependencies] :
           {std::tuple(forward, blocks_.outputs, lo_[index(input_dependencies)]),
            std::tuple(inverse, blocks_.inputs, lo_[index(output_dependencies)])}) {
        below(passive, 0, side, 0);
        below(side, 0, passive, count);
        below(side, dependencies, all, 0);
      }
    }
  }

  const VelocityBlocks& blocks_;
  RankBounds lo_, hi_;
};

}  // namespace

TypeBounds::TypeBounds(const System& system, const VelocityBlocks& blocks) : system_(system), blocks_(blocks) {
  for (std::size_t b = 0; b < blocks.matrices.size(); ++b)
    if (!blocks.matrices[b].entries.empty()) bounds_[b].emplace(system, blocks.matrices[b]);
}

RankBounds TypeBounds::ranks(const Box& box, int halvings, const RankBounds& known, TypeSet wanted) const {
  using enum Block;
  CORANK_CHECK(UpwardRounding::active());
  RankRange range(blocks_, known, blocks_.at_most);
  const auto raise = [&](Block block) {
    const auto& bound = bounds_[index(block)];
    if (bound && range.lo(block) < range.hi(block))
      range.raise(block, blocks_.matrices[index(block)].columns - bound->at_most(box, halvings));
  };
  for (const Block block : {passive, input_dependencies, output_dependencies}) raise(block);
  raise(all);
  // Only where a type may be excluded by it.
  if ((wanted & (bit(SingularityType::ro) | bit(SingularityType::ii))) != 0 &&
      range.hi(forward) >= std::min(blocks_.outputs + range.hi(passive), range.hi(all) - range.hi(input_dependencies)))
    raise(forward);
  if ((wanted & (bit(SingularityType::ri) | bit(SingularityType::io))) != 0 &&
      range.hi(inverse) >= std::min(blocks_.inputs + range.hi(passive), range.hi(all) - range.hi(output_dependencies)))
    raise(inverse);
  return range.lower();
}

TypeLabels TypeBounds::labels(const RankBounds& ranks) const { return RankRange(blocks_, ranks, blocks_.at_most).labels(); }

TypeLabels TypeBounds::at(const ExactPoint& point, const Ended& ended) const {
  RankBounds ranks{};
  for (std::size_t b = 0; b < ranks.size(); ++b) {
    if (blocks_.matrices[b].entries.empty()) continue;
    const std::optional<int> rank = exact_rank(system_, blocks_.matrices[b], point, ended);
    if (!rank) return {};
    ranks[b] = *rank;
  }
  return RankRange(blocks_, ranks, ranks).labels();
}

}  // namespace corank::certify
