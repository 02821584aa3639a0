// Exact arithmetic on sparse polynomials: what a rewriting of a system needs.
//
// Every operation acts on a monomial's exact coefficient and, rounded outward, on its enclosure, which may be wider than the
// exact number asks for: it may carry a coefficient tolerance.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "corank/core/system.h"

namespace corank::certify {

/// Is the enclosure wider than the exact coefficient asks for?
bool carries_tolerance(const Monomial& m);

/// f with the variable, which must not stand inside a sine or cosine, replaced by a polynomial, which must have no sine or
/// cosine if f has the variable in a product or power: f(…, value, …). Monomials whose exact coefficient is the rational
/// number 0 are dropped unless parts of it carry a tolerance: their sum is 0 for some choices only.
/// Requires UpwardRounding::active().
Polynomial substitute(const Polynomial& f, int variable, const Polynomial& value);

/// Where f = a·x + g with a rational a ≠ 0 and x not in g: the polynomial −g/a, so that f = 0 ⇔ x = −g/a. Else nothing.
/// Requires UpwardRounding::active().
std::optional<Polynomial> solved_for(const Polynomial& f, int variable);

/// The rational number q ≠ 0 with f = q·g in exact coefficients. Those that are not rational compare by structure: nothing
/// proves nothing.
std::optional<ExactNumber> proportional(const Polynomial& f, const Polynomial& g);

/// Is a + q·b = 0? True is proven: by rational arithmetic, or because a and −q·b are the same expression.
bool cancels(const ExactNumber& a, const ExactNumber& q, const ExactNumber& b);

/// f + q·g, without the terms that cancel. Requires UpwardRounding::active().
Polynomial sum(const Polynomial& f, const ExactNumber& q, const Polynomial& g);

/// f times a product of powers of variables, which must be 1 where f has a sine or cosine. Requires
/// UpwardRounding::active().
Polynomial product(const Polynomial& f, const Factors& powers);

/// Does the variable occur in f?
bool mentions(const Polynomial& f, int variable);

/// The products that f has, in order; equations that repeat each other have the same.
using Products = std::vector<Factors>;
Products products_of(const Polynomial& f);

/// The variables that f has, or all of a list, in order.
std::vector<int> variables_of(const Polynomial& f);
std::vector<int> variables_of(std::span<const Polynomial> list);

/// Is f = Σ aᵢ·xᵢ + b?
bool is_affine(const Polynomial& f);

/// Encloses {f(x) : x ∈ X}: the natural interval extension over the enclosures. These require UpwardRounding::active().
Interval evaluate(const Factor& f, const std::vector<Interval>& x);
Interval evaluate(const Polynomial& f, const std::vector<Interval>& x);

}  // namespace corank::certify
