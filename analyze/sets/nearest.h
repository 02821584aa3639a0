// The distance of a system's solution set from a centre, in proven bounds, by best-first branch and bound.
//
// From below: boxes wait with a lower bound of the distance of the solutions in them, and the one that is least is divided
// next; a box goes where certify/ proves that it holds no solution within the distance that is sought. So no solution is
// nearer than the least bound of the boxes that are left. From above: certify::newton_prove shows a solution in a small box,
// whose farthest point bounds the distance. (Branch and bound with interval arithmetic: Hansen and Walster, key Hansen2004.)
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "corank/certify/domain.h"
#include "corank/certify/newton.h"
#include "corank/certify/reduction.h"
#include "corank/solve/step/options.h"

namespace corank::solve {
class PreconditionerFactory;
}

namespace corank::analyze {

struct NearestOptions {
  double precision = 0.01;  ///< the search ends where lower ≥ (1 − precision) · upper
  double at_most = 0;       ///< where > 0: nothing farther away is of interest; then upper may be missing, and lower at_most
  std::uint64_t patience = 0;  ///< boxes before the first local search, which takes as long as many boxes
  double enough = 0;           ///< the search may end as soon as a solution is proven that is no farther away
  /// Called now and then with the bounds so far.
  std::function<void(double lower, std::optional<double> upper, std::uint64_t processed)> progress{};
};

struct Nearest {
  double lower = 0;             ///< no solution is nearer
  std::optional<double> upper;  ///< one is no farther; nothing where none was proven
  bool empty = false;           ///< proven: there is no solution in the search domain
  bool complete = false;        ///< as precise as was asked for, or empty
  /// In all variables of the system: a box that holds the solution of `upper`, exactly one for the values of its free
  /// variables, which are points.
  Box box;
  std::vector<int> free;         ///< those, variables of the system
  std::vector<double> unproven;  ///< in all variables: a seemingly nearer point where nothing could be proven; else empty
  double unproven_distance = 0;
  Statistics statistics;
};

/// An upper bound of the square root; 0 of a number below 0. Requires UpwardRounding::active().
double root_above(double square);

/// `differences`: in the system's variables, linear; the distance is the root of the sum of their squares.
Nearest nearest(const solve::Prepared& prepared, const std::vector<Polynomial>& differences, const NearestOptions& options,
                solve::Control& control);

/// A search of seconds that asks whether there is a solution, and ends with `solutions` of them. The run goes on after it.
/// `boxes`: processed at most; 0: no limit.
Cover search_briefly(System system, std::uint64_t solutions, std::uint64_t boxes, int threads,
                     const solve::Control& control);

/// A solution that exists, in the search domain, and satisfies the inequalities: the only one in the sheet's region for its
/// free variables' values, which are points. It lies in the sheet's image (certify::newton_prove).
struct Witness {
  certify::Sheet sheet;
  std::vector<int> free;
};

/// The box in all variables of the system that was reduced. `compiled`: begins with the reduced system's variables; its
/// values are those of the eliminated ones (solve::values_of).
Box lifted(const certify::CompiledSystem& compiled, const certify::Reduction& reduction, const Box& x);

/// Near the point; nothing where it cannot be proven.
std::optional<Witness> prove_near(const certify::CompiledSystem& system, const certify::DomainTest& domain,
                                  const std::vector<double>& point, solve::PreconditionerFactory& preconditioners,
                                  certify::NewtonWorkspace& workspace);

}  // namespace corank::analyze
