// The values and derivatives of a system's equations in numbers of any type. Inside certify/, and where solve/ looks for
// zeros in many digits.
#pragma once

#include <vector>

#include "corank/certify/multiprecision.h"
#include "corank/core/system.h"

namespace corank::certify {

/// The equations with coefficients of type T.
template <class T>
class Equations {  // refers to the system
 public:
  template <class Convert>
  Equations(const System& system, Convert convert) : system_(system) {
    for (const Polynomial& f : system.equations) {
      coefficients_.emplace_back();
      for (const Monomial& m : f.monomials) coefficients_.back().push_back(convert(m.coefficient));
    }
  }
  int rows() const { return static_cast<int>(coefficients_.size()); }

  T value(int row, const std::vector<T>& x) const {
    T sum(0);
    const auto& monomials = system_.equations[row].monomials;
    for (std::size_t k = 0; k < monomials.size(); ++k) {
      T product = coefficients_[row][k];
      for (const Factor& f : monomials[k].factors) product *= factor(f, x, f.power);
      sum += product;
    }
    return sum;
  }

  std::vector<T> gradient(int row, const std::vector<T>& x) const {
    std::vector<T> gradient(x.size(), T(0));
    const auto& monomials = system_.equations[row].monomials;
    for (std::size_t k = 0; k < monomials.size(); ++k)
      for (const Factor& by : monomials[k].factors) {
        T product = coefficients_[row][k];
        for (const Factor& f : monomials[k].factors)
          if (f.variable != by.variable) product *= factor(f, x, f.power);
        const T& at = x[by.variable];
        switch (by.function) {
          case Function::identity: product *= T(by.power) * factor(by, x, by.power - 1); break;
          case Function::sine: product *= cos(at); break;
          case Function::cosine: product *= -sin(at); break;
        }
        gradient[by.variable] += product;
      }
    return gradient;
  }

 private:
  static T factor(const Factor& f, const std::vector<T>& x, int power) {
    const T& at = x[f.variable];
    if (f.function == Function::sine) return sin(at);
    if (f.function == Function::cosine) return cos(at);
    T result(1);
    for (int k = 0; k < power; ++k) result *= at;
    return result;
  }

  const System& system_;
  std::vector<std::vector<T>> coefficients_;
};

/// With coefficients to so many bits.
Equations<Real> real_equations(const System& system, int bits);
Real to_real(const ExactNumber& x);  ///< of a rational number
ExactNumber to_exact(const Real& x);

}  // namespace corank::certify
