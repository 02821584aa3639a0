// corank solve --estimate: what it predicts is near what corank solve then does.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "corank/result/files/result_file.h"
#include "corank/tests/app/program.h"

namespace corank::app {
namespace {

using nlohmann::json;

TEST(Estimate, IsWithinAFactorOfTwoOfARealRunAndSolvesNothing) {
  const TemporaryFolder folder;
  const std::string file = folder.file("r.h5");
  const std::vector<std::string> solve{"solve", model("dextar"), "--set", "forward", "--sigma", "0.1", "-o", file};
  std::vector<std::string> estimate = solve;
  estimate.insert(estimate.end(), {"--estimate", "--json"});
  const Outcome trial = run_corank(estimate);
  ASSERT_EQ(trial.status, 0) << trial.err;
  EXPECT_FALSE(std::filesystem::exists(file));
  const json cost = json::parse(trial.out);
  ASSERT_EQ(run_corank(solve).status, 0);
  const result::Result real = result::read_result(file);
  const auto boxes = static_cast<double>(real.cover.boxes.size());
  const auto size = static_cast<double>(std::filesystem::file_size(file));
  const auto likely = [&cost](const char* key) { return cost.at(key).at("likely").get<double>(); };
  EXPECT_THAT(likely("boxes"), testing::AllOf(testing::Gt(boxes / 2), testing::Lt(boxes * 2)));
  EXPECT_THAT(likely("file_bytes"), testing::AllOf(testing::Gt(size / 2), testing::Lt(size * 2)));
  EXPECT_THAT(likely("processed"), testing::Gt(0));
  EXPECT_LE(cost.at("boxes").at("low"), cost.at("boxes").at("high"));
}

TEST(Estimate, SaysForWhichSigmaAndHowSureItIs) {
  const Outcome trial = run_corank({"solve", model("dextar"), "--set", "forward", "--estimate"});
  EXPECT_EQ(trial.status, 0);
  EXPECT_THAT(trial.out, testing::HasSubstr("for sigma "));
  EXPECT_THAT(trial.out, testing::HasSubstr("boxes returned"));
}

}  // namespace
}  // namespace corank::app
