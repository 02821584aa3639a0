#include "corank/symbolic/sets/kernel_scale.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "corank/certify/compiled_system.h"
#include "corank/certify/projection.h"
#include "corank/core/check.h"
#include "corank/core/rounding.h"
#include "corank/symbolic/algebra/remembered.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/symbolic/sets/requirements.h"

namespace corank::symbolic {
namespace {

constexpr int kSweeps = 12;
constexpr int kLargestPower = 200;  // of a length to the fourth power, in nanometres, say
constexpr double kLeverUnits = 8;   // of the largest lever arm, likewise: of 0.5, 1 … 16 the best for Dextar and the 3-RRR
constexpr double kLengthUnits = 4;  // of the largest size beside angles; measured, see bench/HISTORY.md

// The constraints over the ranges that they leave.
struct Configurations {
  certify::CompiledSystem system;
  std::vector<Interval> box;
};

Configurations narrowed(const System& system) {
  const UpwardRounding rounding;
  Configurations result{certify::CompiledSystem(system), {}};
  for (const Variable& v : system.variables) result.box.push_back(v.domain);
  std::vector<std::uint8_t> changed(result.box.size());
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    const std::vector<Interval> before = result.box;
    for (int row = 0; row < result.system.rows(); ++row)
      if (!certify::project(result.system, row, result.box, 1, changed.data())) return {result.system, before};
  }
  return result;
}

// Hundreds of parts of a boundary ask for the same.
std::shared_ptr<const Configurations> known_configurations(const Mechanism& mechanism) {
  static Remembered<TrigonometricSystem, std::shared_ptr<const Configurations>> remembered(2);
  return remembered.of(plain_system(mechanism), are_alike, [](const TrigonometricSystem& plain) {
    return std::make_shared<const Configurations>(narrowed(algebrize(plain)));
  });
}

double size_of(const Interval& x) {
  const double half = 0.5 * x.width();
  const double size = half > 1e-12 * x.mag() ? half : x.mag();
  return size > 0 && std::isfinite(size) ? size : 1;
}

int exponent_of(double ratio) {
  return std::clamp(static_cast<int>(std::lround(std::log2(ratio))), -kLargestPower, kLargestPower);
}

// Two digits and a power of ten; then a power of two. Sizes that differ in a last bit only are the same number.
std::string number(double size, int exponent) {
  size *= 1 + 1e-9;
  const int ten = static_cast<int>(std::floor(std::log10(size))) - 1;
  const auto digits = std::lround(size / std::pow(10.0, ten));
  const ExactNumber value = ExactNumber(digits) * pow(ExactNumber(10), ten) * pow(ExactNumber(2), exponent);
  return value.text();
}

// None where all are 1.
std::vector<std::string> without_ones(std::vector<std::string> texts) {
  const bool ones = std::ranges::all_of(texts, [](const std::string& text) { return text == "1"; });
  return ones ? std::vector<std::string>{} : std::move(texts);
}

std::vector<std::string> texts(const std::vector<double>& sizes, double unit) {
  if (sizes.empty()) return {};
  double largest = 0;
  for (const double size : sizes) largest = std::max(largest, size);
  std::vector<std::string> result;
  for (const double size : sizes) result.push_back(size == 0 ? "1" : number(unit, exponent_of(size / largest)));
  return without_ones(result);
}

// Times 2^e with |ξ_j| ≤ 2^e/2 for each eliminated rate, as its row gives it in terms of the others.
void scale_eliminated(const Mechanism& mechanism, const KernelQuestion& kernel, std::vector<std::string>& scales) {
  if (scales.empty()) scales.assign(kernel.matrix.columns.size(), "1");
  const System system = algebrize(singularity_system(mechanism, kernel, scales, 1));
  const UpwardRounding rounding;
  const std::vector<Interval> domain = system.domain();
  for (const std::size_t j : kernel.passive.eliminated) {
    const int unknown = system.configuration_size + static_cast<int>(j);
    for (const Polynomial& f : system.equations) {
      double own = 0, others = 0;
      for (const Monomial& m : f.monomials) {
        Interval size = m.enclosure;
        bool is_own = false;
        for (const Factor& x : m.factors) {
          is_own = is_own || x.variable == unknown;
          size *= power(domain[x.variable], x.power);
        }
        is_own ? own = m.enclosure.mig() : others += size.mag();  // own: with the scale it has
      }
      if (!(own > 0)) continue;
      // Upward. What is a power of two but for rounding is one in every unit; there is room for a factor of two.
      const double slack = mechanism.has_own_velocity_equation() ? 1 - 1e-9 : 1;
      const double bound = std::max(others / own * slack, 1.0);
      const ExactNumber factor = pow(ExactNumber(2), static_cast<int>(std::ceil(std::log2(bound))) + 1);
      scales[j] = (ExactNumber::rational(scales[j]) * factor).text();
    }
  }
}

double size_over(const Polynomial& f, const std::vector<Interval>& box) {
  Interval sum(0);
  for (const Monomial& m : f.monomials) {
    Interval term = m.enclosure;
    for (const Factor& x : m.factors)
      term *= x.function == Function::identity ? power(box[x.variable], x.power) : Interval(-1, 1);
    sum += term;
  }
  return std::isfinite(sum.mag()) ? sum.mag() : 0;
}

// max |M_ij(q)| over a box of the model's polynomial system, in doubles, a row for each of M's.
std::vector<std::vector<double>> entry_sizes(const Mechanism& mechanism, const ExpressionMatrix& matrix,
                                             const std::vector<Interval>& box) {
  // An algebrizer makes polynomials of what a model claims, and asks nothing of them.
  TrigonometricSystem system = plain_system(mechanism);
  system.claimed.clear();
  for (const auto& row : matrix.rows)
    for (const Expression& e : row) system.claimed.push_back({e == Expression(0), "entry", {}, false});
  const System polynomials = algebrize(system);
  std::vector<Interval> whole = polynomials.domain();
  std::copy_n(box.begin(), std::min<std::size_t>(box.size(), polynomials.configuration_size), whole.begin());

  const UpwardRounding rounding;
  std::vector<std::vector<double>> sizes;
  std::size_t next = 0;
  for (const auto& row : matrix.rows) {
    sizes.emplace_back();
    for (std::size_t j = 0; j < row.size(); ++j) sizes.back().push_back(size_over(polynomials.claimed[next++], whole));
  }
  return sizes;
}

// Of each column of M: 0 for an angular rate; else how fast the rate is beside angular ones, so that kernel vectors do not
// depend on the unit of length. A linear rate v_j in a row Σ_k L_ik m_k = 0 with an angular rate ω_k is as fast as
// |L_ik| / |L_ij| where ω_k is 1: a lever arm. A row with linear rates only passes the size of one on to the others. All
// lengths times f: a coefficient of dimension length^p becomes f^p times as large, and each of these numbers, of which the
// largest is taken, f times. Linear rates that no row ties to an angular one get the largest of the others, 1 where there is
// none.
std::vector<double> rate_sizes(const Mechanism& mechanism, const ExpressionMatrix& matrix,
                               const std::vector<std::vector<double>>& entries) {
  std::vector<bool> angular;
  for (const std::string& name : matrix.columns) {
    const int rate = mechanism.find_rate(name);
    CORANK_CHECK(rate >= 0);
    angular.push_back(mechanism.rates()[rate].kind == CoordinateKind::angle);
  }
  std::vector<double> sizes(angular.begin(), angular.end());  // 0: not known yet
  for (bool more = true; more;) {
    more = false;
    const std::vector<double> before = sizes;
    for (const std::vector<double>& row : entries) {
      double known = 0;
      for (std::size_t j = 0; j < row.size(); ++j) known = std::max(known, row[j] * before[j]);
      for (std::size_t j = 0; j < row.size(); ++j) {
        if (before[j] > 0 || !(row[j] > 0) || !(known > 0)) continue;
        sizes[j] = std::max(sizes[j], known / row[j]);
        more = true;
      }
    }
  }
  double largest = 0;
  for (std::size_t j = 0; j < sizes.size(); ++j) {
    if (angular[j]) sizes[j] = 0;
    largest = std::max(largest, sizes[j]);
  }
  for (std::size_t j = 0; j < sizes.size(); ++j)
    if (!angular[j] && sizes[j] == 0) sizes[j] = largest > 0 ? largest : 1;
  return sizes;
}

// Of a mechanism's own velocity equation.
std::vector<std::string> scales_of_rates(const Mechanism& mechanism, const KernelQuestion& kernel,
                                         const std::vector<Interval>& box) {
  const auto entries = entry_sizes(mechanism, kernel.matrix, box);
  std::vector<double> sizes = rate_sizes(mechanism, kernel.matrix, entries);
  if (kernel.side == KernelSide::left) {
    std::vector<double> rows;
    for (const std::vector<double>& row : entries) {
      double largest = 0;
      for (std::size_t j = 0; j < row.size(); ++j) largest = std::max(largest, row[j] * (sizes[j] > 0 ? sizes[j] : 1));
      rows.push_back(largest > 0 && std::isfinite(largest) ? largest : 1);
    }
    std::vector<std::string> result;
    for (const double row : rows) result.push_back(number(rows[0] / row, 0));
    return without_ones(result);
  }
  const std::vector<std::size_t>& eliminated = kernel.passive.eliminated;
  const bool angles = std::ranges::find(sizes, 0) != sizes.end();
  double largest = 0;
  for (std::size_t j = 0; j < sizes.size(); ++j)
    if (!std::binary_search(eliminated.begin(), eliminated.end(), j)) largest = std::max(largest, sizes[j]);
  std::vector<double> of_columns = sizes;
  for (const std::size_t j : eliminated)
    if (sizes[j] > 0) of_columns[j] = largest > 0 ? largest : 1;
  std::vector<std::string> result = texts(of_columns, angles && largest > 0 ? kLeverUnits * largest : 1);
  if (!eliminated.empty()) scale_eliminated(mechanism, kernel, result);
  return result;
}

// Of the columns of a right kernel: 0 is an angle's, a direction's, or that of a rate that was eliminated.
struct Sizes {
  std::vector<double> of_columns;
  double largest = 0;
  bool angles = false;
};

// Of each coordinate over the box; 0 of those without a unit, angles and directions.
std::vector<double> length_sizes(const Mechanism& mechanism, const std::vector<Interval>& box) {
  std::vector<double> sizes;
  std::size_t variable = 0;
  for (const Coordinate& c : mechanism.coordinates()) {
    const bool is_angle = c.kind == CoordinateKind::angle;
    sizes.push_back(is_angle || c.direction ? 0 : size_of(box[variable]));
    variable += is_angle ? 2 : 1;
  }
  return sizes;
}

Sizes right_sizes(const Mechanism& mechanism, const KernelQuestion& kernel, const std::vector<Interval>& box) {
  const std::vector<double> all = length_sizes(mechanism, box);
  const std::vector<std::size_t>& eliminated = kernel.passive.eliminated;
  Sizes sizes;
  for (std::size_t j = 0; j < kernel.matrix.columns.size(); ++j) {
    const bool stays = !std::binary_search(eliminated.begin(), eliminated.end(), j);
    const double size = stays ? all[mechanism.find_coordinate(kernel.matrix.columns[j])] : 0;
    sizes.of_columns.push_back(size);
    sizes.largest = std::max(sizes.largest, size);
    sizes.angles = sizes.angles || (stays && size == 0);
  }
  return sizes;
}

std::vector<double> equation_sizes(const Mechanism& mechanism, const Configurations& all) {
  const UpwardRounding rounding;
  std::vector<Interval> entries(all.system.entries());
  all.system.jacobian(all.box, entries);
  const int equations = static_cast<int>(mechanism.equations().size());
  std::vector<double> sizes;
  for (int row = 0; row < equations; ++row) {
    double largest = 0;
    for (int k = all.system.row_begin(row); k < all.system.row_begin(row + 1); ++k)
      largest = std::max(largest, entries[k].mag() * size_of(all.box[all.system.column(k)]));
    sizes.push_back(largest > 0 && std::isfinite(largest) ? largest : 1);
  }
  return sizes;
}

// A length's typical size is its scale times this.
std::string size_per_scale(const Mechanism& mechanism, const KernelQuestion& kernel) {
  const Sizes sizes = right_sizes(mechanism, kernel, known_configurations(mechanism)->box);
  if (!(sizes.largest > 0)) return "1";
  return sizes.angles ? (ExactNumber(1) / ExactNumber(static_cast<int>(kLengthUnits))).text() : number(sizes.largest, 0);
}

}  // namespace

std::vector<double> equation_sizes(const Mechanism& mechanism) {
  return equation_sizes(mechanism, *known_configurations(mechanism));
}

std::vector<std::string> coordinate_sizes(const Mechanism& mechanism) {
  std::vector<std::string> result;
  for (const double size : length_sizes(mechanism, known_configurations(mechanism)->box))
    result.push_back(size > 0 ? number(size, 0) : "1");
  return result;
}

std::vector<std::string> kernel_scales(const Mechanism& mechanism, const KernelQuestion& kernel) {
  const std::shared_ptr<const Configurations> all = known_configurations(mechanism);
  if (kernel.at_limit) return scales_of_rates(kernel.at_limit->mechanism, kernel, all->box);
  if (mechanism.has_own_velocity_equation()) return scales_of_rates(mechanism, kernel, all->box);
  std::vector<double> scales;  // 0: an angle's
  if (kernel.side == KernelSide::left) {
    const std::vector<double> sizes = equation_sizes(mechanism, *all);
    for (std::size_t row = 0; row < sizes.size(); ++row)
      if (!std::binary_search(kernel.dropped.begin(), kernel.dropped.end(), row)) scales.push_back(1 / sizes[row]);
    return texts(scales, 1);
  }
  const auto [of_columns, largest, angles] = right_sizes(mechanism, kernel, all->box);
  std::vector<std::string> result = texts(of_columns, angles && largest > 0 ? kLengthUnits * largest : 1);
  if (!kernel.passive.eliminated.empty()) scale_eliminated(mechanism, kernel, result);
  return result;
}

std::vector<std::string> kernel_scales(const Mechanism& mechanism, SingularitySet set, std::optional<KernelSide> side) {
  if (definition(set).has_kernel()) return kernel_scales(mechanism, kernel_question(mechanism, set, side));
  if (!definition(set).is_singular()) return {};
  const Mechanism plain = mechanism.without_rates();
  const KernelQuestion kernel = kernel_question(plain, set);
  std::vector<std::string> scales = kernel_scales(plain, kernel);
  scales.resize(kernel.matrix.columns.size(), "1");
  scales.push_back(size_per_scale(plain, kernel));
  return without_ones(std::move(scales));
}

}  // namespace corank::symbolic
