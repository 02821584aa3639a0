#include "corank/symbolic/determinant_factors.h"

#include <algorithm>
#include <bit>
#include <map>
#include <utility>

#include "corank/symbolic/block_triangular.h"
#include "corank/symbolic/ginac_bridge.h"
#include "corank/symbolic/ginac_lock.h"
#include "corank/symbolic/rational_polynomial.h"

namespace corank::symbolic {
namespace {

constexpr std::size_t kLargest = 16;       // rows of a block
constexpr std::size_t kMostTerms = 20000;  // of a determinant; what is longer has no sign that boxes would show

using PolynomialRows = std::vector<std::vector<RationalPolynomial>>;

// Expressions as polynomials: coordinates, constants, sines, cosines and irrational numbers are the unknowns.
class Unknowns {
 public:
  Unknowns(const GinacBridge& bridge, const SourceLocation& where) : bridge_(bridge), where_(where) {}

  void collect(const GiNaC::ex& e) {
    if (GiNaC::is_a<GiNaC::numeric>(e) && GiNaC::ex_to<GiNaC::numeric>(e).is_rational()) return;
    if (GiNaC::is_a<GiNaC::add>(e) || GiNaC::is_a<GiNaC::mul>(e)) {
      for (const GiNaC::ex& part : e) collect(part);
    } else if (is_power(e)) {
      collect(e.op(0));
    } else {
      if (!GiNaC::is_a<GiNaC::symbol>(e) && !GiNaC::is_a<GiNaC::function>(e) && bridge_.mentions_coordinate(e))
        throw ModelError(where_, bridge_.to_expression(e).text(), "a polynomial in coordinates, sines and cosines");
      if (index_.try_emplace(e, atoms_.size()).second) atoms_.push_back(e);
    }
  }

  std::size_t size() const { return atoms_.size(); }

  RationalPolynomial polynomial(const PolynomialRing& ring, const GiNaC::ex& e) const {
    if (const auto atom = index_.find(e); atom != index_.end()) return RationalPolynomial::unknown(ring, atom->second);
    if (GiNaC::is_a<GiNaC::numeric>(e)) {
      std::ostringstream text;
      text << e;
      return RationalPolynomial::number(ring, text.str());
    }
    if (is_power(e))
      return polynomial(ring, e.op(0)).power(static_cast<std::uint64_t>(GiNaC::ex_to<GiNaC::numeric>(e.op(1)).to_long()));
    RationalPolynomial result = RationalPolynomial::number(ring, GiNaC::is_a<GiNaC::add>(e) ? "0" : "1");
    for (const GiNaC::ex& part : e)
      result = GiNaC::is_a<GiNaC::add>(e) ? result + polynomial(ring, part) : result * polynomial(ring, part);
    return result;
  }

  GiNaC::ex expression(const RationalPolynomial& f) const {
    GiNaC::exvector sum;
    for (const RationalPolynomial::Term& term : f.terms()) {
      const std::size_t bar = term.coefficient.find('/');
      GiNaC::exvector product{GiNaC::numeric(term.coefficient.substr(0, bar).c_str())};
      if (bar != std::string::npos) product.push_back(1 / GiNaC::numeric(term.coefficient.substr(bar + 1).c_str()));
      for (std::size_t k = 0; k < atoms_.size(); ++k)
        if (term.powers[k] > 0) product.push_back(GiNaC::pow(atoms_[k], GiNaC::numeric(term.powers[k])));
      sum.push_back(GiNaC::mul(product));
    }
    return GiNaC::add(sum);
  }

 private:
  static bool is_power(const GiNaC::ex& e) {
    return GiNaC::is_a<GiNaC::power>(e) && e.op(1).info(GiNaC::info_flags::posint);
  }
  const GinacBridge& bridge_;
  const SourceLocation where_;
  std::map<GiNaC::ex, std::size_t, GiNaC::ex_is_less> index_;
  std::vector<GiNaC::ex> atoms_;
};

std::vector<std::vector<std::size_t>> filled(const PolynomialRows& m) {
  std::vector<std::vector<std::size_t>> result(m.size());
  for (std::size_t i = 0; i < m.size(); ++i)
    for (std::size_t j = 0; j < m.size(); ++j)
      if (!m[i][j].is_zero()) result[i].push_back(j);
  return result;
}

// det M = ± c det M', where c is an entry that is a number and M' is M without its row and column, after multiples of the
// row have made the rest of the column zero. Of all such entries the one that fills the fewest others.
bool eliminate_a_number(PolynomialRows& m) {
  const auto entries = filled(m);
  std::vector<std::size_t> in_column(m.size(), 0);
  for (const auto& row : entries)
    for (const std::size_t j : row) ++in_column[j];
  std::size_t least = 0, row = m.size(), column = 0;
  for (std::size_t i = 0; i < m.size(); ++i)
    for (const std::size_t j : entries[i]) {
      const std::size_t fill = (entries[i].size() - 1) * (in_column[j] - 1);
      if (m[i][j].is_number() && (row == m.size() || fill < least)) std::tie(least, row, column) = std::tuple(fill, i, j);
    }
  if (row == m.size()) return false;
  for (std::size_t i = 0; i < m.size(); ++i) {
    if (i == row || m[i][column].is_zero()) continue;
    const RationalPolynomial multiple = m[i][column].over(m[row][column]);
    for (const std::size_t j : entries[row])
      if (j != column) m[i][j] = m[i][j] - multiple * m[row][j];
  }
  m.erase(m.begin() + static_cast<std::ptrdiff_t>(row));
  for (auto& rest : m) rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(column));
  return true;
}

// By Laplace's expansion along one row after the other; minors of the same columns are summed once.
RationalPolynomial determinant(const PolynomialRing& ring, const PolynomialRows& m, const SquareBlock& block,
                               const SourceLocation& where) {
  if (block.rows.size() > kLargest)
    throw DeterminantTooLarge(
        where, "a determinant of " + std::to_string(block.rows.size()) + " rows that is no product of smaller ones",
        "at most " + std::to_string(kLargest) + " rows");
  std::map<std::uint32_t, RationalPolynomial> minors;
  minors.emplace(0U, RationalPolynomial::number(ring, "1"));
  for (const std::size_t i : block.rows) {
    std::map<std::uint32_t, RationalPolynomial> next;
    std::size_t terms = 0;
    for (const auto& [columns, minor] : minors)
      for (std::size_t k = 0; k < block.columns.size(); ++k) {
        const std::uint32_t bit = 1U << k;
        const RationalPolynomial& entry = m[i][block.columns[k]];
        if ((columns & bit) != 0 || entry.is_zero()) continue;
        const bool odd = std::popcount(columns >> k) % 2 != 0;
        const auto [place, fresh] = next.try_emplace(columns | bit, ring);
        const std::size_t before = place->second.size();
        place->second = odd ? place->second - entry * minor : place->second + entry * minor;
        terms += place->second.size() - std::min(before, place->second.size());
        if (terms > kMostTerms)
          throw DeterminantTooLarge(where, "a determinant of " + std::to_string(block.rows.size()) + " rows with many terms",
                                    "at most " + std::to_string(kMostTerms) + " terms");
      }
    minors = std::move(next);
  }
  const auto all = minors.find(static_cast<std::uint32_t>((std::uint64_t{1} << block.columns.size()) - 1));
  return all == minors.end() ? RationalPolynomial(ring) : all->second;
}

}  // namespace

std::vector<Expression> determinant_factors(const Mechanism& mechanism, const ExpressionMatrix& matrix, const Ended& ended) {
  const std::size_t n = matrix.rows.size();
  const SourceLocation where{mechanism.name(), 0, 0};
  if (n != matrix.columns.size())
    throw ModelError(
        where, "a matrix with " + std::to_string(n) + " rows and " + std::to_string(matrix.columns.size()) + " columns",
        "a square one");
  const GinacLock lock;
  const GinacBridge bridge(mechanism);
  Unknowns unknowns(bridge, where);
  std::vector<std::vector<GiNaC::ex>> entries(n);
  for (std::size_t i = 0; i < n; ++i)
    for (const Expression& e : matrix.rows[i]) unknowns.collect(entries[i].emplace_back(bridge.to_ginac(e, where)));
  const PolynomialRing ring(unknowns.size());
  PolynomialRows m(n);
  for (std::size_t i = 0; i < n; ++i)
    for (const GiNaC::ex& e : entries[i]) m[i].push_back(unknowns.polynomial(ring, e));
  while (eliminate_a_number(m)) {
  }
  const auto vanishing = [&]() -> ModelError {
    return {where, "the determinant vanishes everywhere", "a mechanism with configurations that are not singular"};
  };
  const auto blocks = block_triangular_form(filled(m));
  if (!blocks) throw vanishing();
  std::vector<RationalPolynomial> factors;
  for (const SquareBlock& block : *blocks) {
    const RationalPolynomial value = determinant(ring, m, block, where);
    if (value.is_zero()) throw vanishing();
    for (RationalPolynomial& factor : value.factors(ended))
      if (std::find(factors.begin(), factors.end(), factor) == factors.end()) factors.push_back(std::move(factor));
  }
  std::vector<Expression> result;
  // GiNaC's order and signs are its own: these are the text's.
  for (const RationalPolynomial& factor : factors) {
    const GiNaC::ex e = unknowns.expression(factor);
    if (!bridge.mentions_coordinate(e)) continue;
    const Expression plus = bridge.to_expression(e), minus = bridge.to_expression(-e);
    result.push_back(
        std::make_pair(plus.text().size(), plus.text()) < std::make_pair(minus.text().size(), minus.text()) ? plus : minus);
  }
  std::sort(result.begin(), result.end(), [](const Expression& a, const Expression& b) { return a.text() < b.text(); });
  return result;
}

}  // namespace corank::symbolic
