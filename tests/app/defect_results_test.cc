// Result files that made an earlier version crash, hang, leak or say something wrong. Small ones of the same kinds are made
// by tests/report/strangers_test.cc.
#include "corank/tests/app/defect_files.h"

#include <gmock/gmock.h>

#include "corank/tests/app/program.h"

namespace corank::app {
namespace {

using testing::HasSubstr;
using testing::Not;

class DefectResult : public testing::Test {
 protected:
  void SetUp() override { SKIP_WITHOUT_DEFECT_FILES(); }
  static void expect_refused(const std::string& name, const std::string& reason) {
    for (const auto& words : {std::vector<std::string>{"verify", defect(name)},
                              {"report", "--results", defect(name), "-o", "/nowhere/at/all"}}) {
      const Outcome outcome = run_corank(words);
      EXPECT_EQ(outcome.status, 1) << name << '\n' << outcome.out << outcome.err;
      EXPECT_THAT(outcome.err, HasSubstr(reason)) << name;
      EXPECT_THAT(outcome.err, Not(HasSubstr("bug in corank"))) << name;
      EXPECT_EQ(outcome.out, "") << name;
    }
  }
};

TEST_F(DefectResult, ThatCrashesOrHangsTheHdf5LibraryIsRefused) {
  expect_refused("crash_verify_148.h5", "/certificates/box_region has a type that no result has");
  expect_refused("crash_verify_547.h5", "/certificates/point_point can grow");
  expect_refused("hang_verify_397.h5", "/certificates/exact_points/sole_within can grow");
  expect_refused("out_of_range_267.h5", "/certificates/exact_points/sole_within can grow");
}

TEST_F(DefectResult, ThatHasMoreCoordinatesThanVariablesIsRefused) {
  expect_refused("crash_report_233.h5", "configuration_size is above the number of variables");
}

TEST_F(DefectResult, ThatDeclaresMoreThanItHoldsIsRefused) {
  expect_refused("huge_steps.h5", "/certificates/proof/steps declares more than the file holds");
  expect_refused("huge_text.h5", "/model/text declares more than the file holds");
}

TEST_F(DefectResult, ThatReadsAnotherFileIsRefused) {
  expect_refused("external.h5", "/model/text is stored in another file");
}

TEST_F(DefectResult, WithAScriptInAnAttributeIsRefused) { expect_refused("evil6.h5", "neither right nor left"); }

TEST_F(DefectResult, WithAScriptInItsNameGivesAPageWithoutIt) {
  const TemporaryFolder folder;
  const std::string page = folder.file("page");
  const Outcome outcome = run_corank({"report", "--results", defect("evil5.h5"), "-o", page});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::string html = read_text(page + "/index.html");
  EXPECT_THAT(html, Not(HasSubstr("<!--<script")));
  EXPECT_THAT(html, HasSubstr("\"model\":\"z\\u003c!--\\u003cscript>\""));
}

TEST_F(DefectResult, WithTerminalEscapesPrintsNone) {
  const Outcome outcome = run_corank({"verify", defect("evil4.h5")});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ((outcome.out + outcome.err).find_first_of("\x1b\x07"), std::string::npos);
  EXPECT_THAT(outcome.out, HasSubstr("a\\x1b]0;owned"));
}

TEST_F(DefectResult, ThatIsTrueIsAccepted) {
  for (const char* name : {"true_result_rejected.h5", "bigpoly.h5"}) {
    const Outcome outcome = run_corank({"verify", defect(name)});
    EXPECT_EQ(outcome.status, 0) << name << '\n' << outcome.out;
    EXPECT_THAT(outcome.out, HasSubstr("\nverified\n")) << name;
  }
}

TEST_F(DefectResult, ThatTakesLongEndsAtTheTimeLimit) {
  const Outcome outcome = run_corank({"verify", "--time-limit", "0.5", defect("verify_slow.h5")});
  EXPECT_EQ(outcome.status, 3) << outcome.out;
  EXPECT_THAT(outcome.out, HasSubstr("interrupted in the exact points: 0 of 1 boxes were checked"));
}

}  // namespace
}  // namespace corank::app
