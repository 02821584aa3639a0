// A surface whose condition vanishes doubly on a part that is as large as the surface: the part, and the rest.
//
// Example: an Orthoglide whose three slides are at 0 holds its platform by three rods that meet in one point. The rods'
// determinant f has no derivative there, so that no box on this sphere is proven.
//
// Theorem: let F(x) = 0 be the equations of a set, and R: x_v = a_v for v ∈ V, each a_v an affine function of coordinates
// outside V. Let each F_i be one of the representatives g, or let it be F_i = q g + h with a rational number q, possibly 0,
// and an h that vanishes at R with an order k ≥ 1. Then
//   { F = 0 } = { R, g = 0 } ∪ { x : x_v = a_v + ρ η_v, ‖η‖ = 1, b·η ≥ 0, g = 0, ρ⁻ᵏ h(a + ρ η) = 0 for some ρ, η }
// with any fixed vector b. Proof: F = 0 where R and g = 0 hold, and where g = 0 and h = ρᵏ · 0. Of a solution with x ≠ a on
// V, ρ = ± ‖x − a‖ and η = (x − a)/ρ, with the sign for which b·η ≥ 0. ∎
// This is the blow-up of R: the second set is not doubled on the first any more, and crosses it where ρ = 0. There what is
// smooth in (q, ρ, η) may be pinched in q.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "corank/core/ended.h"
#include "corank/symbolic/sets/singularity_system.h"

namespace corank::symbolic {

/// R: coordinates, lengths with a range, and what each is.
struct DoubleStratum {
  std::vector<Relation> relations;
  int farthest = 0;  ///< ‖x − a‖ is nowhere larger

  std::string text() const;  ///< "d1 = 0, d2 = 0, d3 = 0"
  bool operator==(const DoubleStratum& other) const { return text() == other.text(); }
};

/// A stratum on which f and its gradient vanish, as large as the set { Φ(q) = 0, f(q) = 0 }: the relations and the
/// representatives are as many as the equations of the set. Linear factors of f's derivatives give the relations. Nothing
/// where these show no such stratum within the ranges, where f is long, or once `ended` says so.
std::optional<DoubleStratum> double_stratum(const Mechanism& mechanism, const Expression& f, const Ended& ended = {});

/// Φ(q) = 0, the system's equations so far, becomes { R, g = 0 }.
void put_on(const DoubleStratum& stratum, const Mechanism& mechanism, TrigonometricSystem& system);
/// Φ(q) = 0 and f = 0, the system's equations so far, f the last, become the other set's of the theorem.
void put_beside(const DoubleStratum& stratum, const Mechanism& mechanism, TrigonometricSystem& system);

}  // namespace corank::symbolic
