// The types of singularity on the command line: in the table, in JSON, in result files and on the report's page.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "corank/tests/app/solved.h"

#include "corank/tests/app/program.h"

namespace corank::app {
namespace {
using nlohmann::json;
using testing::HasSubstr;

TEST(TypesOnTheCommandLine, AreCountedInJsonAndListedWithEachPoint) {
  const json forward = solved({model("three_slider"), "--set", "forward"});
  const json types = {{"RO", 4}, {"RPM", 4}, {"II", 8}, {"RI", 0}, {"IO", 4}, {"IIM", 0}, {"unproven", 0}};
  EXPECT_EQ(forward["types"], types);
  for (const json& point : forward["points"]) {
    EXPECT_EQ(point["typed"], true);
    const bool moves_the_output = point["exact"]["x_C"] != "0";
    EXPECT_EQ(point["types"], moves_the_output ? json({"RO", "II"}) : json({"RPM", "II", "IO"})) << point;
  }
  EXPECT_EQ(solved({model("three_slider"), "--set", "cspace"})["types"], json());
}

TEST(TypesOnTheCommandLine, SayNothingOfImpossibleInputsWhereMotorsAreTooMany) {
  const json arms = solved({model("planar/three_arms"), "--set", "forward"});
  EXPECT_EQ(arms["options"]["kernel"], "right");
  EXPECT_EQ(arms["types"]["II"], json());
  EXPECT_EQ(arms["types"]["RO"], 8);
  EXPECT_EQ(arms["types"]["unproven"], 0);
}

TEST(TypesOnTheCommandLine, MakeSetsThatTellWhatTheyLeaveOut) {
  const json ro = solved({model("three_slider"), "--set", "ro"});
  EXPECT_EQ(ro["points"].size(), 4u);
  EXPECT_EQ(ro["left_out"], 4);
  const Outcome table = run_corank({"solve", model("three_slider"), "--set", "ro"});
  EXPECT_THAT(table.out, HasSubstr("types: RO in 4 boxes, II in 4 boxes\n"));
  EXPECT_THAT(table.out, HasSubstr("4 boxes of the kernel's set left out: no solution in them has the set's type"));
}

TEST(TypesOnTheCommandLine, AreVerifiedFromTheFile) {
  const TemporaryFolder folder;
  for (const std::string set : {"forward-inverse", "rpm", "io", "iim"}) {
    ASSERT_EQ(run_corank({"solve", model("three_slider"), "-D", "L2=1", "--set", set, "--proof", "-o", folder.file("r.h5")})
                  .status,
              0);
    const Outcome outcome = run_corank({"verify", folder.file("r.h5")});
    // Of io two boxes were left out, and the proof of completeness with them.
    EXPECT_EQ(outcome.status, set == "io" ? 4 : 0) << set << '\n' << outcome.out << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr(set == "io" ? "verified, except for completeness\n" : "\nverified\n")) << set;
  }
}

TEST(TypesOnTheCommandLine, AreSaidOnThePage) {
  const TemporaryFolder folder;
  ASSERT_EQ(run_corank({"report", model("three_slider"), "--sets", "cspace,forward", "-o", folder.file("page")}).status, 0);
  const std::string page = read_text(folder.file("page") + "/index.html");
  EXPECT_THAT(page, HasSubstr("has the type RO (redundant output: with the actuators locked the output can still move)."));
  EXPECT_THAT(page, HasSubstr("impossible input: the actuators cannot achieve some velocity"));
}

}  // namespace
}  // namespace corank::app
