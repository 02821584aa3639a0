#include "corank/result/cuik/cuik_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cfenv>
#include <cstdio>
#include <random>

#include "corank/tests/result/sample_result.h"

namespace corank::result {
namespace {
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string fault_of_sol(const std::string& text) {
  try {
    parse_sol(text, "a.sol");
  } catch (const CuikFileError& error) {
    return error.what();
  }
  return "accepted";
}

// CUIK's way of finding boxes: whatever is no "{ n [a,b] … }" is skipped.
int boxes_that_cuik_finds(const std::string& text, std::size_t sides) {
  int count = 0;
  for (std::size_t at = text.find('{'); at != std::string::npos; at = text.find('{', at + 1)) {
    const std::string box = text.substr(at, text.find('}', at) - at);
    std::size_t n = 0;
    EXPECT_EQ(std::sscanf(box.c_str(), "{ %zu", &n), 1) << box;
    EXPECT_EQ(n, sides);
    EXPECT_EQ(static_cast<std::size_t>(std::count(box.begin(), box.end(), '[')), sides);
    ++count;
  }
  return count;
}

TEST(CuikSol, ReadsBackWhatItWroteBitForBit) {
  const Result result = sample_result();
  const SolFile file = parse_sol(to_sol(result), "a.sol");
  EXPECT_THAT(file.variables, ElementsAre("x", "c_t", "s_t", "xi1"));
  ASSERT_EQ(file.boxes.size(), result.cover.boxes.size());
  for (std::size_t i = 0; i < file.boxes.size(); ++i) {
    EXPECT_EQ(file.boxes[i].verdict, result.cover.boxes[i].verdict);
    for (std::size_t j = 0; j < 4; ++j) {
      EXPECT_TRUE(same_bits(file.boxes[i].box[j], result.cover.boxes[i].box[j])) << i << " " << j;
    }
  }
  EXPECT_THAT(file.boxes[0].free, ElementsAre("x", "xi1"));
  EXPECT_THAT(file.boxes[1].free, ElementsAre());
}

TEST(CuikSol, HoldsNoBraceBesidesItsBoxes) {
  Result result = sample_result();
  result.model = "a{b}";
  result.model_text = "% {1} a comment with { braces }\n[SYSTEM VARS]\n";
  EXPECT_EQ(boxes_that_cuik_finds(to_sol(result), 4), static_cast<int>(result.cover.boxes.size()));
}

TEST(CuikSol, LeavesAuxiliaryVariablesOutAsTheSuiteDoes) {
  Result result = sample_result();
  result.variables[1].auxiliary = true;
  const SolFile file = parse_sol(to_sol(result), "a.sol");
  EXPECT_THAT(file.variables, ElementsAre("x", "s_t", "xi1"));
  EXPECT_EQ(file.boxes[1].box[1], result.cover.boxes[1].box[2]);
  EXPECT_EQ(boxes_of(result).variables.size(), 4u);
}

TEST(CuikSol, PrintsEveryDoubleOutwardAndExactly) {
  std::mt19937_64 random(20240611);
  for (int i = 0; i < 20000; ++i) {
    const std::uint64_t bits = random();
    double x = 0;
    std::memcpy(&x, &bits, sizeof x);
    if (!std::isfinite(x)) continue;
    double lo = 0, hi = 0;
    const std::string text = outward_interval_text(x);
    ASSERT_EQ(std::sscanf(text.c_str(), "[%lf,%lf]", &lo, &hi), 2) << text;
    ASSERT_TRUE(same_bits(lo, x) && same_bits(hi, x)) << text;
    // The exact decimal is no larger (no smaller): read with directed rounding it does not pass x.
    const auto read = [&](const std::string& number, int mode) {
      const int former = std::fegetround();
      std::fesetround(mode);
      const double value = std::strtod(number.c_str(), nullptr);
      std::fesetround(former);
      return value;
    };
    const std::size_t comma = text.find(',');
    ASSERT_LE(read(text.substr(1, comma - 1), FE_UPWARD), x) << text;
    ASSERT_GE(read(text.substr(comma + 1), FE_DOWNWARD), x) << text;
  }
}

TEST(CuikSol, ReadsTheSuitesOwnLayout) {
  const SolFile file = parse_sol(
      "Random seed: 1\n% PARAMETERS:\n   SIGMA = 0.1\nSOLUTIONS (to input file a.cuik):\n\n"
      "Newton [s:1 v:2 l:8 t:0.04]: { 2  u[3,3] v[3,3] }\n"
      "   1 (err:0.004 tm:0.07):{ 2  u[-1,0.5] v[-0,0] }\n 12 (err:1e-5 tm:1.2): <S> { 2  u[1,1] v[1e-3,+2] }\nSTATISTICS "
      "FOR Cuik:\n",
      "a.sol");
  EXPECT_THAT(file.variables, ElementsAre("u", "v"));
  ASSERT_EQ(file.boxes.size(), 2u);
  EXPECT_EQ(file.boxes[0].box[0], Interval(-1, 0.5));
  EXPECT_EQ(file.boxes[1].box[1], Interval(1e-3, 2));
  EXPECT_FALSE(file.boxes[0].verdict.has_value());
}

TEST(CuikSol, ReadsBoxesWithoutNamesAndFindsVariablesByNumber) {
  const SolFile file = parse_sol("{ 3  [0,1] [2,3] [4,5] }\n{ 3  [0,1] [2,3] [4,5] } % a word\n", "a.sol");
  EXPECT_EQ(file.boxes.size(), 2u);
  EXPECT_EQ(file.find("3"), 2);
  EXPECT_EQ(file.find("0"), -1);
  EXPECT_EQ(file.find("4"), -1);
  EXPECT_EQ(file.find("x"), -1);
  EXPECT_FALSE(file.boxes[1].verdict.has_value());
}

TEST(CuikSol, ReadsACoverWithoutBoxes) {
  Result result = sample_result();
  result.cover.boxes.clear();
  EXPECT_TRUE(parse_sol(to_sol(result), "a.sol").boxes.empty());
}

TEST(CuikSol, NamesFileAndLineOfAFault) {
  EXPECT_EQ(fault_of_sol("\n\n{ 2  x[0,1] }"), "a.sol:3: a box announces 2 sides and has 1; expected as many as announced");
  EXPECT_THAT(fault_of_sol("{ 1 x[0,1] }\n{ 1 y[0,1] }"),
              HasSubstr("a.sol:2: a box has other variables than the one in line 1"));
  EXPECT_THAT(fault_of_sol("{ 1 x[1,0] }"), HasSubstr("a.sol:1: a side of a box is empty"));
  EXPECT_THAT(fault_of_sol("{ 1 x[0,inf] }"), HasSubstr("a bound is not finite"));
  EXPECT_THAT(fault_of_sol("{ 1 x[0,1e999] }"), HasSubstr("a number is out of range"));
  EXPECT_THAT(fault_of_sol("{ 1 x[0;1] }"), HasSubstr("found ';' in a box; expected ',' between the bounds"));
  EXPECT_THAT(fault_of_sol("{ 1 x[0,1]"), HasSubstr("the file ends inside a box"));
  EXPECT_THAT(fault_of_sol("{ 2 x[0,1] [0,1] }"), HasSubstr("only some sides have a name"));
  EXPECT_THAT(fault_of_sol("{ 2 x[0,1] x[0,1] }"), HasSubstr("a name occurs twice"));
  EXPECT_THAT(fault_of_sol("{ 1 x[0,1] } % regular, free y"),
              HasSubstr("the free variable 'y' is not a variable of the box"));
  EXPECT_THAT(fault_of_sol("a text\n"), HasSubstr("holds no boxes"));
  EXPECT_THAT(fault_of_sol(""), HasSubstr("a.sol:1: holds no boxes"));
  std::string text = to_sol(sample_result());
  text.resize(text.find("STATISTICS"));
  EXPECT_THAT(fault_of_sol(text), HasSubstr("the file is cut short"));
}

TEST(CuikSol, SaysWhichFileIsMissing) {
  EXPECT_THROW(read_sol("/nowhere/a.sol"), ResultFileError);
  EXPECT_THROW(read_sol("/tmp"), ResultFileError);
}

}  // namespace
}  // namespace corank::result
