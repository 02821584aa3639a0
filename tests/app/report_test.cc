// corank report: its page shows what its result files hold.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <csignal>
#include <nlohmann/json.hpp>

#include "corank/report/html/page_words.h"
#include "corank/report/pictures/box_payload.h"
#include "corank/result/files/result_file.h"
#include "corank/tests/app/program.h"
#include "corank/tests/report/page_text.h"

namespace corank::app {
namespace {

using nlohmann::json;
using report::script_text;
using testing::HasSubstr;

const std::vector<std::string> kSets{"cspace", "forward", "inverse", "cspace-singular"};

void expect_page_of_results(const std::string& page, const std::string& folder,
                            const std::vector<std::string>& sets = kSets) {
  const json model = json::parse(script_text(page, "model"));
  ASSERT_EQ(model["sets"].size(), sets.size());
  for (std::size_t i = 0; i < sets.size(); ++i) {
    const result::Result result = result::read_result(folder + "/" + sets[i] + ".h5");
    EXPECT_EQ(model["sets"][i]["name"], sets[i]);
    EXPECT_EQ(model["sets"][i]["count"], result.cover.boxes.size());
    EXPECT_EQ(script_text(page, "boxes-" + sets[i]), report::box_payload(result.cover.boxes));
    EXPECT_EQ(script_text(page, "verdicts-" + sets[i]), report::verdict_payload(result.cover.boxes));
  }
}

TEST(Report, OfARobotWithTiedOutputsSaysThem) {
  const TemporaryFolder folder;
  const std::string to = folder.file("spherical");
  const Outcome outcome = run_corank({"report", model("spherical_five_bar"), "--sets", "forward,inverse,cspace-singular",
                                      "--sigma", "0.05", "-o", to});  // without C-space no aspects are searched for
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("Inverse singularities: Curves: "));
  EXPECT_THAT(outcome.out, HasSubstr("C-space singularities: None\n"));
  const std::string page = read_text(to + "/index.html");
  expect_page_of_results(page, to, {"forward", "inverse", "cspace-singular"});
  EXPECT_THAT(
      page,
      HasSubstr(
          "<dd><i>w</i><sub>x</sub>, <i>w</i><sub>y</sub>, <i>w</i><sub>z</sub> <small>tied by 1 equation</small></dd>"));
  EXPECT_THAT(page, HasSubstr("(w @ unit)"));
}

TEST(Report, NamesTheRangesThatCutASet) {
  const TemporaryFolder folder;
  const std::string file = folder.write("cut.cuik",
                                        "[SYSTEM VARS]\nx : [-1/2, 1/2]\ny :\nt ~\n[SYSTEM EQS]\nx = cos(t);\ny = sin(t);\n"
                                        "[INPUTS] t\n[OUTPUTS] x\n");
  const std::string sentence = "The set reaches the end of the declared range of x; nothing beyond was searched.";
  const std::string to = folder.file("a"), again = folder.file("b");
  EXPECT_EQ(run_corank({"report", file, "-o", to}).status, 0);
  EXPECT_THAT(read_text(to + "/index.html"), HasSubstr(sentence));
  EXPECT_THAT(read_text(to + "/index.html"), HasSubstr("<dd><i>y</i> in [−1.01, 1.01], from the equations</dd>"));
  EXPECT_EQ(run_corank({"report", "--results", to + "/cspace.h5", "-o", again}).status, 0);
  EXPECT_THAT(read_text(again + "/index.html"), HasSubstr(sentence)) << "a result file holds what it takes to say so";
}

TEST(Report, SaysWhyAspectsAreNotKnown) {
  const TemporaryFolder folder;
  EXPECT_EQ(run_corank({"report", model("three_slider"), "-D", "L2=1", "-o", folder.file("page")}).status, 0);
  EXPECT_THAT(read_text(folder.file("page") + "/index.html"),  // which crosses itself
              HasSubstr("Not known: C-space is not shown to be smooth in the search domain."));
}

TEST(Report, OfTheThreeSliderHoldsItsResultFiles) {
  const TemporaryFolder folder;
  const std::string to = folder.file("new/slider");
  const Outcome outcome = run_corank({"report", model("three_slider"), "-o", to});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("Forward singularities: 8 points\nInverse singularities: 4 points\n"));
  EXPECT_THAT(outcome.out, HasSubstr("C-space singularities: None\n"));
  const std::string page = read_text(to + "/index.html");
  EXPECT_TRUE(page.starts_with("<!DOCTYPE html>"));
  EXPECT_NE(page.find("corank report three_slider.cuik"), std::string::npos);
  EXPECT_NE(page.find("8 aspects, 8 assembly modes, 4 working modes."), std::string::npos);
  expect_page_of_results(page, to);
  for (const char* figure : {"output-portrait.svg", "output-portrait.pdf", "input-portrait.svg", "input-portrait.pdf"}) {
    EXPECT_GT(std::filesystem::file_size(to + "/figures/" + figure), 1000u) << figure;
    EXPECT_NE(page.find(std::string("figures/") + figure), std::string::npos);
  }

  const std::string again = folder.file("again");
  const Outcome second = run_corank({"report", "--results", to + "/inverse.h5", to + "/cspace-singular.h5",
                                     to + "/forward.h5", to + "/cspace.h5", "-o", again});
  EXPECT_EQ(second.status, 0) << second.err;
  EXPECT_EQ(second.out.substr(0, second.out.rfind('\n', second.out.size() - 2)),
            outcome.out.substr(0, outcome.out.rfind('\n', outcome.out.size() - 2)));
  expect_page_of_results(read_text(again + "/index.html"), to);
}

TEST(Report, TakesConstantsAndSigmas) {
  const TemporaryFolder folder;
  const Outcome outcome = run_corank({"report", model("three_slider"), "--sets", "cspace,forward", "--cspace-sigma", "0.1",
                                      "-D", "L2=1", "-o", folder.file("r")});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(result::read_result(folder.file("r/cspace.h5")).cover.sigma, (Sigma{0.1, 0.1}));
  EXPECT_FALSE(std::filesystem::exists(folder.file("r/inverse.h5")));
  EXPECT_NE(read_text(folder.file("r/index.html")).find("L2 = 1"), std::string::npos);
}

TEST(Report, KeepsSheetsWholeInItsFilesAndCutsThemForThePage) {
  const TemporaryFolder folder;
  const Outcome outcome = run_corank({"report", model("planar/3prr"), "--sets", "inverse", "--max-found", "20000", "--proof",
                                      "--json", "-o", folder.file("r")});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const result::Result whole = result::read_result(folder.file("r/inverse.h5"));
  EXPECT_TRUE(std::isinf(whole.cover.sigma.length));
  EXPECT_TRUE(whole.parts[0].cover.proof);
  const std::string page = read_text(folder.file("r/index.html"));
  const json set = json::parse(script_text(page, "model"))["sets"][0];
  EXPECT_GT(set["count"], whole.cover.boxes.size());
  EXPECT_LE(set["count"], 20'000);
  EXPECT_THAT(page, HasSubstr("; drawn here: its " + report::grouped(whole.cover.boxes.size()) + " boxes, cut to σ</p>"));
  const json said = json::parse(outcome.out)["sets"][0];
  EXPECT_EQ(said["boxes_in_file"], whole.cover.boxes.size());
  EXPECT_GT(said["boxes"]["regular"], whole.cover.boxes.size());
}

TEST(Report, CutsBoxesWithPartsOfSheetsAsFinelyAsThePageAllows) {
  const TemporaryFolder folder;
  const Outcome outcome =
      run_corank({"report", model("planar/3prr"), "--sets", "cspace", "--max-found", "2000", "-o", folder.file("r")});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.err, "");
  const std::string page = read_text(folder.file("r/index.html"));
  EXPECT_LE(json::parse(script_text(page, "model"))["sets"][0]["count"], 2000);
  EXPECT_THAT(page, HasSubstr(" boxes, cut to σ</p>"));
  EXPECT_THAT(page, HasSubstr("or, where the box holds a part of a sheet, at most one</dd>"));
}

TEST(Report, OfACorankNamesItAndLeavesCSpaceAsItIs) {
  const TemporaryFolder folder;
  const Outcome outcome = run_corank({"report", model("dextar"), "--sets", "cspace,inverse", "--corank", "2",
                                      "--cspace-sigma", "0.5", "-o", folder.file("r")});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(result::read_result(folder.file("r/cspace.h5")).options.corank, 1);
  EXPECT_EQ(result::read_result(folder.file("r/inverse.h5")).options.corank, 2);
  const std::string page = read_text(folder.file("r/index.html"));
  EXPECT_NE(page.find("Inverse singularities of corank 2"), std::string::npos);
  EXPECT_NE(page.find("--corank 2"), std::string::npos);
  const Outcome again = run_corank({"report", "--results", folder.file("r/inverse.h5"), "-o", folder.file("again")});
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_THAT(again.out, HasSubstr("Inverse singularities of corank 2: "));
}

TEST(Report, OfALimitedSearchSaysSoAndHasStatus3) {
  const TemporaryFolder folder;
  const Outcome outcome = run_corank({"report", model("dextar"), "--max-boxes", "20", "-o", folder.file("r")});
  EXPECT_EQ(outcome.status, 3);
  EXPECT_THAT(outcome.err, HasSubstr("the report is incomplete"));
  EXPECT_NE(read_text(folder.file("r/index.html")).find("A search ended early"), std::string::npos);
}

TEST(Report, HasOneProgressLineOverAllSetsAndEndsWithWhatItHasAfterAnInterrupt) {
  const TemporaryFolder folder;
  CorankOnTerminal program({"report", model("dextar"), "--cspace-sigma", "0.005", "-o", folder.file("r")});
  ASSERT_TRUE(program.wait_for("cspace (1 of 4): "));
  program.signal(SIGINT);
  const Outcome outcome = program.finish();
  EXPECT_EQ(outcome.status, 3);
  EXPECT_THAT(outcome.err, HasSubstr("corank: cspace: stopped by an interrupt, in the stage "));
  EXPECT_THAT(outcome.err, HasSubstr("corank: inverse: its equations were not derived in time; it is left out"));
  EXPECT_FALSE(result::read_result(folder.file("r/cspace.h5")).cover.complete());
  EXPECT_NE(read_text(folder.file("r/index.html")).find("A search ended early"), std::string::npos);
}

TEST(Report, RefusesResultsThatDoNotBelongTogether) {
  const TemporaryFolder folder;
  const auto solve = [&](const std::string& name, const std::vector<std::string>& more, const std::string& set = "forward") {
    std::vector<std::string> args{"solve", model("three_slider"), "--set", set, "-o", folder.file(name)};
    args.insert(args.end(), more.begin(), more.end());
    EXPECT_EQ(run_corank(args).status, 0);
    return folder.file(name);
  };
  const std::string one = solve("one.h5", {}), same = solve("same.h5", {}), other = solve("other.h5", {"-D", "L2=1"});
  const Outcome twice = run_corank({"report", "--results", one, same, "-o", folder.file("r")});
  EXPECT_EQ(twice.status, 1);
  EXPECT_THAT(twice.err, HasSubstr("holds the set forward"));
  const std::string before = solve("before.h5", {}, "cspace");  // in the order of the sets
  for (const auto& [a, b] : {std::pair(before, other), {other, before}}) {
    const Outcome different = run_corank({"report", "--results", a, b, "-o", folder.file("r")});
    EXPECT_EQ(different.status, 1);
    EXPECT_THAT(different.err, HasSubstr("are results of different models, or with different constants"));
  }
  const Outcome both = run_corank({"report", model("three_slider"), "--results", other, "-o", folder.file("r")});
  EXPECT_EQ(both.status, 2);
  EXPECT_THAT(both.err, HasSubstr("--results: expected no FILE beside it"));
}

TEST(Report, RefusesAPlainSystemBeforeItSolvesAnything) {
  const TemporaryFolder folder;
  const std::string plain = folder.write("plain.cuik", "[SYSTEM VARS]\nx : [0, 2]\n[SYSTEM EQS]\nx^2 = 2;\n");
  const Outcome outcome = run_corank({"report", plain, "-o", folder.file("r")});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.err, HasSubstr("[INPUTS]"));
  EXPECT_FALSE(std::filesystem::exists(folder.file("r") + "/cspace.h5"));
}

}  // namespace
}  // namespace corank::app
