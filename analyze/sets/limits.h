// Where a set ends: the ends of its domain and the inequalities that its cover comes to, as functions that are positive
// inside.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "corank/certify/stratum.h"
#include "corank/core/cover.h"
#include "corank/core/system.h"

namespace corank::analyze {

/// Its function is positive strictly within the limit.
struct Limit : certify::End {
  std::string name;  ///< "lower end of rho1", "range of theta2"
};

/// Of a complete cover: where all of them are positive a solution is strictly inside the domain and the inequalities.
/// Theorem: every end of the domain and every inequality that is not among them (1) has no contact (certify/contact.h), so
/// all solutions in the domain are strictly inside of it, or (2) is implied by the equations, or belongs to a variable of
/// one value, which is no end, or (3) is an end of the cosine or sine of an angle whose range is less than a turn: its
/// chord, an inequality, is 0 where the angle is at an end of its range, and only there does its cosine or sine come to an
/// end that is not ±1.
std::vector<Limit> limits(const System& system, const Cover& cover);

/// The system with an equation more for each length whose domain is one value, as of a leg that is held: its solutions in
/// the domain are the same, and there are fewer equations than variables, by the dimension of its set.
System with_single_values(System system);

/// As many equations as variables, but for a set's dimensions.
inline bool is_square_over(const System& system, int dimension) {
  return static_cast<int>(system.equations.size()) + dimension == system.size();
}

/// The same point in another system's variables, found by their names: auxiliary ones may stand between them. Nothing where
/// they are not all there.
std::optional<Box> same_configuration(const System& from, const Box& box, const System& to);

}  // namespace corank::analyze
