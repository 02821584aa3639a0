#include "corank/symbolic/velocity/exact_matrix.h"

#include <algorithm>
#include <bit>
#include <map>
#include <numeric>
#include <utility>

#include "corank/symbolic/algebra/exact_value.h"
#include "corank/symbolic/algebra/ginac_bridge.h"
#include "corank/symbolic/algebra/ginac_lock.h"

namespace corank::symbolic {

constexpr std::size_t kLargest = 16;       // rows of a block
constexpr std::size_t kMostTerms = 20000;  // of a determinant; what is longer has no sign that boxes would show

// Expressions as polynomials: coordinates, constants, sines, cosines and irrational numbers are the unknowns.
class ExactMatrix::Unknowns {
 public:
  Unknowns(const Mechanism& mechanism, SourceLocation where) : bridge(mechanism), where_(std::move(where)) {
    for (const Coordinate& c : mechanism.coordinates())
      (c.kind == CoordinateKind::angle ? angles_ : lengths_).push_back(bridge.symbol(c.name));
    for (const Constant& c : mechanism.constants()) {
      const Expression name = Expression::symbol(c.name);
      if (!mechanism.toleranced_in(name).empty()) continue;
      const ExactNumber value = exact_value(mechanism, name, c.name);
      if (const ExactNumber square = value * value; !value.is_rational() && square.is_rational())
        squares_.emplace(bridge.symbol(c.name), square.text());
    }
  }

  const GinacLock lock{};
  const GinacBridge bridge;

  void collect(const GiNaC::ex& e) {
    if (GiNaC::is_a<GiNaC::numeric>(e) && GiNaC::ex_to<GiNaC::numeric>(e).is_rational()) return;
    if (GiNaC::is_a<GiNaC::add>(e) || GiNaC::is_a<GiNaC::mul>(e)) {
      for (const GiNaC::ex& part : e) collect(part);
    } else if (is_power(e)) {
      collect(e.op(0));
    } else {
      if (!GiNaC::is_a<GiNaC::symbol>(e) && !GiNaC::is_a<GiNaC::function>(e) && bridge.mentions_coordinate(e))
        throw ModelError(where_, bridge.to_expression(e).text(), "a polynomial in coordinates, sines and cosines");
      if (index_.try_emplace(e, atoms_.size()).second) atoms_.push_back(e);
    }
  }

  /// When all are collected.
  void close() {
    ring_.emplace(atoms_.size());
    // Of the coordinates that are angles, then of constant ones.
    GiNaC::exvector angles = angles_;
    for (const GiNaC::ex& atom : atoms_)
      if (GiNaC::is_a<GiNaC::function>(atom) &&
          std::ranges::none_of(angles, [&](const GiNaC::ex& e) { return e.is_equal(atom.op(0)); }))
        angles.push_back(atom.op(0));
    for (const GiNaC::ex& angle : angles) {
      const auto c = index_.find(GiNaC::cos(angle)), s = index_.find(GiNaC::sin(angle));
      if (c != index_.end() && s != index_.end()) circles_.push_back({c->second, s->second});
    }
    for (std::size_t k = 0; k < atoms_.size(); ++k) {
      const GiNaC::ex& atom = atoms_[k];
      if (const auto constant = squares_.find(atom); constant != squares_.end())
        square_roots_.emplace_back(k, RationalPolynomial::number(*ring_, constant->second));
      if (GiNaC::is_a<GiNaC::power>(atom) && atom.op(1).is_equal(GiNaC::numeric(1, 2)) &&
          atom.op(0).info(GiNaC::info_flags::rational))
        square_roots_.emplace_back(k, polynomial(atom.op(0)));
    }
  }
  const PolynomialRing& ring() const { return *ring_; }

  UnknownsOfAngle of_angle(const std::string& angle) const {
    const auto place = [&](const GiNaC::ex& e) {
      const auto at = index_.find(e);
      return at == index_.end() ? std::nullopt : std::optional(at->second);
    };
    const GiNaC::ex symbol = bridge.symbol(angle);
    return {place(GiNaC::cos(symbol)), place(GiNaC::sin(symbol))};
  }

  struct Circle {
    std::size_t cosine, sine;
  };
  const std::vector<Circle>& circles() const { return circles_; }
  // √3 and constants such as √3/2, with 3 and 3/4.
  const std::vector<std::pair<std::size_t, RationalPolynomial>>& square_roots() const { return square_roots_; }

  RationalPolynomial polynomial(const GiNaC::ex& e) const {
    if (const auto atom = index_.find(e); atom != index_.end()) return RationalPolynomial::unknown(*ring_, atom->second);
    if (GiNaC::is_a<GiNaC::numeric>(e)) return RationalPolynomial::number(*ring_, text_of(e));
    if (is_power(e))
      return polynomial(e.op(0)).power(static_cast<std::uint64_t>(GiNaC::ex_to<GiNaC::numeric>(e.op(1)).to_long()));
    RationalPolynomial result = RationalPolynomial::number(*ring_, GiNaC::is_a<GiNaC::add>(e) ? "0" : "1");
    for (const GiNaC::ex& part : e)
      result = GiNaC::is_a<GiNaC::add>(e) ? result + polynomial(part) : result * polynomial(part);
    return result;
  }

  // Of f = 0: the last coordinate that is none of the seen unknowns and stands in one term alone, with a number for its
  // coefficient; and what it is.
  std::optional<std::pair<std::size_t, RationalPolynomial>> solved_for(const RationalPolynomial& f,
                                                                       const std::vector<bool>& seen) const {
    const auto terms = f.terms();
    for (std::size_t i = lengths_.size(); i-- > 0;) {
      const auto place = index_.find(lengths_[i]);
      const std::size_t k = place == index_.end() ? seen.size() : place->second;
      if (k == seen.size() || seen[k]) continue;
      const auto holds = [&](const RationalPolynomial::Term& term) { return term.powers[k] > 0; };
      const auto own = std::ranges::find_if(terms, holds);
      if (own == terms.end() || std::ranges::count_if(terms, holds) != 1) continue;
      if (std::accumulate(own->powers.begin(), own->powers.end(), std::uint64_t{0}) != 1) continue;
      const RationalPolynomial x = RationalPolynomial::unknown(*ring_, k);
      return std::pair(k, x - f.over(RationalPolynomial::number(*ring_, own->coefficient)));
    }
    return std::nullopt;
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
  const SourceLocation where_;
  std::vector<GiNaC::ex> angles_, lengths_;
  std::map<GiNaC::ex, std::string, GiNaC::ex_is_less> squares_;
  std::optional<PolynomialRing> ring_;
  std::map<GiNaC::ex, std::size_t, GiNaC::ex_is_less> index_;
  std::vector<GiNaC::ex> atoms_;
  std::vector<Circle> circles_;
  std::vector<std::pair<std::size_t, RationalPolynomial>> square_roots_;
};

ExactMatrix::ExactMatrix(const Mechanism& mechanism, const ExpressionMatrix& matrix, const std::vector<Expression>& phi,
                         Shape shape)
    : where_{mechanism.name(), 0, 0}, columns_(matrix.columns), equations_(phi.size()) {
  const std::size_t n = matrix.rows.size();
  if (shape == Shape::square ? n != columns_.size() : n > columns_.size())
    throw ModelError(where_,
                     "a matrix with " + std::to_string(n) + " rows and " + std::to_string(columns_.size()) + " columns",
                     shape == Shape::square ? "a square one" : "at most as many rows as columns");
  unknowns_ = std::make_unique<Unknowns>(mechanism, where_);
  std::vector<std::vector<GiNaC::ex>> entries(n);
  for (std::size_t i = 0; i < n; ++i)
    for (const Expression& e : matrix.rows[i])
      unknowns_->collect(entries[i].emplace_back(unknowns_->bridge.to_ginac(e, where_)));
  std::vector<GiNaC::ex> equations;
  for (const Expression& e : phi) {
    GiNaC::ex equation = unknowns_->bridge.to_ginac(e, where_);
    try {
      unknowns_->collect(equation);
      equations.push_back(std::move(equation));
    } catch (const ModelError&) {  // no polynomial
    }
  }
  unknowns_->close();
  for (const auto& row : entries) {
    auto& to = rows_.emplace_back();
    for (const GiNaC::ex& e : row) to.push_back(unknowns_->polynomial(e));
  }
  std::vector<bool> seen(unknowns_->ring().unknowns(), false);
  for (const GiNaC::ex& equation : equations) {
    const RationalPolynomial f = unknowns_->polynomial(equation);
    if (const auto x = unknowns_->solved_for(f, seen)) explicit_.push_back({x->first, x->second});
    for (const RationalPolynomial::Term& term : f.terms())
      for (std::size_t k = 0; k < seen.size(); ++k) seen[k] = seen[k] || term.powers[k] > 0;
  }
}

ExactMatrix::~ExactMatrix() = default;

std::vector<std::vector<std::size_t>> ExactMatrix::filled() const {
  std::vector<std::vector<std::size_t>> result(size());
  for (std::size_t i = 0; i < size(); ++i)
    for (std::size_t j = 0; j < columns_.size(); ++j)
      if (!rows_[i][j].is_zero()) result[i].push_back(j);
  return result;
}

std::optional<std::vector<SquareBlock>> ExactMatrix::blocks() const {
  return size() == columns_.size() ? block_triangular_form(filled()) : std::nullopt;
}

void ExactMatrix::leave_out_zero_columns() {
  for (std::size_t j = columns_.size(); j-- > 0 && columns_.size() > size();) {
    if (!std::ranges::all_of(rows_, [j](const auto& row) { return row[j].is_zero(); })) continue;
    for (auto& row : rows_) row.erase(row.begin() + static_cast<std::ptrdiff_t>(j));
    columns_.erase(columns_.begin() + static_cast<std::ptrdiff_t>(j));
  }
}

void ExactMatrix::eliminate_numbers() {
  while (eliminate_a_number()) {
  }
}

// Of all such entries the one that fills the fewest others.
bool ExactMatrix::eliminate_a_number() {
  const auto entries = filled();
  std::vector<std::size_t> in_column(columns_.size(), 0);
  for (const auto& row : entries)
    for (const std::size_t j : row) ++in_column[j];
  std::size_t least = 0, row = size(), column = 0;
  for (std::size_t i = 0; i < size(); ++i)
    for (const std::size_t j : entries[i]) {
      const std::size_t fill = (entries[i].size() - 1) * (in_column[j] - 1);
      if (rows_[i][j].is_number() && (row == size() || fill < least)) std::tie(least, row, column) = std::tuple(fill, i, j);
    }
  if (row == size()) return false;
  const RationalPolynomial minus = RationalPolynomial::number(unknowns_->ring(), "-1"), number = rows_[row][column];
  const RationalPolynomial signed_number = (row + column) % 2 == 0 ? number : minus * number;
  eliminated_ = eliminated_ ? *eliminated_ * signed_number : signed_number;
  for (std::size_t i = 0; i < size(); ++i) {
    if (i == row || rows_[i][column].is_zero()) continue;
    const RationalPolynomial multiple = rows_[i][column].over(rows_[row][column]);
    for (const std::size_t j : entries[row])
      if (j != column) rows_[i][j] = rows_[i][j] - multiple * rows_[row][j];
  }
  rows_.erase(rows_.begin() + row);
  for (auto& rest : rows_) rest.erase(rest.begin() + column);
  columns_.erase(columns_.begin() + column);
  return true;
}

RationalPolynomial ExactMatrix::determinant(const SquareBlock& block) const {
  const PolynomialRing& ring = unknowns_->ring();
  if (block.rows.size() > kLargest)
    throw DeterminantTooLarge(
        where_, "a determinant of " + std::to_string(block.rows.size()) + " rows that is not a product of smaller ones",
        "at most " + std::to_string(kLargest) + " rows");
  std::map<std::uint32_t, RationalPolynomial> minors;
  minors.emplace(0U, RationalPolynomial::number(ring, "1"));
  for (const std::size_t i : block.rows) {
    std::map<std::uint32_t, RationalPolynomial> next;
    std::size_t terms = 0;
    for (const auto& [columns, minor] : minors)
      for (std::size_t k = 0; k < block.columns.size(); ++k) {
        const std::uint32_t bit = 1U << k;
        const RationalPolynomial& entry = rows_[i][block.columns[k]];
        if ((columns & bit) != 0 || entry.is_zero()) continue;
        const bool odd = std::popcount(columns >> k) % 2 != 0;
        const auto [place, fresh] = next.try_emplace(columns | bit, ring);
        const std::size_t before = place->second.size();
        place->second = odd ? place->second - entry * minor : place->second + entry * minor;
        terms += place->second.size() - std::min(before, place->second.size());
        if (terms > kMostTerms)
          throw DeterminantTooLarge(where_,
                                    "a determinant of " + std::to_string(block.rows.size()) + " rows with many terms",
                                    "at most " + std::to_string(kMostTerms) + " terms");
      }
    if (in_free_coordinates_)
      for (auto& [columns, minor] : next) minor = normal(std::move(minor));
    minors = std::move(next);
  }
  const auto all = minors.find(static_cast<std::uint32_t>((std::uint64_t{1} << block.columns.size()) - 1));
  return all == minors.end() ? RationalPolynomial(ring) : all->second;
}

RationalPolynomial ExactMatrix::determinant() const {
  SquareBlock all{std::vector<std::size_t>(size()), std::vector<std::size_t>(size())};
  std::iota(all.rows.begin(), all.rows.end(), std::size_t{0});
  all.columns = all.rows;
  const RationalPolynomial rest = determinant(all);
  return eliminated_ ? *eliminated_ * rest : rest;
}

RationalPolynomial ExactMatrix::without_squares(const RationalPolynomial& f, std::size_t gone, std::size_t kept) const {
  const PolynomialRing& ring = unknowns_->ring();
  const RationalPolynomial square = RationalPolynomial::number(ring, "1") - RationalPolynomial::unknown(ring, kept).power(2);
  return f.with(gone, 2, square);
}

RationalPolynomial ExactMatrix::modulo_circles(const RationalPolynomial& f) const {
  RationalPolynomial shortest = f;
  for (const auto& [root, square] : unknowns_->square_roots()) shortest = shortest.with(root, 2, square);
  for (const auto& [cosine, sine] : unknowns_->circles())
    for (const auto& [gone, kept] : {std::pair(cosine, sine), std::pair(sine, cosine)}) {
      RationalPolynomial other = without_squares(shortest, gone, kept);
      if (other.size() < shortest.size()) shortest = std::move(other);
    }
  return shortest;
}

RationalPolynomial ExactMatrix::normal(RationalPolynomial f) const {
  for (const auto& [cosine, sine] : unknowns_->circles()) f = without_squares(f, sine, cosine);
  for (const auto& [root, square] : unknowns_->square_roots()) f = f.with(root, 2, square);
  return f;
}

void ExactMatrix::put_into_free_coordinates(const Ended& ended, std::optional<std::size_t> leading) {
  constexpr std::size_t kLongest = 20'000;
  if (!is_explicit()) return;
  std::vector<Explicit> values;
  const auto in_free = [&](RationalPolynomial f) -> std::optional<RationalPolynomial> {
    for (const auto& [unknown, value] : values)
      if (f.mentions(unknown)) f = normal(f.with(unknown, 1, value));
    f = normal(std::move(f));
    return f.size() > kLongest || is_over(ended) ? std::nullopt : std::optional(std::move(f));
  };
  for (const auto& [unknown, value] : explicit_) {
    auto f = in_free(value);
    if (!f) return;
    values.push_back({unknown, std::move(*f)});
  }
  auto rows = rows_;
  for (std::vector<RationalPolynomial>& row : rows)
    for (RationalPolynomial& entry : row) {
      auto f = in_free(entry);
      if (!f) return;
      entry = std::move(*f);
    }
  rows_ = std::move(rows);
  in_free_coordinates_ = true;
  for (bool any = true; std::exchange(any, false);)
    for (std::size_t i = 0; i < size(); ++i)
      for (std::size_t j = i + 1; j < size(); ++j)
        any = (!is_over(ended) && turn_rows(i, j, leading.value_or(columns_.size()))) || any;
}

// By the first angle that helps.
bool ExactMatrix::turn_rows(std::size_t first, std::size_t second, std::size_t leading) {
  const auto length = [leading](const std::vector<RationalPolynomial>& row) {
    return std::accumulate(row.begin(), row.begin() + static_cast<std::ptrdiff_t>(leading), std::size_t{0},
                           [](std::size_t sum, const RationalPolynomial& entry) { return sum + entry.size(); });
  };
  const std::size_t before = length(rows_[first]) + length(rows_[second]);
  for (const auto& [cosine, sine] : unknowns_->circles()) {
    const auto mentions = [&, c = cosine, s = sine](const RationalPolynomial& e) { return e.mentions(c) || e.mentions(s); };
    if (std::ranges::none_of(rows_[first], mentions) || std::ranges::none_of(rows_[second], mentions)) continue;
    const RationalPolynomial c = RationalPolynomial::unknown(unknowns_->ring(), cosine),
                             s = RationalPolynomial::unknown(unknowns_->ring(), sine);
    for (const bool back : {false, true}) {
      std::vector<RationalPolynomial> one, other;
      for (std::size_t k = 0; k < columns_.size(); ++k) {
        const RationalPolynomial &a = rows_[first][k], &b = rows_[second][k];
        one.push_back(without_squares(back ? c * a - s * b : c * a + s * b, sine, cosine));
        other.push_back(without_squares(back ? c * b + s * a : c * b - s * a, sine, cosine));
      }
      if (length(one) + length(other) >= before) continue;
      rows_[first] = std::move(one);
      rows_[second] = std::move(other);
      return true;
    }
  }
  return false;
}

RationalPolynomial ExactMatrix::in_free_coordinates(const RationalPolynomial& f, const Ended& ended) const {
  constexpr std::size_t kMostOnTheWay = 200'000;
  RationalPolynomial result = f;
  for (std::size_t i = explicit_.size(); i-- > 0;) {
    const auto& [unknown, value] = explicit_[i];
    if (!result.mentions(unknown)) continue;
    result = normal(result.with(unknown, 1, value));
    if (result.size() > kMostOnTheWay || is_over(ended)) return f;
  }
  result = modulo_circles(result);
  const bool in_fewer = result.size() <= 2 * f.size() && result.unknowns() < f.unknowns();
  return result.size() <= f.size() || in_fewer ? result : f;
}

std::vector<Relation> ExactMatrix::given() const {
  std::vector<Relation> result;
  for (const auto& [unknown, value] : explicit_)
    result.push_back(expression(RationalPolynomial::unknown(unknowns_->ring(), unknown)) == expression(value));
  return result;
}

const PolynomialRing& ExactMatrix::ring() const { return unknowns_->ring(); }

ExactMatrix::UnknownsOfAngle ExactMatrix::unknowns_of(const std::string& angle) const { return unknowns_->of_angle(angle); }

Expression ExactMatrix::entry(std::size_t row, std::size_t column) const { return expression(rows_[row][column]); }

Expression ExactMatrix::expression(const RationalPolynomial& f) const {
  return unknowns_->bridge.to_expression(unknowns_->expression(f));
}

// GiNaC's order and signs are its own: these are the text's.
std::optional<Expression> ExactMatrix::condition(const RationalPolynomial& f) const {
  const GiNaC::ex e = unknowns_->expression(f);
  if (!unknowns_->bridge.mentions_coordinate(e)) return std::nullopt;
  const Expression plus = unknowns_->bridge.to_expression(e), minus = unknowns_->bridge.to_expression(-e);
  return std::make_pair(plus.text().size(), plus.text()) < std::make_pair(minus.text().size(), minus.text()) ? plus : minus;
}

}  // namespace corank::symbolic
