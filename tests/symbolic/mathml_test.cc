// Expressions in MathML, checked as text with the tags of grouping left out.
#include "corank/symbolic/writing/mathml.h"

#include <gtest/gtest.h>

#include <regex>

#include "corank/symbolic/model/display_name.h"

namespace corank::symbolic {
namespace {

/// Without <mrow>, <mspace> and invisible signs, the elements' ends as "/".
std::string short_form(const std::string& html) {
  std::string text = std::regex_replace(html, std::regex("</?mrow>|<mspace[^>]*>|&#x206[12];"), "");
  text = std::regex_replace(text, std::regex("<mo></mo>"), "");
  return std::regex_replace(text, std::regex("</[a-z]+>"), "/");
}

std::string of(const char* expression) { return short_form(mathml(Expression(expression))); }

TEST(MathMl, SetsNamesWithGreekLettersAndSubscripts) {
  EXPECT_EQ(of("theta2"), "<msub><mi>θ/<mn>2//");
  EXPECT_EQ(of("J3x"), "<msub><mi>J/<mn>3x//");
  EXPECT_EQ(of("y_A"), "<msub><mi>y/<mi>A//");
  EXPECT_EQ(of("pi"), "<mi>π/");
}

TEST(MathMl, SetsSumsWithMinusSigns) { EXPECT_EQ(of("a - b + 2"), "<mi>a/<mo>−/<mi>b/<mo>+/<mn>2/"); }

TEST(MathMl, KeepsTheParenthesesThatMeanSomething) {
  EXPECT_EQ(of("a - (b + c)"), "<mi>a/<mo>−/<mo>(/<mi>b/<mo>+/<mi>c/<mo>)/");
  EXPECT_EQ(of("(a + b)^2"), "<msup><mo>(/<mi>a/<mo>+/<mi>b/<mo>)/<mn>2//");
  EXPECT_EQ(of("a*(-b)"), "<mi>a/<mo>(/<mo>−/<mi>b/<mo>)/");
}

TEST(MathMl, SetsFunctionsRootsFractionsAndPowers) {
  EXPECT_EQ(of("y_A^2"), "<msubsup><mi>y/<mi>A/<mn>2//");
  EXPECT_EQ(of("cos(t)^2"), "<msup><mi>cos/<mn>2//<mi>t/");
  EXPECT_EQ(of("sin(t + 1)"), "<mi>sin/<mo>(/<mi>t/<mo>+/<mn>1/<mo>)/");
  EXPECT_EQ(of("asin(a)"), "<mi>arcsin/<mi>a/");
  EXPECT_EQ(of("sqrt(3)/2"), "<mfrac><msqrt><mn>3//<mn>2//");
  EXPECT_EQ(of("x*2"), "<mi>x/<mo>·/<mn>2/");
  EXPECT_EQ(of("1e-6"), "<mn>1/<mo>·/<msup><mn>10/<mo>−/<mn>6//");
}

TEST(MathMl, SetsRelationsAndMatrices) {
  EXPECT_EQ(short_form(mathml(Expression("x") <= Expression(1))), "<mi>x/<mo>≤/<mn>1/");
  const ExpressionMatrix matrix{{"x", "y"}, {{Expression(1), Expression("a")}}};
  EXPECT_EQ(short_form(mathml(matrix)), "<mtable class=\"matrix\"><mtr><mtd><mn>1//<mtd><mi>a////");
}

TEST(DisplayName, EscapesAndSplitsNames) {
  EXPECT_EQ(html_name("theta_A_1"), "<i>θ</i><sub>A,1</sub>");
  EXPECT_EQ(html_name("_x"), "<i>_x</i>");
  EXPECT_EQ(html_text("a<b & \"c\""), "a&lt;b &amp; &quot;c&quot;");
}

TEST(MathMl, KeepsAFunctionApartFromTheFactorBeforeIt) {
  const std::string gap = "&#x2062;</mo><mspace width=\"0.17em\"/>";
  EXPECT_NE(mathml(Expression("r*cos(p)")).find(gap), std::string::npos);
  EXPECT_NE(mathml(Expression("cos(p)*sin(q)")).find(gap), std::string::npos);
  EXPECT_NE(mathml(Expression("r*cos(p)^2")).find(gap), std::string::npos);
  EXPECT_EQ(mathml(Expression("r*p")).find(gap), std::string::npos);
}

}  // namespace
}  // namespace corank::symbolic
