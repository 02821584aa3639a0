// Which steps are chosen, and that they keep every solution.
#include "corank/solve/reduction/reducer.h"

#include <gtest/gtest.h>

#include <random>

#include "corank/certify/domain.h"
#include "corank/tests/applied_steps.h"
#include "corank/tests/solve/reductions.h"

namespace corank::solve {
namespace {

TEST(Reducer, ReplacesTiedVariablesAndImages) {
  const Reduction r = reduce(chain().system(), Eliminate::exact);
  ASSERT_EQ(r.system.size(), 1);
  ASSERT_EQ(r.system.equations.size(), 1u);
  EXPECT_TRUE(r.consistent);
  EXPECT_EQ(r.definitions.size(), 3u);
  const auto box = lifted(r, {r.system.variables[0].name == "y" ? 0.5 : 2.0});
  EXPECT_TRUE(box[0].contains(2.0) && box[1].contains(0.5) && box[2].contains(-0.5) && box[3].contains(-0.75));
}

TEST(Reducer, IsGivenUpAsAWholeOnceItIsToEnd) {
  const System system = chain().system();
  int questions = 0;
  reduce(system, Eliminate::exact, [&] { return ++questions < 0; });
  ASSERT_GT(questions, 5);
  for (int k = 0; k < questions; ++k) {
    int asked = 0;
    const Reduction r = reduce(system, Eliminate::exact, [&] { return asked++ >= k; });
    EXPECT_EQ(asked, k + 1) << "the first yes ends it";
    EXPECT_TRUE(r.consistent && r.definitions.empty() && r.steps.empty());
    EXPECT_EQ(r.kept, (std::vector<int>{0, 1, 2, 3}));
    ASSERT_EQ(r.system.equations.size(), system.equations.size());
    for (std::size_t i = 0; i < system.equations.size(); ++i)
      EXPECT_EQ(text(r.system.equations[i]), text(system.equations[i]));
  }
}

TEST(Reducer, LeavesLongNumbersAlone) {
  // The second equation less twice the first is y = 1 in this case; with a coefficient of 1 + 10^−700 it is not worth the
  // arithmetic.
  const auto steps = [](const std::string& coefficient) {
    SystemBuilder b;
    const int x = b.variable("x", "-1", "1"), y = b.variable("y", "-2", "2");
    b.equation({{"1", {{x, 2}}}, {coefficient, {{x, 3}}}, {"1", {{x, 1}, {y, 1}}}, {"1", {{y, 2}}}});
    b.equation({{"2", {{x, 2}}}, {"2", {{x, 3}}}, {"2", {{x, 1}, {y, 1}}}, {"2", {{y, 2}}}, {"1", {{y, 1}}}, {"-1", {}}});
    return reduce(b.system(), Eliminate::exact).steps.size();
  };
  EXPECT_GT(steps("1"), 0u);
  EXPECT_EQ(steps("1" + std::string(699, '0') + "1/1" + std::string(700, '0')), 0u);
  EXPECT_EQ(steps("1/1" + std::string(700, '0')), 0u) << "a long denominator";
}

TEST(Reducer, TreatsThousandsOfEquations) {
  // xᵢ² + xᵢ₊₁ = 1/2, cyclic: nothing to be done, which is to be seen without comparing every pair's coefficients.
  constexpr int kCount = 2000;
  SystemBuilder b;
  for (int i = 0; i < kCount; ++i) b.variable("x" + std::to_string(i), "0", "1");
  for (int i = 0; i < kCount; ++i) b.equation({{"1", {{i, 2}}}, {"1", {{(i + 1) % kCount, 1}}}, {"-1/2", {}}});
  int questions = 0;
  const Reduction r = reduce(b.system(), Eliminate::exact, [&] { return ++questions < 0; });
  EXPECT_TRUE(r.steps.empty());
  EXPECT_LT(questions, 10 * kCount);
}

// The rows of a kernel condition of two dyads, the second one as in a loop equation: u x + v y = 0 and u x + v y + w z = t²
// stand for w z = t².
SystemBuilder kernel_rows() {
  SystemBuilder b;
  for (const char* name : {"t", "u", "v", "w", "x", "y", "z"}) b.variable(name, "-2", "2");
  b.equation({{"3/2", {{1, 1}, {4, 1}}}, {"-1", {{2, 1}, {5, 1}}}});
  b.equation({{"3", {{1, 1}, {4, 1}}}, {"-2", {{2, 1}, {5, 1}}}, {"1", {{3, 1}, {6, 1}}}, {"-1", {{0, 2}}}});
  b.equation({{"1", {{4, 2}}}, {"1", {{5, 2}}}, {"1", {{6, 2}}}, {"-1", {}}});
  return b;
}

TEST(Reducer, AddsMultiplesOfEquationsThatShortenOthers) {
  const Reduction r = reduce(kernel_rows().system(), Eliminate::exact);
  ASSERT_EQ(r.system.equations.size(), 3u);
  EXPECT_EQ(text(r.system.equations[1]), "-1*x0^2 + 1*x3^1*x6^1");
  EXPECT_EQ(r.steps, (std::vector<ReductionStep>{SumOfEquations{1, 0, -2}}));
}

TEST(Reducer, AddsNoEquationsWhereAToleranceIsAboutThemAsGiven) {
  System system = kernel_rows().system();
  system.coefficient_tolerance = 1e-6;
  EXPECT_TRUE(reduce(system).steps.empty());
  EXPECT_TRUE(reduce(system, Eliminate::exact).steps.empty());
}

// √2 cancels as an expression; √2 and √8 do not, although −2·√2 + √8 is 0: then that stays, as a residue.
TEST(Reducer, AddsEquationsWithIrrationalNumbers) {
  for (const bool same : {true, false}) {
    SystemBuilder b;
    const int x = b.variable("x", "-2", "2"), y = b.variable("y", "-2", "2"), z = b.variable("z", "-2", "2");
    b.equation({{"1", {{x, 2}}}, {"1", {{y, 2}}}, {"1", {{z, 2}}}, {"-1", {}}});
    b.equation({{"2", {{x, 2}}}, {"1", {{y, 2}}}, {"2", {{z, 2}}}, {"-1", {{x, 1}, {y, 1}}}, {"-5/2", {}}});
    System system = b.system();
    const ExactNumber root = ExactNumber::apply(ConstantFunction::sqrt, 2);
    const auto set = [](Monomial& m, const ExactNumber& c) { m = Monomial(c, m.factors); };
    set(system.equations[0].monomials[1], root);
    set(system.equations[1].monomials[1], same ? 2 * root : ExactNumber::apply(ConstantFunction::sqrt, 8));
    const Reduction r = reduce(system, Eliminate::exact);
    EXPECT_EQ(r.steps, (std::vector<ReductionStep>{SumOfEquations{1, 0, -2}}));
    if (!same) {
      EXPECT_EQ(r.system.equations[1].monomials.size(), 3u);
      continue;
    }
    EXPECT_EQ(text(r.system.equations[1]), "-1/2 + -1*x0^1*x1^1");
  }
}

TEST(Reducer, AddsNoEquationThatMakesAnotherAsLong) {
  SystemBuilder b;
  const int x = b.variable("x", "-2", "2"), y = b.variable("y", "-2", "2"), z = b.variable("z", "-2", "2");
  b.equation({{"1", {{x, 2}}}, {"1", {{y, 2}}}, {"-1", {}}}).equation({{"1", {{x, 2}}}, {"2", {{y, 1}, {z, 1}}}});
  EXPECT_TRUE(reduce(b.system(), Eliminate::exact).steps.empty());
}

// 0 = x + y − 1 is in both: sums may make an equation tie two variables, which are then eliminated.
TEST(Reducer, EliminatesWhatASumTies) {
  SystemBuilder b;
  const int x = b.variable("x", "-2", "2"), y = b.variable("y", "-2", "2"), z = b.variable("z", "-2", "2");
  b.equation({{"1", {{x, 2}}}, {"1", {{y, 2}}}, {"1", {{z, 2}}}, {"-1", {}}});
  b.equation({{"2", {{x, 2}}}, {"2", {{y, 2}}}, {"2", {{z, 2}}}, {"1", {{x, 1}}}, {"-1", {{y, 1}}}, {"-2", {}}});
  const Reduction r = reduce(b.system(), Eliminate::exact);
  EXPECT_EQ(r.steps, (std::vector<ReductionStep>{SumOfEquations{1, 0, -2}, Elimination{y, 1}}));
  ASSERT_EQ(r.system.equations.size(), 1u);
  EXPECT_EQ(text(r.system.equations[0]), "-1 + 2*x0^2 + 1*x1^2");
}

TEST(Reducer, TakesOnlyIntegersForDefinitionsWhereDecimalsAreRounded) {
  SystemBuilder b;
  const int x = b.variable("x", "-2", "2"), y = b.variable("y", "-2", "2"), z = b.variable("z", "-2", "2");
  b.equation({{"1", {{x, 1}}}, {"-0.866025", {}}}).equation({{"2", {{y, 1}}}, {"-1", {{z, 1}}}});
  b.equation({{"0.25", {{x, 2}}}, {"0.125", {{y, 2}}}, {"0.125", {{z, 2}}}, {"-1", {}}});
  System system = b.system();
  system.coefficient_tolerance = 1e-3;
  const Reduction r = reduce(system, Eliminate::integers);
  EXPECT_EQ(r.kept, (std::vector<int>{x, y}));
  ASSERT_EQ(r.system.equations.size(), 2u);
  // y²/8 + (2y)²/8 = 5/8 y², each part within a thousandth.
  for (const Monomial& m : r.system.equations[1].monomials) {
    if (m.factors != std::vector<Factor>{{1, 2}}) continue;
    EXPECT_EQ(m.coefficient.text(), "5/8");
    EXPECT_NEAR(m.enclosure.width(), 2e-3 * 0.625, 1e-8);
  }
}

TEST(Reducer, KeepsEverySolutionOfRandomSystems) {
  std::mt19937 random(2026);
  std::uniform_int_distribution<int> digit(-3, 3);
  for (int trial = 0; trial < 200; ++trial) {
    // Planted at integers p; affine ties, a product and a quadric through p.
    SystemBuilder b;
    std::vector<double> p;
    for (int j = 0; j < 6; ++j) {
      b.variable("x" + std::to_string(j), "-9", "9");
      p.push_back(digit(random));
    }
    const auto through = [&](std::vector<SystemBuilder::Term> terms) {
      double value = 0;
      for (const auto& [c, factors] : terms) {
        double term = std::stod(c);
        for (const Factor& f : factors) term *= std::pow(p[static_cast<std::size_t>(f.variable)], f.power);
        value += term;
      }
      terms.push_back({std::to_string(static_cast<int>(-value)), {}});
      b.equation(terms);
    };
    const auto nonzero = [&] { return std::to_string(2 * digit(random) + 7 * (digit(random) > 0 ? 1 : -1)); };
    through({{nonzero(), {{0, 1}}}, {nonzero(), {{1, 1}}}});
    through({{nonzero(), {{2, 1}}}, {nonzero(), {{1, 1}}}});
    through({{nonzero(), {{3, 1}}}});
    through({{nonzero(), {{4, 1}}}, {nonzero(), {{1, 1}, {5, 1}}}, {nonzero(), {{3, 2}}}});
    through({{nonzero(), {{0, 2}}}, {nonzero(), {{2, 1}, {5, 1}}}, {nonzero(), {{5, 2}}}});
    const Reduction r = reduce(b.system(), Eliminate::exact);
    ASSERT_TRUE(r.consistent);
    ASSERT_EQ(r.system.size(), 2) << "seed 2026, trial " << trial;
    std::vector<double> kept;
    for (int j : r.kept) kept.push_back(p[static_cast<std::size_t>(j)]);
    const auto box = lifted(r, kept);
    for (std::size_t j = 0; j < p.size(); ++j) EXPECT_TRUE(box[j].contains(p[j])) << trial << " " << j;
    const UpwardRounding rounding;
    for (const Polynomial& f : r.system.equations) EXPECT_TRUE(evaluate(f, point(kept)).contains_zero()) << text(f);
    for (std::size_t j = 0; j < kept.size(); ++j) EXPECT_TRUE(r.system.variables[j].domain.contains(kept[j]));
    for (const Polynomial& g : r.system.inequalities) EXPECT_GE(evaluate(g, point(kept)).hi(), 0) << text(g);
  }
}

TEST(Reducer, ExpandsNoLongPowers) {
  SystemBuilder b;
  const int x = b.variable("x", "-1", "1"), y = b.variable("y", "-1", "2"), w = b.variable("w", "-2", "2");
  b.equation({{"1", {{y, 1}}}, {"-1", {{x, 1}}}, {"-1/3", {}}})
      .equation({{"1", {{y, 1000}}}, {"1", {{x, 1000}}}, {"-1", {}}});
  const int v = b.variable("v", "-1", "1"), u = b.variable("u", "-1", "1");
  b.equation({{"1", {{w, 1}}}, {"-1", {{v, 1000}}}}).equation({{"1", {{v, 1}}}, {"-1", {{u, 1000}}}});
  const Reduction r = reduce(b.system(), Eliminate::exact);
  EXPECT_EQ(r.system.equations.size(), 3u);
  EXPECT_EQ(r.definitions.size(), 1u) << "w only: v = u^1000 would make it u^1000000";
}

TEST(Reducer, IsExactForWhatIsOverDeterminedOnlyWhereThatLeavesNoMoreEquationsThanVariables) {
  const auto tolerant = [](const char* constant, bool dependent) {
    SystemBuilder b;
    const int x = b.variable("x", "-2", "2"), y = b.variable("y", "-2", "2");
    b.equation({{"1", {{x, 2}}}, {"1", {{y, 2}}}, {"-1", {}}}).equation({{"1", {{x, 2}}}, {"-1", {{y, 1}}}});
    if (dependent) b.equation({{"0.1", {{x, 2}}}, {"-0.1", {{y, 1}}}});
    if (!dependent) b.equation({{"0.1", {{x, 1}, {y, 1}}}, {"-0.3", {{y, 3}}}, {constant, {}}});
    System system = b.system();
    system.coefficient_tolerance = 1e-6;
    return reduce(system).tolerant;
  };
  EXPECT_FALSE(tolerant("", true));
  EXPECT_TRUE(tolerant("0.1", false)) << "three equations of two variables";
  SystemBuilder b;  // x = y/2 <= 1 and y > 2: consistent within the tolerance only
  const int x = b.variable("x", "0", "1"), y = b.variable("y", "2.0000001", "3");
  for (const auto& [p, q] : {std::pair{"1", "-0.5"}, {"0.1", "-0.05"}, {"0.3", "-0.15"}})
    b.equation({{p, {{x, 1}}}, {q, {{y, 1}}}});
  System system = b.system();
  EXPECT_FALSE(reduce(system).consistent);
  system.coefficient_tolerance = 1e-6;
  EXPECT_TRUE(reduce(system).consistent);
}

TEST(Reducer, GivenUpKeepsTheTolerance) {
  SystemBuilder b;
  const int x = b.variable("x", "-2", "2"), y = b.variable("y", "-2", "2");
  b.equation({{"0.5", {{x, 1}}}, {"-1", {{y, 1}}}});
  System system = b.system();
  system.coefficient_tolerance = 1e-3;
  const Reduction r = reduce(system, Eliminate::integers, [] { return true; });
  EXPECT_TRUE(r.tolerant);
  EXPECT_TRUE(r.system.equations.at(0).monomials.at(0).enclosure.contains(Interval(0.4995, 0.5005)));
  const Reduction done = Rewriting(system, true).result();
  EXPECT_TRUE(done.system.equations.at(0).monomials.at(0).enclosure.contains(Interval(0.4995, 0.5005)));
}

TEST(ReducerWithParameters, KeepsThemAndTheirDomains) {
  // y = p and x = y + 1 in [0, 1.5]: without care p would be y, and its domain that of x less 1.
  SystemBuilder builder;
  const int x = builder.variable("x", "0", "1.5"), y = builder.variable("y", "-5", "5"),
            p = builder.variable("p", "-2", "2");
  builder.equation({{"1", {{y, 1}}}, {"-1", {{p, 1}}}});
  builder.equation({{"1", {{x, 1}}}, {"-1", {{y, 1}}}, {"-1", {}}});
  const Reduction usual = reduce(builder.system());
  EXPECT_EQ(usual.kept.size(), 1U);
  const Reduction with = reduce(builder.system(), Eliminate::exact, {}, {p});
  ASSERT_EQ(with.kept, std::vector<int>{p});
  EXPECT_TRUE(with.system.variables[0].lower == ExactNumber(-2) && with.system.variables[0].upper == ExactNumber(2));
  // What the eliminated ones' ranges say of p: 0 ≤ p + 1 ≤ 1.5.
  EXPECT_EQ(with.system.inequalities.size(), 2U);
  const CompiledSystem compiled(with.system);
  const UpwardRounding rounding;
  const DomainTest domain(with.system);
  EXPECT_EQ(domain.locate(compiled, std::vector<Interval>{Interval(-1.1)}), Location::outside);
  EXPECT_EQ(domain.locate(compiled, std::vector<Interval>{Interval(0.4)}), Location::inside);
  EXPECT_EQ(domain.locate(compiled, std::vector<Interval>{Interval(0.6)}), Location::outside);
}

// Applied once more, by the checks of certify/reduction.h alone, the steps give the same.
TEST(Reducer, ChoosesStepsThatCanBeAppliedAgain) {
  for (const System& system : {chain().system(), kernel_rows().system()}) {
    const Reduction chosen = reduce(system), again = certify::apply(system, chosen.steps);
    EXPECT_FALSE(chosen.steps.empty());
    EXPECT_EQ(again.kept, chosen.kept);
    EXPECT_EQ(again.steps, chosen.steps);
    ASSERT_EQ(again.system.equations.size(), chosen.system.equations.size());
    for (std::size_t i = 0; i < chosen.system.equations.size(); ++i)
      EXPECT_EQ(text(again.system.equations[i]), text(chosen.system.equations[i]));
  }
}

}  // namespace
}  // namespace corank::solve
