// Sines and cosines of lengths. Unlike an angle, a length may stand outside them, too, and its turns count, so they cannot
// replace it.
//
// While equations are expanded, a *stand-in* variable takes the place of cos t or sin t. Afterwards each is settled:
//   - where it is a term of its own everywhere, it becomes what it is (Function);
//   - where it is a factor in a product or a power, it becomes a new variable c_t or s_t in [−1, 1], with the equation
//     c_t − cos t = 0. The relation c_t² + s_t² = 1 follows from two of these, and is not added.
// An argument that is no single length, such as x + y or 2t, becomes a new variable itself, with the equation u − x − y = 0:
// Chebyshev's polynomials in c_t would enclose cos 2t, cos 3t … ever more coarsely.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "corank/core/system.h"
#include "corank/symbolic/algebra/expanded_polynomial.h"

namespace corank::symbolic {

class LengthFunctions {
 public:
  /// Variables from `first` on are stand-ins, until settle().
  void start(int first) { first_ = first; }

  /// The variable of a linear combination of lengths, each with a coefficient whose sign is known: the one length's, or a
  /// stand-in.
  int argument(const ExpandedPolynomial& lengths);
  /// The stand-ins for the cosine and the sine of an argument().
  std::pair<ExpandedPolynomial, ExpandedPolynomial> cosine_and_sine(int argument);

  /// Settles the stand-ins in the system's equations and inequalities; new variables and their equations go to the end.
  /// `fresh_name` lengthens a name until it is free.
  void settle(System& system, const std::function<std::string(std::string)>& fresh_name);

 private:
  struct StandIn {
    Function function;  ///< identity: of a linear combination
    int argument;       ///< of a sine or cosine: a length, or a stand-in, after settle() its variable
    ExpandedPolynomial sum;
    bool used = false, multiplied = false;
    int variable = -1;  ///< after settle(), where it has become one
  };

  bool is_sum(const StandIn& s) const { return s.function == Function::identity; }
  void mark(const std::vector<Polynomial>& polynomials);
  void replace(std::vector<Polynomial>& polynomials) const;
  void add_sum(StandIn& s, System& system, const std::function<std::string(std::string)>& fresh_name) const;

  int first_ = 0;
  std::vector<StandIn> stand_ins_;
};

}  // namespace corank::symbolic
