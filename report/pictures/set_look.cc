#include "corank/report/pictures/set_look.h"

#include <algorithm>
#include <array>

namespace corank::report {
namespace {

using symbolic::SingularitySet;

// Colours of a page are Okabe and Ito's vermilion and blue, which the colour-blind tell apart.
constexpr Paint kVermilion{{0.80, 0.11, 0.14}, "#d1480a", "#ff8552"};
constexpr Paint kBlue{{0.09, 0.33, 0.75}, "#0a6fb8", "#58b4f5"};
constexpr Paint kPurple{{0.52, 0.18, 0.68}, "#7a3fb0", "#c39af0"};

constexpr std::array<SetLook, 18> kLooks{{
    {.set = SingularitySet::cspace,
     .title = "C-space",
     .member = "C-space",
     .label = "C-space",
     .meaning = "every way to assemble the mechanism",
     .none = "The mechanism cannot be assembled within the search domain.",
     .drawn = {{{0.55, 0.56, 0.58}, "#606670", "#acb4c0"}, 0}},
    {.set = SingularitySet::forward,
     .title = "Forward singularities",
     .member = "Forward singularity",
     .label = "forward locus",
     .meaning = "with the actuators locked the mechanism can still move, to first order",
     .of_corank = "with the actuators locked the mechanism can still move, to first order, in at least {} independent ways",
     .drawn = {kVermilion, 2, 3.8}},
    {.set = SingularitySet::inverse,
     .title = "Inverse singularities",
     .member = "Inverse singularity",
     .label = "inverse locus",
     .meaning = "with the output locked the mechanism can still move, to first order",
     .of_corank = "with the output locked the mechanism can still move, to first order, in at least {} independent ways",
     .drawn = {kBlue, 1}},
    {.set = SingularitySet::cspace_singular,
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
     .drawn = {kPurple, 3}},
    {.set = SingularitySet::boundary,
     .title = "Workspace boundary",
     .member = "Boundary configuration",
     .label = "workspace boundary",
     .meaning = "within its limits the output cannot move in some direction, to first order",
     .of_corank = "within its limits the output cannot move, to first order, in at least {} independent directions",
     .drawn = {{{0.05, 0.42, 0.36}, "#00765f", "#35c4a5"}, 20, 5}},
    {.set = SingularitySet::forward_inverse,
     .title = "Forward and inverse singularities",
     .member = "Forward and inverse singularity",
     .label = "forward and inverse",
     .meaning = "singular in both ways: the mechanism can move, to first order, with the actuators locked and with the "
                "output locked",
     .none = "There are none in the search domain: no configuration is singular in both ways.",
     .drawn = {{{0.45, 0.20, 0.30}, "#8a4a00", "#e0a060"}, 4, 5.0}},
    {.set = SingularitySet::ro,
     .title = "Redundant output",
     .member = "Redundant output (RO)",
     .label = "redundant output",
     .meaning = "with the actuators locked the output can still move, to first order; the set holds all of these "
                "configurations, and others only in boxes whose type is not known",
     .of_corank = "the same, in at least {} independent ways",
     .none = "There are none in the search domain: locked actuators hold the output.",
     .drawn = {kVermilion, 5, 3.8}},
    {.set = SingularitySet::rpm,
     .title = "Redundant passive motion",
     .member = "Redundant passive motion (RPM)",
     .label = "redundant passive motion",
     .meaning = "with the actuators and the output locked passive joints can still move, to first order",
     .of_corank = "with the actuators and the output locked passive joints can still move, to first order, in at least {} "
                  "independent ways",
     .none = "There are none in the search domain: actuators and output together hold every passive joint.",
     .drawn = {{{0.60, 0.45, 0.05}, "#8a6d00", "#e0c040"}, 6, 5.0}},
    {.set = SingularitySet::ii,
     .title = "Impossible input",
     .member = "Impossible input (II)",
     .label = "impossible input",
     .meaning =
         "the actuators cannot achieve some velocity; the set holds all of these configurations, and others only in boxes "
         "whose type is not known",
     .of_corank = "the same, and the kernel has dimension {} or more",
     .none = "There are none in the search domain: the actuators can achieve every velocity.",
     .drawn = {kVermilion, 7, 3.8}},
    {.set = SingularitySet::ri,
     .title = "Redundant input",
     .member = "Redundant input (RI)",
     .label = "redundant input",
     .meaning = "the actuators can move, to first order, while the output stands still; the set holds all of these "
                "configurations, and others only in boxes whose type is not known",
     .of_corank = "the same, in at least {} independent ways",
     .none = "There are none in the search domain: if the output stands still, so do the actuators.",
     .drawn = {kBlue, 8}},
    {.set = SingularitySet::io,
     .title = "Impossible output",
     .member = "Impossible output (IO)",
     .label = "impossible output",
     .meaning =
         "the output cannot achieve some velocity; the set holds all of these configurations, and others only in boxes "
         "whose type is not known",
     .of_corank = "the same, and the kernel has dimension {} or more",
     .none = "There are none in the search domain: the output can achieve every velocity.",
     .drawn = {kBlue, 9}},
    {.set = SingularitySet::iim,
     .title = "Increased instantaneous mobility",
     .member = "Increased instantaneous mobility (IIM)",
     .label = "increased mobility",
     .meaning =
         "the velocity equation loses rank: to first order the mechanism can move in more ways than its mobility says",
     .of_corank = "the rank of the velocity equation drops by at least {}",
     .none = "There are none in the search domain: the velocity equation has full rank there.",
     .drawn = {kPurple, 10}},
    {.set = SingularitySet::requirements,
     .title = "Limits of requirements",
     .member = "Configuration at a limit",
     .label = "limits of requirements",
     .meaning = "a requirement reaches its limit: on a path without such a configuration, what is met once is met all along",
     .of_corank = "requirements reach their limits in at least {} independent ways",
     .none = "There are none in the search domain: no motion changes whether a requirement is met.",
     .drawn = {{{0.85, 0.55, 0.0}, "#a86f00", "#ffc04d"}, 15, 4.2}},
    {.set = SingularitySet::forward_cusps,
     .title = "Cusps of the forward locus",
     .member = "Cusp of the forward locus",
     .label = "forward cusps",
     .meaning = "where the locus has a cusp among the inputs: around it the assembly mode can change without a singularity",
     .none = "The locus has no cusp among the inputs in the search domain. The assembly mode may still change without a "
             "singularity in another way.",
     .drawn = {{{0.52, 0.05, 0.09}, "#8a2b00", "#ffb08a"}, 14, 7.5}},
    {.set = SingularitySet::inverse_cusps,
     .title = "Cusps of the inverse locus",
     .member = "Cusp of the inverse locus",
     .label = "inverse cusps",
     .meaning = "where the locus has a cusp among the outputs: around it the posture can change without a singularity",
     .none = "The locus has no cusp among the outputs in the search domain. The posture may still change without a "
             "singularity in another way.",
     .drawn = {{{0.04, 0.18, 0.48}, "#063f70", "#a5d8ff"}, 13, 7.5}},
    {.set = SingularitySet::forward_nodes,
     .title = "Nodes of the forward locus",
     .member = "Node of the forward locus",
     .label = "forward nodes",
     .meaning = "where the locus crosses itself among the inputs: two singular configurations with the same "
                "inputs",
     .none = "The locus does not cross itself among the inputs in the search domain, except perhaps at pairs of "
             "configurations that are too close to be told apart.",
     .drawn = {{{0.62, 0.36, 0.10}, "#7a5200", "#e8c07a"}, 12, 7.5}},
    {.set = SingularitySet::inverse_nodes,
     .title = "Nodes of the inverse locus",
     .member = "Node of the inverse locus",
     .label = "inverse nodes",
     .meaning = "where the locus crosses itself among the outputs: two singular configurations with the same "
                "outputs",
     .none = "The locus does not cross itself among the outputs in the search domain, except perhaps at pairs of "
             "configurations that are too close to be told apart.",
     .drawn = {{{0.05, 0.42, 0.45}, "#00666b", "#7fdde0"}, 11, 7.5}},
    {.set = std::nullopt,
     .title = "Solutions",
     .member = "Solution",
     .label = "",
     .meaning = "the solutions of the system",
     .drawn = {{{0.35, 0.45, 0.58}, "#59738f", "#9db2c9"}}},
}};

}  // namespace

const SetLook& look(const symbolic::SetDefinition& set) {
  return *std::find_if(kLooks.begin(), kLooks.end() - 1, [&](const SetLook& l) { return l.set == set.set; });
}

Color between(std::span<const Color> stops, double at) {
  const double place = std::clamp(at, 0.0, 1.0) * static_cast<double>(stops.size() - 1);
  const std::size_t k = std::min(static_cast<std::size_t>(place), stops.size() - 2);
  const double share = place - static_cast<double>(k);
  const Color &a = stops[k], &b = stops[k + 1];
  return {a.red + share * (b.red - a.red), a.green + share * (b.green - a.green), a.blue + share * (b.blue - a.blue)};
}

}  // namespace corank::report
