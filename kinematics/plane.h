// Turns and points of a plane as complex numbers, with angles that are coordinates.
#pragma once

#include <iterator>
#include <map>

#include "corank/kinematics/algebra.h"

namespace corank::kinematics {

/// x + iy in constants.
struct Complex {
  ex re = 1, im = 0;
};
inline Complex operator*(const Complex& a, const Complex& b) {
  return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}
inline Complex conjugate(const Complex& a) { return {a.re, -a.im}; }

/// k e^{iα}, α a sum of angles.
struct Turn {
  Complex k;
  ex angle = 0;
  ex cosine() const { return k.re * GiNaC::cos(angle) - k.im * GiNaC::sin(angle); }
  ex sine() const { return k.re * GiNaC::sin(angle) + k.im * GiNaC::cos(angle); }
};
inline Turn operator*(const Turn& a, const Turn& b) { return {a.k * b.k, a.angle + b.angle}; }
inline Turn inverse(const Turn& a) { return {conjugate(a.k), -a.angle}; }  // |k| = 1

/// A point of the plane: a sum of k e^{iα}, with its height over the plane. k may hold lengths.
struct PlanePoint {
  std::map<ex, Complex, GiNaC::ex_is_less> terms;
  ex height = 0;

  void add(const Turn& turn, const Complex& k) {
    const Complex sum = turn.k * k;
    const auto [at, is_new] = terms.emplace(turn.angle, sum);
    if (!is_new) at->second = {at->second.re + sum.re, at->second.im + sum.im};
  }
  ex x() const {
    ex sum = 0;
    for (const auto& [angle, k] : terms) sum += Turn{k, angle}.cosine();
    return sum;
  }
  ex y() const {
    ex sum = 0;
    for (const auto& [angle, k] : terms) sum += Turn{k, angle}.sine();
    return sum;
  }
  /// x² + y² + height², squares of a cosine and its sine put together.
  ex squared() const {
    ex sum = height * height;
    for (auto a = terms.begin(); a != terms.end(); ++a) {
      sum += a->second.re * a->second.re + a->second.im * a->second.im;
      for (auto b = std::next(a); b != terms.end(); ++b) {
        const Complex product = a->second * conjugate(b->second);
        sum += 2 * (product.re * GiNaC::cos(a->first - b->first) - product.im * GiNaC::sin(a->first - b->first));
      }
    }
    return sum;
  }
};
inline PlanePoint plus(PlanePoint a, const PlanePoint& b, int sign = 1) {
  for (const auto& [angle, k] : b.terms) a.add({{1, 0}, angle}, {sign * k.re, sign * k.im});
  a.height += sign * b.height;
  return a;
}

}  // namespace corank::kinematics
