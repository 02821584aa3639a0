#include "corank/symbolic/sets/critical_points.h"

#include <cmath>

#include "corank/core/exact_number.h"
#include "corank/symbolic/algebra/ginac_bridge.h"
#include "corank/symbolic/algebra/ginac_lock.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/symbolic/sets/kernel_scale.h"
#include "corank/symbolic/velocity/kernel_vector.h"

namespace corank::symbolic {
namespace {

// Number k of a fixed sequence without pattern, in [0.2, 1.2), its signs mixed.
Expression coefficient(int height, std::size_t k) {
  const unsigned long place = 7919UL * static_cast<unsigned long>(height) + k + 1;
  const unsigned long fraction = place * 618'034UL % 1'000'000UL;
  const std::string digits = std::to_string(2000 + fraction / 100);  // in 2000 … 11999
  const Expression size = Expression::number(digits) / Expression(10000);
  return place * 414'214UL % 1'000'000UL < 500'000UL ? size : -size;
}

// Half the range of each variable as a power of two, so that lengths weigh as much as angles in every unit.
std::vector<int> size_exponents(const System& system) {
  std::vector<int> exponents;
  for (const Variable& v : system.variables) {
    const double half = 0.5 * v.domain.width();
    exponents.push_back(half > 0 && std::isfinite(half) ? static_cast<int>(std::lround(std::log2(half))) : 0);
  }
  return exponents;
}

Expression power_of_two(int exponent) {
  return exponent >= 0 ? pow(Expression(2), exponent) : Expression(1) / pow(Expression(2), -exponent);
}

Expression height_function(const Mechanism& mechanism, int height) {
  const System system = algebrize(plain_system(mechanism));
  const std::vector<int> exponents = size_exponents(system);
  std::vector<Expression> terms;
  for (std::size_t i = 0; i < mechanism.coordinates().size(); ++i) {
    const Coordinate& coordinate = mechanism.coordinates()[i];
    if (coordinate.auxiliary || is_fixed(coordinate)) continue;
    const Expression x = Expression::symbol(coordinate.name);
    if (coordinate.kind == CoordinateKind::angle) {
      terms.push_back(coefficient(height, 2 * i) * cos(x));
      terms.push_back(coefficient(height, 2 * i + 1) * sin(x));
    } else {
      const int exponent = exponents[system.find(coordinate.name)];
      terms.push_back(coefficient(height, 2 * i) * power_of_two(-exponent) * x);
    }
  }
  return sum_of(terms);
}

// Of λ, one over the size of its equation; of μ, whose height is of size 1: (λ, μ) has components of one size in every unit.
std::vector<std::string> multiplier_scales(const Mechanism& mechanism) {
  std::vector<std::string> scales;
  for (const double size : equation_sizes(mechanism))
    scales.push_back(pow(ExactNumber(2), -static_cast<int>(std::lround(std::log2(size)))).text());
  scales.emplace_back("1");
  return scales;
}

constexpr SetDefinition kCritical{
    .set = std::nullopt, .name = "critical", .matrix = "[Phi_q; grad h]", .side = KernelSide::left};

}  // namespace

CriticalPoints critical_points(const Mechanism& mechanism, int height) {
  mechanism.validate();
  CriticalPoints result;
  for (const Coordinate& c : mechanism.coordinates())
    if (!is_fixed(c)) result.names.push_back(c.name);
  const Expression h = height_function(mechanism, height);

  const GinacLock lock;
  const GinacBridge bridge(mechanism);
  std::vector<GiNaC::ex> functions;
  KernelQuestion kernel{kCritical, kCritical.matrix, {result.names, {}}, {}, KernelSide::left, {}};
  for (const Constraint& c : mechanism.equations()) {
    functions.push_back(bridge.to_ginac(c.relation.lhs, c.where) - bridge.to_ginac(c.relation.rhs, c.where));
    kernel.where.push_back(c.where);
  }
  functions.push_back(bridge.to_ginac(h, {}));
  kernel.where.push_back({});
  for (const GiNaC::ex& f : functions) {
    std::vector<Expression>& row = kernel.matrix.rows.emplace_back();
    for (const std::string& name : result.names) row.push_back(bridge.to_expression(f.diff(bridge.symbol(name))));
  }
  result.jacobian = kernel.matrix;
  result.jacobian.rows.pop_back();
  result.system = singularity_system(mechanism, kernel, multiplier_scales(mechanism), 1);

  const std::vector<Expression> multipliers = scaled(result.system.kernel_unknowns, result.system.kernel_scales);
  result.multiplier = multipliers.back();
  result.hessian = {result.names, {}};
  for (const std::string& a : result.names) {
    std::vector<Expression>& row = result.hessian.rows.emplace_back();
    for (const std::string& b : result.names) {
      std::vector<Expression> terms;
      for (std::size_t k = 0; k < functions.size(); ++k) {
        const GiNaC::ex second = functions[k].diff(bridge.symbol(a)).diff(bridge.symbol(b));
        if (!second.is_zero()) terms.push_back(multipliers[k] * bridge.to_expression(second));
      }
      row.push_back(terms.empty() ? Expression(0) : sum_of(terms));
    }
  }
  return result;
}

}  // namespace corank::symbolic
