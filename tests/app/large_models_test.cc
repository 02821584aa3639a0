// Models of thousands of variables and links: derived in time that grows with what is printed, or refused by a sentence.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "corank/tests/app/program.h"

namespace corank::app {
namespace {

using testing::AnyOf;
using testing::HasSubstr;

// Of processor time, which a run that goes through all pairs of variables exceeds many times over.
#if defined(__SANITIZE_ADDRESS__)
constexpr Allowed kAllowed{.cpu_seconds = 200};
#else
constexpr Allowed kAllowed{.cpu_seconds = 20};
#endif

std::string variables(int n) {
  std::string text = "[SYSTEM VARS]\n";
  for (int i = 0; i < n; ++i) text += "x" + std::to_string(i) + " : [0, 1]\n";
  return text + "[SYSTEM EQS]\n";
}

// Each equation has two of the variables.
std::string chain(int n) {
  std::string text = variables(n);
  for (int i = 0; i + 1 < n; ++i) text += "x" + std::to_string(i) + "^2 = 1/2*x" + std::to_string(i + 1) + ";\n";
  return text;
}

std::string joined(int n, const std::string& sign, const std::string& power) {
  std::string text = variables(n);
  for (int i = 0; i < n; ++i) text += (i > 0 ? sign : "") + "x" + std::to_string(i) + power;
  return text + " = 1/2;\n";
}

std::string urdf_chain(int joints) {
  std::string text = "<robot name=\"chain\">\n<link name=\"l0\"/>\n";
  for (int i = 0; i < joints; ++i) {
    const std::string from = std::to_string(i), to = std::to_string(i + 1);
    text += "<link name=\"l" + to + "\"/>\n<joint name=\"j" + to + "\" type=\"continuous\"><parent link=\"l" + from +
            "\"/><child link=\"l" + to + "\"/><origin xyz=\"1 0 0\"/><axis xyz=\"" + (i % 2 == 0 ? "0 0 1" : "0 1 0") +
            "\"/></joint>\n";
  }
  return text + "</robot>\n";
}

TEST(LargeModels, OfFewVariablesInEachEquationAreDerived) {
  const TemporaryFolder folder;
  const Outcome outcome = run_corank({"derive", folder.write("m.cuik", chain(2000))}, kAllowed);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("(1999)  x1998  2*x1998\n"));
}

TEST(LargeModels, OfOneEquationWithAllVariablesAreDerived) {
  const TemporaryFolder folder;
  const Outcome sum = run_corank({"derive", folder.write("s.cuik", joined(4000, "+", "^2"))}, kAllowed);
  EXPECT_EQ(sum.status, 0) << sum.err;
  EXPECT_THAT(sum.out, HasSubstr("2*x3999\n"));
  const Outcome product = run_corank({"derive", folder.write("p.cuik", joined(300, "*", ""))}, kAllowed);
  EXPECT_EQ(product.status, 0) << product.err;
  const Outcome longer = run_corank({"derive", folder.write("l.cuik", joined(4000, "*", ""))}, kAllowed);
  EXPECT_EQ(longer.status, 1);
  EXPECT_THAT(longer.err, HasSubstr("the derivatives of an equation have 16000000 factors"));
}

TEST(LargeModels, WhoseJacobianIsTooLargeAreRefusedByDeriveAndSolvedInTheirTime) {
  const TemporaryFolder folder;
  const std::string file = folder.write("m.cuik", chain(20'000));
  const Outcome derived = run_corank({"derive", file}, kAllowed);
  EXPECT_EQ(derived.status, 1);
  EXPECT_THAT(derived.err, HasSubstr("its Jacobian has 19999 rows and 20000 columns"));
  const Outcome solved = run_corank({"solve", file, "--time-limit", "1"}, kAllowed);
  EXPECT_THAT(solved.status, AnyOf(0, 3)) << solved.err;
}

TEST(LargeModels, OfMoreLinksThanEquationsCanBeWrittenOfAreRefused) {
  const TemporaryFolder folder;
  const std::string file = folder.write("chain.urdf", urdf_chain(9'999));
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"derive", file}, {"solve", file, "--time-limit", "60"}}) {
    const Outcome outcome = run_corank(words, kAllowed);
    EXPECT_EQ(outcome.status, 1);
    EXPECT_THAT(outcome.err, HasSubstr("the robot has 9999 moving bodies; expected at most 500"));
  }
}

TEST(LargeModels, EndAtTheTimeLimitWhileTheirEquationsAreMade) {
  const TemporaryFolder folder;
  const Outcome outcome = run_corank({"solve", folder.write("chain.urdf", urdf_chain(450)), "--time-limit", "1"}, kAllowed);
  EXPECT_EQ(outcome.status, 3) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("stopped by the time limit"));
}

}  // namespace
}  // namespace corank::app
