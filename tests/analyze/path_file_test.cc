// A path's file: what is written is read and verified; whatever is changed in it is found out.
#include "corank/result/files/hdf5_file.h"
#include "corank/result/values/claim_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "corank/analyze/paths/path.h"
#include "corank/study/model.h"
#include "corank/symbolic/model/model_file.h"

namespace corank::analyze {
namespace {

using ::testing::HasSubstr;

result::PathFile make_file(Avoid avoid, const std::string& x, int mode) {
  const study::Question question{.model =
                                     study::read_model(std::string(CORANK_SOURCE_DIR) + "/models/dextar.cuik").mechanism};
  PathFinder finder(question, {.avoid = avoid});
  solve::Control control;
  const auto at = [](const std::string& value) {
    return std::vector<NamedValue>{{"J3x", symbolic::parse_expression(value, "J3x")},
                                   {"J3y", symbolic::parse_expression("1", "J3y")}};
  };
  const Path path =
      finder.find(finder.end(at("0.5"), 1, "--from", control), finder.end(at(x), mode, "--to", control), control);
  result::PathFile file;
  file.model = question.model.name();
  file.model_text = question.model.source_text();
  file.avoid = to_string(avoid);
  for (const Variable& v : finder.system().variables) file.variables.push_back(v.name);
  file.tube = path.tube.value();
  return file;
}

const result::PathFile& sample() {
  static const result::PathFile file = make_file(Avoid::forward, "0.7", 3);
  return file;
}

TEST(PathFile, IsReadAsItWasWritten) {
  const std::string path = ::testing::TempDir() + "path_file_test.h5";
  result::write_path(path, sample());
  EXPECT_EQ(result::format_of(path), result::kPathKind.format);
  const result::PathFile read = result::read_path(path);
  EXPECT_EQ(read.model_text, sample().model_text);
  EXPECT_EQ(read.avoid, sample().avoid);
  EXPECT_EQ(read.tube.pieces, sample().tube.pieces);
  EXPECT_EQ(read.tube.radii, sample().tube.radii);
  EXPECT_EQ(read.tube.sizes, sample().tube.sizes);
  ASSERT_EQ(read.tube.nodes.size(), sample().tube.nodes.size());
  EXPECT_EQ(read.tube.nodes.back().rows, sample().tube.nodes.back().rows);
  EXPECT_EQ(read.tube.nodes.back().values, sample().tube.nodes.back().values);
  EXPECT_TRUE(result::verify(read).verified());
}

TEST(PathFile, OfBothKindsOfSingularitiesIsVerified) {
  EXPECT_TRUE(result::verify(make_file(Avoid::both, "0.3", 1)).verified());
}

struct PathChange {
  const char* name;
  std::function<void(result::PathFile&)> apply;
  const char* words;
};

TEST(PathFile, ThatSomebodyChangedIsRefused) {
  const std::size_t last = sample().tube.pieces.size() - 1;
  ASSERT_GT(last, 0U);
  const std::vector<PathChange> changes{
      {"a waypoint is moved", [](auto& f) { f.tube.nodes[1].values[0] += 1e-6; }, "node 2"},
      {"a direction is turned", [](auto& f) { f.tube.nodes[1].rows[0] += 1e-3; }, "node 2"},
      {"a node's box is moved", [](auto& f) { f.tube.nodes[0].box[0] = Interval(0.4, 0.41); }, "node 1"},
      {"a piece's box is too narrow",
       [](auto& f) { f.tube.pieces[0][2] = Interval(f.tube.nodes[0].box[2].lo(), f.tube.nodes[0].box[2].hi()); }, "piece 1"},
      {"a piece's box is so wide that it holds another lift",
       [](auto& f) {
         for (Interval& side : f.tube.pieces[0]) side = Interval(-1.8, 1.8);
       },
       "piece 1"},
      {"a larger radius is claimed", [](auto& f) { f.tube.radii[0] = 1; }, "a singularity is not excluded"},
      {"a radius counts for more of a length",
       [](auto& f) {
         for (double& size : f.tube.sizes) size *= 100;
       },
       "about it"},
      {"a size is none", [](auto& f) { f.tube.sizes[0] = 0; }, "a variable's size"},
      {"a radius is infinite", [](auto& f) { f.tube.radii[0] = HUGE_VAL; }, "not a length"},
      {"a radius is negative", [](auto& f) { f.tube.radii[0] = -1; }, "not a length"},
      {"a piece is removed",
       [](auto& f) {
         f.tube.pieces.erase(f.tube.pieces.begin());
         f.tube.radii.erase(f.tube.radii.begin());
       },
       "one piece between"},
      {"a piece is removed with its node",
       [](auto& f) {
         f.tube.pieces.erase(f.tube.pieces.begin());
         f.tube.radii.erase(f.tube.radii.begin());
         f.tube.nodes.erase(f.tube.nodes.begin() + 1);
       },
       "not in its box"},
      {"another mechanism",
       [](auto& f) {
         f.constants = {{"l", "0.91"}};
       },
       "node 1"},
      {"other variables", [](auto& f) { f.variables[0] = "x"; }, "variables"},
      {"rows are missing", [](auto& f) { f.tube.nodes[0].rows.pop_back(); }, "sizes"},
  };
  for (const PathChange& change : changes) {
    SCOPED_TRACE(change.name);
    result::PathFile file = sample();
    change.apply(file);
    const check::TubeReport report = result::verify(file);
    EXPECT_FALSE(report.verified());
    std::string all;
    for (const std::string& failure : report.failures) all += failure + "\n";
    EXPECT_THAT(all, HasSubstr(change.words));
  }
}

// The range of an input, narrowed so that the path leaves it.
TEST(PathFile, ThatLeavesALimitIsRefused) {
  result::PathFile file = sample();
  const std::string range = "theta2 ~ [-pi, pi]";
  const std::size_t at = file.model_text.find(range);
  ASSERT_NE(at, std::string::npos);
  file.model_text.replace(at, range.size(), "theta2 ~ [-1, 1]");
  const check::TubeReport report = result::verify(file);
  ASSERT_FALSE(report.failures.empty());
  EXPECT_THAT(report.failures.front(), HasSubstr("a range, a limit or an inequality"));
}

}  // namespace
}  // namespace corank::analyze
