// Sets in parts on the command line: in the table, in JSON, in files, in the derivation and on the report's page.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "corank/result/files/result_file.h"
#include "corank/tests/app/program.h"

namespace corank::app {
namespace {

using nlohmann::json;
using Words = std::vector<std::string>;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

TEST(SetPartsOnTheCommandLine, AreListedAndStoredAndVerified) {
  const TemporaryFolder folder;
  const Outcome table = run_corank({"solve", model("planar/3prr"), "--set", "inverse", "--sigma", "1", "--proof", "-o",
                                    folder.file("r.h5"), "--json", folder.file("r.json")});
  EXPECT_EQ(table.status, 0) << table.err;
  EXPECT_THAT(table.out, HasSubstr("the union of 3 parts:"));
  EXPECT_THAT(table.out, HasSubstr("\n  cos(psi1) = 0 "));
  EXPECT_THAT(table.out, Not(HasSubstr("undecided")));
  const Outcome verified = run_corank({"verify", folder.file("r.h5")});
  EXPECT_EQ(verified.status, 0) << verified.out << verified.err;
  const json result = json::parse(read_text(folder.file("r.json")));
  ASSERT_EQ(result["parts"].size(), 3u);
  std::size_t boxes = 0;
  for (const json& part : result["parts"]) {
    EXPECT_EQ(part["dimension"], 2);
    EXPECT_EQ(part["complete"], true);
    EXPECT_EQ(part["part"], part["condition"]);
    boxes += part["boxes"].get<std::size_t>();
  }
  EXPECT_EQ(boxes, result["boxes"]["regular"].get<std::size_t>() + result["boxes"]["boundary"].get<std::size_t>());
  EXPECT_EQ(result["options"]["kernel"], json());
}

TEST(SetPartsOnTheCommandLine, AreProductsWithTheCoordinatesThatTheyLeaveFree) {
  const TemporaryFolder folder;
  const Outcome asked = run_corank({"solve", model("serial/puma_560"), "--set", "inverse", "--sigma", "inf", "--json",
                                    folder.file("r.json"), "-o", folder.file("r.h5")});
  EXPECT_EQ(asked.status, 0) << asked.err;
  const json result = json::parse(read_text(folder.file("r.json")));
  const std::vector<json> expected{{"theta2", "theta3"}, {"theta2", "theta5"}, {"theta5"}};
  ASSERT_EQ(result["parts"].size(), expected.size());
  EXPECT_EQ(result["boxes"]["boundary"], 0) << "directions of links have ranges beyond [-1, 1], which are no limits";
  const result::Result read = result::read_result(folder.file("r.h5"));
  for (std::size_t k = 0; k < expected.size(); ++k) {
    EXPECT_EQ(result["parts"][k]["free_coordinates"], expected[k]) << result["parts"][k];
    EXPECT_EQ(json(read.parts.at(k).free_coordinates), expected[k]);
  }
  EXPECT_EQ(result["free_coordinates"], json::array()) << "no coordinate is free in all parts";
  EXPECT_THAT(asked.out, HasSubstr(", for every theta2 and theta5\n"));
  EXPECT_THAT(run_corank({"solve", model("planar/arm_4r"), "--set", "cspace", "--sigma", "inf"}).out,
              HasSubstr("a product: solutions stay solutions for every theta1, theta2, theta3 and theta4\n"));
}

TEST(SetPartsOnTheCommandLine, OfALargeSetLeaveOutCoordinates) {
  const TemporaryFolder folder;
  std::string text = read_text(model("serial/puma_560"));
  for (const char* range : {"range [t1, t1]", "range [t4, t4]", "range [t6, t6]"}) text.erase(text.find(range), 14);
  folder.write("puma.cuik", text);
  const Outcome asked = run_corank({"solve", folder.file("puma.cuik"), "--set", "inverse", "--json", folder.file("r.json"),
                                    "-o", folder.file("r.h5"), "--proof"});
  EXPECT_EQ(asked.status, 0) << asked.err;
  EXPECT_THAT(asked.out, HasSubstr("dimension 5\n"));
  EXPECT_THAT(asked.out, HasSubstr("a product: solutions stay solutions for every theta1, theta4 and theta6\n"));
  EXPECT_THAT(asked.out,
              HasSubstr("  sin(theta5) = 0                       2 boxes, for every theta1, theta2, theta3, theta4"));
  const json result = json::parse(read_text(folder.file("r.json")));
  EXPECT_EQ(result["boxes"]["isolated"], 0);
  EXPECT_EQ(result["parts"][0]["isolated"], 2);
  for (const json& part : result["parts"]) EXPECT_EQ(part["dimension"], 5);
  const Outcome verified = run_corank({"verify", folder.file("r.h5")});
  EXPECT_EQ(verified.status, 0) << verified.out << verified.err;
  EXPECT_THAT(verified.out, HasSubstr("\nverified\n"));
  result::Result claimed = result::read_result(folder.file("r.h5"));
  claimed.parts[1].free_coordinates.push_back("theta3");  // its condition is about theta3, which its boxes have
  claimed.parts[2].free_coordinates.push_back("hand_x");  // which the joints give
  result::write_result(folder.file("claimed.h5"), claimed);
  const Outcome refused = run_corank({"verify", folder.file("claimed.h5")});
  EXPECT_EQ(refused.status, 1);
  EXPECT_THAT(refused.out, AllOf(HasSubstr("theta3 is not free"), HasSubstr("hand_x is not free")));
  // Pictures may have joints that are left out as axes; nobody chooses them unasked. The hand follows from five joints.
  EXPECT_EQ(run_corank({"plot", folder.file("r.h5"), "--axes", "theta2,theta3", "-o", folder.file("p.svg")}).status, 0);
  const Outcome hand = run_corank({"plot", folder.file("r.h5"), "--axes", "hand_x,theta3", "-o", folder.file("q.svg")});
  EXPECT_EQ(hand.status, 2);
  EXPECT_THAT(hand.err, HasSubstr("would be too many boxes over hand_x"));
  const Outcome page = run_corank({"report", "--results", folder.file("r.h5"), "-o", folder.file("page.html")});
  EXPECT_EQ(page.status, 0) << page.err;
  EXPECT_THAT(read_text(folder.file("page.html/figures/output-portrait.svg")),
              AllOf(HasSubstr("θ"), Not(HasSubstr("hand"))));
  EXPECT_THAT(read_text(folder.file("page.html/index.html")), HasSubstr("\"leftOut\":[0,1,"));
}

TEST(SetPartsOnTheCommandLine, SayTheirExactPointsAsOtherSetsDo) {
  const TemporaryFolder folder;
  const Words solve{"solve",  model("three_slider"), "--set",   "forward", "-D", "L2=1", "-o", folder.file("r.h5"),
                    "--json", folder.file("r.json"), "--kernel"};
  const auto points_by = [&](const std::string& kernel) {
    Words words = solve;
    words.push_back(kernel);
    const Outcome outcome = run_corank(words);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_THAT(outcome.out, Not(HasSubstr("[")));
    std::multiset<std::string> points;
    for (const json& point : json::parse(read_text(folder.file("r.json")))["points"]) {
      json exact = json::object();
      for (const char* name : {"y_A", "y_B", "x_C"}) exact[name] = point["exact"][name];
      points.insert(exact.dump());
    }
    return points;
  };
  EXPECT_EQ(points_by("none"), points_by("right"));
  points_by("none");
  const auto verified = [&](const std::function<void(Cover&)>& change) {
    result::Result result = result::read_result(folder.file("r.h5"));
    EXPECT_EQ(result.parts.size(), 2u);
    EXPECT_EQ(result.cover.exact_points.size(), 6u);
    change(result.cover);
    result::write_result(folder.file("changed.h5"), result);
    return run_corank({"verify", folder.file("changed.h5")});
  };
  EXPECT_EQ(verified([](Cover&) {}).status, 4);  // there is no proof of completeness
  const Outcome other = verified([](Cover& cover) { std::swap(cover.points[0].point, cover.points[1].point); });
  EXPECT_THAT(other.out, HasSubstr("the whole is not made of its parts"));
  EXPECT_EQ(other.status, 1);
  EXPECT_EQ(verified([](Cover& cover) { std::swap(cover.exact_points[0], cover.exact_points[1]); }).status, 1);
  const Outcome old = verified([](Cover& cover) {  // as an older program has left it
    cover.exact_points.clear();
    for (auto* boxes : {&cover.boxes, &cover.points})
      for (CoverBox& box : *boxes) box.point = -1;
  });
  EXPECT_EQ(old.status, 4) << old.out;
}

// The rails' directions are (-1/2, ±h) in the file; without a name for √3/2 corank gives it one.
TEST(SetPartsOnTheCommandLine, HaveNoNamesWithConstantsThatNobodyWrote) {
  const TemporaryFolder folder;
  std::string text = read_text(model("planar/3prr"));
  const auto replace = [&text](const std::string& from, const std::string& to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
      text.replace(at, from.size(), to);
  };
  replace("(-1/2, h, 0)", "(-1/2, sqrt(3)/2, 0)");
  replace("(-1/2, -h, 0)", "(-1/2, -sqrt(3)/2, 0)");
  folder.write("rails.cuik", text);
  const Outcome asked = run_corank({"solve", folder.file("rails.cuik"), "--set", "inverse", "--sigma", "inf", "--json",
                                    folder.file("r.json"), "-o", folder.file("r.h5")});
  EXPECT_EQ(asked.status, 0) << asked.err;
  EXPECT_THAT(asked.out, AllOf(HasSubstr("\n  1.73205*sin(psi2) - cos(psi2) = 0  "),
                               HasSubstr("\n  1.73205*sin(psi3) + cos(psi3) = 0  "), HasSubstr("\n  cos(psi1) = 0  ")));
  EXPECT_EQ(json::parse(read_text(folder.file("r.json")))["parts"][0]["condition"], "2*k1*sin(psi2) - cos(psi2) = 0");
  EXPECT_THAT(run_corank({"derive", folder.file("rails.cuik"), "--set", "inverse"}).out,
              HasSubstr("Constants that corank has named:\n  k1 = 0.5*sqrt(3)\n"));
  EXPECT_EQ(run_corank({"verify", folder.file("r.h5")}).status, 4);
  result::Result result = result::read_result(folder.file("r.h5"));
  result.parts[0].part = "2*k1*sin(psi2) - cos(psi2) = 0";  // as an older program called it
  result::write_result(folder.file("r.h5"), result);
  EXPECT_EQ(run_corank({"verify", folder.file("r.h5")}).status, 4);
  result.parts[0].part = "1.73206*sin(psi2) - cos(psi2) = 0";
  result::write_result(folder.file("r.h5"), result);
  EXPECT_EQ(run_corank({"verify", folder.file("r.h5")}).status, 1);
}

TEST(SetPartsOnTheCommandLine, AreLeftTogetherWhereAKernelIsAskedFor) {
  const Outcome whole = run_corank({"solve", model("dextar"), "--set", "inverse", "--kernel", "right"});
  EXPECT_THAT(whole.out, AllOf(HasSubstr("kernel right"), Not(HasSubstr("the union of"))));
  const Outcome parts = run_corank({"solve", model("dextar"), "--set", "inverse"});
  EXPECT_EQ(parts.status, 0) << parts.err;
  EXPECT_THAT(parts.out, HasSubstr("the union of 4 parts:"));
  EXPECT_THAT(parts.out, HasSubstr("  theta3 = theta2 + pi "));
  const Outcome right =
      run_corank({"solve", model("planar/3prr"), "--set", "inverse", "--kernel", "right", "--sigma", "2", "--estimate"});
  EXPECT_EQ(right.status, 0) << right.err;
  EXPECT_EQ(run_corank({"solve", model("dextar"), "--set", "cspace", "--kernel", "none"}).status, 2);
}

TEST(SetPartsOnTheCommandLine, AreDerivedOneByOne) {
  const Outcome parts = run_corank({"derive", model("dextar"), "--set", "forward", "--kernel", "none"});
  EXPECT_EQ(parts.status, 0) << parts.err;
  EXPECT_THAT(parts.out, HasSubstr("theta4 = theta3 + pi"));
  EXPECT_THAT(parts.out, Not(HasSubstr("xi1")));
  EXPECT_EQ(run_corank({"derive", model("dextar"), "--set", "forward", "--kernel", "none", "--format", "cuik"}).status, 2);
  EXPECT_EQ(run_corank({"derive", model("planar/3prr"), "--set", "inverse", "--format", "cuik"}).status, 0);
}

TEST(SetPartsOnTheCommandLine, AreSaidOnTheReportsPage) {
  const TemporaryFolder folder;
  const auto page_of = [&](const std::string& name, const std::string& sigma) {
    const Outcome report =
        run_corank({"report", model(name), "--sets", "inverse", "--sigma", sigma, "-o", folder.file("page")});
    EXPECT_EQ(report.status, 0) << report.err;
    std::ifstream file(folder.file("page") + "/index.html");
    std::stringstream page;
    page << file.rdbuf();
    return page.str();
  };
  const std::string platform = page_of("planar/3prr", "0.3");
  EXPECT_THAT(platform, HasSubstr("The set is the union of 3 parts: "));
  EXPECT_THAT(platform, HasSubstr("<summary>Inverse singularities: the union of 3 parts</summary>"));
  EXPECT_THAT(page_of("serial/ur5", "0.5"), HasSubstr("boxes, for every theta2 and theta5); sin(theta5) = 0 ("));
}

}  // namespace
}  // namespace corank::app
