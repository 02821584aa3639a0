// From many digits to exact numbers. Heuristic: a guess is worth what certify::verify_exactly says of it.
#pragma once

#include <optional>
#include <vector>

#include "corank/core/ended.h"
#include "corank/core/exact_point.h"

namespace corank::solve {

/// The exact point whose coordinates agree with those given, rational numbers that are right to `bits` bits: rational
/// numbers first (continued fractions), else polynomials in one algebraic number of at most `degree`, one of the coordinates
/// or a small combination of them, whose integer relations come from lattice reduction (LLL; key LenstraLenstraLovasz1982).
/// Nothing where all that fits has long numbers: such fits exist for any coordinates and mean nothing. Coordinates without a
/// value stay unknown. Nothing where `ended` is true before.
std::optional<ExactPoint> guess_exactly(const std::vector<std::optional<ExactNumber>>& coordinates, int bits, int degree,
                                        const Ended& ended = {});

}  // namespace corank::solve
