#include "corank/check/rows.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "corank/core/box.h"

namespace corank::check {
namespace {

double power(double x, int p) { return p == 1 ? x : p == 2 ? x * x : std::pow(x, p); }
double sine(double x) { return std::sin(x); }
double cosine(double x) { return std::cos(x); }

// (sin x − sin c)/(x − c) = cos((x + c)/2)·sin(h)/h with h = (x − c)/2, and 1 − h²/6 ≤ sin(h)/h ≤ 1; besides, a derivative
// at a point between x and c.
Enclosure wave_slope(const Enclosure& at_middle, const Enclosure& over_hull, const Enclosure& h) {
  const Enclosure least = Enclosure(1.0) - quotient(power(h, 2), Enclosure(6.0));
  Enclosure slope = at_middle * Enclosure::hull(least, Enclosure(1.0));
  slope.intersect(over_hull);
  return slope;
}

}  // namespace

Row::Row(const Terms& f, const std::vector<int>& place) {
  for (const auto& [factors, c] : f.list())
    for (const Factor& factor : factors) columns_.push_back(place[factor.variable]);
  std::ranges::sort(columns_);
  columns_.erase(std::unique(columns_.begin(), columns_.end()), columns_.end());
  for (const auto& [factors, c] : f.list()) {
    Term t{c.range, c.range.mid(), {}};
    for (const Factor& factor : factors) {
      const int variable = place[factor.variable];
      const auto column = std::ranges::lower_bound(columns_, variable) - columns_.begin();
      t.parts.push_back({variable, factor.power, static_cast<int>(column), factor.function});
    }
    terms_.push_back(std::move(t));
  }
}

Row::Row(const Polynomial& f, int variables, double tolerance) : Row(Terms(f, tolerance), all_but({}, variables)) {}

template <class Number>
Number Row::value(const TermFactor& p, const Number& x) {
  if (p.function == Function::sine) return sine(x);
  if (p.function == Function::cosine) return cosine(x);
  return power(x, p.power);
}

template <class Number>
Number Row::derivative(const TermFactor& p, const Number& x) {
  if (p.function == Function::sine) return cosine(x);
  if (p.function == Function::cosine) return -sine(x);
  return p.power == 1 ? Number(1.0) : Number(static_cast<double>(p.power)) * power(x, p.power - 1);
}

Enclosure Row::slope(const TermFactor& p, const Enclosure& x, const Enclosure& c) {
  if (p.function != Function::identity) {
    const Enclosure half(0.5), middle = half * (x + c), hull = Enclosure::hull(x, c), h = half * (x - c);
    if (p.function == Function::sine) return wave_slope(cosine(middle), cosine(hull), h);
    return wave_slope(-sine(middle), -sine(hull), h);
  }
  if (p.power == 1) return 1.0;
  if (p.power == 2) return x + c;
  Enclosure sum;  // xᵖ − cᵖ = (x − c) Σ xᵏ c^{p−1−k}
  for (int k = 0; k < p.power; ++k) sum.add_product(power(x, k), power(c, p.power - 1 - k));
  sum.intersect(derivative(p, Enclosure::hull(x, c)));
  return sum;
}

template <class Number>
Number Row::value(const Term& t, const std::vector<Number>& x) {
  Number product = t.coefficient(Number());
  for (const TermFactor& p : t.parts) {
    const Number& side = x[p.variable];
    if (p.power == 1 && p.function == Function::identity) {
      product *= side;
    } else {
      product *= value(p, side);
    }
  }
  return product;
}

Enclosure Row::value(const Sides& x) const {
  Enclosure sum;
  for (const Term& t : terms_) sum += value(t, x);
  return sum;
}

void Row::slopes(const Sides& x, const Sides& c, Sides& s) const {
  s.assign(columns_.size(), Enclosure());
  for (const Term& t : terms_) {
    const std::size_t n = t.parts.size();
    if (n == 2 && t.parts[0].power == 1 && t.parts[1].power == 1) {
      for (std::size_t i = 0; i < 2; ++i) {
        const std::size_t other = t.parts[1 - i].variable;
        s[t.parts[i].column].add_product(t.c, Enclosure(0.5) * (x[other] + c[other]));
      }
      continue;
    }
    // Π fᵢ(xᵢ) − Π fᵢ(cᵢ) = Σᵢ Π_{j<i} fⱼ(cⱼ) · (fᵢ(xᵢ) − fᵢ(cᵢ)) · Π_{j>i} fⱼ(xⱼ)
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t own = t.parts[i].variable;
      Enclosure product = t.c * slope(t.parts[i], x[own], c[own]);
      for (std::size_t j = 0; j < n; ++j) {
        if (j == i) continue;
        const std::size_t v = t.parts[j].variable;
        product *= value(t.parts[j], j < i ? c[v] : x[v]);
      }
      s[t.parts[i].column] += product;
    }
  }
}

template <class Number>
void Row::find_derivatives(const std::vector<Number>& x, std::vector<Number>& s) const {
  s.assign(columns_.size(), Number());
  for (const Term& t : terms_)
    for (const TermFactor& p : t.parts) {
      Number product = t.coefficient(Number()) * derivative(p, x[p.variable]);
      for (const TermFactor& q : t.parts)
        if (&q != &p) product *= value(q, x[q.variable]);
      s[p.column] += product;
    }
}

void Row::derivatives(const Sides& x, Sides& s) const { find_derivatives(x, s); }

double Row::approximate(const std::vector<double>& x) const {
  double sum = 0;
  for (const Term& t : terms_) sum += value(t, x);
  return sum;
}

void Row::approximate(const std::vector<double>& x, std::vector<double>& s) const { find_derivatives(x, s); }

bool Row::invert(const Term& t, const Enclosure& image, Sides& x) {
  for (const TermFactor& p : t.parts) {
    Enclosure& side = x[p.variable];
    Enclosure others = t.c;
    for (const TermFactor& q : t.parts)
      if (&q != &p) others *= value(q, x[q.variable]);
    if (others.is_zero()) continue;
    const auto values = divide(image, others, value(p, side));
    if (!values) return false;
    const auto shrunk = p.function == Function::sine     ? inverse_sine(*values, side)
                        : p.function == Function::cosine ? inverse_cosine(*values, side)
                                                         : root(*values, p.power, side);
    if (!shrunk) return false;
    side = *shrunk;
  }
  return true;
}

bool Row::project(Sides& x, bool equation) const {
  const std::size_t n = terms_.size();
  Sides values, suffix(n + 1);  // suffix[k] = Σ_{j ≥ k} Tⱼ
  values.reserve(n);
  for (const Term& t : terms_) values.push_back(value(t, x));
  for (std::size_t k = n; k-- > 0;) suffix[k] = values[k] + suffix[k + 1];
  if (equation ? !suffix[0].has_zero() : suffix[0].is_negative()) return false;
  if (!equation && suffix[0].is_nonnegative()) return true;
  Enclosure prefix;
  for (std::size_t k = 0; k < n; ++k) {
    Enclosure image = -(prefix + suffix[k + 1]);
    if (!equation) image = Enclosure::hull(image, Enclosure(kInfinity));
    prefix += values[k];
    if (values[k].inside(image)) continue;  // no information
    if (!invert(terms_[k], image, x)) return false;
  }
  return equation || is_linear() || project_by_slopes(x);
}

bool Row::is_linear() const {
  return std::ranges::all_of(terms_, [](const Term& t) {
    return t.parts.empty() || (t.parts.size() == 1 && t.parts[0].power == 1 && t.parts[0].function == Function::identity);
  });
}

bool Row::project_by_slopes(Sides& x) const {
  Sides c = x, s;
  for (const int j : columns_) {
    const double mid = x[j].mid();
    if (!std::isfinite(mid)) return true;
    c[j] = Enclosure(mid);
  }
  slopes(x, c, s);
  const Enclosure at_center = value(c);
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    Enclosure& side = x[columns_[k]];
    const Enclosure& middle = c[columns_[k]];
    Enclosure others = at_center;
    for (std::size_t i = 0; i < columns_.size(); ++i)
      if (i != k) others.add_product(s[i], x[columns_[i]] - c[columns_[i]]);
    const auto offset = divide(Enclosure::hull(-others, Enclosure(kInfinity)), s[k], side - middle);
    if (!offset || !side.intersect(*offset + middle)) return false;
  }
  return true;
}

std::vector<Row> rows_of(const std::vector<Polynomial>& list, int variables, double tolerance) {
  std::vector<Row> rows;
  for (const Polynomial& f : list) rows.emplace_back(f, variables, tolerance);
  return rows;
}

RowMatrix entries_of(const PolynomialMatrix& matrix, int variables, double tolerance) {
  RowMatrix rows(matrix.rows);
  for (int k = 0; k < matrix.rows * matrix.columns; ++k)
    rows[k / matrix.columns].emplace_back(matrix.entries[k], variables, tolerance);
  return rows;
}

std::vector<Sides> values(const RowMatrix& matrix, const Sides& x) {
  std::vector<Sides> result;
  for (const std::vector<Row>& row : matrix) {
    result.emplace_back();
    for (const Row& entry : row) result.back().push_back(entry.value(x));
  }
  return result;
}

std::vector<int> variables_of(const RowMatrix& matrix) {
  std::set<int> variables;
  for (const std::vector<Row>& row : matrix)
    for (const Row& entry : row) variables.insert(entry.columns().begin(), entry.columns().end());
  return {variables.begin(), variables.end()};
}

bool overlap(const Sides& x, const Sides& y) {
  return std::ranges::equal(x, y, [](const Enclosure& a, const Enclosure& b) { return a.overlaps(b); });
}

std::vector<double> domain_lengths(const System& system) {
  std::vector<double> lengths;
  for (const Variable& v : system.variables) {
    const double length = v.is_parameter() ? v.domain.mag() : v.domain.width();
    lengths.push_back(length > 0 ? length : 1);
  }
  return lengths;
}

std::optional<std::array<Sides, 2>> halved(const Sides& x, const std::vector<int>& sides,
                                           const std::vector<double>& lengths) {
  int widest = -1;
  double width = 0;
  for (const int j : sides)
    if (const Enclosure& side = x[j]; side.width() > width * lengths[j] && side.lo() < side.mid() && side.mid() < side.hi())
      width = side.width() / lengths[j], widest = j;
  if (widest < 0) return std::nullopt;
  const double from = x[widest].lo(), middle = x[widest].mid(), to = x[widest].hi();
  std::array<Sides, 2> halves{x, x};
  halves[0][widest] = Enclosure(from, middle);
  halves[1][widest] = Enclosure(middle, to);
  return halves;
}

bool shown_in_parts(Sides x, const std::vector<int>& sides, const std::vector<double>& lengths, int most_parts,
                    const StopFlag& stop, const std::function<bool(Sides&)>& shown) {
  std::vector<Sides> open{std::move(x)};
  for (int parts = 0; !open.empty(); ++parts) {
    stop.poll();
    Sides part = std::move(open.back());
    open.pop_back();
    if (shown(part)) continue;
    auto both = parts > most_parts ? std::nullopt : halved(part, sides, lengths);
    if (!both) return false;
    open.push_back(std::move((*both)[1]));
    open.push_back(std::move((*both)[0]));
  }
  return true;
}

}  // namespace corank::check
