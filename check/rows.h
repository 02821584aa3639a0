// Polynomials and sines over boxes of Enclosures: values, slopes, derivatives, projections.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "corank/check/terms.h"
#include "corank/core/singularity_types.h"

namespace corank::check {

using Sides = std::vector<Enclosure>;

/// One row f, over the variables that were kept, by their places among those.
class Row {
 public:
  /// place[j]: of variable j among the kept ones.
  Row(const Terms& f, const std::vector<int>& place);
  /// Over all variables; `variables` is their number.
  Row(const Polynomial& f, int variables, double tolerance = 0);

  const std::vector<int>& columns() const { return columns_; }  ///< the variables of f, ascending

  /// Encloses {f(x) : x ∈ X}: the natural interval extension.
  Enclosure value(const Sides& x) const;
  /// s with f(x) − f(c) ∈ s·(x − c) for every x ∈ X and a point c; entries follow columns(). For terms of degree ≤ 2 these
  /// are the derivatives over (X + c)/2: x² − c² = (x + c)(x − c), xy − ab = (y + b)/2 (x − a) + (x + a)/2 (y − b).
  void slopes(const Sides& x, const Sides& c, Sides& s) const;
  /// Encloses ∂f/∂x over X.
  void derivatives(const Sides& x, Sides& s) const;
  /// f and ∂f/∂x at a point in plain doubles: nothing is proven by them.
  double approximate(const std::vector<double>& x) const;
  void approximate(const std::vector<double>& x, std::vector<double>& s) const;
  /// Shrinks X to a box that holds every x ∈ X with f(x) = 0 (f(x) ≥ 0). False: there is none. Theorem: if Σ tₖ(x) = 0 then
  /// tₖ(x) ∈ −Σ_{j≠k} Tⱼ, Tⱼ an enclosure of tⱼ over X, and each variable of tₖ lies in the inverse image of that set
  /// (Benhamou1999). For f(x) ≥ 0 also by f(c) + s·(x − c) ≥ 0 with the slopes about the midpoint, each x solved for.
  bool project(Sides& x, bool equation) const;

 private:
  struct TermFactor {
    int variable, power, column;
    Function function;
  };
  struct Term {
    Enclosure c;
    double approximate;
    std::vector<TermFactor> parts;

    const Enclosure& coefficient(const Enclosure&) const { return c; }
    double coefficient(double) const { return approximate; }
  };
  // Number: Enclosure or double.
  template <class Number>
  static Number value(const TermFactor& p, const Number& x);
  template <class Number>
  static Number derivative(const TermFactor& p, const Number& x);
  static Enclosure slope(const TermFactor& p, const Enclosure& x, const Enclosure& c);
  template <class Number>
  static Number value(const Term& t, const std::vector<Number>& x);
  template <class Number>
  void find_derivatives(const std::vector<Number>& x, std::vector<Number>& s) const;
  bool is_linear() const;
  bool project_by_slopes(Sides& x) const;
  static bool invert(const Term& t, const Enclosure& image, Sides& x);

  std::vector<Term> terms_;
  std::vector<int> columns_;
};

/// Over all variables; `variables` is their number.
std::vector<Row> rows_of(const std::vector<Polynomial>& list, int variables, double tolerance = 0);

/// The entries of a matrix over all variables, row by row.
using RowMatrix = std::vector<std::vector<Row>>;
RowMatrix entries_of(const PolynomialMatrix& matrix, int variables, double tolerance = 0);
std::vector<Sides> values(const RowMatrix& matrix, const Sides& x);
/// Of all entries, ascending.
std::vector<int> variables_of(const RowMatrix& matrix);

/// Have two boxes of as many sides a point in common?
bool overlap(const Sides& x, const Sides& y);

/// Of each variable the width of its domain, of a parameter its size; 1 where that is 0. By their share of it sides of
/// unlike units compare.
std::vector<double> domain_lengths(const System& system);

/// The halves of x, cut in the middle of one of these sides: of those that can be cut, the one that is widest in units of
/// its length. Nothing where no side can be cut.
std::optional<std::array<Sides, 2>> halved(const Sides& x, const std::vector<int>& sides,
                                           const std::vector<double>& lengths);

/// Is `shown` true of x, or else of all parts into which halved() divides it? It may shrink a part to what matters. False
/// where more than `most_parts` parts are looked at, or one cannot be halved.
bool shown_in_parts(Sides x, const std::vector<int>& sides, const std::vector<double>& lengths, int most_parts,
                    const StopFlag& stop, const std::function<bool(Sides&)>& shown);

}  // namespace corank::check
