// [IMPLIED EQS]: derived, used, proven and refused as a user sees it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "corank/tests/app/program.h"

namespace corank::app {
namespace {

using testing::HasSubstr;
using testing::Not;

const std::string kTwoLinks =
    "[CONSTANTS]\na := 1.3\nb := 0.7\n[SYSTEM VARS]\nx : [-2, 2]\ny : [-2, 2]\nt1 ~ [-pi, pi]\nt2 ~ [-pi, pi]\n[SYSTEM "
    "EQS]\n"
    "x = a*cos(t1) + b*cos(t2);\ny = a*sin(t1) + b*sin(t2);\nx = 1;\ny = 1/2;\n";
const std::string kClosing = "[IMPLIED EQS]\n(x - a*cos(t1))^2 + (y - a*sin(t1))^2 = b^2;\n";

TEST(ImpliedEquationsOfAModel, AreShownAndWrittenAndUsed) {
  const TemporaryFolder folder;
  const std::string file = folder.write("arm.cuik", kTwoLinks + kClosing), result = folder.file("arm.h5");
  Outcome outcome = run_corank({"derive", file});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("Implied"));
  outcome = run_corank({"derive", file, "--format", "cuik"});
  EXPECT_THAT(outcome.out, HasSubstr("[IMPLIED EQS]"));
  EXPECT_EQ(run_corank({"derive", folder.write("again.cuik", outcome.out)}).status, 0) << "what it writes, it reads";
  outcome = run_corank({"solve", file, "--proof", "-o", result});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("2 points: 2 isolated"));
  outcome = run_corank({"verify", result});
  EXPECT_EQ(outcome.status, 0) << outcome.out;
}

TEST(ImpliedEquationsOfAModel, AreRefusedWhereTheyDoNotFollow) {
  const TemporaryFolder folder;
  const std::string wrong = "(x - a*cos(t1))^2 + (y - a*sin(t1))^2 = b;\n";
  for (const char* command : {"derive", "solve"}) {
    const Outcome outcome = run_corank({command, folder.write("arm.cuik", kTwoLinks + kClosing + wrong)});
    EXPECT_EQ(outcome.status, 1);
    EXPECT_THAT(outcome.err, HasSubstr("arm.cuik:16:1: corank found no identity that derives this equation"));
  }
  const Outcome inequality = run_corank({"derive", folder.write("arm.cuik", kTwoLinks + "[IMPLIED EQS]\nx <= 1;\n")});
  EXPECT_EQ(inequality.status, 1);
  EXPECT_THAT(inequality.err, HasSubstr("arm.cuik:15:1: an inequality cannot be an implied equation"));
  const Outcome unknown = run_corank({"derive", folder.write("arm.cuik", kTwoLinks + "[IMPLIED EQS]\nx = z;\n")});
  EXPECT_THAT(unknown.err, HasSubstr("'z'"));
}

TEST(ImpliedEquationsOfAModel, MakeNoDifferenceToItsMobility) {
  const TemporaryFolder folder;
  const std::string arm = kTwoLinks.substr(0, kTwoLinks.find("x = 1;")) + "[INPUTS] t1, t2\n[OUTPUTS] x, y\n";
  const auto table = [&](const std::string& text) {
    const Outcome outcome = run_corank({"derive", folder.write("arm.cuik", text), "--set", "inverse"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome.out.substr(0, outcome.out.find("System"));
  };
  EXPECT_EQ(table(arm), table(arm + kClosing));
}

}  // namespace
}  // namespace corank::app
