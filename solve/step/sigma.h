// σ: how finely proven sheets are cut. It concerns the model's own coordinates, lengths and angles apart, never kernel
// vectors and auxiliary variables, and it steers no search.
#pragma once

#include <vector>

#include "corank/certify/reduction.h"
#include "corank/core/cover.h"
#include "corank/core/system.h"

namespace corank::solve {

/// Which σ a variable has.
enum class SigmaClass : std::uint8_t { none, length, angle };
SigmaClass sigma_class(const Variable& variable);

/// Of the variables that are kept, then of the eliminated ones, in the order of Reduction::definitions.
std::vector<SigmaClass> sigma_classes(const System& system, const certify::Reduction& reduction);

/// Infinite for SigmaClass::none.
double sigma_of(const Sigma& sigma, SigmaClass kind);

/// A share of the size of a set: `hull` holds it, in all variables. The size of a set is its widest side, of lengths and of
/// sines and cosines apart. The share is 1/200 for a curve, 1/60 for a surface, 1/20 for a larger set, both more where there
/// are over 20 variables, and 1/20 where coefficients carry a tolerance; for isolated points 1e-6, and no less than the
/// square root of the tolerance: so far apart may two solutions be that merge for some choice of the coefficients. A set
/// without size counts as one of size 1.
Sigma default_sigma(const System& system, const Box& hull, int dimension);

}  // namespace corank::solve
