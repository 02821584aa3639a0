#include "corank/study/spread_run.h"

#include <ostream>
#include <utility>

#include "corank/core/check.h"
#include "corank/solve/store/shard_bytes.h"
#include "corank/study/run_journal.h"

namespace corank::study {
namespace {

// A unit does not know which solutions others have found. What is done here is done by all threads; units have their own.
Options of_cluster(Options options) {
  solve::Options& o = options.search;
  const auto refuse = [](const char* option) {
    throw solve::OptionError(option,
                             "a search on a cluster does not have this limit; expected limits of time, boxes or memory");
  };
  o.validate();
  if (o.max_found > 0) refuse("max_found");
  if (o.max_solutions > 0) refuse("max_solutions");
  o.threads = 0;
  return options;
}

}  // namespace

SpreadRun::SpreadRun(const Question& question, Options options, const std::atomic<bool>* stop)
    : options_(of_cluster(options)), control_(limits_of(options_.search, stop)), systems_(systems_of(question, control_)) {
  for (const System& system : systems_.of_parts) check_options(options_.search, system);
}

solve::Coordinator& SpreadRun::begin(std::optional<std::string> state) {
  CORANK_CHECK(!search_ && finished() < searches());
  asked_ = study::prepare(systems_.parts[finished()], systems_.of_parts[finished()], options_, control_);
  search_ = std::make_unique<solve::Coordinator>(solve::to_bytes(asked_->prepared), std::move(state), &control_);
  return *search_;
}

solve::Coordinator& SpreadRun::search() {
  CORANK_CHECK(search_);
  return *search_;
}

void SpreadRun::finish() {
  CORANK_CHECK(search_ && (search_->done() || search_->ended()));
  const std::size_t i = finished();
  Cover cover = search_->assemble(control_);
  search_.reset();  // its memory is not counted any more
  solve::settle(asked_->prepared, asked_->settling, cover, control_);
  results_.push_back(describe(systems_.parts[i], systems_.of_parts[i], options_, std::move(cover), control_.ending()));
  asked_.reset();
}

void SpreadRun::keep_state(const result::Checkpoint& checkpoint) {
  const std::string state = search().state();
  if (state.size() >= RunJournal::Plan{}.most_in_result) return;
  kept_ = result::checkpoint_bytes(solve::engine_version(), checkpoint, [&state](std::ostream& out) { out << state; });
}

result::Result SpreadRun::result() {
  CORANK_CHECK(finished() == searches());
  result::Result whole = join(systems_.parts, std::exchange(results_, {}));
  search_assembly(systems_.parts.front(), control_, whole);
  whole.search = std::move(kept_);
  return whole;
}

}  // namespace corank::study
