// The systems of cusps and nodes: how many equations they have, what they are called, and what is refused.
#include <gmock/gmock.h>

#include "corank/result/values/sentences.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/symbolic/sets/cusps_and_nodes.h"
#include "corank/symbolic/sets/kernel_scale.h"
#include "corank/tests/models/cusps/asking.h"

namespace corank::test {
namespace {

using symbolic::ModelError;
using testing::HasSubstr;

symbolic::Mechanism model(const std::string& name) {
  return study::read_model(CORANK_SOURCE_DIR "/models/" + name + ".cuik").mechanism;
}

std::string error_of(const auto& f) {
  try {
    f();
  } catch (const ModelError& error) {
    return error.what();
  }
  return "";
}

System system_of(const symbolic::Mechanism& m, SingularitySet set) {
  return symbolic::algebrize(symbolic::singularity_system(m, set, std::nullopt, symbolic::kernel_scales(m, set)));
}

TEST(CuspsAndNodes, HaveTheMobilityLessTwoAsDimension) {
  for (const std::string name : {"dextar", "3rrr", "serial/orthogonal_3r_section", "spherical_five_bar", "planar/3rpr"})
    for (const SingularitySet set : {SingularitySet::forward_cusps, SingularitySet::inverse_cusps,
                                     SingularitySet::forward_nodes, SingularitySet::inverse_nodes}) {
      const symbolic::Mechanism m = model(name);
      const int mobility = system_of(m, SingularitySet::cspace).dimension();
      const System system = system_of(m, set);
      EXPECT_EQ(system.size() - static_cast<int>(system.equations.size()), mobility - 2) << name << ' ' << to_string(set);
    }
}

TEST(CuspsAndNodes, UseCoordinatesWhereTheMechanismHasItsOwnRates) {
  const symbolic::Mechanism m = model("serial/orthogonal_3r");
  ASSERT_TRUE(m.has_own_velocity_equation());
  const System own = system_of(m, SingularitySet::inverse_cusps),
               plain = system_of(m.without_rates(), SingularitySet::inverse_cusps);
  EXPECT_EQ(own.equations.size(), plain.equations.size());
  EXPECT_EQ(own.size(), plain.size());
  EXPECT_EQ(own.dimension(), 0) << "its first joint is held";
}

TEST(CuspsAndNodes, SayNothingOfAKernelsDimension) {
  const result::Result result = ask("serial/orthogonal_3r_section", SingularitySet::inverse_cusps);
  for (const result::ResultVariable& v : result.variables) EXPECT_NE(v.kind, VariableKind::kernel);
  for (const CoverBox& box : result.cover.boxes) EXPECT_EQ(box.kernel_at_most, CoverBox{}.kernel_at_most);
}

TEST(CuspsAndNodes, NeedAMobilityOfTwoAndNoOtherCorank) {
  const symbolic::Mechanism four_bar = model("planar/four_bar_crank_rocker");
  EXPECT_THAT(error_of([&] { symbolic::singularity_system(four_bar, SingularitySet::forward_cusps); }),
              HasSubstr("expected a mobility of 2 or more"));
  const symbolic::Mechanism dextar = model("dextar");
  EXPECT_THAT(error_of([&] {
                symbolic::singularity_system(dextar, SingularitySet::forward_nodes, {}, {"1", "2"});
              }),
              HasSubstr("2 scales"));
  EXPECT_THAT(error_of([&] { symbolic::singularity_system(dextar, SingularitySet::forward_cusps, {}, {}, 2); }),
              HasSubstr("no corank"));
}

// Two of the six have their end on the first axis, where joint 1 turns in vain: no cusps.
TEST(Cusps, AreNotClaimedWhereACoordinateIsHeldThatIsNotLocked) {
  const result::Result arm = ask("serial/orthogonal_3r", SingularitySet::inverse_cusps);
  EXPECT_EQ(arm.cover.points.size(), 6u);
  EXPECT_THAT(result::locus_sentence(arm),
              HasSubstr("6 solutions of the equations of cusps, with theta1 held; it is proven that each"));
  EXPECT_THAT(result::locus_sentence(ask("planar/3rpr_innocenti", SingularitySet::forward_cusps)),
              HasSubstr("it is proven that around these 5 cusps assembly modes can change without a forward singularity"));
}

// All of Dextar's links are equally long: with an arm folded it has self-motions.
TEST(Cusps, AreNeitherClaimedNorDeniedAlongLargerSets) {
  result::Result dextar = ask("dextar", SingularitySet::forward_cusps);
  const auto is_open =
      testing::AllOf(HasSubstr("no cusp is proven; in "), HasSubstr("the equations hold, or may hold, along larger sets"));
  EXPECT_THAT(result::locus_sentence(dextar), is_open);
  // Of a larger set that is no self-motion there are no points either.
  dextar.cover.points.clear();
  for (CoverBox& box : dextar.cover.boxes) box.motion = -1;
  EXPECT_THAT(result::locus_sentence(dextar), is_open);
}

TEST(Nodes, AreThoseOfTheLocusThatIsNotEmptyForAPlainReason) {
  EXPECT_EQ(symbolic::nodes_of(model("serial/orthogonal_3r_section")), SingularitySet::inverse_nodes);
  EXPECT_EQ(symbolic::nodes_of(model("serial/orthogonal_3r")), SingularitySet::inverse_nodes);
  EXPECT_EQ(symbolic::nodes_of(model("planar/3rpr_innocenti")), SingularitySet::forward_nodes) << "no leg has length 0";
  EXPECT_THAT(error_of([&] { symbolic::nodes_of(model("dextar")); }), HasSubstr("expected forward-nodes or inverse-nodes"));
}

TEST(Nodes, NameTheSecondConfigurationAfterTheFirst) {
  const result::Result result = ask("serial/orthogonal_3r_section", SingularitySet::inverse_nodes);
  std::vector<std::string> names;
  for (const Angle& a : result.angles) names.push_back(a.name);
  EXPECT_THAT(names, testing::ElementsAre("theta2", "theta3", "theta2_2", "theta3_2"));
}

}  // namespace
}  // namespace corank::test
