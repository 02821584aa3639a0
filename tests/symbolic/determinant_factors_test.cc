// Determinants in factors: random matrices whose blocks and factors are planted, against determinants of rational numbers.
#include "corank/symbolic/sets/determinant_factors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "corank/symbolic/model/model_error.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/velocity/exact_matrix.h"
#include "corank/tests/seeds.h"
#include "corank/tests/symbolic/evaluate.h"

namespace corank::symbolic {
namespace {

using Numbers = std::vector<std::vector<double>>;

class DeterminantFactors : public testing::Test {
 protected:
  DeterminantFactors() {
    for (int k = 0; k < kCoordinates; ++k) coordinates_.push_back(mechanism_.length("x" + std::to_string(k), -10, 10));
  }
  Expression linear() {
    Expression sum = number(random_(3) - 1);
    for (int k = 0; k < 2; ++k)
      sum = sum + number(1 + random_(4)) * coordinates_[static_cast<std::size_t>(random_(kCoordinates))];
    return sum;
  }
  static Expression number(int value) { return Expression(value); }
  int random(int below) { return random_(below); }

  static constexpr int kCoordinates = 5;
  Mechanism mechanism_{"planted"};
  std::vector<Expression> coordinates_;
  struct Random {
    std::mt19937 engine{20261124};
    int operator()(int below) { return static_cast<int>(engine() % static_cast<unsigned>(below)); }
  } random_;
};

TEST_F(DeterminantFactors, HoldNoneThatIsOneOnEveryCircle) {
  const Expression t = mechanism_.angle("t"), x = coordinates_[0];
  const ExpressionMatrix turned{.columns = {"a", "b"}, .rows = {{x * cos(t), -sin(t)}, {x * sin(t), cos(t)}}};
  const std::vector<Expression> factors = determinant_factors(mechanism_, turned);
  ASSERT_EQ(factors.size(), 1u);
  EXPECT_EQ(factors[0].text(), "x0");
}

TEST_F(DeterminantFactors, VanishWhereTheDeterminantDoesAndNowhereElse) {
  const int rounds = test::long_run() ? 400 : 130;
  int with_factors = 0;
  for (int round = 0; round < rounds; ++round) {
    // Blocks of one to three rows on the diagonal, anything right of them, all rows and columns shuffled.
    const auto n = static_cast<std::size_t>(2 + random(6));
    std::vector<std::size_t> block_of(n), rows(n), columns(n);
    for (std::size_t i = 1; i < n; ++i) block_of[i] = block_of[i - 1] + (random(2) == 0);
    std::iota(rows.begin(), rows.end(), 0U);
    std::iota(columns.begin(), columns.end(), 0U);
    std::shuffle(rows.begin(), rows.end(), random_.engine);
    std::shuffle(columns.begin(), columns.end(), random_.engine);
    ExpressionMatrix m;
    m.rows.assign(n, std::vector<Expression>(n, number(0)));
    for (std::size_t j = 0; j < n; ++j) m.columns.push_back("c" + std::to_string(j));
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) {
        const bool on = block_of[i] == block_of[j], right = block_of[i] < block_of[j] && random(3) == 0;
        if (on || right) m.rows[rows[i]][columns[j]] = random(4) == 0 ? number(1 + random(3)) : linear();
      }
    std::vector<Expression> factors;
    bool vanishes = false;
    try {
      factors = determinant_factors(mechanism_, m);
    } catch (const ModelError&) {
      vanishes = true;
    }
    with_factors += !factors.empty();
    for (int k = 0; k < 12; ++k) {
      Values at;
      for (int c = 0; c < kCoordinates; ++c) at["x" + std::to_string(c)] = random(41) - 20;
      Numbers values(n, std::vector<double>(n));
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) values[i][j] = static_cast<double>(evaluate(m.rows[i][j], at));
      const double det = determinant_of(values);
      if (vanishes) {
        EXPECT_NEAR(det, 0, 1e-6) << round;
        continue;
      }
      bool zero = false;
      for (const Expression& f : factors) zero = zero || evaluate(f, at) == 0;
      EXPECT_EQ(zero, std::abs(det) < 1e-6) << round << ' ' << det;
    }
  }
  EXPECT_GT(with_factors, rounds / 2);
}

TEST_F(DeterminantFactors, OfATriangularMatrixAreItsDiagonal) {
  ExpressionMatrix m;
  m.columns = {"a", "b", "c"};
  m.rows = {{coordinates_[0], coordinates_[3], coordinates_[4]},
            {number(0), coordinates_[1], coordinates_[0]},
            {number(0), number(0), number(3)}};
  const auto factors = determinant_factors(mechanism_, m);
  ASSERT_EQ(factors.size(), 2u);
  EXPECT_EQ(factors[0].text(), "x0");
  EXPECT_EQ(factors[1].text(), "x1");
}

// Of a determinant of 720 terms, irreducible: what is not factored in time stays one factor.
TEST_F(DeterminantFactors, AreOneWhereThereIsNoTime) {
  ExpressionMatrix m;
  for (int j = 0; j < 6; ++j) m.columns.push_back("c" + std::to_string(j));
  for (int i = 0; i < 6; ++i) {
    m.rows.emplace_back();
    for (int j = 0; j < 6; ++j)
      m.rows.back().push_back(mechanism_.length("z" + std::to_string(i) + std::to_string(j), -1, 1));
  }
  const auto hurried = determinant_factors(mechanism_, m, [] { return true; }), all = determinant_factors(mechanism_, m);
  ASSERT_EQ(hurried.size(), 1u);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(hurried[0].text(), all[0].text());
}

// (p² − q²)·x0: the values of p and q decide whether it is 0 everywhere; also where √2·√3 − √6 cannot be told from 0.
TEST_F(DeterminantFactors, ThatHoldConstantsAloneAreNotZero) {
  const Expression p = mechanism_.constant("p", 2), q = mechanism_.constant("q", 3), x = coordinates_[0];
  const Expression r = mechanism_.constant("r", sqrt(Expression(6)));
  const ExpressionMatrix m{.columns = {"a", "b"}, .rows = {{p * x, q * x}, {q, p}}};
  const ExpressionMatrix roots{.columns = {"a", "b"}, .rows = {{p * x, r * x}, {r, q * q * p}}};
  std::vector<Expression> constants;
  EXPECT_EQ(determinant_factors(mechanism_, m, {}, &constants).size(), 1u);
  EXPECT_EQ(constants.size(), 2u);
  EXPECT_EQ(determinant_factors(mechanism_, roots).size(), 1u);
  mechanism_.set_constant("q", -2);
  EXPECT_THROW(determinant_factors(mechanism_, m), DeterminantVanishes);
  mechanism_.set_constant("p", sqrt(Expression(2)));
  mechanism_.set_constant("q", sqrt(Expression(3)));
  EXPECT_EQ(determinant_factors(mechanism_, m).size(), 1u);
  EXPECT_THROW(determinant_factors(mechanism_, roots), DeterminantVanishes);
}

TEST_F(DeterminantFactors, SayWhereADeterminantHasTooManyTerms) {
  ExpressionMatrix m;
  for (int j = 0; j < 9; ++j) m.columns.push_back("c" + std::to_string(j));
  for (int i = 0; i < 9; ++i) {
    m.rows.emplace_back();
    for (int j = 0; j < 9; ++j)
      m.rows.back().push_back(mechanism_.length("y" + std::to_string(i) + std::to_string(j), -1, 1));
  }
  try {
    determinant_factors(mechanism_, m);
    FAIL();
  } catch (const DeterminantTooLarge& error) {
    EXPECT_NE(std::string(error.what()).find("20000 terms"), std::string::npos) << error.what();
  }
}

TEST(BlockTriangularForm, OrdersAPermutedStaircase) {
  const auto blocks = block_triangular_form({{0, 2}, {1}, {0, 1, 2}});
  ASSERT_TRUE(blocks);
  EXPECT_EQ(*blocks, (std::vector<SquareBlock>{{{0, 2}, {0, 2}}, {{1}, {1}}}));
}

TEST(BlockTriangularForm, IsNothingWhereTwoRowsFillOneColumn) { EXPECT_FALSE(block_triangular_form({{0}, {0}})); }

// An arm of two joints of which one length is asked for.
TEST(Loci, SayWhichMatrixOfARedundantRobotHasNoDeterminant) {
  const Mechanism arm = parse_model(
      "[SYSTEM VARS]\na ~\nb ~\nx : [-2, 2]\n[SYSTEM EQS]\nx = cos(a) + cos(b);\n"
      "[INPUTS] a, b\n[OUTPUTS] x\n",
      "arm.cuik");
  try {
    singularity_loci(arm);
    ADD_FAILURE() << "no error";
  } catch (const ModelError& error) {
    EXPECT_STREQ(error.what(),
                 "arm: L_z has 1 row and 2 columns, and so no determinant, whose sign tells aspects apart; expected as "
                 "many outputs as the mobility");
  }
}

}  // namespace
}  // namespace corank::symbolic
