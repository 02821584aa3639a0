// Systems with a planted passage: Φ_z, its left kernel and the form on its right kernel are made from integers, so that
// the answer is known.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "corank/core/cover.h"
#include "corank/core/system.h"

namespace corank::test {

struct PlantedPassage {
  System system;           ///< variables: t, then λ unless the system is without; everything is as planted at t = 0
  std::vector<double> at;  ///< the solution
  bool plus = false, minus = false, zero = false;  ///< signs among the numbers of the form
  std::vector<double> normal;

  /// About the solution.
  Box box(double radius) const {
    Box b;
    for (const double x : at) b.emplace_back(x - radius, x + radius);
    return b;
  }
  bool is_barrier() const { return plus != minus && !zero; }
  bool is_traversable() const { return plus && minus; }
  /// Where a barrier leaves the output.
  std::vector<double> side() const {
    double size = 0;
    for (const double x : normal) size += x * x;
    std::vector<double> s;
    for (const double x : normal) s.push_back((plus ? -x : x) / std::sqrt(size));
    return s;
  }
};

class PassagePlanter {
 public:
  explicit PassagePlanter(unsigned seed) : random_(seed) {}

  /// With these numbers of equations, dimensions of the right kernel, coordinates at limits; `zeros`: how many numbers of
  /// the form are 0. Without multipliers the form's entries are sums of λ's components, which the system does not have.
  PlantedPassage plant(std::size_t equations, std::size_t kernel, std::size_t limits, std::size_t zeros = 0,
                       bool has_multipliers = true) {
    const std::size_t e = equations, m = e - 1 + kernel;
    PlantedPassage p;
    PassageForm& form = p.system.passage.emplace();
    form.equations = static_cast<int>(e);
    form.columns = static_cast<int>(m);
    p.system.variables.emplace_back("t", VariableKind::length, -1, 1);
    p.system.configuration_size = 1;
    p.at.push_back(0);
    std::vector<int> lambda;
    for (std::size_t i = 0; i < e; ++i) {
      lambda.push_back(i + 1 == e ? 1 : number(-2, 2));
      if (!has_multipliers) continue;
      p.system.variables.emplace_back("l" + std::to_string(i), VariableKind::kernel, -10, 10);
      p.at.push_back(lambda.back());
      form.multipliers.push_back(static_cast<int>(i) + 1);
    }
    const auto entry = [&](int x) { return has_multipliers ? nearby(x) : sum_of(lambda, x); };
    // Φ_z = M·T, its first e − 1 rows A·T, its last the one that λ asks for.
    const Matrix t = unimodular(m), a = unimodular(e - 1);
    Matrix jacobian(e, std::vector<int>(m, 0));
    for (std::size_t i = 0; i + 1 < e; ++i)
      for (std::size_t j = 0; j < m; ++j) {
        for (std::size_t b = 0; b + 1 < e; ++b) jacobian[i][j] += a[i][b] * t[b][j];
        jacobian[e - 1][j] -= lambda[i] * jacobian[i][j];
      }
    for (const auto& row : jacobian)
      for (const int x : row) form.jacobian.push_back(nearby(x));
    // H = Tᵀ K T, where K ends in the form: that of a diagonal in other coordinates.
    const Matrix c = unimodular(kernel);
    std::vector<int> diagonal;
    for (std::size_t i = 0; i < kernel + limits; ++i)
      diagonal.push_back(zeros > i ? 0 : number(1, 3) * (number(0, 1) ? 1 : -1));
    if (number(0, 1)) {  // half of them definite
      for (int& d : diagonal) d = std::abs(d);
    }
    std::shuffle(diagonal.begin(), diagonal.end(), random_);
    for (const int d : diagonal) (d > 0 ? p.plus : d < 0 ? p.minus : p.zero) = true;
    Matrix k(m, std::vector<int>(m, 0));
    for (std::size_t i = 0; i < m; ++i)
      for (std::size_t j = i; j < m; ++j) {
        if (i < e - 1 || j < e - 1) {
          k[i][j] = number(-2, 2);
        } else {
          for (std::size_t b = 0; b < kernel; ++b) k[i][j] += c[b][i - (e - 1)] * diagonal[b] * c[b][j - (e - 1)];
        }
        k[j][i] = k[i][j];
      }
    for (std::size_t i = 0; i < m; ++i)
      for (std::size_t j = i; j < m; ++j) {
        int h = 0;
        for (std::size_t x = 0; x < m; ++x)
          for (std::size_t y = 0; y < m; ++y) h += t[x][i] * k[x][y] * t[y][j];
        form.hessian.push_back(entry(h));
      }
    for (std::size_t i = 0; i < limits; ++i) form.slack.push_back(entry(diagonal[kernel + i]));
    for (int i = 0; i < 2; ++i) {
      p.normal.push_back(number(1, 3) * (number(0, 1) ? 1 : -1));
      form.normal.push_back(entry(static_cast<int>(p.normal.back())));
    }
    return p;
  }

  int number(int from, int to) { return std::uniform_int_distribution<int>(from, to)(random_); }

 private:
  using Matrix = std::vector<std::vector<int>>;

  // x + a·t.
  Polynomial nearby(int x) {
    Polynomial f;
    if (x != 0) f.monomials.emplace_back(x, std::vector<Factor>{});
    if (const int a = number(-1, 1); a != 0) f.monomials.emplace_back(a, std::vector<Factor>{{0, 1}});
    return f;
  }

  // Σ aᵢ λᵢ + a·t, where the sum is x.
  Polynomial sum_of(const std::vector<int>& lambda, int x) {
    Polynomial f = nearby(0);
    for (std::size_t i = 0; i < lambda.size(); ++i) {
      const bool last = i + 1 == lambda.size();  // whose λ is 1
      const int a = last ? x : number(-1, 1);
      x -= a * lambda[i];
      if (a != 0) f.monomials.emplace_back(a, std::vector<Factor>{{static_cast<int>(i) + 1, 1}});
    }
    return f;
  }

  Matrix unimodular(std::size_t n) {
    Matrix m(n, std::vector<int>(n, 0));
    for (std::size_t i = 0; i < n; ++i) m[i][i] = 1;
    for (std::size_t step = 0; step < n && n > 1; ++step) {
      const auto i = static_cast<std::size_t>(number(0, static_cast<int>(n) - 1)),
                 j = static_cast<std::size_t>(number(0, static_cast<int>(n) - 1));
      const int factor = number(-1, 1);
      for (std::size_t k = 0; k < n && i != j; ++k) m[i][k] += factor * m[j][k];
    }
    return m;
  }

  std::mt19937 random_;
};

/// In x alone: λ = (1, x), since Φ_z = (x, −1)ᵀ, and the only number of the form is x − 1/2; n = 1.
inline System system_with_multipliers_to_find() {
  System system;
  system.variables.emplace_back("x", VariableKind::length, -9, 9);
  const auto sum = [](const std::vector<std::pair<const char*, int>>& terms) {
    Polynomial f;
    for (const auto& [coefficient, variable] : terms)
      f.monomials.emplace_back(ExactNumber::rational(coefficient), std::vector<Factor>{{variable, 1}});
    return f;
  };
  Polynomial minus_one;
  minus_one.monomials.emplace_back(-1, std::vector<Factor>{});
  PassageForm& form = system.passage.emplace();
  form.equations = 2, form.columns = 1;
  form.jacobian = {sum({{"1", 0}}), minus_one};
  form.hessian.resize(1);
  form.slack = {sum({{"-1/2", 1}, {"1", 2}})};
  form.normal = {sum({{"1", 1}})};
  return system;
}

}  // namespace corank::test
