// Vectors of doubles: loops over them use the processor's wider registers where it has some, with the same results on all.
#pragma once

#include <cstddef>

// Of a function: compiled for wider registers, too, and chosen when the program starts. No fused operations:
// -ffp-contract=off.
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__)
#define CORANK_WIDE __attribute__((target_clones("avx2", "default")))
#else
#define CORANK_WIDE
#endif

namespace corank {

inline constexpr std::size_t kLanes = 4;
using Lanes = double __attribute__((vector_size(kLanes * sizeof(double)), aligned(sizeof(double)), may_alias));

/// kLanes doubles from `x` on, as one vector.
inline const Lanes& lanes(const double* x) { return *reinterpret_cast<const Lanes*>(x); }
inline Lanes& lanes(double* x) { return *reinterpret_cast<Lanes*>(x); }

/// The least multiple of kLanes that is not below n.
inline std::size_t whole_lanes(std::size_t n) { return (n + kLanes - 1) / kLanes * kLanes; }

}  // namespace corank
