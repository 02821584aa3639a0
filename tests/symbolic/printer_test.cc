// What is printed for programs must read back as the same system; what is printed for people is compared with the page as a
// whole.
#include "corank/symbolic/writing/printer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/tests/symbolic/evaluate.h"
#include "corank/tests/symbolic/reference.h"

namespace corank::symbolic {
namespace {
using ::testing::HasSubstr;

constexpr unsigned kPrinterSeed = 161803;

void expect_round_trip(const System& system) {
  const std::string text = to_cuik(system);
  SCOPED_TRACE(text);
  const System again = algebrize(plain_system(parse_model(text, "printed.cuik")));
  EXPECT_EQ(canonical(again.equations), canonical(system.equations));
  EXPECT_EQ(canonical(again.inequalities), canonical(system.inequalities));
  ASSERT_EQ(again.size(), system.size());
  for (std::size_t i = 0; i < system.variables.size(); ++i) {
    EXPECT_EQ(again.variables[i].name, system.variables[i].name);
    EXPECT_EQ(again.variables[i].lower, system.variables[i].lower);
    EXPECT_EQ(again.variables[i].upper, system.variables[i].upper);
    EXPECT_EQ(again.variables[i].domain, system.variables[i].domain);
  }
}

TEST(CuikPrinter, ReadsBackForEverySetAndKernelOfTheModels) {
  for (const char* name : {"dextar", "three_slider"}) {
    const Mechanism mechanism = reference(name);
    for (const auto set :
         {SingularitySet::cspace, SingularitySet::forward, SingularitySet::inverse, SingularitySet::cspace_singular})
      for (const auto side : {KernelSide::right, KernelSide::left})
        if (set != SingularitySet::cspace_singular || side == KernelSide::left)
          expect_round_trip(algebrize(singularity_system(mechanism, set, side)));
  }
}

TEST(CuikPrinter, ReadsBackForRandomMechanisms) {
  RandomMechanism generator(kPrinterSeed);
  for (int i = 0; i < 15; ++i) expect_round_trip(algebrize(plain_system(generator.make(2))));
}

TEST(CuikPrinter, ReadsBackWithRangesAndIrrationalCoefficients) {
  expect_round_trip(algebrize(plain_system(parse_model(
      "[CONSTANTS]\nk := 1 + sqrt(2)\n[SYSTEM VARS]\ntheta ~ [pi/7, 2]\nx : [-k, 1/3]\ny : [-1e-25, 1e30]\n[SYSTEM EQS]\n"
      "k*x^2 - k*sin(theta + 1/3) + (1 - sqrt(3)) = y/3;\nexp(-1)*x <= cos(pi/7)*y*x - 1e-25;\n",
      "m.cuik"))));
}

TEST(CuikPrinter, ReadsBackWithSinesAndCosinesOfLengths) {
  const System s = algebrize(plain_system(parse_model(
      "[SYSTEM VARS]\nx : [-2, 2]\nt : [0, 8*pi]\ntheta ~ [-pi, pi]\n[SYSTEM EQS]\n"
      "x*sin(t) = cos(t) + sin(theta)*cos(x);\nt*cos(x + t/3) = sin(1 - x) + sin(x + t/3) + t^2;\ncos(x) <= sin(t)*x;\n",
      "m.cuik")));
  expect_round_trip(s);
  EXPECT_THAT(to_cuik(s), HasSubstr("\n[DUMMY VARS]\nu_x_t   : [-2, 2 + 8/3*pi]\ns_t     : [-1, 1]\n"));
  EXPECT_THAT(to_cuik(s), HasSubstr("\n% definition of s_t\ns_t - sin(t) = 0;\n"));
}

TEST(CuikPrinter, PrintsTheThreeSlider) {
  EXPECT_EQ(to_cuik(algebrize(singularity_system(reference("three_slider"), SingularitySet::forward))),
            "% three_slider forward: polynomial equations\n"
            "\n"
            "[SYSTEM VARS]\n"
            "y_A : [-1, 1]\n"
            "y_B : [-0.8, 0.8]\n"
            "x_C : [-1, 1]\n"
            "% the kernel vector\n"
            "xi1 : [-1, 1]\n"
            "xi2 : [-1, 1]\n"
            "\n"
            "[SYSTEM EQS]\n"
            "% three_slider.cuik:18\n"
            "-1 + y_A^2 + x_C^2 = 0;\n"
            "% three_slider.cuik:19\n"
            "-0.64 + y_B^2 + x_C^2 = 0;\n"
            "% row 1 of L_y xi = 0\n"
            "2*x_C*xi2 = 0;\n"
            "% row 2 of L_y xi = 0\n"
            "2*y_B*xi1 + 2*x_C*xi2 = 0;\n"
            "% norm of xi\n"
            "-1 + xi1^2 + xi2^2 = 0;\n"
            "% half-space of xi\n"
            "0.7326*xi1 + 0.4652*xi2 >= 0;\n");
}

TEST(CuikPrinter, SaysWhatTheVariablesOfAnAngleMean) {
  EXPECT_THAT(to_cuik(algebrize(singularity_system(reference("dextar"), SingularitySet::cspace))),
              HasSubstr("% c_theta2 = cos(theta2), s_theta2 = sin(theta2), theta2 in [-3.14159, 3.14159] rad\n"));
}

TEST(TextPrinter, PrintsTheThreeSlider) {
  const Mechanism mechanism = reference("three_slider");
  EXPECT_EQ(to_text(derive(mechanism), std::vector{singularity_system(mechanism, SingularitySet::forward)}),
            "Φ(q) = 0\n"
            "  (1)  y_A^2 + x_C^2 - L1^2 = 0\n"
            "  (2)  y_B^2 + x_C^2 - L2^2 = 0\n"
            "\n"
            "Φ_q   2 x 3\n"
            "         y_A    y_B    x_C\n"
            "  (1)  2*y_A      0  2*x_C\n"
            "  (2)      0  2*y_B  2*x_C\n"
            "\n"
            "L_y   2 x 2\n"
            "         y_B    x_C\n"
            "  (1)      0  2*x_C\n"
            "  (2)  2*y_B  2*x_C\n"
            "\n"
            "L_z   2 x 2\n"
            "         y_A    x_C\n"
            "  (1)  2*y_A  2*x_C\n"
            "  (2)      0  2*x_C\n"
            "\n"
            "System three_slider forward\n"
            "  y_A : [-L1, L1]\n"
            "  y_B : [-L2, L2]\n"
            "  x_C : [-L1, L1]\n"
            "  xi1 : [-1, 1]\n"
            "  xi2 : [-1, 1]\n"
            "  (1)  y_A^2 + x_C^2 = L1^2           % three_slider.cuik:18\n"
            "  (2)  y_B^2 + x_C^2 = L2^2           % three_slider.cuik:19\n"
            "  (3)  2*x_C*xi2 = 0                  % row 1 of L_y xi = 0\n"
            "  (4)  2*y_B*xi1 + 2*x_C*xi2 = 0      % row 2 of L_y xi = 0\n"
            "  (5)  xi1^2 + xi2^2 = 1              % norm of xi\n"
            "  (6)  0.7326*xi1 + 0.4652*xi2 >= 0   % half-space of xi\n");
}

TEST(LatexPrinter, BalancesItsBracesAndEnvironments) {
  for (const char* name : {"dextar", "three_slider"}) {
    const Mechanism mechanism = reference(name);
    const std::string latex =
        to_latex(derive(mechanism), std::vector{singularity_system(mechanism, SingularitySet::inverse)});
    EXPECT_EQ(std::count(latex.begin(), latex.end(), '{'), std::count(latex.begin(), latex.end(), '}'));
    const auto occurrences = [&](const std::string& word) {
      int n = 0;
      for (std::size_t at = latex.find(word); at != std::string::npos; at = latex.find(word, at + 1)) ++n;
      return n;
    };
    EXPECT_EQ(occurrences("\\begin{pmatrix}"), 3);
    EXPECT_EQ(occurrences("\\end{pmatrix}"), 3);
    EXPECT_EQ(occurrences("\\begin{align}"), occurrences("\\end{align}"));
  }
}

TEST(LatexPrinter, PrintsTheKernelEquations) {
  const Mechanism mechanism = reference("three_slider");
  const std::string latex = to_latex(derive(mechanism), std::vector{singularity_system(mechanism, SingularitySet::forward)});
  EXPECT_THAT(latex, HasSubstr("\\xi_{1}^{2} + \\xi_{2}^{2} &= 1"));
  EXPECT_THAT(latex, HasSubstr("&\\ge 0"));
  EXPECT_THAT(latex, HasSubstr("2 y_{A} & 2 x_{C} \\\\"));
}

}  // namespace
}  // namespace corank::symbolic
