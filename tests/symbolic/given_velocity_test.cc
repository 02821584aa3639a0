// Mechanisms that bring their own velocity equation: L, its roles, what is asked of it, its scales and how it is printed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/symbolic/sets/kernel_scale.h"
#include "corank/symbolic/sets/singularity_system.h"
#include "corank/symbolic/writing/printer.h"

namespace corank::symbolic {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

// A crank of length r turns by t and pushes a block at x through a rod of length l at the angle p.
const std::string kCrank =
    "[CONSTANTS]\nu := 1\nr := 3/10*u\nl := 6/5*u\n[SYSTEM VARS]\nt ~\np ~\nx :\n[SYSTEM EQS]\nr*cos(t) + l*cos(p) = x;\n"
    "r*sin(t) + l*sin(p) = 0;\n";

Mechanism crank(const std::string& rates, const std::string& rows) {
  return parse_model(kCrank + "[RATES]\n" + rates + "[VELOCITY EQS]\n" + rows, "crank.cuik");
}
Mechanism crank() {
  return crank("v : output\nwt ~ input\nwp ~ passive\n",
               "v = -r*sin(t)*wt - l*sin(p)*wp;\nr*cos(t)*wt + l*cos(p)*wp = 0;\n");
}

std::string fault(const std::function<void()>& work) {
  try {
    work();
  } catch (const ModelError& error) {
    return error.what();
  }
  return "none";
}

TEST(GivenVelocity, HasTheColumnsAndRolesOfItsRates) {
  const Mechanism m = crank();
  EXPECT_FALSE(m.is_plain_system());
  EXPECT_THAT(m.inputs(), IsEmpty());
  const Derivation d = derive(m);
  EXPECT_EQ(d.phi.size(), 2u);
  EXPECT_TRUE(d.velocity.given);
  EXPECT_THAT(d.velocity.matrix.columns, ElementsAre("v", "wt", "wp"));
  EXPECT_THAT(d.velocity.matrix.roles, ElementsAre(Role::output, Role::input, Role::passive));
  EXPECT_EQ(d.velocity.matrix.rows[0][0].text(), "1");
  EXPECT_EQ(d.velocity.matrix.rows[0][1].text(), "r*sin(t)");
  EXPECT_EQ(d.velocity.matrix.rows[1][2].text(), "l*cos(p)");
  EXPECT_EQ(d.velocity.where[1].text(), "crank.cuik:18:1");
  EXPECT_THAT(d.velocity.without(std::array{Role::input}).columns, ElementsAre("v", "wp"));
}

TEST(GivenVelocity, IsBuiltInCppAsWell) {
  Mechanism m("slide");
  const Expression x = m.length("x", 0, 1), y = m.length("y", 0, 1);
  m.constrain(x * y == Expression("1/4"));
  const Expression vx = m.rate("vx", CoordinateKind::length, Role::input),
                   vy = m.rate("vy", CoordinateKind::length, Role::output);
  m.velocity(y * vx + x * vy == Expression(0));
  EXPECT_EQ(derive(m).velocity.matrix.rows[0][0].text(), "y");
  EXPECT_THROW(m.velocity(vx <= vy), ModelError);
  EXPECT_THROW(m.rate("x", CoordinateKind::length, Role::input), ModelError);
  EXPECT_THROW(m.length("vx", 0, 1), ModelError);
}

TEST(GivenVelocity, OfPassiveRatesAloneIsAPlainSystem) {
  EXPECT_TRUE(crank("a ~ passive\nb ~ passive\n", "a = b;\n").is_plain_system());
}

TEST(GivenVelocity, IsAskedForAsManyInputRatesAsTheMobilitySays) {
  const auto forward = [](const Mechanism& m) { return fault([&] { singularity_system(m, SingularitySet::forward); }); };
  EXPECT_EQ(forward(crank()), "none");
  EXPECT_EQ(forward(crank("a ~ output\nb ~ passive\n", "a = b;\n")),
            "crank.cuik: the model names no input rates, which the forward singularities need; expected a line `name ~ "
            "input` in [RATES]");
  EXPECT_EQ(forward(crank("a ~ input\nb ~ input\nc ~ passive\n", "a = b + c;\nb = c;\n")), "none") << "redundantly actuated";
  EXPECT_EQ(forward(crank("a ~ input\nb ~ input\nc ~ passive\n", "a = b;\nb = c;\n")), "none") << "tied";
  EXPECT_EQ(forward(crank("a ~ input\nb ~ output\nc ~ output\n", "a = b + c;\nb = c + a;\n")),
            "crank.cuik:14:1: the mechanism has 3 rates and 2 velocity equations, so mobility 1, but 2 output rates: "
            "they are not independent; expected 1 output rate, or 1 equation in output rates only that ties them");
  EXPECT_EQ(forward(crank("a ~ input\nb ~ input\n", "a = b;\n")),
            "crank.cuik:13:1: every rate is an input rate, so nothing can move when they are locked; expected rates "
            "that are not input rates");
  const Mechanism m = crank();
  EXPECT_THAT(fault([&] { singularity_system(m, SingularitySet::cspace_singular, KernelSide::right); }),
              HasSubstr("L has 2 rows and 3 columns, so every configuration has a right kernel; expected the left kernel"));
}

TEST(GivenVelocity, HasCoefficientsThatCanBeMadePolynomials) {
  const Mechanism m = crank("v : output\nwt ~ input\nwp ~ passive\n", "v = t*wp;\nwt = wp;\n");
  EXPECT_THAT(fault([&] { algebrize(singularity_system(m, SingularitySet::forward)); }), HasSubstr("crank.cuik:17:"));
}

// The kernel of L's own rows, where inputs and outputs of the coordinates do not matter.
TEST(GivenVelocity, MakesTheRowsOfTheSystem) {
  const TrigonometricSystem forward = singularity_system(crank(), SingularitySet::forward);
  EXPECT_THAT(forward.kernel_unknowns, ElementsAre("xi1", "xi2"));
  EXPECT_EQ(forward.equations[2].relation.text(), "xi1 + l*sin(p)*xi2 = 0");
  EXPECT_EQ(forward.equations[2].source, "row 1 of L_y xi = 0");
  EXPECT_EQ(singularity_system(crank(), SingularitySet::cspace_singular).equations[2].source, "row 1 of L^T xi = 0");
}

TEST(GivenVelocity, LosesPassiveRatesToReciprocalRows) {
  const Mechanism m = crank();
  const KernelQuestion kernel = without_passive_rates(m, kernel_question(m, SingularitySet::forward));
  EXPECT_THAT(kernel.passive.eliminated, ElementsAre(1));
  // The role is the rate's, not that of a coordinate with the same place.
  const Mechanism other = crank("v : output\nwt ~ input\nwp ~ output\nz ~ passive\nu1 ~ input\n",
                                "v = -r*sin(t)*wt - l*sin(p)*wp;\nr*cos(t)*wt + l*cos(p)*wp = 0;\nz = wt;\nu1 = wt;\n");
  EXPECT_THAT(eliminate_passive_rates(other, derive(other).velocity.matrix).eliminated, IsEmpty());
}

// v is counted in eight times the crank's length, the largest lever arm: r·sin t, and l·sin p = -r·sin t. With another
// unit the number alone changes.
TEST(GivenVelocity, ScalesLinearRatesByTheLeverArmsOfTheirRows) {
  Mechanism m = crank();
  EXPECT_THAT(kernel_scales(m, SingularitySet::forward), ElementsAre("12/5", "1"));
  m.set_constant("u", Expression("1000"));
  EXPECT_THAT(kernel_scales(m, SingularitySet::forward), ElementsAre("2400", "1"));
  m.set_constant("u", Expression("1/1000"));
  EXPECT_THAT(kernel_scales(m, SingularitySet::forward), ElementsAre("3/1250", "1"));
  EXPECT_THAT(kernel_scales(m, SingularitySet::inverse), IsEmpty()) << "angles alone";
}

TEST(GivenVelocity, ScalesLeftKernelsByRowsWithLengthsAgainstRowsWithout) {
  const auto model = [](const std::string& u) {
    Mechanism m = crank("v : output\nwt ~ input\nwp ~ passive\nw ~ passive\n",
                        "w = wt + wp;\nv = -r*sin(t)*wt - l*sin(p)*wp;\nr*cos(t)*wt + l*cos(p)*wp = 0;\n");
    m.set_constant("u", Expression(u));
    return kernel_scales(m, SingularitySet::cspace_singular);
  };
  EXPECT_THAT(model("1"), ElementsAre("1", "33/10", "83/100"));
  EXPECT_THAT(model("1000"), ElementsAre("1", "33/10000", "83/100000"));
}

TEST(GivenVelocity, GivesLinearRatesFarFromAnglesTheSizeOfTheirNeighbours) {
  const Mechanism m =
      crank("a : input\nb : passive\nc : passive\nd : output\nw ~ passive\n", "b = l*w;\nc = 2*b;\nd = a;\na = b;\n");
  // b: l; c: what it is where b is l; d, which nothing ties to w with a locked: the largest of these.
  EXPECT_THAT(kernel_scales(m, SingularitySet::forward), ElementsAre("19/2", "19", "19", "1"));
}

TEST(GivenVelocity, IsPrintedWithItsRates) {
  const Mechanism m = crank();
  const TrigonometricSystem system = singularity_system(m, SingularitySet::cspace);
  const std::string text = to_text(derive(m), std::vector{system}), latex = to_latex(derive(m), std::vector{system});
  EXPECT_THAT(text, HasSubstr("L (given)   2 x 3\n       v        wt        wp\n"));
  EXPECT_THAT(text, HasSubstr("L_y   2 x 2\n       v        wp\n"));
  EXPECT_THAT(text, Not(HasSubstr("Φ_q")));
  EXPECT_THAT(latex, HasSubstr("% columns: v wt wp\n\\[ L = "));
  EXPECT_THAT(latex, Not(HasSubstr("\\Phi_q")));
}

}  // namespace
}  // namespace corank::symbolic
