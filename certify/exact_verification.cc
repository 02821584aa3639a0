#include "corank/certify/exact_verification.h"

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "corank/certify/polynomial_algebra.h"

namespace corank::certify {
namespace {

bool is_kernel(const System& system, int j) { return system.variables[j].kind == VariableKind::kernel; }

// Substitutes the point's coordinates. Requires that all of f's variables are known.
RationalPolynomial value_of(const Polynomial& f, const ExactPoint& point, const AlgebraicNumber& t) {
  RationalPolynomial value;
  for (const Monomial& m : f.monomials) {
    if (!m.coefficient.is_rational() || m.is_trigonometric())
      throw std::domain_error(f.source + " has a coefficient that is not a rational number, or a sine or cosine");
    RationalPolynomial product{m.coefficient};
    for (const Factor& x : m.factors)
      for (int k = 0; k < x.power; ++k) product = t.product(product, point.coordinates[x.variable]);
    value = sum(value, product);
  }
  return t.reduced(std::move(value));
}

using ExactMatrix = std::vector<std::vector<RationalPolynomial>>;

ExactMatrix values_of(const PolynomialMatrix& matrix, const ExactPoint& point, const AlgebraicNumber& t) {
  ExactMatrix values(matrix.rows);
  for (int k = 0; k < matrix.rows * matrix.columns; ++k)
    values[k / matrix.columns].push_back(value_of(matrix.entries[k], point, t));
  return values;
}

// Elimination without division: a row a is replaced by pivot · a − a_column · (pivot row), so its rank counts as the pivot
// is not 0 at t. Nothing where an entry's sign cannot be decided, or where `ended` is true before.
std::optional<int> rank(ExactMatrix rows, const AlgebraicNumber& t, const Ended& ended) {
  int rank = 0;
  std::vector<bool> used(rows.empty() ? 0 : rows[0].size(), false);
  for (std::size_t from = 0; from < rows.size(); ++from) {
    std::size_t row = rows.size(), column = 0;
    for (std::size_t i = from; i < rows.size() && row == rows.size(); ++i)
      for (std::size_t j = 0; j < used.size() && row == rows.size(); ++j) {
        if (used[j]) continue;
        if (is_over(ended)) return std::nullopt;
        const auto s = t.sign(rows[i][j]);
        if (!s) return std::nullopt;
        if (*s != 0) row = i, column = j;
      }
    if (row == rows.size()) break;
    std::swap(rows[from], rows[row]);
    used[column] = true;
    ++rank;
    const RationalPolynomial pivot = rows[from][column];
    for (std::size_t i = from + 1; i < rows.size(); ++i) {
      if (is_over(ended)) return std::nullopt;
      const RationalPolynomial factor = scaled(rows[i][column], ExactNumber(-1));
      for (std::size_t j = 0; j < used.size(); ++j)
        rows[i][j] = sum(t.product(pivot, rows[i][j]), t.product(factor, rows[from][j]));
    }
  }
  return rank;
}

ExactVerification fails(const std::string& reason) { return {false, reason, -1}; }

}  // namespace

PolynomialMatrix kernel_matrix(const System& system) {
  if (system.singular) return *system.singular;
  std::vector<int> unknowns;
  for (int j = 0; j < system.size(); ++j)
    if (is_kernel(system, j)) unknowns.push_back(j);
  unknowns.resize(unknowns.size() / system.kernel_vectors);  // ξ¹
  PolynomialMatrix matrix{0, static_cast<int>(unknowns.size()), {}};
  for (const Polynomial& f : system.equations) {
    std::vector<Polynomial> row(unknowns.size());
    const auto place = [&](const Monomial& m) {  // false: not linear in the unknowns
      Monomial entry = m;
      int unknown = -1;
      for (const Factor& x : m.factors) {
        if (!is_kernel(system, x.variable)) continue;
        if (unknown >= 0 || x.power != 1 || x.function != Function::identity) return false;
        unknown = x.variable;
      }
      const auto column = std::ranges::find(unknowns, unknown) - unknowns.begin();
      if (column == matrix.columns) return false;
      std::erase_if(entry.factors, [&](const Factor& x) { return x.variable == unknown; });
      row[column].monomials.push_back(std::move(entry));
      return true;
    };
    if (f.monomials.empty() || !std::ranges::all_of(f.monomials, place)) continue;
    ++matrix.rows;
    std::ranges::move(row, std::back_inserter(matrix.entries));
  }
  return matrix;
}

ExactVerification verify_exactly(const System& system, const ExactPoint& point, const Ended& ended) {
  try {
    if (point.coordinates.size() != system.variables.size()) return fails("the point has another number of coordinates");
    if (system.coefficient_tolerance > 0) return fails("the coefficients have a tolerance");
    const AlgebraicNumber t(point.polynomial, point.lower, point.upper);
    const auto known = [&](int j) { return !point.coordinates[j].empty(); };
    for (int j = 0; j < system.size(); ++j) {
      if (!known(j)) {
        if (!is_kernel(system, j)) return fails("the coordinate " + system.variables[j].name + " is missing");
        continue;
      }
      const Variable& v = system.variables[j];
      const RationalPolynomial& x = point.coordinates[j];
      const bool rational = v.lower.is_rational() && v.upper.is_rational() &&
                            std::ranges::all_of(x, [](const ExactNumber& c) { return c.is_rational(); });
      if (!rational) return fails("the domain of " + v.name + " or its coordinate is not rational");
      if (t.sign(sum(x, {-v.lower})).value_or(-1) < 0 || t.sign(sum({v.upper}, scaled(x, ExactNumber(-1)))).value_or(-1) < 0)
        return fails(v.name + " is not proven to lie in its domain");
    }
    const auto is_known = [&](const Polynomial& f) {
      return std::ranges::all_of(f.monomials, [&](const Monomial& m) {
        return std::ranges::all_of(m.factors, [&](const Factor& x) { return known(x.variable); });
      });
    };
    for (const Polynomial& f : system.equations) {
      if (is_over(ended)) return fails("the verification was ended early");
      if (is_known(f) && !value_of(f, point, t).empty()) return fails("the equation " + f.source + " does not hold exactly");
    }
    for (const Polynomial& g : system.inequalities)
      if (is_known(g) && t.sign(value_of(g, point, t)).value_or(-1) < 0)
        return fails("the inequality " + g.source + " is not proven to hold");

    ExactVerification result{true, "", -1};
    const PolynomialMatrix matrix = kernel_matrix(system);
    if (matrix.rows == 0) return result;
    const auto r = rank(values_of(matrix, point, t), t, ended);
    if (!r) return fails("the rank of the kernel matrix cannot be decided");
    result.corank = matrix.columns - *r;
    if (result.corank == 0) return fails("the kernel matrix is regular there");
    if (result.corank < system.kernel_vectors) return fails("the kernel has a smaller dimension there");
    return result;
  } catch (const std::invalid_argument& error) {
    return fails(error.what());
  } catch (const std::domain_error& error) {
    return fails(error.what());
  }
}

std::optional<int> exact_rank(const System& system, const PolynomialMatrix& matrix, const ExactPoint& point,
                              const Ended& ended) {
  if (point.coordinates.size() != system.variables.size() || system.coefficient_tolerance > 0) return std::nullopt;
  for (const int j : variables_of(matrix.entries))
    if (point.coordinates[j].empty()) return std::nullopt;
  try {
    const AlgebraicNumber t(point.polynomial, point.lower, point.upper);
    return rank(values_of(matrix, point, t), t, ended);
  } catch (const std::invalid_argument&) {  // the point defines no number
    return std::nullopt;
  } catch (const std::domain_error&) {  // no rational coefficient, or numbers of too many bits
    return std::nullopt;
  }
}

PointLocation::PointLocation(const ExactPoint& point)
    : t_(point.polynomial, point.lower, point.upper), coordinates_(point.coordinates) {
  for (const RationalPolynomial& x : coordinates_) enclosures_.push_back(t_.enclose(x));
}

bool PointLocation::in(const std::vector<Interval>& box) const {
  if (coordinates_.size() != box.size()) return false;
  const auto apart = [&](std::size_t j) { return !coordinates_[j].empty() && !enclosures_[j].overlaps(box[j]); };
  for (std::size_t j = 0; j < box.size(); ++j)
    if (apart(j)) return false;
  for (std::size_t j = 0; j < box.size(); ++j) {
    const RationalPolynomial& x = coordinates_[j];
    if (x.empty() || box[j].contains(enclosures_[j])) continue;
    if (t_.sign(sum(x, {-ExactNumber::dyadic(box[j].lo())})).value_or(-1) < 0) return false;
    if (t_.sign(sum(x, {-ExactNumber::dyadic(box[j].hi())})).value_or(1) > 0) return false;
  }
  return true;
}

ExactNumber reach(const ExactPoint& point, const std::vector<Interval>& box) {
  if (point.coordinates.size() != box.size()) throw std::invalid_argument("the point has another number of coordinates");
  const AlgebraicNumber t(point.polynomial, point.lower, point.upper);
  const ExactNumber width = pow(ExactNumber(2), -80);
  ExactNumber farthest;
  for (std::size_t j = 0; j < box.size(); ++j) {
    if (point.coordinates[j].empty()) continue;
    const auto x = t.bounds(point.coordinates[j], width);
    for (const ExactNumber& distance :
         {ExactNumber::dyadic(box[j].hi()) - x.lower, x.upper - ExactNumber::dyadic(box[j].lo())})
      if ((distance - farthest).sign() == 1) farthest = distance;
  }
  return farthest;
}

}  // namespace corank::certify
