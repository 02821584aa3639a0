// The unit of time in which corank's benchmarks are stated, so that they compare across machines and moments: one Eigen
// PartialPivLU of a 14×14 double matrix.
#pragma once

namespace corank::bench {

/// Seconds for one factorization on this core now: the best of several batches, about 10 ms in all.
double lu_seconds();

}  // namespace corank::bench
