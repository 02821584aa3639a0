// Which boxes hang together, and what is said about it.
#include "corank/report/pictures/components.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "corank/report/html/page_words.h"

namespace corank::report {
namespace {
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// Boxes in the plane; a third variable is no part of the configuration.
result::Result boxes(const std::vector<std::pair<Box, Verdict>>& list) {
  result::Result result;
  result.set = "forward";
  result.variables.resize(3);
  result.configuration_size = 2;
  result.cover.dimension = 1;
  result.cover.sigma = {1, 1};
  for (const auto& [box, verdict] : list) result.cover.boxes.push_back({box, verdict, {}});
  return result;
}

TEST(Components, JoinBoxesThatShareACornerAndPartThoseThatDoNot) {
  const result::Result result = boxes({{{{0, 1}, {0, 1}, 0.5}, Verdict::regular},
                                       {{{3, 4}, {0, 1}, 0.5}, Verdict::undecided},
                                       {{{1, 2}, {1, 2}, -0.5}, Verdict::regular},
                                       {{{2, 3}, {2, 2.5}, 0.5}, Verdict::boundary},
                                       {{{4.0625, 5}, {0, 1}, 0.5}, Verdict::boundary}});
  const Components found = components(result);
  EXPECT_EQ(found.count, 3u);
  EXPECT_THAT(found.of_box, ElementsAre(0u, 1u, 0u, 0u, 2u));
  EXPECT_EQ(found.with_proven_solution, 1u);
}

TEST(Components, OfALongChainAreOne) {
  std::vector<std::pair<Box, Verdict>> chain;
  for (int i = 0; i < 500; ++i) {
    const double x = (i * 37) % 500;  // each touches the next, in no order
    chain.push_back({{{x, x + 1}, {-x, 1 - x}, 0.5}, Verdict::regular});
  }
  EXPECT_EQ(components(boxes(chain)).count, 1u);
}

TEST(Components, OfPointsAreThePoints) {
  EXPECT_EQ(components(boxes({{{0.5, 0.5, 0.5}, Verdict::isolated}, {{0.5, 0.75, 0.5}, Verdict::isolated}})).count, 2u);
  EXPECT_EQ(components(boxes({})).count, 0u);
}

TEST(SetWords, ClaimSeparatenessOnlyOfACompleteCover) {
  result::Result result = boxes({{{{0, 1}, {0, 1}, 0.5}, Verdict::regular}, {{{3, 4}, {0, 1}, 0.5}, Verdict::regular}});
  EXPECT_THAT(set_words(result, components(result)).proven, Contains(HasSubstr("No two of the 2 components are connected")));
  result.cover.boxes.push_back({{{8, 9}, {0, 1}, 0.5}, Verdict::pending, {}});
  const SetWords words = set_words(result, components(result));
  EXPECT_THAT(words.proven, Not(Contains(HasSubstr("connected"))));
  EXPECT_THAT(words.proven, Not(Contains(HasSubstr("excluded"))));
  EXPECT_THAT(words.unproven, Contains(HasSubstr("ended early")));
  EXPECT_THAT(words.finding, HasSubstr("incomplete"));
}

TEST(SetWords, SayOfPiecesNoMoreThanIsProven) {
  result::Result result = boxes({{{{0, 1}, {0, 1}, 0.5}, Verdict::regular}, {{{3, 4}, {0, 1}, 0.5}, Verdict::boundary}});
  result.free_coordinates = {"x"};
  const auto proven = [&] { return set_words(result, components(result)).proven; };
  EXPECT_THAT(proven(),
              Contains("In 1 box the set is smooth, but may leave the box: for each value of 1 free coordinate there "
                       "is at most one solution, and for some values there is one."));
  EXPECT_THAT(proven(),
              Contains("In 1 box the set is smooth, but may reach beyond the search domain: within, for each value "
                       "of 1 free coordinate there is at most one solution."));
  EXPECT_THAT(proven(), Contains("The set is a product: solutions stay solutions for every x."));
  for (CoverBox& box : result.cover.boxes) box.free = {0};
  EXPECT_THAT(proven(), Contains(HasSubstr("In 1 of 2 boxes (50.0 %) the set is one smooth piece")));
  EXPECT_THAT(proven(), Not(Contains(HasSubstr("may leave the box"))));
}

// A point over all values of what its part leaves out is a whole piece, with no free variables in the list of the whole.
TEST(SetWords, OfAUnionTakeWholePiecesFromItsParts) {
  result::Result whole = boxes({{{{0, 1}, {0, 1}, 0.5}, Verdict::regular}, {{{3, 4}, {0, 1}, 0.5}, Verdict::regular}});
  whole.parts = {boxes({{{0.5, 0.5, 0.5}, Verdict::isolated}}), boxes({{{{3, 4}, {0, 1}, 0.5}, Verdict::regular}})};
  const std::vector<std::string> proven = set_words(whole, components(whole)).proven;
  EXPECT_THAT(proven, Contains(HasSubstr("In 1 of 2 boxes (50.0 %) one of its parts is one smooth piece")));
  EXPECT_THAT(proven, Contains(HasSubstr("In 1 box one of its parts is smooth, but may leave the box")));
}

TEST(SetWords, CountUndecidedPlacesApartFromPoints) {
  result::Result result = boxes({{{0.5, 0.5, 0.5}, Verdict::isolated}, {{0.75, 0.5, 0.5}, Verdict::undecided}});
  result.cover.dimension = 0;
  result.cover.points = result.cover.boxes;
  const SetWords words = set_words(result, components(result));
  EXPECT_EQ(words.finding, "1 point and 1 undecided place");
  EXPECT_THAT(words.unproven, Contains(HasSubstr("nothing is proven")));
}

TEST(SetWords, TellPointsAtTheBorderOfTheDomainApart) {
  result::Result result = boxes({{{0.5, 0.5, 0.5}, Verdict::isolated}, {{1.0, 0.5, 0.5}, Verdict::boundary}});
  result.cover.dimension = 0;
  result.cover.points = result.cover.boxes;
  const SetWords words = set_words(result, components(result));
  EXPECT_EQ(words.finding, "1 point, 1 at the border of the search domain");
  EXPECT_THAT(words.unproven, Contains(HasSubstr("It is not proven that the solution")));
}

TEST(SetWords, OfAnEmptyCompleteCoverSayThatThereIsNone) {
  const SetWords words = set_words(boxes({}), {});
  EXPECT_EQ(words.finding, "None");
  EXPECT_THAT(words.proven, ElementsAre("There are none in the search domain."));
}

TEST(Percentage, IsAHundredOnlyWhereItIsAll) {
  EXPECT_EQ(percentage(5, 5), "100 %");
  EXPECT_EQ(percentage(99'999, 100'000), "over 99.9 %");
  EXPECT_EQ(percentage(1, 8), "12.5 %");
}

}  // namespace
}  // namespace corank::report
