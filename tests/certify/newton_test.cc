#include "corank/certify/newton.h"

#include <gtest/gtest.h>

#include <optional>
#include <random>
#include <vector>

#include "corank/certify/distinct.h"
#include "corank/core/rounding.h"
#include "corank/tests/system_builder.h"

namespace corank::certify {
namespace {

using test::SystemBuilder;

// One equation in one unknown: Y = 1/f'(mid), or 1 where that is 0.
Preconditioner scalar_preconditioner(const CompiledSystem& f, const Interval& x) {
  double derivative = 0;
  const double mid = x.mid();
  f.approximate_jacobian(&mid, &derivative);
  return {{0}, {0}, {derivative == 0 ? 1.0 : 1 / derivative}};
}

class Newton : public testing::Test {
 protected:
  Sheet prove(const SystemBuilder& builder, Interval x) {
    const CompiledSystem f(builder.system());
    return newton_prove(f, scalar_preconditioner(f, x), {&x, 1}, workspace_);
  }
  UpwardRounding rounding_;
  NewtonWorkspace workspace_;
};

TEST_F(Newton, ProvesASimpleRootAndEnclosesIt) {
  SystemBuilder b;
  const int x = b.variable("x", "-4", "4");
  b.equation({{"1", {{x, 2}}}, {"-2", {}}});  // x² = 2
  const Sheet sheet = prove(b, Interval(1.3, 1.5));
  ASSERT_TRUE(sheet.proven);
  EXPECT_TRUE(sheet.region[0].strictly_contains(sheet.image[0]));
  EXPECT_LE(sheet.image[0].lo(), std::sqrt(2.0));
  EXPECT_GE(sheet.image[0].hi(), std::nextafter(std::sqrt(2.0), 0));
}

// x = cos x has one solution, 0.7390851332151607.
TEST_F(Newton, ProvesTheFixedPointOfTheCosine) {
  SystemBuilder b;
  const int x = b.variable("x", "-4", "4");
  b.equation({{"1", {{x, 1}}}, {"-1", {{x, 1, Function::cosine}}}});
  const Sheet sheet = prove(b, Interval(0, 1));
  ASSERT_TRUE(sheet.proven);
  EXPECT_TRUE(sheet.image[0].contains(0.7390851332151607));
  EXPECT_LE(sheet.image[0].width(), 0.4);
}

// sin x − x/2 has the roots 0 and ±1.895; 1 − cos x a double one at 0.
TEST_F(Newton, NeverClaimsOneRootOfASineWhereThereAreMore) {
  SystemBuilder sine, cosine;
  const int x = sine.variable("x", "-4", "4");
  sine.equation({{"1", {{x, 1, Function::sine}}}, {"-1/2", {{x, 1}}}});
  cosine.variable("x", "-4", "4");
  cosine.equation({{"1", {{x, 1, Function::cosine}}}, {"-1", {}}});
  for (double radius = 1e-9; radius < 3; radius *= 1.7) {
    const Sheet sheet = prove(sine, Interval(-radius, 0.9 * radius));
    EXPECT_FALSE(sheet.proven && sheet.region[0].contains(1.8954942670339809)) << radius;
    EXPECT_FALSE(prove(cosine, Interval(-radius, 0.9 * radius)).proven) << radius;
  }
  EXPECT_TRUE(prove(sine, Interval(-0.01, 0.012)).proven);
}

TEST_F(Newton, LeavesADoubleRootUndecided) {
  SystemBuilder b;
  const int x = b.variable("x", "-4", "4");
  b.equation({{"1", {{x, 2}}}});  // x² = 0
  for (double width : {1.0, 1e-3, 1e-9}) EXPECT_FALSE(prove(b, Interval(-width, 0.9 * width)).proven) << width;
}

TEST_F(Newton, ProvesNothingWhereThereIsNoRoot) {
  SystemBuilder b;
  const int x = b.variable("x", "-4", "4");
  b.equation({{"1", {{x, 2}}}, {"1/1000000", {}}});  // x² = −1e-6
  for (double lo : {-1.0, -1e-3, -1e-4, 1e-4}) EXPECT_FALSE(prove(b, Interval(lo, lo + 1e-4)).proven) << lo;
}

TEST_F(Newton, NeverClaimsOneRootWhereThereAreThree) {
  // x³ − εx has the slope x² − ε about 0, which is near constant for small x: slopes alone may show a contraction.
  SystemBuilder b;
  const int x = b.variable("x", "-4", "4");
  b.equation({{"1", {{x, 3}}}, {"-1/10000", {{x, 1}}}});  // roots −0.01, 0, 0.01
  for (double radius = 0.0101; radius < 1; radius *= 1.3) {
    const Sheet sheet = prove(b, Interval(-radius, radius));
    EXPECT_FALSE(sheet.proven && sheet.region[0].contains(0.01) && sheet.region[0].contains(-0.01)) << radius;
  }
}

// Polynomials Π (x − r_i) with known rational roots: a proven region holds exactly one of them.
TEST_F(Newton, AProvenRegionHoldsExactlyOneRoot) {
  std::mt19937 random(7);
  int proven = 0;
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<int> roots;  // in 1/64
    for (int k = 0; k < 3; ++k) roots.push_back(static_cast<int>(random() % 257) - 128);
    const int r0 = roots[0], r1 = roots[1], r2 = roots[2];
    SystemBuilder b;
    const int x = b.variable("x", "-4", "4");
    b.equation({{"262144", {{x, 3}}},
                {std::to_string(-4096 * (r0 + r1 + r2)), {{x, 2}}},
                {std::to_string(64 * (r0 * r1 + r0 * r2 + r1 * r2)), {{x, 1}}},
                {std::to_string(-r0 * r1 * r2), {}}});
    for (int box = 0; box < 40; ++box) {
      const double lo = static_cast<double>(random() % 512) / 128 - 2,
                   width = std::ldexp(1.0, -static_cast<int>(random() % 7));
      const Sheet sheet = prove(b, Interval(lo, lo + width));
      if (!sheet.proven) continue;
      ++proven;
      int inside = 0, in_image = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        if (std::count(roots.begin(), roots.begin() + static_cast<std::ptrdiff_t>(k), roots[k])) continue;  // count once
        inside += sheet.region[0].contains(roots[k] / 64.0);
        in_image += sheet.image[0].contains(roots[k] / 64.0);
      }
      ASSERT_EQ(inside, 1) << "roots/64: " << r0 << ' ' << r1 << ' ' << r2 << " region " << sheet.region[0];
      ASSERT_EQ(in_image, 1);
    }
  }
  EXPECT_GT(proven, 500) << "the test must see proofs";
}

TEST_F(Newton, ProvesASheetForEveryValueOfTheFreeVariable) {
  // x² + y² = 1, y free: x = √(1 − y²).
  SystemBuilder b;
  const int x = b.variable("x", "-1", "1"), y = b.variable("y", "-1", "1");
  b.equation({{"1", {{x, 2}}}, {"1", {{y, 2}}}, {"-1", {}}});
  const CompiledSystem f(b.system());
  const std::vector<Interval> box{Interval(0.9, 1), Interval(0.1, 0.3)};
  const Sheet sheet = newton_prove(f, {{0}, {x}, {0.5}}, box, workspace_);
  ASSERT_TRUE(sheet.proven);
  EXPECT_EQ(sheet.region[y], Interval(0.1, 0.3));
  for (double v : {0.1, 0.17, 0.2, 0.3}) EXPECT_TRUE(sheet.image[x].contains(std::sqrt(1 - v * v))) << v;
}

TEST_F(Newton, DoesNotProveASheetThatFoldsOver) {
  // x² = y with y ∈ [−0.01, 0.2] free: no solution for y < 0.
  SystemBuilder b;
  const int x = b.variable("x", "-1", "1"), y = b.variable("y", "-1", "1");
  b.equation({{"1", {{x, 2}}}, {"-1", {{y, 1}}}});
  const CompiledSystem f(b.system());
  const std::vector<Interval> box{Interval(0, 0.5), Interval(-0.01, 0.2)};
  EXPECT_FALSE(newton_prove(f, {{0}, {x}, {2.0}}, box, workspace_).proven);
}

TEST_F(Newton, AnyPreconditionerKeepsEverySolution) {
  // Circle and line: x² + y² = 25, x = y + 1 has (4, 3) and (−3, −4). Nonsensical Y must not lose them.
  SystemBuilder b;
  const int x = b.variable("x", "-9", "9"), y = b.variable("y", "-9", "9");
  b.equation({{"1", {{x, 2}}}, {"1", {{y, 2}}}, {"-25", {}}}).equation({{"1", {{x, 1}}}, {"-1", {{y, 1}}}, {"-1", {}}});
  const CompiledSystem f(b.system());
  std::mt19937 random(11);
  std::uniform_real_distribution<double> any(-3, 3), size(0, 2);
  for (int trial = 0; trial < 20000; ++trial) {
    std::vector<Interval> box{Interval(4 - size(random), 4 + size(random)), Interval(3 - size(random), 3 + size(random))};
    const Preconditioner p{
        {0, 1}, trial % 2 ? std::vector{x, y} : std::vector{y, x}, {any(random), any(random), any(random), any(random)}};
    ASSERT_FALSE(NewtonStep(f, p, box, workspace_).outcome().empty);
    ASSERT_TRUE(box[x].contains(4.0) && box[y].contains(3.0));
    const Sheet sheet = newton_prove(f, p, box, workspace_);
    if (sheet.proven) {
      ASSERT_TRUE(sheet.image[x].contains(4.0) && sheet.image[y].contains(3.0));
    }
  }
}

// x + z = y² (one equation, x dependent): zeros are planted in random boxes, with sensible and nonsensical Y.
TEST_F(Newton, ContractingFreeVariablesKeepsEverySolution) {
  SystemBuilder b;
  const int x = b.variable("x", "-9", "9"), y = b.variable("y", "-9", "9"), z = b.variable("z", "-9", "9");
  b.equation({{"1", {{x, 1}}}, {"1", {{z, 1}}}, {"-1", {{y, 2}}}});
  const CompiledSystem f(b.system());
  std::mt19937 random(12);
  std::uniform_real_distribution<double> any(-3, 3), size(0, 1);
  int contracted = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const double at_y = std::ldexp(std::round(64 * any(random)), -6), at_z = std::ldexp(std::round(64 * any(random)), -6);
    const double zero[] = {at_y * at_y - at_z, at_y, at_z};  // exact
    std::vector<Interval> box;
    for (double v : zero) box.emplace_back(v - size(random), v + size(random));
    const std::vector<Interval> before = box;
    const Preconditioner p{{0}, {x}, {trial % 2 ? 1.0 : any(random)}};
    const NewtonStep step(f, p, box, workspace_);
    ASSERT_FALSE(step.outcome().empty);
    ASSERT_TRUE(step.contract_free(box));
    for (int j : {x, y, z}) ASSERT_TRUE(box[j].contains(zero[j]) && before[j].contains(box[j]));
    contracted += box[z].width() < 0.9 * before[z].width();
  }
  EXPECT_GT(contracted, 1000);
}

TEST_F(Newton, ContractingFreeVariablesEmptiesABoxThatTheSheetMisses) {
  SystemBuilder b;
  const int x = b.variable("x", "-9", "9"), y = b.variable("y", "-9", "9");
  b.equation({{"1", {{x, 1}}}, {"-1", {{y, 1}}}});  // x = y
  const CompiledSystem f(b.system());
  const Preconditioner p{{0}, {x}, {1.0}};
  std::vector<Interval> box{Interval(0, 1), Interval(0, 1)};
  const NewtonStep step(f, p, box, workspace_);
  ASSERT_FALSE(step.outcome().empty);
  box[x] = Interval(0.25, 0.5);
  ASSERT_TRUE(step.contract_free(box));
  EXPECT_NEAR(box[y].lo(), 0.25, 1e-12);
  EXPECT_NEAR(box[y].hi(), 0.5, 1e-12);
  box = {Interval(0.75, 1), Interval(0, 0.5)};
  EXPECT_FALSE(step.contract_free(box));
}

TEST_F(Newton, TighteningAPartKeepsItsPointsOfTheSheetAndLittleElse) {
  // u² + x² + y² = 2, x and y free: u = √(2 − x² − y²).
  SystemBuilder b;
  const int x = b.variable("x", "-2", "2"), y = b.variable("y", "-2", "2"), u = b.variable("u", "-2", "2");
  b.equation({{"1", {{u, 2}}}, {"1", {{x, 2}}}, {"1", {{y, 2}}}, {"-2", {}}});
  const CompiledSystem f(b.system());
  const auto u_at = [](double px, double py) { return std::sqrt(2 - px * px - py * py); };
  const Preconditioner p{{0}, {u}, {0.5 / u_at(0.3, 0.5)}};
  const std::vector<Interval> box{Interval(0.2, 0.4), Interval(0.4, 0.6), Interval(1.2, 1.4)};
  const Sheet sheet = newton_prove(f, p, box, workspace_);
  ASSERT_TRUE(sheet.proven);
  std::mt19937 random(17);
  std::uniform_real_distribution<double> share(0, 1);
  std::vector<Interval> whole = sheet.image;
  const NewtonStep step = tighten_sheet(f, p, whole, workspace_);
  ASSERT_LT(step.outcome().spread, 1);
  for (int trial = 0; trial < 2000; ++trial) {
    std::vector<Interval> part = whole;
    for (const int j : {x, y}) {
      const double from = whole[j].lo() + 0.18 * share(random);
      part[j] = Interval(from, std::min(from + 0.1 * share(random), whole[j].hi()));
    }
    step.tighten_part(part);
    ASSERT_TRUE(whole[u].contains(part[u]));
    const double range = u_at(part[x].lo(), part[y].lo()) - u_at(part[x].hi(), part[y].hi());
    ASSERT_LT(part[u].width(), range + 0.04) << "the slopes are those over the whole";
    for (int sample = 0; sample < 20; ++sample) {
      const double px = part[x].lo() + share(random) * (part[x].hi() - part[x].lo());
      const double py = part[y].lo() + share(random) * (part[y].hi() - part[y].lo());
      ASSERT_TRUE((part[u] + Interval(-1e-15, 1e-15)).contains(u_at(px, py))) << trial;
    }
  }
}

TEST_F(Newton, APartIsTightenedOnlyByAStepOnABoxThatContainsIt) {
  SystemBuilder b;
  const int x = b.variable("x", "-2", "2"), y = b.variable("y", "-2", "2");
  b.equation({{"1", {{x, 2}}}, {"1", {{y, 2}}}, {"-1", {}}});
  const CompiledSystem f(b.system());
  const Preconditioner p{{0}, {x}, {0.5}};
  const std::vector<Interval> box{Interval(0.9, 1), Interval(0.1, 0.3)};
  std::vector<Interval> whole = box;
  const NewtonStep step(f, p, whole, workspace_);
  ASSERT_FALSE(step.outcome().empty);
  std::vector<Interval> part{Interval(0.9, 1), Interval(0.2, 0.4)};
  EXPECT_THROW(step.tighten_part(part), std::logic_error) << "y reaches beyond the box of the step";
  EXPECT_THROW(step.contract_free(part), std::logic_error);
  EXPECT_THROW(step.value_at_zeros(0, part), std::logic_error);
  part[y] = Interval(0.2, 0.3);
  step.tighten_part(part);
  EXPECT_LT(part[x].width(), 0.05);
  const std::vector<Interval> tightened = part;
  ASSERT_TRUE(newton_prove(f, p, box, workspace_).proven);
  std::vector<Interval> other{Interval(0.95, 1), Interval(0.1, 0.2)};
  const NewtonStep later(f, {{0}, {y}, {2.0}}, other, workspace_);
  part[x] = box[x];
  step.tighten_part(part);
  EXPECT_EQ(part, tightened) << "proofs and other steps with the same memory leave it as it is";
}

TEST_F(Newton, ASingularPreconditionerProvesNothing) {
  SystemBuilder b;
  const int x = b.variable("x", "-9", "9"), y = b.variable("y", "-9", "9");
  b.equation({{"1", {{x, 1}}}, {"-1", {}}}).equation({{"1", {{y, 1}}}, {"-1", {}}});
  const CompiledSystem f(b.system());
  const std::vector<Interval> box{Interval(0, 2.5), Interval(0, 2.5)};
  EXPECT_TRUE(newton_prove(f, {{0, 1}, {x, y}, {1, 0, 0, 1}}, box, workspace_).proven);
  EXPECT_FALSE(newton_prove(f, {{0, 1}, {x, y}, {1, 0, 0, 0}}, box, workspace_).proven);
  EXPECT_FALSE(newton_prove(f, {{0, 1}, {x, y}, {0, 0, 0, 0}}, box, workspace_).proven);
  EXPECT_FALSE(newton_prove(f, {{0, 1}, {x, y}, {1, 1, 1, 1}}, box, workspace_).proven);
  EXPECT_FALSE(newton_prove(f, {{}, {}, {}}, box, workspace_).proven) << "no row, no claim";
  const Sheet partial = newton_prove(f, {{0}, {x}, {1}}, box, workspace_);
  EXPECT_TRUE(partial.proven);
  EXPECT_EQ(partial.equations, std::vector<int>{0}) << "a proof says which rows it speaks of";
}

TEST_F(Newton, ComparesIsolatedSolutions) {
  SystemBuilder b;
  const int x = b.variable("x", "-4", "4");
  b.equation({{"1", {{x, 2}}}, {"-2", {}}});
  const Sheet left = prove(b, Interval(-1.5, -1.3)), right = prove(b, Interval(1.3, 1.5)),
              again = prove(b, Interval(1.39, 1.6));
  ASSERT_TRUE(left.proven && right.proven && again.proven);
  EXPECT_EQ(compare_isolated(left, right), Identity::different);
  EXPECT_EQ(compare_isolated(right, again), Identity::same);
  EXPECT_EQ(compare_isolated(again, right), Identity::same);
  const Interval inside(1.35, 1.36), outside(1.0, 1.36);
  EXPECT_TRUE(holds_nothing_else(right, {&inside, 1}));
  EXPECT_FALSE(holds_nothing_else(right, {&outside, 1}));
}

// Images that overlap, each reaching beyond the other's region: two solutions, or one.
TEST_F(Newton, DoesNotKnowWhetherProofsThatOverlapAreOfOneSolution) {
  const auto sheet = [](Interval region, Interval image) {
    return Sheet{.proven = true, .equations = {0}, .dependent = {0}, .region = {region}, .image = {image}};
  };
  const Sheet a = sheet({0.2, 0.65}, {0.3, 0.6}), b = sheet({0.45, 0.9}, {0.5, 0.8});
  EXPECT_EQ(compare_isolated(a, b), Identity::unknown);
  const Sheet wide = sheet({0.29, 0.9}, {0.5, 0.8});
  EXPECT_EQ(compare_isolated(a, wide), Identity::same) << "a's image is in its region";
  EXPECT_EQ(compare_isolated(wide, a), Identity::same);
  EXPECT_EQ(compare_isolated(a, sheet({0.45, 0.9}, {0.61, 0.8})), Identity::different);
}

TEST_F(Newton, ProofsAreOfOneSolutionWhereTheyAreSoInEveryVariable) {
  const auto sheet = [](const std::vector<Interval>& region, const std::vector<Interval>& image) {
    return Sheet{.proven = true, .equations = {0, 1}, .dependent = {0, 1}, .region = region, .image = image};
  };
  const Sheet a = sheet({{0, 1}, {0, 1}}, {{0.4, 0.6}, {0.4, 0.6}});
  EXPECT_EQ(compare_isolated(a, sheet({{0, 1}, {0.5, 2}}, {{0.5, 0.7}, {0.55, 1.5}})), Identity::unknown);
  EXPECT_EQ(compare_isolated(a, sheet({{0, 1}, {0.5, 2}}, {{0.5, 0.7}, {0.7, 1.5}})), Identity::different);
  EXPECT_TRUE(holds_nothing_else(a, std::vector<Interval>{{0, 0.1}, {0.9, 1}})) << "the region counts";
  EXPECT_FALSE(holds_nothing_else(a, std::vector<Interval>{{0.4, 0.6}, {0.9, 1.1}}));
  EXPECT_FALSE(holds_nothing_else(a, std::vector<Interval>{{0.9, 1.1}, {0.4, 0.6}}));
}

// x² + a·x over [−1, 1], preconditioned by y: (1) asks for |1 − y·[a − 1, a + 1]| < 1, (2) for |1 − y·[a − 2, a + 2]| < 1.
TEST_F(Newton, TheProofOfUniquenessEndsWhereTheJacobiansRadiusReachesOne) {
  const auto is_proven = [&](const char* a, double y) {
    SystemBuilder b;
    const int x = b.variable("x", "-2", "2");
    b.equation({{"1", {{x, 2}}}, {a, {{x, 1}}}});
    const std::vector<Interval> box{Interval(-1, 1)};
    return newton_prove(CompiledSystem(b.system()), {{0}, {x}, {y}}, box, workspace_).proven;
  };
  EXPECT_TRUE(is_proven("21/10", 0.4)) << "radius 0.96";
  EXPECT_FALSE(is_proven("19/10", 0.5)) << "radius 1.05, though the image is [-0.55, 0.55]";
  EXPECT_FALSE(is_proven("2", 0.45)) << "radius 1: the derivative vanishes at an end";
}

// x = 0 over [0, 1] with y = 1/2: the first image is [0, 1/2], exactly, which touches the box's end; so the region has
// to grow.
TEST_F(Newton, TheImageLiesInTheRegionsInterior) {
  SystemBuilder b;
  const int x = b.variable("x", "-2", "2");
  b.equation({{"1", {{x, 1}}}});
  const std::vector<Interval> box{Interval(0, 1)};
  const Sheet sheet = newton_prove(CompiledSystem(b.system()), {{0}, {x}, {0.5}}, box, workspace_);
  ASSERT_TRUE(sheet.proven);
  EXPECT_TRUE(sheet.region[0].strictly_contains(sheet.image[0]));
  EXPECT_TRUE(sheet.region[0].strictly_contains(Interval(0.0)));
}

// On the unit circle, (x² + y²)² − 1 vanishes and x⁴ + y⁴ − 1 + 2x²y² does; x² + y² + x/1000 − 1 does not.
TEST_F(Newton, EnclosesTheValueOfADependentEquationAtZeros) {
  SystemBuilder b;
  const int x = b.variable("x", "-1", "1"), y = b.variable("y", "-1", "1");
  b.equation({{"1", {{x, 2}}}, {"1", {{y, 2}}}, {"-1", {}}});
  b.equation({{"1", {{x, 4}}}, {"2", {{x, 2}, {y, 2}}}, {"1", {{y, 4}}}, {"-1", {}}});
  b.equation({{"1", {{x, 2}}}, {"1", {{y, 2}}}, {"-1", {}}, {"1/1000", {{x, 1}}}});
  const CompiledSystem f(b.system());
  double narrow[2] = {0, 0};
  for (double width : {0.1, 0.01}) {
    const std::vector<Interval> box{Interval(0.95, 1), Interval(0.1, 0.1 + width)};
    const Preconditioner p{{0}, {x}, {1 / (2 * 0.99)}};
    const Sheet sheet = newton_prove(f, p, box, workspace_);
    ASSERT_TRUE(sheet.proven);
    std::vector<Interval> piece = sheet.image;
    const NewtonStep step(f, p, piece, workspace_);
    ASSERT_FALSE(step.outcome().empty);
    const Interval zero = step.value_at_zeros(1, piece);
    const Interval other = step.value_at_zeros(2, piece);
    EXPECT_TRUE(zero.contains(0.0));
    for (double v : {0.1, 0.1 + width / 2, 0.1 + width}) EXPECT_TRUE(other.contains(std::sqrt(1 - v * v) / 1000)) << v;
    narrow[width < 0.05] = zero.width();
  }
  EXPECT_LT(narrow[1], narrow[0] / 30) << "second order in the width";
}

// Slopes and Jacobians enclose what they claim to, for monomials of every shape.
TEST_F(Newton, SlopesAndJacobiansEncloseDifferencesAndDerivatives) {
  SystemBuilder b;
  const int x = b.variable("x", "-2", "2"), y = b.variable("y", "-2", "2"), z = b.variable("z", "-2", "2");
  b.equation({{"3", {{x, 2}, {y, 1}}},
              {"-1/3", {{x, 1}, {y, 1}, {z, 1}}},
              {"2", {{z, 3}}},
              {"5", {{x, 1}, {z, 1}}},
              {"-0.7", {{y, 2}}},
              {"1", {{x, 1}}},
              {"2", {{x, 1, Function::sine}}},
              {"-3/2", {{z, 1, Function::cosine}}},
              {"4", {}}});
  const CompiledSystem f(b.system());
  const auto value = [](double u, double v, double w) {
    return 3 * u * u * v - u * v * w / 3 + 2 * w * w * w + 5 * u * w - 0.7 * v * v + u + 2 * std::sin(u) -
           1.5 * std::cos(w) + 4;
  };
  std::mt19937 random(3);
  std::uniform_real_distribution<double> in(-2, 2);
  for (int trial = 0; trial < 5000; ++trial) {
    double c[3], p[3];
    std::vector<Interval> box;
    for (int j = 0; j < 3; ++j) {
      const double a = in(random), e = in(random);
      box.emplace_back(std::min(a, e), std::max(a, e));
      p[j] = std::clamp(in(random), box[j].lo(), box[j].hi());
      c[j] = in(random);  // the centre need not lie in the box
    }
    std::vector<Interval> s(f.entries()), jacobian(f.entries());
    f.slopes(box, c, s);
    f.jacobian(box, jacobian);
    Interval difference;
    for (int j = 0; j < 3; ++j) difference += s[j] * (Interval(p[j]) - Interval(c[j]));
    const Interval slack(-1e-11, 1e-11);  // the expected values carry rounding errors
    ASSERT_TRUE((difference + slack).contains(value(p[0], p[1], p[2]) - value(c[0], c[1], c[2])));
    const double d[3] = {6 * p[0] * p[1] - p[1] * p[2] / 3 + 5 * p[2] + 1 + 2 * std::cos(p[0]),
                         3 * p[0] * p[0] - p[0] * p[2] / 3 - 1.4 * p[1],
                         -p[0] * p[1] / 3 + 6 * p[2] * p[2] + 5 * p[0] + 1.5 * std::sin(p[2])};
    double approximate[3];
    f.approximate_jacobian(p, approximate);
    for (int j = 0; j < 3; ++j) ASSERT_NEAR(approximate[j], d[j], 1e-12) << j;
    for (int j = 0; j < 3; ++j) ASSERT_TRUE((jacobian[j] + slack).contains(d[j])) << j;
    ASSERT_TRUE((f.evaluate(0, box) + slack).contains(value(p[0], p[1], p[2])));
    ASSERT_TRUE((f.evaluate_at(0, p) + slack).contains(value(p[0], p[1], p[2])));
  }
}

TEST(NewtonProof, IsRefusedInAnotherRoundingMode) {
  SystemBuilder b;
  const int x = b.variable("x", "-2", "2");
  b.equation({{"1", {{x, 1}}}});
  const CompiledSystem f(b.system());
  const std::vector<Interval> box{Interval(-1, 1)};
  NewtonWorkspace workspace;
  EXPECT_THROW(newton_prove(f, {{0}, {x}, {1}}, box, workspace), std::logic_error);
  const UpwardRounding rounding;
  EXPECT_TRUE(newton_prove(f, {{0}, {x}, {1}}, box, workspace).proven);
}

// x² + y² = 1 solved for y, in a box that the circle leaves through its side y = 4/5, at x = 3/5.
class PartOfACircle : public Newton {
 protected:
  PartOfACircle() {
    SystemBuilder b;
    const int x = b.variable("x", "-2", "2"), y = b.variable("y", "-2", "2");
    b.equation({{"1", {{x, 2}}}, {"1", {{y, 2}}}, {"-1", {}}});
    system_.emplace(b.system());
  }
  Sheet prove(const std::vector<Interval>& x, const std::vector<Interval>& near) {
    return newton_prove_in_part(*system_, {{0}, {1}, {0.7}}, x, near, workspace_);
  }
  std::optional<CompiledSystem> system_;
};

TEST_F(PartOfACircle, IsProvenInABoxThatItLeaves) {
  const std::vector<Interval> x{{0.3, 0.9}, {0.4, 0.8}}, near{{0.69, 0.71}, {0.70, 0.73}};
  EXPECT_FALSE(newton_prove(*system_, {{0}, {1}, {0.7}}, x, workspace_).proven) << "y is above the box at x = 0.3";
  const Sheet sheet = prove(x, near);
  ASSERT_TRUE(sheet.proven);
  EXPECT_FALSE(sheet.spans_image());
  EXPECT_EQ(sheet.image, x);
  EXPECT_EQ(sheet.region[0], near[0]);
  EXPECT_TRUE(x[1].contains(sheet.region[1]));
  EXPECT_TRUE(sheet.region[1].contains(std::sqrt(1 - 0.49)));
}

TEST_F(PartOfACircle, IsNotProvenWhereThereMayBeTwoPointsOrNone) {
  const std::vector<Interval> near{{0.69, 0.71}, {0.70, 0.73}};
  EXPECT_FALSE(prove({{0.3, 0.9}, {-0.8, 0.8}}, near).proven) << "two points for x = 0.7";
  EXPECT_FALSE(prove({{0.3, 0.9}, {0, 0.8}}, near).proven) << "a vertical tangent may be in it";
  EXPECT_FALSE(prove({{0.1, 0.3}, {0.4, 0.8}}, {{0.19, 0.21}, {0.6, 0.62}}).proven) << "no point at all";
  EXPECT_FALSE(prove({{0.3, 0.6}, {0.4, 0.8}}, near).proven) << "the point is beside the box";
}

}  // namespace
}  // namespace corank::certify
