#include "corank/symbolic/velocity/known_values.h"

#include "corank/symbolic/algebra/exact_algebra.h"
#include "corank/symbolic/algebra/ginac_lock.h"

namespace corank::symbolic {
namespace {

// Angles that have one value are replaced by it where their sines and cosines are 0 or ±1. Of another value cos² + sin² = 1
// is worth more than its name.
class RightAngles {
 public:
  explicit RightAngles(const Mechanism& mechanism) : bridge_(mechanism) {
    for (const Coordinate& c : mechanism.coordinates()) {
      if (c.kind != CoordinateKind::angle || !symbolic::is_fixed(c)) continue;
      const GiNaC::ex value = bridge_.to_ginac(c.lower, c.where);
      if (GiNaC::ex(GiNaC::sin(2 * value)).is_zero()) values_[bridge_.symbol(c.name)] = value;
    }
  }

  void put_into(std::vector<Expression>& expressions) const {
    if (values_.empty()) return;
    for (Expression& e : expressions) {
      const GiNaC::ex written = bridge_.to_ginac(e, {}), value = written.subs(values_);
      if (!value.is_equal(written)) e = bridge_.to_expression(value.expand());
    }
  }

 private:
  const GinacBridge bridge_;
  GiNaC::exmap values_;
};

void clear_zeros(const Mechanism& mechanism, ExpressionMatrix& matrix) {
  if (!mechanism.toleranced().empty()) return;
  const ExactAlgebra algebra(mechanism);
  for (std::vector<Expression>& row : matrix.rows)
    for (Expression& e : row)
      if (!same_tree(e, 0) && algebra.value(e).is_zero()) e = Expression(0);
}

}  // namespace

void put_in_known_values(const Mechanism& mechanism, ExpressionMatrix& matrix, std::vector<Expression>& phi) {
  const GinacLock lock;
  const RightAngles fixed(mechanism);
  fixed.put_into(phi);
  for (std::vector<Expression>& row : matrix.rows) fixed.put_into(row);
  clear_zeros(mechanism, matrix);
}

}  // namespace corank::symbolic
