#include "corank/symbolic/set_definition.h"

#include <algorithm>
#include <vector>

namespace corank::symbolic {
namespace {

constexpr std::array kInput{Role::input}, kOutput{Role::output};

// Colours of a page are Okabe and Ito's vermilion and blue, which the colour-blind tell apart.
constexpr std::array<SetDefinition, 6> kSets{{
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
     .none = "There is none in the search domain.",
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
     .none = "There is none in the search domain.",
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
     .of_corank = "the constraints’ Jacobian loses at least {} of its ranks",
     .none = "There is none in the search domain, so C-space is smooth there.",
     .given_meaning =
         "the velocity equation loses rank: to first order the mechanism can move in more ways than its mobility says",
     .given_of_corank = "the velocity equation loses at least {} of its ranks",
     .given_none = "There is none in the search domain: the velocity equation has full rank there.",
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
     .none = "There is none in the search domain.",
     .print = {0.05, 0.42, 0.36},
     .on_light = "#00765f",
     .on_dark = "#35c4a5",
     .layer = 4,
     .dot = 5,
     .of_parts = true},
    {.set = std::nullopt,
     .name = "system",
     .title = "Solutions",
     .member = "Solution",
     .label = "",
     .meaning = "the solutions of the system",
     .of_corank = "",
     .none = "There is none in the search domain.",
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
