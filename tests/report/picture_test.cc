// Which boxes a picture shows, where, and in which colours.
#include "corank/report/pictures/picture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "corank/report/pictures/layout.h"

namespace corank::report {
namespace {
using std::numbers::pi;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

// The box of cosine and sine about angle ± half.
Box about(double angle, double half, Interval length = {0, 1}) {
  const auto over = [&](double a, double b) { return Interval(std::min(a, b) - 1e-12, std::max(a, b) + 1e-12); };
  return {length, over(std::cos(angle - half), std::cos(angle + half)),
          over(std::sin(angle - half), std::sin(angle + half))};
}

PictureSource source(const std::vector<Box>& boxes, const std::string& set = "forward", Interval range = {-pi, pi}) {
  PictureSource s{"a.h5", set, {}, {{"theta", 1, 2, range}}, 2};
  s.boxes.variables = {"x", "c_theta", "s_theta"};
  for (const auto& b : boxes) s.boxes.boxes.push_back({b, Verdict::regular, {}});
  return s;
}

PictureOptions axes(std::vector<std::string> names, ColorScheme color = ColorScheme::set) {
  return {std::move(names), color, 0};
}

void expect_sides(const PictureBox& box, std::size_t j, double lo, double hi) {
  EXPECT_NEAR(box.sides[j].lo(), lo, 1e-9);
  EXPECT_NEAR(box.sides[j].hi(), hi, 1e-9);
}

TEST(Picture, TakesVariablesByNameOrNumberAndAnglesByName) {
  const Picture p = make_picture({source({about(0.5, 0.1)})}, axes({"x", "theta", "2"}));
  ASSERT_EQ(p.layers.size(), 1u);
  ASSERT_EQ(p.layers[0].boxes.size(), 1u);
  const PictureBox& box = p.layers[0].boxes[0];
  EXPECT_EQ(box.sides[0], Interval(0, 1));
  EXPECT_TRUE(box.sides[1].contains(Interval(0.4, 0.6)));
  EXPECT_LT(box.sides[1].width(), 0.26);
  expect_sides(box, 2, std::cos(0.6), std::cos(0.4));
  EXPECT_EQ(p.axes[2].name, "theta");
  EXPECT_EQ(p.axes[2].function, "cos");
  EXPECT_TRUE(p.axes[1].angle && p.axes[1].range);
  EXPECT_FALSE(p.axes[0].angle);
}

TEST(Picture, DrawsABoxAcrossPiInTwoPiecesThatShareItsNumber) {
  const Picture p = make_picture({source({about(0, 0.1), about(pi, 0.1)})}, axes({"theta", "x"}));
  const auto& boxes = p.layers[0].boxes;
  ASSERT_EQ(boxes.size(), 3u);
  EXPECT_EQ(boxes[1].number, 1);
  EXPECT_EQ(boxes[2].number, 1);
  const double reach = std::atan(std::sin(0.1) / std::cos(0.1));
  expect_sides(boxes[1], 0, -pi, -pi + reach);
  expect_sides(boxes[2], 0, pi - reach, pi);
}

TEST(Picture, DrawsFourPiecesWhereTwoAnglesWrap) {
  const Picture p = make_picture({source({about(pi, 0.1)})}, axes({"theta", "theta"}));
  EXPECT_EQ(p.layers[0].boxes.size(), 4u);
}

TEST(Picture, DrawsAnglesInTheirDeclaredRange) {
  const Picture turned = make_picture({source({about(-1, 0.1)}, "forward", {0, 2 * pi})}, axes({"theta", "x"}));
  ASSERT_EQ(turned.layers[0].boxes.size(), 1u);
  EXPECT_NEAR(turned.layers[0].boxes[0].sides[0].mid(), 2 * pi - 1, 0.01);
  const Picture cut = make_picture({source({about(1, 0.1)}, "forward", {0, 1})}, axes({"theta", "x"}));
  ASSERT_EQ(cut.layers[0].boxes.size(), 1u);
  EXPECT_EQ(cut.layers[0].boxes[0].sides[0].hi(), 1) << "what is beyond the range is no solution";
  const Picture whole = make_picture({source({about(1, 0.1)}, "forward", {-10, 10})}, axes({"theta", "x"}));
  EXPECT_EQ(whole.layers[0].boxes.size(), 1u) << "one turn, not three";
}

TEST(Picture, FindsTheAnglesOfASolutionFileByTheNamesOfTheirCosinesAndSines) {
  result::SolFile file;
  file.variables = {"s_a", "c_a"};
  file.boxes = {{{{0.99, 1}, {-0.01, 0.01}}, std::nullopt, {}}};
  const Picture p = make_picture({picture_source(file, "dir/mine.sol")}, axes({"a", "1"}));
  EXPECT_NEAR(p.layers[0].boxes[0].sides[0].mid(), pi / 2, 1e-9);
  EXPECT_EQ(p.layers[0].label, "mine");
}

TEST(Picture, PutsCSpaceBelowItsSubsetsAndKeepsAnEmptySetInTheLegend) {
  const Picture p = make_picture({source({about(0, 0.1)}), source({}, "cspace-singular"), source({about(0, 0.1)}, "cspace")},
                                 axes({"x", "theta"}));
  std::vector<std::string> labels;
  for (const auto& layer : p.layers) labels.push_back(layer.label);
  EXPECT_THAT(labels, ElementsAre("C-space", "forward locus", "C-space singularities"));
  EXPECT_LT(p.layers[0].opacity, 1);
  EXPECT_EQ(p.layers[1].color, set_color("forward"));
  EXPECT_TRUE(p.layers[2].boxes.empty());
  EXPECT_FALSE(is_empty(p));
  EXPECT_TRUE(is_empty(make_picture({source({})}, axes({"x", "theta"}))));
}

TEST(Picture, ShowsWhatWasNotSearchedApart) {
  PictureSource s = source({about(0, 0.1), about(1, 0.1)});
  s.boxes.boxes[1].verdict = Verdict::pending;
  const Picture p = make_picture({s}, axes({"x", "theta"}));
  ASSERT_EQ(p.layers.size(), 2u);
  EXPECT_EQ(p.layers[1].label, "forward locus, not searched");
  EXPECT_EQ(p.layers[0].boxes.size(), 1u);
  EXPECT_FALSE(p.layers[1].color == p.layers[0].color);
}

TEST(Picture, ColoursVerdictsWhereAsked) {
  PictureSource s = source({about(0, 0.1), about(1, 0.1), about(2, 0.1)});
  s.boxes.boxes[1].verdict = Verdict::undecided;
  const Picture p = make_picture({s}, axes({"x", "theta"}, ColorScheme::verdict));
  ASSERT_EQ(p.layers.size(), 2u);
  EXPECT_EQ(p.layers[0].label, "regular");
  EXPECT_EQ(p.layers[0].boxes.size(), 2u);
  EXPECT_EQ(p.layers[1].color, verdict_color(Verdict::undecided));
  EXPECT_EQ(p.layers[1].boxes[0].number, 1);
}

TEST(Picture, DrawsWhatIsUndecidedAboveWhatIsProven) {
  PictureSource s = source({about(0, 0.1), about(1, 0.1), about(2, 0.1)});
  s.boxes.boxes[0].verdict = Verdict::undecided;
  s.boxes.boxes[2].verdict = Verdict::boundary;
  const Picture p = make_picture({s}, axes({"x", "theta"}, ColorScheme::verdict));
  ASSERT_EQ(p.layers.size(), 3u);
  EXPECT_EQ(p.layers[0].label, "regular");
  EXPECT_EQ(p.layers[2].label, "undecided");
}

TEST(Picture, TellsSeveralResultsOfOneSetApart) {
  PictureSource a = source({about(0, 0.1)}), b = a;
  b.file = "dir/b.h5";
  const Picture loci = make_picture({a, b}, axes({"x", "theta"}));
  EXPECT_EQ(loci.layers[0].label, "forward locus (a)");
  EXPECT_EQ(loci.layers[1].label, "forward locus (b)");
  EXPECT_FALSE(loci.layers[0].color == loci.layers[1].color);
  a.set = b.set = "";
  const Picture others = make_picture({a, b}, axes({"x", "theta"}));
  EXPECT_EQ(others.layers[0].label, "a");
  EXPECT_EQ(others.layers[1].label, "b");
  EXPECT_FALSE(others.layers[0].color == others.layers[1].color);
}

TEST(Picture, ShowsACurveInFullColour) {
  PictureSource curve = source({about(0, 0.1)}, "cspace");
  curve.dimension = 1;
  EXPECT_EQ(make_picture({curve}, axes({"x", "theta"})).layers[0].opacity, 1);
}

TEST(Picture, SaysWhichAxesThereAre) {
  try {
    make_picture({source({about(0, 0.1)})}, axes({"x", "phi"}));
    FAIL() << "accepted phi";
  } catch (const std::invalid_argument& e) {
    EXPECT_STREQ(e.what(), "a.h5 has no variable 'phi'; expected a number from 1 to 3 or one of x, c_theta, s_theta, theta");
  }
  EXPECT_THROW(make_picture({source({})}, axes({"x"})), std::invalid_argument);
}

std::string plain(const Label& label) {
  std::string text;
  for (const TextRun& run : label) text += (run.subscript ? "_" : run.italic ? "*" : "") + run.text;
  return text;
}

TEST(Label, SetsNamesAsMathematicsDoes) {
  EXPECT_EQ(plain(math_label("theta2")), "*θ_2");
  EXPECT_EQ(plain(math_label("J3x")), "*J_3x");
  EXPECT_EQ(plain(math_label("y_A")), "*y_A");
  EXPECT_EQ(plain(math_label("x")), "*x");
  EXPECT_EQ(plain(math_label("Omega_in")), "*Ω_in");
  EXPECT_EQ(plain(math_label("slider1")), "slider1");
  EXPECT_EQ(plain(math_label("atan2_s_c")), "atan2_s_c");
  EXPECT_EQ(plain(axis_label({"theta2", "cos", false, {}})), "cos *θ_2");
  EXPECT_EQ(plain(axis_label({"phi", "", true, {}})), "*φ (rad)");
}

std::vector<std::string> tick_texts(double lo, double hi, bool angle, int count) {
  std::vector<std::string> texts;
  for (const Tick& t : ticks(lo, hi, angle, count)) {
    EXPECT_TRUE(lo <= t.at && t.at <= hi);
    texts.push_back(t.text);
  }
  return texts;
}

TEST(Ticks, AreRoundNumbersAndMultiplesOfPi) {
  EXPECT_THAT(tick_texts(-0.7, 1.9, false, 5), ElementsAre("−0.5", "0.0", "0.5", "1.0", "1.5"));
  EXPECT_THAT(tick_texts(0, 10, false, 5), ElementsAre("0", "2", "4", "6", "8", "10"));
  EXPECT_THAT(tick_texts(0.00101, 0.00139, false, 4), ElementsAre("0.0011", "0.0012", "0.0013"));
  EXPECT_THAT(tick_texts(-pi, pi, true, 4), ElementsAre("−π", "−π/2", "0", "π/2", "π"));
  EXPECT_THAT(tick_texts(0, 2 * pi, true, 8), ElementsAre("0", "π/4", "π/2", "3π/4", "π", "5π/4", "3π/2", "7π/4", "2π"));
  EXPECT_THAT(tick_texts(0.1, 0.52, true, 4), ElementsAre("0.1", "0.2", "0.3", "0.4", "0.5"));
  EXPECT_THAT(tick_texts(-2e9, 2e9, false, 4), ElementsAre("-2e+09", "-1e+09", "0", "1e+09", "2e+09"));
}

}  // namespace
}  // namespace corank::report
