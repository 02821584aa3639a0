// A set as a union: its matrix M, square or wide with columns that turn out to be zero, is brought to block triangular form
// by exact row operations. It is singular exactly where one of the diagonal blocks is; a small block where a factor of its
// determinant vanishes. Each of these is a part of the set, with an equation of its own and no kernel vector. So the parts
// have none of the strata that the whole system has where two of them meet: a circle of kernel vectors over each
// configuration.
//
// Theorem (doc/theory.md, "Parts of a set"): M(q) has not the rank of its rows exactly where a part's condition holds; of a
// square M that is ker M(q) ≠ 0. Columns of zeros do not count. Rows are eliminated by entries that are rational numbers ≠ 0
// and by the rotations of passive_rates.h, which leave det M as it is but for a factor ≠ 0; entries left of and below the
// blocks are identically zero, so that det M = ± Π det B_i; factors over the rational numbers, and what cos² + sin² = 1
// makes of them, have the zeros of their product.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "corank/core/ended.h"
#include "corank/symbolic/sets/double_stratum.h"
#include "corank/symbolic/sets/singularity_system.h"

namespace corank::symbolic {

/// { q : Φ(q) = 0, the values, and one of dependent_angle, all conditions = 0, block singular }.
struct Component {
  std::string name;  ///< "phi_rod1 = theta1", "x_C = 0", "condition on theta1, theta2, theta3 (2)"
  std::optional<DependentAngle> dependent_angle{};  ///< of sin(a ∓ b) = 0 or cos(a ∓ b) = 0, each a part for either way
  std::vector<Expression> conditions{};             ///< one, or of rank_loss.h some
  std::vector<std::pair<std::string, Expression>> values{};  ///< of joints (rank_loss.h): q2 = 0, q6 = pi/2
  /// With a kernel vector: its determinant is long; or it is no product, of more than three rows, and the set is points.
  std::optional<ExpressionMatrix> block{};
  /// In place of Φ(q) = 0, where some coordinates are left out (set_parts.h).
  std::shared_ptr<const TrigonometricSystem> factor{};
  bool condition_in_factor = false;        ///< whose equations say it
  std::vector<std::string> joints{};       ///< of such a part: the coordinates that give all others (free_coordinates.h)
  std::optional<DoubleStratum> stratum{};  ///< where the condition vanishes doubly; the part is this, or
  bool is_rest = false;                    ///< what else the condition says
  std::string former_name{};               ///< before rounded numbers were put into the name (part_names.h)

  /// "phi_rod1 = theta1", "x_C = 0"; of a block nothing.
  std::string relation() const {
    if (stratum && !is_rest) return stratum->text();
    if (dependent_angle) return dependent_angle->text();
    std::string text;
    const auto add = [&](const std::string& more) { text += (text.empty() ? "" : ", ") + more; };
    for (const auto& [joint, value] : values) add(joint + " = " + value.text());
    for (const Expression& e : conditions) add(e.text() + " = 0");
    return text;
  }
  friend bool operator==(const Component& a, const Component& b) {
    return a.name == b.name || (!a.block && a.relation() == b.relation());
  }
};

/// "x - y = 0"; where that is long "condition on x, y".
std::string name_of_condition(const Mechanism& mechanism, const Expression& condition);

/// The parts of the set of a kernel_question(), in the order of M's rows, of a block the shortest condition first. One: the
/// set is no union. None: M does not become square, or vanishes everywhere, or is singular nowhere for a reason that its
/// factors show, or the factors are not found in time (RationalPolynomial::factors) or before `ended`. Factors that are
/// proven to have no zero in the search domain are left out. Angles fixed at multiples of π/2 are replaced by their value.
/// Of an arm M is written in the joints before it is decomposed (ExactMatrix::put_into_free_coordinates).
std::vector<Component> decompose(const Mechanism& mechanism, const KernelQuestion& kernel, const Ended& ended = {});

/// M in the joints of an arm, where it stays wide: it loses row rank where M does. Nothing where it becomes square, or Φ
/// does not give all other coordinates.
std::optional<ExpressionMatrix> wide_in_joints(const Mechanism& mechanism, const KernelQuestion& kernel,
                                               const Ended& ended = {});

}  // namespace corank::symbolic
