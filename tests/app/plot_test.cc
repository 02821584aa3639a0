// corank plot as a user runs it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "corank/tests/app/program.h"

namespace corank::app {
namespace {

using ::testing::HasSubstr;

class Plot : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    for (const char* const set : {"cspace", "forward", "inverse"})
      ASSERT_EQ(
          run_corank({"solve", model("three_slider"), "--set", set, "--sigma", "0.2", "-o", file(set + std::string(".h5"))})
              .status,
          0);
  }
  static void TearDownTestSuite() { delete folder_; }
  static std::string file(const std::string& name) { return folder_->file(name); }
  static std::vector<std::string> words(const std::string& axes, const std::string& output,
                                        const std::vector<std::string>& more = {}) {
    std::vector<std::string> all{"plot", file("inverse.h5"), file("cspace.h5"), file("forward.h5"), "--axes", axes,
                                 "-o",   file(output)};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  static TemporaryFolder* folder_;
};
TemporaryFolder* Plot::folder_ = nullptr;

TEST_F(Plot, DrawsSeveralResultsInEveryFormat) {
  for (const auto& [name, beginning] : {std::pair{"a.svg", "<svg"},
                                        {"a.pdf", "%PDF-"},
                                        {"a.png", "\x89PNG"},
                                        {"a.vtp", "<?xml"},
                                        {"a.gcl", "# Boxes in 2"}}) {
    const Outcome outcome = run_corank(words("y_A,y_B", name));
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.out + outcome.err, "");
    EXPECT_TRUE(read_text(file(name)).starts_with(beginning)) << name;
  }
  const std::string svg = read_text(file("a.svg"));
  EXPECT_LT(svg.find("data-set=\"cspace\""), svg.find("data-set=\"inverse\""));
  EXPECT_LT(svg.find("data-set=\"inverse\""), svg.find("data-set=\"forward\""));
  EXPECT_THAT(svg, HasSubstr("inverse locus"));
  EXPECT_EQ(run_corank(words("y_A,y_B,x_C", "b.vtp")).status, 0);
  EXPECT_THAT(read_text(file("b.vtp")), HasSubstr("PolyData"));
}

TEST_F(Plot, HasATitleAWidthAndALegendOrNone) {
  ASSERT_EQ(
      run_corank(words("y_A,y_B", "t.svg", {"--title", "Sliders", "--width", "120", "--no-legend", "--color", "verdict"}))
          .status,
      0);
  const std::string svg = read_text(file("t.svg"));
  EXPECT_THAT(svg, HasSubstr("<title>Sliders</title>"));
  EXPECT_THAT(svg, HasSubstr("width=\"340.157pt\""));
  EXPECT_EQ(svg.find("swatch"), std::string::npos);
  EXPECT_THAT(svg, HasSubstr("<title>regular</title>"));
}

TEST_F(Plot, SaysWhatItCannotDraw) {
  const Outcome spatial = run_corank(words("y_A,y_B,x_C", "c.pdf"));
  EXPECT_EQ(spatial.status, 2);
  EXPECT_THAT(spatial.err,
              HasSubstr(".pdf pictures are flat; expected two axes, or a name that ends in .vtp or .gcl for three"));
  const Outcome format = run_corank(words("y_A,y_B", "c.jpg"));
  EXPECT_EQ(format.status, 2);
  EXPECT_THAT(format.err, HasSubstr("expected a name that ends in .svg, .pdf, .png, .vtp or .gcl"));
  const Outcome axis = run_corank(words("y_A,phi", "c.svg"));
  EXPECT_EQ(axis.status, 2);
  EXPECT_THAT(axis.err, HasSubstr("has no variable 'phi'; expected a number from 1 to "));
  const Outcome one = run_corank(words("y_A", "c.svg"));
  EXPECT_EQ(one.status, 2);
  EXPECT_THAT(one.err, HasSubstr("expected two or three"));
  EXPECT_EQ(run_corank(words("y_A,y_B", "c.svg", {"--width", "3"})).status, 2);
  EXPECT_EQ(run_corank({"plot", file("none.h5"), "--axes", "1,2", "-o", file("c.svg")}).status, 1);
  for (const char* const name : {"c.pdf", "c.jpg", "c.svg"}) EXPECT_FALSE(std::filesystem::exists(file(name))) << name;
}

}  // namespace
}  // namespace corank::app
