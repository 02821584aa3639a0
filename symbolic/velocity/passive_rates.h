// Passive rates eliminated from the right kernel M(q) ξ = 0 by rows that they do no work in (reciprocal screws): a link of
// direction ψ holds its rate in one row as α sin ψ, in another as ±α cos ψ. Multiplied by (cos ψ, ∓sin ψ) these rows add up
// to one without the rate, by (sin ψ, ±cos ψ) to one that gives it.
//
// Theorem (doc/theory.md, "Passive rates"): let T(q) be the matrix of all that is done, sums of rows with constant factors
// and the pairs above, each of determinant ±1. So ker T M = ker M at every configuration; let E be the eliminated columns, R
// the others. E's own rows are α_j ξ_j + Σ_R b_jk(q) ξ_k = 0 with constants α_j ≠ 0, and no other row has a ξ_j, j ∈ E. So
// ξ ↦ ξ_R is injective on the kernel: it has dimension ≥ c where c independent ξ_R satisfy the other rows, and a vector may
// be normalized by ‖ξ_R‖ = 1.
#pragma once

#include <string>
#include <vector>

#include "corank/symbolic/velocity/velocity_equation.h"

namespace corank::symbolic {

struct PassiveRates {
  ExpressionMatrix matrix;              ///< T M
  std::vector<std::size_t> eliminated;  ///< columns, ascending
  /// Of each row, how it came about: the columns that were eliminated by it, with the one that it gives marked.
  struct RowNote {
    std::vector<std::string> free_of;  ///< rates that were in it
    std::string gives;                 ///< a rate; empty: none
  };
  std::vector<RowNote> notes;
};

/// Eliminates what it can of the passive columns: those whose entries are constants times the sine and the
/// cosine of one coordinate, α in one row and ±α in another after sums with constant factors, α a rational number ≠ 0.
/// `eliminated` is empty where there are none.
PassiveRates eliminate_passive_rates(const Mechanism& mechanism, const ExpressionMatrix& matrix);

}  // namespace corank::symbolic
