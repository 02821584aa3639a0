// What the cutting of a result's sheets says of its own end.
#include "corank/study/cut.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <set>
#include <string>

#include "corank/result/files/verification.h"
#include "corank/result/values/summary.h"
#include "corank/result/values/tallies.h"
#include "corank/study/answer.h"
#include "corank/study/model.h"

namespace corank::study {
namespace {

result::Result uncut(symbolic::SingularitySet set) {
  return answer({.model = read_model(CORANK_SOURCE_DIR "/models/planar/3prr.cuik").mechanism, .set = set},
                {.search = {.surfaces_whole = true}});
}
result::Result whole_sheets() { return uncut(symbolic::SingularitySet::inverse); }

TEST(Cut, ThatHasEndedBeforeItBeginsLeavesTheSheetsAsTheyAre) {
  const result::Result whole = whole_sheets();
  ASSERT_EQ(whole.parts.size(), 3u);
  for (const int looks : {1, 2, 4}) {
    int look = 0;
    solve::Control control({.time = 1, .clock = [&] { return look++ < looks ? 0.0 : 2.0; }});
    const result::Result cut = study::cut(whole, {.sigma = 0.1}, control);
    EXPECT_THAT(cut.stopped, testing::StartsWith("the time limit"));
    EXPECT_EQ(cut.cover.boxes.size(), whole.cover.boxes.size());
    EXPECT_TRUE(cut.cover.complete());
  }
}

// A program that has found nothing by the limit ends without a result; here all was found before.
TEST(Cut, IsTheStageOfTheSearchInAllParts) {
  std::set<solve::Stage> stages;
  solve::Control control;
  control.progress = [&](const solve::Control::Progress& p) { stages.insert(p.stage); };
  const result::Result whole = whole_sheets(), cut = study::cut(whole, {.sigma = 0.5}, control);
  EXPECT_GT(cut.cover.boxes.size(), whole.cover.boxes.size());
  EXPECT_EQ(stages, std::set{solve::Stage::search});
  EXPECT_EQ(cut.stopped, "");
}

TEST(Cut, LeavesPartsOfSheetsThatAreNoWiderThanSigma) {
  const result::Result found = uncut(symbolic::SingularitySet::forward);
  const std::size_t parts = result::parts_of_sheets(found);
  EXPECT_GT(parts, 0u);
  EXPECT_EQ(result::how_many(found.cover.boxes, [](const CoverBox& b) { return b.free.empty(); }), parts)
      << "in the list of the whole set, too";
  EXPECT_THAT(to_table(found), testing::HasSubstr(std::to_string(parts) + " of these hold a part of a sheet"));
  solve::Control control;
  for (const double sigma : {0.5, 0.1}) {
    const result::Result cut = study::cut(found, {.sigma = sigma}, control);
    EXPECT_TRUE(cut.cover.complete());
    EXPECT_GT(result::parts_of_sheets(cut), 0u);
    EXPECT_EQ(cut.cover.wider_than_sigma, 0u);
    EXPECT_LE(cut.cover.count(Verdict::undecided), found.cover.count(Verdict::undecided));
  }
  const result::Result on_page = cut_for_page(found, {}, 20'000, {});
  EXPECT_GT(on_page.cover.boxes.size(), found.cover.boxes.size());
  EXPECT_LE(on_page.cover.boxes.size(), 20'000u);
  const result::Result sheets = study::cut(found, {.sigma = solve::kWhole}, control);
  EXPECT_TRUE(sheets.cover.complete());
  EXPECT_EQ(result::parts_of_sheets(sheets), 0u);
}

// With a sigma the search ends with parts that would not be cut: no solution is lost, and each box is verified.
TEST(Cut, ASearchWithSigmaEndsWithPartsOfSheetsToo) {
  const Question question{.model = read_model(CORANK_SOURCE_DIR "/models/planar/3prr.cuik").mechanism,
                          .set = symbolic::SingularitySet::forward};
  solve::Options search{.sigma = 0.5, .surfaces_whole = true, .proof = true};
  const result::Result found = answer(question, {.search = search});
  search.sigma = 0.25;
  const result::Result finer = answer(question, {.search = search});
  EXPECT_TRUE(found.cover.complete());
  EXPECT_GT(result::parts_of_sheets(found), 0u);
  EXPECT_EQ(found.cover.wider_than_sigma, 0u);
  EXPECT_TRUE(result::verify(found).verified());
  // Every solution that another search is sure of is in a box.
  for (std::size_t i = 0; i < finer.cover.boxes.size(); i += 37) {
    const CoverBox& b = finer.cover.boxes[i];
    if (!holds_a_solution(b)) continue;
    const auto meets = [&](const CoverBox& other) {
      for (std::size_t j = 0; j < b.box.size(); ++j)
        if (!b.box[j].overlaps(other.box[j])) return false;
      return true;
    };
    EXPECT_TRUE(std::ranges::any_of(found.cover.boxes, meets)) << i;
  }
}

TEST(Cut, KeepsTheTypesThatWereAskedFor) {
  const result::Result found = answer({.model = read_model(CORANK_SOURCE_DIR "/models/planar/3prr.cuik").mechanism,
                                       .set = symbolic::SingularitySet::forward,
                                       .kernel = symbolic::KernelSide::right},
                                      {.search = {.surfaces_whole = true}});
  EXPECT_GT(result::parts_of_sheets(found), 0u);
  EXPECT_GT(found.cover.types.asked, 0);
  solve::Control control;
  const result::Result cut = study::cut(found, {.sigma = 0.5}, control);
  EXPECT_EQ(cut.cover.types.asked, found.cover.types.asked);
  EXPECT_GT(result::how_many(cut.cover.boxes, [](const CoverBox& b) { return b.types != TypeLabels{}; }), 0u);
}

TEST(Cut, ForAPageHasAsManyBoxesAsItShowsInAllParts) {
  const result::Result whole = whole_sheets();
  std::size_t before = 0;
  for (const std::size_t most : {3000u, 20'000u, 100'000u}) {
    const result::Result cut = cut_for_page(whole, {}, most, {});
    EXPECT_LE(cut.cover.boxes.size(), most);
    EXPECT_GT(cut.cover.boxes.size(), std::max(before, whole.cover.boxes.size()));
    EXPECT_TRUE(cut.cover.complete());
    EXPECT_EQ(cut.stopped, "");
    before = cut.cover.boxes.size();
  }
  const std::atomic<bool> interrupted = true;
  EXPECT_THAT(cut_for_page(whole, {}, 20'000, {.stop = &interrupted}).stopped, testing::StartsWith("an interrupt"));
  EXPECT_EQ(cut_for_page(whole, {}, 0, {.time = 1e-6}).cover.boxes.size(), whole.cover.boxes.size()) << "no time to cut";
}

}  // namespace
}  // namespace corank::study
