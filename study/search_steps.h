// What study::answer does before and after its search, for those who search elsewhere.
#pragma once

#include <optional>
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

/// `cover`: of solve::solve(asked.prepared). What follows, one after the other.
result::Result finish(const Question& question, const System& system, const Options& options, const Asked& asked,
                      Cover cover, solve::Control& control);

/// What types of singularity are read off, to label boxes with them (solve::label_types); nothing where they get none.
std::optional<VelocityBlocks> type_blocks(const Question& question);
/// Proves exactly what can be, labels types, finds decimals. Like solve::prepare and solve::solve it knows no model, whose
/// algebra is for one thread alone: several threads may settle covers at once.
void settle(std::optional<symbolic::SingularitySet> set, const std::optional<VelocityBlocks>& blocks, const Options& options,
            const Asked& asked, Cover& cover, solve::Control& control);
/// Puts beside a settled cover what a result says of its question. `ending`: of the control.
result::Result describe(const Question& question, const System& system, const Options& options, Cover cover,
                        const std::optional<solve::Ending>& ending);

/// The result of a question from those of its parts (parts_of).
result::Result join(const std::vector<Question>& parts, std::vector<result::Result> results);

}  // namespace corank::study
