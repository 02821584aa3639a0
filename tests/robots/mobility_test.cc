// What the parts of known linkages leave to move: by the count of equations, of joints, and by the rank at a configuration.
#include <gtest/gtest.h>

#include <algorithm>

#include "corank/study/answer.h"
#include "corank/study/model.h"

namespace corank {
namespace {

study::Model model(const std::string& name) { return study::read_model(CORANK_SOURCE_DIR "/models/" + name + ".cuik"); }

struct Known {
  const char* name;
  kinematics::Space space;
  int mobility, by_joints;
  bool paradoxical;
  int by_rank;
};

TEST(Mobility, OfKnownLinkages) {
  using enum kinematics::Space;
  const std::vector<Known> list{
      {"spatial/rssr", spatial, 1, 1, false, 1},
      {"spatial/spherical_four_bar", spherical, 1, 1, false, 1},
      {"spatial/spherical_five_bar", spherical, 2, 2, false, 2},
      {"spatial/agile_eye", spherical, 3, 3, false, 3},
      {"spatial/bennett", spatial, -2, -2, true, 1},
      {"spatial/bricard_trihedral", spatial, -1, 0, true, 1},
      {"spatial/sarrus", spatial, 1, 0, false, 1},       // parallel axes are seen, and what they repeat is left out
      {"spatial/cyclohexane", spatial, 0, 0, false, 0},  // at a chair, the first that sampling finds
      {"serial/six_r", spatial, 0, 0, false, 0},
      {"serial/iiwa_locked", spatial, 0, 0, false, 0},
      {"serial/orthogonal_3r", spatial, 3, 3, false, 3},
      {"serial/puma_560", spatial, 6, 6, false, 6},
      {"serial/ur5", spatial, 6, 6, false, 6},
  };
  for (const Known& known : list) {
    SCOPED_TRACE(known.name);
    const study::Model read = model(known.name);
    EXPECT_EQ(read.assembly->space, known.space);
    EXPECT_EQ(read.assembly->mobility, known.mobility);
    EXPECT_EQ(read.assembly->mobility_by_joints, known.by_joints);
    EXPECT_EQ(read.assembly->mobility_by_rank, known.by_rank);
    EXPECT_EQ(!read.notices.empty(), known.paradoxical);
  }
}

// A scissor lift: its two sliders' links lie on each other where drive is 0, which the range excludes.
TEST(Mobility, IsSampledWithinTheRangesOfJoints) {
  const std::string bar = " : point A (0, 0, 0) point M (1/2, 0, 0) point T (1, 0, 0)\n";
  const auto lift = [&](const std::string& range) {
    return study::parse_model(
        {"[LINKS]\nfloor : point A (0, 0, 0)\nslider : point B (0, 0, 0)\na1" + bar + "b1" + bar + "a2" + bar + "b2" + bar +
             "top : point P (0, 0, 0)\n[JOINTS]\nprismatic drive : floor A + (1, 0, 0)  slider B + (1, 0, 0)  range " +
             range +
             "  actuated\nrevolute : floor A + (0, 0, 1)  a1 A + (0, 0, 1)\nrevolute : slider B + (0, 0, 1)  b1 A + (0, 0, "
             "1)\n"
             "revolute : a1 M + (0, 0, 1)  b1 M + (0, 0, 1)\nrevolute : a1 T + (0, 0, 1)  b2 A + (0, 0, 1)\n"
             "revolute : b1 T + (0, 0, 1)  a2 A + (0, 0, 1)\nrevolute : a2 M + (0, 0, 1)  b2 M + (0, 0, 1)\n"
             "revolute : b2 T + (0, 0, 1)  top P + (0, 0, 1)\nslot pin : top P + (1, 0, 0)  a2 T  range [-3/2, 3/2]\n"
             "[OUTPUTS]\nh : position of top.P only y\n",
         "lift.cuik"});
  };
  const auto has_paradox = [](const study::Model& read) {
    return std::ranges::any_of(read.notices, [](const std::string& n) { return n.find("paradoxical") != n.npos; });
  };
  EXPECT_FALSE(has_paradox(lift("[1/4, 9/10]")));
}

Cover cspace(const std::string& name) {
  const study::Model read = model(name);
  return study::answer({.model = read.mechanism, .assembly = read.assembly}).cover;
}

TEST(Bennett, MovesAlongACurveOfPartialBoxes) {
  const Cover cover = cspace("spatial/bennett");
  EXPECT_TRUE(cover.complete());
  EXPECT_EQ(cover.dimension, 1);
  EXPECT_GT(cover.boxes.size(), 50u);
  EXPECT_EQ(cover.count(Verdict::partial), cover.boxes.size());
}

TEST(Bennett, DoesNotMoveWithoutItsCondition) {
  const study::Model read = study::read_model(CORANK_SOURCE_DIR "/models/spatial/bennett.cuik", {{"a", "1/2"}});
  EXPECT_NE(read.assembly->mobility_by_rank, 1);
}

TEST(Bricard, MovesAlongACurveOfPartialBoxes) {
  const Cover cover = cspace("spatial/bricard_trihedral");
  EXPECT_TRUE(cover.complete());
  EXPECT_EQ(cover.dimension, 1);
  EXPECT_GT(cover.count(Verdict::partial), 100u);
}

TEST(Sarrus, MovesAlongACurveThatIsProven) {
  const Cover cover = cspace("spatial/sarrus");
  EXPECT_TRUE(cover.complete());
  EXPECT_EQ(cover.dimension, 1);
  EXPECT_EQ(cover.count(Verdict::regular), cover.boxes.size());
}

TEST(SixRevolutes, HaveEightPostures) {
  const Cover cover = cspace("serial/six_r");
  EXPECT_TRUE(cover.complete());
  EXPECT_EQ(cover.count(Verdict::isolated), 8u);
  EXPECT_EQ(cover.boxes.size(), 8u);
}

}  // namespace
}  // namespace corank
