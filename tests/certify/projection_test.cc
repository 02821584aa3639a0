#include "corank/certify/projection.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "corank/certify/domain.h"
#include "corank/core/rounding.h"
#include "corank/tests/system_builder.h"

namespace corank::certify {
namespace {

using test::SystemBuilder;

bool project_once(const System& system, std::vector<Interval>& x, int row = 0) {
  const UpwardRounding rounding;
  std::vector<std::uint8_t> changed(x.size());
  return project(CompiledSystem(system), row, x, 0.1, changed.data());
}

TEST(Projection, ShrinksACircleToItsArc) {
  SystemBuilder b;
  const int c = b.variable("c", "-1", "1"), s = b.variable("s", "-1", "1");
  b.equation({{"1", {{c, 2}}}, {"1", {{s, 2}}}, {"-1", {}}});
  std::vector<Interval> x{Interval(0.6, 1), Interval(0, 1)};
  ASSERT_TRUE(project_once(b.system(), x));
  EXPECT_EQ(x[c], Interval(0.6, 1));
  EXPECT_GE(x[s].hi(), 0.8);
  EXPECT_LE(x[s].hi(), 0.8 + 1e-15);
}

TEST(Projection, DeletesABoxWithoutSolutions) {
  SystemBuilder b;
  const int c = b.variable("c", "-1", "1"), s = b.variable("s", "-1", "1");
  b.equation({{"1", {{c, 2}}}, {"1", {{s, 2}}}, {"-1", {}}});
  std::vector<Interval> x{Interval(0.8, 1), Interval(0.7, 1)};
  EXPECT_FALSE(project_once(b.system(), x));
}

TEST(Projection, HonoursAnInequality) {
  SystemBuilder b;
  const int u = b.variable("u", "-4", "4"), v = b.variable("v", "-4", "4");
  b.at_least_zero({{"1", {{u, 1}}}, {"-1", {{v, 1}}}});  // u ≥ v
  std::vector<Interval> x{Interval(0, 1), Interval(0.5, 3)};
  ASSERT_TRUE(project_once(b.system(), x));
  EXPECT_EQ(x[u], Interval(0.5, 1));
  EXPECT_EQ(x[v], Interval(0.5, 1));
  std::vector<Interval> none{Interval(0, 1), Interval(2, 3)};
  EXPECT_FALSE(project_once(b.system(), none));
}

TEST(Projection, KeepsWhatHoldsAtAnEndOnly) {
  SystemBuilder equation, inequality;
  for (SystemBuilder* b : {&equation, &inequality}) b->variable("u", "-4", "4"), b->variable("v", "-4", "4");
  equation.equation({{"1", {{0, 1}}}, {"-1", {{1, 1}}}});
  inequality.at_least_zero({{"1", {{0, 1}}}, {"-1", {{1, 1}}}});
  for (const SystemBuilder* b : {&equation, &inequality}) {
    std::vector<Interval> x{Interval(0, 1), Interval(1, 2)};
    ASSERT_TRUE(project_once(b->system(), x));
    EXPECT_EQ(x, (std::vector<Interval>{1.0, 1.0}));
  }
  std::vector<Interval> x{Interval(1, 2), Interval(0, 1)};
  ASSERT_TRUE(project_once(equation.system(), x));
  EXPECT_EQ(x, (std::vector<Interval>{1.0, 1.0}));
}

TEST(Projection, LeavesWhatAnInequalityAllows) {
  SystemBuilder b;
  const int u = b.variable("u", "-4", "4"), v = b.variable("v", "-4", "4");
  b.at_least_zero({{"1", {{u, 1}}}, {"-1", {{v, 1}}}});
  std::vector<Interval> x{Interval(0, 3), Interval(1, 2)};
  ASSERT_TRUE(project_once(b.system(), x));
  EXPECT_EQ(x, (std::vector<Interval>{Interval(1, 3), Interval(1, 2)}));
}

TEST(Projection, KeepsBothRootsOfASquare) {
  SystemBuilder b;
  const int x = b.variable("x", "-4", "4");
  b.equation({{"1", {{x, 2}}}, {"-4", {}}});
  std::vector<Interval> box{Interval(-4, 4)};
  ASSERT_TRUE(project_once(b.system(), box));
  EXPECT_EQ(box[0], Interval(-2, 2));
}

TEST(Projection, ShrinksTheArgumentOfASineToItsBranches) {
  SystemBuilder b;
  const int s = b.variable("s", "-1", "1"), t = b.variable("t", "-40", "40");
  b.equation({{"1", {{s, 1}}}, {"-2", {{t, 1, Function::sine}}}});  // s = 2 sin t
  std::vector<Interval> x{Interval(1, 2), Interval(-1, 10)};
  ASSERT_TRUE(project_once(b.system(), x));
  EXPECT_EQ(x[s], Interval(1, 2));
  EXPECT_NEAR(x[t].lo(), std::numbers::pi / 6, 1e-14);
  EXPECT_NEAR(x[t].hi(), 2 * std::numbers::pi + 5 * std::numbers::pi / 6, 1e-14);
  x = {Interval(-2, 2), Interval(0.1, 0.2)};
  ASSERT_TRUE(project_once(b.system(), x));
  EXPECT_NEAR(x[s].lo(), 2 * std::sin(0.1), 1e-15);
  EXPECT_NEAR(x[s].hi(), 2 * std::sin(0.2), 1e-15);
  x = {Interval(1, 2), Interval(3, 6)};
  EXPECT_FALSE(project_once(b.system(), x)) << "the sine is negative there";
}

TEST(Projection, HonoursAnInequalityOfACosine) {
  SystemBuilder b;
  const int t = b.variable("t", "-40", "40");
  b.at_least_zero({{"1", {{t, 1, Function::cosine}}}, {"-1/2", {}}});  // cos t ≥ 1/2
  std::vector<Interval> x{Interval(2, 8)};
  ASSERT_TRUE(project_once(b.system(), x));
  EXPECT_NEAR(x[t].lo(), 5 * std::numbers::pi / 3, 1e-14);
  EXPECT_NEAR(x[t].hi(), 7 * std::numbers::pi / 3, 1e-14);
}

// a sin t + b cos u + c v² = w with a planted solution, w being the one computed value: enclosed, so that a solution is in
// the box.
TEST(Projection, NeverLosesAPlantedSolutionOfSinesAndCosines) {
  std::mt19937 random(20261122);
  const auto uniform = [&](double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(random); };
  SystemBuilder b;
  for (const char* name : {"t", "u", "v", "w"}) b.variable(name, "-100", "100");
  b.equation({{"3", {{0, 1, Function::sine}}}, {"-2", {{1, 1, Function::cosine}}}, {"1/3", {{2, 2}}}, {"-1", {{3, 1}}}});
  int deleted = 0;
  for (int trial = 0; trial < 20'000; ++trial) {
    const double t = uniform(-30, 30), u = uniform(-30, 30), v = uniform(-2, 2);
    const double w = 3 * std::sin(t) - 2 * std::cos(u) + v * v / 3;  // rounded: the exact one is nearby
    const auto around = [&](double at) {
      const double size = std::ldexp(1.0, static_cast<int>(random() % 12) - 8);
      return Interval(at - uniform(0, size), at + uniform(0, size));
    };
    std::vector<Interval> x{around(t), around(u), around(v), Interval(w - 1e-14, w + 1e-14)};
    std::vector<Interval> elsewhere = x;
    elsewhere[3] = Interval(w + 1, w + 1.1);
    ASSERT_TRUE(project_once(b.system(), x)) << "trial " << trial;
    ASSERT_TRUE(x[0].contains(t) && x[1].contains(u) && x[2].contains(v)) << "trial " << trial;
    deleted += !project_once(b.system(), elsewhere);
  }
  EXPECT_GT(deleted, 5'000) << "the test must see projections that matter";
}

// Random polynomials with a planted root: whatever the box around it, no projection may lose it.
TEST(Projection, NeverLosesAPlantedSolution) {
  std::mt19937 random(20261121);
  const auto integer = [&](int lo, int hi) { return lo + static_cast<int>(random() % static_cast<unsigned>(hi - lo + 1)); };
  for (int trial = 0; trial < 3000; ++trial) {
    SystemBuilder b;
    std::vector<double> root;
    std::vector<ExactNumber> exact_root;
    for (int j = 0; j < 4; ++j) {
      b.variable("x" + std::to_string(j), "-4", "4");
      const int numerator = integer(-64, 64);
      root.push_back(numerator / 16.0);
      exact_root.push_back(ExactNumber(numerator) / ExactNumber(16));
    }
    const bool inequality = trial % 5 == 0;
    std::vector<Monomial> monomials;
    ExactNumber sum;
    for (int t = 0; t < integer(1, 6); ++t) {
      std::vector<Factor> factors;
      ExactNumber value(integer(1, 9) * (integer(0, 1) ? 1 : -1));
      const ExactNumber coefficient = value;
      for (int j = 0; j < 4; ++j)
        if (integer(0, 2) == 0) {
          factors.push_back({j, integer(1, 3)});
          value = value * pow(exact_root[j], factors.back().power);
        }
      if (factors.empty() || std::any_of(monomials.begin(), monomials.end(), [&](auto& m) { return m.factors == factors; }))
        continue;
      monomials.emplace_back(coefficient, factors);
      sum = sum + value;
    }
    if (monomials.empty()) continue;
    monomials.emplace_back(-sum, std::vector<Factor>{});
    System system = b.system();
    (inequality ? system.inequalities : system.equations).push_back({monomials, "planted"});

    std::vector<Interval> x;
    for (double r : root)
      x.emplace_back(std::max(-4.0, r - integer(0, 40) / 10.0), std::min(4.0, r + integer(0, 40) / 10.0));
    ASSERT_TRUE(project_once(system, x)) << "trial " << trial;
    for (int j = 0; j < 4; ++j) ASSERT_TRUE(x[j].contains(root[j])) << "trial " << trial << " variable " << j;
  }
}

TEST(System, RefusesASineOfAPowerOrInAProduct) {
  for (const std::vector<Factor>& factors : {std::vector<Factor>{{0, 2, Function::sine}},
                                             {{0, 1, Function::sine}, {1, 1}},
                                             {{0, 1}, {1, 1, Function::cosine}},
                                             {{0, 1, Function::sine}, {0, 1, Function::cosine}}}) {
    SystemBuilder b;
    b.variable("x", "-1", "1"), b.variable("y", "-1", "1");
    b.equation({{"1", {{0, 1}}}, {"1", factors}});
    EXPECT_THROW(b.system().validate(), std::invalid_argument);
  }
  SystemBuilder b;  // x, sin x and cos x are three monomials
  b.variable("x", "-1", "1");
  b.equation({{"1", {{0, 1}}}, {"1", {{0, 1, Function::sine}}}, {"1", {{0, 1, Function::cosine}}}});
  EXPECT_NO_THROW(b.system().validate());
}

TEST(Domain, IsImpliedByACircleOrANorm) {
  SystemBuilder b;
  const int c = b.variable("c", "-1", "1"), s = b.variable("s", "-1/2", "1"), y = b.variable("y", "-0.8", "0.8"),
            z = b.variable("z", "-1", "1");
  b.equation({{"1", {{c, 2}}}, {"1", {{s, 2}}}, {"-1", {}}});
  b.equation({{"1", {{y, 2}}}, {"1", {{c, 2}}}, {"-0.64", {}}});
  b.equation({{"1", {{z, 2}}}, {"-1", {{c, 2}}}, {"-1", {}}});
  const auto implied = implied_domains(b.system());
  EXPECT_TRUE(implied[c].both());
  EXPECT_FALSE(implied[s].lower) << "−1/2 cuts the circle";
  EXPECT_TRUE(implied[s].upper);
  EXPECT_TRUE(implied[y].both()) << "0.8² = 0.64 exactly";
  EXPECT_FALSE(implied[z].both()) << "not a sum of squares";
}

TEST(Domain, IsImpliedByASineOrCosine) {
  SystemBuilder b;
  const int t = b.variable("t", "0", "9"), c = b.variable("c", "-1", "1"), q = b.variable("q", "-1/2", "1/2"),
            r = b.variable("r", "-1/2", "0.49"), z = b.variable("z", "-3", "3"), y = b.variable("y", "-9", "9"),
            u = b.variable("u", "-0.49", "1/2");
  b.equation({{"1", {{c, 1}}}, {"-1", {{t, 1, Function::cosine}}}});
  b.equation({{"-2", {{q, 1}}}, {"1", {{t, 1, Function::sine}}}});
  b.equation({{"-2", {{r, 1}}}, {"1", {{t, 1, Function::sine}}}});
  b.equation({{"-2", {{u, 1}}}, {"1", {{t, 1, Function::sine}}}});
  b.equation({{"-1", {{z, 1}}}, {"3/2", {{t, 1, Function::cosine}}}, {"1", {{t, 1, Function::sine}}}, {"-1/2", {}}});
  b.equation({{"1", {{y, 1}}}, {"1", {{t, 1, Function::cosine}}}, {"1", {{t, 1}}}});
  b.equation({{"1", {{t, 1, Function::cosine}}}, {"1", {{t, 1, Function::sine}}}, {"-1", {}}});
  const auto implied = implied_domains(b.system());
  EXPECT_TRUE(implied[c].both());
  EXPECT_TRUE(implied[q].both()) << "2q = sin t";
  EXPECT_FALSE(implied[r].both()) << "0.49 cuts it off";
  EXPECT_FALSE(implied[u].both()) << "−0.49 cuts it off";
  EXPECT_TRUE(implied[z].both()) << "3/2 + 1 + 1/2 = 3";
  EXPECT_FALSE(implied[y].lower || implied[y].upper) << "t is not bounded by its equations";
  EXPECT_FALSE(implied[t].lower || implied[t].upper);
}

TEST(Domain, IsImpliedByASumOfWhatIsImplied) {
  SystemBuilder b;
  const int c = b.variable("c", "-1", "1"), s = b.variable("s", "-1", "1"), d = b.variable("d", "-1", "1"),
            e = b.variable("e", "-1", "1"), x = b.variable("x", "-18/10", "18/10"), y = b.variable("y", "-18/10", "17/10"),
            z = b.variable("z", "-28/10", "28/10"), w = b.variable("w", "-5", "5"), o = b.variable("o", "-5", "5");
  b.equation({{"1", {{c, 2}}}, {"1", {{s, 2}}}, {"-1", {}}}).equation({{"1", {{d, 2}}}, {"1", {{e, 2}}}, {"-1", {}}});
  b.equation({{"-1", {{z, 1}}}, {"1", {{x, 1}}}, {"1", {}}});  // before the bounds of x are known
  b.equation({{"1", {{x, 1}}}, {"-7/10", {{c, 1}}}, {"-11/10", {{d, 1}}}});
  b.equation({{"2", {{y, 1}}}, {"-14/10", {{s, 1}}}, {"22/10", {{e, 1}}}});
  b.equation({{"1", {{w, 1}}}, {"1", {{o, 1}}}, {"1", {{c, 1}}}});
  const auto implied = implied_domains(b.system());
  EXPECT_TRUE(implied[x].both());
  EXPECT_TRUE(implied[y].lower);
  EXPECT_FALSE(implied[y].upper) << "1.7 cuts off what 1.8 would not";
  EXPECT_TRUE(implied[z].both()) << "[-0.8, 2.8]";
  EXPECT_FALSE(implied[w].lower || implied[w].upper || implied[o].lower || implied[o].upper) << "w + o = -c";
}

TEST(Domain, IsImpliedByTheOtherArmOfAClosedChain) {
  SystemBuilder b;  // x = 1.18 + 0.9 (c2 + c3), and the chain closes: x = 0.9 (c5 − c4)
  const int x = b.variable("x", "-1.8", "1.8");
  std::array<int, 4> c{};
  for (int i = 0; i < 4; ++i) {
    c[i] = b.variable("c" + std::to_string(i + 2), "-1", "1");
    const int s = b.variable("s" + std::to_string(i + 2), "-1", "1");
    b.equation({{"1", {{c[i], 2}}}, {"1", {{s, 2}}}, {"-1", {}}});
  }
  b.equation({{"1.18", {}}, {"0.9", {{c[0], 1}}}, {"0.9", {{c[1], 1}}}, {"0.9", {{c[2], 1}}}, {"-0.9", {{c[3], 1}}}});
  EXPECT_FALSE(implied_domains(b.system())[x].upper);
  b.equation({{"-1", {{x, 1}}}, {"1.18", {}}, {"0.9", {{c[0], 1}}}, {"0.9", {{c[1], 1}}}});
  EXPECT_TRUE(implied_domains(b.system())[x].both());
}

TEST(Domain, IsNotImpliedByAVariableThatItBounds) {
  SystemBuilder b;  // nothing bounds x or y, though each would bound the other
  const int x = b.variable("x", "-1", "1"), y = b.variable("y", "-1", "1");
  b.equation({{"1", {{x, 1}}}, {"-1", {{y, 1}}}});
  const auto implied = implied_domains(b.system());
  EXPECT_FALSE(implied[x].lower || implied[x].upper || implied[y].lower || implied[y].upper);
}

TEST(Domain, OfACrossProductIsImpliedByTheNorms) {
  SystemBuilder b;
  std::array<int, 3> p{}, q{};
  for (int i = 0; i < 3; ++i) p[i] = b.variable("p" + std::to_string(i), "-1", "1");
  for (int i = 0; i < 3; ++i) q[i] = b.variable("q" + std::to_string(i), "-1", "1");
  const int r = b.variable("r", "-1", "1"), narrow = b.variable("narrow", "-1", "9/10"), sum = b.variable("sum", "-1", "1"),
            twice = b.variable("twice", "-1", "1");
  for (const auto& v : {p, q}) b.equation({{"1", {{v[0], 2}}}, {"1", {{v[1], 2}}}, {"1", {{v[2], 2}}}, {"-1", {}}});
  b.equation({{"1", {{r, 1}}}, {"-1", {{p[0], 1}, {q[1], 1}}}, {"1", {{p[1], 1}, {q[0], 1}}}});
  b.equation({{"1", {{narrow, 1}}}, {"-1", {{p[0], 1}, {q[1], 1}}}, {"1", {{p[1], 1}, {q[0], 1}}}});
  b.equation({{"1", {{sum, 1}}}, {"-1", {{p[0], 1}, {q[1], 1}}}, {"1", {{p[1], 1}, {q[0], 1}}}, {"-1/10", {}}});
  b.equation(
      {{"1", {{twice, 1}}}, {"-1", {{p[0], 1}, {q[1], 1}}}, {"1", {{p[0], 1}, {q[0], 1}}}});  // p0 (q1 − q0): up to √2
  const auto implied = implied_domains(b.system());
  EXPECT_TRUE(implied[r].both());
  EXPECT_TRUE(implied[narrow].lower && !implied[narrow].upper);
  EXPECT_FALSE(implied[sum].lower || implied[sum].upper) << "a tenth more than 1";
  EXPECT_FALSE(implied[twice].lower || implied[twice].upper);
}

TEST(Domain, LocatesPiecesInsideOutsideAndAcross) {
  const UpwardRounding rounding;
  SystemBuilder b;
  const int u = b.variable("u", "0", "1"), v = b.variable("v", "0", "1");
  b.at_least_zero({{"1", {{u, 1}}}, {"-1", {{v, 1}}}});
  const CompiledSystem compiled(b.system());
  const DomainTest domain(b.system());
  const auto locate = [&](Interval x, Interval y) {
    const std::vector<Interval> box{x, y};
    return domain.locate(compiled, box);
  };
  EXPECT_EQ(locate({0.5, 0.6}, {0.1, 0.2}), Location::inside);
  EXPECT_EQ(locate({0.1, 0.2}, {0.5, 0.6}), Location::outside);
  EXPECT_EQ(locate({0.4, 0.6}, {0.5, 0.6}), Location::across);
  EXPECT_EQ(locate({0.9, 1.1}, {0.1, 0.2}), Location::across);
  EXPECT_EQ(locate({1.1, 1.2}, {0.1, 0.2}), Location::outside);
}

// Random quadratic inequalities: no point that satisfies one is cut off.
TEST(Project, KeepsEveryPointOfAnInequalityBySlopes) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto coefficient = [&] { return std::to_string(std::lround(8 * unit(random))) + "/4"; };
  int shrunk = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    SystemBuilder b;
    const int x = b.variable("x", "-4", "4"), y = b.variable("y", "-4", "4"), z = b.variable("z", "-4", "4");
    b.at_least_zero({{coefficient(), {{x, 2}}},
                     {coefficient(), {{x, 1}, {y, 1}}},
                     {coefficient(), {{y, 2}}},
                     {coefficient(), {{y, 1}, {z, 1}}},
                     {coefficient(), {{z, 1}}},
                     {coefficient(), {}}});
    const CompiledSystem system(b.system());
    const UpwardRounding rounding;
    std::vector<Interval> box;
    for (int j = 0; j < 3; ++j) {
      const double at = 3 * unit(random);
      box.emplace_back(at, at + std::fabs(unit(random)));
    }
    std::vector<Interval> left = box;
    std::array<std::uint8_t, 3> changed{};
    const bool any = project(system, 0, left, 0.1, changed.data());
    shrunk += !any || left != box;
    for (int sample = 0; sample < 50; ++sample) {
      std::array<double, 3> p{};
      for (std::size_t j = 0; j < 3; ++j) p[j] = box[j].lo() + 0.5 * (unit(random) + 1) * (box[j].hi() - box[j].lo());
      bool inside = true;
      for (std::size_t j = 0; j < 3; ++j) inside = inside && box[j].contains(p[j]);
      if (!inside || system.evaluate_at(0, p.data()).lo() < 0) continue;
      ASSERT_TRUE(any) << trial;
      for (std::size_t j = 0; j < 3; ++j) ASSERT_TRUE(left[j].contains(p[j])) << trial;
    }
  }
  EXPECT_GT(shrunk, 500);
}

TEST(Project, SeesThatTwoNumbersAreTooCloseToEachOther) {
  SystemBuilder b;  // (x − y)² ≥ 1/4, written out
  const int x = b.variable("x", "-9", "9"), y = b.variable("y", "-9", "9");
  b.at_least_zero({{"1", {{x, 2}}}, {"-2", {{x, 1}, {y, 1}}}, {"1", {{y, 2}}}, {"-1/4", {}}});
  const CompiledSystem system(b.system());
  const UpwardRounding rounding;
  std::vector<Interval> box{{5.0, 5.2}, {5.0, 5.2}};
  std::array<std::uint8_t, 2> changed{};
  EXPECT_FALSE(project(system, 0, box, 0.1, changed.data()));
  box = {{5.0, 5.2}, {5.5, 5.7}};
  EXPECT_TRUE(project(system, 0, box, 0.1, changed.data()));
}

}  // namespace
}  // namespace corank::certify
