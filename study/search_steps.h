// What study::answer does before and after its search, for those who search elsewhere.
#pragma once

#include <vector>

#include "corank/study/answer.h"
#include "corank/study/node_search.h"

namespace corank::study {

/// A question that is ready to be searched.
struct Asked {
  solve::Prepared prepared;
  std::uint64_t processed_before = 0;  ///< boxes, to find out where to search
};

/// `system`: system(question). Throws as solve::prepare does.
Asked prepare(const Question& question, const System& system, const Options& options, solve::Control& control);

/// `cover`: of solve::solve(asked.prepared).
result::Result finish(const Question& question, const System& system, const Options& options, const Asked& asked,
                      Cover cover, solve::Control& control);

/// The result of a question from those of its parts (parts_of).
result::Result join(const std::vector<Question>& parts, std::vector<result::Result> results);

}  // namespace corank::study
