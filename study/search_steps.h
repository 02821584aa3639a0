// What study::answer does before and after its search, for those who search elsewhere.
#pragma once

#include <optional>
#include <vector>

#include "corank/solve/search/solve.h"
#include "corank/solve/step/control.h"
#include "corank/study/answer.h"
#include "corank/study/question.h"

namespace corank::study {

/// A question that is ready to be searched.
struct Asked {
  solve::Prepared prepared;
  std::uint64_t processed_before = 0;  ///< boxes, to find out where to search
};

/// Throws solve::OptionError where the options do not go with the system.
void check_options(const solve::Options& options, const System& system);

/// `system`: system(question). Throws as solve::prepare does.
Asked prepare(const Question& question, const System& system, const Options& options, solve::Control& control);

/// `cover`: of solve::solve(asked.prepared). What follows, one after the other.
result::Result finish(const Question& question, const System& system, const Options& options, const Asked& asked,
                      Cover cover, solve::Control& control);

/// What types of singularity are read off, to label boxes with them (solve::label_types); nothing where they get none.
std::optional<VelocityBlocks> type_blocks(const Question& question);
/// Labels types, where there are blocks, and keeps those of the set's own type.
void label(std::optional<symbolic::SingularitySet> set, const std::optional<VelocityBlocks>& blocks,
           const solve::Prepared& prepared, Cover& cover, solve::Control& control);
/// Proves exactly what can be, labels types, finds decimals. Like solve::prepare and solve::solve it knows no model, whose
/// algebra is for one thread alone: several threads may settle covers at once.
void settle(std::optional<symbolic::SingularitySet> set, const std::optional<VelocityBlocks>& blocks, const Options& options,
            const Asked& asked, Cover& cover, solve::Control& control);
/// Puts beside a settled cover what a result says of its question. `ending`: of the control.
result::Result describe(const Question& question, const System& system, const Options& options, Cover cover,
                        const std::optional<solve::Ending>& ending);

/// Of an empty set: can the robot be assembled within its ranges at all? A robot without singularities and one that exists
/// nowhere have the same empty set. Where a result is complete and has no box, fills in Result::assembly: a search of
/// C-space that ends at the first proven configuration, or proves that there is none; and Result::nearly_solved, a hint.
/// Does nothing else, so that other questions cost nothing. Ends with the control, and by itself after a number of boxes:
/// then nothing is known.
void search_assembly(const Question& question, solve::Control& control, result::Result& result);

/// The result of a question from those of its parts (parts_of).
result::Result join(const std::vector<Question>& parts, std::vector<result::Result> results);

/// Nodes are sought in two steps: first the locus, then pairs of its boxes whose locked coordinates may be the same. The
/// search over the whole domain would meet every pair of places before it knows that neither is on the locus. This is what
/// the second one starts from: certify::pairs of the locus's cover.
struct NodeSearch {
  std::vector<Box> roots;       ///< none: the whole domain is to be searched, since the pairs are too many
  std::uint64_t processed = 0;  ///< boxes, for the locus
};

/// `system`: study::system(question), of forward_nodes or inverse_nodes.
NodeSearch node_search(const Question& question, const System& system, const solve::Options& options,
                       solve::Control& control);

}  // namespace corank::study
