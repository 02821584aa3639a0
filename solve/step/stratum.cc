#include "corank/solve/step/stratum.h"

#include "corank/certify/polynomial_algebra.h"
#include "corank/solve/step/heuristics.h"

namespace corank::solve {
namespace {

// The sum of |coefficient| · typical size.
double size_of(const Polynomial& relation, const certify::CompiledSystem& system) {
  double size = 0;
  for (const Monomial& m : relation.monomials)
    if (!m.factors.empty()) size += m.enclosure.mag() * system.scales()[m.factors[0].variable];
  return size;
}

// Of a·x + b = 0 the variable; −1 for another relation.
int only_variable(const Polynomial& relation) {
  int variable = -1;
  for (const Monomial& m : relation.monomials) {
    if (m.factors.empty()) continue;
    if (variable >= 0) return -1;
    variable = m.factors[0].variable;
  }
  return variable;
}

// Of a·x + b = 0 the value of x.
double value_of(const Polynomial& relation) {
  double a = 1, b = 0;
  for (const Monomial& m : relation.monomials) (m.factors.empty() ? b : a) = m.enclosure.mid();
  return -b / a;
}

}  // namespace

TubePlace locate(const Stratum& stratum, const certify::CompiledSystem& system, const Box& x) {
  TubePlace place{TubePlace::Where::inside};
  for (const Polynomial& relation : stratum.motion.relations) {
    const double room = kTube * size_of(relation, system);
    const Interval value = certify::evaluate(relation, x);
    const double reach = (1 - kThinSlab) * room;
    if (value.lo() > reach || value.hi() < -reach) return {TubePlace::Where::outside};
    if (value.mag() <= (1 + kThinSlab) * room) continue;
    place.where = TubePlace::Where::across;
    const int j = only_variable(relation);
    if (j < 0 || place.variable >= 0) continue;
    const double centre = value_of(relation), half = kTube * system.scales()[j];
    for (const double face : {centre - half, centre + half})
      if (face > x[j].lo() + kThinSlab * half && face < x[j].hi() - kThinSlab * half) place.variable = j, place.at = face;
  }
  return place;
}

}  // namespace corank::solve
