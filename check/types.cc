#include "corank/check/types.h"

#include <algorithm>

namespace corank::check {
namespace {

// Of the labels the first one that is not confirmed; nothing where all are.
std::string first_fault(const TypeLabels& labels, const auto& confirms) {
  for (const bool proven : {true, false})
    for (const SingularityType type : kSingularityTypes)
      if (((proven ? labels.proven : labels.excluded) & bit(type)) != 0 && !confirms(type, proven))
        return std::string("it is not shown that its solutions are ") + (proven ? "" : "not ") + to_string(type);
  return {};
}

// A side of the mechanism: inputs locked, or outputs.
struct Side {
  Block block, dependencies;  // L_y and g_v, or L_z and g_u
  int rates;                  // n_u or n_v
};

}  // namespace

// What holds of ranks in one box.
class TypeCheck::InBox {
 public:
  InBox(const TypeCheck& check, const Box& box) : check_(check), blocks_(check.blocks_), box_(box) {}

  bool shows(SingularityType type, bool proven) const {
    using enum SingularityType;
    const Side forward{Block::forward, Block::input_dependencies, blocks_.outputs},
        inverse{Block::inverse, Block::output_dependencies, blocks_.inputs};
    switch (type) {
      case rpm: return proven ? most(Block::passive) < blocks_.passive : passive_is(blocks_.passive);
      case iim: return proven ? most(Block::all) < rows() : all_is(rows());
      case ro: return redundant(forward, proven);
      case ri: return redundant(inverse, proven);
      case ii: return impossible(forward, proven);
      case io: return impossible(inverse, proven);
    }
    return false;
  }

 private:
  bool redundant(const Side& side, bool proven) const {  // rk M < n + rk L_p
    if (proven) return passive_is(most_of(side) - side.rates + 1);
    return side_is(side, side.rates + most(Block::passive));
  }
  bool impossible(const Side& side, bool proven) const {  // rk M + rk g < rk L
    if (proven) return all_is(most_of(side) + most(side.dependencies) + 1);
    return side_is(side, most(Block::all) - dependencies(side));
  }

  int rows() const { return blocks_.matrices[index(Block::all)].rows; }
  int most(Block block) const {
    const int own = blocks_.at_most[index(block)];
    if (block != Block::passive) return own;
    return std::min({own, most(Block::forward), most(Block::inverse)});
  }
  int most_of(const Side& side) const {
    return std::min({most(side.block), side.rates + most(Block::passive), most(Block::all) - dependencies(side)});
  }
  int dependencies(const Side& side) const {
    return is(side.dependencies, most(side.dependencies)) ? most(side.dependencies) : 0;
  }

  // Is the rank r at least, all over the box?
  bool is(Block block, int r) const {
    if (r <= 0) return true;
    const auto& rank = check_.ranks_[index(block)];
    return rank && r <= rank->columns() && rank->is_at_most(rank->columns() - r, box_);
  }
  bool passive_is(int r) const {
    return is(Block::passive, r) || is(Block::forward, r + blocks_.outputs) || is(Block::inverse, r + blocks_.inputs);
  }
  bool side_is(const Side& side, int r) const { return is(side.block, r) || is(Block::passive, r); }
  bool all_is(int r) const { return is(Block::all, r) || is(Block::forward, r) || is(Block::inverse, r); }

  const TypeCheck& check_;
  const VelocityBlocks& blocks_;
  const Box& box_;
};

TypeCheck::TypeCheck(const System& system, const VelocityBlocks& blocks, const StopFlag& stop) : blocks_(blocks) {
  for (std::size_t b = 0; b < ranks_.size(); ++b)
    if (!blocks.matrices[b].entries.empty())
      ranks_[b] = std::make_unique<const KernelCheck>(system, blocks.matrices[b], stop);
}

std::string TypeCheck::of_box(const TypeLabels& labels, const Box& box) const {
  return first_fault(labels, [in_box = InBox(*this, box)](auto type, bool proven) { return in_box.shows(type, proven); });
}

std::string TypeCheck::of_point(const TypeLabels& labels, const ExactCheck& point) const {
  if (labels == TypeLabels{}) return {};
  std::array<int, kBlocks> r{};
  for (std::size_t b = 0; b < r.size(); ++b) {
    if (blocks_.matrices[b].entries.empty()) continue;
    const auto rank = point.rank(blocks_.matrices[b]);
    if (!rank) return "the ranks behind its types are not known";
    r[b] = *rank;
  }
  const auto rank = [&r](Block block) { return r[index(block)]; };
  const auto has = [&](SingularityType type) {
    using enum SingularityType;
    using enum Block;
    switch (type) {
      case rpm: return rank(passive) < blocks_.passive;
      case iim: return rank(all) < blocks_.matrices[index(all)].rows;
      case ro: return rank(forward) < blocks_.outputs + rank(passive);
      case ri: return rank(inverse) < blocks_.inputs + rank(passive);
      case ii: return rank(forward) + rank(input_dependencies) < rank(all);
      case io: return rank(inverse) + rank(output_dependencies) < rank(all);
    }
    return false;
  };
  return first_fault(labels, [&](SingularityType type, bool proven) { return has(type) == proven; });
}

}  // namespace corank::check
