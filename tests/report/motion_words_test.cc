#include "corank/result/values/sentences.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "corank/report/html/page_words.h"
#include "corank/result/values/summary.h"
#include "corank/solve/search/solve.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/symbolic/sets/singularity_system.h"

namespace corank::report {
namespace {
using testing::ElementsAre;
using testing::HasSubstr;

struct Part {
  const char *factor, *name;  // no name: a constant
};

Polynomial relation(const System& system, const std::vector<Part>& parts) {
  Polynomial f;
  for (const Part& part : parts) {
    std::vector<Factor> factors;
    if (part.name) factors.push_back({system.find(part.name), 1});
    f.monomials.emplace_back(ExactNumber::rational(part.factor), std::move(factors));
  }
  return f;
}

// The words for a set of dimension 1 of a plain system, with these relations.
std::string words(const std::string& text, const std::vector<std::vector<Part>>& relations, int dimension = 1) {
  const symbolic::Mechanism model = symbolic::parse_model(text, "model.cuik");
  const System system = symbolic::algebrize(symbolic::plain_system(model));
  result::Result result;
  result.set = "system";
  result::describe_system(system, result);
  result.cover.self_motions.push_back({dimension, {}});
  for (const auto& parts : relations) result.cover.self_motions[0].relations.push_back(relation(system, parts));
  result::describe_in_words(model, system, result);
  return result.motions.at(0);
}

// Two angles that no equation binds but their circles.
const std::string kAngles = "[SYSTEM VARS]\na ~ [-pi, pi]\nb ~ [-pi, pi]\n[DUMMY VARS]\nw : [0, 2]\n[SYSTEM EQS]\nw = 1;\n";

std::string tied(const char* cosine_factor, const char* cosine_of, const char* sine_factor, const char* sine_of) {
  return words(kAngles, {{{"1", "c_b"}, {cosine_factor, cosine_of}}, {{"1", "s_b"}, {sine_factor, sine_of}}});
}

TEST(MotionWords, NameAnAngleThatFollowsAnother) {
  EXPECT_EQ(tied("-1", "c_a", "-1", "s_a"), "a turns freely: b = a");
  EXPECT_EQ(tied("-1", "c_a", "1", "s_a"), "a turns freely: b = -a");
  EXPECT_EQ(tied("1", "c_a", "1", "s_a"), "a turns freely: b = a + 180°");
  EXPECT_EQ(tied("1", "c_a", "-1", "s_a"), "a turns freely: b = 180° - a");
  EXPECT_EQ(tied("-1", "s_a", "-1", "c_a"), "a turns freely: b = 90° - a");
  EXPECT_EQ(tied("1", "s_a", "-1", "c_a"), "a turns freely: b = a + 90°");
  EXPECT_EQ(tied("-1", "s_a", "1", "c_a"), "a turns freely: b = a - 90°");
  EXPECT_EQ(tied("1", "s_a", "1", "c_a"), "a turns freely: b = -a - 90°");
}

TEST(MotionWords, PrintOtherRelationsAsTheyAre) {
  EXPECT_EQ(tied("-1/2", "c_a", "-1", "s_a"), "a moves along a curve: cos b = 1/2*cos a, sin b = sin a");
  EXPECT_EQ(words(kAngles, {{{"1", "c_b"}, {"-1", "c_a"}}}), "a moves along a curve: cos b = cos a")
      << "the sine may have either sign";
}

TEST(MotionWords, NameAnAngleThatStays) {
  EXPECT_EQ(words(kAngles, {{{"1", "c_b"}, {"-1", nullptr}}}), "with b = 0, a turns freely");
  EXPECT_EQ(words(kAngles, {{{"1", "c_b"}, {"1", nullptr}}, {{"1", "s_b"}}}), "with b = 180°, a turns freely");
  EXPECT_EQ(words(kAngles, {{{"2", "s_b"}, {"2", nullptr}}}), "with b = -90°, a turns freely");
  EXPECT_EQ(words(kAngles, {{{"1", "s_b"}}}), "with sin b = 0, a turns freely") << "0 or 180°";
  EXPECT_EQ(words(kAngles, {{{"1", "c_b"}, {"-3/5", nullptr}}, {{"1", "s_b"}, {"-4/5", nullptr}}}),
            "with cos b = 3/5, sin b = 4/5, a turns freely");
}

TEST(MotionWords, SayFreelyOnlyWhereNoOtherEquationBindsIt) {
  const std::string model =
      "[SYSTEM VARS]\nx : [-3, 3]\ny : [-3, 3]\nz : [-3, 3]\n[SYSTEM EQS]\nx^2 + y^2 + z = 4;\nz*x = 0;\n";
  EXPECT_EQ(words(model, {{{"1", "z"}}}), "with z = 0, x and y move along a curve");
  EXPECT_EQ(words("[SYSTEM VARS]\nx : [-3, 3]\nz : [-3, 3]\n[SYSTEM EQS]\nz*x = 0;\nx*z + z = 0;\n", {{{"1", "z"}}}),
            "with z = 0, x moves freely");
}

TEST(MotionWords, FollowEquationsThatTheRelationsMakeLinear) {
  EXPECT_EQ(words("[SYSTEM VARS]\nx : [-3, 3]\ny : [-3, 3]\nz : [-3, 3]\n[SYSTEM EQS]\ny*z + x = 2*z + y*x;\nz*x = x;\n",
                  {{{"1", "z"}, {"-1", nullptr}}}, 1),
            "with z = 1, x and y move along a curve");
  EXPECT_EQ(words("[SYSTEM VARS]\nx : [-3, 3]\ny : [-3, 3]\nz : [-3, 3]\n[SYSTEM EQS]\ny*z + x = 2*z;\nz*x = x;\n",
                  {{{"1", "z"}, {"-1", nullptr}}}, 1),
            "with z = 1, x moves freely: y = 2 - x");
}

TEST(MotionWords, AreNoneForRelationsThatAreNotLinear) {
  const symbolic::Mechanism model = symbolic::parse_model(kAngles, "model.cuik");
  const System system = symbolic::algebrize(symbolic::plain_system(model));
  result::Result result;
  result::describe_system(system, result);
  result.cover.self_motions.push_back({1, {}});
  result.cover.self_motions[0].relations.push_back({{{ExactNumber(1), {{0, 2}}}}, ""});
  result::describe_in_words(model, system, result);
  EXPECT_THAT(result.motions, ElementsAre(""));
}

result::Result solved(const std::string& text, symbolic::SingularitySet set) {
  const symbolic::Mechanism model = symbolic::parse_model(text, "model.cuik");
  const System system = symbolic::algebrize(symbolic::singularity_system(model, set));
  result::Result result;
  result.set = to_string(set);
  result.cover = solve::solve(system);
  result::describe_system(system, result);
  result::describe_in_words(model, system, result);
  return result;
}
result::Result rhombus(symbolic::SingularitySet set) {
  return solved(
      "[SYSTEM VARS]\nt1 ~ [-pi, pi]\nt2 ~ [-pi, pi]\nt3 ~ [-pi, pi]\n[SYSTEM EQS]\ncos(t1) + cos(t2) = 1 + cos(t3);\n"
      "sin(t1) + sin(t2) = sin(t3);\n[INPUTS] t1\n[OUTPUTS] t3\n",
      set);
}

TEST(MotionWords, NameWhatIsLockedInTableAndPageAndBesideTheRelations) {
  const result::Result forward = rhombus(symbolic::SingularitySet::forward);
  const std::string text = "a self-motion of dimension 1: with the input locked at t1 = 0, t2 turns freely: t3 = t2";
  EXPECT_THAT(result::to_table(forward), HasSubstr(text));
  const auto json = nlohmann::json::parse(to_json(forward));
  ASSERT_EQ(json["self_motions"].size(), 1u);
  EXPECT_EQ(json["self_motions"][0]["text"], text);
  EXPECT_EQ(json["self_motions"][0]["relations"].size(), 5u);
  const SetWords said = set_words(forward, components(forward));
  EXPECT_THAT(said.finding, HasSubstr("1 set of larger dimension than expected"));
  EXPECT_THAT(said.proven, testing::Contains(HasSubstr(text)));
  EXPECT_THAT(result::to_table(rhombus(symbolic::SingularitySet::inverse)),
              HasSubstr("with the output locked at t3 = 180°, t1 turns freely: t2 = t1 + 180°"));
}

// A kite: with the crank on the frame, coupler and rocker turn together. The second rate follows from the coordinates.
TEST(MotionWords, SayFreelyWhereAnEquationOnlyGivesARate) {
  EXPECT_THAT(result::to_table(solved("[SYSTEM VARS]\nt1 ~ [-pi, pi]\nt2 ~ [-pi, pi]\nt3 ~ [-pi, pi]\n[SYSTEM EQS]\n"
                                      "4*cos(t1) + 7*cos(t3) = 4 + 7*cos(t2);\n4*sin(t1) + 7*sin(t3) = 7*sin(t2);\n"
                                      "[INPUTS] t1\n[OUTPUTS] t2\n",
                                      symbolic::SingularitySet::forward)),
              HasSubstr("with the input locked at t1 = 0, t2 turns freely: t3 = t2"));
}

// Two kernels at one configuration, whose vectors are many: a length that follows from an angle that stays does not move.
TEST(MotionWords, SayThatNothingMovesWhereOnlyKernelVectorsDo) {
  const std::string model =
      "[SYSTEM VARS]\na ~ [-pi, pi]\nb ~ [-pi, pi]\ny : [-3, 3]\n[DUMMY VARS]\nw : [0, 2]\n[SYSTEM EQS]\nw = 1;\n";
  const std::vector<Part> stays = {{"1", "c_a"}, {"-3/5", nullptr}}, follows = {{"1", "y"}, {"-2", "s_a"}},
                          also_stays = {{"1", "c_b"}};
  EXPECT_EQ(words(model, {stays, also_stays, follows}), "no coordinate moves, with cos a = 3/5, cos b = 0 and y = 2*sin a");
  EXPECT_EQ(words(model, {stays, follows}), "with cos a = 3/5 and y = 2*sin a, b turns freely");
}

}  // namespace
}  // namespace corank::report
