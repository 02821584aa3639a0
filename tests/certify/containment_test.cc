// Interval operations and matrices on hard inputs, against Arb: whatever numbers the operands hold, the result holds the
// number that comes of them. RC_PARAMS=max_success=100000 ./certify_test --gtest_filter='*Contain*' looks further.
#include "corank/certify/slope_matrix.h"
#include "corank/core/interval.h"
#include "corank/tests/certify/adversary.h"
#include "corank/tests/system_builder.h"

namespace corank::certify {
namespace {

using namespace adversary;

RC_GTEST_PROP(IntervalContainment, OfSumsDifferencesAndProducts, ()) {
  const Interval x = any_interval(), y = any_interval();
  const double a = member(x), b = member(y);
  RC_LOG() << shown(x) << ' ' << shown(y) << ' ' << a << ' ' << b << '\n';
  RC_ASSERT((Ball(a) + b).in(upward([&] { return x + y; })));
  RC_ASSERT((Ball(a) - b).in(upward([&] { return x - y; })));
  RC_ASSERT((Ball(a) * b).in(upward([&] { return x * y; })));
  RC_ASSERT((Ball(a) * b).in(upward([&] { return scale(a, y); })));
  RC_ASSERT(Ball(-a).in(-x));
  Interval sum = x, difference = x, product = x;
  upward([&] { return sum += sum, difference -= difference, product *= product, 0; });  // aliased
  const double c = member(x);
  RC_ASSERT((Ball(a) + c).in(sum));
  RC_ASSERT((Ball(a) - c).in(difference));
  RC_ASSERT((Ball(a) * c).in(product));
}

RC_GTEST_PROP(IntervalContainment, OfSquaresAndPowers, ()) {
  const Interval x = any_interval();
  const double a = member(x);
  const int p = *rc::gen::weightedOneOf<int>({{3, rc::gen::inRange(0, 12)}, {1, rc::gen::inRange(12, 150)}});
  RC_LOG() << shown(x) << " ^ " << p << ", " << a << '\n';
  RC_ASSERT((Ball(a) * a).in(upward([&] { return square(x); })));
  RC_ASSERT(pow(Ball(a), p).in(upward([&] { return power(x, p); })));
}

RC_GTEST_PROP(IntervalContainment, OfSquareRootsAndRoots, ()) {
  const Interval x = any_interval(), within = any_interval();
  const double a = member(x);
  const int p = *rc::gen::inRange(1, 9);
  Ball root;
  arb_root_ui(root.get(), Ball(std::fabs(a)).get(), static_cast<ulong>(p), kBits);
  if (a >= 0) {
    const auto kept = upward([&] { return square_root(x); });
    RC_LOG() << "sqrt " << shown(x) << " = " << shown(kept) << " at " << a << '\n';
    RC_ASSERT(kept && Ball::unary(arb_sqrt, a).in(*kept));
  }
  const auto kept = upward([&] { return corank::root(x, p, within); });
  RC_LOG() << "root " << p << " of " << shown(x) << " within " << shown(within) << " = " << shown(kept) << " at " << a
           << '\n';
  RC_ASSERT(!kept || within.contains(*kept));
  const bool even = p % 2 == 0;
  if (a >= 0 && root.certainly_in(within)) RC_ASSERT(kept && root.in(*kept));
  root = Ball(0.0) - root;
  if ((even ? a >= 0 : a <= 0) && root.certainly_in(within)) RC_ASSERT(kept && root.in(*kept));
}

RC_GTEST_PROP(IntervalContainment, OfQuotients, ()) {
  const Interval num = any_interval(), den = any_interval(), within = any_interval();
  const double n = member(num), d = member(den), x = member(within);
  const auto kept = upward([&] { return divide(num, den, within); });
  RC_LOG() << shown(num) << " / " << shown(den) << " within " << shown(within) << " = " << shown(kept) << " at " << n
           << " / " << d << '\n';
  RC_ASSERT(!kept || within.contains(*kept));
  if (d != 0) {
    const Ball quotient = Ball(n) / d;
    if (quotient.certainly_in(within)) RC_ASSERT(kept && quotient.in(*kept));
  }
  if ((Ball(d) * x).certainly_in(num)) RC_ASSERT(kept && kept->contains(x));  // 0·x = 0 among them
}

RC_GTEST_PROP(IntervalContainment, OfHullsAndIntersections, ()) {
  const Interval x = any_interval(), y = any_interval();
  const double a = member(x), b = member(y);
  const Interval hull = Interval::hull(x, y);
  RC_ASSERT(hull.contains(a) && hull.contains(b) && hull.contains(x) && hull.contains(y));
  Interval meet = x;
  const bool met = meet.intersect(y);
  RC_ASSERT(met == x.overlaps(y));
  for (const double c : {a, b}) RC_ASSERT((met && meet.contains(c)) == (x.contains(c) && y.contains(c)));
  if (!met) RC_ASSERT(meet == x);
}

RC_GTEST_PROP(IntervalContainment, OfWidthMiddleAndMagnitudes, ()) {
  const Interval x = any_interval();
  const double a = member(x), b = member(x);
  RC_LOG() << shown(x) << ' ' << a << ' ' << b << '\n';
  const double width = upward([&] { return x.width(); });
  RC_ASSERT((Ball(a) - b).in({-width, width}));
  RC_ASSERT(x.mig() <= std::fabs(a) && std::fabs(a) <= x.mag());
  RC_ASSERT(x.contains(x.mag()) || x.contains(-x.mag()) || std::isinf(x.mag()));
  RC_ASSERT(x.contains(x.mig()) || x.contains(-x.mig()));
  if (x.is_bounded()) RC_ASSERT(upward([&] { return std::isfinite(x.mid()) && x.contains(x.mid()); }));
}

// A dense r×n matrix Y·S, with a member of each entry of S.
struct Dense {
  int r = *rc::gen::inRange(1, 6), n = r + *rc::gen::inRange(0, 3);
  std::vector<double> y, member_of_s;
  std::vector<Interval> s;
  std::vector<int> equations;
  CompiledSystem system = full_system(r, n);

  Dense() {
    for (int k = 0; k < r * r; ++k) y.push_back(finite_double());
    for (int k = 0; k < r * n; ++k) s.push_back(bounded_interval()), member_of_s.push_back(member(s.back()));
    for (int a = 0; a < r; ++a) equations.push_back(a);
  }
  Ball product(int a, int j) const {
    Ball sum;
    for (int b = 0; b < r; ++b)
      sum = sum + Ball(y[static_cast<std::size_t>(a * r + b)]) * member_of_s[static_cast<std::size_t>(b * n + j)];
    return sum;
  }
  static CompiledSystem full_system(int m, int n) {
    test::SystemBuilder b;
    for (int j = 0; j < n; ++j) b.variable("x" + std::to_string(j), "-1", "1");
    std::vector<test::SystemBuilder::Term> row;
    for (int j = 0; j < n; ++j) row.push_back({"1", {{j, 1}}});
    for (int i = 0; i < m; ++i) b.equation(row);
    return CompiledSystem(b.system());
  }
};

RC_GTEST_PROP(PanelContainment, OfProductsWithMatricesAndVectors, ()) {
  const Dense d;
  SlopeMatrix matrix;
  matrix.set_matrix(d.y, d.r);
  if (upward([&] { return matrix.assign_product(d.system, d.equations, d.s); })) {
    for (int a = 0; a < d.r; ++a)
      for (int j = 0; j < d.n; ++j) RC_ASSERT(d.product(a, j).in(matrix.at(a, j)));
  }
  std::vector<Interval> values, result;
  std::vector<double> members;
  for (int b = 0; b < d.r; ++b) values.push_back(bounded_interval()), members.push_back(member(values.back()));
  upward([&] { return matrix.multiply(values, result), 0; });
  for (int a = 0; a < d.r; ++a) {
    Ball sum;
    for (int b = 0; b < d.r; ++b)
      sum = sum + Ball(d.y[static_cast<std::size_t>(a * d.r + b)]) * members[static_cast<std::size_t>(b)];
    RC_LOG() << shown(result[static_cast<std::size_t>(a)]) << '\n';
    RC_ASSERT(sum.in(result[static_cast<std::size_t>(a)]));
  }
}

RC_GTEST_PROP(PanelContainment, OfSumsWithAnotherDiagonal, ()) {
  const Dense d;
  SlopeMatrix matrix;
  matrix.set_matrix(d.y, d.r);
  RC_PRE(upward([&] { return matrix.assign_product(d.system, d.equations, d.s); }));
  std::vector<Interval> offset, sums;
  std::vector<double> offset_members, sum_members;
  std::vector<int> dependent;
  for (int j = 0; j < d.n; ++j) offset.push_back(any_interval()), offset_members.push_back(member(offset.back()));
  for (int a = 0; a < d.r; ++a) {
    sums.push_back(any_interval()), sum_members.push_back(member(sums.back()));
    dependent.push_back(d.n - 1 - a);
  }
  for (const auto diagonal : {SlopeMatrix::Diagonal::zero, SlopeMatrix::Diagonal::minus_one}) {
    std::vector<Interval> result = sums;
    upward([&] { return matrix.accumulate(offset.data(), dependent, diagonal, result), 0; });
    for (int a = 0; a < d.r; ++a) {
      const std::size_t k = static_cast<std::size_t>(a);
      Ball sum(sum_members[k]);
      for (int j = 0; j < d.n; ++j) {
        Ball entry = d.product(a, j);
        if (j == dependent[k]) entry = diagonal == SlopeMatrix::Diagonal::zero ? Ball(0.0) : entry - Ball(1.0);
        sum = sum + entry * offset_members[static_cast<std::size_t>(j)];
      }
      RC_LOG() << shown(result[k]) << '\n';
      RC_ASSERT(sum.in(result[k]));
    }
  }
}

}  // namespace
}  // namespace corank::certify
