// What is true although it is hard to tell: solutions close to one another, numbers of a large degree. What is false stays
// so.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "corank/check/exact.h"
#include "corank/tests/check/covers.h"

namespace corank::check {
namespace {

using testing::HasSubstr;

// Two solutions 5e-7 from each other, about a point that is nearly a double one, as a solver found them.
constexpr const char* kCloseSolutions = R"([SYSTEM VARS]
th0 ~ [-pi, pi]
th1 ~ [-pi, pi]
[SYSTEM EQS]
(568459999999963159999999998978850000000024000/206266666666651066666666666151000000000013)*cos(th0) +
(191359999999993526000000000041599999999996685/190399999999985599999999999524000000000012)*sin(2*th1) + (-2000)*sin(th1)
+ 750*sin(2*th0 + th1)*sin(- th0 + acos(3/5)) + (-750) = 0;
(21163040000000178335999999777194399999995160160000000132269000000002197/324479999999986479999999999999999999999966199999999997972)*cos(th0)*sin(th1) + (-10581520000000063487999999889667199999997580080000000068809500000001259/162239999999993239999999999999999999999983099999999998986)*sin(th1) + (-2)*cos(2*th1)*sin(- th1) + (-0.75)*sin(th0)*sin(- th0 - th1) + (-1/2)*cos(2*th0 + atan(3/4))*cos(th1) + 2*sin(- th0)*sin(th0) + 1 = 0;
)";

Cover close_solutions() {
  Cover cover;
  cover.sigma = {1e-6, 1e-6};
  cover.regions = {{{0.9999999999999691, 0.9999999999999734},
                    {-2.440484738759228e-07, -2.3534347959848297e-07},
                    {-0.6990029638741264, -0.6990029561286941},
                    {0.7151187709011608, 0.7151187784720429}},
                   {{0.9999999999999689, 0.9999999999999731},
                    {2.3628496136504443e-07, 2.4495614958938575e-07},
                    {-0.6990033912290299, -0.6990033835136892},
                    {0.7151183531768124, 0.7151183607182898}}};
  cover.boxes = {{{{0.9999999999999697, 0.9999999999999724},
                   {2.369404137948286e-07, 2.443001932764729e-07},
                   {-0.6990033906453819, -0.6990033840968902},
                   {0.7151183537473079, 0.7151183601482313}},
                  Verdict::isolated,
                  {},
                  1},
                 {{{0.9999999999999699, 0.9999999999999726},
                   {-2.4338997447511965e-07, -2.3600142979455702e-07},
                   {-0.6990029632887022, -0.6990029567145616},
                   {0.7151187714733918, 0.7151187778993783}},
                  Verdict::isolated,
                  {},
                  0}};
  cover.points = cover.boxes;
  return cover;
}

TEST(CloseSolutions, AreVerified) {
  const System system = plain(kCloseSolutions);
  const Report report = check(system, close_solutions());
  EXPECT_EQ(tally(report, Verdict::isolated), (Tally{2, 0, 0})) << text(report);
}

TEST(CloseSolutions, AreNotVerifiedWhereTheyAreNot) {
  const System system = plain(kCloseSolutions);
  Cover moved = close_solutions();
  // Between the two there is none.
  for (auto* box : {&moved.boxes[0].box, &moved.points[0].box, &moved.regions[1]})
    for (Interval& side : *box)
      if (side.hi() < 1e-6 && side.lo() > 0) side = {side.lo() - 1.2e-7, side.hi() - 1.2e-7};
  EXPECT_EQ(tally(check(system, moved), Verdict::isolated), (Tally{1, 1, 0}));
}

// The fault of the number that the polynomial defines in the interval.
std::string fault(const RationalPolynomial& p, const char* lower, const char* upper) {
  static const System system = plain("[SYSTEM VARS]\nx : [-2, 2]\n[SYSTEM EQS]\nx^2 = 0;\n");
  const ExactPoint point{p, number(lower), number(upper), {{0}}, -1, 0};
  return ExactCheck(system, point).fault();
}

RationalPolynomial times(const RationalPolynomial& f, const RationalPolynomial& g) {
  RationalPolynomial result(f.size() + g.size() - 1);
  for (std::size_t i = 0; i < f.size(); ++i)
    for (std::size_t k = 0; k < g.size(); ++k) result[i + k] = result[i + k] + f[i] * g[k];
  return result;
}

TEST(ExactNumberOfAPoint, MayHaveAPolynomialOfALargeDegree) {
  RationalPolynomial p(3001, 1);  // x + x² + … = 1: x is nearly 1/2
  p[0] = -1;
  EXPECT_EQ(fault(p, "0", "1"), "");
  EXPECT_THAT(fault(p, "3/4", "1"), HasSubstr("opposite signs"));
}

TEST(ExactNumberOfAPoint, IsTheOnlyRootInItsInterval) {
  const RationalPolynomial quarter{number("-1/4"), 1}, half{number("-1/2"), 1}, quarters{number("-3/4"), 1},
      no_root{1, 0, 1};  // x² + 1
  const RationalPolynomial three = times(times(quarter, half), times(quarters, no_root));
  EXPECT_THAT(fault(three, "0", "1"), HasSubstr("not have exactly one root"));
  EXPECT_EQ(fault(three, "3/8", "5/8"), "");
  EXPECT_EQ(fault(times(half, times(half, half)), "0", "1"), "") << "once, though its slope is 0 there";
  EXPECT_THAT(fault(times(quarter, times(half, half)), "3/8", "1"), HasSubstr("opposite signs"));
  RationalPolynomial large(300, 0);  // three, and a factor without a root between 0 and 1
  large[0] = 2, large[299] = -1;
  EXPECT_THAT(fault(times(three, large), "0", "1"), HasSubstr("of a large degree"));
  EXPECT_EQ(fault(times(three, large), "3/8", "5/8"), "");
}

}  // namespace
}  // namespace corank::check
