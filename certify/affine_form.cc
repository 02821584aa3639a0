#include "corank/certify/affine_form.h"

namespace corank::certify {

Interval AffineForm::range(std::span<const Interval> offsets) const {
  Interval sum = constant;
  for (std::size_t j = 0; j < slopes.size(); ++j) sum += slopes[j] * offsets[j];
  return sum;
}

void AffineForm::add(const Interval& factor, const AffineForm& f) {
  constant += factor * f.constant;
  for (std::size_t j = 0; j < slopes.size(); ++j) slopes[j] += factor * f.slopes[j];
}

AffineForm product(const AffineForm& f, const AffineForm& g, std::span<const Interval> offsets) {
  AffineForm result{f.constant * g.constant, f.slopes};
  Interval left, right;
  for (std::size_t j = 0; j < f.slopes.size(); ++j) {
    result.slopes[j] = f.constant * g.slopes[j] + g.constant * f.slopes[j];
    left += f.slopes[j] * offsets[j];
    right += g.slopes[j] * offsets[j];
  }
  result.constant += left * right;
  return result;
}

}  // namespace corank::certify
