// The interval Newton operator for m equations in n ≥ m unknowns, as a contractor and as a proof.
//
// A Preconditioner picks, for each of r ≤ m equations, one dependent variable, and holds an r×r real matrix Y. Any choice is
// *valid*: it decides how much is gained, never whether a conclusion is true. The other variables are called free.
#pragma once

#include <vector>

#include "corank/certify/compiled_system.h"
#include "corank/certify/panel.h"

namespace corank::certify {

struct Preconditioner {
  std::vector<int> equations;  ///< r rows of the system, distinct
  std::vector<int> dependent;  ///< r variables, distinct; row a of Y·F is solved for dependent[a]
  std::vector<double> y;       ///< r×r, row-major
  int rank() const { return static_cast<int>(dependent.size()); }
};

/// Buffers for one thread. Between calls only those of the last newton_contract mean something, to contract_free,
/// tighten_part and value_at_zeros, which check that they are given its rows and a part of its box.
struct NewtonWorkspace {
  Panel panel;
  std::vector<Interval> slope, values, residual, offset, image, region, gradient;
  std::vector<double> center, magnitude, radius, next_radius;
  std::vector<unsigned char> is_dependent;
  std::vector<int> free;
  // The last newton_contract:
  bool contracted = false;           ///< it had a bounded Y·S and Y·F(c), and nothing has replaced them
  std::vector<Interval> stepped;     ///< the box that it was given
  std::vector<int> rows, row_sides;  ///< its p.equations and p.dependent
};

struct NewtonOutcome {
  bool empty = false;    ///< the box holds no solution
  bool regular = false;  ///< no diagonal entry of Y·S(X) held 0: a hint that a proof is worth trying, no claim
  double spread = 0;     ///< largest row sum of |I − Y·S_D|, weighted by the scales: below 1 a proof may succeed; a hint
};

/// Contracts the dependent variables of x in place.
/// Theorem (interval Newton, Hansen–Sengupta step; key Neumaier1990, ch. 5; HansenSengupta1981): for any centre c and real
/// Y, a zero x of F in X satisfies Y·F(c) + Y·S(X)·(x − c) ∋ 0 row by row, so each row bounds its dependent variable by the
/// others. Points of X outside the contracted box are no solutions; where a row is unsatisfiable, X holds none. Proves
/// nothing about existence.
NewtonOutcome newton_contract(const CompiledSystem& system, const Preconditioner& p, Interval* x, NewtonWorkspace& w);

/// After newton_contract(system, p, y, w): contracts the free variables of x ⊂ y in place. The same rows, each solved for a
/// free variable, so the same theorem: every zero of F in x lies in what is left. False: x holds none. Where the step had
/// no bounded Y·S: nothing happens.
bool contract_free(const Preconditioner& p, Interval* x, NewtonWorkspace& w);

/// What newton_prove shows about a box of values of the free variables.
struct Sheet {
  bool proven = false;
  std::vector<int>
      equations;    ///< the rows that the proof speaks of: all of them, or a subset (over-determined systems, self-motions)
  int motion = -1;  ///< which self-motion it lies on, along which all rows hold (certify/self_motion.h); −1: none
  std::vector<int> dependent;
  std::vector<Interval> region;  ///< n: free sides as given, dependent sides inflated
  std::vector<Interval> image;   ///< n: free sides as given, dependent sides the Newton image, inside region's interior
};

/// Tries to prove, for X_F the sides of the free variables in x: for **every** value f ∈ X_F there is **exactly one** dependent
/// value d with (f, d) in `region` and F(f, d) = 0, and that d lies in `image`. F stands for the
/// rows p.equations. Besides, every zero of F in x lies in `image`.
///
/// Theorem (parametric Krawczyk; keys Krawczyk1969, Neumaier1990 ch. 5, Rump2010; proof in doc/theory.md): let Z be a box of
/// dependent values, B = X_F × Z, c a centre and K = c_D − Y·F(c) + (I − Y·S_D(B))(Z − c_D) − Y·S_F(B)(X_F − c_F).
///   (1) K ⊂ int Z                          ⇒ for every f ∈ X_F the map d ↦ d − Y·F(f, d) sends Z into itself and has a fixed
///                                            point (Brouwer), and every zero of F(f, ·) in Z lies in K;
///   (2) |I − Y·J_D(B)|·r < r for some r > 0 ⇒ every matrix in Y·J_D(B) is regular, so Y is regular (fixed points are zeros)
///                                            and F(f, ·) has at most one zero in Z (mean value theorem, row by row);
///   (3) every zero of F in B lies in X_F × K. So if Z_{k+1} ⊇ K(Z_k) and Z_0 is x's own, no zero of x is left behind.
/// S may be slopes about c in (1); (2) needs the interval Jacobian J over B.
/// Z comes from ε-inflation of the image, at most `iterations` times; the dependent variables stay the same throughout.
Sheet newton_prove(const CompiledSystem& system, const Preconditioner& p, const Interval* x, NewtonWorkspace& w,
                   int iterations = 8);

/// After newton_contract(system, p, y, w): encloses f_row at the zeros of p's rows in x ⊂ Y, Y the box that the step was
/// given and `row` any row. Let R = Y·F and λ real: R(c) + Y·S (z − c) ∋ 0 at a zero z, so f_row(z) ∈ f_row(c) − λ·R(c) +
/// (S_row − λ·Y·S)(X − c). Here λ makes the dependent variables' part vanish nearly; any λ is valid. Where the step had no
/// bounded Y·S: the whole line.
Interval value_at_zeros(const CompiledSystem& system, const Preconditioner& p, int row, const Interval* x,
                        NewtonWorkspace& w);

/// One step of (1)'s image inside a proven sheet: the box must have the sheet's dependent sides or a part of them that is
/// known to hold the solutions, free sides within the sheet's, and p the sheet's rows and dependents. Shrinks dependent sides
/// only, so that the sheet's claim carries over. Returns the step's NewtonOutcome::spread, infinite where Y·S_D is not regular.
double tighten_sheet(const CompiledSystem& system, const Preconditioner& p, Interval* x, NewtonWorkspace& w);

/// After tighten_sheet(system, p, y, w): tightens a part x ⊂ y in the same way, by the slopes over y, which hold on every
/// part of it. A tenth of the work, and less sharp. Where the step had no bounded Y·S: nothing happens.
void tighten_part(const Preconditioner& p, Interval* x, NewtonWorkspace& w);

}  // namespace corank::certify
