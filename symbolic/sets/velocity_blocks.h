// The blocks of a mechanism's velocity equation whose ranks say which types of singularity a configuration has
// (core/singularity_types.h), as polynomials in the variables of the system of a set.
#pragma once

#include <optional>

#include "corank/core/singularity_types.h"
#include "corank/symbolic/sets/singularity_system.h"

namespace corank::symbolic {

/// Of the system that singularity_system(mechanism, set, side, …, corank) gives; with at_most what its kernels say of ranks.
/// Nothing for cspace, and where an entry is no polynomial in the system's variables (a sine of a length). Throws ModelError
/// as kernel_question does.
std::optional<VelocityBlocks> velocity_blocks(const Mechanism& mechanism, SingularitySet set,
                                              std::optional<KernelSide> side = std::nullopt, int corank = 1);

/// Of a set with locked rates M, in the variables of the configurations' system; of forward and inverse singularities with
/// the rows of zeros that are dependencies. Nothing where an entry is no polynomial in them.
std::optional<PolynomialMatrix> locked_polynomials(const Mechanism& mechanism, SingularitySet set);

/// M of the set's kernel_question(), transposed where its left kernel is asked for. Nothing where an entry is no polynomial.
std::optional<PolynomialMatrix> singular_matrix(const Mechanism& mechanism, SingularitySet set);

}  // namespace corank::symbolic
