// Coordinates that have no say in where the outputs are, such as the last joint of an arm that is to bring its tool's tip
// somewhere.
//
// Theorem. Leave out, as long as there are such, equations a·x + g = 0 with a rational a ≠ 0 and a length x that is no
// output, has no limit, stands in no other equation that is left and in no inequality, and in whose range all values of
// −g/a are. Let z be coordinates that are no outputs and then stand in no equation and no inequality. Then C-space is a
// graph, the x over the other coordinates, and a product, of the configurations C' without the x and z and of the ranges of
// the z. The outputs' velocities at a configuration are those at its point of C', so what is said of these alone, as that
// they cannot have some direction, holds for all z or for none.
#pragma once

#include <string>
#include <vector>

#include "corank/symbolic/model/mechanism.h"

namespace corank::symbolic {

struct IdleCoordinates {
  std::vector<std::string> free;   ///< z, those of more than one value
  std::vector<std::string> given;  ///< x
};

/// None where an equation is no polynomial in lengths, sines and cosines of angles, or plain_system() would throw.
/// `kept`: names that are neither x nor z, besides the outputs.
IdleCoordinates idle_coordinates(const Mechanism& mechanism, const std::vector<std::string>& kept = {});

/// C', with the derivative of its constraints as velocity equation. The mechanism itself where no z is free.
Mechanism without_idle(const Mechanism& mechanism, const IdleCoordinates& idle);

}  // namespace corank::symbolic
