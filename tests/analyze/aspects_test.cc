// Pieces between singularities, counted by hand or by the geometry of the mechanism.
#include "corank/analyze/aspects/aspects.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "corank/certify/angle.h"
#include "corank/result/values/claim_files.h"
#include "corank/study/model.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/sets/determinant_factors.h"
#include "corank/tests/seeds.h"

namespace corank::analyze {
namespace {

Aspects aspects_of(symbolic::Mechanism model) {
  solve::Control control;
  return aspects({.model = std::move(model)}, {}, control);
}

Aspects aspects_of_model(const std::string& name) {
  return aspects_of(study::read_model(std::string(CORANK_SOURCE_DIR) + "/models/" + name + ".cuik").mechanism);
}

// |y_A| and |y_B| are √(1 − x_C²) and √(16/25 − x_C²) on two closed curves; det L_y = 0 where x_C y_B = 0, det L_z = 0
// where x_C y_A = 0, which for y_A is never so. 8 forward singularities on 2 closed curves leave 8 arcs, 4 inverse ones 4.
TEST(Aspects, OfTheThreeSlidersAreArcs) {
  const Aspects a = aspects_of_model("three_slider");
  ASSERT_TRUE(a.aspects.exact() && a.assembly_modes.exact() && a.working_modes.exact());
  EXPECT_EQ(a.aspects.at_least, 8);
  EXPECT_EQ(a.assembly_modes.at_least, 8);
  EXPECT_EQ(a.working_modes.at_least, 4);
}

// Neither crank of this spatial four-bar turns all the way: its C-space is one closed curve, on which each angle has a
// greatest and a least value. Sheets are so large that enclosures of their parts stay wide but for a proof of their own.
TEST(Aspects, OfASpatialFourBarAreItsFourArcs) {
  const Aspects found = aspects_of(symbolic::read_model(CORANK_SOURCE_DIR "/tests/data/rssr.cuik"));
  EXPECT_TRUE(found.aspects.exact() && found.assembly_modes.exact() && found.working_modes.exact());
  EXPECT_EQ(found.aspects.at_least, 4);
  EXPECT_EQ(found.assembly_modes.at_least, 2);
  EXPECT_EQ(found.working_modes.at_least, 2);
}

TEST(Aspects, DoNotDependOnTheUnitOfLength) {
  std::vector<std::string> units{"1/1000", "1000000"};
  if (test::long_run()) units.insert(units.end(), {"1", "100"});
  for (const std::string& unit : units) {
    auto model = study::read_model(std::string(CORANK_SOURCE_DIR) + "/models/dextar.cuik").mechanism;
    model.set_constant("l", symbolic::Expression("9/10*" + unit));
    model.set_constant("d", symbolic::Expression("59/50*" + unit));
    const Aspects a = aspects_of(std::move(model));
    ASSERT_TRUE(a.aspects.exact() && a.assembly_modes.exact() && a.working_modes.exact()) << unit;
    EXPECT_EQ(a.aspects.at_least, 10) << unit;
    EXPECT_EQ(a.assembly_modes.at_least, 2) << unit;
    EXPECT_EQ(a.working_modes.at_least, 4) << unit;
    EXPECT_NEAR(static_cast<double>(a.aspects.cells), 3380, 100) << unit;
  }
}

// det L_z = l1 l2 sin(t2).
TEST(Aspects, OfAnArmWithoutALinkAreNeitherCountedNorVerified) {
  const std::string path = CORANK_SOURCE_DIR "/models/planar/arm_2r_limits.cuik";
  const study::Question arm{.model = study::read_model(path).mechanism};
  solve::Control control;
  result::PiecesFile file = to_file(arm, aspects(arm, {.certificate = true}, control));
  EXPECT_TRUE(result::verify(file).complete());
  file.constants.push_back({"l1", "0"});
  EXPECT_THROW(result::verify(file), symbolic::DeterminantVanishes);
  EXPECT_THROW(aspects_of(study::read_model(path, file.constants).mechanism), symbolic::DeterminantVanishes);
}

TEST(Aspects, SayThatThereIsNoConfiguration) {
  const std::string path = CORANK_SOURCE_DIR "/models/dextar.cuik";
  const study::Question dextar{.model = study::read_model(path, {{"d", "9"}}).mechanism};
  const std::string text = to_text(dextar, aspects_of(dextar.model));
  EXPECT_THAT(text, testing::HasSubstr("There is no configuration in the search domain."));
  EXPECT_THAT(text, testing::Not(testing::HasSubstr("A configuration of each aspect")));
}

// Limits of lengths count as the sines that are 0 where it is singular do.
TEST(Aspects, WithinLimitsOfLengthsDoNotDependOnTheirUnit) {
  for (const std::string unit : {"1/1000", "1", "1000000"}) {
    const auto model = study::parse_model(
        {"[CONSTANTS]\nu := " + unit + "\nl1 := u\nl2 := 6/5*u\nw := 3/2*u\n[SYSTEM VARS]\n" +
             "a : [-w, w]\nb : [-w, w]\nx :\ny :\ntheta1 ~ [-pi, pi]\ntheta2 ~ [-pi, pi]\n[SYSTEM EQS]\n" +
             "x = a + l1*cos(theta1);\ny = l1*sin(theta1);\nx = b + l2*cos(theta2);\ny = l2*sin(theta2);\n" +
             "[INPUTS] a, b\n[OUTPUTS] x, y\n[LIMITS]\na : [-w, w]\nb : [-w, w]\n",
         "sliders.cuik"});
    const Aspects a = aspects_of(model.mechanism);
    ASSERT_TRUE(a.aspects.exact() && a.assembly_modes.exact() && a.working_modes.exact()) << unit;
    EXPECT_EQ(a.aspects.at_least, 8) << unit;
    EXPECT_EQ(a.assembly_modes.at_least, 4) << unit;
    EXPECT_EQ(a.working_modes.at_least, 4) << unit;
  }
}

// C-space is two closed curves where the linkage is of Grashof's kind, else one. A crank has no dead points: the other
// link's four (two on each curve) divide the curves.
TEST(Aspects, OfFourBarsAreThoseOfTheirGrashofType) {
  struct Case {
    const char* model;
    int aspects;
  };
  for (const auto& [model, count] :
       {Case{"crank_rocker", 4}, Case{"double_crank", 2}, Case{"double_rocker", 8}, Case{"triple_rocker", 4}}) {
    SCOPED_TRACE(model);
    const Aspects a = aspects_of_model(std::string("planar/four_bar_") + model);
    ASSERT_TRUE(a.aspects.exact());
    EXPECT_EQ(a.aspects.at_least, count);
  }
}

// A five-bar has two sides of J2, J4 on which J3 may be, and each arm two postures.
void expect_modes_of_a_five_bar(const Aspects& a) {
  ASSERT_TRUE(a.assembly_modes.exact() && a.working_modes.exact());
  EXPECT_EQ(a.assembly_modes.at_least, 2);
  EXPECT_EQ(a.working_modes.at_least, 4);
  EXPECT_EQ(a.forward_factors.size(), 1u);
  EXPECT_EQ(a.inverse_factors.size(), 2u);
}

// The number of connected pieces, of more than `least` cells, of a grid's cells of one sign each; 0 belongs to none. The
// grid's border is 0, or it is a torus.
int pieces_of_grid(std::vector<int> signs, int rows, int columns, int least) {
  int pieces = 0;
  std::vector<int> stack;
  for (int start = 0; start < rows * columns; ++start) {
    const int sign = std::exchange(signs[static_cast<std::size_t>(start)], 0);
    if (sign == 0) continue;
    int size = 0;
    for (stack.push_back(start); !stack.empty(); ++size) {
      const int at = stack.back(), i = at / columns, j = at % columns;
      stack.pop_back();
      for (const auto& [di, dj] : {std::pair(1, 0), {-1, 0}, {0, 1}, {0, -1}}) {
        const int to = (i + di + rows) % rows * columns + (j + dj + columns) % columns;
        if (signs[static_cast<std::size_t>(to)] == sign) signs[static_cast<std::size_t>(to)] = 0, stack.push_back(to);
      }
    }
    pieces += size > least;
  }
  return pieces;
}

// Within a working mode of Dextar the place of J3 says the configuration: the pieces of a grid of places, without those so
// near to a singularity that the grid does not show on which side they are. `limited`: with J2 and J4 above the ground.
int dextar_pieces(bool limited) {
  constexpr int kRows = 900;
  constexpr double kStep = 4.0 / kRows, l = 0.9, d = 1.18;
  const auto elbow = [&](double center, double sign, double x, double y) {
    const double r = std::hypot(x - center, y), h = std::sqrt(std::max(l * l - r * r / 4, 0.0)) / r;
    return std::array{center + (x - center) / 2 - sign * h * y, y / 2 + sign * h * (x - center), r};
  };
  int pieces = 0;
  for (const double left : {-1.0, 1.0})
    for (const double right : {-1.0, 1.0}) {
      std::vector<int> side;  // of J3 to J4 and J2
      for (int i = 0; i < kRows; ++i)
        for (int j = 0; j < kRows; ++j) {
          const double x = d / 2 - 2 + (i + 0.5) * kStep, y = -2 + (j + 0.5) * kStep;
          const auto [ax, ay, a] = elbow(0, left, x, y);
          const auto [bx, by, b] = elbow(d, right, x, y);
          const bool there = std::min(a, b) > 3 * kStep && std::max(a, b) < 2 * l && (!limited || (ay > 0 && by > 0));
          side.push_back(!there ? 0 : (x - ax) * (y - by) - (y - ay) * (x - bx) > 0 ? 1 : -1);
        }
      pieces += pieces_of_grid(side, kRows, kRows, 50);
    }
  return pieces;
}

void expect_those_of_a_flood_fill(const Aspects& a) {
  const int pieces = dextar_pieces(false);
  EXPECT_EQ(pieces, 10);
  ASSERT_TRUE(a.aspects.exact()) << a.aspects.reason;
  EXPECT_EQ(a.aspects.at_least, pieces);
  EXPECT_TRUE(a.limits.empty());
}

TEST(Aspects, OfDextarWithLimitsAreThoseOfAFloodFill) {
  const Aspects a = aspects_of_model("dextar_limits");
  ASSERT_TRUE(a.aspects.exact()) << a.aspects.reason;
  EXPECT_EQ(a.aspects.at_least, dextar_pieces(true));
  EXPECT_THAT(a.limits, testing::ElementsAre("range of theta2", "range of theta5"));
}

// Nothing is singular but where arm 2 and 3 of the orthogonal robot are, on two closed curves of their torus.
TEST(Aspects, OfAnOrthogonalArmAreThoseOfAFloodFill) {
  constexpr int kRows = 400;
  std::vector<int> signs;
  for (int i = 0; i < kRows; ++i)
    for (int j = 0; j < kRows; ++j) {
      const double t2 = i * 2 * M_PI / kRows, t3 = j * 2 * M_PI / kRows;
      signs.push_back(sin(t3) + cos(t2) * (2 * sin(t3) - cos(t3)) > 0 ? 1 : -1);
    }
  const Aspects a = aspects_of_model("serial/orthogonal_3r");
  ASSERT_TRUE(a.aspects.exact()) << a.aspects.reason;
  EXPECT_EQ(a.aspects.at_least, pieces_of_grid(signs, kRows, kRows, 5));
  EXPECT_EQ(a.assembly_modes.at_least, 1);
  EXPECT_TRUE(a.limits.empty());
}

// With its first leg held the 3-RPR platform is where that leg's and the platform's angles are, as far as the other legs
// reach. Forward singularities: the legs' lines meet in a point or are parallel.
int slice_pieces(double leg) {
  constexpr int kRows = 600;
  std::vector<int> signs;
  for (int i = 0; i < kRows; ++i)
    for (int j = 0; j < kRows; ++j) {
      const double alpha = i * 2 * M_PI / kRows, phi = j * 2 * M_PI / kRows;
      const double c = cos(phi), s = sin(phi), x = leg * cos(alpha), y = leg * sin(alpha);
      const std::array base{std::array{0.0, 0.0}, std::array{2.0, 0.0}, std::array{0.8, 1.5}};
      const std::array ends{std::array{x, y}, std::array{x + c, y + s},
                            std::array{x + 0.6 * c - 0.4 * s, y + 0.6 * s + 0.4 * c}};
      std::array<std::array<double, 3>, 3> line{};
      bool within = true;
      for (std::size_t k = 0; k < 3; ++k) {
        const double u = ends[k][0] - base[k][0], v = ends[k][1] - base[k][1], rho = std::hypot(u, v);
        within = within && (k == 0 || (0.5 < rho && rho < 2));
        line[k] = {u, v, base[k][0] * v - base[k][1] * u};
      }
      const auto& [p, q, r] = line;
      const double det =
          p[0] * (q[1] * r[2] - q[2] * r[1]) - p[1] * (q[0] * r[2] - q[2] * r[0]) + p[2] * (q[0] * r[1] - q[1] * r[0]);
      signs.push_back(!within ? 0 : det > 0 ? 1 : -1);
    }
  return pieces_of_grid(signs, kRows, kRows, 10);
}

Aspects slice(const char* held) {
  return aspects_of(
      study::read_model(CORANK_SOURCE_DIR "/models/planar/3rpr.cuik", {{"lower1", held}, {"upper1", held}}).mechanism);
}

// At 6/5 and 7/5 a limit of the second leg passes through cells where the locus ends.
TEST(Aspects, OfThreeRprSlicesAreThoseOfAFloodFill) {
  std::vector<std::pair<double, const char*>> legs{{1.2, "6/5"}};
  if (test::long_run()) legs.insert(legs.end(), {{0.8, "4/5"}, {1.4, "7/5"}});
  for (const auto& [leg, held] : legs) {
    SCOPED_TRACE(held);
    const Aspects a = slice(held);
    ASSERT_TRUE(a.aspects.exact()) << a.aspects.reason;
    EXPECT_EQ(a.aspects.at_least, slice_pieces(leg));
    EXPECT_EQ(a.working_modes.at_least, 1);
    EXPECT_FALSE(a.limits.empty());
  }
}

// At 3/2 the second leg's lower end is a critical value of its length: two sectors of one piece, or of two, come together at
// that point, and which of these it is no box can tell.
TEST(Aspects, OfASliceWhoseLimitEndsAtACriticalValueHaveAnUpperBound) {
  const Aspects a = slice("3/2");
  const int pieces = slice_pieces(1.5);
  EXPECT_LE(a.aspects.at_least, pieces);
  EXPECT_EQ(a.aspects.at_most, pieces);
  EXPECT_GE(a.aspects.at_least, 5);
  EXPECT_TRUE(a.working_modes.exact());
}

// Straight lines on the torus of v and w: two of v + k w = ±π/2 and two of v − m w = ±π/2, which meet in 4 (k + m) points,
// divide it into as many pieces (Euler).
TEST(Aspects, OfLinesThatCrossOnATorusAreItsFaces) {
  std::vector<std::pair<int, int>> lines{{1, 1}, {1, 2}};
  if (test::long_run()) lines.insert(lines.end(), {{1, 0}, {2, 1}});
  for (const auto& [k, m] : lines) {
    SCOPED_TRACE(k * 10 + m);
    const auto line = [](int c) { return std::to_string(c) + "*w"; };
    const Aspects a =
        aspects_of(symbolic::parse_model("[SYSTEM VARS]\nv ~ [-pi, pi]\nw ~ [-pi, pi]\nx : [-2, 2]\ny : [-2, 2]\n"
                                         "[SYSTEM EQS]\nx = sin(v + " +
                                             line(k) + ");\ny = sin(v - " + line(m) + ");\n[INPUTS] v, w\n[OUTPUTS] x, y\n",
                                         "lines.cuik"));
    ASSERT_TRUE(a.aspects.exact()) << a.reason << a.aspects.reason;
    EXPECT_EQ(a.aspects.at_least, 4 * (k + m));
    EXPECT_EQ(a.assembly_modes.at_least, 1);
  }
}

TEST(Aspects, OfTheSphericalFiveBarAreCounted) {
  const Aspects a = aspects_of_model("spherical_five_bar");
  ASSERT_TRUE(a.aspects.exact()) << a.aspects.reason;
  EXPECT_EQ(a.aspects.at_least, 10);
}

// Each is a configuration, and has the signs that are said of it.
void expect_configurations(const Aspects& a) {
  ASSERT_EQ(a.aspects.representatives.size(), a.aspects.signs.size());
  for (std::size_t k = 0; k < a.aspects.signs.size(); ++k) {
    std::map<std::string, double> q;
    const Box& box = a.aspects.representatives[k];
    for (const Angle& angle : a.system.angles)
      q[angle.name] =
          std::atan2(box[static_cast<std::size_t>(angle.sine)].mid(), box[static_cast<std::size_t>(angle.cosine)].mid());
    const double l = 0.9, d = 1.18;
    EXPECT_NEAR(d + l * (cos(q["theta2"]) + cos(q["theta3"]) + cos(q["theta4"]) - cos(q["theta5"])), 0, 1e-9);
    EXPECT_NEAR(l * (sin(q["theta2"]) + sin(q["theta3"]) + sin(q["theta4"]) - sin(q["theta5"])), 0, 1e-9);
    EXPECT_GT(std::abs(sin(q["theta3"] - q["theta4"]) * sin(q["theta2"] - q["theta3"]) * sin(q["theta4"] - q["theta5"])),
              1e-9);
  }
}

// det L_y and det L_z are their factors' product, up to one sign for all.
void expect_signs_of_their_determinants(const Aspects& a) {
  ASSERT_EQ(a.determinant_signs.size(), 10u);
  const auto& [y, z] = a.determinant_signs.front();
  const auto& first = a.aspects.signs.front();
  for (std::size_t k = 0; k < a.determinant_signs.size(); ++k) {
    const auto& s = a.aspects.signs[k];
    EXPECT_NE(a.determinant_signs[k][0] * a.determinant_signs[k][1], 0);
    EXPECT_EQ(a.determinant_signs[k][0] * y, s[0] * first[0]);
    EXPECT_EQ(a.determinant_signs[k][1] * z, s[1] * s[2] * first[1] * first[2]);
  }
}

// In each working mode the end reaches the lens about both motors once: of one mode no two aspects have a place in common.
void expect_images_that_cover_the_lens_once_per_working_mode(const Aspects& a) {
  ASSERT_TRUE(a.images && a.images->areas.size() == 10);
  const double r = 1.8, d = 1.18, lens = 2 * r * r * std::acos(d / (2 * r)) - d / 2 * std::sqrt(4 * r * r - d * d);
  double lo = 0, hi = 0;
  for (const Interval& area : a.images->areas) lo += area.lo(), hi += area.hi();
  EXPECT_LE(lo, 4 * lens);
  EXPECT_GE(hi, 4 * lens);
  EXPECT_GT(lo, 2 * lens);
  EXPECT_LT(hi, 6 * lens);
  const auto& s = a.aspects.signs;
  int shared = 0;
  for (std::size_t p = 0; p < s.size(); ++p)
    for (std::size_t q = 0; q < p; ++q) {
      EXPECT_EQ(a.images->share[p][q], a.images->share[q][p]);
      const bool same_mode = s[p][1] == s[q][1] && s[p][2] == s[q][2];
      EXPECT_FALSE(same_mode && a.images->share[p][q].value_or(false));
      shared += a.images->share[p][q].value_or(false);
    }
  EXPECT_GE(shared, 15);
}

// Searched for once.
TEST(Aspects, OfDextarAreThoseOfAFloodFillWithModesRepresentativesSignsAndImages) {
  solve::Control control;
  const Aspects a = aspects({.model = study::read_model(CORANK_SOURCE_DIR "/models/dextar.cuik").mechanism},
                            {.images = {"J3x", "J3y"}, .rows = 40}, control);
  expect_those_of_a_flood_fill(a);
  expect_modes_of_a_five_bar(a);
  expect_configurations(a);
  expect_signs_of_their_determinants(a);
  expect_images_that_cover_the_lens_once_per_working_mode(a);
}

TEST(Aspects, AreNotCountedWhereCSpaceCrossesItself) {
  symbolic::Mechanism equal = symbolic::read_model(CORANK_SOURCE_DIR "/models/three_slider.cuik");
  equal.set_constant("L2", 1);
  const Aspects a = aspects_of(equal);
  EXPECT_FALSE(a.reason.empty());
  EXPECT_EQ(a.aspects.at_least, 0);
}

// A graph u = p(v) over a circle of v, a curve: p's critical points are the inverse singularities, and the arcs between
// them the working modes.
TEST(Aspects, OfPlantedCurvesAreTheirMonotoneArcs) {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> harmonic(1, 4);
  for (int k = 0; k < 8; ++k) {
    const int n = harmonic(random);
    const symbolic::Mechanism m =
        symbolic::parse_model("[SYSTEM VARS]\nv ~ [-pi, pi]\nu : [-2, 2]\n[SYSTEM EQS]\nu = sin(" + std::to_string(n) +
                                  "*v + 1/" + std::to_string(k + 2) + ");\n[INPUTS] v\n[OUTPUTS] u\n",
                              "wave.cuik");
    const Aspects a = aspects_of(m);
    ASSERT_TRUE(a.working_modes.exact() && a.assembly_modes.exact()) << n;
    EXPECT_EQ(a.working_modes.at_least, 2 * n);
    EXPECT_EQ(a.assembly_modes.at_least, 1);
    EXPECT_EQ(a.aspects.at_least, 2 * n);
  }
}

}  // namespace
}  // namespace corank::analyze
