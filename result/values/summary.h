// What a result says, short: a table for people and a JSON object for programs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "corank/result/values/result.h"
#include "corank/symbolic/model/mechanism.h"
#include "corank/symbolic/sets/left_out.h"
#include "corank/symbolic/sets/singularity_system.h"

namespace corank::result {

/// Along what boxes with Reason::degenerate_set lie; where that is larger than expected, of which dimension, and
/// why it is not proven.
std::string along_set_text(const Result& result);

/// The σ of a search, as tables say it.
std::string sigma_text(const Sigma& sigma);

/// A few lines for a terminal: the set, its verdicts, and the points of a set of dimension 0 (configuration only,
/// angles in radians, bounds rounded outward).
std::string to_table(const Result& result);

/// One object: model, set, system{variables, equations, inequalities, dimension}, options{…}, complete, stopped (null, or by
/// what and in which stage), boxes{processed, regular, isolated, exact, boundary, partial, undecided, pending},
/// parts_of_sheets (boxes), undecided_reasons{reason: boxes}, observed_dimension, self_motions[{dimension, boxes, relations,
/// text}], boundary_reasons, range_ends, ranges_found, tolerances, points, meaning, node_distance, kernel,
/// free_coordinates, seconds{total, search, certify}, version. Every double reads back as the same double; sigma is null
/// where it is infinite.
///
/// `free_coordinates` lists those that take every value in their ranges, whatever the others are (Result).
/// `observed_dimension` is null, or that of a set along which boxes stayed undecided, as samples show, where it is larger
/// than expected: no claim. `boundary_reasons` is a list of {reason, boxes}: what `boundary` boxes are not shown to be
/// inside of. `range_ends` is a list of {variable, reached}: declared ranges whose ends the set reaches (proven), or may
/// reach. `ranges_found` has name: {lo, hi} of each variable without a declared range. `points` is null where the
/// dimension is not 0, else a list of {values{name: {lo, hi}}, verdict}: lengths and kernel unknowns as they are, angles
/// in radians in place of their sines and cosines; of a robot from parts also joints{name: value} and links{name:
/// {position, rotation}}, poses in the world at the middle of the point's box. `meaning` is null, or what cusps or nodes
/// say of the robot (sentences.h); `node_distance` is null, or how far apart the two configurations of a node are at
/// least, whose values stand side by side: x and x_2. `kernel` is null where its dimension is not known, else
/// at_most{bound: boxes}, without undecided boxes that hold no known point, and points, where the dimension is known to
/// be 2 or more: a list of {dimension, exact{name: text}}.
///
/// `types` is null where none were asked for, else RO, RPM, II, RI, IO, IIM: boxes in which every solution is of the type
/// (null: of no interest in this mechanism), and unproven: boxes that may hold no solution, or where a type that makes up
/// the set is neither proven nor excluded. A point has the list `types` of those that are proven, and `typed`. `left_out`,
/// where there are such: boxes of the kernel's set without a solution of the type that the set is of. Of a workspace
/// boundary: boundary{barrier, traversable, unproven, outputs}, in boxes, parts[{part, boxes, verdicts, boundary,
/// seconds}], and area{lo, hi} where that was found; it is no part of the result.
std::string to_json(const Result& result, const std::optional<Interval>& area = std::nullopt);

/// {"model", "robot", "constants", "coordinates", "inputs", "outputs", "constraints", "velocity", "left_out", "set",
/// "systems"}: the constraints, velocity equation and systems of a set, each expression in the model language. `robot`: of
/// parts, what they make. Without systems only the model's own members. `left_out`: what a robot's equations go without;
/// each follows from the constraints and rows with these numbers, from 1.
std::string derivation_json(const symbolic::Mechanism& mechanism, const std::optional<std::string>& robot,
                            const std::vector<symbolic::LeftOut>& left_out, const std::string& set,
                            const std::vector<symbolic::TrigonometricSystem>& systems);

}  // namespace corank::result
