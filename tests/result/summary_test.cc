// The table and the JSON summary of a made-up result.
#include "corank/result/values/summary.h"
#include "corank/result/values/words.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "corank/certify/angle.h"
#include "corank/result/values/sentences.h"
#include "corank/symbolic/model/model_error.h"
#include "corank/tests/result/sample_result.h"
#include "corank/tests/system_builder.h"

namespace corank::result {
namespace {

using nlohmann::ordered_json;
using testing::AllOf;
using testing::ContainsRegex;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

std::vector<std::string> keys(const ordered_json& object) {
  std::vector<std::string> names;
  for (const auto& item : object.items()) names.push_back(item.key());
  return names;
}

TEST(JsonSummary, HasExactlyTheKeysThatScriptsRelyOn) {
  const ordered_json json = ordered_json::parse(to_json(sample_result()));
  EXPECT_THAT(keys(json), ElementsAre("model", "set", "corank", "system", "options", "complete", "assembled", "sample",
                                      "nearly_solved", "stopped", "boxes", "parts_of_sheets", "undecided_reasons",
                                      "observed_dimension", "seems_of_corank", "self_motions", "boundary_reasons",
                                      "range_ends", "ranges_found", "tolerances", "points", "meaning", "node_distance",
                                      "kernel", "free_coordinates", "types", "seconds", "version"));
  EXPECT_THAT(keys(json["system"]), ElementsAre("variables", "equations", "inequalities", "dimension"));
  EXPECT_THAT(keys(json["options"]),
              ElementsAre("kernel", "sigma", "sigma_length", "sigma_angle", "kernel_scales", "passive_rates_eliminated",
                          "tolerance", "threads", "max_boxes", "max_solutions", "time_limit", "constants"));
  EXPECT_THAT(keys(json["boxes"]),
              ElementsAre("processed", "regular", "isolated", "exact", "boundary", "partial", "undecided", "pending"));
  EXPECT_THAT(keys(json["seconds"]), ElementsAre("total", "search", "certify"));
  EXPECT_THAT(keys(json["points"][0]), ElementsAre("values", "verdict"));
  EXPECT_THAT(keys(json["points"][0]["values"]), ElementsAre("x", "t", "xi1"));
}

TEST(JsonSummary, SaysWhatTheResultHolds) {
  const Result result = sample_result();
  const ordered_json json = ordered_json::parse(to_json(result));
  EXPECT_EQ(json["model"], "sample");
  EXPECT_EQ(json["set"], "forward");
  EXPECT_EQ(json["system"]["variables"], 4);
  EXPECT_EQ(json["complete"], false);
  EXPECT_EQ(json["boxes"]["processed"], 123);
  for (const char* verdict : {"regular", "isolated", "exact", "boundary", "partial", "undecided", "pending"}) {
    EXPECT_EQ(json["boxes"][verdict], 1) << verdict;
  }
  EXPECT_EQ(json["options"]["max_boxes"], (std::uint64_t{1} << 53) + 1);
  EXPECT_EQ(json["options"]["max_solutions"], 7);
  EXPECT_EQ(json["options"]["tolerance"], 1e-6);
  EXPECT_EQ(json["options"]["constants"]["L2"], "4/5");
  EXPECT_EQ(json["version"], version());
}

TEST(Summary, CountsPartsOfSheets) {
  Result result = sample_result();
  EXPECT_EQ(ordered_json::parse(to_json(result))["parts_of_sheets"], 0);
  EXPECT_THAT(to_table(result), Not(HasSubstr("part of a sheet")));
  result.cover.regions[0][0] = 0.5;
  EXPECT_EQ(ordered_json::parse(to_json(result))["parts_of_sheets"], 1);
  EXPECT_THAT(to_table(result), HasSubstr("1 of these holds a part of a sheet"));
}

TEST(JsonSummary, GivesItsSampleAsFarAsTheProofDoes) {
  Result result = sample_result();
  result.cover.boxes = {sample_box({{0.0, 4.0}, {0.25, 0.75}, {-1.0, 1.0}, 0.5}, Verdict::regular, {0})};
  result.cover.boxes[0].region = 0;
  result.cover.regions[0] = {{1.0, 2.0}, {0.5, 1.0}, {0.5, 0.875}, 0.5};
  const ordered_json narrow = ordered_json::parse(to_json(result))["sample"];
  EXPECT_EQ(narrow["x"], (ordered_json{{"lo", 1.5}, {"hi", 1.5}}));
  EXPECT_LT(narrow["t"]["hi"].get<double>() - narrow["t"]["lo"].get<double>(), 1);
}

TEST(JsonSummary, GivesBoundsBackBitForBitAndAnglesInRadians) {
  const Result result = sample_result();
  const ordered_json json = ordered_json::parse(to_json(result));
  ASSERT_EQ(json["points"].size(), 2u);
  const ordered_json& x = json["points"][1]["values"]["x"];
  EXPECT_TRUE(same_bits(Interval(x["lo"], x["hi"]), 1.0 / 3));
  const ordered_json& t = json["points"][0]["values"]["t"];
  EXPECT_EQ(Interval(t["lo"], t["hi"]), certify::angle_enclosure({-1.0, -0.9}, {-0.1, 0.1}, result.angles[0].range));
  EXPECT_EQ(json["points"][0]["verdict"], "isolated");
  EXPECT_EQ(json["points"][1]["verdict"], "undecided");
}

TEST(JsonSummary, HasNoPointsForACurve) {
  Result result = sample_result();
  result.cover.dimension = 1;
  EXPECT_TRUE(ordered_json::parse(to_json(result))["points"].is_null());
}

TEST(JsonSummary, TellsAPlainSystemFromOneWithAKernel) {
  Result result = sample_result();
  result.options.kernel.clear();
  EXPECT_TRUE(ordered_json::parse(to_json(result))["options"]["kernel"].is_null());
  EXPECT_TRUE(ordered_json::parse(to_json(result))["corank"].is_null());
}

TEST(Summary, SaysWhichCorankWasAskedFor) {
  Result result = sample_result();
  EXPECT_EQ(ordered_json::parse(to_json(result))["corank"], 1);
  result.options.corank = 2;
  result.cover.boxes[3].kernel_at_most = 2;
  result.cover.boxes[4].kernel_at_most = 2;
  EXPECT_EQ(ordered_json::parse(to_json(result))["corank"], 2);
  EXPECT_THAT(to_table(result), testing::StartsWith("sample, forward singularities of corank 2: "));
  EXPECT_THAT(to_table(result),
              HasSubstr("kernel: dimension 2 in 2 boxes\n  in 1 of them dimension 2 is proven at a point:\n"));
}

TEST(Summary, LeavesUndecidedBoxesOutOfTheKernelUnlessTheyHoldAKnownPoint) {
  Result result = sample_result();
  const auto at_most = [&] { return ordered_json::parse(to_json(result))["kernel"]["at_most"]; };
  result.cover.boxes[4].kernel_at_most = 2;
  EXPECT_EQ(at_most(), (ordered_json{{"1", 1}, {"2", 1}}));
  EXPECT_THAT(to_table(result), HasSubstr("kernel: dimension 1 in 1 box, at most 2 in 1\n"));
  result.cover.boxes[4].point = -1;
  EXPECT_EQ(at_most(), (ordered_json{{"1", 1}}));
  EXPECT_THAT(to_table(result), HasSubstr("kernel: dimension 1 in 1 box\n"));
}

TEST(OutwardText, RoundsEachBoundOutward) {
  EXPECT_EQ(outward_text({1.0 / 3, 2.0 / 3}, 3), "[0.333, 0.667]");
  EXPECT_EQ(outward_text({-2.0 / 3, -1.0 / 3}, 3), "[-0.667, -0.333]");
  EXPECT_EQ(outward_text(0.1, 9), "[0.1, 0.100000001]") << "the double 0.1 is above 1/10";
  EXPECT_EQ(outward_text(0.5, 9), "0.5");
  EXPECT_EQ(outward_text({-0.0, 0.0}, 9), "0");
  EXPECT_EQ(outward_text({-1e-320, 1e-15}, 9), "[-1e-12, 1e-12]");
  EXPECT_EQ(outward_text({1e-15, 2e-15}, 9), "[0, 1e-12]");
  EXPECT_EQ(outward_text({-2e-15, -1e-15}, 9), "[-1e-12, 0]");
}

TEST(Table, CountsVerdictsAndListsPointsWithAngles) {
  Result result = sample_result();
  EXPECT_THAT(to_table(result), HasSubstr("  2  1  ")) << "an exact coordinate";
  result.cover.points[1].point = -1;
  const std::string table = to_table(result);
  EXPECT_THAT(table, HasSubstr("sample, forward: 4 variables, 4 equations, 1 inequality; dimension 0"));
  EXPECT_THAT(table, HasSubstr("INCOMPLETE"));
  EXPECT_THAT(table, HasSubstr("1 wider than sigma"));
  EXPECT_THAT(table, HasSubstr("2 points: 1 isolated, 1 undecided"));
  EXPECT_THAT(table, HasSubstr("[3.03093"));
  EXPECT_THAT(table, HasSubstr("[0.333333333, 0.333333334]"));
  EXPECT_THAT(table.substr(0, table.find("kernel:")), Not(HasSubstr("c_t")));
}

TEST(Table, SaysWhatATolerancedSystemMeans) {
  Result result = sample_result();
  EXPECT_THAT(to_table(result),
              HasSubstr("coefficients that are not integers are taken within a relative tolerance of 1e-06"));
  EXPECT_THAT(to_table(result), HasSubstr("each verdict holds for every choice of them"));
  result.equations = 5;
  EXPECT_THAT(to_table(result), HasSubstr("more equations than variables: coefficients"));
  EXPECT_THAT(to_table(result), HasSubstr("the others hold within 1e-05"));
  result.cover.tolerance = 0;
  EXPECT_THAT(to_table(result), Not(HasSubstr("coefficients")));
}

TEST(Table, ListsTheParts) {
  Result result = sample_result();
  Result limit = sample_result(), none = sample_result();
  limit.part = "rho at its lower limit";
  none.part = "rho at its upper limit", none.cover.boxes.clear();
  result.parts = {limit, none};
  const std::string parts = "  rho at its lower limit", empty = "\n  1 part without a solution\n";
  EXPECT_THAT(to_table(result), AllOf(HasSubstr("\nthe union of 2 parts:\n" + parts), HasSubstr(empty)));
  result.outputs = {"x", "y"};
  EXPECT_THAT(to_table(result), AllOf(ContainsRegex("in the space of x, y: .* boxes\n" + parts), HasSubstr(empty)))
      << "below the passages";
}

Result result_at_the_ends() {
  Result result = sample_result();
  result.domain = {{0}, {{"x", true}, {"t", false}, {"z", true}}, {{"upper end of x", 3}, {"m.cuik:9", 1}}};
  result.variables[0].domain = {-0.11, 1.81};
  return result;
}

// Where there is nothing to cut, nothing was, and sigma is what it had been.
TEST(Summary, OfPartsHasTheSigmaOfThoseThatHavePieces) {
  Result whole = sample_result();
  whole.cover.dimension = 2;
  whole.parts = {whole, whole};
  whole.parts[1].cover.boxes.clear();
  whole.parts[1].cover.sigma = {HUGE_VAL, HUGE_VAL};
  merge_parts(whole);
  EXPECT_EQ(whole.cover.sigma, (Sigma{0.1, 0.25}));
  EXPECT_EQ(whole.options.sigma, whole.cover.sigma);
  whole.parts.erase(whole.parts.begin());
  merge_parts(whole);
  EXPECT_EQ(whole.cover.sigma, whole.parts[0].cover.sigma) << "of an empty set that of its parts";
}

TEST(Summary, OfAnEmptyBoundaryNeedsNoModelText) {
  Result empty = sample_result();
  empty.set = "boundary";
  empty.model_text.clear();  // as of a model that was built in C++
  empty.cover.boxes.clear();
  EXPECT_THROW(model_of(empty), symbolic::ModelError);
  EXPECT_THAT(assembly_sentences(empty), testing::Each(Not(HasSubstr("[LIMITS]"))));
}

TEST(Table, SaysWhatRangesDo) {
  const std::string table = to_table(result_at_the_ends());
  EXPECT_THAT(table, HasSubstr("ranges found from the equations: x in [-0.11, 1.81]\n"));
  EXPECT_THAT(table, HasSubstr("\nthe set reaches the ends of the declared ranges of x, z; nothing beyond was searched\n"
                               "the set may reach the end of the declared range of t; nothing beyond was searched\n"));
  EXPECT_THAT(table, HasSubstr("boundary: may reach beyond upper end of x (3), m.cuik:9 (1)\n"));
  const std::string plain = to_table(sample_result());
  for (const char* word : {"found from", "reach", "not shown"}) EXPECT_THAT(plain, Not(HasSubstr(word)));
}

TEST(JsonSummary, SaysWhatRangesDo) {
  const ordered_json json = ordered_json::parse(to_json(result_at_the_ends()));
  EXPECT_EQ(json["boundary_reasons"],
            ordered_json::parse(R"([{"reason": "upper end of x", "boxes": 3}, {"reason": "m.cuik:9", "boxes": 1}])"));
  EXPECT_EQ(json["range_ends"][1], ordered_json::parse(R"({"variable": "t", "reached": false})"));
  EXPECT_EQ(json["range_ends"][2]["reached"], true);
  EXPECT_EQ(json["ranges_found"]["x"]["lo"], -0.11);
}

TEST(Table, SaysNoneForAnEmptySet) {
  Result result = sample_result();
  result.cover.boxes.clear();
  result.cover.points.clear();
  const std::string table = to_table(result);
  EXPECT_THAT(table,
              HasSubstr("complete: every solution in the search domain is in a box\n\nempty: there is no solution in the "
                        "search domain   (123 processed)\nit is not known whether the robot can be assembled within its "
                        "ranges: corank did not search for a configuration\n\n1.500 s"));
  EXPECT_THAT(table, Not(HasSubstr("verdict")));
}

TEST(Table, PrintsAnExactAngle) {
  Result result = sample_result();
  CoverBox& point = result.cover.points[1];
  point.box[1] = {0.59, 0.61}, point.box[2] = {0.79, 0.81};
  result.cover.exact_points[1].coordinates[1] = {ExactNumber::rational("3/5")};
  result.cover.exact_points[1].coordinates[2] = {ExactNumber::rational("4/5")};
  EXPECT_THAT(to_table(result), HasSubstr("  atan2(4/5, 3/5)  "));
}

TEST(Table, IsShortForASurface) {
  Result result = sample_result();
  result.cover.dimension = 2;
  result.cover.boxes.pop_back();
  const std::string table = to_table(result);
  EXPECT_THAT(table, Not(HasSubstr("point")));
  EXPECT_THAT(table, HasSubstr("complete: every solution in the search domain is in a box"));
}

TEST(Summary, ShowsTheFirstThousandOfVeryManyPoints) {
  Result result = sample_result();
  result.cover.dimension = 0;
  result.cover.points.assign(1521, result.cover.points[0]);
  const std::string table = to_table(result);
  EXPECT_NE(table.find("1521 points"), std::string::npos);
  EXPECT_NE(table.find("\n   1000  "), std::string::npos) << table.substr(0, 2000);
  EXPECT_EQ(table.find("\n   1001  "), std::string::npos);
  EXPECT_NE(table.find("\n  and 521 more"), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(to_json(result))["points"].size(), 1521u);
}

// Names come from files of others.
TEST(JsonSummary, ReplacesWhatIsNoUtf8) {
  Result result = sample_result();
  result.model = "\xC0robot";
  result.variables[0].name = "x\xFF";
  const ordered_json json = ordered_json::parse(to_json(result));
  EXPECT_EQ(json["model"], "\uFFFDrobot");
}

TEST(Summary, SaysWhatStoppedTheRun) {
  Result result = sample_result();
  EXPECT_EQ(to_table(result).find("stopped by"), std::string::npos);
  EXPECT_TRUE(nlohmann::json::parse(to_json(result))["stopped"].is_null());
  result.stopped = "the time limit, in the stage exact points";
  EXPECT_NE(to_table(result).find("\nstopped by the time limit, in the stage exact points\n"), std::string::npos);
  EXPECT_NE(to_table(result).find("1 wider than sigma: the search ended before they were cut\n"), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(to_json(result))["stopped"], result.stopped);
}

}  // namespace
}  // namespace corank::result
