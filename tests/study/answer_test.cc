// From a question to a result: what the library gives is what the command line gives.
#include "corank/study/answer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "corank/result/files/verification.h"
#include "corank/result/values/summary.h"
#include "corank/study/model.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/tests/result/sample_result.h"
#include "corank/tests/system_builder.h"

namespace corank::study {
namespace {

using symbolic::SingularitySet;

symbolic::Mechanism three_slider() { return symbolic::read_model(CORANK_SOURCE_DIR "/models/three_slider.cuik"); }

TEST(Answer, HoldsThePointsOfASetAndIsVerified) {
  const result::Result result = answer({three_slider(), SingularitySet::forward});
  EXPECT_EQ(result.set, "forward");
  EXPECT_TRUE(result.cover.complete());
  EXPECT_EQ(result.cover.points.size(), 8u);
  EXPECT_TRUE(result::verify(result, result::system_of(result), {}).verified());
}

// Lengths of hundreds beside directions: what counts as a large entry of L must not depend on the unit.
TEST(Answer, OfAPlatformInMillimetresHasItsKernelsVerified) {
  result::Result result =
      answer({read_model(CORANK_SOURCE_DIR "/models/platforms/hexapod.cuik").mechanism, SingularitySet::forward});
  const auto is_one = [](const CoverBox& box) { return box.kernel_at_most == 1; };
  EXPECT_TRUE(std::all_of(result.cover.boxes.begin(), result.cover.boxes.end(), is_one));
  const System equations = result::system_of(result);
  EXPECT_TRUE(result::verify(result, equations, {}).verified());
  result.cover.boxes.front().kernel_at_most = 0;
  EXPECT_FALSE(result::verify(result, equations, {}).verified());
}

// The platform's position is an affine function of a leg's end, whose sides end where the position's range does, rounded
// outward.
TEST(Answer, OfARangeThatAnAffineFunctionHasIsVerifiedUpToItsEnds) {
  Options coarse;
  coarse.search.sigma = 3;
  result::Result result =
      answer({read_model(CORANK_SOURCE_DIR "/models/platforms/stewart.cuik").mechanism, SingularitySet::cspace}, coarse);
  EXPECT_TRUE(result.cover.complete());
  EXPECT_TRUE(result::verify(result).verified());
  // Farther beyond, it is not.
  const auto is_at_end = [&](const CoverBox& box) {
    return box.verdict == Verdict::regular && box.box.back().lo() <= 0.2 && box.box.back().hi() > 0.21;
  };
  const auto at_end = std::find_if(result.cover.boxes.begin(), result.cover.boxes.end(), is_at_end);
  ASSERT_NE(at_end, result.cover.boxes.end());
  CoverBox wider = *at_end;
  const auto leg = std::find_if(result.variables.begin(), result.variables.end(),
                                [](const result::ResultVariable& v) { return v.name == "P_leg1_z"; });
  ASSERT_NE(leg, result.variables.end());
  for (Interval* side : {&wider.box[static_cast<std::size_t>(leg - result.variables.begin())], &wider.box.back()})
    *side = Interval(side->lo() - 1e-3, side->hi());
  result.cover.boxes = {wider};
  EXPECT_FALSE(result::verify(result).verified());
}

// The end of the range is an irrational value of the sine, which no double is.
TEST(Answer, OfARangeThatAnIrrationalMultipleHasIsVerifiedUpToItsEnds) {
  for (const std::string slope : {"sqrt(2)/3", "-sqrt(3)/3", "sin(2*pi/9)"})
    for (const double sigma : {0.05, solve::kWhole}) {
      Options options;
      options.search.sigma = sigma;
      const result::Result result =
          answer({symbolic::parse_model(
                     "[SYSTEM VARS]\nz : [-1/8, 1/2]\nt ~\n[SYSTEM EQS]\nz = 1/9 + " + slope + "*sin(t);\n", "height.cuik")},
                 options);
      EXPECT_TRUE(result.cover.complete());
      EXPECT_GT(result.cover.count(Verdict::regular), 0u);
      EXPECT_TRUE(result::verify(result).verified()) << slope << " " << sigma;
    }
}

TEST(Answer, RemembersTheConstantsThatWerePutIn) {
  Question question{.model = three_slider(), .set = SingularitySet::inverse, .constants = {{"L2", "1"}}};
  result::put_in(question.constants, question.model);
  const result::Result result = answer(question);
  EXPECT_EQ(result.options.constants, question.constants);
  EXPECT_TRUE(result::verify(result, result::system_of(result), {}).verified());
}

TEST(Answer, OfAPlainSystemHasItsEquationsAlone) {
  const result::Result result =
      answer({symbolic::parse_model("[SYSTEM VARS]\nx : [-2, 2]\n[SYSTEM EQS]\nx^2 = 2;\n", "root.cuik")});
  EXPECT_EQ(result.set, "system");
  EXPECT_EQ(result.cover.points.size(), 2u);
}

// t4 = π by a chord of its circle: its sine is 0 but for rounding, and has no size of its own.
TEST(Answer, ProvesPointsWhereASineIsZeroByRoundedNumbers) {
  const result::Result result = answer({symbolic::parse_model(
      "[SYSTEM VARS]\nt1 ~ [-pi, pi]\nt2 ~ [-pi, pi]\nt3 ~ [-pi, pi]\nt4 ~ [-pi, pi]\n[SYSTEM EQS]\n"
      "cos(t1) + 1.5*cos(t2) = 2 + 1.4*cos(t4) + 1.3*cos(t3);\nsin(t1) + 1.5*sin(t2) = 1.4*sin(t4) + 1.3*sin(t3);\n"
      "cos(t4 - (1+pi)/2) = cos((pi-1)/2);\ncos(t1 - 5/2) = cos(1/2);\n",
      "corner.cuik")});
  EXPECT_EQ(result.cover.points.size(), 4u);
  EXPECT_EQ(result.cover.count(Verdict::isolated), result.cover.boxes.size());
}

// Degenerate points and sets, a tolerance, self-motions, limits.
TEST(Answer, HasAReasonForEachUndecidedBox) {
  const auto plain = [](const std::string& equations) {
    return symbolic::parse_model("[SYSTEM VARS]\nx : [-2, 2]\ny : [-2, 2]\n[SYSTEM EQS]\n" + equations, "plain.cuik");
  };
  const auto read = [](const std::string& name) {
    return read_model(CORANK_SOURCE_DIR "/models/" + name + ".cuik", {}).mechanism;
  };
  std::vector<Question> questions{
      {.model = plain("x^2 = 0;\ny^2 = 0;\n")},
      {.model = plain("x^2 - 2*x*y + y^2 = 0;\n")},
      {.model = plain("x^2 + y^2 - 0.999999 = 0;\nx = 0.866025;\n"), .tolerance = 1e-3},
      {.model = plain("x^2 + y^2 - 1.01 = 0;\nx - 1.005*y = 0;\n2.01*x - 2.02*y = 0;\n"), .tolerance = 1e-2},
      {.model = plain("x^3 - 0.3*x*y = 0;\n0.7*x*y^2 - 0.21*y*y = 0;\nx*x - 0.3*y = 0;\n"), .tolerance = 1e-4}};
  for (const char* name : {"planar/dextar", "planar/parallelogram", "planar/three_arms", "planar/five_bar_sliders"})
    for (const SingularitySet set : {SingularitySet::cspace, SingularitySet::inverse})
      questions.push_back({.model = read(name), .set = set});
  std::size_t undecided = 0;
  for (const Question& question : questions) {
    for (const std::uint64_t most : {1'000, 20'000}) {
      Options options;
      options.search.max_boxes = most;
      if (question.set) options.search.sigma = 0.3;  // their surfaces are not what is asked about
      const result::Result result = answer(question, options);
      for (const CoverBox& box : result.cover.boxes) {
        if (box.verdict != Verdict::undecided) continue;
        EXPECT_NE(box.reason, Reason::none) << question.model.name();
        ++undecided;
      }
      EXPECT_EQ(result::to_table(result).find("reason unknown"), std::string::npos);
    }
  }
  EXPECT_GT(undecided, 100u);
}

TEST(Answer, SaysWhichLimitEndedIt) {
  Options options;
  options.search.max_boxes = 3;
  const result::Result result = answer({three_slider(), SingularitySet::forward}, options);
  EXPECT_FALSE(result.cover.complete());
  EXPECT_THAT(stopped_words(result), testing::HasSubstr("stopped by "));
  EXPECT_THAT(result.stopped, testing::HasSubstr("search"));
}

TEST(Question, OfASetThatTheModelDoesNotHaveIsRefused) {
  const auto plain = symbolic::parse_model("[SYSTEM VARS]\nx : [-2, 2]\n[SYSTEM EQS]\nx^2 = 2;\n", "root.cuik");
  EXPECT_THROW(system({plain, SingularitySet::forward}), symbolic::ModelError);
}

// M(x, y) = diag(x, y), ξ in its kernel: of dimension 2 at the origin.
TEST(Corank, NamesALargerOneOnlyWhereSingularValuesShowIt) {
  test::SystemBuilder b;
  const int x = b.variable("x", "-1", "1"), y = b.variable("y", "-1", "1");
  const int xi1 = b.variable("xi1", "-1", "1", VariableKind::kernel),
            xi2 = b.variable("xi2", "-1", "1", VariableKind::kernel),
            xi3 = b.variable("xi3", "-1", "1", VariableKind::kernel);
  b.equation({{"1", {{x, 1}, {xi1, 1}}}}).equation({{"1", {{y, 1}, {xi2, 1}}}}).equation({{"1", {{xi3, 1}}}});
  result::Result result = result::sample_result();
  result.options.corank = 1;
  const auto hint_at = [&](double at_x, double at_y, Reason reason) {
    CoverBox box = result::sample_box({at_x, at_y, 0.5, 0.5, 0.0}, Verdict::undecided, {});
    box.reason = reason;
    result.cover.boxes = {box, box};
    result.cover.points.clear();
    describe_corank(b.system(), result);
    return result.seems_of_corank;
  };
  EXPECT_EQ(hint_at(0.001, 0.002, Reason::degenerate_set), 2);
  EXPECT_EQ(hint_at(0.001, 0.5, Reason::degenerate_set), 0);
  EXPECT_EQ(hint_at(0.001, 0.002, Reason::degenerate_point), 0);
  result.options.corank = 2;
  EXPECT_EQ(hint_at(0.001, 0.002, Reason::degenerate_set), 0) << "that is what was asked for";
}

}  // namespace
}  // namespace corank::study
