#include "corank/solve/search/cover_edit.h"

#include <algorithm>

#include "corank/solve/step/box_order.h"
#include "corank/solve/step/recorder.h"

namespace corank::solve {
namespace {
using Step = Proof::Step;

// Calls change(step, its first integer) for every step.
template <class Change>
void change_steps(Proof& proof, Change change) {
  std::int32_t* integers = proof.integers.data();
  for (std::uint8_t& step : proof.steps) {
    const std::size_t own = size_of_step(static_cast<Step>(step), integers).integers;
    change(step, integers);
    integers += own;
  }
}

}  // namespace

void CoverEdit::replace(int i, int by) {
  fate_.resize(cover_.boxes.size(), kStays);
  fate_[i] = by;
}

void CoverEdit::replace(const std::vector<std::size_t>& boxes, const Partition& partition, Cover around, CoverBox core) {
  const int first = static_cast<int>(cover_.boxes.size()), region = static_cast<int>(cover_.regions.size());
  std::move(around.regions.begin(), around.regions.end(), std::back_inserter(cover_.regions));
  for (CoverBox& box : around.boxes) {
    if (box.region >= 0) box.region += region;
    cover_.boxes.push_back(std::move(box));
  }
  cover_.boxes.push_back(std::move(core));
  const int root = cover_.proof && around.proof ? append(partition, *around.proof, first) : 0;
  for (const std::size_t i : boxes) replace(static_cast<int>(i), kInRoot - root);
}

Proof& CoverEdit::proof() {
  if (!proof_) proof_ = std::make_shared<Proof>(*cover_.proof);
  return *proof_;
}

int CoverEdit::append(const Partition& partition, Proof around, int first_box) {
  Proof& proof = this->proof();
  const int root = static_cast<int>(proof.roots.size());
  const auto add_leaf = [&](Step kind, int index) {
    proof.steps.push_back(static_cast<std::uint8_t>(kind));
    proof.integers.push_back(index);
  };
  proof.roots.emplace_back();
  for (std::size_t k = 0; k < reduction_.kept.size(); ++k) {
    Interval side = partition.whole[reduction_.kept[k]];
    side.intersect(reduction_.system.variables[k].domain);
    proof.roots.back().push_back(side);
  }
  // The parts came one after the other: each split leaves one part and what goes on. Those that lie below come at once,
  // those above after all that follows.
  std::vector<int> above;
  for (std::size_t k = 0; k < partition.splits.size(); ++k) {
    const Partition::Split& split = partition.splits[k];
    proof.steps.push_back(static_cast<std::uint8_t>(Step::split));
    proof.integers.push_back(split.variable);
    proof.reals.push_back(split.where);
    const int part = root + 1 + static_cast<int>(k);
    if (split.part_is_lower) {
      add_leaf(Step::root, part);
    } else {
      above.push_back(part);
    }
  }
  add_leaf(Step::box, static_cast<int>(cover_.boxes.size()) - 1);
  for (auto part = above.rbegin(); part != above.rend(); ++part) add_leaf(Step::root, *part);
  // The searches of the parts follow.
  const auto combination = static_cast<std::int32_t>(proof.combinations.size());
  change_steps(around, [&](std::uint8_t step, std::int32_t* integers) {
    if (static_cast<Step>(step) == Step::newton) integers[0] += combination;
    if (static_cast<Step>(step) == Step::box) integers[0] += first_box;
  });
  std::move(around.roots.begin(), around.roots.end(), std::back_inserter(proof.roots));
  std::move(around.combinations.begin(), around.combinations.end(), std::back_inserter(proof.combinations));
  proof.steps.insert(proof.steps.end(), around.steps.begin(), around.steps.end());
  proof.integers.insert(proof.integers.end(), around.integers.begin(), around.integers.end());
  proof.reals.insert(proof.reals.end(), around.reals.begin(), around.reals.end());
  return root;
}

void CoverEdit::finish() {
  if (fate_.empty()) return;
  fate_.resize(cover_.boxes.size(), kStays);
  std::vector<int> order;
  for (std::size_t i = 0; i < cover_.boxes.size(); ++i)
    if (fate_[i] == kStays) order.push_back(static_cast<int>(i));
  std::vector<int> variables = reduction_.kept;
  for (const auto& definition : reduction_.definitions) variables.push_back(definition.variable);
  std::ranges::sort(order, [&](int i, int k) { return before(cover_.boxes[i], cover_.boxes[k], variables); });
  std::vector<int> place(cover_.boxes.size(), -1);
  std::vector<CoverBox> boxes;
  for (const int i : order) {
    place[i] = static_cast<int>(boxes.size());
    boxes.push_back(std::move(cover_.boxes[i]));
  }
  cover_.boxes = std::move(boxes);
  if (!cover_.proof) return;
  change_steps(proof(), [&](std::uint8_t& step, std::int32_t* index) {
    if (static_cast<Step>(step) != Step::box) return;
    const int by = fate_[*index];
    if (by <= kInRoot) step = static_cast<std::uint8_t>(Step::root);
    *index = by <= kInRoot ? kInRoot - by : place[by == kStays ? *index : by];
  });
  cover_.proof = std::move(proof_);
}

}  // namespace corank::solve
