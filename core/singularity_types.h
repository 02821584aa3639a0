// The six types of singular configurations (Zlatanov1994), as statements about ranks of blocks of the velocity equation L m
// = 0, m = (output, input, passive rates).
//
//   L_y = L without the input columns      L_z = L without the output columns      L_p = the passive columns alone
//   g_v, g_u: the rows of L that are 0 but in the input (output) columns, those columns alone: the dependencies of the
// inputs
//
//   RO   redundant output         rk L_y < n_u + rk L_p      (some ξ in ker L_y has an output rate ≠ 0)
//   RI   redundant input          rk L_z < n_v + rk L_p
//   RPM  redundant passive motion rk L_p < n_p
//   II   impossible input         rk L_y + rk g_v < rk L     (some input rate that the dependencies allow cannot be
// achieved)
//   IO   impossible output        rk L_z + rk g_u < rk L
//   IIM  increased instantaneous mobility  rk L < the number of its rows
// The equivalences are proven in doc/theory.md, "The six types".
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "corank/core/system.h"

namespace corank {

enum class SingularityType : std::uint8_t { ro, rpm, ii, ri, io, iim };
inline constexpr std::array kSingularityTypes{SingularityType::ro, SingularityType::rpm, SingularityType::ii,
                                              SingularityType::ri, SingularityType::io,  SingularityType::iim};

inline const char* to_string(SingularityType type) {
  constexpr std::array kNames{"RO", "RPM", "II", "RI", "IO", "IIM"};
  return kNames.at(static_cast<std::size_t>(type));
}

/// Types as bits.
using TypeSet = std::uint8_t;
constexpr TypeSet bit(SingularityType type) { return static_cast<TypeSet>(1U << static_cast<unsigned>(type)); }
inline constexpr TypeSet kAllTypes = 63;

/// Of a box: these types every solution in it has; these none has; of the others nothing is proven.
struct TypeLabels {
  TypeSet proven = 0, excluded = 0;
  bool settle(TypeSet types) const { return ((proven | excluded) & types) == types; }
  friend bool operator==(const TypeLabels&, const TypeLabels&) = default;
};

/// Which block of L: all of it, L_y, L_z, L_p, g_v, g_u.
enum class Block : std::uint8_t { all, forward, inverse, passive, input_dependencies, output_dependencies };
inline constexpr int kBlocks = 6;
constexpr std::size_t index(Block block) { return static_cast<std::size_t>(block); }

/// The blocks of a mechanism's velocity equation, over the variables of the system of a set of its singularities.
struct VelocityBlocks {
  std::array<PolynomialMatrix, kBlocks> matrices;
  int inputs = 0, outputs = 0, passive = 0;  ///< rates
  /// No block has a higher rank at any solution of the system: by its entries that are 0 always, and by the kernel that the
  /// system asks for.
  std::array<int, kBlocks> at_most{};
  TypeSet asked = 0;   ///< types that say something of this mechanism; redundant ones are II or RI everywhere
  TypeSet of_set = 0;  ///< those of which the set is made: a box is typed where they are settled
};

}  // namespace corank
