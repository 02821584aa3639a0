// The interval Newton operator for m equations in n ≥ m unknowns, as a contractor and as a proof.
//
// A Preconditioner picks, for each of r ≤ m equations, one dependent variable, and holds an r×r real matrix Y. Any choice is
// *valid*: it decides how much is gained, never whether a conclusion is true. The other variables are called free.
#pragma once

#include <cmath>
#include <memory>
#include <span>
#include <vector>

#include "corank/certify/affine_form.h"
#include "corank/certify/compiled_system.h"

namespace corank::certify {

struct Preconditioner {
  std::vector<int> equations;  ///< r rows of the system, distinct
  std::vector<int> dependent;  ///< r variables, distinct; row a of Y·F is solved for dependent[a]
  std::vector<double> y;       ///< r×r, row-major
  int rank() const { return static_cast<int>(dependent.size()); }
};

/// Serves pieces whose chart is known; any choice is valid. All m equations, these m dependents, Y the inverse of their
/// Jacobian at the point, in floating point; Y = 0 where there is no inverse.
Preconditioner midpoint_preconditioner(const CompiledSystem& system, const std::vector<double>& point,
                                       const std::vector<int>& dependent);

struct NewtonBuffers;  // what a step or a proof computes with

/// Memory for the steps and proofs of one thread, so that they need not allocate any: nothing in it means anything. Outlives
/// its steps, and stays where it is as long as there are some.
class NewtonWorkspace {
 public:
  NewtonWorkspace();
  ~NewtonWorkspace();
  NewtonWorkspace(NewtonWorkspace&&) noexcept;
  NewtonWorkspace& operator=(NewtonWorkspace&&) noexcept;

  struct GiveBack {
    NewtonWorkspace* home;
    void operator()(NewtonBuffers* buffers) const;
  };
  /// Buffers that come back at the end of their use.
  using Borrowed = std::unique_ptr<NewtonBuffers, GiveBack>;
  Borrowed take();

 private:
  std::vector<std::unique_ptr<NewtonBuffers>> spare_;
};

struct NewtonOutcome {
  bool empty = false;    ///< the box holds no solution
  bool regular = false;  ///< no diagonal entry of Y·S(X) held 0: a hint that a proof is worth trying, no claim
  /// Largest row sum of |I − Y·S_D|, weighted by the scales, where regular: below 1 a proof may succeed; a hint.
  double spread = HUGE_VAL;
};

/// One interval Newton step on a box X about its midpoint c: the rows Y·F(c) + Y·S(X)·(x − c) ∋ 0, which each zero x of p's
/// equations in X satisfies. What it says about a part of X needs nothing but the step. Requires UpwardRounding::active()
/// throughout; a box that is no part of X breaks an invariant (CORANK_CHECK).
class NewtonStep {
 public:
  /// Contracts the dependent variables of x in place.
  /// Theorem (interval Newton, Hansen–Sengupta step; key Neumaier1990, ch. 5; HansenSengupta1981): for any centre c and real
  /// Y, a zero x of F in X satisfies Y·F(c) + Y·S(X)·(x − c) ∋ 0 row by row, so each row bounds its dependent variable by
  /// the others. Points of X outside the contracted box are no solutions; where a row is unsatisfiable, X holds none. Proves
  /// nothing about existence.
  NewtonStep(const CompiledSystem& system, const Preconditioner& p, std::span<Interval> x, NewtonWorkspace& w);

  const NewtonOutcome& outcome() const { return outcome_; }
  const CompiledSystem& system() const { return *system_; }
  const std::vector<int>& equations() const;  ///< p's
  const std::vector<int>& dependent() const;  ///< p's

  /// Contracts the free variables of a part x of X in place: the same rows, each solved for a free variable, so the same
  /// theorem. Every zero of F in x lies in what is left. False: x holds none. Where the step has no bounded Y·S nothing
  /// happens.
  bool contract_free(std::span<Interval> x) const;

  /// Encloses f_row at the zeros of p's rows in a part x of X, `row` any row of the system. Let R = Y·F and λ real: R(c) +
  /// Y·S (z − c) ∋ 0 at a zero z, so f_row(z) ∈ f_row(c) − λ·R(c) + (S_row − λ·Y·S)(x − c). Here λ makes the dependent
  /// variables' part vanish nearly; any λ is valid. Where the step has no bounded Y·S: the whole line.
  Interval value_at_zeros(int row, std::span<const Interval> x) const;
  /// The same as an affine form in the offsets x_f − c_f of the free variables, `free`, from the step's centre: by the same
  /// rows, f_row(z) = value + Σ_j g_j (z_j − c_j) with some g_j in intervals; what dependent variables add is in its
  /// constant. `variable`: the form of one of the system's variables. Where the step has no bounded Y·S: the whole line.
  AffineForm form_at_zeros(int row, std::span<const Interval> x, const std::vector<int>& free) const;
  AffineForm form_of_variable(int variable, std::span<const Interval> x, const std::vector<int>& free) const;

  /// Of a step inside a proven sheet (tighten_sheet): tightens a part x of X in the same way, by the slopes over X, which
  /// hold on every part of it. A tenth of the work of a step, and less sharp. Where the step has no bounded Y·S nothing
  /// happens.
  void tighten_part(std::span<Interval> x) const;

  /// For heuristics, nothing is proven by them: the step's centre, ∂(dependent[a])/∂(free j) of the linearized system, and
  /// how wide rounding makes Y·F(c) in row a. Nearly meaningless, 0, where the step has no bounded Y·S.
  std::span<const double> center() const;
  double derivative(int a, int j) const;
  double noise(int a) const;
  /// Of each variable Σ_a √(u_aj / Σ_k u_ak), its shares in what the rows leave open over a part x of X: u_aj = |Y·S − I|_aj
  /// times the width of x_j, where I has its 1 at (a, dependent[a]).
  void add_smears(std::span<const Interval> x, std::vector<double>& sums) const;

 private:
  void check_part(std::span<const Interval> x) const;
  // Of a function that is value + gradient·(z − c) at z, the same at zeros: with dependent variables' parts nearly 0.
  bool eliminate_dependents(Interval& value, std::vector<Interval>& gradient) const;
  Interval gradient_about_center(int row, std::span<const Interval> x) const;
  AffineForm form_of(Interval value, std::span<const Interval> x, const std::vector<int>& free) const;

  const CompiledSystem* system_;
  NewtonWorkspace::Borrowed buffers_;
  NewtonOutcome outcome_;
  bool bounded_ = false;  // Y·S and Y·F(c) are
};

/// What newton_prove shows about a box of values of the free variables, or newton_prove_in_part about a box.
struct Sheet {
  bool proven = false;
  /// The rows that the proof speaks of: all of them, or a subset (over-determined systems, self-motions).
  std::vector<int> equations;
  int motion = -1;  ///< which self-motion it lies on, along which all rows hold (certify/self_motion.h); −1: none
  std::vector<int> dependent;
  std::vector<Interval> region;  ///< n: free sides as given, dependent sides inflated
  std::vector<Interval> image;   ///< n: free sides as given, dependent sides the Newton image, inside region's interior

  /// Is there a zero for every value of the free variables in the image? False: newton_prove_in_part's claim.
  bool spans_image() const;
};

/// Tries to prove, for X_F the sides of the free variables in x: for **every** value f ∈ X_F there is **exactly one**
/// dependent value d with (f, d) in `region` and F(f, d) = 0, and that d lies in `image`. F stands for the rows p.equations.
/// Besides, every zero of F in x lies in `image`.
///
/// Theorem (parametric Krawczyk; keys Krawczyk1969, Neumaier1990 ch. 5, Rump2010; proof in doc/theory.md): let Z be a box of
/// dependent values, B = X_F × Z, c a centre and K = c_D − Y·F(c) + (I − Y·S_D(B))(Z − c_D) − Y·S_F(B)(X_F − c_F).
///   (1) K ⊂ int Z                          ⇒ for every f ∈ X_F the map d ↦ d − Y·F(f, d) sends Z into itself and has a
///                                            fixed point (Brouwer), and every zero of F(f, ·) in Z lies in K;
///   (2) |I − Y·J_D(B)|·r < r for some r > 0 ⇒ every matrix in Y·J_D(B) is regular, so Y is regular (fixed points are zeros)
///                                            and F(f, ·) has at most one zero in Z (mean value theorem, row by row);
///   (3) every zero of F in B lies in X_F × K. So if Z_{k+1} ⊇ K(Z_k) and Z_0 is x's own, no zero of x is left behind.
/// S may be slopes about c in (1); (2) needs the interval Jacobian J over B.
/// Z comes from ε-inflation of the image, at most `iterations` times; the dependent variables stay the same throughout.
Sheet newton_prove(const CompiledSystem& system, const Preconditioner& p, std::span<const Interval> x, NewtonWorkspace& w,
                   int iterations = 8);

/// The same for a box x that a sheet leaves through sides of dependent variables: for every value f of the free variables
/// in x there is **at most one** d with (f, d) in x and F(f, d) = 0, and for every f in the free sides of `region`, a part
/// of x, there is one, in `region`. The image is x, and J has full rank at every zero of F in it. `near`: about where a zero
/// may be; anything is valid.
/// Theorem: (2) of newton_prove over B = x, and newton_prove in a box about `near`, whose region lies in x.
Sheet newton_prove_in_part(const CompiledSystem& system, const Preconditioner& p, std::span<const Interval> x,
                           std::span<const Interval> near, NewtonWorkspace& w);

/// A step inside a proven sheet: the box must have the sheet's dependent sides or a part of them that is known to hold the
/// solutions, free sides within the sheet's, and p the sheet's rows and dependents. Shrinks dependent sides only, so that
/// the sheet's claim carries over.
NewtonStep tighten_sheet(const CompiledSystem& system, const Preconditioner& p, std::span<Interval> x, NewtonWorkspace& w);

}  // namespace corank::certify
