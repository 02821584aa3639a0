#include "corank/certify/self_motion.h"

#include <algorithm>

#include "corank/certify/polynomial_algebra.h"
#include "corank/core/box.h"
#include "corank/core/check.h"
#include "corank/core/rounding.h"

namespace corank::certify {
namespace {

constexpr int kAttempts = 3, kZeroTightenings = 3;

// The first variable of a relation that no other relation mentions; −1: none.
int own_variable(const std::vector<Polynomial>& relations, std::size_t i) {
  for (const Monomial& m : relations[i].monomials) {
    if (m.factors.empty()) continue;
    const int v = m.factors[0].variable;
    bool alone = true;
    for (std::size_t k = 0; k < relations.size(); ++k) alone = alone && (k == i || !mentions(relations[k], v));
    if (alone) return v;
  }
  return -1;
}

bool is_linear_and_rational(const Polynomial& f) {
  return std::ranges::all_of(f.monomials, [](const Monomial& m) {
    return m.coefficient.is_rational() && m.degree() <= 1 && !m.is_trigonometric();
  });
}

}  // namespace

std::optional<SelfMotion> self_motion(const System& system, std::vector<Polynomial> relations, int dimension) {
  std::vector<Polynomial> rest = system.equations;
  for (const Polynomial& f : rest)
    if (std::ranges::any_of(f.monomials, carries_tolerance)) return std::nullopt;
  for (std::size_t i = 0; i < relations.size(); ++i) {
    const int v = own_variable(relations, i);
    if (v < 0 || !is_linear_and_rational(relations[i])) return std::nullopt;
    const auto value = solved_for(relations[i], v);
    if (!value) return std::nullopt;
    for (Polynomial& f : rest) {
      for (const Monomial& m : f.monomials)  // what substitute() does not take
        if (m.is_trigonometric() && m.factors[0].variable == v) return std::nullopt;
      f = substitute(f, v, *value);
    }
  }
  SelfMotion motion{std::move(relations), system, CompiledSystem(System{}), {}};
  std::vector<int> classes;
  for (std::size_t i = 0; i < rest.size(); ++i) {
    if (rest[i].monomials.empty()) continue;
    const bool known = std::ranges::any_of(classes, [&](int g) { return proportional(rest[i], rest[g]).has_value(); });
    if (!known) classes.push_back(static_cast<int>(i));
  }
  const int m = static_cast<int>(system.equations.size());
  for (std::size_t i = 0; i < motion.relations.size(); ++i) {
    motion.sufficient.push_back(m + static_cast<int>(i));
    motion.extended.equations.push_back(motion.relations[i]);
  }
  motion.sufficient.insert(motion.sufficient.end(), classes.begin(), classes.end());
  if (system.size() - static_cast<int>(motion.sufficient.size()) != dimension) return std::nullopt;
  motion.compiled = CompiledSystem(motion.extended);
  return motion;
}

bool same_relations(const SelfMotion& a, const SelfMotion& b) {
  // As many: those of one then follow from those of the other, too.
  if (a.relations.size() != b.relations.size()) return false;
  std::vector<Polynomial> rest = a.relations;
  for (std::size_t i = 0; i < b.relations.size(); ++i) {
    const int v = own_variable(b.relations, i);
    const auto value = v < 0 ? std::nullopt : solved_for(b.relations[i], v);
    if (!value) return false;
    for (Polynomial& f : rest) f = substitute(f, v, *value);
  }
  return std::ranges::all_of(rest, [](const Polynomial& f) { return f.monomials.empty(); });
}

Sheet prove_self_motion(const CompiledSystem& system, const SelfMotion& motion, const Preconditioner& e,
                        const Preconditioner& r, std::span<const Interval> x, NewtonWorkspace& w) {
  CORANK_CHECK(std::ranges::is_permutation(r.equations, motion.sufficient));
  CORANK_CHECK(std::ranges::is_permutation(e.dependent, r.dependent));
  CORANK_CHECK(std::ranges::all_of(e.equations, [&](int row) { return row < system.equations(); }));
  std::vector<Interval> start(x.begin(), x.end());
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    // (1): at most one zero of E in its region, which holds every zero of E in `start`, hence in x.
    Sheet sheet = newton_prove(system, e, start, w);
    if (!sheet.proven) return {};
    // (2): a zero of {R, g} for every value of the same free variables, inside that region.
    Sheet other = newton_prove(motion.compiled, r, sheet.image, w);
    if (!other.proven) return {};
    // That zero stays in the image when rows that vanish there contract it.
    for (int k = 0; k < kZeroTightenings && !contains(sheet.region, other.image); ++k)
      tighten_sheet(motion.compiled, r, other.image, w);
    if (!contains(sheet.region, other.image)) {  // of {R, g} less may be known than of E: a larger region is to hold it
      for (const int d : sheet.dependent) {
        const std::size_t j = d;
        const Interval& image = other.image[j];  // the next one differs from it by roundings
        const Interval wider = image + Interval(-image.width(), image.width());
        start[j] = Interval::hull(start[j], Interval::hull(sheet.region[j], wider));
      }
      continue;
    }
    for (const int d : sheet.dependent)  // both hold the one zero
      CORANK_CHECK(sheet.image[d].intersect(other.image[d]));
    return sheet;
  }
  return {};
}

}  // namespace corank::certify
