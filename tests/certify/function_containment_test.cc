// Sines, cosines, angles, exact numbers and whole systems on hard inputs, against Arb.
#include "corank/certify/angle.h"
#include "corank/certify/compiled_system.h"
#include "corank/certify/trigonometric.h"
#include "corank/tests/certify/adversary.h"

namespace corank::certify {
namespace {

using namespace adversary;

RC_GTEST_PROP(WaveContainment, OfValuesAndSlopes, ()) {
  const Interval x = any_interval();
  const double a = member(x), c = *rc::gen::inRange(0, 2) == 0 ? member(x) : finite_double();
  RC_LOG() << std::hexfloat << shown(x) << ' ' << a << ' ' << c << '\n';
  RC_ASSERT(sin(Ball(a)).in(upward([&] { return sine(x); })));
  RC_ASSERT(cos(Ball(a)).in(upward([&] { return cosine(x); })));
  const Interval s = upward([&] { return sine_slope(x, c); }), t = upward([&] { return cosine_slope(x, c); });
  RC_LOG() << shown(s) << ' ' << shown(t) << '\n';
  if (a == c) {
    RC_ASSERT(cos(Ball(a)).in(s));
    RC_ASSERT((Ball(0.0) - sin(Ball(a))).in(t));
  } else {
    RC_ASSERT(((sin(Ball(a)) - sin(Ball(c))) / (Ball(a) - c)).in(s));
    RC_ASSERT(((cos(Ball(a)) - cos(Ball(c))) / (Ball(a) - c)).in(t));
  }
}

RC_GTEST_PROP(WaveContainment, OfInverseImages, ()) {
  const Interval within = any_interval();
  const double a = member(within), slack = std::fabs(finite_double()) * *rc::gen::element(0.0, 1.0, 1e-300);
  for (const bool is_sine : {true, false}) {
    const Ball value = is_sine ? sin(Ball(a)) : cos(Ball(a));
    const double middle = arf_get_d(arb_midref(value.get()), ARF_RND_NEAR);
    const Interval y(std::nextafter(middle, -2.0) - slack, std::nextafter(middle, 2.0) + slack);
    RC_PRE(value.certainly_in(y));
    const auto kept = upward([&] { return is_sine ? inverse_sine(y, within) : inverse_cosine(y, within); });
    RC_LOG() << std::hexfloat << a << " in " << shown(within) << ", " << shown(y) << '\n';
    RC_ASSERT(kept && kept->contains(a) && within.contains(*kept));
  }
}

RC_GTEST_PROP(AngleContainment, OfEveryPointOfABox, ()) {
  const Interval c = any_interval(), s = any_interval(), range = any_interval();
  const Interval angles = angle_enclosure(c, s, range);
  bool common[9] = {true, true, true, true, true, true, true, true, true};
  const double k0 = range.is_bounded() ? std::round(angles.mid() / (2 * std::numbers::pi)) : 0;
  RC_PRE(std::fabs(k0) < 1e15);
  const bool across = c.hi() < 0 && s.lo() < 0 && s.hi() > 0;
  const bool touches = c.hi() < 0 && s.lo() < 0 && s.hi() == 0;
  RC_LOG() << shown(c) << ' ' << shown(s) << " -> " << shown(angles) << '\n';
  Ball turn;
  arb_const_pi(turn.get(), kBits);
  turn = turn * 2.0;
  for (int trial = 0; trial < 4; ++trial) {
    const double a = member(c), b = member(s);
    if (a == 0 && b == 0) continue;
    Ball angle = Ball::binary(arb_atan2, b, a, kBits);
    if (across && b < 0) angle = angle + turn;  // the angle is continuous over the box
    if (touches && b == 0) angle = angle - turn;
    for (int k = -4; k <= 4; ++k) common[k + 4] = common[k + 4] && (angle + turn * (k0 + k)).in(angles);
  }
  RC_ASSERT(std::any_of(std::begin(common), std::end(common), [](bool holds) { return holds; }));
}

// A double as an exact number.
ExactNumber exact(double x) {
  int exponent = 0;
  const double mantissa = std::ldexp(std::frexp(x, &exponent), 53);
  return ExactNumber(static_cast<long>(mantissa)) * pow(ExactNumber(2), exponent - 53);
}

struct Constant {
  ExactNumber number;
  Ball value;
};

// f of a double or of the sum, product or quotient of two such; nothing where that is no real number as far as Arb can tell.
std::optional<Constant> function_of_a_constant(const Constant& x) {
  using F = ConstantFunction;
  const F f = *rc::gen::element(F::sqrt, F::sin, F::cos, F::tan, F::asin, F::acos, F::atan, F::exp, F::log, F::abs);
  const auto arb = [f] {
    switch (f) {
      case F::sqrt: return arb_sqrt;
      case F::sin: return arb_sin;
      case F::cos: return arb_cos;
      case F::tan: return arb_tan;
      case F::asin: return arb_asin;
      case F::acos: return arb_acos;
      case F::atan: return arb_atan;
      case F::exp: return arb_exp;
      default: return arb_log;
    }
  }();
  Ball value;
  if (f == F::abs)
    arb_abs(value.get(), x.value.get());
  else
    arb(value.get(), x.value.get(), kBits);
  if (!arb_is_finite(value.get())) return std::nullopt;
  return Constant{ExactNumber::apply(f, x.number), value};
}

RC_GTEST_PROP(ExactNumberContainment, OfFunctionsOfDoubles, ()) {
  const auto number = [] {
    const double x = finite_double();
    return Constant{exact(x), x};
  };
  const Constant x = number(), y = number();
  RC_ASSERT(x.value.in(x.number.enclose()));
  const auto f = function_of_a_constant(x);
  RC_PRE(f);
  const Constant sum{f->number + y.number, f->value + y.value}, product{f->number * y.number, f->value * y.value};
  for (const Constant& c : {*f, sum, product}) {
    Interval enclosure;
    try {
      enclosure = c.number.enclose();
    } catch (const std::domain_error&) {  // the argument of a sine is too large, or its tangent too near a pole
      continue;
    }
    RC_LOG() << c.number.text() << " in " << shown(enclosure) << '\n';
    RC_ASSERT(c.value.in(enclosure));
  }
}

RC_GTEST_PROP(WaveContainment, OfTheAngleOfANumber, ()) {
  const double h =
      std::clamp(*rc::gen::inRange(0, 4) == 0 ? finite_double() : *rc::gen::inRange(-1000000, 1000001) * 1e-6, -1.0, 1.0);
  const Ball cosine = Ball::unary(arb_acos, h, 200), sine = Ball::unary(arb_asin, h, 200);
  const auto by_cosine = upward([&] { return inverse_cosine(h, {0, 3.5}); });
  const auto by_sine = upward([&] { return inverse_sine(h, {-1.6, 1.6}); });
  RC_LOG() << h << ": " << shown(by_cosine) << ' ' << shown(by_sine) << '\n';
  RC_ASSERT(by_cosine && cosine.in(*by_cosine));
  RC_ASSERT(by_sine && sine.in(*by_sine));
}

// What the C library gives for the arccosine of these numbers, rounding upward, is below it.
TEST(WaveContainment, OfAnglesThatTheLibraryRoundsInTheWrongDirection) {
  for (const double h : {0x1.f0065ba0fa143p-1, 0x1.ff8dda23df321p-1, 0x1.556673d4bbed6p-1, 0x1.eeb02caedd142p-1,
                         0x1.ff75c9b57d45bp-1, 0x1.e020fb22c0554p-1, 0x1.4b766306761fp-1, 0x1.0b6ad948cd95cp-1}) {
    const auto angle = upward([&] { return inverse_cosine(h, {0, 3.5}); });
    EXPECT_TRUE(angle && Ball::unary(arb_acos, h, 200).in(*angle)) << shown(angle);
  }
}

// A random system with every shape of term, its coefficients doubles.
struct RandomSystem {
  System system;

  RandomSystem() {
    const int n = *rc::gen::inRange(1, 4);
    for (int j = 0; j < n; ++j) system.variables.emplace_back("x" + std::to_string(j), VariableKind::length, -1, 1);
    for (int i = 0; i < 2; ++i) {
      system.equations.emplace_back();
      const int terms = *rc::gen::inRange(1, 5);
      auto& monomials = system.equations.back().monomials;
      for (int k = 0; k < terms; ++k) {
        const Monomial next(exact(finite_double()), factors(n));
        const auto same = [&](const Monomial& m) { return m.factors == next.factors; };
        if (std::none_of(monomials.begin(), monomials.end(), same)) monomials.push_back(next);
      }
    }
  }
  static std::vector<Factor> factors(int n) {
    const int first = *rc::gen::inRange(0, n), kind = *rc::gen::inRange(0, 6);
    if (kind == 0) return {};
    if (kind == 1) return {{first, 1, Function::sine}};
    if (kind == 2) return {{first, 1, Function::cosine}};
    std::vector<Factor> result;
    for (int j = first; j < n; ++j)
      if (j == first || *rc::gen::inRange(0, 2) == 0) result.push_back({j, *rc::gen::inRange(1, kind == 3 ? 2 : 5)});
    return result;
  }
  Ball value(int row, const std::vector<double>& x) const {
    Ball sum;
    for (const Monomial& m : system.equations[static_cast<std::size_t>(row)].monomials) sum = sum + term(m, x, -1);
    return sum;
  }
  Ball derivative(int row, int j, const std::vector<double>& x) const {
    Ball sum;
    for (const Monomial& m : system.equations[static_cast<std::size_t>(row)].monomials) sum = sum + term(m, x, j);
    return sum;
  }
  // The term, or its derivative with respect to variable j.
  static Ball term(const Monomial& m, const std::vector<double>& x, int j) {
    Ball product = m.enclosure.lo();
    bool depends = j < 0;
    for (const Factor& f : m.factors) {
      const double y = x[static_cast<std::size_t>(f.variable)];
      const bool differentiated = f.variable == j;
      depends = depends || differentiated;
      if (f.function == Function::sine)
        product = product * (differentiated ? cos(Ball(y)) : sin(Ball(y)));
      else if (f.function == Function::cosine)
        product = product * (differentiated ? Ball(0.0) - sin(Ball(y)) : cos(Ball(y)));
      else
        product = product * (differentiated ? pow(Ball(y), f.power - 1) * f.power : pow(Ball(y), f.power));
    }
    return depends ? product : Ball(0.0);
  }
};

RC_GTEST_PROP(SystemContainment, OfValuesSlopesAndDerivatives, ()) {
  const RandomSystem random;
  const CompiledSystem system(random.system);
  const int n = system.variables();
  std::vector<Interval> x;
  std::vector<double> a, c;
  for (int j = 0; j < n; ++j) {
    x.push_back(bounded_interval());
    a.push_back(member(x.back()));
    c.push_back(*rc::gen::inRange(0, 2) == 0 ? member(x.back()) : finite_double());
  }
  std::vector<Interval> slopes(static_cast<std::size_t>(system.entries())), jacobian(slopes);
  upward([&] { return system.slopes(x, c.data(), slopes), system.jacobian(x, jacobian), 0; });
  for (int row = 0; row < system.equations(); ++row) {
    RC_ASSERT(random.value(row, a).in(upward([&] { return system.evaluate(row, x); })));
    RC_ASSERT(random.value(row, a).in(upward([&] { return system.evaluate_at(row, a.data()); })));
    // f(a) − f(c) between the sums of the least and of the greatest s_j (a_j − c_j).
    Ball least, greatest;
    bool bounded = true;
    for (int k = system.row_begin(row); k < system.row_begin(row + 1); ++k) {
      const std::size_t j = static_cast<std::size_t>(system.column(k));
      RC_ASSERT(random.derivative(row, system.column(k), a).in(jacobian[static_cast<std::size_t>(k)]));
      const Interval& s = slopes[static_cast<std::size_t>(k)];
      RC_ASSERT(s.lo() <= s.hi());
      bounded = bounded && s.is_bounded();
      const Ball step = Ball(a[j]) - c[j];
      const bool forward = a[j] >= c[j];
      if (bounded)
        least = least + step * (forward ? s.lo() : s.hi()), greatest = greatest + step * (forward ? s.hi() : s.lo());
    }
    if (!bounded) continue;
    const Ball difference = random.value(row, a) - random.value(row, c);
    RC_ASSERT(!arb_lt(difference.get(), least.get()));
    RC_ASSERT(!arb_gt(difference.get(), greatest.get()));
  }
}

}  // namespace
}  // namespace corank::certify
