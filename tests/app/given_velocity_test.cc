// Models with a velocity equation of their own, from file to verified result and report.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "corank/result/files/result_file.h"
#include "corank/tests/app/program.h"
#include "corank/tests/models/given_rates.h"

namespace corank::app {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

class GivenVelocity : public testing::Test {
 protected:
  /// A model of the repository with rates instead of inputs and outputs.
  std::string model_file(const std::string& name, const std::string& rates) const {
    std::string text = read_text(model(name));
    const std::size_t inputs = text.find("[INPUTS]"), drawing = text.find("[DRAWING]");
    text.erase(inputs, drawing - inputs);
    return folder_.write(name + ".cuik", text + rates);
  }
  std::string path() const { return folder_.file("r.h5"); }
  std::string file(const std::string& name) const { return folder_.file(name); }
  Outcome solve(const std::string& from, std::vector<std::string> more) const {
    more.insert(more.begin(), {"solve", from, "-o", path()});
    return run_corank(more);
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(GivenVelocity, IsSolvedAndVerifiedWithItsProof) {
  const std::string sliders = model_file("three_slider", test::kRodRates), dextar = model_file("dextar", test::kJointRates);
  for (const auto& [file, set, boxes] :
       {std::tuple(sliders, "forward", "isolated              8          0"),
        std::tuple(sliders, "inverse", "isolated              4          0"), std::tuple(dextar, "forward", "regular "),
        std::tuple(dextar, "cspace-singular", "completeness")}) {
    const Outcome solved = solve(file, {"--set", set, "--proof", "--sigma", "0.2"});
    ASSERT_EQ(solved.status, 0) << solved.err;
    const Outcome verified = run_corank({"verify", path(), "--threads", "0"});
    EXPECT_EQ(verified.status, 0) << verified.out << verified.err;
    EXPECT_THAT(verified.out, HasSubstr(boxes));
    EXPECT_THAT(verified.out, HasSubstr("completeness: replayed"));
  }
}

TEST_F(GivenVelocity, IsPartOfWhatIsVerified) {
  ASSERT_EQ(solve(model_file("three_slider", test::kRodRates), {"--set", "forward"}).status, 0);
  result::Result changed = result::read_result(path());
  const std::size_t at = changed.model_text.find("v_C = y_A*w1");
  ASSERT_NE(at, std::string::npos);
  changed.model_text.replace(at, 12, "v_C = x_C*w1");
  result::write_result(path(), changed);
  const Outcome verified = run_corank({"verify", path()});
  EXPECT_EQ(verified.status, 1);
  EXPECT_THAT(verified.out, HasSubstr("the system is not that of the model"));
}

TEST_F(GivenVelocity, HasItsCorank2Points) {
  const Outcome solved = solve(model_file("dextar", test::kJointRates), {"--set", "inverse", "--corank", "2", "--json"});
  ASSERT_EQ(solved.status, 0) << solved.err;
  EXPECT_EQ(json::parse(solved.out)["corank"], 2);
  EXPECT_THAT(run_corank({"verify", path(), "--threads", "0"}).out, HasSubstr("verified, except for completeness\n"));
}

TEST_F(GivenVelocity, NeedsRatesWithARole) {
  const std::string file =
      model_file("three_slider", "[RATES]\na : input\nb : passive\nc : passive\n[VELOCITY EQS]\na = b;\nx_C*b = c;\n");
  EXPECT_EQ(solve(file, {"--set", "forward"}).status, 0);
  const Outcome inverse = solve(file, {"--set", "inverse"});
  EXPECT_EQ(inverse.status, 1);
  EXPECT_THAT(inverse.err, HasSubstr("the model names no output rates, which the inverse singularities need"));
}

TEST_F(GivenVelocity, IsWrittenAsAModelThatGivesTheSameSystem) {
  const std::string from = model_file("dextar", test::kJointRates);
  const Outcome written = run_corank({"derive", from, "--format", "model", "-D", "l=1"});
  ASSERT_EQ(written.status, 0) << written.err;
  EXPECT_THAT(written.out, HasSubstr("[RATES]\nw5 ~ input\n"));
  EXPECT_THAT(written.out, HasSubstr("l  := 1\n"));
  const TemporaryFolder other;
  const std::string again = other.write("dextar.cuik", written.out);
  for (const char* set : {"forward", "inverse", "cspace-singular"}) {
    const auto system = [&](const std::string& file, const std::vector<std::string>& more) {
      std::vector<std::string> words{"derive", file, "--set", set, "--format", "cuik"};
      words.insert(words.end(), more.begin(), more.end());
      std::string text = run_corank(words).out, equations;
      std::istringstream lines(text);
      for (std::string line; std::getline(lines, line);)
        if (!line.starts_with("%")) equations += line + "\n";  // places in the file differ
      return equations;
    };
    EXPECT_EQ(system(again, {}), system(from, {"-D", "l=1"}));
  }
}

TEST_F(GivenVelocity, IsReportedWithItsRatesAndNoOthersArrows) {
  const std::string model = model_file("three_slider", test::kRodRates);
  const Outcome outcome = run_corank({"report", model, "-o", file("out")});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::string page = read_text(file("out") + "/index.html");
  EXPECT_THAT(page, HasSubstr("given by the model, in rates of its own"));
  EXPECT_THAT(page, HasSubstr("<small>rates</small>"));
  EXPECT_THAT(page, HasSubstr("the velocity equation has full rank there"));
  EXPECT_THAT(page, Not(HasSubstr("C-space is smooth there")));
  EXPECT_THAT(page, HasSubstr("\"columns\":[]")) << "the drawing says no velocities in these rates";
}

// Where the model names coordinates as inputs and outputs, as robots from parts do, the page names these.
TEST(GivenVelocityWithInputs, IsReportedByItsCoordinates) {
  const TemporaryFolder folder;
  const std::string file = folder.write("sliders.cuik", read_text(model("three_slider")) + test::kRodRates);
  ASSERT_EQ(run_corank({"report", file, "-o", folder.file("out")}).status, 0);
  EXPECT_THAT(read_text(folder.file("out") + "/index.html"), Not(HasSubstr("<small>rates</small>")));
}

}  // namespace
}  // namespace corank::app
