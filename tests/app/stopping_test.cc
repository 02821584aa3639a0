// Limits and interrupts, as users meet them: exit status 3, what ended the run and where, and files that say so.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "corank/report/pictures/figures.h"
#include "corank/result/files/result_file.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/symbolic/sets/singularity_system.h"
#include "corank/tests/app/program.h"

namespace corank::app {
namespace {

using nlohmann::json;
using testing::HasSubstr;

using Words = std::vector<std::string>;

struct Limited {
  Words args;
  std::string stopped;
};

TEST(Limits, AreNamedByTheTableTheSummaryTheFileAndTheMessage) {
  const TemporaryFolder folder;
  const std::string file = folder.file("r.h5");
  const Words solve{"solve", model("dextar"), "--set", "cspace", "--sigma", "0.05", "-o", file};
  for (const Limited& limited : {Limited{{"--time-limit", "1e-9"}, "the time limit, in the stage model"},
                                 Limited{{"--max-boxes", "20"}, "the box limit, in the stage search"},
                                 Limited{{"--max-found", "20"}, "the limit of boxes found, in the stage search"},
                                 Limited{{"--max-solutions", "20"}, "the solution limit, in the stage search"},
                                 Limited{{"--memory-limit", "1M"}, "the memory limit, in the stage search"}}) {
    SCOPED_TRACE(limited.stopped);
    Words args = solve;
    args.insert(args.end(), limited.args.begin(), limited.args.end());
    const Outcome table = run_corank(args);
    EXPECT_EQ(table.status, 3);
    EXPECT_EQ(table.err, "corank: stopped by " + limited.stopped + "; the result is incomplete\n");
    EXPECT_THAT(table.out, HasSubstr("\nstopped by " + limited.stopped + "\n"));
    const result::Result result = result::read_result(file);
    EXPECT_EQ(result.stopped, limited.stopped);
    EXPECT_FALSE(result.cover.complete());
    args.push_back("--json");
    const json summary = json::parse(run_corank(args).out);
    EXPECT_EQ(summary["stopped"], limited.stopped);
    EXPECT_EQ(summary["complete"], false);
  }
}

TEST(Limits, ThatDoNotBiteLeaveNoTrace) {
  const Outcome outcome = run_corank({"solve", model("three_slider"), "--set", "forward", "--time-limit", "1000",
                                      "--max-boxes", "1000000", "--memory-limit", "8G", "--json"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(json::parse(outcome.out)["stopped"].is_null());
}

TEST(Limits, ThatEndAReportAreOnItsPage) {
  const TemporaryFolder folder;
  const Outcome outcome =
      run_corank({"report", model("dextar"), "--sets", "cspace,forward", "--memory-limit", "200k", "-o", folder.file("r")});
  EXPECT_EQ(outcome.status, 3);
  EXPECT_THAT(outcome.err, HasSubstr("corank: cspace: stopped by the memory limit, in the stage search\n"));
  EXPECT_THAT(outcome.err, HasSubstr("corank: the report is incomplete, and says what is missing\n"));
  EXPECT_THAT(read_text(folder.file("r/index.html")), HasSubstr("was stopped by the memory limit, in the stage search"));
}

TEST(Limits, OfAReportAreInItsHelp) {
  const std::string help = run_corank({"report", "--help"}).out;
  EXPECT_THAT(help, HasSubstr("--time-limit SECONDS"));
  EXPECT_THAT(help, HasSubstr("default: 8"));
  EXPECT_THAT(help, HasSubstr("default: 200000"));
  EXPECT_THAT(help, HasSubstr("within a minute"));
}

TEST(Figures, AreLeftOutAfterAnInterrupt) {
  const TemporaryFolder folder;
  const symbolic::Mechanism mechanism = symbolic::read_model(model("three_slider"));
  result::Result result;
  result.set = "cspace";
  result::describe_system(algebrize(singularity_system(mechanism, symbolic::SingularitySet::cspace)), result);
  result.cover.boxes.push_back({Box(result.variables.size(), Interval(0, 1)), Verdict::pending, {}});
  std::atomic<bool> stop{false};
  const auto figures = [&] {
    return report::write_figures(folder.file(""), mechanism, {report::picture_view(result, result.set)}, {&stop});
  };
  const report::Figures all = figures();
  EXPECT_FALSE(all.stopped);
  EXPECT_EQ(all.files.size(), 4u);
  stop = true;
  const report::Figures none = figures();
  EXPECT_TRUE(none.stopped);
  EXPECT_TRUE(none.files.empty());
}

TEST(Ranges, ThatAreHugeDoNoHarmWhereTheEquationsBoundTheSet) {
  const TemporaryFolder folder;
  const std::string huge = folder.write(
      "huge.cuik", "[SYSTEM VARS]\nx : [-1, 1]\ny : [-1e300, 1e300]\n[SYSTEM EQS]\nx^2 + y^2 = 1;\nx - y = 0;\n");
  const Outcome outcome = run_corank({"solve", huge});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("2 points: 2 isolated"));
}

// Files that once took long, or broke something; no part of the repository.
std::filesystem::path hard_files() {
  const char* const given = std::getenv("CORANK_DEFECTS_DIR");
  return given != nullptr && *given != '\0' ? std::filesystem::path(given)
                                            : std::filesystem::path(CORANK_SOURCE_DIR) / "../shared/defects";
}

struct Hard {
  std::string file;
  Words args;
  int status;
  std::string out, err;  ///< parts
};

class HardFiles : public testing::TestWithParam<Hard> {};

TEST_P(HardFiles, EndAsTheyShould) {
  const std::filesystem::path path = hard_files() / GetParam().file;
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there (CORANK_DEFECTS_DIR)";
  Words args{"solve", path.string()};
  args.insert(args.end(), GetParam().args.begin(), GetParam().args.end());
  const Outcome outcome = run_corank(args);
  EXPECT_EQ(outcome.status, GetParam().status) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr(GetParam().out));
  EXPECT_THAT(outcome.err, HasSubstr(GetParam().err));
}

INSTANTIATE_TEST_SUITE_P(
    Solve, HardFiles,
    testing::Values(
        // Faces of a blow-up with numbers of thousands of digits.
        Hard{"slow_over.cuik", {"--tolerance", "0", "--max-boxes", "20000"}, 0, "1 point: 1 exact", ""},
        Hard{"slow_iso8.cuik", {"--sigma", "0.1"}, 0, "2 points: 2 boundary", ""},
        Hard{"verify_slow.cuik", {}, 0, "1 point: 1 exact", ""},
        // A reduction that would make such numbers.
        Hard{"slow_over3.cuik",
             {"--tolerance", "0", "--sigma", "0.1", "--max-boxes", "2000"},
             3,
             "(2000 processed)",
             "the box limit"},
        // A sphere of undecided boxes where points are expected: a quarter of a million, in one cluster but for what is
        // pending between them.
        Hard{"shell3.cuik", {"--sigma", "0.002"}, 0, "1 point: 1 isolated", ""},
        // 3,000 variables.
        Hard{"manyvars.cuik", {}, 0, "1 point: 1 isolated", ""}, Hard{"huge_exp.cuik", {}, 0, "complete", ""}),
    [](const auto& hard) { return std::filesystem::path(hard.param.file).stem().string(); });

TEST(HardFilesInTime, EndAtATimeLimitInWhateverStageTheyAre) {
  for (const char* name : {"slow_over", "slow_over3", "slow_iso8", "shell3", "manyvars", "verify_slow"}) {
    const std::filesystem::path path = hard_files() / (std::string(name) + ".cuik");
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there (CORANK_DEFECTS_DIR)";
    for (const char* limit : {"1e-9", "0.05", "0.2"}) {
      SCOPED_TRACE(std::string(name) + " " + limit);
      const json summary = json::parse(run_corank({"solve", path.string(), "--time-limit", limit, "--json"}).out);
      const bool stopped = !summary["stopped"].is_null();
      EXPECT_TRUE(stopped || summary["complete"] == true);
      if (stopped) {
        EXPECT_THAT(summary["stopped"].get<std::string>(), HasSubstr("the time limit, in the stage "));
      }
    }
  }
}

}  // namespace
}  // namespace corank::app
