// Expression ↔ GiNaC, for differentiation. Named constants stay symbols, so a derivative reads l2*sin(theta2).
//
// GiNaC orders terms and factors by hash; the way back orders them by the model's declarations instead: numbers first, then
// pi, constants, coordinates, functions (by their first coordinate), sums. So the output never depends on GiNaC's internals.
#pragma once

#include <ginac/ginac.h>

#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "corank/core/exact_number.h"
#include "corank/symbolic/model/expression.h"
#include "corank/symbolic/model/mechanism.h"

namespace corank::symbolic {

/// As GiNaC prints it.
std::string text_of(const GiNaC::ex& e);
/// The terms of a sum (Kind: GiNaC::add) or the factors of a product (GiNaC::mul). Any other expression is its only part.
template <typename Kind>
GiNaC::exvector parts_of(const GiNaC::ex& e) {
  return GiNaC::is_a<Kind>(e) ? GiNaC::exvector(e.begin(), e.end()) : GiNaC::exvector{e};
}
/// log2 of the largest numerator or denominator in an expression, an upper bound.
double numeric_bits(const GiNaC::ex& e);
/// Numbers with more bits are refused.
inline constexpr double kMaxBits = 100'000;
/// Raises only where the numbers of the result stay below about kMaxBits; throws std::domain_error otherwise.
GiNaC::ex guarded_power(const GiNaC::ex& base, const GiNaC::ex& exponent);
/// A decimal of the model language as an exact rational number. Throws std::domain_error where it is absurdly long.
GiNaC::numeric exact_decimal(const std::string& decimal);
/// Which of the language's functions a GiNaC function is; nothing where it is none.
std::optional<ConstantFunction> constant_function(const GiNaC::ex& function);

class GinacBridge {
 public:
  /// A mechanism's constants and coordinates.
  explicit GinacBridge(const Mechanism& mechanism);
  /// The order of the names is the order of the output.
  GinacBridge(const std::vector<std::string>& constants, const std::vector<std::string>& coordinates);

  /// Throws ModelError (at the subexpression, or at `otherwise` where it has no place) for an unknown name, a division by
  /// zero, an absurd power.
  GiNaC::ex to_ginac(const Expression& e, const SourceLocation& otherwise) const;
  /// Throws std::domain_error for what the model language cannot say (a complex number).
  Expression to_expression(const GiNaC::ex& e) const;

  const GiNaC::symbol& symbol(const std::string& name) const { return symbols_.at(name); }
  /// The symbols that occur.
  std::set<std::string> names_in(const GiNaC::ex& e) const;
  /// Does a coordinate occur?
  bool mentions_coordinate(const GiNaC::ex& e) const;

 private:
  /// Where a factor stands: kind, index of declaration, text.
  using Rank = std::tuple<int, int, std::string>;

  Rank rank(const GiNaC::ex& factor) const;
  int first_coordinate(const GiNaC::ex& e) const;
  struct Factor {
    Rank order;
    GiNaC::ex base, exponent;
  };

  /// The factors of coefficient·Π base^exponent in order. Sums are oriented: their first term is positive.
  std::vector<Factor> factors(const GiNaC::ex& term, GiNaC::numeric& coefficient) const;
  const GiNaC::exvector& ordered_terms(const GiNaC::ex& sum) const;
  bool begins_negative(const GiNaC::ex& sum) const;
  Expression translate(const GiNaC::ex& e) const;
  Expression sum(const GiNaC::ex& e) const;
  Expression product(const GiNaC::ex& e) const;
  Expression expression(const Factor& factor) const;

  std::map<std::string, GiNaC::realsymbol> symbols_;
  std::map<std::string, int> constants_, coordinates_;
  // Done work: without it, the time would grow exponentially with the nesting of sums.
  mutable std::map<GiNaC::ex, GiNaC::exvector, GiNaC::ex_is_less> ordered_;
  mutable std::map<GiNaC::ex, Expression, GiNaC::ex_is_less> translated_;
};

}  // namespace corank::symbolic
