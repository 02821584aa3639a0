// What a result says, in sentences that claim no more than its verdicts: whether the robot can be assembled within its
// ranges at all, which an empty set alone does not say; what the ranges did to the search; self-motions; cusps and nodes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "corank/result/values/result.h"

namespace corank::result {

/// true: a configuration is proven to exist. false: it is proven that there is none. Nothing: neither is known, or the
/// result is of a plain system.
std::optional<bool> assembled(const Result& result);
/// A configuration that is proven to exist: in the box, in the first `configuration_size` variables of `of`. It is the one
/// over the middle of the free variables' sides, in the region of its proof.
struct Sample {
  const Result* of = nullptr;  ///< the result, or its assembly
  CoverBox box;
};
/// Nothing where assembled() is not true.
std::optional<Sample> sample(const Result& result);
/// What an empty set leaves open: whether the robot can be assembled, with the sample; and what helps where rounded decimals
/// contradict each other. Empty for a set with boxes.
std::vector<std::string> assembly_sentences(const Result& result);

/// Fills result.domain and result.motions for the system that was solved; they are empty for a result of another system. Of
/// each self-motion there is a clause such as "with the input locked at t1 = 0, t2 turns freely: t3 = t2", angles up to full
/// turns. It says what follows exactly from the relations and those of the system's equations that they make linear;
/// "freely" where no other equation is about the coordinate but its circle, and the kernel's.
void describe_in_words(const symbolic::Mechanism& mechanism, const System& system, Result& result);
/// Result::free_coordinates. An equation a·x + g = 0 with a rational a ≠ 0 and an x without a declared range, in no other
/// equation and no inequality, says what x is and nothing of the others. Without such equations, taken away in turns, a
/// coordinate is free where nothing mentions it, or its sine and cosine, but an angle's circle and its range. So is one that
/// the system leaves out and that is one of `joints` (symbolic::Component), not given by others. Of a robot from parts the
/// auxiliary coordinates, vectors of links, have no declared range.
std::vector<std::string> free_coordinates(const symbolic::Mechanism& mechanism, const System& system, bool from_parts,
                                          const std::vector<std::string>& joints);
/// ", for every theta2 and theta3"; nothing where none is free.
std::string free_text(const Result& result);
/// The part of describe_in_words() that is about ranges.
void describe_domain(const symbolic::Mechanism& mechanism, const System& system, Result& result);
/// "reaches the ends of x, y: not searched beyond", "may reach the end of theta: not searched beyond", "the workspace may
/// also end where arm.cuik:9 (range of elbow) is reached"; those that there are.
std::vector<std::string> range_end_sentences(const DomainNotes& notes);
/// "c_t3 = c_t2": a linear relation, solved for the first variable that has the coefficient 1, or the first.
std::string relation_text(const Result& result, const Polynomial& f);
/// What a set of that dimension larger than expected is called: "a self-motion", or where no coordinate moves, only kernel
/// vectors, "a set of kernel vectors". Whole: "a self-motion, of dimension 1: with …".
std::string motion_sentence(const Result& result, std::size_t motion);

/// Of cusps or nodes: "around these 4 cusps assembly modes can be changed without a forward singularity: proven"; of nodes
/// how many there are, and that pairs of configurations closer than symbolic::kNodeDistance were not looked for. Empty for
/// another set.
/// Rests on: an isolated solution of the cusps' system, where its Jacobian has full rank, lies over a cusp of
/// Whitney's, and one of the nodes' system over a transversal crossing (doc/theory.md, "Cusps and nodes"); where a
/// coordinate is held that is not locked, that theorem does not apply, and the sentence says so.
std::string locus_sentence(const Result& result);
/// Of a set of cusps those points that are proven to lie over one of Whitney's, by the theorem that the sentence rests on.
/// None where a coordinate is held to which it does not apply.
std::vector<const CoverBox*> proven_cusps(const Result& result);
/// symbolic::kNodeDistance of a set of nodes.
std::optional<double> node_distance(const Result& result);

}  // namespace corank::result
