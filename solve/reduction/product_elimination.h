// Which sums of equations leave few products? Linear elimination with every product of variables as an unknown.
//
// The products that several equations share are eliminated as by Gauss and Jordan, in doubles: pivots are chosen by size,
// what rounding cannot tell from zero counts as zero. The result is a list of sums f += q·g with rational q. Each keeps the
// solutions whatever q is ((c) of certify/reduction.h): that q is a rounded quotient leaves a small multiple of the product
// where exact arithmetic would have none, and loses nothing else.
#pragma once

#include <functional>
#include <vector>

#include "corank/core/system.h"

namespace corank::solve {

/// rows[row] += factor · rows[other].
struct RowSum {
  std::size_t row, other;
  ExactNumber factor;
};

/// Sums to be done in their order. `sizes`: of each variable, how large it is typically, so that products are compared by
/// what they contribute; no statement rests on them. Empty where nothing is gained: a group of equations that share products
/// is left alone unless elimination leaves fewer products in it. `check` is called now and then.
std::vector<RowSum> eliminate_products(const std::vector<Polynomial>& rows, const std::vector<double>& sizes,
                                       const std::function<void()>& check);

/// Below this share of its row's largest term, over the domain, a term is a residue: what rounding has left of a product
/// that was eliminated, or what rounded constants leave where exact ones would cancel. A residue is as true as any other
/// term; it is no pivot.
inline constexpr double kResidue = 1e-9;
/// The row without its residues.
Polynomial without_residues(const Polynomial& row, const std::vector<double>& sizes);

}  // namespace corank::solve
