// Coordinates that are free whatever the others are: planted in random models, none more and none fewer are found.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "corank/result/values/sentences.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/symbolic/sets/set_parts.h"
#include "corank/tests/seeds.h"

namespace corank::result {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::vector<std::string> free_of(const std::string& text) {
  const symbolic::Mechanism mechanism = symbolic::parse_model(text, "m.cuik");
  return free_coordinates(mechanism, symbolic::SetEquations(mechanism, symbolic::SingularitySet::cspace).compiled({}), false,
                          {});
}

TEST(FreeCoordinates, AreThoseThatOnlyCircleAndRangeMention) {
  const std::string head = "[SYSTEM VARS]\na ~ [-pi, pi]\nb ~ [-1, 1]\nx : [-5, 5]\np :\n[SYSTEM EQS]\n";
  EXPECT_THAT(free_of(head + "p = x + cos(a) + sin(b);\n"), ElementsAre("a", "b", "x"));
  EXPECT_THAT(free_of(head + "p = x + cos(a) + sin(b);\nsin(a) = 0;\n"), ElementsAre("b", "x")) << "a has two values";
  EXPECT_THAT(free_of(head + "p = x + cos(a) + sin(b);\nsin(a) >= 0.5;\n"), ElementsAre("b", "x")) << "a has a part";
  EXPECT_THAT(free_of(head + "p = x + cos(a) + sin(b);\nx >= 0;\n"), ElementsAre("a", "b")) << "x has a part";
  EXPECT_THAT(free_of(head + "p = x + cos(a) + sin(b);\np^2 = 2;\n"), IsEmpty());
  EXPECT_THAT(free_of(head + "p = x + cos(a) + sin(b);\np >= 0;\n"), IsEmpty()) << "the value has a limit";
  const std::string limited = "[SYSTEM VARS]\na ~ [-pi, pi]\nx : [-5, 5]\np : [-1, 1]\n[SYSTEM EQS]\n";
  EXPECT_THAT(free_of(limited + "p = x + cos(a);\n"), IsEmpty()) << "the value has a range";
}

// Some coordinates are in equations of their own, all of them in images, and those in images of images.
TEST(FreeCoordinates, ThatArePlantedAreFound) {
  for (unsigned seed = 1; seed <= test::seeds(200); ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const auto number = [&](int below) { return static_cast<int>(random() % static_cast<unsigned>(below)); };
    std::string variables, equations, sum = "0";
    std::vector<std::string> planted, bound;
    const int n = 2 + number(5);
    for (int i = 0; i < n; ++i) {
      const bool angle = number(2) == 0;
      const std::string name = fmt::format("q{}", i);
      variables += fmt::format("{} {} [{}, {}]\n", name, angle ? "~" : ":", -1 - number(2), 1 + number(2));
      const std::string function = angle ? fmt::format("{}({})", number(2) ? "sin" : "cos", name) : name;
      sum += fmt::format(" + {}*{}", 1 + number(3), function);
      if (number(2) == 0) {
        planted.push_back(name);
      } else {
        bound.push_back(function);
      }
    }
    for (std::size_t i = 0; i + 1 < bound.size(); ++i) equations += fmt::format("{}*{} = 1/3;\n", bound[i], bound[i + 1]);
    if (!bound.empty()) equations += fmt::format("{}^2 {} 1/4;\n", bound.back(), number(2) ? "=" : "<=");
    const int images = 1 + number(3);
    for (int k = 0; k < images; ++k) {
      variables += fmt::format("p{} :\n", k);
      equations += fmt::format("p{} = {};\n", k, k > 0 && number(2) ? fmt::format("p{}^2 + 1", k - 1) : sum);
    }
    const std::string text = "[SYSTEM VARS]\n" + variables + "[SYSTEM EQS]\n" + equations;
    SCOPED_TRACE(text);
    EXPECT_EQ(free_of(text), planted);
  }
}

}  // namespace
}  // namespace corank::result
