#include "corank/solve/assembly.h"

#include <algorithm>
#include <map>
#include <memory>

#include "corank/core/rounding.h"
#include "corank/solve/gathering.h"
#include "corank/solve/points.h"

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
  sort(found);
  if (cover.dimension == 0) {
    const InStage stage(control, Stage::points);
    const Ended overdue = [&control] { return control.overdue(); };
    merge_isolated(found, overdue);
    cover.regions = number_regions(reduction, found);
    cover.points = collect_points(found, problem.limits(kPointGap), overdue);
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
  if (std::any_of(found.begin(), found.end(), [](const Found* f) { return f->box.reason == Reason::degenerate_set; }))
    cover.observed_dimension = motions.observed_dimension();
  for (CoverBox& point : cover.points) point = lifted(prepared.system, reduction, std::move(point));
  std::vector<FoundList*> lists;
  for (Shard* shard : shards) lists.push_back(&shard->found);
  cover.boxes = take_lifted(prepared.system, reduction, std::move(found), lists);
  return cover;
}

}  // namespace corank::solve
