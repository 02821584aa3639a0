#include <algorithm>
#include <utility>

#include "corank/solve/distribution/cluster.h"
#include "corank/solve/search/passes.h"
#include "corank/solve/store/shard_bytes.h"
#include "corank/solve/store/strata.h"

namespace corank::solve {
namespace {

// Does σ depend on nothing that is found? Then sheets need not travel to be cut.
bool sigma_is_known(const Prepared& prepared) { return prepared.options.asked_length() && prepared.options.asked_angle(); }

void cut_at_once(const Prepared& prepared, const Problem& problem, ShardNumber last_number, std::size_t most,
                 Answer& answer) {
  Control control;
  Tally tally(prepared, control, 0);
  Pool pool(prepared, tally, last_number, &problem);
  pool.set_sigma({*prepared.options.asked_length(), *prepared.options.asked_angle()});
  std::vector<Shard*> shards;
  std::vector<std::vector<Waiting>> left;  // it is not to become pending
  for (Shard& shard : answer.shards) {
    shards.push_back(&shard);
    left.push_back(std::exchange(shard.left, {}));
  }
  pool.cut(shards, most);
  for (std::size_t i = 0; i < shards.size(); ++i) {
    std::erase_if(shards[i]->sheets, [](const Proven& sheet) { return sheet.cut; });
    shards[i]->left = std::move(left[i]);
  }
  for (Shard& shard : pool.take_shards()) answer.shards.push_back(std::move(shard));
}

}  // namespace

UnitRunner::UnitRunner(std::string_view prepared)
    : prepared_(prepared_from(prepared)), problem_(problem_with_strata(prepared_, {})) {
  prepared_.options.max_found = prepared_.options.max_solutions = 0;
}

std::string UnitRunner::run(std::string_view bytes, const Budget& budget) {
  Unit unit = unit_from(bytes, prepared_);
  prepared_.options.threads = std::clamp(budget.threads, 1, kMostUnitThreads);
  Control control({.time = unit.cut ? 0 : budget.seconds, .boxes = unit.cut ? 0 : unit.boxes, .clock = budget.clock});
  Tally tally(prepared_, control, unit.cut ? 0 : budget.boxes);
  const ShardNumber number = unit.id * kNumbersOfUnit;
  Answer answer{unit.id, {}};
  {
    Pool pool(prepared_, tally, number, &problem_);
    if (unit.cut) {
      Shard sheets(0, false);
      sheets.sheets = std::move(unit.sheets);
      pool.set_sigma(unit.sigma);
      pool.cut({&sheets});
    } else {
      pool.set_sigma(sigma_of_search(prepared_, pool.problem()));
      pool.search(unit.work);
    }
    answer.shards = pool.take_shards();
  }
  if (!unit.cut && sigma_is_known(prepared_))
    cut_at_once(prepared_, problem_, number + kMostUnitThreads + 1, budget.found, answer);
  return to_bytes(answer);
}

}  // namespace corank::solve
