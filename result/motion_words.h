// Self-motions in words: which coordinates stay, which moves freely, which follow.
#pragma once

#include <string>

#include "corank/result/result.h"
#include "corank/symbolic/mechanism.h"

namespace corank::result {

/// Fills result.motions for the system that was solved: of each self-motion a clause such as "with the input locked at t1 =
/// 0, t2 turns freely: t3 = t2", angles up to full turns. It says what follows exactly from the relations and those of the
/// system's equations that they make linear; "freely" where no other equation is about the coordinate but its circle, and
/// the kernel's. Does nothing for a result that is of another system.
void describe_motions(const symbolic::Mechanism& mechanism, const System& system, Result& result);

/// describe_domain() and describe_motions().
void describe_in_words(const symbolic::Mechanism& mechanism, const System& system, Result& result);

/// "c_t3 = c_t2": a linear relation, solved for the first variable that has the coefficient 1, or the first.
std::string relation_text(const Result& result, const Polynomial& f);

/// What a set of that dimension larger than expected is called: "a self-motion", or where no coordinate moves, only kernel
/// vectors, "a set of kernel vectors". Whole: "a self-motion, of dimension 1: with …".
std::string motion_sentence(const Result& result, std::size_t motion);

}  // namespace corank::result
