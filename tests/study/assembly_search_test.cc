// Whether a robot can be assembled, against triangle inequalities.
#include "corank/study/search_steps.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <random>

#include "corank/result/files/result_file.h"
#include "corank/result/files/verification.h"
#include "corank/result/values/sentences.h"
#include "corank/result/values/summary.h"
#include "corank/study/answer.h"
#include "corank/study/model.h"
#include "corank/symbolic/model/model_file.h"

namespace corank::study {
namespace {

using symbolic::SingularitySet;
using testing::HasSubstr;

// A closed chain of four bars; `a` is driven by theta, psi is the output.
symbolic::Mechanism four_bar(double a, double b, double c, double d, const std::string& range = "[-pi, pi]") {
  const std::string text = fmt::format(
      "[SYSTEM VARS]\ntheta ~ {}\nphi ~ [-pi, pi]\npsi ~ [-pi, pi]\n[SYSTEM EQS]\n"
      "{:.3f}*cos(theta) + {:.3f}*cos(phi) - {:.3f}*cos(psi) - {:.3f} = 0;\n"
      "{:.3f}*sin(theta) + {:.3f}*sin(phi) - {:.3f}*sin(psi) = 0;\n[INPUTS] theta\n[OUTPUTS] psi\n",
      range, a, b, c, d, a, b, c);
  return symbolic::parse_model(text, "four_bar.cuik");
}

// A two-link arm whose end is held in a point at the distance r from its base.
symbolic::Mechanism held_arm(double a, double b, double r, double at) {
  const std::string text = fmt::format(
      "[SYSTEM VARS]\nt1 ~ [-pi, pi]\nt2 ~ [-pi, pi]\ns : [-0.25, 0.25]\n[SYSTEM EQS]\n"
      "{:.3f}*cos(t1) + {:.3f}*cos(t2) - ({:.6f}) - s*({:.6f}) = 0;\n"
      "{:.3f}*sin(t1) + {:.3f}*sin(t2) - ({:.6f}) - s*({:.6f}) = 0;\n[INPUTS] s\n[OUTPUTS] t1\n",
      a, b, r * std::cos(at), std::cos(at), a, b, r * std::sin(at), std::sin(at));
  return symbolic::parse_model(text, "arm.cuik");
}

result::Result through_a_file(const result::Result& result) {
  const auto path = std::filesystem::path(testing::TempDir()) /  // of each test another: they may run at the same time
                    fmt::format("corank_{}.h5", testing::UnitTest::GetInstance()->current_test_info()->name());
  result::write_result(path, result);
  return result::read_result(path);
}

// What an empty set says of the robot is confirmed, after a file, too.
void expect_confirmed(const result::Result& result, bool expected, bool in_a_file = true) {
  EXPECT_EQ(result::assembled(result), std::optional(expected));
  EXPECT_EQ(result::sample(result).has_value(), expected);
  const result::Result read = in_a_file ? through_a_file(result) : result;
  if (in_a_file) {
    EXPECT_EQ(result::to_json(read), result::to_json(result));
  }
  const result::Verification verification = result::verify(read);
  EXPECT_TRUE(verification.verified()) << result::to_table(verification, read);
  if (!result.assembly.empty()) {
    EXPECT_EQ(verification.assembled, std::optional(expected))
        << result::to_table(verification, read) << result::to_table(result.assembly.front());
    EXPECT_EQ(verification.complete(), !expected);  // an empty C-space has empty sets
  }
}

TEST(Assembly, OfFourBarsIsWhatTheTriangleInequalitySays) {
  std::mt19937 random(33);
  std::uniform_real_distribution<double> length(0.2, 3);
  int empty = 0, apart = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const auto rounded = [&] { return std::round(1000 * length(random)) / 1000; };
    const double a = rounded(), b = rounded(), c = rounded(), d = rounded();
    const double longest = std::max({a, b, c, d}), sum = a + b + c + d;
    if (std::fabs(sum - 2 * longest) < 0.01) continue;
    const bool closes = sum > 2 * longest;
    for (const SingularitySet set : {SingularitySet::forward, SingularitySet::cspace_singular}) {
      const result::Result result = answer({four_bar(a, b, c, d), set});
      ASSERT_TRUE(result.cover.complete());
      if (!result.cover.boxes.empty()) {
        EXPECT_TRUE(closes);
        continue;
      }
      SCOPED_TRACE(fmt::format("{} {} {} {}", a, b, c, d));
      expect_confirmed(result, closes, empty % 4 == 0);
      ++empty;
      apart += !closes;
    }
  }
  EXPECT_GT(empty, 60);
  EXPECT_GT(apart, 8);
}

TEST(Assembly, OfHeldArmsIsWhatTheTriangleInequalitySays) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> length(0.5, 2), away(0.3, 6), angle(-3, 3);
  int empty = 0, apart = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const double a = std::round(1000 * length(random)) / 1000, b = std::round(1000 * length(random)) / 1000,
                 r = away(random);
    const double nearest = std::max(0.0, r - 0.25), farthest = r + 0.25;
    const double room = std::min(a + b - nearest, farthest - std::fabs(a - b));
    if (std::fabs(room) < 0.01) continue;
    const result::Result result = answer({held_arm(a, b, r, angle(random)), SingularitySet::cspace_singular});
    if (!result.cover.boxes.empty()) continue;
    SCOPED_TRACE(fmt::format("{} {} {}", a, b, r));
    expect_confirmed(result, room > 0, empty % 4 == 0);
    ++empty;
    apart += room < 0;
  }
  EXPECT_GT(empty, 30);
  EXPECT_GT(apart, 5);
}

// A platform with three legs of two links each, at a pose that only x may leave by 0.05: the legs' ends are c + (x, 0).
TEST(Assembly, OfThreeLegsAtAPoseIsWhatTheirTriangleInequalitiesSay) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> link(0.6, 1.6), place(-2, 2);
  int empty = 0, apart = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const double a = std::round(1000 * link(random)) / 1000, b = std::round(1000 * link(random)) / 1000;
    std::string variables = "x : [-0.05, 0.05]\n", equations;
    std::array<std::array<double, 2>, 3> ends;
    for (int k = 0; k < 3; ++k) {
      ends[k] = {std::round(1000 * place(random)) / 1000, std::round(1000 * place(random)) / 1000};
      variables += fmt::format("t{0} ~ [-pi, pi]\nu{0} ~ [-pi, pi]\n", k);
      equations += fmt::format(
          "{1:.3f}*cos(t{0}) + {2:.3f}*cos(u{0}) - ({3:.3f}) - x = 0;\n"
          "{1:.3f}*sin(t{0}) + {2:.3f}*sin(u{0}) - ({4:.3f}) = 0;\n",
          k, a, b, ends[k][0], ends[k][1]);
    }
    double room = -10;  // where it is largest: how much each leg has to spare
    for (int i = -500; i <= 500; ++i) {
      double least = 10;
      for (const auto& [x, y] : ends) {
        const double reach = std::hypot(x + i * 1e-4, y);
        least = std::min({least, a + b - reach, reach - std::fabs(a - b)});
      }
      room = std::max(room, least);
    }
    if (std::fabs(room) < 0.01) continue;
    const auto robot = symbolic::parse_model(
        "[SYSTEM VARS]\n" + variables + "[SYSTEM EQS]\n" + equations + "[INPUTS] x\n[OUTPUTS] t0\n", "legs.cuik");
    const result::Result result = answer({robot, SingularitySet::cspace_singular});
    if (!result.cover.boxes.empty()) continue;
    SCOPED_TRACE(trial);
    expect_confirmed(result, room > 0, empty % 4 == 0);
    ++empty;
    apart += room < 0;
  }
  EXPECT_GT(empty, 25);
  EXPECT_GT(apart, 10);
}

TEST(Assembly, KeepsRanges) {
  // The rocker of this crank-rocker reaches every theta; but theta alone is held where nothing closes for the other one.
  const result::Result inside = answer({four_bar(1, 3, 3, 3, "[0.5, 0.6]"), SingularitySet::cspace_singular});
  expect_confirmed(inside, true);
  const Interval theta = result::sample(inside)->box.box[0];  // its cosine
  EXPECT_GE(theta.lo(), std::cos(0.6) - 1e-9);
  EXPECT_LE(theta.hi(), std::cos(0.5) + 1e-9);
  // 3, 1, 1 and 4: the coupler and the rocker span 2 at most, and the crank's end is farther than that from the far pivot.
  expect_confirmed(answer({four_bar(3, 1, 1, 4, "[1, 2]"), SingularitySet::cspace_singular}), false);
}

TEST(Assembly, IsNotLookedForWhereTheSetHasBoxes) {
  const result::Result result = answer({four_bar(1, 3, 3, 3), SingularitySet::cspace});
  EXPECT_FALSE(result.cover.boxes.empty());
  EXPECT_TRUE(result.assembly.empty());
  EXPECT_EQ(result::assembled(result), std::optional(true));
  EXPECT_TRUE(result::assembly_sentences(result).empty());
}

TEST(Assembly, IsNotKnownWhereALimitEndsTheSearchForIt) {
  const Question question{four_bar(1, 3, 3, 3), SingularitySet::cspace_singular};
  result::Result result = answer(question);
  ASSERT_TRUE(result.cover.boxes.empty());
  result.assembly.clear();
  solve::Control control(solve::Control::Limits{.boxes = 1});
  search_assembly(question, control, result);
  ASSERT_FALSE(result.assembly.empty());
  EXPECT_EQ(result::assembled(result), std::nullopt);
  EXPECT_FALSE(result::sample(result));
  EXPECT_THAT(result::to_table(result), HasSubstr("is not known"));
  EXPECT_THAT(result::to_json(result), HasSubstr("\"assembled\": null"));
  EXPECT_EQ(result::verify(result).assembled, std::nullopt);
}

TEST(Assembly, ThatWasTamperedWithIsRejected) {
  const result::Result good = answer({four_bar(1, 3, 3, 3), SingularitySet::cspace_singular});
  ASSERT_EQ(result::verify(good).assembled, std::optional(true));
  result::Result moved = good;
  for (CoverBox& box : moved.assembly.front().cover.boxes)
    for (Interval& side : box.box) side = Interval(side.lo() - 0.01, side.hi() - 0.009);
  EXPECT_FALSE(result::verify(moved).verified());
  result::Result emptied = good;  // claims that the robot cannot be assembled
  emptied.assembly.front().cover.boxes.clear();
  EXPECT_EQ(result::assembled(emptied), std::optional(false));
  EXPECT_NE(result::verify(emptied).assembled, std::optional(false));
  result::Result beside = answer({four_bar(1, 3, 3, 3), SingularitySet::cspace});
  beside.assembly = good.assembly;
  EXPECT_FALSE(result::verify(beside).verified());
}

TEST(Assembly, ThatIsImpossibleIsSaidInWords) {
  const result::Result result = answer({four_bar(0.2, 0.3, 0.4, 2), SingularitySet::forward});
  EXPECT_THAT(result::to_table(result), HasSubstr("the robot cannot be assembled within its ranges: it is proven"));
  EXPECT_THAT(result::to_json(result), HasSubstr("\"assembled\": false"));
}

// One line written twice: the second time in decimals that are rounded otherwise.
TEST(Assembly, OfRoundedDecimalsNamesTheOptionThatHelps) {
  const auto system = [](const std::string& second) {
    return symbolic::parse_model(
        "[SYSTEM VARS]\nx : [-2, 2]\ny : [-2, 2]\n[SYSTEM EQS]\n3*x + y - 1.4142136 = 0;\n"
        "x^2 + y^2 - 1 = 0;\n6*x + 2*y - " +
            second + " = 0;\n",
        "rounded.cuik");
  };
  const result::Result rounded = answer({.model = system("2.8284271"), .tolerance = 0});
  ASSERT_TRUE(rounded.cover.boxes.empty());
  EXPECT_TRUE(rounded.nearly_solved);
  EXPECT_THAT(result::to_table(rounded), HasSubstr("--tolerance 1e-06"));
  EXPECT_FALSE(answer({.model = system("2.8384271"), .tolerance = 0}).nearly_solved);
}

}  // namespace
}  // namespace corank::study
