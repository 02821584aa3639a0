// corank where Cairo is missing: what needs it says so, all else works.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "corank/tests/app/program.h"

namespace corank::app {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const char* const kCairo = "apt install libcairo2-dev";

TEST(WithoutCairo, PdfAndPngAreRefusedBeforeAnyWork) {
  const TemporaryFolder folder;
  for (const char* const name : {"a.pdf", "a.png"}) {
    const Outcome plot = run_corank_without_cairo({"plot", "no_such.h5", "--axes", "x,y", "-o", folder.file(name)});
    EXPECT_EQ(plot.status, 1);
    EXPECT_THAT(plot.err, AllOf(HasSubstr("without Cairo"), HasSubstr(kCairo))) << name;
    EXPECT_FALSE(std::filesystem::exists(folder.file(name)));
  }
}

TEST(WithoutCairo, AReportHasItsFiguresAsSvgAlone) {
  const TemporaryFolder folder;
  const Outcome report = run_corank_without_cairo({"report", model("three_slider"), "-o", folder.file("r")});
  ASSERT_EQ(report.status, 0) << report.err;
  std::vector<std::string> figures;
  for (const auto& entry : std::filesystem::directory_iterator(folder.file("r/figures")))
    figures.push_back(entry.path().filename().string());
  EXPECT_THAT(figures, testing::UnorderedElementsAre("output-portrait.svg", "input-portrait.svg"));
  EXPECT_THAT(read_text(folder.file("r/index.html")), testing::Not(HasSubstr(".pdf\"")));
}

// Words have about the room that Cairo gives them: Helvetica or what stands for it.
TEST(WithoutCairo, ASvgIsThePictureThatCairoLaysOut) {
  const TemporaryFolder folder;
  const std::string result = folder.file("f.h5");
  ASSERT_EQ(run_corank({"solve", model("dextar"), "--set", "forward", "--sigma", "0.2", "-o", result}).status, 0);
  const std::vector<std::string> words{"plot", result, "--axes", "J3x,theta2", "-o"};
  const auto picture = [&](Outcome (*run)(const std::vector<std::string>&), const std::string& name) {
    std::vector<std::string> args = words;
    args.push_back(folder.file(name));
    const Outcome outcome = run(args);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return read_text(folder.file(name));
  };
  const std::string with = picture(run_corank, "with.svg"), without = picture(run_corank_without_cairo, "without.svg");
  const auto height = [](const std::string& svg) {
    const std::string begin = "height=\"";
    return std::stod(svg.substr(svg.find(begin) + begin.size()));
  };
  EXPECT_NEAR(height(without), height(with), 0.03 * height(with));
  EXPECT_THAT(without, AllOf(HasSubstr("θ"), HasSubstr("π/2")));
}

}  // namespace
}  // namespace corank::app
