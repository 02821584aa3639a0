// Results of surfaces and solids without a sigma: boxes that hold parts of sheets, of robots from their links and joints.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <random>
#include <string>

#include "corank/result/files/verification.h"
#include "corank/result/values/tallies.h"
#include "corank/study/answer.h"
#include "corank/study/model.h"
#include "corank/tests/seeds.h"

namespace corank::study {
namespace {

result::Result cspace(const std::string& robot) {
  return answer({.model = parse_model({robot, "robot.cuik"}).mechanism, .set = symbolic::SingularitySet::cspace},
                {.search = {.surfaces_whole = true}});
}

// The axes of the hand's joints are tilted, so that the sides of many variables are those of eliminated ones.
TEST(PartsOfSheets, OfWristsAreVerified) {
  const char* const kAxes[] = {"(0, 0, 1)", "(0, 3/5, 4/5)", "(4/5, 0, 3/5)", "(0, 5/13, 12/13)", "(12/13, 0, 5/13)"};
  std::size_t parts = 0;
  for (unsigned seed = 1; seed <= test::seeds(3); ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::uniform_int_distribution<int> any(1, 4);
    std::string joints;
    for (const auto& [name, from, to] : {std::tuple("q1", "base", "one"), {"q2", "one", "two"}, {"q3", "two", "hand"}})
      joints += fmt::format("revolute {0} : {1} O + {3}  {2} O + {3}  actuated\n", name, from, to,
                            kAxes[std::string(name) == "q1" ? 0 : any(random)]);
    const std::string point = " : point O (0, 0, 0)\n";
    const result::Result result = cspace("[LINKS]\nbase" + point + "one" + point + "two" + point + "hand" + point +
                                         "[JOINTS]\n" + joints + "[OUTPUTS]\ntool : orientation of hand\n");
    parts += result::parts_of_sheets(result);
    EXPECT_TRUE(result::verify(result).verified());
  }
  EXPECT_GT(parts, 0u);
}

// A platform of one orientation on three legs.
std::string platform(const std::string& longest) {
  std::string robot =
      "[LINKS]\n"
      "base : point A1 (1, 0, 0)  point A2 (-1/2, 0.9, 0)  point A3 (-1/2, -0.8, 0)\n"
      "plate : point B1 (0.4, 0.1, 0)  point B2 (-0.2, 0.4, 0.1)  point B3 (-0.3, -0.4, 0)\n"
      "along_x\nalong_y\n"
      "[JOINTS]\n"
      "prismatic x : base (0, 0, 0) + (1, 0, 0)  along_x (0, 0, 0) + (1, 0, 0)  range [-1, 1]\n"
      "prismatic y : along_x (0, 0, 0) + (0, 1, 0)  along_y (0, 0, 0) + (0, 1, 0)  range [-1, 1]\n"
      "prismatic z : along_y (0, 0, 0) + (0, 0, 1)  plate (0, 0, 0) + (0, 0, 1)  range [-1.5, 1.5]\n";
  for (const char leg : {'1', '2', '3'})
    robot += fmt::format("sph_prs_sph r{0} : base A{0}  plate B{0}  range [0.3, {1}]  actuated\n", leg, longest);
  return robot + "[OUTPUTS]\np : position of plate.B1\n";
}

// All of it is one sheet, which reaches beyond the legs' ranges: as one box it would say nothing of the robot.
TEST(PartsOfSheets, AreDividedWhereTheyReachFarBeyondTheDomain) {
  const result::Result possible = cspace(platform("2"));
  EXPECT_TRUE(possible.cover.complete());
  EXPECT_GT(possible.cover.count(Verdict::regular), possible.cover.count(Verdict::boundary));
  EXPECT_TRUE(cspace(platform("0.555")).cover.boxes.empty()) << "its legs are too short";
}

}  // namespace
}  // namespace corank::study
