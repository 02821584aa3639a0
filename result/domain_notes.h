// What the ranges of a model's coordinates did to a result: which were found from the equations, which ends the set reaches,
// and what keeps boxes `boundary`.
#pragma once

#include "corank/result/result.h"
#include "corank/symbolic/mechanism.h"

namespace corank::result {

/// Fills result.domain for the system that was solved. Does nothing for a result that is of another system.
void describe_domain(const symbolic::Mechanism& mechanism, const System& system, Result& result);

/// "reaches the ends of x, y: not searched beyond", "may reach the end of theta: not searched beyond"; none, one or both.
std::vector<std::string> range_end_sentences(const DomainNotes& notes);

}  // namespace corank::result
