// Where requirements are met, as inequalities: the sign of a bordered determinant.
#include "corank/symbolic/sets/required_space.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

#include "corank/symbolic/model/evaluate.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/tests/seeds.h"

namespace corank::symbolic {
namespace {

// A planar arm of two links, each with its absolute angle.
Mechanism arm(const std::string& require) {
  Mechanism model = parse_model(
      "[CONSTANTS]\na := 1\nb := 3/4\n[SYSTEM VARS]\nx : [-2, 2]\ny : [-2, 2]\ns ~ [-pi, pi]\nt ~ [-pi, pi]\n[SYSTEM EQS]\n"
      "x = a*cos(s) + b*cos(t);\ny = a*sin(s) + b*sin(t);\n[INPUTS] s, t\n[OUTPUTS] x, y\n",
      "arm.cuik");
  model.require(require);
  return model;
}

TEST(RequiredSpace, HasTheSignOfTheFormsDeterminant) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> angle(-M_PI, M_PI);
  for (const double most : {0.5, 1.0, 1.5}) {
    const RequiredSpace space = required_space(arm("amplification(outputs) <= " + std::to_string(most)));
    ASSERT_EQ(space.inequalities.size(), 1u);
    const Relation& r = space.inequalities[0].relation;
    for (unsigned k = 0; k < test::seeds(200); ++k) {
      const double s = angle(random), t = angle(random);
      const double x = std::cos(s) + 0.75 * std::cos(t), y = std::sin(s) + 0.75 * std::sin(t);
      // JᵀJ = [a², ab c; ab c, b²], c the cosine between the links.
      const double ab = 0.75 * std::cos(s - t), b = 0.5625;
      const double determinant = (most * most - 1) * (most * most - b) - ab * ab;
      const std::map<std::string, double> at{{"a", 1}, {"b", 0.75}, {"s", s}, {"t", t}, {"x", x}, {"y", y}};
      const double value = evaluate(r.lhs, at) - evaluate(r.rhs, at);
      if (std::fabs(determinant) < 1e-9) continue;
      EXPECT_EQ(value > 0, determinant > 0) << s << " " << t << " " << most;
    }
  }
}

// A lever that doubles every rate.
TEST(RequiredSpace, OfAConstantIsNoConditionOrAnError) {
  const auto lever = [](const std::string& require) {
    Mechanism model = parse_model(
        "[SYSTEM VARS]\nx : [-2, 2]\ny : [-4, 4]\n[SYSTEM EQS]\ny = 2*x;\n[INPUTS] x\n[OUTPUTS] y\n", "lever.cuik");
    model.require(require);
    return required_space(model);
  };
  EXPECT_TRUE(lever("amplification(outputs) <= 3").inequalities.empty());
  EXPECT_THROW(lever("amplification(outputs) <= 2"), ModelError);
  EXPECT_THROW(lever("amplification(outputs) <= 1"), ModelError);
  EXPECT_EQ(lever("x <= 1").inequalities.size(), 1u);
}

// The same lever beside another coordinate: one factor is 0 by the values of constants.
TEST(RequiredSpace, AtItsLimitByConstantsIsAnError) {
  for (const std::string k : {"2", "sqrt(2)", "2*cos(pi/4)"}) {
    Mechanism model = parse_model("[CONSTANTS]\nk := " + k +
                                      "\n[SYSTEM VARS]\nx : [-2, 2]\nu : [-2, 2]\ny : [-4, 4]\nz : [-9, 9]\n"
                                      "[SYSTEM EQS]\ny = k*x;\nz = u^2;\n[INPUTS] x, u\n[OUTPUTS] y, z\n",
                                  "lever.cuik");
    model.require("amplification(outputs) <= " + k);
    EXPECT_THROW(required_space(model), ModelError) << k;
  }
}

TEST(RequiredSpace, OfIndependentConditionsHasThemAsFunctions) {
  Mechanism model = parse_model(
      "[SYSTEM VARS]\nv ~ [-pi, pi]\nw ~ [-pi, pi]\nx : [-2, 2]\ny : [-2, 2]\n[SYSTEM EQS]\nx = sin(v);\ny = sin(w);\n"
      "[INPUTS] v, w\n[OUTPUTS] x, y\n",
      "waves.cuik");
  model.require("amplification(outputs) <= 1/2");
  const RequiredSpace space = required_space(model);
  EXPECT_TRUE(space.inequalities.empty());
  EXPECT_EQ(space.functions.size(), 4u) << "1 ± 2 cos v, 1 ± 2 cos w";
}

}  // namespace
}  // namespace corank::symbolic
