// What a command gives up that was told to end: what it prepares, and nothing that it has found.
#include "corank/app/limited_run.h"

#include <gtest/gtest.h>

namespace corank::app {
namespace {

using solve::Stage;

constexpr Watch::Work kNothing = 0;

TEST(DeafWork, IsAllThatComesBeforeTheFirstSearch) {
  solve::Control control;
  const Watch::Work model = deaf_work(control);
  EXPECT_NE(model, kNothing);
  const solve::InStage stage(control, Stage::reduction);
  EXPECT_EQ(deaf_work(control), model) << "one piece with the model's equations";
}

// A map of aspects searches under controls of its own, and a resumed search may have no box left to look at.
TEST(DeafWork, IsNoSearchThatHasBegunThoughItHasCountedNoBox) {
  solve::Control control;
  { const solve::InStage stage(control, Stage::search); }
  EXPECT_EQ(deaf_work(control), kNothing) << "nor what is made of it: the control keeps the stage";
}

TEST(DeafWork, IsNotTheReductionOfALaterSearch) {
  solve::Control control;
  {
    const solve::InStage stage(control, Stage::search);
    ASSERT_TRUE(control.count_box());
  }
  const solve::InStage stage(control, Stage::reduction);
  EXPECT_EQ(deaf_work(control), kNothing);
}

}  // namespace
}  // namespace corank::app
