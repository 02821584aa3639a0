// The checker's own sparse polynomials with exact coefficients, and its repetition of the reduction that came before a
// search.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "corank/check/enclosure.h"
#include "corank/check/stop.h"
#include "corank/core/reduction_step.h"
#include "corank/core/system.h"

namespace corank::check {

/// One sine or cosine; one variable.
inline bool is_function(const Factors& factors) { return factors.size() == 1 && factors[0].function != Function::identity; }
inline bool is_variable(const Factors& factors) { return factors.size() == 1 && factors[0] == Factor{factors[0].variable}; }
/// The product, where neither has a sine or cosine.
Factors merged(const Factors& a, const Factors& b);

/// A coefficient; `range` encloses it, or all choices within the tolerance.
struct Coefficient {
  ExactNumber exact;
  Enclosure range;
  bool tolerant = false;  ///< range has more than the exact number
};

/// Σ coefficient · Π factors, as Polynomial, with distinct factor lists.
class Terms {
 public:
  Terms() = default;
  Terms(const Polynomial& f, double tolerance);
  explicit Terms(const ExactNumber& constant);

  const std::map<Factors, Coefficient>& list() const { return list_; }
  bool mentions(int variable) const;
  bool mentions_inside_function(int variable) const;
  bool is_constant() const;
  bool is_exact() const;  ///< no coefficient has a tolerance
  ExactNumber constant() const;
  /// a and c where this is a·x_variable + c.
  struct Affine {
    int variable;
    ExactNumber a, c;
  };
  std::optional<Affine> affine() const;

  /// −g/a where this is a·x + g with a rational a ≠ 0 and x not in g.
  std::optional<Terms> solved_for(int variable) const;
  /// x replaced by a value; nothing where a sine or cosine would become a factor.
  std::optional<Terms> substituted(int variable, const Terms& value) const;
  /// Is this q·g with a rational q, in exact coefficients?
  bool is_multiple_of(const Terms& g) const;

  /// this + q·g.
  Terms plus(const ExactNumber& q, const Terms& g) const;
  /// this times powers of variables; nothing where a sine or cosine would become a factor.
  std::optional<Terms> times(const Factors& powers) const;

 private:
  void add(const Factors& factors, const Coefficient& c);
  void drop_zeros();

  std::map<Factors, Coefficient> list_;
};

Terms operator-(const Terms& f, const ExactNumber& c);
Terms operator-(const Terms& f);

/// A reduced system. Variables keep their indices in the original one.
struct Reduced {
  std::vector<int> kept;
  std::vector<Terms> equations;              ///< none vanishes or is a multiple of one before
  std::vector<Terms> inequalities;           ///< the system's
  std::vector<Terms> implied;                ///< they follow from the equations
  std::vector<std::optional<Terms>> values;  ///< of each eliminated variable: its value in the kept ones
  bool contradiction = false;                ///< an equation became a nonzero number = 0
};

/// Repeats the reduction. Theorem: certify/reduction.h. Each step is legal: an elimination's equation is a·x + g = 0 with a
/// rational a ≠ 0 and x not in g, or the domain of x is one number; a sum is of two different equations that are there; an
/// implied equation, which no other step may follow, is Σ q·p·f with rational q, products p of powers of kept variables, and
/// equations f that are there. Throws std::invalid_argument, with the reason, where one is not.
Reduced reduce(const System& system, const std::vector<ReductionStep>& steps, const StopFlag& stop = {});

}  // namespace corank::check
