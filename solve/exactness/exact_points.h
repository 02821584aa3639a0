// The exact points of a cover: guessed from many digits, verified in exact arithmetic (certify::verify_exactly), each kept
// once. Heuristic in what it guesses; what it keeps is proven.
#pragma once

#include <optional>
#include <vector>

#include "corank/core/cover.h"
#include "corank/core/ended.h"
#include "corank/core/system.h"
#include "corank/solve/step/control.h"

namespace corank::solve {

class ExactPoints {
 public:
  /// Adds to cover.exact_points; the three have to outlive it.
  ExactPoints(const System& system, Cover& cover, const Control& control)
      : system_(system), points_(cover.exact_points), ended_([&control] { return control.ended(); }) {}

  /// The place in Cover::exact_points of a verified solution in the box.
  std::optional<int> solution_in(const Box& box);
  /// Of a verified configuration, in or next to the box, where the kernel has that dimension at least.
  std::optional<int> with_kernel(const PolynomialMatrix& matrix, const Box& hull, int least);

 private:
  int add(ExactPoint point);

  const System& system_;
  std::vector<ExactPoint>& points_;
  const Ended ended_;
};

/// Heuristic: a guess is worth what certify::verify_exactly says of it. The exact point whose coordinates agree with those
/// given, rational numbers that are right to `bits` bits: rational numbers first (continued fractions), else polynomials in
/// one algebraic number of at most `degree`, one of the coordinates or a small combination of them, whose integer relations
/// come from lattice reduction (LLL; key LenstraLenstraLovasz1982). Nothing where all that fits has long numbers: such fits
/// exist for any coordinates and mean nothing. Coordinates without a value stay unknown. Nothing where `ended` is true
/// before.
std::optional<ExactPoint> guess_exactly(const std::vector<std::optional<ExactNumber>>& coordinates, int bits, int degree,
                                        const Ended& ended = {});

/// The widest side of the hull in the coordinates that the point has.
double width_of(const ExactPoint& point, const Box& hull);

}  // namespace corank::solve
