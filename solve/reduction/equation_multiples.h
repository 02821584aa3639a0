// Multiples of equations as rows modulo a prime. What linear elimination finds among them holds of the equations with luck
// only: certify/reduction.h forms it in exact arithmetic.
#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "corank/core/reduction_step.h"
#include "corank/core/system.h"
#include "corank/solve/reduction/flint.h"

namespace corank::solve {

using Powers = std::vector<std::pair<int, int>>;  ///< of a product of variables: variable, power; ascending
using Row = std::map<Powers, mp_limb_t>;

int degree(const Powers& p);
Powers times(const Powers& p, const Powers& q);
Powers powers_of(const Monomial& m);

/// Nothing where a coefficient is not rational, or there is a sine or cosine.
std::optional<Row> row_of(const Polynomial& f);
/// The fraction of small numerator and denominator that x stands for.
std::optional<ExactNumber> fraction_of(mp_limb_t x);

/// A row of the elimination: equation `equation` times a product.
struct Multiple {
  Multiple(int of, const Row& terms, Powers by);
  ImpliedEquation::Multiple part(const ExactNumber& factor) const;

  int equation;
  Powers product;
  Row row;
};

inline constexpr std::size_t kMostRows = 1200;  ///< of an elimination

/// Drops the multiples that have a product of at least that degree which neither another nor the target has: nothing cancels
/// it.
void drop_lone(std::vector<Multiple>& multiples, int of_degree, const Row& target = {});

}  // namespace corank::solve
