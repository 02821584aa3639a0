// corank verify: what it prints and returns. What the checker accepts and rejects is for tests/check to say.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>

#include "corank/result/files/result_file.h"
#include "corank/tests/app/program.h"

namespace corank::app {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::StartsWith;

class Verify : public testing::Test {
 protected:
  void SetUp() override { solve({"--proof"}); }
  void solve(std::vector<std::string> more) {
    std::vector<std::string> words{
        "solve", model("three_slider"), "--set", "forward", "-D", "L2=3/4", "--kernel", "left", "-o", path()};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = run_corank(words);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
  }
  std::string path() const { return folder_.file("r.h5"); }
  void change(const std::function<void(result::Result&)>& how) {
    result::Result result = result::read_result(path());
    how(result);
    result::write_result(path(), result);
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(Verify, PrintsATableAndReturnsZeroWhereAllIsVerified) {
  const Outcome outcome = run_corank({"verify", path(), "--threads", "0"});
  EXPECT_EQ(outcome.status, 0) << outcome.out;
  EXPECT_THAT(outcome.out, StartsWith("three_slider, forward: checked"));
  EXPECT_THAT(outcome.out, HasSubstr("isolated              8          0              0\n"));
  EXPECT_THAT(outcome.out, HasSubstr("completeness: replayed"));
  EXPECT_THAT(outcome.out, HasSubstr("\nverified\n"));
  EXPECT_EQ(outcome.err, "");
}

TEST_F(Verify, PrintsJson) {
  const Outcome outcome = run_corank({"verify", path(), "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.out;
  const json summary = json::parse(outcome.out);
  EXPECT_EQ(summary["verified"], true);
  EXPECT_EQ(summary["verdicts"]["isolated"], (json{{"verified", 8}, {"failed", 0}, {"not_checkable", 0}}));
  EXPECT_EQ(summary["complete"], true);
  EXPECT_EQ(summary["completeness"]["proof"], true);
  EXPECT_TRUE(summary["failures"].empty());
}

TEST_F(Verify, OfASampleSaysThatNothingIsSaidOfTheRest) {
  const Outcome some = run_corank({"verify", path(), "--sample", "5"});
  EXPECT_EQ(some.status, 3) << some.out;
  EXPECT_THAT(some.out, HasSubstr("isolated              5          0              0\n"));
  EXPECT_THAT(some.out,
              HasSubstr("a sample: 5 of 8 boxes, chosen at random, were checked; nothing is said about the others"));
  EXPECT_THAT(some.out, HasSubstr(" or about completeness\nif more than 60 % of all boxes were wrong"));
  EXPECT_THAT(some.out, testing::EndsWith("\nverified, but only the sample\n"));
  const json summary = json::parse(run_corank({"verify", path(), "--sample", "5", "--json"}).out);
  EXPECT_EQ(summary["not_in_sample"], 3);
  EXPECT_EQ(summary["verified"], false);
  EXPECT_EQ(run_corank({"verify", path(), "--sample", "8", "--require-proof"}).status, 2);
}

TEST_F(Verify, OfASampleThatHoldsEachBoxFailsWhereOneIsWrong) {
  change([](result::Result& result) {
    for (CoverBox& box : result.cover.boxes) box.region = -1;
  });
  const Outcome outcome = run_corank({"verify", path(), "--sample", "3"});
  EXPECT_EQ(outcome.status, 1) << outcome.out;
  EXPECT_THAT(outcome.out, HasSubstr("the file has no region for it"));
  EXPECT_THAT(outcome.out, testing::EndsWith("NOT VERIFIED\n"));
}

TEST_F(Verify, NamesTheBoxThatFails) {
  change([](result::Result& r) { r.cover.boxes[2].box[3] = {0.25, 0.5}; });
  const Outcome outcome = run_corank({"verify", path()});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.out, HasSubstr("box 3: it is not inside the region of its proof\n"));
  EXPECT_THAT(outcome.out, HasSubstr("\nNOT VERIFIED\n"));
}

TEST_F(Verify, NamesWhatIsNotTheModels) {
  change([](result::Result& r) {
    r.variables[0].domain = {-3.0, 1.0};
    r.options.constants[0].expression = "0.74";
  });
  const Outcome outcome = run_corank({"verify", path()});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.out, HasSubstr("file: the domain of y_A is not that of the model\n"));
  EXPECT_THAT(outcome.out, HasSubstr("file: the system is not that of the model\n"));
}

TEST_F(Verify, SaysWhereAModelHasNoSuchSet) {
  change([](result::Result& r) { r.set = "system"; });
  const Outcome outcome = run_corank({"verify", path()});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.err, HasSubstr("the result's model has no set 'system'"));
}

TEST_F(Verify, RefusesAFileThatIsNoResult) {
  EXPECT_EQ(run_corank({"verify", model("dextar")}).status, 1);
  EXPECT_EQ(run_corank({"verify"}).status, 2);
}

TEST_F(Verify, ReplaysAProofWhereEveryVariableWasEliminated) {
  const TemporaryFolder folder;
  const std::string system = folder.write("s.cuik", "[SYSTEM VARS]\nx : [-1, 1]\n[SYSTEM EQS]\n3*x = 1;\n"),
                    file = folder.file("s.h5");
  ASSERT_EQ(run_corank({"solve", system, "--proof", "--digits", "9", "-o", file}).status, 0);
  const Outcome outcome = run_corank({"verify", file});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.out, HasSubstr("completeness: replayed"));
  EXPECT_THAT(outcome.out, HasSubstr("decimals: they lie in their boxes, but were not proven again\n"));
}

TEST_F(Verify, RejectsDecimalsOutsideTheirBox) {
  solve({"--digits", "20", "--proof"});
  ASSERT_EQ(run_corank({"verify", path()}).status, 0);
  change([](result::Result& r) {
    for (char& c : r.cover.decimals[2][0])
      if (c >= '0' && c <= '9') c = static_cast<char>('9' - (c - '0'));
  });
  const Outcome outcome = run_corank({"verify", path()});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.out, HasSubstr("file: the decimals of point 3 are not in its box\n"));
}

TEST_F(Verify, SaysWhereCompletenessIsNotProven) {
  solve({});
  const Outcome outcome = run_corank({"verify", path()});
  EXPECT_EQ(outcome.status, 4);
  EXPECT_THAT(outcome.out, HasSubstr("completeness: no proof in the file\n"));
  EXPECT_THAT(outcome.out, HasSubstr("\nverified, except for completeness\n"));
  EXPECT_EQ(outcome.err, "");
  const Outcome as_json = run_corank({"verify", path(), "--json"});
  EXPECT_EQ(as_json.status, 4);
  EXPECT_EQ(json::parse(as_json.out)["verified"], true);
  EXPECT_EQ(json::parse(as_json.out)["complete"], false);
}

TEST_F(Verify, FailsWithoutAProofWhereOneIsRequired) {
  EXPECT_EQ(run_corank({"verify", path(), "--require-proof"}).status, 0);
  solve({});
  const Outcome outcome = run_corank({"verify", path(), "--require-proof"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.err, HasSubstr("--require-proof"));
}

TEST_F(Verify, SaysWhereASearchHadEndedEarly) {
  const TemporaryFolder folder;
  const std::string file = folder.file("s.h5");
  ASSERT_EQ(
      run_corank({"solve", model("three_slider"), "--set", "cspace", "--max-boxes", "5", "--proof", "-o", file}).status, 3);
  const Outcome outcome = run_corank({"verify", file});
  EXPECT_EQ(outcome.status, 4);
  EXPECT_THAT(outcome.out, HasSubstr("not searched\n"));
  EXPECT_THAT(outcome.out, HasSubstr("\nverified, except for completeness\n"));
  EXPECT_EQ(run_corank({"verify", file, "--require-proof"}).status, 1);
}

TEST_F(Verify, EndsAtItsTimeLimitWithAStatement) {
  const Outcome outcome = run_corank({"verify", path(), "--time-limit", "1e-9"});
  EXPECT_EQ(outcome.status, 3);
  EXPECT_THAT(outcome.out,
              HasSubstr("interrupted in the reduction: 0 of 8 boxes were checked; nothing is said about the rest\n"));
  EXPECT_THAT(outcome.out, testing::Not(HasSubstr("verified\n")));
  const json summary = json::parse(run_corank({"verify", path(), "--time-limit", "1e-9", "--json"}).out);
  EXPECT_EQ(summary["verified"], false);
  EXPECT_EQ(summary["interrupted"], true);
  EXPECT_EQ(summary["stage"], "the reduction");
}

TEST_F(Verify, PrintsNoControlCharactersOfAFile) {
  change([](result::Result& r) {
    r.model =
        "a\x1b]0;owned\x07\xc2\x9b"
        "31m";
  });
  const Outcome outcome = run_corank({"verify", path()});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.out, StartsWith("a\\x1b]0;owned\\x07\\u009b31m, forward: checked"));
  EXPECT_EQ(outcome.out.find('\x1b'), std::string::npos);
  change([](result::Result& r) { r.set = "\x1b[2J"; });
  EXPECT_THAT(run_corank({"verify", path()}).err, HasSubstr("no set '\\x1b[2J'"));
}

}  // namespace
}  // namespace corank::app
