#include "corank/check/passage.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "corank/check/krawczyk.h"

namespace corank::check {
namespace {

constexpr int kMostParts = 500;

// Are all pivots of sign·S positive? Elimination with intervals encloses those of every matrix within.
bool definite(std::vector<Sides> s, int sign) {
  const std::size_t k = s.size();
  for (std::size_t p = 0; p < k; ++p) {
    if (!(sign > 0 ? s[p][p].is_positive() : s[p][p].is_negative())) return false;
    for (std::size_t i = p + 1; i < k; ++i) {
      const Enclosure factor = quotient(s[i][p], s[p][p]);
      for (std::size_t j = p + 1; j < k; ++j) s[i][j] -= factor * s[p][j];
    }
  }
  return true;
}

// The rows of L⁻¹ where S = L D Lᵀ, as far as pivots allow, the unit vectors, their sums and differences.
std::vector<std::vector<double>> directions(const std::vector<Sides>& s) {
  const std::size_t k = s.size();
  std::vector<std::vector<double>> a(k, std::vector<double>(k)), list;
  for (std::size_t i = 0; i < k; ++i)
    for (std::size_t j = 0; j < k; ++j) a[i][j] = s[i][j].mid();
  std::vector<std::vector<double>> inverse(k, std::vector<double>(k, 0.0));
  for (std::size_t i = 0; i < k; ++i) inverse[i][i] = 1;
  list = inverse;
  for (std::size_t i = 0; i < k; ++i)
    for (std::size_t j = 0; j < i; ++j)
      for (const double sign : {1.0, -1.0}) {
        list.push_back(inverse[i]);
        list.back()[j] = sign;
      }
  for (std::size_t p = 0; p < k && a[p][p] != 0; ++p)
    for (std::size_t i = p + 1; i < k; ++i) {
      const double factor = a[i][p] / a[p][p];
      for (std::size_t j = 0; j < k; ++j) {
        a[i][j] -= factor * a[p][j];
        inverse[i][j] -= factor * inverse[p][j];
      }
    }
  list.insert(list.end(), inverse.begin(), inverse.end());
  std::erase_if(
      list, [](const std::vector<double>& v) { return !std::ranges::all_of(v, [](double x) { return std::isfinite(x); }); });
  return list;
}

Enclosure value(const std::vector<Sides>& s, const std::vector<double>& v) {
  Enclosure sum;
  for (std::size_t i = 0; i < v.size(); ++i)
    for (std::size_t j = 0; j < v.size(); ++j) sum += Enclosure(v[i]) * Enclosure(v[j]) * s[i][j];
  return sum;
}

}  // namespace

PassageCheck::PassageCheck(const System& system, const StopFlag& stop) : stop_(stop), lengths_(domain_lengths(system)) {
  if (!system.passage || system.coefficient_tolerance > 0) return;
  const PassageForm& form = *system.passage;
  has_form_ = true;
  equations_ = form.equations;
  columns_ = form.columns;
  multipliers_ = form.multipliers;
  std::set<int> arguments;
  const auto add = [&](const std::vector<Polynomial>& list, std::vector<Row>& rows) {
    for (const Polynomial& f : list) {
      rows.emplace_back(f, system.size());
      arguments.insert(rows.back().columns().begin(), rows.back().columns().end());
    }
  };
  add(form.jacobian, jacobian_);
  add(form.hessian, hessian_);
  add(form.slack, slack_);
  add(form.normal, normal_);
  arguments_.assign(arguments.begin(), arguments.end());
  add(system.equations, rows_);
  add(system.inequalities, rows_);
  system_equations_ = system.equations.size();
}

// S and the slacks over x; nothing where the hypotheses about λ and N are not shown.
std::optional<PassageCheck::Form> PassageCheck::form(const Sides& x) const {
  const std::size_t none = equations_;
  std::size_t passed = none;
  for (std::size_t i = 0; i < equations_; ++i) {
    const Enclosure& side = x[multipliers_[i]];
    if (side.has_zero()) continue;
    if (passed == none || side.mig() > x[multipliers_[passed]].mig()) passed = i;
  }
  if (equations_ > 0 && (passed == none || columns_ + 1 < equations_)) return std::nullopt;
  std::vector<Sides> m;
  for (std::size_t i = 0; i < equations_; ++i) {
    if (i == passed) continue;
    m.emplace_back();
    for (std::size_t j = 0; j < columns_; ++j) m.back().push_back(jacobian_[i * columns_ + j].value(x));
  }
  const std::size_t r = m.size();
  std::vector<std::vector<double>> t;
  for (const Sides& row : m) {
    t.emplace_back();
    for (const Enclosure& e : row) t.back().push_back(e.mid());
  }
  const std::vector<std::size_t> dependent = pivots(t, r).columns;  // of N
  if (dependent.size() < r) return std::nullopt;
  std::vector<std::size_t> others;
  for (std::size_t j = 0; j < columns_; ++j)
    if (std::ranges::find(dependent, j) == dependent.end()) others.push_back(j);

  std::vector<double> middle;
  for (const std::vector<double>& row : t)
    for (const std::size_t j : dependent) middle.push_back(row[j]);
  const std::vector<double> y = r > 0 ? inverse(middle, r) : std::vector<double>{};
  if (y.size() != r * r) return std::nullopt;
  const auto times_y = [&](std::size_t i, std::size_t column) {
    Enclosure sum;
    for (std::size_t b = 0; b < r; ++b) sum.add_product(y[i * r + b], m[b][column]);
    return sum;
  };
  std::vector<Sides> e(r);
  std::vector<double> excess;
  double most = 0;
  for (std::size_t i = 0; i < r; ++i) {
    double sum = 0;
    for (std::size_t j = 0; j < r; ++j) {
      e[i].push_back(Enclosure(i == j ? 1.0 : 0.0) - times_y(i, dependent[j]));
      excess.push_back(e[i].back().mag());
      sum += excess.back();
    }
    most = std::max(most, sum * (1 + 1e-12));
  }
  if (r > 0 && (!is_contraction(excess, r) || !(most < 1))) return std::nullopt;

  // Column a of ker Φ_z: 1 at others[a]; at the dependent ones w = −Y·b + E·w, so |w| ≤ |Y·b| / (1 − |E|).
  std::vector<Sides> basis(others.size(), Sides(columns_));
  for (std::size_t a = 0; a < others.size(); ++a) {
    basis[a][others[a]] = Enclosure(1.0);
    Sides w;
    double size = 0;
    for (std::size_t i = 0; i < r; ++i) {
      w.push_back(-times_y(i, others[a]));
      size = std::max(size, w.back().mag());
    }
    const double bound = size / (1 - most) * (1 + 1e-12);
    Sides all(r, Enclosure(-bound, bound));
    for (int sweep = 0; sweep < 3; ++sweep) {
      Sides next = w;
      for (std::size_t i = 0; i < r; ++i)
        for (std::size_t j = 0; j < r; ++j) next[i].add_product(e[i][j], all[j]);
      for (std::size_t i = 0; i < r; ++i)
        if (!all[i].intersect(next[i])) return std::nullopt;
    }
    for (std::size_t i = 0; i < r; ++i) basis[a][dependent[i]] = all[i];
  }
  std::vector<Sides> h(columns_, Sides(columns_));
  for (std::size_t i = 0, next = 0; i < columns_; ++i)
    for (std::size_t j = i; j < columns_; ++j, ++next) h[i][j] = h[j][i] = hessian_[next].value(x);
  Form result;
  for (std::size_t a = 0; a < others.size(); ++a) {
    result.s.emplace_back();
    for (std::size_t b = 0; b < others.size(); ++b) {
      Enclosure sum;
      for (std::size_t i = 0; i < columns_; ++i)
        for (std::size_t j = 0; j < columns_; ++j) sum += basis[a][i] * basis[b][j] * h[i][j];
      result.s.back().push_back(sum);
    }
  }
  for (const Row& s : slack_) result.slack.push_back(s.value(x));
  return result;
}

bool PassageCheck::holds(const CoverBox& box, const Sides& x) const {
  Enclosure along;  // n·side
  for (std::size_t i = 0; i < normal_.size(); ++i) along.add_product(box.side[i], normal_[i].value(x));
  if (along.has_zero()) return false;
  const std::optional<Form> f = form(x);
  if (!f) return false;
  if (box.passage == Passage::traversable) {
    bool plus = false, minus = false;
    const auto see = [&](const Enclosure& e) {
      plus = plus || e.is_positive();
      minus = minus || e.is_negative();
    };
    for (const Enclosure& s : f->slack) see(s);
    for (const auto& v : directions(f->s)) see(value(f->s, v));
    return plus && minus;
  }
  const int sign = along.is_negative() ? 1 : -1;  // the outputs are at −n where the form is positive
  for (const Enclosure& s : f->slack)
    if (!(sign > 0 ? s.is_positive() : s.is_negative())) return false;
  return definite(f->s, sign);
}

bool PassageCheck::contract(Sides& x) const {
  for (int sweep = 0; sweep < 2; ++sweep)
    for (std::size_t k = 0; k < rows_.size(); ++k)
      if (!rows_[k].project(x, k < system_equations_)) return false;
  return true;
}

std::string PassageCheck::fault(const CoverBox& box) const {
  if (box.passage == Passage::unproven) return box.side.empty() ? "" : "it names a side, but no passage";
  if (!has_form_) return "it says whether the output can pass, but nothing decides that here";
  double length = 0;
  for (const double d : box.side) length = std::hypot(length, d);
  if (box.side.size() != normal_.size() || !(std::fabs(length - 1) < 1e-9)) return "its side is not a unit vector";
  const bool shown = shown_in_parts(Sides(box.box.begin(), box.box.end()), arguments_, lengths_, kMostParts, stop_,
                                    [&](Sides& x) { return holds(box, x) || !contract(x) || holds(box, x); });
  if (shown) return "";
  return std::string("it is not shown that the output finds a ") +
         (box.passage == Passage::barrier ? "barrier there, on that side" : "way through there");
}

}  // namespace corank::check
