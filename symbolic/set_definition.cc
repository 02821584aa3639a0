#include "corank/symbolic/set_definition.h"

#include <algorithm>
#include <vector>

namespace corank::symbolic {
namespace {

constexpr std::array kInput{Role::input}, kOutput{Role::output};
constexpr std::array kBoth{Role::input, Role::output};

constexpr std::array<SetDefinition, 17> kSets{{
    {.set = SingularitySet::cspace, .name = "cspace"},
    {.set = SingularitySet::forward, .name = "forward", .matrix = "L_y", .locked = kInput, .side = KernelSide::right},
    {.set = SingularitySet::inverse, .name = "inverse", .matrix = "L_z", .locked = kOutput, .side = KernelSide::right},
    {.set = SingularitySet::cspace_singular, .name = "cspace-singular", .matrix = "Phi_q", .side = KernelSide::left},
    {.set = SingularitySet::boundary,
     .name = "boundary",
     .matrix = "Phi_z",
     .locked = kOutput,
     .side = KernelSide::left,
     .of_parts = true},
    {.set = SingularitySet::forward_inverse,
     .name = "forward-inverse",
     .matrix = "L_y",
     .locked = kInput,
     .side = KernelSide::right,
     .one_side = true,
     .also_locked = kOutput,
     .also_matrix = "L_z"},
    {.set = SingularitySet::ro,
     .name = "ro",
     .matrix = "L_y",
     .locked = kInput,
     .side = KernelSide::right,
     .one_side = true,
     .type = SingularityType::ro},
    {.set = SingularitySet::rpm,
     .name = "rpm",
     .matrix = "L_p",
     .locked = kBoth,
     .side = KernelSide::right,
     .one_side = true,
     .type = SingularityType::rpm},
    {.set = SingularitySet::ii,
     .name = "ii",
     .matrix = "L_y",
     .locked = kInput,
     .side = KernelSide::left,
     .one_side = true,
     .type = SingularityType::ii},
    {.set = SingularitySet::ri,
     .name = "ri",
     .matrix = "L_z",
     .locked = kOutput,
     .side = KernelSide::right,
     .one_side = true,
     .type = SingularityType::ri},
    {.set = SingularitySet::io,
     .name = "io",
     .matrix = "L_z",
     .locked = kOutput,
     .side = KernelSide::left,
     .one_side = true,
     .type = SingularityType::io},
    {.set = SingularitySet::iim,
     .name = "iim",
     .matrix = "Phi_q",
     .side = KernelSide::left,
     .one_side = true,
     .type = SingularityType::iim},
    {.set = SingularitySet::forward_cusps,
     .name = "forward-cusps",
     .matrix = "L_y",
     .locked = kInput,
     .side = KernelSide::right,
     .part = LocusPart::cusps},
    {.set = SingularitySet::inverse_cusps,
     .name = "inverse-cusps",
     .matrix = "L_z",
     .locked = kOutput,
     .side = KernelSide::right,
     .part = LocusPart::cusps},
    {.set = SingularitySet::forward_nodes,
     .name = "forward-nodes",
     .matrix = "L_y",
     .locked = kInput,
     .side = KernelSide::right,
     .part = LocusPart::nodes},
    {.set = SingularitySet::inverse_nodes,
     .name = "inverse-nodes",
     .matrix = "L_z",
     .locked = kOutput,
     .side = KernelSide::right,
     .part = LocusPart::nodes},
    {.set = std::nullopt, .name = "system"},
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
