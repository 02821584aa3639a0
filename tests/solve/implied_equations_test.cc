// What is found to follow from equations does; what a model claims to follow is found where it does, and refused elsewhere;
// and searches that use it lose no planted solution.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "corank/certify/polynomial_algebra.h"
#include "corank/certify/reduction.h"
#include "corank/check/checker.h"
#include "corank/core/rounding.h"
#include "corank/solve/reduction/implied_equations.h"
#include "corank/solve/reduction/reducer.h"
#include "corank/solve/search/solve.h"
#include "corank/tests/solve/cover_questions.h"
#include "corank/tests/system_builder.h"

namespace corank::solve {
namespace {
using test::SystemBuilder;

// Unit vectors u ⊥ v, and w = u × v: variables 0 … 8.
SystemBuilder frame() {
  SystemBuilder b;
  for (const char* axis : {"u", "v", "w"})
    for (const char* of : {"x", "y", "z"}) b.variable(std::string(axis) + of, "-1", "1");
  b.equation({{"1", {{0, 2}}}, {"1", {{1, 2}}}, {"1", {{2, 2}}}, {"-1", {}}});
  b.equation({{"1", {{3, 2}}}, {"1", {{4, 2}}}, {"1", {{5, 2}}}, {"-1", {}}});
  b.equation({{"1", {{0, 1}, {3, 1}}}, {"1", {{1, 1}, {4, 1}}}, {"1", {{2, 1}, {5, 1}}}});
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    b.equation({{"1", {{6 + k, 1}}}, {"-1", {{i, 1}, {3 + j, 1}}}, {"1", {{j, 1}, {3 + i, 1}}}});
  }
  return b;
}

std::vector<Polynomial> implied(const System& system) {
  const UpwardRounding rounding;
  certify::Reduction r = certify::Rewriting(system, true).result();
  add_implied_equations({}, r);
  return r.system.implied;
}

bool has(const std::vector<Polynomial>& list, const std::vector<SystemBuilder::Term>& terms) {
  const UpwardRounding rounding;
  const Polynomial wanted = certify::sum({}, 1, SystemBuilder::polynomial(terms));
  return std::any_of(list.begin(), list.end(),
                     [&](const Polynomial& f) { return certify::proportional(f, wanted).has_value(); });
}

TEST(ImpliedEquations, AreFoundForAFrameGivenByTwoAxesAndTheirCrossProduct) {
  const std::vector<Polynomial> found = implied(frame().system());
  EXPECT_TRUE(has(found, {{"1", {{6, 2}}}, {"1", {{7, 2}}}, {"1", {{8, 2}}}, {"-1", {}}})) << "|w|² = 1";
  for (const int axis : {0, 3})
    EXPECT_TRUE(has(found, {{"1", {{axis, 1}, {6, 1}}}, {"1", {{axis + 1, 1}, {7, 1}}}, {"1", {{axis + 2, 1}, {8, 1}}}}))
        << "axis " << axis << " ⊥ w";
  EXPECT_TRUE(has(found, {{"1", {{0, 1}}}, {"-1", {{4, 1}, {8, 1}}}, {"1", {{5, 1}, {7, 1}}}})) << "u = v × w";
  EXPECT_TRUE(has(found, {{"1", {{3, 1}}}, {"-1", {{7, 1}, {2, 1}}}, {"1", {{8, 1}, {1, 1}}}})) << "v = w × u";
  for (int k = 0; k < 3; ++k) {
    EXPECT_TRUE(has(found, {{"1", {{k, 2}}}, {"1", {{3 + k, 2}}}, {"1", {{6 + k, 2}}}, {"-1", {}}})) << "row " << k;
    const int i = (k + 1) % 3;
    EXPECT_TRUE(has(found, {{"1", {{k, 1}, {i, 1}}}, {"1", {{3 + k, 1}, {3 + i, 1}}}, {"1", {{6 + k, 1}, {6 + i, 1}}}}))
        << "rows " << k << ", " << i;
  }
}

TEST(ImpliedEquations, AreFoundForAVectorInTwoFrames) {
  SystemBuilder b = frame();
  for (const char* name : {"Px", "Py", "Pz", "qx", "qy", "qz"}) b.variable(name, "-1", "1");
  b.equation({{"1", {{9, 2}}}, {"1", {{10, 2}}}, {"1", {{11, 2}}}, {"-1", {}}});
  for (int k = 0; k < 3; ++k)
    b.equation({{"1", {{12 + k, 1}}},
                {"-1", {{3 * k, 1}, {9, 1}}},
                {"-1", {{3 * k + 1, 1}, {10, 1}}},
                {"-1", {{3 * k + 2, 1}, {11, 1}}}});
  const std::vector<Polynomial> found = implied(b.system());
  EXPECT_TRUE(has(found, {{"1", {{12, 2}}}, {"1", {{13, 2}}}, {"1", {{14, 2}}}, {"-1", {}}})) << "|q|² = |P|²";
  for (int k = 0; k < 3; ++k)
    EXPECT_TRUE(
        has(found,
            {{"1", {{9 + k, 1}}}, {"-1", {{k, 1}, {12, 1}}}, {"-1", {{3 + k, 1}, {13, 1}}}, {"-1", {{6 + k, 1}, {14, 1}}}}))
        << "P = Σ q_i axis_i, row " << k;
}

// A random rotation of rational entries (Cayley), column by column.
std::vector<ExactNumber> rotation(std::mt19937& random) {
  std::uniform_int_distribution<long> pick(-5, 5);
  const ExactNumber a = pick(random), b = pick(random), c = pick(random), d = pick(random) * 2 + 1;
  const ExactNumber n = a * a + b * b + c * c + d * d, two = 2;
  return {(d * d + a * a - b * b - c * c) / n, two * (a * b + c * d) / n,           two * (a * c - b * d) / n,
          two * (a * b - c * d) / n,           (d * d - a * a + b * b - c * c) / n, two * (b * c + a * d) / n,
          two * (a * c + b * d) / n,           two * (b * c - a * d) / n,           (d * d - a * a - b * b + c * c) / n};
}

ExactNumber value(const Polynomial& f, const std::vector<ExactNumber>& x) {
  ExactNumber sum = 0;
  for (const Monomial& m : f.monomials) {
    ExactNumber product = m.coefficient;
    for (const Factor& factor : m.factors)
      product = product * pow(x[static_cast<std::size_t>(factor.variable)], factor.power);
    sum = sum + product;
  }
  return sum;
}

TEST(ImpliedEquations, HoldExactlyAtRandomFrames) {
  const System system = frame().system();
  const std::vector<Polynomial> found = implied(system);
  ASSERT_GE(found.size(), 15u);
  std::mt19937 random(1);
  for (int k = 0; k < 200; ++k) {
    const std::vector<ExactNumber> x = rotation(random);
    for (const Polynomial& f : system.equations) ASSERT_TRUE(value(f, x).is_zero());
    for (const Polynomial& h : found) ASSERT_TRUE(value(h, x).is_zero());
  }
}

TEST(ImpliedEquations, AreNoneWhereNothingFollows) {
  SystemBuilder b;
  for (const char* name : {"a", "b", "c", "d"}) b.variable(name, "-1", "1");
  b.equation({{"1", {{0, 2}}}, {"1", {{1, 2}}}, {"-1", {}}});
  b.equation({{"1", {{2, 2}}}, {"1", {{3, 2}}}, {"-1", {}}});
  b.equation({{"1", {{0, 1}, {2, 1}}}, {"1", {{1, 1}, {3, 1}}}, {"-1/3", {}}});
  EXPECT_TRUE(implied(b.system()).empty());
}

TEST(ImpliedEquations, FindTheIdentityOfAClaimAndRefuseAFalseOne) {
  // A link of length 7/10 from (1.3 c, 1.3 s) to (x, y): its closing distance.
  SystemBuilder b;
  for (const char* name : {"x", "y", "c", "s", "c2", "s2"}) b.variable(name, "-2", "2");
  b.equation({{"1", {{0, 1}}}, {"-13/10", {{2, 1}}}, {"-7/10", {{4, 1}}}});
  b.equation({{"1", {{1, 1}}}, {"-13/10", {{3, 1}}}, {"-7/10", {{5, 1}}}});
  b.equation({{"1", {{2, 2}}}, {"1", {{3, 2}}}, {"-1", {}}});
  b.equation({{"1", {{4, 2}}}, {"1", {{5, 2}}}, {"-1", {}}});
  const auto closing = [](const char* constant) {
    return SystemBuilder::polynomial(
        {{"1", {{0, 2}}}, {"1", {{1, 2}}}, {"-13/5", {{0, 1}, {2, 1}}}, {"-13/5", {{1, 1}, {3, 1}}}, {constant, {}}});
  };
  const System system = b.system();
  const auto found = express_by_equations(closing("6/5"), system);  // 1.69 − 0.49
  ASSERT_TRUE(found);
  const UpwardRounding rounding;
  EXPECT_TRUE(certify::sum(certify::implied_equation(system, *found), -1, closing("6/5")).monomials.empty());
  EXPECT_FALSE(express_by_equations(closing("12000000001/10000000000"), system));
  EXPECT_FALSE(express_by_equations(Polynomial{}, system));
  Polynomial irrational = closing("6/5");
  irrational.monomials[0] = Monomial(ExactNumber::apply(ConstantFunction::sqrt, 3), irrational.monomials[0].factors);
  EXPECT_FALSE(express_by_equations(irrational, system));
}

// Σ multiplier·equation with random decimals follows; with its constant moved a little it does not.
TEST(ImpliedEquations, FindRandomSumsOfDecimals) {
  std::mt19937 random(7);
  const auto decimal = [&] {
    return ExactNumber(std::uniform_int_distribution<long>(-999'999, 999'999)(random)) / ExactNumber(100'000);
  };
  for (int k = 0; k < 30; ++k) {
    System s;
    for (int j = 0; j < 3; ++j) s.variables.emplace_back("x" + std::to_string(j), VariableKind::length, -2, 2);
    for (int i = 0; i < 2; ++i) {
      Polynomial f;
      for (int j = 0; j < 3; ++j) {
        f.monomials.emplace_back(decimal(), std::vector<Factor>{{j, 2}});
        f.monomials.emplace_back(decimal(), std::vector<Factor>{{j, 1}});
      }
      f.monomials.emplace_back(decimal(), std::vector<Factor>{});
      s.equations.push_back(std::move(f));
    }
    const UpwardRounding rounding;
    ImpliedEquation planted;
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 3; ++j) planted.parts.push_back({i, decimal(), {{j, 1}}});
    Polynomial h = certify::implied_equation(s, planted);
    EXPECT_TRUE(express_by_equations(h, s)) << k;
    h.monomials.emplace_back(ExactNumber(1) / ExactNumber(1'000'000'000), std::vector<Factor>{});
    EXPECT_FALSE(express_by_equations(h, s)) << k;
  }
}

// Three planes that a random frame's nine coordinates lie on: the search with implied equations finds it, and the checker
// repeats them from the factors alone.
TEST(ImpliedEquations, LoseNoPlantedFrame) {
  std::mt19937 random(3);
  for (unsigned k = 0; k < 12; ++k) {
    const std::vector<ExactNumber> x = rotation(random);
    SystemBuilder b = frame();
    System system = b.system();
    for (int i = 0; i < 3; ++i) {
      Polynomial f;
      ExactNumber sum = 0;
      for (int j = 0; j < 9; ++j) {
        const ExactNumber c = ExactNumber(std::uniform_int_distribution<long>(-99, 99)(random)) / ExactNumber(100);
        if (c.is_zero()) continue;
        f.monomials.emplace_back(c, std::vector<Factor>{{j, 1}});
        sum = sum + c * x[static_cast<std::size_t>(j)];
      }
      if (!sum.is_zero()) f.monomials.emplace_back(-sum, std::vector<Factor>{});
      system.equations.push_back(std::move(f));
    }
    Options options;
    options.proof = k % 4 == 0;
    options.max_boxes = 20'000;
    const Cover cover = solve(system, options);
    EXPECT_TRUE(std::any_of(cover.reduction.begin(), cover.reduction.end(),
                            [](const ReductionStep& s) { return std::holds_alternative<ImpliedEquation>(s); }));
    std::vector<double> planted;
    for (const ExactNumber& c : x) planted.push_back(c.enclose().mid());
    EXPECT_TRUE(covers(cover, planted)) << k;
    const check::Report report = check::check(system, cover);
    EXPECT_TRUE(report.failures.empty()) << k;
    if (cover.proof && cover.complete()) {
      EXPECT_TRUE(report.proof.verified) << k;
    }
  }
}

TEST(ImpliedEquations, AreNamedAsTheStepsBeforeHaveLeftTheSystem) {
  // t is eliminated, and the equation that defines it goes; the frame's indices shift by one. A last equation keeps w.
  System system = frame().system();
  for (Polynomial& f : system.equations)
    for (Monomial& m : f.monomials)
      for (Factor& x : m.factors) ++x.variable;
  system.variables.insert(system.variables.begin(), Variable("t", VariableKind::length, -3, 3));
  system.equations.insert(system.equations.begin(), SystemBuilder::polynomial({{"1", {{0, 1}}}, {"-2", {{1, 1}}}}));
  system.equations.push_back(SystemBuilder::polynomial({{"1", {{7, 1}, {8, 1}}}, {"1/3", {{9, 1}}}, {"-1/5", {}}}));
  const UpwardRounding rounding;
  certify::Reduction r = reduce(system);
  ASSERT_EQ(r.kept.size(), 9u);
  add_implied_equations(
      {SystemBuilder::polynomial({{"1", {{0, 1}, {7, 1}}}, {"2", {{2, 1}, {8, 1}}}, {"2", {{3, 1}, {9, 1}}}})}, r);
  std::size_t implied_steps = 0;
  for (const ReductionStep& step : r.steps)
    if (const auto* of = std::get_if<ImpliedEquation>(&step)) {
      ++implied_steps;
      for (const auto& part : of->parts) {
        EXPECT_GE(part.equation, 1);
        EXPECT_LT(part.equation, 8 + static_cast<int>(r.system.implied.size()));
        for (const Factor& x : part.product)
          EXPECT_TRUE(std::find(r.kept.begin(), r.kept.end(), x.variable) != r.kept.end());
      }
    }
  EXPECT_EQ(implied_steps, r.system.implied.size());
  const std::vector<std::size_t> unproven = add_implied_equations({SystemBuilder::polynomial({{"1", {{0, 1}}}})}, r);
  EXPECT_EQ(unproven, std::vector<std::size_t>{0});
}

}  // namespace
}  // namespace corank::solve
