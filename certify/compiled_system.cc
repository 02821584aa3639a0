#include "corank/certify/compiled_system.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "corank/certify/trigonometric.h"
#include "corank/core/check.h"

namespace corank::certify {
namespace {

// Encloses (xᵖ − cᵖ)/(x − c) = Σ_{k<p} xᵏ c^{p−1−k} for x ∈ X, by Horner's scheme.
Interval power_slope(const Interval& x, double c, int p) {
  Interval sum = 1.0, c_power = 1.0;
  for (int k = 1; k < p; ++k) {
    c_power = c_power * Interval(c);
    sum = sum * x + c_power;
  }
  return sum;
}

// About xᵖ, of a small p.
double approximate_power(double x, int p) {
  double product = 1;
  for (; p > 0; --p) product *= x;
  return product;
}

// (X + c)/2.
Interval half_way(const Interval& x, double c) { return scale(0.5, x + Interval(c)); }

}  // namespace

CompiledSystem::CompiledSystem(const System& system, std::span<const Polynomial> values) : variables_(system.size()) {
  for (int j = 0; j < variables_; ++j) {
    const Variable& v = system.variables[j];
    scales_.push_back(v.size);
    if (!v.is_parameter()) continue;
    parameters_.push_back(j);
    parameter_domains_.push_back(v.domain);
  }
  system.validate();
  equations_ = static_cast<int>(system.equations.size());
  rows_ = equations_ + static_cast<int>(system.inequalities.size());
  contracting_ = rows_ + static_cast<int>(system.implied.size());
  term_begin_.push_back(0);
  row_begin_.push_back(0);
  std::vector<std::vector<int>> rows_of(variables_);

  const auto add_row = [&](const Polynomial& f) {
    const int row = static_cast<int>(term_begin_.size()) - 1;
    std::set<int> used;
    for (const Monomial& m : f.monomials)
      for (const Factor& factor : m.factors) used.insert(factor.variable);
    const int first = row_begin_.back();
    for (int v : used) {
      columns_.push_back(v);
      if (row < contracting_) rows_of[v].push_back(row);
    }
    const auto entry = [&](int v) { return first + static_cast<int>(std::distance(used.begin(), used.find(v))); };
    for (const Monomial& m : f.monomials) {
      Term t{m.enclosure, Shape::general};
      const auto& fs = m.factors;
      if (fs.empty()) {
        t.shape = Shape::constant;
      } else if (m.is_trigonometric()) {
        t.shape = fs[0].function == Function::sine ? Shape::sine : Shape::cosine;
      } else if (fs.size() == 1 && fs[0].power <= 2) {
        t.shape = fs[0].power == 1 ? Shape::linear : Shape::square;
      } else if (fs.size() == 2 && fs[0].power == 1 && fs[1].power == 1) {
        t.shape = Shape::bilinear;
        t.y = fs[1].variable;
        t.y_entry = entry(t.y);
      }
      if (!fs.empty()) {
        t.x = fs[0].variable;
        t.x_entry = entry(t.x);
      }
      if (t.shape == Shape::general) {
        t.factors_begin = static_cast<int>(factors_.size());
        for (const Factor& g : fs) factors_.push_back({g.variable, g.power, entry(g.variable)});
        t.factors_end = static_cast<int>(factors_.size());
      }
      terms_.push_back(t);
    }
    term_begin_.push_back(static_cast<int>(terms_.size()));
    row_begin_.push_back(static_cast<int>(columns_.size()));
  };
  for (const Polynomial& f : system.equations) add_row(f);
  for (const Polynomial& g : system.inequalities) add_row(g);
  for (const Polynomial& h : system.implied) add_row(h);
  for (const Polynomial& v : values) add_row(v);

  rows_of_begin_.push_back(0);
  for (const auto& list : rows_of) {
    rows_of_.insert(rows_of_.end(), list.begin(), list.end());
    rows_of_begin_.push_back(static_cast<int>(rows_of_.size()));
  }
}

void CompiledSystem::free_parameters(std::span<Interval> x) const {
  for (std::size_t k = 0; k < parameters_.size(); ++k) x[parameters_[k]] = parameter_domains_[k];
}

void CompiledSystem::set_scales(std::vector<double> scales) {
  CORANK_CHECK(static_cast<int>(scales.size()) == variables_);
  for (const double scale : scales) CORANK_CHECK(scale > 0 && std::isfinite(scale));
  scales_ = std::move(scales);
}

Interval CompiledSystem::evaluate(const Term& t, std::span<const Interval> x) const {
  switch (t.shape) {
    case Shape::constant: return t.c;
    case Shape::linear: return t.c * x[t.x];
    case Shape::square: return t.c * square(x[t.x]);
    case Shape::bilinear: return t.c * (x[t.x] * x[t.y]);
    case Shape::sine: return t.c * sine(x[t.x]);
    case Shape::cosine: return t.c * cosine(x[t.x]);
    case Shape::general: break;
  }
  Interval product = t.c;
  for (const GeneralFactor& f : factors(t)) product *= power(x[f.variable], f.power);
  return product;
}

Interval CompiledSystem::evaluate(int row, std::span<const Interval> x) const {
  Interval sum;
  for (const Term& t : terms(row)) sum += evaluate(t, x);
  return sum;
}

Interval CompiledSystem::evaluate_at(int row, const double* x) const {
  Interval sum;
  for (const Term& t : terms(row)) {
    switch (t.shape) {
      case Shape::constant: sum += t.c; break;
      case Shape::linear: sum += scale(x[t.x], t.c); break;
      case Shape::square: sum += t.c * square(Interval(x[t.x])); break;
      case Shape::bilinear: sum += scale(x[t.y], scale(x[t.x], t.c)); break;
      case Shape::sine: sum += t.c * sine(x[t.x]); break;
      case Shape::cosine: sum += t.c * cosine(x[t.x]); break;
      case Shape::general: {
        Interval product = t.c;
        for (const GeneralFactor& f : factors(t)) product *= power(Interval(x[f.variable]), f.power);
        sum += product;
      }
    }
  }
  return sum;
}

void CompiledSystem::slopes(int from, int to, std::span<const Interval> x, const double* c, std::span<Interval> s) const {
  std::fill(s.begin() + row_begin_[from], s.begin() + row_begin_[to], Interval());
  for (int k = term_begin_[from]; k < term_begin_[to]; ++k) {
    const Term& t = terms_[k];
    switch (t.shape) {
      case Shape::constant: break;
      case Shape::linear: s[t.x_entry] += t.c; break;
      case Shape::square: s[t.x_entry] += t.c * (x[t.x] + Interval(c[t.x])); break;
      case Shape::bilinear:  // xy − ab = (y + b)/2 (x − a) + (x + a)/2 (y − b)
        s[t.x_entry] += t.c * half_way(x[t.y], c[t.y]);
        s[t.y_entry] += t.c * half_way(x[t.x], c[t.x]);
        break;
      case Shape::sine: s[t.x_entry] += t.c * sine_slope(x[t.x], c[t.x]); break;
      case Shape::cosine: s[t.x_entry] += t.c * cosine_slope(x[t.x], c[t.x]); break;
      case Shape::general: {  // telescoping: the factors before the j-th at c, those after it over X
        const auto fs = factors(t);
        for (std::size_t j = 0; j < fs.size(); ++j) {
          Interval product = t.c * power_slope(x[fs[j].variable], c[fs[j].variable], fs[j].power);
          for (std::size_t i = 0; i < fs.size(); ++i) {
            if (i < j) product *= power(Interval(c[fs[i].variable]), fs[i].power);
            if (i > j) product *= power(x[fs[i].variable], fs[i].power);
          }
          s[fs[j].entry] += product;
        }
      }
    }
  }
}

void CompiledSystem::jacobian(int from, int to, std::span<const Interval> x, std::span<Interval> j) const {
  std::fill(j.begin() + row_begin_[from], j.begin() + row_begin_[to], Interval());
  for (int k = term_begin_[from]; k < term_begin_[to]; ++k) {
    const Term& t = terms_[k];
    switch (t.shape) {
      case Shape::constant: break;
      case Shape::linear: j[t.x_entry] += t.c; break;
      case Shape::square: j[t.x_entry] += t.c * scale(2.0, x[t.x]); break;
      case Shape::bilinear:
        j[t.x_entry] += t.c * x[t.y];
        j[t.y_entry] += t.c * x[t.x];
        break;
      case Shape::sine: j[t.x_entry] += t.c * cosine(x[t.x]); break;
      case Shape::cosine: j[t.x_entry] -= t.c * sine(x[t.x]); break;
      case Shape::general: {
        const auto fs = factors(t);
        for (std::size_t a = 0; a < fs.size(); ++a) {
          Interval product = t.c * scale(fs[a].power, power(x[fs[a].variable], fs[a].power - 1));
          for (std::size_t b = 0; b < fs.size(); ++b)
            if (b != a) product *= power(x[fs[b].variable], fs[b].power);
          j[fs[a].entry] += product;
        }
      }
    }
  }
}

void CompiledSystem::approximate_jacobian(const double* x, double* j) const {
  std::fill(j, j + row_begin_[equations_], 0.0);
  for (int k = 0; k < term_begin_[equations_]; ++k) {
    const Term& t = terms_[k];
    const double c = t.c.hi();
    switch (t.shape) {
      case Shape::constant: break;
      case Shape::linear: j[t.x_entry] += c; break;
      case Shape::square: j[t.x_entry] += 2 * c * x[t.x]; break;
      case Shape::bilinear:
        j[t.x_entry] += c * x[t.y];
        j[t.y_entry] += c * x[t.x];
        break;
      case Shape::sine: j[t.x_entry] += c * std::cos(x[t.x]); break;
      case Shape::cosine: j[t.x_entry] -= c * std::sin(x[t.x]); break;
      case Shape::general: {
        const auto fs = factors(t);
        for (std::size_t a = 0; a < fs.size(); ++a) {
          double product = c * fs[a].power * approximate_power(x[fs[a].variable], fs[a].power - 1);
          for (std::size_t b = 0; b < fs.size(); ++b)
            if (b != a) product *= approximate_power(x[fs[b].variable], fs[b].power);
          j[fs[a].entry] += product;
        }
      }
    }
  }
}

}  // namespace corank::certify
