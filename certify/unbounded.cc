#include "corank/certify/unbounded.h"

#include <cstdint>
#include <map>

#include "corank/certify/compiled_system.h"
#include "corank/certify/polynomial_algebra.h"
#include "corank/certify/projection.h"
#include "corank/core/check.h"
#include "corank/core/cover.h"
#include "corank/core/rounding.h"

namespace corank::certify {
namespace {

// α x² + B x for one variable without bounds.
struct Square {
  Interval alpha, linear;
};

// What the theorem says of f ≤ 0, with I the variables that have no bounds.
class Squares {
 public:
  Squares(const Polynomial& f, int sign, const Box& x) : x_(x), sign_(sign) {
    for (const Monomial& m : f.monomials) find_square(m);
    for (const Monomial& m : f.monomials)
      if (applies_) add(m);
  }

  // Returns false where no point of x satisfies f ≤ 0.
  bool contract(Box& x) const {
    if (!applies_ || squares_.empty()) return true;
    Interval s = -rest_;
    for (const auto& [i, q] : squares_) s += *divide(square(q.linear), scale(4, q.alpha), Interval::whole());
    if (s.hi() < 0) return false;
    for (const auto& [i, q] : squares_) {
      const Interval center = -*divide(q.linear, scale(2, q.alpha), Interval::whole());
      const double radius = square_root(*divide(Interval(0, s.hi()), q.alpha, Interval::whole()))->hi();
      if (!x[i].intersect(center + Interval(-radius, radius))) return false;
    }
    return true;
  }

 private:
  bool is_free(const Factor& f) const { return f.function == Function::identity && !x_[f.variable].is_bounded(); }

  void find_square(const Monomial& m) {
    if (m.factors.size() != 1 || m.factors[0].power != 2 || !is_free(m.factors[0])) return;
    const Interval alpha = sign_ < 0 ? -m.enclosure : m.enclosure;
    if (alpha.lo() > 0) squares_.emplace(m.factors[0].variable, Square{alpha, Interval()});
  }

  void add(const Monomial& m) {
    const Factor* free = nullptr;
    int frees = 0;
    Interval others = sign_ < 0 ? -m.enclosure : m.enclosure;
    for (const Factor& f : m.factors) {
      if (is_free(f))
        free = &f, ++frees;
      else
        others *= evaluate(f, x_);
    }
    if (frees == 0) {
      rest_ += others;
      return;
    }
    const auto known = squares_.find(free->variable);
    if (frees == 1 && known != squares_.end() && free->power == 1) {
      known->second.linear += others;
    } else if (frees == 1 && known != squares_.end() && free->power == 2 && m.factors.size() == 1) {
      return;  // α itself
    } else {
      for (const Factor& f : m.factors)
        if (is_free(f)) others *= evaluate(f, x_);
      applies_ = others.lo() >= 0;  // a part of R
    }
  }

  const Box& x_;
  int sign_;
  bool applies_ = true;
  std::map<int, Square> squares_;
  Interval rest_;
};

bool contract_squares(const System& system, Box& x) {
  for (const Polynomial& f : system.equations)
    for (const int sign : {1, -1})
      if (!Squares(f, sign, Box(x)).contract(x)) return false;
  for (const Polynomial& g : system.inequalities)  // g ≥ 0
    if (!Squares(g, -1, Box(x)).contract(x)) return false;
  return true;
}

bool gains(const Box& before, const Box& after) {
  constexpr double kGain = 0.99;
  for (std::size_t j = 0; j < before.size(); ++j) {
    const bool bounded = before[j].is_bounded();
    if (bounded ? after[j].width() < kGain * before[j].width() : !(after[j] == before[j])) return true;
  }
  return false;
}

}  // namespace

bool contract_unbounded(const System& system, std::vector<Interval>& x) {
  constexpr int kRounds = 100;
  const UpwardRounding rounding;
  const CompiledSystem compiled(system);
  CORANK_CHECK(x.size() == system.variables.size());
  std::vector<std::uint8_t> changed(x.size());
  for (int round = 0; round < kRounds; ++round) {
    const Box before = x;
    for (int row = 0; row < compiled.rows(); ++row)
      if (!project(compiled, row, x, 0, changed.data())) return false;
    if (!contract_squares(system, x)) return false;
    if (!gains(before, x)) break;
  }
  return true;
}

}  // namespace corank::certify
