#include "corank/result/cuik/cuik_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

namespace corank::result {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

CuikParameters parsed(const std::string& text) { return parse_param(text, "a.param"); }

std::string message_of(const std::string& text) {
  try {
    parsed(text);
  } catch (const CuikFileError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(CuikParam, HonoursWhatMeansSomethingAndListsTheRestOnce) {
  const CuikParameters p = parsed(
      "% a comment with SIGMA = 3\nRHO = 0.95\nSIGMA=0.1\n\nSMALL_SIGMA = 1e-4 % behind\nERROR_SPLIT = TRUE\nRHO = 0.5\n"
      "N_SOLUTIONS = 3\nREPRESENTATION = LINKS\nG_AXIS = -Z\nLR2TM_Q=.25");
  EXPECT_EQ(p.sigma, 0.1);
  EXPECT_EQ(p.small_sigma, 1e-4);
  EXPECT_EQ(p.n_solutions, 3);
  EXPECT_THAT(p.ignored, ElementsAre("RHO", "ERROR_SPLIT", "REPRESENTATION", "G_AXIS", "LR2TM_Q"));
}

TEST(CuikParam, AcceptsAnEmptyFile) {
  const CuikParameters p = parsed("/* nothing\n */ // at all\n# really");
  EXPECT_FALSE(p.sigma.has_value());
  EXPECT_EQ(p.n_solutions, 0);
}

TEST(CuikParam, ComputesExpressionsAsTheSuiteDoes) {
  EXPECT_EQ(parsed("SIGMA = 0.05*(1+3)/2").sigma, 0.1);
  EXPECT_EQ(parsed("SIGMA = -2^2").sigma, 4);    // a sign binds closest
  EXPECT_EQ(parsed("SIGMA = 2^3^2").sigma, 64);  // powers from left to right
  EXPECT_EQ(parsed("SIGMA = 8/4/2 - -1").sigma, 2);
  EXPECT_DOUBLE_EQ(*parsed("SIGMA = SQRT(4)*SIN(PI/2)").sigma, 2);
  EXPECT_EQ(parsed("SIGMA = 0.2 SMALL_SIGMA = SIGMA/2").small_sigma, 0.1);
}

TEST(CuikParam, ChoosesByACondition) {
  EXPECT_EQ(parsed("SIGMA = (TRUE?1:2)").sigma, 1);
  EXPECT_EQ(parsed("SIGMA = FALSE ? 1 : 2-1 ? 3 : 4").sigma, 3);
}

TEST(CuikParam, TheLastValueCounts) { EXPECT_EQ(parsed("SIGMA = 1\nSIGMA = 2").sigma, 2); }

TEST(CuikParam, NamesFileAndLineOfAFault) {
  EXPECT_EQ(message_of("RHO = 1\nSIGNA = 0.1"),
            "a.param:2: the parameter 'SIGNA' is unknown; expected a parameter of the CUIK suite; did you mean SIGMA?");
  EXPECT_THAT(message_of("sigme = 0.1"), HasSubstr("did you mean SIGMA?"));
  EXPECT_THAT(message_of("DUMIFY = 1"), HasSubstr("did you mean DUMMIFY?"));
  EXPECT_THAT(message_of("\n\nSIGMA 0.1"), HasSubstr("a.param:3: found '0.1'; expected '='"));
  EXPECT_THAT(message_of("SIGMA ="), HasSubstr("found the end of the file; expected a value"));
  EXPECT_THAT(message_of("SIGMA = 0"), HasSubstr("SIGMA cannot be used; expected a positive number"));
  EXPECT_THAT(message_of("SIGMA = 1/0"), HasSubstr("expected a positive number"));
  EXPECT_THAT(message_of("SIGMA = LINKS"), HasSubstr("expected a positive number"));
  EXPECT_THAT(message_of("SIGMA = RHO"), HasSubstr("'RHO' has no value"));
  EXPECT_THAT(message_of("N_SOLUTIONS = 1.5"), HasSubstr("expected a number of boxes, or 0 for all"));
  EXPECT_THAT(message_of("N_SOLUTIONS = -1"), HasSubstr("expected a number of boxes, or 0 for all"));
  EXPECT_THAT(message_of("RHO = (1"), HasSubstr("expected ')'"));
  EXPECT_THAT(message_of("RHO = 1 $ 2"), HasSubstr("found '$'"));
  EXPECT_THAT(message_of("/* x"), HasSubstr("has no end"));
  EXPECT_THAT(message_of("RHO = 1e999"), HasSubstr("out of range"));
}

TEST(CuikParam, EveryParameterIsInTheManual) {
  std::ostringstream manual;
  manual << std::ifstream(CORANK_SOURCE_DIR "/doc/cuik.md").rdbuf();
  for (const std::string& p : cuik_parameters()) {
    EXPECT_THAT(manual.str(), HasSubstr("`" + p + "`"));
    EXPECT_NO_THROW(parsed(p + " = 1"));
  }
}

}  // namespace
}  // namespace corank::result
