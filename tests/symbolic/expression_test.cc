#include "corank/symbolic/model/expression.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "corank/symbolic/model/model_file.h"

namespace corank::symbolic {
namespace {

using Kind = Expression::Kind;

TEST(Expression, PrintsAsAPaperWritesIt) {
  const Expression d = "d", l2 = "l2", l5 = "l5", theta2 = "theta2", theta5 = "theta5";
  const Expression e = d + l2 * cos(theta2) - l5 * cos(theta5);
  EXPECT_EQ(e.text(), "d + l2*cos(theta2) - l5*cos(theta5)");
  EXPECT_EQ(e.latex(), R"(d + l_{2}\cos\theta_{2} - l_{5}\cos\theta_{5})");
}

TEST(Expression, CxxOperatorsBuildTheTreeThatTheTextParsesTo) {
  const Expression x = "x", y = "y", z = "z";
  EXPECT_TRUE(same_tree(x + y - z, Expression("x + y - z")));
  EXPECT_TRUE(same_tree(x * y / z * 2, Expression("x*y/z*2")));
  EXPECT_TRUE(same_tree(-pow(x, 2), Expression("-x^2")));
  EXPECT_TRUE(same_tree(x + (y + z), Expression("x + (y + z)")));
  EXPECT_FALSE(same_tree(x + (y + z), Expression("x + y + z")));
  EXPECT_TRUE(same_tree(sqrt(x) + tan(pi()), Expression("sqrt(x) + tan(pi)")));
  EXPECT_TRUE(same_tree(Expression(-3), Expression("-3")));
}

TEST(Expression, ASumOrAProductIsOneNodeWhateverItsLength) {
  EXPECT_EQ(Expression("a + b - c + d").operands().size(), 4u);
  EXPECT_EQ(Expression("a*b*c").operands().size(), 3u);
  EXPECT_EQ(Expression("a - b").operands()[1].kind(), Kind::negation);
}

TEST(Expression, MinusBindsWeakerThanPowersAndProducts) {
  const Expression square = "-x^2";
  ASSERT_EQ(square.kind(), Kind::negation);
  EXPECT_EQ(square.operands()[0].kind(), Kind::power);
  const Expression product = "-x*y";
  ASSERT_EQ(product.kind(), Kind::negation);
  EXPECT_EQ(product.operands()[0].kind(), Kind::product);
  EXPECT_EQ(Expression("(-x)*y").kind(), Kind::product);
}

TEST(Expression, PowersAssociateToTheRightAndQuotientsToTheLeft) {
  EXPECT_TRUE(same_tree("x^y^z", "x^(y^z)"));
  EXPECT_FALSE(same_tree("x^y^z", "(x^y)^z"));
  EXPECT_TRUE(same_tree("x/y/z", "(x/y)/z"));
  EXPECT_TRUE(same_tree("2^-1", "2^(-1)"));
  EXPECT_TRUE(same_tree("2^-x^2", "2^(-(x^2))"));
}

TEST(Expression, PrintsFewParentheses) {
  for (const char* text :
       {"(x + y)*z", "x*y/z", "x/(y*z)", "x^2^3", "(x^2)^3", "x^(-1)", "x - (y - z)", "-(x + y)", "x*(-y)", "a - (-b)",
        "(-x)^2", "x/y*z", "x*(y/z)", "sin(x + y)^2", "x/(y/z)", "(x*y)*z", "(-x)/y", "-x/y"}) {
    EXPECT_EQ(Expression(text).text(), text);
  }
  EXPECT_EQ(Expression("((x)) + ((y*(z)))").text(), "x + y*z");
}

TEST(Expression, KeepsNumbersAsWritten) {
  EXPECT_EQ(Expression("0.90").name(), "0.90");
  EXPECT_EQ(Expression("1e-6").name(), "1e-6");
  EXPECT_EQ(Expression(".5").name(), "0.5");
  EXPECT_EQ(Expression("5.").name(), "5");
  EXPECT_EQ(Expression("1E+3").name(), "1e3");
  EXPECT_EQ(Expression::number("-2.5").text(), "-2.5");
  EXPECT_EQ(Expression::number("-2.5").kind(), Kind::negation);
  EXPECT_EQ(Expression(std::numeric_limits<int>::min()).text(), "-2147483648");
}

TEST(Expression, MentionsTheNamesInIt) {
  const Expression e = "a + 2*cos(theta_1)^b";
  EXPECT_TRUE(e.mentions("theta_1"));
  EXPECT_TRUE(e.mentions("b"));
  EXPECT_FALSE(e.mentions("theta"));
  EXPECT_FALSE(e.mentions("cos"));
}

TEST(Expression, BuildsRelations) {
  const Expression x = "x";
  EXPECT_EQ((x == 1).text(), "x = 1");
  EXPECT_EQ((x * x <= 4).text(), "x*x <= 4");
  EXPECT_EQ((x >= -x).text(), "x >= -x");
}

TEST(Expression, SetsNamesInLatex) {
  EXPECT_EQ(latex_name("theta2"), R"(\theta_{2})");
  EXPECT_EQ(latex_name("J3x"), "J_{3x}");
  EXPECT_EQ(latex_name("y_A"), "y_{A}");
  EXPECT_EQ(latex_name("d"), "d");
  EXPECT_EQ(latex_name("xi4"), R"(\xi_{4})");
  EXPECT_EQ(latex_name("Omega_0"), R"(\Omega_{0})");
  EXPECT_EQ(latex_name("q1_lim"), R"(q_{1,\mathrm{lim}})");
  EXPECT_EQ(latex_name("ct2"), R"(\mathit{ct}_{2})");
  EXPECT_EQ(latex_name("_a"), R"(\mathtt{\_a})");
}

TEST(Expression, SetsOperationsInLatex) {
  const auto latex = [](const char* text) { return Expression(text).latex(); };
  EXPECT_EQ(latex("4/5"), R"(\frac{4}{5})");
  EXPECT_EQ(latex("sqrt(x + 1)"), R"(\sqrt{x + 1})");
  EXPECT_EQ(latex("cos(theta2 + theta3)"), R"(\cos(\theta_{2} + \theta_{3}))");
  EXPECT_EQ(latex("cos(pi/4)"), R"(\cos\left(\frac{\pi}{4}\right))");
  EXPECT_EQ(latex("cos(x)^2"), R"(\cos^{2} x)");
  EXPECT_EQ(latex("cos(x)^-1"), R"((\cos x)^{-1})");
  EXPECT_EQ(latex("2*3*x*y"), R"(2 \cdot 3 x y)");
  EXPECT_EQ(latex("sin(theta)*x"), R"(\sin\theta \cdot x)");
  EXPECT_EQ(latex("sin(theta)*cos(theta)"), R"(\sin\theta \cos\theta)");
  EXPECT_EQ(latex("2*(x + y)"), "2(x + y)");
  EXPECT_EQ(latex("(x + y)^2"), "(x + y)^{2}");
  EXPECT_EQ(latex("y_A^2"), "y_{A}^{2}");
  EXPECT_EQ(latex("1e-3*x"), R"(1 \cdot 10^{-3} x)");
  EXPECT_EQ(latex("asin(x)"), R"(\arcsin x)");
  EXPECT_EQ(latex("abs(x)"), R"(\left|x\right|)");
  EXPECT_EQ(latex("-(x - y)"), "-(x - y)");
}

TEST(Expression, SaysWhatIsWrongWithAText) {
  const auto message = [](const char* text) -> std::string {
    try {
      return Expression(text).text();
    } catch (const ModelError& error) {
      return error.what();
    }
  };
  EXPECT_EQ(message("l2*cos(theta"),
            "'l2*cos(theta':1:13: found the end of the text inside the parentheses opened in 1:7; "
            "expected an operator or ')'");
  EXPECT_EQ(message(""), "'':1:1: found the end of the text; expected a number, a name, a function or '('");
  EXPECT_EQ(message("x = 1"), "'x = 1':1:3: found '='; expected an operator or the end of the expression");
}

TEST(Expression, RefusesNamesAndNodesThatAreNone) {
  EXPECT_THROW(Expression::symbol("2x"), ModelError);
  EXPECT_THROW(Expression::symbol(""), ModelError);
  EXPECT_THROW(Expression::symbol("sin"), ModelError);
  EXPECT_THROW(Expression::function("sinh", "x"), ModelError);
  EXPECT_THROW(Expression::number("1.2.3"), ModelError);
  EXPECT_THROW(Expression::number("nan"), ModelError);
  EXPECT_THROW(Expression::node(Kind::quotient, {"x"}), ModelError);
  EXPECT_THROW(Expression::node(Kind::number, {"x"}), ModelError);
}

TEST(Expression, RefusesToGrowDeeperThanARecursionMayGo) {
  Expression e = "x";
  for (int i = 0; i < Expression::kMaxDepth; ++i) e = 1 / e;
  EXPECT_FALSE(e.text().empty());
  EXPECT_TRUE(e.mentions("x"));
  EXPECT_THROW(1 / e, ModelError);
}

TEST(Expression, HoldsAHundredThousandTerms) {
  std::string text = "x0";
  for (int i = 1; i < 100'000; ++i) text += (i % 2 ? " - " : " + ") + std::string("2*x") + std::to_string(i);
  const Expression e = text;
  EXPECT_EQ(e.operands().size(), 100'000u);
  EXPECT_EQ(e.text(), text);
  EXPECT_TRUE(e.mentions("x99999"));
  EXPECT_FALSE(same_tree(e, e + 1));
}

/// A random tree of every kind of node.
class RandomTree {
 public:
  explicit RandomTree(unsigned seed) : random_(seed) {}

  Expression operator()(int depth) {
    switch (below(depth > 0 ? 9 : 2)) {
      case 0: return Expression::number(std::vector<std::string>{"0", "2", "0.90", "1e-6", "12.5e3"}[below(5)]);
      case 1: return Expression::symbol(std::vector<std::string>{"x", "y_A", "theta2", "pi", "e1", "_"}[below(6)]);
      case 2:
        return Expression::function(std::vector<std::string>{"sin", "cos", "sqrt", "abs"}[below(4)], (*this)(depth - 1));
      case 3: return Expression::node(Kind::negation, {(*this)(depth - 1)});
      case 4: return Expression::node(Kind::quotient, {(*this)(depth - 1), (*this)(depth - 1)});
      case 5: return Expression::node(Kind::power, {(*this)(depth - 1), (*this)(depth - 1)});
      case 6:
      case 7: return Expression::node(Kind::sum, several(depth));
      default: return Expression::node(Kind::product, several(depth));
    }
  }

 private:
  std::size_t below(int n) { return static_cast<std::size_t>(std::uniform_int_distribution<int>(0, n - 1)(random_)); }
  std::vector<Expression> several(int depth) {
    std::vector<Expression> result;
    for (std::size_t n = 2 + below(3); n > 0; --n) result.push_back((*this)(depth - 1));
    return result;
  }

  std::mt19937 random_;
};

TEST(Expression, EveryTreePrintsToATextThatParsesBackToIt) {
  constexpr unsigned kTreeSeed = 20170613;
  RecordProperty("seed", static_cast<int>(kTreeSeed));
  RandomTree tree(kTreeSeed);
  for (int i = 0; i < 5'000; ++i) {
    const Expression e = tree(1 + i % 6);
    ASSERT_TRUE(same_tree(parse_expression(e.text()), e)) << "seed " << kTreeSeed << ", tree " << i << ": " << e;
    ASSERT_FALSE(e.latex().empty());
  }
}

}  // namespace
}  // namespace corank::symbolic
