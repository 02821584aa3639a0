// Surfaces whose condition vanishes doubly on a part: Orthoglides, whose rods meet in one point all over a sphere. That the
// sphere and the rest are the set, by samples in doubles. CORANK_SEEDS=100 tries more robots.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "corank/result/files/result_file.h"
#include "corank/result/files/verification.h"
#include "corank/result/values/summary.h"
#include "corank/study/answer.h"
#include "corank/study/model.h"
#include "corank/tests/cover_lookup.h"
#include "corank/tests/seeds.h"
#include "corank/tests/study/samples.h"

namespace corank::study {
namespace {

using test::names_of;

// Where the slides begin, in eighths, and the rods' length: others' where the rods are not equally long.
struct Orthoglide {
  std::array<int, 3> starts{};
  int rod = 8;
  int other_rod = rod;
  std::string range = "[-1/2, 2]";  // of the slides

  Question question() const {
    ModelText file = read_text(CORANK_SOURCE_DIR "/models/platforms/orthoglide.cuik");
    const auto replace = [&](const std::string& from, const std::string& to) {
      const std::size_t at = file.text.find(from);
      EXPECT_NE(at, std::string::npos) << from;
      file.text.replace(at, from.size(), to);
    };
    const auto eighths = [](int number) { return std::to_string(number) + "/8"; };
    replace("base : point O (0, 0, 0)", "base : point O (0, 0, 0)  point S1 (" + eighths(starts[0]) +
                                            ", 0, 0)  point S2 (0, " + eighths(starts[1]) + ", 0)  point S3 (0, 0, " +
                                            eighths(starts[2]) + ")");
    for (const std::string k : {"1", "2", "3"}) {
      replace("prismatic d" + k + " : base O", "prismatic d" + k + " : base S" + k);
      replace("range [-1/2, 2]", "range " + range);
      replace("block" + k + " P   platform C   length 1",
              "block" + k + " P   platform C   length " + eighths(k == "3" ? other_rod : rod));
    }
    return {.model = parse_model(file).mechanism, .set = symbolic::SingularitySet::forward};
  }
};

TEST(DoubleStratum, IsNamedByWhereTheSlidesMeet) {
  EXPECT_THAT(names_of(parts_of(Orthoglide{}.question())),
              testing::ElementsAre("d1 = 0, d2 = 0, d3 = 0", testing::EndsWith(", elsewhere")));
  EXPECT_THAT(names_of(parts_of(Orthoglide{{-2, 1, 3}}.question())),
              testing::ElementsAre("d1 = 0.25, d2 = -0.125, d3 = -0.375", testing::EndsWith(", elsewhere")));
  EXPECT_THAT(names_of(parts_of(Orthoglide{.rod = 8, .other_rod = 7}.question())),
              testing::ElementsAre(testing::Not(testing::EndsWith(", elsewhere"))))
      << "three spheres about one point do not meet";
}

TEST(DoubleStratum, AndTheRestLoseNothing) {
  for (unsigned seed = 0; seed < test::seeds(4); ++seed) {
    std::mt19937_64 random(seed);
    Orthoglide robot;
    for (int& start : robot.starts) start = static_cast<int>(random() % 7) - 3;
    robot.rod = robot.other_rod = 6 + static_cast<int>(random() % 5);
    Question question = robot.question();
    const result::Result result = answer(question, {});
    ASSERT_EQ(result.parts.size(), 2u) << seed;
    EXPECT_TRUE(result.cover.complete());
    EXPECT_LT(result.cover.count(Verdict::undecided), result.cover.boxes.size() / 20) << seed;
    const test::CoverLookup lookup(result.cover);
    question.kernel = symbolic::KernelSide::right;
    const System whole = system(question);
    int found = 0, lost = 0;
    for (int trial = 0; trial < 1000 && found < 100; ++trial) {
      const auto x = test::sample(whole, random);
      if (!x) continue;
      ++found;
      lost += !lookup.holds(std::span(x->data(), 6), 1e-4);
    }
    EXPECT_GE(found, 20) << seed;
    EXPECT_EQ(lost, 0) << seed;
  }
}

// Where the three rods are in line with a slide.
TEST(DoubleStratum, LeavesThreePlacesUndecided) {
  const result::Result result = answer(Orthoglide{}.question(), {});
  EXPECT_THAT(to_table(result), testing::HasSubstr("undecided, 3: next to a degenerate solution"));
  for (const CoverBox& box : result.cover.boxes) {
    if (box.verdict != Verdict::undecided) continue;
    const auto near = [&](int d, int x) { return box.box[d].mid() > 1.9 && box.box[x].mid() > 0.9; };
    EXPECT_TRUE(near(0, 3) || near(1, 4) || near(2, 5));
  }
}

TEST(DoubleStratum, IsVerified) {
  Options options;
  options.search.proof = true;
  result::Result result = answer(Orthoglide{.starts = {1, 0, -1}, .range = "[-1/8, 1/8]"}.question(), options);
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("double_stratum_" + std::to_string(getpid()) + ".h5");
  write_result(file, result);
  EXPECT_TRUE(result::verify(result::read_result(file)).complete());
  std::swap(result.parts[0].part, result.parts[1].part);
  write_result(file, result);
  EXPECT_FALSE(result::verify(result::read_result(file)).verified());
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace corank::study
