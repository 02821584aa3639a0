// A run whose searches are cut into units (solve/distribution/cluster.h) that somebody else gets done, wherever: what
// study::answer does with its own threads.
//
//   SpreadRun run(question, options, &stop);
//   while (run.finished() < run.searches()) {
//     solve::Coordinator& search = run.begin();
//     … until search.done() or search.ended()
//     run.finish();
//   }
//   result::Result result = run.result();
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "corank/result/files/checkpoint.h"
#include "corank/solve/distribution/cluster.h"
#include "corank/study/answer.h"
#include "corank/study/search_steps.h"

namespace corank::study {

class SpreadRun {
 public:
  /// Derives the systems. Limits of what is found are refused (solve::OptionError); time counts from here on. Throws as
  /// answer() does. `stop`, where given, ends what this object does itself.
  SpreadRun(const Question& question, Options options, const std::atomic<bool>* stop = nullptr);

  /// Until the limit of time; infinite where there is none.
  double seconds_left() const { return control_.seconds_left(); }
  std::size_t searches() const { return systems_.parts.size(); }
  std::size_t finished() const { return results_.size(); }
  /// The next search, from a state on where one is given. Throws solve::ShardError where the state is none of it.
  solve::Coordinator& begin(std::optional<std::string> state = {});
  /// The one that has begun.
  solve::Coordinator& search();
  /// Its state goes into the result, from which the run can go on, unless it is very large; `checkpoint` is without it.
  void keep_state(const result::Checkpoint& checkpoint);
  /// Its cover becomes a result: proves exactly what can be. The search is done, or has ended, and is forgotten.
  void finish();
  /// Of a run of which everything is finished.
  result::Result result();

 private:
  const Options options_;
  solve::Control control_;
  Systems systems_;
  std::optional<Asked> asked_;
  std::unique_ptr<solve::Coordinator> search_;
  std::vector<result::Result> results_;
  std::string kept_;  // result::Result::search
};

}  // namespace corank::study
