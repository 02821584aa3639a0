// From a question to a result: what the library gives is what the command line gives.
#include "corank/study/answer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "corank/result/verification.h"
#include "corank/symbolic/model_file.h"
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
