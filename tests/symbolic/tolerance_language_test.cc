// Constants with tolerances in the model language.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/symbolic/writing/printer.h"

namespace corank::symbolic {
namespace {

std::string with_constants(const std::string& lines, const std::string& equation = "x = l") {
  return "[CONSTANTS]\n" + lines + "\n[SYSTEM VARS]\nx : [-9, 9]\n[SYSTEM EQS]\n" + equation + ";\n";
}
System compiled(const std::string& text) { return algebrize(plain_system(parse_model(text, "m.cuik"))); }
std::string range(const std::string& lines) {
  const System system = compiled(with_constants(lines));
  const int l = system.find("l");
  if (l < 0) return "exact";
  const Variable& v = system.variables[l];
  EXPECT_TRUE(v.is_parameter());
  return v.lower.text() + " " + v.upper.text();
}

TEST(ToleranceLanguage, HasFourForms) {
  EXPECT_EQ(range("l := 0.9 ± 0.1"), "4/5 1");
  EXPECT_EQ(range("l := 0.9+-0.1"), "4/5 1");
  EXPECT_EQ(range("l := 2 ± 1/2;"), "3/2 5/2");
  EXPECT_EQ(range("l := in [1, 3/2]"), "1 3/2");
  EXPECT_EQ(range("l := 2 ± 10%"), "9/5 11/5");
  EXPECT_EQ(range("l := 2 ± 10 %"), "9/5 11/5");
  EXPECT_EQ(range("l := -2 ± 10 % ;"), "-11/5 -9/5");
  EXPECT_EQ(range("t := 1/10\nl := 2 - 1 ± 2*t"), "4/5 6/5");
  EXPECT_EQ(range("l := 2 ± 0"), "exact");
}

TEST(ToleranceLanguage, KeepsComments) {
  EXPECT_EQ(range("l := 0.9 ± 0.1 % a comment"), "4/5 1");
  EXPECT_EQ(range("l := 2 ± 10% % a comment"), "9/5 11/5");
  EXPECT_EQ(range("l := 2 % ± 1"), "exact");
}

TEST(ToleranceLanguage, MeansASumInEquations) {
  EXPECT_NO_THROW(compiled(with_constants("l := 1", "x +-l = 0")));
  EXPECT_EQ(range("k := (1 +-2)\nl := k ± 1"), "-2 0") << "in parentheses it is a sum, too";
}

TEST(ToleranceLanguage, OneNameIsOneUnknown) {
  const System system = compiled(with_constants("l := 1 ± 0.1\nm := 2*l\nk := m - l", "x = k*l - m + k^2"));
  EXPECT_EQ(system.parameters(), 1);
  EXPECT_EQ(system.dimension(), 0);
  ASSERT_EQ(system.equations.size(), 1u);
  EXPECT_EQ(system.equations[0].monomials.size(), 3u) << "x = 2 l^2 - 2 l";
}

TEST(ToleranceLanguage, RefusesWhatCannotBe) {
  const auto fault = [](const std::string& text) -> std::string {
    try {
      compiled(text);
    } catch (const ModelError& error) {
      return error.what();
    }
    return "";
  };
  using testing::HasSubstr;
  EXPECT_THAT(fault(with_constants("l := 1 ± -0.1")), HasSubstr("is empty"));
  EXPECT_THAT(fault(with_constants("l := in [2, 1]")), HasSubstr("is empty"));
  for (const char* zero : {"0", "-0.0", "0e3"})
    EXPECT_THAT(fault(with_constants("l := " + std::string(zero) + " ± 1%")), HasSubstr("m.cuik:2")) << zero;
  EXPECT_THAT(fault(with_constants("l := 0 ± 1%")), HasSubstr("in percent of 0 has width 0; expected a width"));
  EXPECT_THAT(fault(with_constants("l := in [2 1]")), HasSubstr("m.cuik:2"));
  EXPECT_THAT(fault(with_constants("l := 1 ±")), HasSubstr("m.cuik:2"));
  for (const char* percent : {"2*5%", "1/2 %"})
    EXPECT_THAT(fault(with_constants("l := 1 ± " + std::string(percent))), HasSubstr("neither a percent sign")) << percent;
  EXPECT_THAT(fault("[CONSTANTS]\nl := 1 ± 0.1\n[SYSTEM VARS]\nx : [l, l]\ny : [0, 9]\n[SYSTEM EQS]\nx = y;\n"),
              HasSubstr("the range of 'x' depends on 'l'"));
  EXPECT_THAT(fault(with_constants("a := 1 ± 0.1\nl := 2 ± a")), HasSubstr("depends on 'a'"));
  EXPECT_THAT(fault(with_constants("l := 1 ± 0.1", "x = 1/l")), HasSubstr("divides by"));
  EXPECT_THAT(fault("[CONSTANTS]\nl := 1 ± 0.1\n[SYSTEM VARS]\nt ~ [0, l]\n[SYSTEM EQS]\nsin(t) = l/2;\n"),
              HasSubstr("the range of 't' depends on 'l'"));
  EXPECT_THAT(fault("[CONSTANTS]\nl := 1 ± 0.1\n[SYSTEM VARS]\nx : [0, 9]\n[SYSTEM EQS]\nx = l;\n[LIMITS]\nx : [0, l]\n"),
              HasSubstr("depend on 'l'"));
}

TEST(ToleranceLanguage, LeavesTheNameInToConstants) {
  EXPECT_NO_THROW(compiled("[CONSTANTS]\nin := 2\nl := in\n[SYSTEM VARS]\nx : [-9, 9]\n[SYSTEM EQS]\nx = l;\n"));
}

TEST(ToleranceLanguage, RangesThatFollowAConstantHoldForEveryValue) {
  const System system =
      compiled("[CONSTANTS]\nl := 1 ± 0.1\n[SYSTEM VARS]\nx : [-l-1, 2*l]\ny : [-l, 1]\n[SYSTEM EQS]\nx^2 = l;\ny = x;\n");
  EXPECT_EQ(system.variables[1].upper.text(), "1") << "this end does not vary";
  EXPECT_TRUE(system.variables[0].domain.contains(Interval(-2.1, 2.2)));
  EXPECT_LT(system.variables[0].domain.width(), 4.6);
}

TEST(ToleranceLanguage, IsWrittenBack) {
  const Mechanism model = parse_model(with_constants("l := 2 ± 10%\nk := l"), "m.cuik");
  const Mechanism again = parse_model(to_model(model), "m.cuik");
  ASSERT_TRUE(again.constants()[0].tolerance);
  EXPECT_EQ(again.toleranced(), std::vector<std::string>{"l"});
  const System one = algebrize(plain_system(model)), other = algebrize(plain_system(again));
  EXPECT_TRUE(one.variables[one.find("l")].lower == other.variables[other.find("l")].lower);
}

}  // namespace
}  // namespace corank::symbolic
