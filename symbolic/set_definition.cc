#include "corank/symbolic/set_definition.h"

#include <algorithm>
#include <vector>

namespace corank::symbolic {
namespace {

constexpr std::array kInput{Role::input}, kOutput{Role::output};
constexpr std::array kBoth{Role::input, Role::output};

// Colours of a page are Okabe and Ito's vermilion and blue, which the colour-blind tell apart.
constexpr std::array<SetDefinition, 17> kSets{{
    {.set = SingularitySet::cspace,
     .name = "cspace",
     .title = "C-space",
     .member = "C-space",
     .label = "C-space",
     .meaning = "every way to assemble the mechanism",
     .of_corank = "",
     .none = "The mechanism cannot be assembled within the search domain.",
     .print = {0.55, 0.56, 0.58},
     .on_light = "#606670",
     .on_dark = "#acb4c0",
     .layer = 0,
     .dot = 6.2},
    {.set = SingularitySet::forward,
     .name = "forward",
     .matrix = "L_y",
     .locked = kInput,
     .side = KernelSide::right,
     .title = "Forward singularities",
     .member = "Forward singularity",
     .label = "forward locus",
     .meaning = "with the actuators locked the mechanism can still move, to first order",
     .of_corank = "with the actuators locked the mechanism can still move, to first order, in at least {} independent ways",
     .none = "There are none in the search domain.",
     .print = {0.80, 0.11, 0.14},
     .on_light = "#d1480a",
     .on_dark = "#ff8552",
     .layer = 2,
     .dot = 3.8},
    {.set = SingularitySet::inverse,
     .name = "inverse",
     .matrix = "L_z",
     .locked = kOutput,
     .side = KernelSide::right,
     .title = "Inverse singularities",
     .member = "Inverse singularity",
     .label = "inverse locus",
     .meaning = "with the output locked the mechanism can still move, to first order",
     .of_corank = "with the output locked the mechanism can still move, to first order, in at least {} independent ways",
     .none = "There are none in the search domain.",
     .print = {0.09, 0.33, 0.75},
     .on_light = "#0a6fb8",
     .on_dark = "#58b4f5",
     .layer = 1,
     .dot = 6.2},
    {.set = SingularitySet::cspace_singular,
     .name = "cspace-singular",
     .matrix = "Phi_q",
     .side = KernelSide::left,
     .title = "C-space singularities",
     .member = "C-space singularity",
     .label = "C-space singularities",
     .meaning = "the constraints’ Jacobian loses rank: C-space may cross itself or end in a cusp",
     .of_corank = "the rank of the constraints’ Jacobian drops by at least {}",
     .none = "There are none in the search domain, so C-space is smooth there.",
     .given_meaning =
         "the velocity equation loses rank: to first order the mechanism can move in more ways than its mobility says",
     .given_of_corank = "the rank of the velocity equation drops by at least {}",
     .given_none = "There are none in the search domain: the velocity equation has full rank there.",
     .print = {0.52, 0.18, 0.68},
     .on_light = "#7a3fb0",
     .on_dark = "#c39af0",
     .layer = 3,
     .dot = 6.2},
    {.set = SingularitySet::boundary,
     .name = "boundary",
     .matrix = "Phi_z",
     .locked = kOutput,
     .side = KernelSide::left,
     .title = "Workspace boundary",
     .member = "Boundary configuration",
     .label = "workspace boundary",
     .meaning = "within its limits the output cannot move in some direction, to first order",
     .of_corank = "within its limits the output cannot move, to first order, in at least {} independent directions",
     .none = "There are none in the search domain.",
     .print = {0.05, 0.42, 0.36},
     .on_light = "#00765f",
     .on_dark = "#35c4a5",
     .layer = 20,
     .dot = 5,
     .of_parts = true},
    {.set = SingularitySet::forward_inverse,
     .name = "forward-inverse",
     .matrix = "L_y",
     .locked = kInput,
     .side = KernelSide::right,
     .one_side = true,
     .also_locked = kOutput,
     .also_matrix = "L_z",
     .title = "Forward and inverse singularities",
     .member = "Forward and inverse singularity",
     .label = "forward and inverse",
     .meaning = "singular in both ways: the mechanism can move, to first order, with the actuators locked and with the "
                "output locked",
     .of_corank = "",
     .none = "There are none in the search domain: no configuration is singular in both ways.",
     .print = {0.45, 0.20, 0.30},
     .on_light = "#8a4a00",
     .on_dark = "#e0a060",
     .layer = 4,
     .dot = 5.0},
    {.set = SingularitySet::ro,
     .name = "ro",
     .matrix = "L_y",
     .locked = kInput,
     .side = KernelSide::right,
     .one_side = true,
     .type = SingularityType::ro,
     .title = "Redundant output",
     .member = "Redundant output (RO)",
     .label = "redundant output",
     .meaning = "with the actuators locked the output can still move, to first order; the set holds all of these "
                "configurations, and others only in boxes whose type is not known",
     .of_corank = "the same, in at least {} independent ways",
     .none = "There are none in the search domain: locked actuators hold the output.",
     .print = {0.80, 0.11, 0.14},
     .on_light = "#d1480a",
     .on_dark = "#ff8552",
     .layer = 5,
     .dot = 3.8},
    {.set = SingularitySet::rpm,
     .name = "rpm",
     .matrix = "L_p",
     .locked = kBoth,
     .side = KernelSide::right,
     .one_side = true,
     .type = SingularityType::rpm,
     .title = "Redundant passive motion",
     .member = "Redundant passive motion (RPM)",
     .label = "redundant passive motion",
     .meaning = "with the actuators and the output locked passive joints can still move, to first order",
     .of_corank = "with the actuators and the output locked passive joints can still move, to first order, in at least {} "
                  "independent ways",
     .none = "There are none in the search domain: actuators and output together hold every passive joint.",
     .print = {0.60, 0.45, 0.05},
     .on_light = "#8a6d00",
     .on_dark = "#e0c040",
     .layer = 6,
     .dot = 5.0},
    {.set = SingularitySet::ii,
     .name = "ii",
     .matrix = "L_y",
     .locked = kInput,
     .side = KernelSide::left,
     .one_side = true,
     .type = SingularityType::ii,
     .title = "Impossible input",
     .member = "Impossible input (II)",
     .label = "impossible input",
     .meaning =
         "the actuators cannot achieve some velocity; the set holds all of these configurations, and others only in boxes "
         "whose type is not known",
     .of_corank = "the same, and the kernel has dimension {} or more",
     .none = "There are none in the search domain: the actuators can achieve every velocity.",
     .print = {0.80, 0.11, 0.14},
     .on_light = "#d1480a",
     .on_dark = "#ff8552",
     .layer = 7,
     .dot = 3.8},
    {.set = SingularitySet::ri,
     .name = "ri",
     .matrix = "L_z",
     .locked = kOutput,
     .side = KernelSide::right,
     .one_side = true,
     .type = SingularityType::ri,
     .title = "Redundant input",
     .member = "Redundant input (RI)",
     .label = "redundant input",
     .meaning = "the actuators can move, to first order, while the output stands still; the set holds all of these "
                "configurations, and others only in boxes whose type is not known",
     .of_corank = "the same, in at least {} independent ways",
     .none = "There are none in the search domain: if the output stands still, so do the actuators.",
     .print = {0.09, 0.33, 0.75},
     .on_light = "#0a6fb8",
     .on_dark = "#58b4f5",
     .layer = 8,
     .dot = 6.2},
    {.set = SingularitySet::io,
     .name = "io",
     .matrix = "L_z",
     .locked = kOutput,
     .side = KernelSide::left,
     .one_side = true,
     .type = SingularityType::io,
     .title = "Impossible output",
     .member = "Impossible output (IO)",
     .label = "impossible output",
     .meaning =
         "the output cannot achieve some velocity; the set holds all of these configurations, and others only in boxes "
         "whose type is not known",
     .of_corank = "the same, and the kernel has dimension {} or more",
     .none = "There are none in the search domain: the output can achieve every velocity.",
     .print = {0.09, 0.33, 0.75},
     .on_light = "#0a6fb8",
     .on_dark = "#58b4f5",
     .layer = 9,
     .dot = 6.2},
    {.set = SingularitySet::iim,
     .name = "iim",
     .matrix = "Phi_q",
     .side = KernelSide::left,
     .one_side = true,
     .type = SingularityType::iim,
     .title = "Increased instantaneous mobility",
     .member = "Increased instantaneous mobility (IIM)",
     .label = "increased mobility",
     .meaning =
         "the velocity equation loses rank: to first order the mechanism can move in more ways than its mobility says",
     .of_corank = "the rank of the velocity equation drops by at least {}",
     .none = "There are none in the search domain: the velocity equation has full rank there.",
     .print = {0.52, 0.18, 0.68},
     .on_light = "#7a3fb0",
     .on_dark = "#c39af0",
     .layer = 10,
     .dot = 6.2},
    {.set = SingularitySet::forward_cusps,
     .name = "forward-cusps",
     .matrix = "L_y",
     .locked = kInput,
     .side = KernelSide::right,
     .part = LocusPart::cusps,
     .title = "Cusps of the forward locus",
     .member = "Cusp of the forward locus",
     .label = "forward cusps",
     .meaning = "where the locus has a cusp among the inputs: around it the assembly mode can change without a singularity",
     .of_corank = "",
     .none = "The locus has no cusp among the inputs in the search domain. The assembly mode may still change without a "
             "singularity in another way.",
     .print = {0.52, 0.05, 0.09},
     .on_light = "#8a2b00",
     .on_dark = "#ffb08a",
     .layer = 14,
     .dot = 7.5},
    {.set = SingularitySet::inverse_cusps,
     .name = "inverse-cusps",
     .matrix = "L_z",
     .locked = kOutput,
     .side = KernelSide::right,
     .part = LocusPart::cusps,
     .title = "Cusps of the inverse locus",
     .member = "Cusp of the inverse locus",
     .label = "inverse cusps",
     .meaning = "where the locus has a cusp among the outputs: around it the posture can change without a singularity",
     .of_corank = "",
     .none = "The locus has no cusp among the outputs in the search domain. The posture may still change without a "
             "singularity in another way.",
     .print = {0.04, 0.18, 0.48},
     .on_light = "#063f70",
     .on_dark = "#a5d8ff",
     .layer = 13,
     .dot = 7.5},
    {.set = SingularitySet::forward_nodes,
     .name = "forward-nodes",
     .matrix = "L_y",
     .locked = kInput,
     .side = KernelSide::right,
     .part = LocusPart::nodes,
     .title = "Nodes of the forward locus",
     .member = "Node of the forward locus",
     .label = "forward nodes",
     .meaning = "where the locus crosses itself among the inputs: two singular configurations with the same "
                "inputs",
     .of_corank = "",
     .none = "The locus does not cross itself among the inputs in the search domain, except perhaps at pairs of "
             "configurations that are too close to be told apart.",
     .print = {0.62, 0.36, 0.10},
     .on_light = "#7a5200",
     .on_dark = "#e8c07a",
     .layer = 12,
     .dot = 7.5},
    {.set = SingularitySet::inverse_nodes,
     .name = "inverse-nodes",
     .matrix = "L_z",
     .locked = kOutput,
     .side = KernelSide::right,
     .part = LocusPart::nodes,
     .title = "Nodes of the inverse locus",
     .member = "Node of the inverse locus",
     .label = "inverse nodes",
     .meaning = "where the locus crosses itself among the outputs: two singular configurations with the same "
                "outputs",
     .of_corank = "",
     .none = "The locus does not cross itself among the outputs in the search domain, except perhaps at pairs of "
             "configurations that are too close to be told apart.",
     .print = {0.05, 0.42, 0.45},
     .on_light = "#00666b",
     .on_dark = "#7fdde0",
     .layer = 11,
     .dot = 7.5},
    {.set = std::nullopt,
     .name = "system",
     .title = "Solutions",
     .member = "Solution",
     .label = "",
     .meaning = "the solutions of the system",
     .of_corank = "",
     .none = "There are none in the search domain.",
     .print = {0.35, 0.45, 0.58},
     .on_light = "#59738f",
     .on_dark = "#9db2c9"},
}};

}  // namespace

const char* to_string(SingularitySet set) { return definition(set).name; }

const char* to_string(KernelSide side) { return side == KernelSide::right ? "right" : "left"; }

const char* to_string(Role role) { return role == Role::input ? "input" : role == Role::output ? "output" : "passive"; }

std::optional<SingularitySet> singularity_set_from_string(const std::string& text) { return definition(text).set; }

std::optional<KernelSide> kernel_side_from_string(const std::string& text) {
  for (const KernelSide side : {KernelSide::right, KernelSide::left})
    if (text == to_string(side)) return side;
  return std::nullopt;
}

std::span<const SetDefinition> set_definitions() { return std::span(kSets).first(kSets.size() - 1); }

const SetDefinition& definition(std::optional<SingularitySet> set) {
  return *std::find_if(kSets.begin(), kSets.end() - 1, [&](const SetDefinition& d) { return d.set == set; });
}

const SetDefinition& definition(const std::string& name) {
  return *std::find_if(kSets.begin(), kSets.end() - 1, [&](const SetDefinition& d) { return name == d.name; });
}

std::string names_of_sets(bool with_corank_only) {
  std::vector<std::string> names;
  for (const SetDefinition& d : set_definitions())
    if ((d.has_kernel() && !d.of_parts) || !with_corank_only) names.emplace_back(d.name);
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : &name == &names.back() ? " or " : ", ") + name;
  return text;
}

std::string set_with_corank(const std::string& set, int corank) {
  return corank == 1 ? set : set + " singularities of corank " + std::to_string(corank);
}

}  // namespace corank::symbolic
