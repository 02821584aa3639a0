// C-space as a graph: the coordinates that are free, and the others as functions of them. Of an arm the free ones are its
// joints; a question about two of them is then asked of two angles, not of all that the arm's equations name.
//
// Theorem: let each equation of Φ give one coordinate as a polynomial in the others and in sines and cosines, where no
// equation before it has that coordinate. Then the others, the free ones, determine all coordinates, and C-space is the
// graph of a polynomial map over those values of the free ones at which every given coordinate is within its range. So it
// is smooth, and a set of configurations that is described by free coordinates has as many pieces as its image there.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "corank/core/ended.h"
#include "corank/symbolic/sets/singularity_system.h"

namespace corank::symbolic {

struct FreeCoordinates {
  /// The free coordinates, without equations. Its inequalities are the model's own, and the ranges of given coordinates
  /// that are not shown to hold at all values of the free ones, by intervals or as components of unit vectors
  /// (unit_vectors.h).
  TrigonometricSystem system;
  /// In the order of their equations, each by free ones and those before it: x = f.
  std::vector<Relation> given;
};

/// Nothing where some equation gives no coordinate, a given one has one value or stands in a sine, or a range depends on a
/// tolerance. Other constants with tolerances stay names: the theorem holds for every robot.
std::optional<FreeCoordinates> free_coordinates(const Mechanism& mechanism);

/// The coordinates that some function or inequality is about, and those of one value, with the inequalities: C-space is the
/// product of these configurations and of the other free coordinates' ranges. Nothing where a function has a given
/// coordinate.
std::optional<TrigonometricSystem> mentioned_coordinates(const FreeCoordinates& free,
                                                         const std::vector<Expression>& functions);

/// A factor of a product of sets.
struct IndependentPart {
  TrigonometricSystem system;          ///< some of the free coordinates, and the inequalities about them
  std::vector<std::size_t> functions;  ///< which functions are about them
};
/// Coordinates that no function and no inequality ties to each other are in different parts; those that none is about, and
/// over whose ranges a set is a product, are in no part. Nothing where a function has a given coordinate.
std::optional<std::vector<IndependentPart>> independent_parts(const FreeCoordinates& free,
                                                              const std::vector<Expression>& functions);

}  // namespace corank::symbolic
