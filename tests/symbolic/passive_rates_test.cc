#include "corank/symbolic/velocity/passive_rates.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/sets/singularity_system.h"
#include "corank/tests/symbolic/evaluate.h"

namespace corank::symbolic {
namespace {

using testing::ElementsAre;

PassiveRates rates(const Mechanism& m, SingularitySet set) {
  return eliminate_passive_rates(m, kernel_question(m, set).matrix);
}
Mechanism repository_model(const std::string& name) { return read_model(CORANK_SOURCE_DIR "/models/" + name + ".cuik"); }

// |det M(q)| by elimination with pivots.
double size_of_determinant(const ExpressionMatrix& m, const Values& at) {
  std::vector<std::vector<long double>> t;
  for (const auto& row : m.rows) {
    t.emplace_back();
    for (const Expression& e : row) t.back().push_back(evaluate(e, at));
  }
  long double product = 1;
  for (std::size_t k = 0; k < t.size(); ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k; i < t.size(); ++i)
      if (std::fabs(t[i][k]) > std::fabs(t[pivot][k])) pivot = i;
    std::swap(t[k], t[pivot]);
    product *= t[k][k];
    for (std::size_t i = k + 1; i < t.size() && t[k][k] != 0; ++i)
      for (std::size_t j = t.size(); j-- > k;) t[i][j] -= t[i][k] / t[k][k] * t[k][j];
  }
  return static_cast<double>(std::fabs(product));
}

const std::string kTwoLinks = "[SYSTEM VARS]\nx : [-2, 2]\ny : [-2, 2]\nt ~ [-pi, pi]\np ~ [-pi, pi]\n[SYSTEM EQS]\n";

TEST(PassiveRates, OfTheDextarLeaveTheDirectionsOfItsDistalLinks) {
  const Mechanism m = repository_model("dextar");
  const PassiveRates forward = rates(m, SingularitySet::forward);
  EXPECT_THAT(forward.eliminated, ElementsAre(2, 3)) << "theta3 and theta4, of J3x, J3y, theta3, theta4";
  for (const std::size_t j : forward.eliminated) {
    std::size_t rows = 0;
    for (const auto& row : forward.matrix.rows) rows += !same_tree(row[j], Expression(0));
    EXPECT_EQ(rows, 1u);
  }
  EXPECT_EQ(rates(m, SingularitySet::inverse).eliminated.size(), 2u);
}

// det M up to sign is that of T M: the rows of the two have the same kernels, at any q, on the constraints or not.
TEST(PassiveRates, LeaveTheKernelAsItIs) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> pick(-3, 3);
  std::size_t compared = 0;
  for (const char* name : {"dextar", "3rrr", "spherical_five_bar"})
    for (const SingularitySet set : {SingularitySet::forward, SingularitySet::inverse}) {
      const Mechanism m = repository_model(name);
      const ExpressionMatrix before = kernel_question(m, set).matrix;
      const PassiveRates after = eliminate_passive_rates(m, before);
      if (after.eliminated.empty()) continue;
      ++compared;
      for (int trial = 0; trial < 20; ++trial) {
        Values at;
        for (const Constant& c : m.constants()) at[c.name] = evaluate(c.value, at);
        for (const Coordinate& c : m.coordinates()) at[c.name] = pick(random);
        const double a = size_of_determinant(before, at), b = size_of_determinant(after.matrix, at);
        EXPECT_NEAR(a, b, 1e-9 * (1 + a)) << name;
      }
    }
  EXPECT_GE(compared, 4u);
}

TEST(PassiveRates, AreEliminatedWhereASlidesDirectionHoldsThem) {
  // A leg of length r, driven by its angle t: the passive length's column is (cos t, sin t).
  const Mechanism m = parse_model(
      "[SYSTEM VARS]\nx : [-2, 2]\ny : [-2, 2]\nr : [1, 2]\nt ~ [-pi, pi]\n[SYSTEM EQS]\nx = r*cos(t);\ny = r*sin(t);\n"
      "[INPUTS] t\n[OUTPUTS] x\n",
      "leg.cuik");
  const PassiveRates found = eliminate_passive_rates(m, derive(m).velocity.without(std::vector<Role>{Role::output}));
  EXPECT_THAT(found.eliminated, testing::SizeIs(1));
}

TEST(PassiveRates, StayWhereTheyCannotBeEliminated) {
  const auto of = [](const std::string& equations) {
    const Mechanism m = parse_model(kTwoLinks + equations + "[INPUTS] t\n[OUTPUTS] x\n", "m.cuik");
    return eliminate_passive_rates(m, derive(m).velocity.matrix).eliminated.size();
  };
  EXPECT_EQ(of("x = cos(t) + 1/2*cos(p);\ny = sin(t) + 1/2*sin(p);\n"), 1u);
  EXPECT_EQ(of("x = cos(t) + 1/2*cos(p);\ny = sin(t) + 1/3*sin(p);\n"), 0u) << "an ellipse";
  EXPECT_EQ(of("x = cos(t) + sqrt(2)*cos(p);\ny = sin(t) + sqrt(2)*sin(p);\n"), 0u) << "an irrational length";
  EXPECT_EQ(of("x = cos(t) + y*cos(p);\ny = sin(t) + y*sin(p);\n"), 0u) << "a length that may vanish";
  EXPECT_EQ(of("x = cos(t) + p;\ny = sin(t) + 1/2*sin(p);\n"), 0u);
}

TEST(PassiveRates, AreNamedByTheRowsOfTheSystem) {
  const Mechanism m = repository_model("dextar");
  const KernelQuestion kernel = without_passive_rates(m, kernel_question(m, SingularitySet::forward));
  const TrigonometricSystem system = singularity_system(m, kernel, {}, 1);
  EXPECT_TRUE(system.passive_rates_eliminated);
  std::vector<std::string> sources;
  for (const auto& e : system.equations)
    if (e.of_kernel) sources.push_back(e.source);
  EXPECT_THAT(sources, ElementsAre("row 1 of L_y xi = 0, without the rates of theta3, theta4",
                                   "row 2 of L_y xi = 0, without the rate of theta3, gives the rate of theta4",
                                   "row 3 of L_y xi = 0, without the rate of theta3",
                                   "row 4 of L_y xi = 0, gives the rate of theta3", "norm of xi"));
  EXPECT_FALSE(singularity_system(m, SingularitySet::forward).passive_rates_eliminated);
}

}  // namespace
}  // namespace corank::symbolic
