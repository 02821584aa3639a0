// Unit vectors and rotation matrices as declarations: their names, their equations, and that these say what they should.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/symbolic/writing/printer.h"
#include "corank/tests/symbolic/evaluate.h"

namespace corank::symbolic {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Matrix = std::array<std::array<long double, 3>, 3>;

constexpr unsigned kRotationSeed = 314159;

Mechanism model_with(const std::string& variables, const std::string& equations = "R_xx = 0;",
                     const std::string& rest = "") {
  return parse_model("[SYSTEM VARS]\n" + variables + "\n[SYSTEM EQS]\n" + equations + "\n" + rest, "m.cuik");
}

std::vector<std::string> coordinate_names(const Mechanism& m) {
  std::vector<std::string> list;
  for (const Coordinate& c : m.coordinates()) list.push_back(c.name);
  return list;
}

/// From a quaternion, not of unit length.
Matrix rotation_of(const std::array<long double, 4>& q) {
  const auto [a, b, c, d] = q;
  const long double n = a * a + b * b + c * c + d * d;
  return {{{(a * a + b * b - c * c - d * d) / n, 2 * (b * c - a * d) / n, 2 * (b * d + a * c) / n},
           {2 * (b * c + a * d) / n, (a * a - b * b + c * c - d * d) / n, 2 * (c * d - a * b) / n},
           {2 * (b * d - a * c) / n, 2 * (c * d + a * b) / n, (a * a - b * b - c * c + d * d) / n}}};
}

Values values_of(const Matrix& r) {
  Values values;
  const std::string axes = "xyz";
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) values[std::string("R_") + axes[i] + axes[j]] = r[i][j];
  return values;
}

long double largest_residual(const Mechanism& m, const Values& at) {
  long double largest = 0;
  for (const Constraint& c : m.constraints()) {
    if (c.note.empty()) continue;
    largest = std::max(largest, std::fabs(residual(c.relation, at)));
  }
  return largest;
}

TEST(UnitVector, DeclaresThreeLengthsAndTheirNorm) {
  const Mechanism m = model_with("x : [0, 1]\nw @ unit   % an axis\n", "w_x = x;");
  EXPECT_THAT(coordinate_names(m), ElementsAre("x", "w_x", "w_y", "w_z"));
  EXPECT_EQ(m.coordinates()[1].where.text(), "m.cuik:3:1");
  ASSERT_EQ(m.constraints().size(), 2u);
  EXPECT_EQ(m.constraints()[0].relation.text(), "w_x^2 + w_y^2 + w_z^2 = 1");
  EXPECT_EQ(m.constraints()[0].note, "w @ unit");
}

TEST(UnitVector, MayStandAloneInALineWithASemicolonAndInDummyVariables) {
  EXPECT_THAT(coordinate_names(model_with("w @ unit; x : [0, 1]", "w_x = x;")), ElementsAre("w_x", "w_y", "w_z", "x"));
  const Mechanism m = parse_model("[DUMMY VARS]\nw@unit\n[SYSTEM VARS]\nx : [0, 1]\n[SYSTEM EQS]\nx = w_x;\n", "m.cuik");
  for (const Coordinate& c : m.coordinates()) EXPECT_EQ(c.auxiliary, c.name != "x");
}

TEST(Composite, IsNamedAsAWholeAmongOutputsOrInputs) {
  const Mechanism m = model_with("R @ rotation\nw @ unit", "R_xx = w_x;", "[OUTPUTS] R\n[INPUTS] w_y, w_z");
  EXPECT_EQ(m.outputs().size(), 9u);
  EXPECT_THAT(m.inputs(), ElementsAre("w_y", "w_z"));
  EXPECT_THAT([] { model_with("w @ unit", "w_x = 0;", "[OUTPUTS] w_x, w"); },
              testing::ThrowsMessage<ModelError>(HasSubstr("the output 'w_x' is named twice")));
}

TEST(RotationMatrix, HasTheRotationsAsItsSolutionsAndNoReflection) {
  const Mechanism m = model_with("R @ rotation");
  EXPECT_THAT(coordinate_names(m), ElementsAre("R_xx", "R_xy", "R_xz", "R_yx", "R_yy", "R_yz", "R_zx", "R_zy", "R_zz"));
  EXPECT_EQ(m.constraints().size(), 7u);
  std::mt19937 engine(kRotationSeed);
  std::normal_distribution<double> normal;
  for (int k = 0; k < 200; ++k) {
    const Matrix r = rotation_of({normal(engine), normal(engine), normal(engine), normal(engine)});
    EXPECT_LT(largest_residual(m, values_of(r)), 1e-15L);
    Matrix mirrored = r;
    for (auto& row : mirrored) row[2] = -row[2];
    EXPECT_GT(largest_residual(m, values_of(mirrored)), 0.5L) << "a reflection";
  }
}

TEST(RotationMatrix, HasSixEquationsThatAreIndependentAtEveryRotation) {
  const Derivation d = derive(model_with("R @ rotation"));
  std::mt19937 engine(kRotationSeed);
  std::normal_distribution<double> normal;
  for (int k = 0; k < 50; ++k) {
    const Values at = values_of(rotation_of({normal(engine), normal(engine), normal(engine), normal(engine)}));
    // The Gram determinant of the six gradients.
    std::array<std::array<long double, 9>, 6> rows{};
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t j = 0; j < 9; ++j) rows[i][j] = evaluate(d.velocity.matrix.rows[i][j], at);
    long double determinant = 1;
    for (std::size_t i = 0; i < 6; ++i) {  // Gram and Schmidt
      long double square = 0;
      for (const long double entry : rows[i]) square += entry * entry;
      determinant *= square;
      for (std::size_t below = i + 1; below < 6; ++below) {
        long double product = 0;
        for (std::size_t j = 0; j < 9; ++j) product += rows[i][j] * rows[below][j];
        for (std::size_t j = 0; j < 9; ++j) rows[below][j] -= product / square * rows[i][j];
      }
    }
    EXPECT_GT(determinant, 1);
  }
}

TEST(RotationMatrix, CanBeBuiltInCpp) {
  Mechanism m;
  const auto r = m.rotation("R");
  const auto w = m.unit_vector("w");
  m.constrain(r[2] == w[0]);
  m.outputs(w);
  EXPECT_EQ(m.constraints().back().relation.text(), "R_xz = w_x");
  EXPECT_THAT(m.outputs(), ElementsAre("w_x", "w_y", "w_z"));
}

TEST(Composite, PrintsAsAFileThatReadsBack) {
  const System s = algebrize(plain_system(model_with("R @ rotation\nw @ unit", "R_xx + R_yy = w_x;")));
  const std::string text = to_cuik(s);
  EXPECT_THAT(text, HasSubstr("% m.cuik:2 (R @ rotation)\n"));
  const System again = algebrize(plain_system(parse_model(text, "m.cuik")));
  ASSERT_EQ(again.equations.size(), s.equations.size());
  for (std::size_t i = 0; i < s.equations.size(); ++i)
    EXPECT_EQ(again.equations[i].monomials.size(), s.equations[i].monomials.size());
  for (std::size_t j = 0; j < s.variables.size(); ++j) EXPECT_EQ(again.variables[j].name, s.variables[j].name);
}

}  // namespace
}  // namespace corank::symbolic
