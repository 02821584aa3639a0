// Aspects where C-space is the graph of a map over some free coordinates (symbolic/sets/free_coordinates.h): the joints of
// an arm, the pose of a platform whose legs' lengths are given by it. The singularities are about some of these only, and
// often in groups that have nothing to do with each other, such as an arm's shoulder and elbow, and its wrist.
//
// Theorem: let C-space without the zeros of functions be the graph of a map over a product A × B × …, each function being of
// one factor. Its pieces are the products of the pieces of A, B, … without the zeros of their own functions.
#pragma once

#include "corank/analyze/aspects/aspect_equations.h"
#include "corank/analyze/aspects/aspects.h"

namespace corank::analyze {

/// Fills in the numbers and representatives. Requires AspectEquations::product.
void count_in_free_coordinates(const AspectEquations& equations, const AspectsOptions& options, solve::Control& control,
                               Aspects& result);

}  // namespace corank::analyze
