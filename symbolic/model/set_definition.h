// The sets of configurations that corank knows of a mechanism, as data: of which matrix a set is the rank deficiency.
// Whoever needs to know what a set is asks here; nobody compares names. How it is called and shown:
// report/pictures/set_look.h.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>

#include "corank/core/singularity_types.h"

namespace corank::symbolic {

enum class SingularitySet {
  cspace,
  forward,
  inverse,
  cspace_singular,
  forward_inverse,  ///< where both are singular at once
  ro,               ///< those of one type (core/singularity_types.h) …
  rpm,
  ii,
  ri,
  io,
  iim,
  requirements,  ///< where a requirement reaches its limit
  forward_cusps,
  inverse_cusps,
  forward_nodes,
  inverse_nodes,
  boundary  ///< of the workspace, in parts (boundary.h)
};
/// What of a locus is asked for: all of it, or where its image among the locked coordinates has a cusp or crosses itself.
enum class LocusPart { all, cusps, nodes };
enum class KernelSide { right, left };  ///< M ξ = 0 or Mᵀ ξ = 0
/// Of a coordinate: whose rate is it? Inputs are the actuators', passive is the rest.
enum class Role { input, output, passive };

const char* to_string(SingularitySet set);  ///< SetDefinition::name
const char* to_string(KernelSide side);
const char* to_string(Role role);
/// Nothing for another word.
std::optional<SingularitySet> singularity_set_from_string(const std::string& text);
std::optional<KernelSide> kernel_side_from_string(const std::string& text);

/// { q : Φ(q) = 0 and, where there is a matrix, ker M or ker Mᵀ ≠ 0 }, M = L without the columns of the locked rates.
struct SetDefinition {
  std::optional<SingularitySet> set;    ///< nothing: the solutions of a plain system
  const char* name;                     ///< on command lines and in result files: "forward"
  const char* matrix = "";              ///< what M is called, "L_y"; empty: the set has no kernel
  std::span<const Role> locked{};       ///< the rates that are 0: which columns of L go
  KernelSide side{};                    ///< of the kernel of a square M, where none is asked for
  bool one_side = false;                ///< no other kernel gives this set
  std::span<const Role> also_locked{};  ///< of a second matrix that is singular as well: its kernel's vector is eta
  const char* also_matrix = "";
  /// The set is that of a type: of the kernel's configurations those where the type is not excluded.
  std::optional<SingularityType> type{};
  LocusPart part = LocusPart::all;  ///< cusps and nodes: cusps_and_nodes.h

  /// Its result consists of parts, each the solutions of a system of its own (boundary.h).
  bool of_parts = false;
  /// M is the forward one of a companion of the mechanism (requirements.h), whose rates are none of its own.
  bool of_requirements = false;

  /// Is it all configurations where M has a kernel, whose side and corank can be asked for?
  bool has_kernel() const { return is_singular() && part == LocusPart::all; }
  bool is_singular() const { return *matrix != '\0'; }
  /// All configurations of a mechanism, among which those of the other sets are.
  bool is_cspace() const { return set && !is_singular(); }
  /// Of those that a report shows unless it is told which: the others take their time, and few mechanisms have them all.
  bool is_usual() const { return !type && also_locked.empty() && part == LocusPart::all && !of_parts && !of_requirements; }
};

/// The sets of a mechanism, in the order of a report.
std::span<const SetDefinition> set_definitions();
/// Nothing: a plain system's.
const SetDefinition& definition(std::optional<SingularitySet> set);
/// By name; a plain system's where no set is called so.
const SetDefinition& definition(const std::string& name);

/// "cspace, forward … or boundary": all, or those that are asked for of a corank.
std::string names_of_sets(bool with_corank_only = false);
/// "forward singularities of corank 2"; "forward" where the corank is 1.
std::string set_with_corank(const std::string& set, int corank);

}  // namespace corank::symbolic
