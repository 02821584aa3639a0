// corank sweep: its members are exact, its page shows what its result files hold, and Dextar's family agrees with closed
// forms.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <csignal>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>

#include "corank/report/pictures/box_payload.h"
#include "corank/report/pictures/components.h"
#include "corank/result/files/result_file.h"
#include "corank/tests/app/program.h"
#include "corank/tests/report/page_text.h"
#include "corank/tests/seeds.h"

namespace corank::app {
namespace {
using nlohmann::json;
using report::script_text;
using result::Result;
using testing::ElementsAre;
using testing::HasSubstr;

json page_model(const std::string& folder) { return json::parse(script_text(read_text(folder + "/index.html"), "model")); }

std::vector<std::string> values_of(const json& model) {
  std::vector<std::string> values;
  for (const json& member : model["members"]) values.push_back(member["text"]);
  return values;
}

/// The values of L2 that a sweep of the three-slider takes; its sets are small.
std::vector<std::string> values_for(const std::string& range) {
  const TemporaryFolder folder;
  const Outcome outcome =
      run_corank({"sweep", model("three_slider"), "-D", "L2=" + range, "--sets", "forward", "-o", folder.file("f")});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return values_of(page_model(folder.file("f")));
}

TEST(SweptValues, AreExactRationalsAndIncludeTheEnds) {
  EXPECT_THAT(values_for("0.7:1:4"), ElementsAre("0.7", "0.8", "0.9", "1"));
  EXPECT_THAT(values_for("1:1/3:3"), ElementsAre("1", "2/3", "1/3"));
  EXPECT_THAT(values_for("(1+1)/4:3*0.3:2"), ElementsAre("0.5", "0.9"));
}

TEST(SweptValues, OfIrrationalEndsStayExpressions) {
  const std::vector<std::string> values = values_for("sqrt(2)/2:L1:3");
  ASSERT_EQ(values.size(), 3u);
  EXPECT_EQ(values[0], "sqrt(2)/2");
  EXPECT_THAT(values[1], AllOf(HasSubstr("sqrt(2)"), HasSubstr("1/2"), HasSubstr("L1")));
  EXPECT_EQ(values[2], "L1");
}

TEST(SweepUsage, IsRefusedWithStatus2) {
  struct Case {
    std::vector<std::string> definitions;
    std::string expected;
  };
  const std::vector<Case> cases{{{}, "a constant to sweep is required"},
                                {{"L2=1"}, "a constant to sweep is required"},
                                {{"L2=0.5:1:3", "L1=1:2:3"}, "only one constant can be swept"},
                                {{"L2=0.5:1"}, "NAME=FROM:TO:COUNT"},
                                {{"L2=0.5::3"}, "NAME=FROM:TO:COUNT"},
                                {{"L2=:1:3"}, "NAME=FROM:TO:COUNT"},
                                {{"=0.5:1:3"}, "NAME=FROM:TO:COUNT"},
                                {{"L2=0.5:1:3:4"}, "NAME=FROM:TO:COUNT"},
                                {{"L2=0.5:1:1"}, "COUNT from 2 to 200"},
                                {{"L2=0.5:1:201"}, "COUNT from 2 to 200"},
                                {{"L2=0.5:1:2.5"}, "COUNT from 2 to 200"},
                                {{"L2=0.5:1:"}, "COUNT from 2 to 200"},
                                {{"L2=1/2:0.5:3"}, "two values FROM and TO that differ"},
                                {{"L2=0.5:1:3", "L1"}, "NAME=EXPR"}};
  for (const Case& c : cases) {
    const TemporaryFolder folder;
    std::vector<std::string> args{"sweep", model("three_slider"), "-o", folder.file("f")};
    for (const std::string& definition : c.definitions) args.insert(args.end(), {"-D", definition});
    const Outcome outcome = run_corank_in_a_copy(args, {});
    EXPECT_EQ(outcome.status, 2) << testing::PrintToString(c.definitions);
    EXPECT_THAT(outcome.err, HasSubstr(c.expected));
    EXPECT_FALSE(std::filesystem::exists(folder.file("f")));
  }
}

TEST(SweepBadInput, IsRefusedWithStatus1BeforeAnythingIsSolved) {
  const TemporaryFolder folder;
  const std::string plain =
      folder.write("plain.cuik", "[CONSTANTS]\na := 2\n[SYSTEM VARS]\nx : [0, 2]\n[SYSTEM EQS]\nx^2 = a;\n");
  const std::string slider = model("three_slider");
  for (const auto& [file, definition, expected] : {std::array{slider, std::string("L9=0.5:1:3"), std::string("L9")},
                                                   std::array{slider, std::string("L2=0.5:1+:3"), std::string("-D L2")},
                                                   std::array{slider, std::string("L2=1:1/0:3"), std::string("L2")},
                                                   std::array{plain, std::string("a=1:2:3"), std::string("[INPUTS]")}}) {
    const Outcome outcome = run_corank({"sweep", file, "-D", definition, "-o", folder.file("f")});
    EXPECT_EQ(outcome.status, 1) << definition << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(expected));
    EXPECT_FALSE(std::filesystem::exists(folder.file("f")));
  }
}

/// l2 = 1.6, 1.25, 0.9; l3 = l4 = l5 = 0.9; d = 1.18. J3 is |l2 − l3| = 0.7, 0.35, 0 away from J1 = (d, 0) at least.
class DextarFamily {
 public:
  DextarFamily()
      : outcome_(run_corank({"sweep", model("dextar"), "-D", "l2=1.6:0.9:3", "--cspace-sigma", "0.2", "--sigma", "0.05",
                             "-o", folder_.file("f")})) {
    EXPECT_EQ(outcome_.status, 0) << outcome_.err;
    for (int m = 0; m < kMembers; ++m)
      for (const std::string& set : kSets) results_[{m, set}] = result::read_result(path(file(m, set)));
  }
  void is_solved_whole() const;
  void shows_what_its_result_files_hold() const;
  void has_the_counts_of_its_results_in_the_table() const;
  void leaves_the_disc_about_j1_empty_that_the_links_do_not_reach() const;
  void has_the_inverse_locus_on_its_circles_and_nowhere_else() const;
  void shrinks_a_circle_of_inverse_singularities_to_a_point() const;
  void has_figures_with_the_same_axes() const;
  void can_be_verified() const;

 private:
  static constexpr int kMembers = 3;
  static constexpr double kBase = 1.18, kLink = 0.9, kTiny = 1e-12;
  static const std::array<std::string, 3> kSets;

  std::string path(const std::string& name) const { return folder_.file("f/" + name); }
  static std::string file(int member, const std::string& set) {
    return "member-" + std::to_string(member + 1) + "-" + set + ".h5";
  }
  const Result& result(int member, const std::string& set) const { return results_.at({member, set}); }
  static double l2(int member) { return 1.6 - 0.35 * member; }
  static double hole(int member) { return l2(member) - kLink; }

  const TemporaryFolder folder_;
  const Outcome outcome_;
  std::map<std::pair<int, std::string>, Result> results_;
};
const std::array<std::string, 3> DextarFamily::kSets{"cspace", "forward", "inverse"};

/// The distances from (x, 0) that the points of a box of J3 have.
std::pair<double, double> distances(const Box& box, double x) {
  const auto near = [](const Interval& side, double at) { return std::max({side.lo() - at, at - side.hi(), 0.0}); };
  const auto far = [](const Interval& side, double at) { return std::max(at - side.lo(), side.hi() - at); };
  return {std::hypot(near(box[0], x), near(box[1], 0)), std::hypot(far(box[0], x), far(box[1], 0))};
}

void DextarFamily::is_solved_whole() const {
  EXPECT_THAT(outcome_.out, HasSubstr("l2 = 1.25, C-space: Surfaces"));
  for (int m = 0; m < kMembers; ++m) {
    for (const std::string& set : kSets) {
      const Result& r = result(m, set);
      EXPECT_TRUE(r.cover.complete());
      const double sigma = set == "cspace" ? 0.2 : 0.05;
      EXPECT_EQ(r.cover.sigma, (Sigma{sigma, sigma}));
      ASSERT_EQ(r.options.constants.size(), 1u);
      EXPECT_EQ(r.options.constants[0], (result::ConstantOverride{"l2", std::array{"1.6", "1.25", "0.9"}[m]}));
      EXPECT_EQ(r.variables[0].name, "J3x");
      EXPECT_EQ(r.variables[1].name, "J3y");
    }
  }
}

void DextarFamily::shows_what_its_result_files_hold() const {
  const std::string page = read_text(path("index.html"));
  const json model = page_model(folder_.file("f"));
  EXPECT_EQ(model["constant"]["name"], "l2");
  EXPECT_EQ(model["coordinates"][0]["name"], "J3x");
  EXPECT_EQ(model["coordinates"][1]["name"], "J3y");
  ASSERT_EQ(model["members"].size(), static_cast<std::size_t>(kMembers));
  for (int m = 0; m < kMembers; ++m) {
    EXPECT_NEAR(model["members"][m]["value"].get<double>(), l2(m), kTiny);
    for (std::size_t s = 0; s < kSets.size(); ++s) {
      const Result& r = result(m, kSets[s]);
      const json& set = model["members"][m]["sets"][s];
      EXPECT_EQ(set["name"], kSets[s]);
      EXPECT_EQ(set["count"], r.cover.boxes.size());
      EXPECT_EQ(set["complete"], true);
      const std::string id = std::to_string(m) + "-" + kSets[s];
      EXPECT_EQ(script_text(page, "boxes-" + id), report::box_payload(r.cover.boxes, std::array{0, 1}));
      EXPECT_EQ(script_text(page, "verdicts-" + id), report::verdict_payload(r.cover.boxes));
      EXPECT_NE(page.find("href=\"" + file(m, kSets[s]) + "\""), std::string::npos);
    }
  }
}

void DextarFamily::has_the_counts_of_its_results_in_the_table() const {
  const std::string page = read_text(path("index.html"));
  const std::size_t begin = page.find("<section id=\"counts\">"), end = page.find("</section>", begin);
  const std::string table = page.substr(begin, end - begin);
  const std::regex row("<tr data-member=\"([0-9]+)\">(.*?)</tr>"), cell("<td[^>]*>([^<]*)</td>"), gap("\u202F");
  int rows = 0;
  for (std::sregex_iterator r(table.begin(), table.end(), row), none; r != none; ++r, ++rows) {
    const std::string cells = (*r)[2];
    std::vector<std::size_t> numbers, expected;
    for (std::sregex_iterator c(cells.begin(), cells.end(), cell); c != none; ++c)
      numbers.push_back(std::stoul(std::regex_replace((*c)[1].str(), gap, "")));
    for (const std::string& set : kSets) {
      const Result& own = result(rows, set);
      expected.push_back(static_cast<std::size_t>(report::components(own).count));
      expected.push_back(own.cover.boxes.size());
      for (int v = 0; v < kVerdicts; ++v) {
        const auto verdict = static_cast<Verdict>(v);
        bool occurs = false;
        for (int m = 0; m < kMembers; ++m) occurs = occurs || result(m, set).cover.count(verdict) > 0;
        if (occurs) expected.push_back(own.cover.count(verdict));
      }
    }
    EXPECT_EQ(numbers, expected) << "member " << rows;
  }
  EXPECT_EQ(rows, kMembers);
}

void DextarFamily::leaves_the_disc_about_j1_empty_that_the_links_do_not_reach() const {
  for (int m = 0; m < kMembers; ++m) {
    for (const std::string& set : kSets) {
      for (const CoverBox& b : result(m, set).cover.boxes)
        EXPECT_GE(distances(b.box, kBase).second, hole(m) - kTiny) << set << " of member " << m;
    }
  }
}

void DextarFamily::has_the_inverse_locus_on_its_circles_and_nowhere_else() const {
  for (int m = 0; m < kMembers; ++m) {
    for (const CoverBox& b : result(m, "inverse").cover.boxes) {
      if (b.verdict != Verdict::regular) continue;
      const auto holds = [&](double centre, double radius) {
        const auto [near, far] = distances(b.box, centre);
        return near <= radius + kTiny && radius <= far + kTiny;
      };
      EXPECT_TRUE(holds(kBase, hole(m)) || holds(kBase, l2(m) + kLink) || holds(0, 0) || holds(0, 2 * kLink))
          << b.box[0] << ' ' << b.box[1] << " of member " << m;
    }
  }
}

void DextarFamily::shrinks_a_circle_of_inverse_singularities_to_a_point() const {
  for (int m = 0; m < kMembers; ++m) {
    const Result& inverse = result(m, "inverse");
    int places = 0;
    for (int k = 0; k < 360; ++k) {
      const double t = k * M_PI / 180, x = kBase + hole(m) * std::cos(t), y = hole(m) * std::sin(t);
      if (std::hypot(x, y) > 2 * kLink - 1e-9) continue;  // beyond the reach of the other arm
      ++places;
      EXPECT_TRUE(std::any_of(inverse.cover.boxes.begin(), inverse.cover.boxes.end(),
                              [&](const auto& b) {
                                return b.box[0].lo() <= x + kTiny && x <= b.box[0].hi() + kTiny &&
                                       b.box[1].lo() <= y + kTiny && y <= b.box[1].hi() + kTiny;
                              }))
          << x << ' ' << y << " of member " << m;
    }
    EXPECT_GT(places, 250);
  }
}

void DextarFamily::has_figures_with_the_same_axes() const {
  const std::regex ranges("data-x=\"([^\"]*)\" data-y=\"([^\"]*)\"");
  std::vector<std::string> found;
  for (const char* name : {"member-1.svg", "member-2.svg", "member-3.svg", "family.svg"}) {
    const std::string svg = read_text(path(std::string("figures/") + name));
    EXPECT_NE(read_text(path("index.html")).find(std::string("figures/") + name), std::string::npos);
    for (std::sregex_iterator i(svg.begin(), svg.end(), ranges), none; i != none; ++i) found.push_back((*i)[0]);
  }
  ASSERT_EQ(found.size(), 6u);  // three alone, three side by side
  for (const std::string& text : found) EXPECT_EQ(text, found.front());
}

void DextarFamily::can_be_verified() const {
  const Outcome outcome = run_corank({"verify", path(file(0, "forward"))});
  EXPECT_EQ(outcome.status, 4) << outcome.out << outcome.err;  // all but its completeness
}

// One sweep for all of these.
TEST(Sweep, OfDextarAgreesWithItsFilesAndWithClosedForms) {
  const DextarFamily family;
  family.is_solved_whole();
  family.shows_what_its_result_files_hold();
  family.has_the_counts_of_its_results_in_the_table();
  family.leaves_the_disc_about_j1_empty_that_the_links_do_not_reach();
  family.has_the_inverse_locus_on_its_circles_and_nowhere_else();
  family.shrinks_a_circle_of_inverse_singularities_to_a_point();
  family.has_figures_with_the_same_axes();
  family.can_be_verified();
}

TEST(Sweep, OfALimitedSearchSaysSoAndHasStatus3) {
  const TemporaryFolder folder;
  const Outcome outcome =
      run_corank({"sweep", model("dextar"), "-D", "l2=1.6:0.9:2", "--max-boxes", "20", "-o", folder.file("f")});
  EXPECT_EQ(outcome.status, 3);
  EXPECT_THAT(outcome.err, HasSubstr("forward: stopped by the box limit, in the stage search\ncorank: l2 = 1.6, inverse: "));
  EXPECT_NE(read_text(folder.file("f/index.html")).find("A search ended early"), std::string::npos);
}

TEST(Sweep, HasTheSameResultsForAnyNumberOfThreads) {
  const TemporaryFolder folder;
  // In a long run C-space takes more memory than searches that are made ahead may; the loci do not.
  const std::string of_loci = test::long_run() ? "0.02" : "0.05", of_cspace = test::long_run() ? "0.03" : "0.1";
  const auto sweep = [&](const std::string& name, const std::string& threads) {
    return run_corank({"sweep", model("dextar"), "-D", "l2=1.6:0.9:3", "--sigma", of_loci, "--cspace-sigma", of_cspace,
                       "--threads", threads, "-o", folder.file(name)});
  };
  const Outcome one = sweep("1", "1"), four = sweep("4", "4");
  ASSERT_EQ(one.status, 0) << one.err;
  ASSERT_EQ(four.status, 0) << four.err;
  const auto findings = [](const Outcome& outcome) {
    return outcome.out.substr(0, outcome.out.rfind('\n', outcome.out.size() - 2));
  };
  EXPECT_EQ(findings(one), findings(four));
  EXPECT_EQ(page_model(folder.file("1")), page_model(folder.file("4")));
  for (const char* figure : {"family.svg", "member-1.svg", "member-2.svg", "member-3.svg"})
    EXPECT_EQ(read_text(folder.file("1/figures/") + figure), read_text(folder.file("4/figures/") + figure));
  for (const char* name :
       {"member-1-cspace.h5", "member-1-forward.h5", "member-1-inverse.h5", "member-2-cspace.h5", "member-2-forward.h5",
        "member-2-inverse.h5", "member-3-cspace.h5", "member-3-forward.h5", "member-3-inverse.h5"}) {
    const Result a = result::read_result(folder.file("1/") + name), b = result::read_result(folder.file("4/") + name);
    EXPECT_EQ(a.options.threads, 1);
    EXPECT_EQ(b.options.threads, 4);
    EXPECT_EQ(a.cover.statistics.processed, b.cover.statistics.processed);
    ASSERT_EQ(a.cover.boxes.size(), b.cover.boxes.size()) << name;
    std::size_t different = 0;
    for (std::size_t i = 0; i < a.cover.boxes.size(); ++i) {
      const CoverBox &x = a.cover.boxes[i], &y = b.cover.boxes[i];
      different +=
          x.box != y.box || x.verdict != y.verdict || x.free != y.free || x.region != y.region || x.types != y.types;
    }
    EXPECT_EQ(different, 0u) << name;
    EXPECT_EQ(a.cover.regions, b.cover.regions) << name;
  }
}

/// Interrupts a sweep of 200 members in its second; how many are on its page.
std::size_t members_when_interrupted(const std::string& threads, Outcome& outcome) {
  constexpr std::size_t kAsked = 200;
  const TemporaryFolder folder;
  CorankOnTerminal program({"sweep", model("dextar"), "-D", "l2=1.6:0.9:" + std::to_string(kAsked), "--sets", "inverse",
                            "--threads", threads, "-o", folder.file("f")});
  EXPECT_TRUE(program.wait_for("(2 of 200)"));
  program.signal(SIGINT);
  outcome = program.finish();
  EXPECT_EQ(outcome.status, 3);
  const std::size_t done = page_model(folder.file("f"))["members"].size();
  EXPECT_GE(done, 2u);
  EXPECT_LT(done, kAsked);
  const std::string ended = std::to_string(done) + " of 200 mechanisms are ";
  EXPECT_NE(read_text(folder.file("f/index.html")).find("The sweep ended early: " + ended + "here."), std::string::npos);
  EXPECT_THAT(outcome.err, HasSubstr(ended + "on the page"));
  EXPECT_TRUE(result::read_result(folder.file("f/member-001-inverse.h5")).cover.complete());
  for (std::size_t m = 2; m < done; ++m)  // the last one may be what an interrupt has left
    EXPECT_TRUE(
        result::read_result(folder.file("f/member-" + std::to_string(1000 + m).substr(1) + "-inverse.h5")).cover.complete());
  return done;
}

TEST(Sweep, LeavesWhatIsDoneWhenInterrupted) {
  Outcome outcome;
  members_when_interrupted("1", outcome);
  EXPECT_THAT(outcome.err, HasSubstr("stopped by an interrupt, in the stage "));
}

TEST(Sweep, LeavesWhatIsDoneWhenInterruptedAmongSearchesThatAreMadeAhead) {
  Outcome outcome;
  members_when_interrupted("2", outcome);
}

}  // namespace
}  // namespace corank::app
