#include "corank/symbolic/sets/dependent_columns.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace corank::symbolic {
namespace {

using Zeros = JointZeros::Zeros;
using Column = std::vector<RationalPolynomial>;
constexpr std::size_t kThreeRows = 3;

Column column_of(const ExactMatrix& matrix, std::size_t j) {
  Column result;
  for (std::size_t i = 0; i < matrix.size(); ++i) result.push_back(matrix.polynomial(i, j));
  return result;
}

RationalPolynomial minor_of(const ExactMatrix& matrix, std::size_t a, std::size_t b, std::size_t c) {
  return matrix.modulo_circles(matrix.determinant({{0, 1, 2}, {a, b, c}}));
}

Column cross_product(const ExactMatrix& matrix, std::size_t a, std::size_t b) {
  const Column u = column_of(matrix, a), v = column_of(matrix, b);
  Column result;
  for (std::size_t i = 0; i < kThreeRows; ++i) {
    const std::size_t j = (i + 1) % kThreeRows, k = (i + 2) % kThreeRows;
    result.push_back(matrix.modulo_circles(u[j] * v[k] - u[k] * v[j]));
  }
  return result;
}

// The first three columns of rank two.
std::optional<std::array<std::size_t, 3>> flat_columns(const ExactMatrix& matrix) {
  const std::size_t n = matrix.columns().size();
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = a + 1; b < n; ++b)
      for (std::size_t c = b + 1; c < n; ++c)
        if (minor_of(matrix, a, b, c).is_zero()) return std::array{a, b, c};
  return std::nullopt;
}

// Turns pairs of columns by joints' angles, which leaves the rank as it is, while that makes them shorter.
void turn_columns(const Mechanism& mechanism, ExpressionMatrix& matrix, const Ended& ended) {
  const std::size_t n = matrix.columns.size();
  ExpressionMatrix transposed;
  transposed.columns = matrix.columns;
  transposed.rows.assign(n, std::vector<Expression>(n, Expression(0)));
  for (std::size_t i = 0; i < matrix.rows.size(); ++i)
    for (std::size_t j = 0; j < n; ++j) transposed.rows[j][i] = matrix.rows[i][j];
  ExactMatrix exact(mechanism, transposed);
  exact.put_into_free_coordinates(ended);
  for (std::size_t i = 0; i < matrix.rows.size(); ++i)
    for (std::size_t j = 0; j < n; ++j) matrix.rows[i][j] = exact.entry(j, i);
}

// The factor by which y is x at the value, 1 or −1.
std::optional<int> sign_between(const Column& x, const Column& y, const JointZeros& zeros, const ExactMatrix& matrix,
                                const QuarterTurns& value) {
  bool same = true, opposite = true;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const RationalPolynomial a = matrix.modulo_circles(zeros.at(x[i], value)),
                             b = matrix.modulo_circles(zeros.at(y[i], value));
    same = same && a == b;
    opposite = opposite && (a + b).is_zero();
  }
  if (same == opposite) return std::nullopt;  // both are 0, or there is no factor
  return same ? 1 : -1;
}

std::size_t terms_in(const Column& column) {
  std::size_t sum = 0;
  for (const RationalPolynomial& f : column) sum += f.size();
  return sum;
}

std::optional<AgreeingColumns> agreeing_at(const ExactMatrix& matrix, const JointZeros& zeros, const std::string& joint,
                                           int quarters, std::size_t a, std::size_t b) {
  const auto [cosine, sine] = matrix.unknowns_of(joint);
  if (!cosine || !sine) return std::nullopt;
  const Column x = column_of(matrix, a), y = column_of(matrix, b);
  AgreeingColumns result{{{joint, quarters}, {joint, quarters + 2}}, {}};
  const auto first = sign_between(x, y, zeros, matrix, result.values[0]),
             second = sign_between(x, y, zeros, matrix, result.values[1]);
  if (!first || !second) return std::nullopt;
  const PolynomialRing& ring = matrix.ring();
  const auto number = [&](int value) { return RationalPolynomial::number(ring, std::to_string(value)); };
  const std::size_t vanishing = quarters == 0 ? *sine : *cosine;
  const RationalPolynomial p = RationalPolynomial::unknown(ring, vanishing),
                           q = RationalPolynomial::unknown(ring, quarters == 0 ? *cosine : *sine),
                           square = number(1) - q * q, multiple = *first == *second ? number(*first) : number(*first) * q;
  const bool keeps_x = terms_in(x) <= terms_in(y);
  const Column &kept = keeps_x ? x : y, &replaced = keeps_x ? y : x;
  result.elsewhere.columns = matrix.columns();
  result.elsewhere.roles.assign(matrix.columns().size(), Role::passive);
  for (std::size_t i = 0; i < matrix.size(); ++i) {
    const RationalPolynomial difference = (replaced[i] - multiple * kept[i]).with(vanishing, 2, square);
    const RationalPolynomial even = difference.with(vanishing, 1, number(0));
    const auto by_p = (difference - even).divided_by(p), by_square = even.divided_by(square);
    if (!by_p || !by_square) return std::nullopt;
    std::vector<Expression>& row = result.elsewhere.rows.emplace_back();
    for (std::size_t j = 0; j < matrix.columns().size(); ++j)
      row.push_back(j == (keeps_x ? b : a) ? matrix.expression(matrix.modulo_circles(*by_p + p * *by_square))
                                           : matrix.entry(i, j));
  }
  return result;
}

}  // namespace

std::optional<std::vector<RationalPolynomial>> rank_conditions(const ExactMatrix& matrix, JointZeros& zeros) {
  const std::size_t n = matrix.columns().size();
  if (matrix.size() != kThreeRows || n <= kThreeRows) return std::nullopt;
  const auto flat = flat_columns(matrix);
  if (!flat) return std::nullopt;
  std::vector<std::array<std::size_t, 2>> pairs;
  std::vector<RationalPolynomial> products;
  for (const auto& [a, b] :
       {std::pair((*flat)[0], (*flat)[1]), std::pair((*flat)[0], (*flat)[2]), std::pair((*flat)[1], (*flat)[2])}) {
    Column v = cross_product(matrix, a, b);
    if (std::ranges::all_of(v, &RationalPolynomial::is_zero)) continue;
    pairs.push_back({a, b});
    products.insert(products.end(), v.begin(), v.end());
  }
  if (pairs.empty() || !zeros.have_no_common_zero(products)) return std::nullopt;
  std::vector<std::vector<Zeros>> minors;     // of each other column k, by pairs
  std::vector<Zeros> of_columns;              // what those of k have in common: c_k
  std::vector<Zeros> of_pairs(pairs.size());  // what else those of A have: f_A
  for (std::size_t k = 0; k < n; ++k) {
    std::vector<RationalPolynomial> own;
    for (const auto& [a, b] : pairs) own.push_back(minor_of(matrix, a, b, k));
    if (std::ranges::all_of(own, &RationalPolynomial::is_zero)) continue;  // one of B
    minors.emplace_back();
    for (const RationalPolynomial& m : own) {
      const std::optional<Zeros> found = m.is_zero() ? std::nullopt : zeros.of(m);
      if (!found) return std::nullopt;
      minors.back().push_back(*found);
    }
    of_columns.push_back(minors.back().front());
    for (const Zeros& each : minors.back()) of_columns.back() = each.chosen(of_columns.back(), true);
    for (std::size_t p = 0; p < pairs.size(); ++p) of_pairs[p].add(minors.back()[p].chosen(of_columns.back(), false));
  }
  for (std::size_t k = 0; k < minors.size(); ++k)
    for (std::size_t p = 0; p < pairs.size(); ++p) {
      Zeros both = of_columns[k];
      both.add(of_pairs[p]);
      if (!both.is_within(minors[k][p])) return std::nullopt;
    }
  std::vector<RationalPolynomial> factors, conditions;
  for (const Zeros& f : of_pairs) factors.push_back(zeros.product(f));
  if (!zeros.have_no_common_zero(factors)) return std::nullopt;
  for (const Zeros& c : of_columns) conditions.push_back(zeros.product(c));
  return conditions;
}

std::optional<AgreeingColumns> agreeing_columns(const Mechanism& mechanism, const ExactMatrix& matrix,
                                                const JointZeros& zeros, const Ended& ended) {
  const std::size_t n = matrix.columns().size();
  for (const std::string& joint : zeros.joints())
    for (const int quarters : {0, 1})
      for (std::size_t a = 0; a < n; ++a)
        for (std::size_t b = a + 1; b < n; ++b) {
          if (is_over(ended)) return std::nullopt;
          if (std::optional<AgreeingColumns> found = agreeing_at(matrix, zeros, joint, quarters, a, b)) {
            turn_columns(mechanism, found->elsewhere, ended);
            return found;
          }
        }
  return std::nullopt;
}

ExpressionMatrix matrix_at(const ExactMatrix& matrix, const JointZeros& zeros, const QuarterTurns& value) {
  std::vector<Column> columns;
  ExpressionMatrix result;
  result.rows.resize(matrix.size());
  for (std::size_t j = 0; j < matrix.columns().size(); ++j) {
    Column here, opposite;
    for (const RationalPolynomial& f : column_of(matrix, j)) {
      here.push_back(matrix.modulo_circles(zeros.at(f, value)));
      opposite.push_back(RationalPolynomial(matrix.ring()) - here.back());
    }
    const auto is_known = [&](const Column& c) { return c == here || c == opposite; };
    if (std::ranges::all_of(here, &RationalPolynomial::is_zero) || std::ranges::any_of(columns, is_known)) continue;
    result.columns.push_back(matrix.columns()[j]);
    for (std::size_t i = 0; i < here.size(); ++i) result.rows[i].push_back(matrix.expression(here[i]));
    columns.push_back(std::move(here));
  }
  result.roles.assign(result.columns.size(), Role::passive);
  return result;
}

}  // namespace corank::symbolic
