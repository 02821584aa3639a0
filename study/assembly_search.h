// Of an empty set: can the robot be assembled within its ranges at all? A robot without singularities and one that exists
// nowhere have the same empty set.
#pragma once

#include "corank/result/result.h"
#include "corank/solve/control.h"
#include "corank/study/question.h"

namespace corank::study {

/// Where a result is complete and has no box, fills in Result::assembly: a search of C-space that ends at the first proven
/// configuration, or proves that there is none; and Result::nearly_solved, a hint. Does nothing else, so that other
/// questions cost nothing. Ends with the control, and by itself after so many boxes: then nothing is known.
void search_assembly(const Question& question, solve::Control& control, result::Result& result);

}  // namespace corank::study
