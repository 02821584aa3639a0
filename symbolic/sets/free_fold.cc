#include "corank/symbolic/sets/free_fold.h"

#include <algorithm>
#include <array>

#include "corank/core/rounding.h"
#include "corank/symbolic/algebra/exact_algebra.h"
#include "corank/symbolic/algebra/ginac_lock.h"
#include "corank/symbolic/sets/algebrizer.h"

namespace corank::symbolic {
namespace {

// Does its range say nothing? One of one value has no circle, a smaller one a chord.
bool is_full(const System& system, const std::string& angle) {
  const auto is_named = [&](const char* what) {
    return [name = what + angle](const Polynomial& f) { return f.source == name; };
  };
  return std::ranges::any_of(system.equations, is_named("circle of ")) &&
         std::ranges::none_of(system.inequalities, is_named("range of "));
}

}  // namespace

std::optional<TrigonometricSystem> without_free_fold(const Mechanism& mechanism, const DependentAngle& angle) {
  TrigonometricSystem system = plain_system(mechanism);
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

namespace {

// e = cosine cos t + sine sin t, with coefficients that are not about t.
struct Turning {
  GiNaC::ex cosine, sine;
};

std::optional<Turning> turning_in(const GiNaC::ex& e, const GiNaC::symbol& t) {
  const GiNaC::ex c = GiNaC::cos(t), s = GiNaC::sin(t);
  const Turning part{e.coeff(c), e.coeff(s)};
  const bool whole = GiNaC::ex(e - part.cosine * c - part.sine * s).expand().is_zero();
  if (!whole || part.cosine.has(t) || part.sine.has(t)) return std::nullopt;
  return part;
}

// Is x = k y with a number k ≠ 0 for both pairs?
bool are_proportional(const GiNaC::ex& x1, const GiNaC::ex& x2, const GiNaC::ex& y1, const GiNaC::ex& y2) {
  const GiNaC::ex k = y1.is_zero() ? GiNaC::ex(x2 / y2).normal() : GiNaC::ex(x1 / y1).normal();
  return GiNaC::is_a<GiNaC::numeric>(k.evalf()) && !k.is_zero() && GiNaC::ex(x1 - k * y1).expand().is_zero() &&
         GiNaC::ex(x2 - k * y2).expand().is_zero();
}

}  // namespace

std::optional<FreeTurn> without_free_turn(const Mechanism& mechanism, const Expression& condition) {
  TrigonometricSystem system = plain_system(mechanism);
  const System compiled = algebrize(system);
  const GinacLock lock;
  const ExactAlgebra algebra(mechanism);
  const GiNaC::ex f = algebra.value(condition);
  for (const Coordinate& c : mechanism.coordinates()) {
    if (!condition.mentions(c.name) || !is_full(compiled, c.name)) continue;
    const auto is_about_it = [&](const TrigonometricSystem::Equation& e) {
      return e.relation.lhs.mentions(c.name) || e.relation.rhs.mentions(c.name);
    };
    const auto about = std::ranges::find_if(system.equations, is_about_it);
    if (std::ranges::count_if(system.equations, is_about_it) != 1 || std::ranges::any_of(system.inequalities, is_about_it))
      continue;
    const GiNaC::symbol& t = algebra.symbol(c.name);
    const auto said = turning_in(algebra.value(about->relation.lhs - about->relation.rhs), t), asked = turning_in(f, t);
    if (!said || !asked || (said->cosine.is_zero() && said->sine.is_zero())) continue;
    if (!are_proportional(asked->sine, asked->cosine, said->cosine, -said->sine)) continue;
    const TrigonometricSystem::Equation equation = *about;
    system.equations.erase(about);
    for (const GiNaC::ex& zero : {said->cosine, said->sine}) {
      if (zero.is_zero()) continue;
      system.equations.push_back(equation);
      system.equations.back().relation = algebra.expression(zero) == Expression(0);
    }
    std::erase_if(system.coordinates, [&](const Coordinate& other) { return other.name == c.name; });
    system.claimed.clear();
    return FreeTurn{c.name, std::move(system)};
  }
  return std::nullopt;
}

}  // namespace corank::symbolic
