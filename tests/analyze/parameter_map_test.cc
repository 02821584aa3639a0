// Numbers of solutions over planes of parameters, against closed forms and against searches at single values.
#include "corank/analyze/maps/parameter_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "corank/core/exact_number.h"
#include "corank/study/answer.h"
#include "corank/study/model.h"

namespace corank::analyze {
namespace {

using Kind = MapCellAnswer::Kind;

study::Question question_of(const std::string& text, std::optional<symbolic::SingularitySet> set = std::nullopt) {
  study::Model model = study::parse_model({text, "test.cuik"});
  return {.model = std::move(model.mechanism), .set = set};
}

study::Question model_question(const std::string& file, symbolic::SingularitySet set) {
  study::Model model = study::read_model(std::string(CORANK_SOURCE_DIR) + "/models/" + file);
  return {.model = std::move(model.mechanism), .set = set};
}

ParameterMap map_of(const MapQuestion& question, int resolution = 32, int threads = 2) {
  solve::Control control;
  return parameter_map(question, {.resolution = resolution, .boundary = true, .threads = threads, .progress = {}}, control);
}

ParameterMap map_of(const std::string& text, const std::vector<symbolic::Parameter>& over, int resolution = 32) {
  return map_of({.question = question_of(text), .over = over}, resolution);
}

const char* const kCubic = R"([CONSTANTS]
a := 0
b := 0
[SYSTEM VARS]
x : [-4, 4]
[SYSTEM EQS]
x^3 + a*x + b = 0;)";

// Of each proven cell, at its corners and between them.
void expect_counts(const ParameterMap& map, const std::function<int(double, double)>& count) {
  for (const MapCellAnswer& c : map.cells) {
    ASSERT_NE(c.kind, Kind::pending);
    if (c.kind != Kind::proven) continue;
    for (const double x : {c.sides[0].lo(), c.sides[0].mid(), c.sides[0].hi()})
      for (const double y : {c.sides[1].lo(), c.sides[1].mid(), c.sides[1].hi()})
        EXPECT_EQ(*c.count, count(x, y)) << "at " << x << ", " << y;
  }
}

TEST(ParameterMap, OfACubicIsItsCuspOfThreeRoots) {
  const ParameterMap map = map_of(kCubic, {{"a", "-2", "1"}, {"b", "-1", "1"}});
  expect_counts(map, [](double a, double b) { return 4 * a * a * a + 27 * b * b < 0 ? 3 : 1; });
  EXPECT_TRUE(map.complete);
  EXPECT_GT(map.proven_share(), 0.8);
  EXPECT_GT(map.shares().at(3) * 6, 1);  // of an area of about 1.7
  EXPECT_GT(map.shares().at(1) * 6, 3);
}

TEST(ParameterMap, EnclosesTheWholeCurveOnWhichSolutionsMeetAndProvesPiecesOfIt) {
  const ParameterMap map = map_of(kCubic, {{"a", "-2", "1"}, {"b", "-1", "1"}});
  ASSERT_TRUE(map.boundary_known);
  const auto covered = [&](double a, double b) {
    return std::any_of(map.boundary.begin(), map.boundary.end(),
                       [&](const MapBoundaryBox& box) { return box.sides[0].contains(a) && box.sides[1].contains(b); });
  };
  for (double x = -0.55; x <= 0.55; x += 0.01) EXPECT_TRUE(covered(-3 * x * x, 2 * x * x * x)) << x;
  int proven = 0;
  for (const MapBoundaryBox& box : map.boundary) {
    proven += box.proven;
    // 4a³ + 27b² takes both signs in it, or is 0 at an end.
    const double least = 4 * std::pow(box.sides[0].lo(), 3) + 27 * std::pow(box.sides[1].mig(), 2);
    const double most = 4 * std::pow(box.sides[0].hi(), 3) + 27 * std::pow(box.sides[1].mag(), 2);
    if (box.proven) {
      EXPECT_LE(least, 1e-9);
      EXPECT_GE(most, -1e-9);
    }
  }
  EXPECT_GT(proven, 20);
}

TEST(ParameterMap, OfTwoCirclesIsTheirTriangleInequality) {
  const ParameterMap map = map_of(R"([CONSTANTS]
r1 := 1
r2 := 1
[SYSTEM VARS]
x : [-3, 3]
y : [-3, 3]
[SYSTEM EQS]
x^2 + y^2 = r1^2;
(x - 1)^2 + y^2 = r2^2;)",
                                  {{"r1", "1/10", "2"}, {"r2", "1/10", "2"}});
  expect_counts(map, [](double r1, double r2) { return std::fabs(r1 - r2) < 1 && r1 + r2 > 1 ? 2 : 0; });
  EXPECT_GT(map.proven_share(), 0.85);
}

TEST(ParameterMap, CountsASolutionOnlyWhereItIsInTheDomain) {
  const ParameterMap map = map_of(R"([CONSTANTS]
a := 0
b := 0
[SYSTEM VARS]
x : [-1, 1]
[SYSTEM EQS]
x = a + b;)",
                                  {{"a", "-3/2", "3/2"}, {"b", "-1", "1"}});
  expect_counts(map, [](double a, double b) { return std::fabs(a + b) <= 1 ? 1 : 0; });
  EXPECT_GT(map.shares().at(0), 0.1);
  EXPECT_GT(map.shares().at(1), 0.4);
  for (const MapCellAnswer& c : map.cells) {  // on either side of an end nothing is proven of the whole cell
    const bool crosses = c.sides[0].lo() + c.sides[1].lo() < 1 && c.sides[0].hi() + c.sides[1].hi() > 1;
    EXPECT_FALSE(crosses && c.kind == Kind::proven);
  }
}

TEST(ParameterMap, CountsEachConfigurationWithAKernelVectorOnce) {
  // Three sliders: 8 forward singularities where one rod is longer than the other, 4 on the other side of the equality.
  const ParameterMap map = map_of({.question = model_question("three_slider.cuik", symbolic::SingularitySet::forward),
                                   .over = {{"L1", "1/2", "2"}, {"L2", "1/2", "2"}}});
  expect_counts(map, [](double l1, double l2) { return l1 > l2 ? 8 : 4; });
  EXPECT_GT(map.proven_share(), 0.85);
}

TEST(ParameterMap, TakesCoordinatesAndAnglesAsParameters) {
  // A five-bar with four links of 0.9: over its end's position each arm has two postures where it reaches.
  const ParameterMap inverse = map_of({.question = model_question("dextar.cuik", symbolic::SingularitySet::cspace),
                                       .over = {{"J3x", "-1", "2"}, {"J3y", "-2", "2"}}});
  expect_counts(inverse, [](double x, double y) { return std::hypot(x, y) < 1.8 && std::hypot(x - 1.18, y) < 1.8 ? 4 : 0; });
  EXPECT_GT(inverse.shares().at(4), 0.2);
  // Over its motors' angles two assembly modes where its elbows are less than 1.8 apart.
  const ParameterMap direct = map_of({.question = model_question("dextar.cuik", symbolic::SingularitySet::cspace),
                                      .over = {{"theta2", "-pi", "pi"}, {"theta5", "-pi", "pi"}}});
  expect_counts(direct, [](double t2, double t5) {
    const double x = 1.18 + 0.9 * (std::cos(t2) - std::cos(t5)), y = 0.9 * (std::sin(t2) - std::sin(t5));
    return std::hypot(x, y) < 1.8 ? 2 : 0;
  });
  EXPECT_GT(direct.shares().at(2), 0.3);
}

TEST(ParameterMap, FollowsConstantsThatAreDefinedByAParameterAndFixedCoordinates) {
  const ParameterMap map = map_of({.question = model_question("dextar.cuik", symbolic::SingularitySet::cspace),
                                   .over = {{"l", "1/2", "3/2"}, {"d", "1/2", "3/2"}},
                                   .fixed = {{"theta2", "pi/3"}, {"theta5", "2"}}});
  expect_counts(map, [](double l, double d) {
    const double x = d + l * (std::cos(M_PI / 3) - std::cos(2)), y = l * (std::sin(M_PI / 3) - std::sin(2));
    return std::hypot(x, y) < 2 * l ? 2 : 0;
  });
  EXPECT_GT(map.proven_share(), 0.85);
}

TEST(ParameterMap, IsTheSameForAnyNumberOfThreadsAndFromTilesInAnyOrder) {
  const MapQuestion question{.question = question_of(kCubic), .over = {{"a", "-2", "1"}, {"b", "-1", "1"}}};
  ParameterMap one = map_of(question, 32, 1), three = map_of(question, 32, 3);
  const ParameterMapper mapper(question, {.resolution = 32, .boundary = true, .threads = 1, .progress = {}});
  std::vector<MapTile> tiles;
  solve::Control control;
  for (int k = ParameterMapper::tiles() - 1; k >= 0; --k) tiles.push_back(tile_from_json(to_json(mapper.tile(k, control))));
  ParameterMap put_together = mapper.assemble(std::move(tiles));
  one.seconds = three.seconds = put_together.seconds = 0;
  EXPECT_EQ(to_json(one), to_json(three));
  EXPECT_EQ(to_json(one), to_json(put_together));
}

TEST(ParameterMap, LeavesPendingWhatALimitHasLeft) {
  std::atomic<bool> stop = true;
  solve::Control control({.stop = &stop});
  const ParameterMap map = parameter_map({.question = question_of(kCubic), .over = {{"a", "-2", "1"}, {"b", "-1", "1"}}},
                                         {.resolution = 32}, control);
  EXPECT_FALSE(map.complete);
  EXPECT_FALSE(map.boundary_known);
  EXPECT_EQ(map.cells.size(), 64U);
  for (const MapCellAnswer& c : map.cells) EXPECT_EQ(c.kind, Kind::pending);
}

TEST(ParameterMap, SearchesForNoFoldsAfterALimitOfTime) {
  const ParameterMapper mapper({.question = question_of(kCubic), .over = {{"a", "-2", "1"}, {"b", "-1", "1"}}},
                               {.resolution = 128, .boundary = true, .threads = 1, .progress = {}});
  int ended = 0;
  for (int k = 0; k < ParameterMapper::tiles(); ++k)
    for (std::uint64_t moment = 2;; moment += 12) {
      std::uint64_t questions = 0;
      solve::Control control({.time = 1, .clock = [&] { return ++questions > moment ? 2.0 : 0.0; }});
      const MapTile tile = mapper.tile(k, control);
      if (std::ranges::none_of(tile.cells, [](const auto& cell) { return cell.kind == Kind::pending; })) break;
      if (tile.boundary.empty()) continue;  // there was nothing to search for yet
      EXPECT_FALSE(tile.boundary_known) << "tile " << k << ", question " << moment;
      ++ended;
    }
  EXPECT_GT(ended, 100);
}

TEST(ParameterMap, CellsCoverTheRegionOnce) {
  const ParameterMap map = map_of(kCubic, {{"a", "-2", "1"}, {"b", "-1", "1"}});
  double area = 0;
  for (const MapCellAnswer& c : map.cells) area += c.sides[0].width() * c.sides[1].width();
  EXPECT_NEAR(area, 6, 1e-9);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> a(-2, 1), b(-1, 1);
  for (int k = 0; k < 200; ++k) {
    const double x = a(random), y = b(random);
    EXPECT_EQ(std::count_if(map.cells.begin(), map.cells.end(),
                            [&](const auto& c) { return c.sides[0].contains(x) && c.sides[1].contains(y); }),
              1);
  }
}

TEST(ParameterMap, KnowsComponentsAtCentresAlone) {
  const ParameterMap map = map_of({.question = question_of(R"([CONSTANTS]
c := 1
e := 0
[SYSTEM VARS]
x : [-3, 3]
y : [-3, 3]
[SYSTEM EQS]
x^2 - c - e*y = 0;)"),
                                   .over = {{"c", "1/2", "2"}, {"e", "1/20", "1/10"}},
                                   .answer = MapAnswer::components},
                                  8);
  for (const MapCellAnswer& cell : map.cells) {
    EXPECT_EQ(cell.kind, Kind::centre);
    EXPECT_FALSE(cell.count);
  }
  EXPECT_EQ(map.cells.size(), 64U);
  EXPECT_EQ(map.proven_share(), 0);
  EXPECT_GT(map.shares().at(2), 0.5);
}

// A slider-crank, at centres L = k/8: where the crank L is 0 all configurations are singular.
TEST(ParameterMap, KnowsNoAspectsWhereADeterminantVanishes) {
  const char* const slider = R"([CONSTANTS]
L := 1
M := 1
[SYSTEM VARS]
x : [-4, 4]
a ~
b ~
[SYSTEM EQS]
x = L*cos(a) + M*cos(b);
L*sin(a) + M*sin(b) = 0;
[INPUTS] a
[OUTPUTS] x)";
  const ParameterMap map = map_of(
      {.question = question_of(slider), .over = {{"L", "-1/16", "15/16"}, {"M", "1", "2"}}, .answer = MapAnswer::aspects},
      8);
  ASSERT_EQ(map.cells.size(), 64U);
  for (const MapCellAnswer& cell : map.cells)
    EXPECT_EQ(cell.at_centre, cell.sides[0].mid() == 0 ? std::nullopt : std::optional(4)) << cell.sides[0].mid();
}

TEST(ParameterMap, RefusesWhatHasNoNumber) {
  const auto refused = [](MapQuestion question) { EXPECT_THROW(map_of(question), symbolic::ModelError); };
  const symbolic::Parameter a{"a", "-2", "1"}, b{"b", "-1", "1"};
  refused({.question = question_of(kCubic), .over = {a}});
  refused({.question = question_of(kCubic), .over = {a, a}});
  refused({.question = question_of(kCubic), .over = {a, {"c", "0", "1"}}});
  refused({.question = question_of(kCubic), .over = {a, {"b", "1", "1"}}});
  refused({.question = question_of(kCubic), .over = {a, b}, .fixed = {{"y", "1"}}});
  // A five-bar's configurations are a surface.
  refused({.question = model_question("dextar.cuik", symbolic::SingularitySet::cspace),
           .over = {{"l2", "1/2", "1"}, {"l3", "1/2", "1"}}});
  refused({.question = model_question("dextar.cuik", symbolic::SingularitySet::boundary),
           .over = {{"l2", "1/2", "1"}, {"l3", "1/2", "1"}}});
}

// Random systems of two polynomials in two unknowns, their coefficients linear in two parameters: what is proven of a cell
// holds at random values in it, where the ordinary search counts.
// A four-bar; `more` is what its coupler's first joint has across the crank.
study::Question four_bar(const std::string& more = "0", const std::string& normal = "1") {
  const std::string axis = "+(0,0," + normal + ")";
  study::Model model = study::parse_model(
      {"[CONSTANTS]\na := 1\nb := 3\nc := 2\nd := 5/2\n[LINKS]\nground\ncrank\ncoupler\nrocker\n[JOINTS]\n"
       "revolute t1 : ground (0,0,0)" +
           axis + " crank (0,0,0)" + axis +
           " zero (1,0,0) (1,0,0) actuated\n"
           "revolute A : crank (a," +
           more +
           ",0)+(0,0,1) coupler (0,0,0)+(0,0,1)\n"
           "revolute B : coupler (b,0,0)+(0,0,1) rocker (c,0,0)+(0,0,1)\n"
           "revolute t2 : ground (d,0,0)+(0,0,1) rocker (0,0,0)+(0,0,1)\n[OUTPUTS]\nt2 : joint t2\n",
       "four_bar.cuik"});
  return {
      .model = std::move(model.mechanism), .set = symbolic::SingularitySet::cspace, .assembly = std::move(model.assembly)};
}

std::string fault_of(const study::Question& question, const std::vector<symbolic::Parameter>& over) {
  try {
    map_of({.question = question, .over = over, .fixed = {{"t1", "pi/2"}}}, 8);
  } catch (const symbolic::ModelError& error) {
    return error.what();
  }
  return "none";
}

// With the crank across the ground, coupler and rocker close the triangle with a side of sqrt(a² + d²), in two ways or none.
TEST(ParameterMap, OfConstantsOfARobotFromPartsIsThatOfItsTriangles) {
  const ParameterMap lengths =
      map_of({.question = four_bar(), .over = {{"b", "1", "4"}, {"c", "1", "4"}}, .fixed = {{"t1", "pi/2"}}});
  const auto closes = [](double b, double c, double side) { return std::fabs(b - c) < side && side < b + c ? 2 : 0; };
  expect_counts(lengths, [&](double b, double c) { return closes(b, c, std::hypot(1, 2.5)); });
  EXPECT_GT(lengths.proven_share(), 0.8);
  const ParameterMap base =
      map_of({.question = four_bar(), .over = {{"a", "0.5", "4"}, {"d", "0.5", "4"}}, .fixed = {{"t1", "pi/2"}}});
  expect_counts(base, [&](double a, double d) { return closes(3, 2, std::hypot(a, d)); });
  EXPECT_GT(base.proven_share(), 0.8);
}

// b − 3 is 0 for the constants' own values, and no term of the equations that are made for those.
TEST(ParameterMap, RefusesConstantsOfARobotFromPartsWhereItsEquationsAreNotProvenToBeTheSame) {
  const study::Question offset = four_bar("b - 3");
  const std::string left_out = fault_of(offset, {{"b", "2", "4"}, {"c", "1", "4"}});
  EXPECT_NE(left_out.find("the equations leave out -3 + b, which is 0 for the constants' own values"), std::string::npos)
      << left_out;
  EXPECT_NE(left_out.find("corank derive FILE --format model"), std::string::npos);
  EXPECT_EQ(fault_of(offset, {{"d", "2", "4"}, {"c", "1", "4"}}), "none");

  const study::Question turned = four_bar("0", "c - 3/2");  // the axis' sense is that of c − 3/2, and its length counts
  const std::string sense = fault_of(turned, {{"c", "1", "4"}, {"d", "2", "4"}});
  EXPECT_NE(sense.find("the equations"), std::string::npos) << sense;
  EXPECT_EQ(fault_of(turned, {{"b", "2", "4"}, {"d", "2", "4"}}), "none");
}

TEST(ParameterMap, AgreesWithSearchesAtRandomValuesInProvenCells) {
  std::mt19937 random(20);
  std::uniform_int_distribution<int> digit(-9, 9);
  std::uniform_real_distribution<double> share(0, 1);
  int compared = 0, several = 0;
  for (int n = 0; n < 4; ++n) {
    std::string text = "[CONSTANTS]\np := 0\nq := 0\n[SYSTEM VARS]\nx : [-2, 2]\ny : [-2, 2]\n[SYSTEM EQS]\n";
    const auto coefficient = [&] {
      return "(" + std::to_string(digit(random)) + " + (" + std::to_string(digit(random)) + ")*p + (" +
             std::to_string(digit(random)) + ")*q)/10";
    };
    for (int row = 0; row < 2; ++row) {
      for (const char* monomial : {"x^2", "x*y", "y^2", "x", "y"}) text += coefficient() + "*" + monomial + " + ";
      text += coefficient() + " = 0;\n";
    }
    const study::Question question = question_of(text);
    const ParameterMap map = map_of({.question = question, .over = {{"p", "-1", "1"}, {"q", "-1", "1"}}}, 32);
    std::vector<MapCellAnswer> proven;
    for (const MapCellAnswer& c : map.cells)
      if (c.kind == Kind::proven) proven.push_back(c);
    std::uniform_int_distribution<std::size_t> any(0, proven.empty() ? 0 : proven.size() - 1);
    for (int k = 0; k < 40 && !proven.empty(); ++k) {
      const MapCellAnswer& c = proven[any(random)];
      const auto value = [&](const Interval& side) {
        return ExactNumber::dyadic(side.lo() + share(random) * (side.hi() - side.lo())).text();
      };
      study::Question at = question;
      result::put_in({{"p", value(c.sides[0])}, {"q", value(c.sides[1])}}, at.model);
      const Cover cover = study::answer(at).cover;
      ASSERT_TRUE(cover.complete());
      int isolated = 0;
      for (const CoverBox& point : cover.points)
        isolated += point.verdict == Verdict::isolated || point.verdict == Verdict::exact;
      EXPECT_EQ(static_cast<std::size_t>(isolated), cover.points.size());
      EXPECT_EQ(isolated, *c.count) << text;
      ++compared;
      several += isolated > 1;
    }
  }
  EXPECT_EQ(compared, 160);
  EXPECT_GT(several, 40);  // the comparisons are not all of 0 or 1
}

}  // namespace
}  // namespace corank::analyze
