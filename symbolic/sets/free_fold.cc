#include "corank/symbolic/sets/free_fold.h"

#include <algorithm>
#include <array>

#include "corank/core/rounding.h"
#include "corank/symbolic/algebra/exact_algebra.h"
#include "corank/symbolic/algebra/ginac_lock.h"
#include "corank/symbolic/sets/algebrizer.h"

namespace corank::symbolic {
namespace {

// Does its range say nothing?
bool is_full(const System& system, const std::string& angle) {
  const auto a = std::ranges::find(system.angles, angle, &Angle::name);
  const bool has_chord =
      std::ranges::any_of(system.inequalities, [&](const Polynomial& f) { return f.source == "range of " + angle; });
  return a != system.angles.end() && !has_chord;
}

}  // namespace

std::optional<TrigonometricSystem> without_free_fold(const Mechanism& mechanism, const DependentAngle& angle) {
  TrigonometricSystem system = plain_system(mechanism);
  for (const Coordinate& c : system.coordinates)
    if ((c.name == angle.angle || c.name == angle.other) && is_fixed(c)) return std::nullopt;
  const System compiled = algebrize(system);
  if (!is_full(compiled, angle.angle) || !is_full(compiled, angle.other)) return std::nullopt;
  const GinacLock lock;
  const ExactAlgebra algebra(mechanism);
  // cos and sin of ± b + k π/2.
  const GiNaC::ex cosine = GiNaC::cos(algebra.symbol(angle.other)),
                  sine = angle.sign * GiNaC::sin(algebra.symbol(angle.other));
  const std::array<GiNaC::ex, 4> turned{cosine, -sine, -cosine, sine};
  const GiNaC::exmap values{{GiNaC::cos(algebra.symbol(angle.angle)), turned[angle.quarters]},
                            {GiNaC::sin(algebra.symbol(angle.angle)), turned[(angle.quarters + 3) % 4]}};
  const auto mentions = [&](const Expression& e) { return e.mentions(angle.angle) || e.mentions(angle.other); };
  const auto is_about_them = [&](const TrigonometricSystem::Equation& e) {
    return mentions(e.relation.lhs) || mentions(e.relation.rhs);
  };
  if (std::ranges::any_of(system.inequalities, is_about_them)) return std::nullopt;
  std::vector<TrigonometricSystem::Equation> left;
  for (const TrigonometricSystem::Equation& e : system.equations) {
    if (!is_about_them(e)) {
      left.push_back(e);
      continue;
    }
    const GiNaC::ex rest = algebra.value(e.relation.lhs - e.relation.rhs).subs(values).expand();
    if (rest.is_zero()) continue;
    left.push_back(e);
    left.back().relation = algebra.expression(rest) == Expression(0);
    if (is_about_them(left.back())) return std::nullopt;
  }
  system.equations = std::move(left);
  std::erase_if(system.coordinates, [&](const Coordinate& c) { return c.name == angle.angle || c.name == angle.other; });
  system.claimed.clear();
  return system;
}

}  // namespace corank::symbolic
