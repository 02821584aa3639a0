#include "corank/symbolic/model/set_definition.h"

#include <algorithm>
#include <vector>

#include "corank/symbolic/model/expression_words.h"

namespace corank::symbolic {
namespace {

constexpr std::array kInput{Role::input}, kOutput{Role::output};
constexpr std::array kBoth{Role::input, Role::output};

constexpr SetDefinition kForward{.set = SingularitySet::forward, .name = "forward", .matrix = "L_y", .locked = kInput};
constexpr SetDefinition kInverse{.set = SingularitySet::inverse, .name = "inverse", .matrix = "L_z", .locked = kOutput};
constexpr SetDefinition kCspaceSingular{
    .set = SingularitySet::cspace_singular, .name = "cspace-singular", .matrix = "Phi_q", .side = KernelSide::left};

/// Of the configurations of another set's kernel, on that side alone, those of a type.
constexpr SetDefinition of_type(SetDefinition of, SingularitySet set, const char* name, KernelSide side,
                                SingularityType type) {
  of.set = set, of.name = name, of.side = side, of.type = type;
  of.one_side = true;
  return of;
}

constexpr SetDefinition part_of(SetDefinition locus, SingularitySet set, const char* name, LocusPart part) {
  locus.set = set, locus.name = name, locus.part = part;
  return locus;
}

constexpr std::array<SetDefinition, 18> kSets{{
    {.set = SingularitySet::cspace, .name = "cspace"},
    kForward,
    kInverse,
    kCspaceSingular,
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
     .one_side = true,
     .also_locked = kOutput,
     .also_matrix = "L_z"},
    of_type(kForward, SingularitySet::ro, "ro", KernelSide::right, SingularityType::ro),
    of_type({.set = {}, .name = "", .matrix = "L_p", .locked = kBoth}, SingularitySet::rpm, "rpm", KernelSide::right,
            SingularityType::rpm),
    of_type(kForward, SingularitySet::ii, "ii", KernelSide::left, SingularityType::ii),
    of_type(kInverse, SingularitySet::ri, "ri", KernelSide::right, SingularityType::ri),
    of_type(kInverse, SingularitySet::io, "io", KernelSide::left, SingularityType::io),
    of_type(kCspaceSingular, SingularitySet::iim, "iim", KernelSide::left, SingularityType::iim),
    {.set = SingularitySet::requirements, .name = "requirements", .matrix = "R", .of_requirements = true},
    part_of(kForward, SingularitySet::forward_cusps, "forward-cusps", LocusPart::cusps),
    part_of(kInverse, SingularitySet::inverse_cusps, "inverse-cusps", LocusPart::cusps),
    part_of(kForward, SingularitySet::forward_nodes, "forward-nodes", LocusPart::nodes),
    part_of(kInverse, SingularitySet::inverse_nodes, "inverse-nodes", LocusPart::nodes),
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
  return listed(names, " or ");
}

std::string set_with_corank(const std::string& set, int corank) {
  return corank == 1 ? set : set + " singularities of corank " + std::to_string(corank);
}

}  // namespace corank::symbolic
