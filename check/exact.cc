#include "corank/check/exact.h"

#include <algorithm>

#include "corank/check/kernel.h"

namespace corank::check {
namespace {

constexpr std::size_t kLongestSturm = 200;  // coefficients

void strip(RationalPolynomial& f) {
  while (!f.empty() && f.back().is_zero()) f.pop_back();
}

// sum := sum ± f
void add(RationalPolynomial& sum, const RationalPolynomial& f, int sign = 1) {
  sum.resize(std::max(sum.size(), f.size()));
  for (std::size_t k = 0; k < f.size(); ++k) sum[k] = sign > 0 ? sum[k] + f[k] : sum[k] - f[k];
  strip(sum);
}

bool is_rational(const RationalPolynomial& f) {
  return std::ranges::all_of(f, [](const ExactNumber& c) { return c.is_rational(); });
}

template <class Number>
Number at(const std::vector<Number>& f, const Number& x) {
  Number sum;
  for (std::size_t k = f.size(); k-- > 0;) sum = sum * x + f[k];
  return sum;
}

int sign_at(const RationalPolynomial& f, const ExactNumber& x) { return at(f, x).sign().value(); }

// The remainder of f by g ≠ 0.
RationalPolynomial remainder(RationalPolynomial f, const RationalPolynomial& g, const StopFlag& stop) {
  strip(f);
  while (f.size() >= g.size()) {
    stop.poll();
    const ExactNumber q = f.back() / g.back();
    const std::size_t shift = f.size() - g.size();
    for (std::size_t k = 0; k < g.size(); ++k) f[shift + k] = f[shift + k] - q * g[k];
    strip(f);
  }
  return f;
}

int changes(const std::vector<RationalPolynomial>& chain, const ExactNumber& x) {
  int count = 0, last = 0;
  for (const RationalPolynomial& f : chain) {
    const int sign = sign_at(f, x);
    if (sign == 0) continue;
    if (last != 0 && sign != last) ++count;
    last = sign;
  }
  return count;
}

RationalPolynomial derivative(const RationalPolynomial& f) {
  RationalPolynomial result;
  for (std::size_t k = 1; k < f.size(); ++k) result.push_back(ExactNumber(static_cast<long>(k)) * f[k]);
  return result;
}

using Enclosures = std::vector<Enclosure>;

Enclosures enclosures(const RationalPolynomial& f) {
  Enclosures result;
  for (const ExactNumber& c : f) result.emplace_back(c);
  return result;
}

// Nothing where the enclosure does not tell it.
std::optional<int> sign_at(const Enclosures& f, const ExactNumber& x) {
  const Enclosure value = at(f, Enclosure(x));
  if (value.is_zero()) return 0;
  if (value.is_negative()) return -1;
  if (value.is_positive()) return 1;
  return std::nullopt;
}

// Lemma: if p has opposite signs at the ends of an interval, and if every part of it has no zero of p, or p' with one and
// the same sign throughout, then p has exactly one root in the interval. Between two neighbouring roots, each with p' > 0
// (p' < 0), p would have to change its sign once more.
// False: not shown in a few parts.
bool is_crossed_once(const RationalPolynomial& p, const ExactNumber& lower, const ExactNumber& upper, const StopFlag& stop) {
  constexpr int kMostPartsOfRoot = 200;
  const Enclosures f = enclosures(p), slope = enclosures(derivative(p));
  bool rises = false, falls = false;
  const auto is_known = [&](const Sides& part) {
    if (!at(f, part[0]).has_zero()) return true;
    const Enclosure steepness = at(slope, part[0]);
    rises = rises || steepness.is_positive();
    falls = falls || steepness.is_negative();
    return !steepness.has_zero();
  };
  const Enclosure all = Enclosure::hull(Enclosure(lower), Enclosure(upper));
  return shown_in_parts({all}, {0}, {1.0}, kMostPartsOfRoot, stop, is_known) && !(rises && falls);
}

int roots_between(const RationalPolynomial& p, const ExactNumber& lower, const ExactNumber& upper, const StopFlag& stop) {
  std::vector<RationalPolynomial> chain{p, derivative(p)};
  while (chain.back().size() > 1) {
    RationalPolynomial next = remainder(chain[chain.size() - 2], chain.back(), stop);
    if (next.empty()) break;
    for (ExactNumber& c : next) c = -c;
    chain.push_back(std::move(next));
  }
  return changes(chain, lower) - changes(chain, upper);
}

}  // namespace

ExactCheck::ExactCheck(const System& system, const ExactPoint& point, const StopFlag& stop)
    : system_(system), point_(point), stop_(stop) {
  if (point.coordinates.size() != system.variables.size()) {
    fault_ = "it does not have one coordinate for each variable";
    return;
  }
  fault_ = check_root();
  if (!fault_.empty()) return;
  for (const RationalPolynomial& x : point.coordinates) {
    if (!is_rational(x)) fault_ = "a coordinate has a coefficient that is not a rational number";
    if (!fault_.empty()) return;
    reduced_.push_back(reduced(x));
    coordinates_.push_back(enclose(reduced_.back()));
  }
}

std::string ExactCheck::check_root() {
  p_ = point_.polynomial;
  strip(p_);
  if (p_.size() < 2 || !is_rational(p_) || !point_.lower.is_rational() || !point_.upper.is_rational())
    return "its number is not defined by a polynomial and an interval";
  const ExactNumber leading = p_.back();
  for (ExactNumber& c : p_) c = c / leading;
  ExactNumber lower = point_.lower, upper = point_.upper;
  const Enclosures enclosed = enclosures(p_);
  const auto sign_of_p = [&](const ExactNumber& x) {
    const auto sign = sign_at(enclosed, x);
    return sign ? *sign : sign_at(p_, x);
  };
  if ((upper - lower).sign() != 1 || sign_of_p(lower) * sign_of_p(upper) != -1)
    return "its polynomial does not have opposite signs at the ends of its interval";
  const bool is_short = p_.size() <= kLongestSturm;  // else the numbers of exact steps fill the memory
  if (!is_crossed_once(p_, lower, upper, stop_) && (!is_short || roots_between(p_, lower, upper, stop_) != 1))
    return is_short ? "its polynomial does not have exactly one root in its interval"
                    : "it is not shown that its polynomial, of a large degree, has exactly one root in its interval";
  const int sign = sign_of_p(lower);
  for (int step = 0; step < Enclosure::kBits + 16; ++step) {
    stop_.poll();
    const ExactNumber middle = (lower + upper) / 2;
    const auto fast = sign_at(enclosed, middle);
    if (!fast && !is_short) break;  // narrow enough for what enclosures can tell
    const int here = fast ? *fast : sign_at(p_, middle);
    if (here == 0) lower = upper = middle;
    if (here == 0) break;
    (here == sign ? lower : upper) = middle;
  }
  lower_ = lower;
  upper_ = upper;
  t_ = Enclosure::hull(Enclosure(lower), Enclosure(upper));
  return {};
}

RationalPolynomial ExactCheck::reduced(RationalPolynomial f) const { return remainder(std::move(f), p_, stop_); }

RationalPolynomial ExactCheck::product(const RationalPolynomial& f, const RationalPolynomial& g) const {
  if (f.empty() || g.empty()) return {};
  RationalPolynomial result(f.size() + g.size() - 1);
  for (std::size_t i = 0; i < f.size(); ++i) {
    stop_.poll();
    for (std::size_t k = 0; k < g.size(); ++k) result[i + k] = result[i + k] + f[i] * g[k];
  }
  return reduced(std::move(result));
}

RationalPolynomial ExactCheck::sum(RationalPolynomial f, const RationalPolynomial& g) const {
  add(f, g);
  return reduced(std::move(f));
}

Enclosure ExactCheck::enclose(const RationalPolynomial& f) const { return at(enclosures(f), t_); }

bool ExactCheck::is_known(const Polynomial& f) const {
  return std::ranges::all_of(f.monomials, [&](const Monomial& m) {
    return std::ranges::all_of(m.factors, [&](const Factor& x) { return knows(x.variable); });
  });
}

std::optional<RationalPolynomial> ExactCheck::value(const Monomial& m) const {
  if (!m.coefficient.is_rational()) return std::nullopt;
  RationalPolynomial result{m.coefficient};
  strip(result);
  for (const Factor& x : m.factors) {
    if (x.function != Function::identity || !knows(x.variable)) return std::nullopt;
    for (int k = 0; k < x.power; ++k) result = product(result, reduced_[x.variable]);
  }
  return result;
}

std::optional<RationalPolynomial> ExactCheck::value(const Polynomial& f) const {
  RationalPolynomial sum;
  for (const Monomial& m : f.monomials) {
    const auto term = value(m);
    if (!term) return std::nullopt;
    add(sum, *term);
  }
  return sum;
}

std::string ExactCheck::holds() const {
  if (system_.coefficient_tolerance > 0) return "a system with a tolerance has no exact solutions";
  for (std::size_t i = 0; i < system_.equations.size(); ++i) {
    const Polynomial& f = system_.equations[i];
    if (!is_known(f)) continue;
    const auto v = value(f);
    if (!v)
      return "equation " + std::to_string(i + 1) + " (" + f.source + ") is not a polynomial with rational coefficients";
    if (!v->empty()) return "equation " + std::to_string(i + 1) + " (" + f.source + ") does not hold there";
  }
  for (const Polynomial& g : system_.inequalities) {
    if (!is_known(g)) continue;
    const auto v = value(g);
    const Enclosure bound = Row(g, system_.size()).value(coordinates_);
    if (!(v && is_nonnegative(*v)) && !bound.is_nonnegative())
      return "an inequality (" + g.source + ") is not shown to hold there";
  }
  for (int j = 0; j < system_.size(); ++j) {
    if (!knows(j)) continue;
    const Variable& v = system_.variables[j];
    const auto not_less = [&](const ExactNumber& end, int sign) {  // sign·(x − end) ≥ 0
      if (!end.is_rational()) {
        const Enclosure bound(end);
        return sign > 0 ? bound.at_most(coordinate(j)) : coordinate(j).at_most(bound);
      }
      RationalPolynomial difference = sign > 0 ? reduced_[j] : RationalPolynomial{end};
      add(difference, sign > 0 ? RationalPolynomial{end} : reduced_[j], -1);
      return is_nonnegative(difference);
    };
    if (!not_less(v.lower, 1) || !not_less(v.upper, -1)) return v.name + " is not shown to lie in its domain";
  }
  return {};
}

std::string ExactCheck::kernel() const {
  const PolynomialMatrix matrix = kernel_matrix(system_);
  if (matrix.columns == 0) return point_.corank == -1 ? "" : "the system has no kernel vector";
  if (point_.corank == -1) return {};  // nothing is said
  auto entries = values(matrix);
  if (!entries) return "an entry of the kernel's matrix is not known there";
  const std::optional<int> known = rank(std::move(*entries), matrix.columns);
  if (!known) return "the rank of the kernel's matrix is not shown";
  const int dimension = matrix.columns - *known;
  if (dimension != point_.corank)
    return "the kernel's dimension is " + std::to_string(dimension) + ", not " + std::to_string(point_.corank);
  return {};
}

std::optional<int> ExactCheck::rank(Rows rows, std::size_t columns) const {
  // Rows are multiplied by pivots that are not 0: the rank stays.
  int rank = 0;
  std::vector<unsigned char> used(columns, 0);
  while (!rows.empty()) {
    std::size_t pivot_row = rows.size(), pivot = 0;
    bool open = false;
    for (std::size_t i = 0; i < rows.size() && pivot_row == rows.size(); ++i)
      for (std::size_t j = 0; j < rows[i].size(); ++j) {
        if (used[j] || rows[i][j].empty()) continue;
        open = true;
        if (enclose(rows[i][j]).has_zero()) continue;
        pivot_row = i, pivot = j;
        break;
      }
    if (pivot_row == rows.size()) {
      if (open) return std::nullopt;
      break;
    }
    const auto by = rows[pivot_row];
    rows.erase(rows.begin() + pivot_row);
    used[pivot] = 1;
    ++rank;
    for (auto& row : rows) {
      const RationalPolynomial factor = row[pivot];
      for (std::size_t j = 0; j < row.size(); ++j) {
        row[j] = product(row[j], by[pivot]);
        add(row[j], product(factor, by[j]), -1);
      }
    }
  }
  return rank;
}

std::optional<int> ExactCheck::rank(const PolynomialMatrix& matrix) const {
  auto entries = values(matrix);
  return entries ? rank(std::move(*entries), matrix.columns) : std::nullopt;
}

std::optional<ExactCheck::Rows> ExactCheck::values(const PolynomialMatrix& matrix) const {
  Rows rows(matrix.rows);
  for (int k = 0; k < matrix.rows * matrix.columns; ++k) {
    auto entry = value(matrix.entries[k]);
    if (!entry) return std::nullopt;
    rows[k / matrix.columns].push_back(std::move(*entry));
  }
  return rows;
}

std::string ExactCheck::inside(const Box& box) const {
  for (int j = 0; j < system_.size(); ++j) {
    if (!knows(j) || coordinate(j).inside(box[j])) continue;
    return system_.variables[j].name + " of its exact point lies outside it";
  }
  return {};
}

std::string ExactCheck::within(double radius, const Box& box) const {
  for (int j = 0; j < system_.size(); ++j) {
    if (!knows(j)) continue;
    // Every x − p_j, rounded outward: the ends of the ball itself would be rounded to its favour.
    const Enclosure offset = Enclosure(box[j]) - coordinate(j);
    if (!offset.inside(Enclosure(-radius, radius)))
      return "it reaches beyond the distance at which its exact point is shown to be the only solution";
  }
  return {};
}

}  // namespace corank::check
