#include "corank/study/spread_run.h"

#include <utility>

#include "corank/core/check.h"
#include "corank/solve/shard_bytes.h"

namespace corank::study {
namespace {

// A unit does not know what others have found, so that no limit could hold all of them.
const Options& without_limits(const Options& options) {
  const solve::Options& o = options.search;
  const auto refuse = [](const char* option) {
    throw solve::OptionError(option,
                             "a search on a cluster has no such limit; it is ended by Ctrl-C, and goes on from its "
                             "checkpoint");
  };
  o.validate();
  if (o.max_boxes > 0) refuse("max_boxes");
  if (o.max_found > 0) refuse("max_found");
  if (o.max_solutions > 0) refuse("max_solutions");
  if (o.time_limit > 0) refuse("time_limit");
  return options;
}

}  // namespace

SpreadRun::SpreadRun(const Question& question, Options options, const std::atomic<bool>* stop)
    : options_(without_limits(options)), control_(limits_of(options_.search, stop)) {
  const solve::InStage stage(control_, solve::Stage::model);
  parts_ = parts_of(question);
  for (const Question& part : parts_) {
    systems_.push_back(system(part));
    options_.search.validate(systems_.back());
    if (options_.search.proof && systems_.back().coefficient_tolerance > 0)
      throw solve::OptionError("proof",
                               "there is none for coefficients with a tolerance; a tolerance of 0 takes them as exact");
  }
}

solve::Coordinator& SpreadRun::begin(std::optional<std::string> state) {
  CORANK_CHECK(!search_ && finished() < searches());
  asked_ = study::prepare(parts_[finished()], systems_[finished()], options_, control_);
  search_ = std::make_unique<solve::Coordinator>(solve::to_bytes(asked_->prepared), std::move(state));
  return *search_;
}

solve::Coordinator& SpreadRun::search() {
  CORANK_CHECK(search_);
  return *search_;
}

void SpreadRun::finish() {
  CORANK_CHECK(search_ && search_->done());
  const std::size_t i = finished();
  results_.push_back(study::finish(parts_[i], systems_[i], options_, *asked_, search_->assemble(control_), control_));
  search_.reset();
  asked_.reset();
}

result::Result SpreadRun::result() {
  CORANK_CHECK(finished() == searches());
  return join(parts_, std::exchange(results_, {}));
}

}  // namespace corank::study
