// What study::answer does before and after its search, for those who search elsewhere.
#pragma once

#include <optional>
#include <vector>

#include "corank/solve/exactness/exactness.h"
#include "corank/solve/search/solve.h"
#include "corank/solve/step/control.h"
#include "corank/study/answer.h"
#include "corank/study/question.h"

namespace corank::study {

/// A question that is ready to be searched.
struct Asked {
  solve::Prepared prepared;
  solve::Settling settling;  ///< of what the search finds
};

/// Throws solve::OptionError where the options do not go with the system.
void check_options(const solve::Options& options, const System& system);

/// `system`: system(question). Unless what is found is `settled` later (solve::settle), no types are asked of the model.
/// Throws as solve::prepare does.
Asked prepare(const Question& question, const System& system, const Options& options, solve::Control& control,
              bool settled = true);

/// What boxes are labelled with; nothing where they get no types. `system`: system(question).
std::optional<solve::Labelling> labelling(const Question& question, const System& system);
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
