// The sets of a leg whose shank a parallelogram drives, against its flat positions.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include "corank/result/files/verification.h"
#include "corank/study/answer.h"
#include "corank/study/model.h"

namespace corank::study {
namespace {

using std::numbers::pi;

constexpr const char* kLeg =
    "[LINKS]\nhip\nthigh\ncrank\nrod\nshank\n[JOINTS]\n"
    "revolute q1 : hip (0,0,0)+(0,0,1) thigh (0,0,0)+(0,0,1) actuated\n"
    "revolute q2 : hip (0,0,0)+(0,0,1) crank (0,0,0)+(0,0,1) actuated\n"
    "revolute : thigh (11,0,0)+(0,0,1) shank (0,0,0)+(0,0,1)\n"
    "revolute : crank (3,0,0)+(0,0,1) rod (0,0,0)+(0,0,1)\n"
    "revolute : rod (11,0,0)+(0,0,1) shank (3,0,0)+(0,0,1)\n"
    "[OUTPUTS]\nF : position of shank (-12,0,0)\n";

bool is_in_some_box(const result::Result& result, const std::map<std::string, double>& angles) {
  for (const CoverBox& box : result.cover.boxes) {
    bool inside = true;
    for (std::size_t j = 0; inside && j < result.variables.size(); ++j) {
      const std::string& name = result.variables[j].name;
      if (name.size() < 3 || !angles.contains(name.substr(2))) continue;
      const double angle = angles.at(name.substr(2)), value = name[0] == 'c' ? std::cos(angle) : std::sin(angle);
      inside = box.box[j].lo() - 1e-12 <= value && value <= box.box[j].hi() + 1e-12;
    }
    if (inside) return true;
  }
  return false;
}

// L_y has the columns of rod and shank alone: it loses rank where these are parallel, that is where the loop is flat.
TEST(ParallelogramSets, AreProvenAtFlatPositionsOnBothBranches) {
  const Model leg = parse_model({kLeg, "leg.cuik", "."});
  ASSERT_EQ(leg.assembly->parallelograms.size(), 1u);
  Options coarse;
  coarse.search.sigma = 1;
  const result::Result result = answer({leg.mechanism, symbolic::SingularitySet::forward}, coarse);
  EXPECT_TRUE(result.cover.complete());
  ASSERT_FALSE(result.cover.boxes.empty());
  for (const CoverBox& box : result.cover.boxes)
    EXPECT_TRUE(box.verdict == Verdict::regular || box.verdict == Verdict::boundary);
  EXPECT_TRUE(result::verify(result).verified());
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> angle(-pi, pi);
  for (int trial = 0; trial < 200; ++trial) {
    const double q1 = angle(random), crosswise = trial % 2 == 0 ? 0 : pi, fold = trial % 4 < 2 ? 0 : pi;
    EXPECT_TRUE(is_in_some_box(
        result, {{"q1", q1}, {"q2", q1 + fold}, {"phi_rod", q1}, {"phi_shank", q1 + fold}, {"crosswise", crosswise}}))
        << q1 << ' ' << fold << ' ' << crosswise;
  }
}

TEST(ParallelogramSets, OfCSpaceNameTheFlatPositions) {
  const Model leg = parse_model({kLeg, "leg.cuik", "."});
  const result::Result result = answer({leg.mechanism, symbolic::SingularitySet::cspace_singular});
  EXPECT_TRUE(result.cover.complete());
  EXPECT_GE(result.cover.self_motions.size(), 4u);  // two branches, stretched out or folded
  for (const CoverBox& box : result.cover.boxes) EXPECT_NE(box.verdict, Verdict::undecided);
}

}  // namespace
}  // namespace corank::study
