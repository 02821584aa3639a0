#include "corank/check/form.h"

namespace corank::check {
namespace {

Enclosure linear_part(const Form& f, const Sides& offsets) {
  Enclosure sum;
  for (std::size_t j = 0; j < offsets.size(); ++j) sum.add_product(f.slopes[j], offsets[j]);
  return sum;
}

}  // namespace

Enclosure Form::range(const Sides& offsets) const { return constant + linear_part(*this, offsets); }

void Form::add_multiple(const Enclosure& factor, const Form& f) {
  constant.add_product(factor, f.constant);
  for (std::size_t j = 0; j < slopes.size(); ++j) slopes[j].add_product(factor, f.slopes[j]);
}

Form product(const Form& f, const Form& g, const Sides& offsets) {
  Form result{f.constant * g.constant + linear_part(f, offsets) * linear_part(g, offsets), {}};
  for (std::size_t j = 0; j < offsets.size(); ++j)
    result.slopes.push_back(f.constant * g.slopes[j] + g.constant * f.slopes[j]);
  return result;
}

}  // namespace corank::check
