// Planar linkages of mobility 1 from links and joints (models/planar): their singularities against closed forms and against
// the loops of vectors of planar_parts.h.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <numbers>
#include <string>
#include <vector>

#include "corank/kinematics/language/part_file.h"
#include "corank/tests/models/closed_forms.h"
#include "corank/tests/models/planar_parts.h"

namespace corank {
namespace {
using symbolic::SingularitySet;
using test::Configuration;
using test::Constants;
using test::Loops;
using test::Point;

using Places = std::vector<Configuration>;

void expect_points(const study::Model& model, SingularitySet set, const Places& expected) {
  SCOPED_TRACE(to_string(set));
  const System system = test::set_of(model.mechanism, set);
  test::expect_points(system, solve::solve(system), expected);
}

struct Mobility {
  const char* model;
  int expected;
};

TEST(PlanarParts, HaveTheirMobilityByCountByJointsAndByRank) {
  for (const auto& [model, expected] : {Mobility{"four_bar_crank_rocker", 1},
                                        {"four_bar_double_crank", 1},
                                        {"four_bar_double_rocker", 1},
                                        {"four_bar_triple_rocker", 1},
                                        {"parallelogram", 1},
                                        {"slider_crank", 1},
                                        {"watt", 1},
                                        {"stephenson", 1},
                                        {"peaucellier", 1},
                                        {"double_butterfly", 1},
                                        {"three_slider", 1},
                                        {"dextar", 2},
                                        {"five_bar_sliders", 2},
                                        {"3rrr", 3},
                                        {"3rpr", 3},
                                        {"3rpr_innocenti", 3},
                                        {"3prr", 3}}) {
    const study::Model m = test::planar_model(model);
    ASSERT_TRUE(m.assembly) << model;
    EXPECT_EQ(m.assembly->space, kinematics::Space::planar) << model;
    EXPECT_EQ(m.assembly->mobility, expected) << model;
    EXPECT_EQ(m.assembly->mobility_by_joints, expected) << model;
    EXPECT_EQ(m.assembly->mobility_by_rank, expected) << model;
    const bool can_be_flat = std::string(model) == "parallelogram" || std::string(model) == "peaucellier";
    EXPECT_EQ(m.notices.size(), can_be_flat ? 1u : 0u) << model;
  }
}

// A = (0, 0), D = (d, 0), B = A + a e(theta), C = D + c e(psi), |B C| = b.
struct FourBar {
  double a, b, c, d;

  Point far() const { return {d, 0}; }
  Configuration at(Point tip, Point end) const {
    return {{"theta", angle_of(tip)}, {"phi_coupler", angle_of(end - tip)}, {"psi", angle_of(end - far())}};
  }
  /// B C D in line: |B D| = b + c, or |b − c|.
  Places forward() const {
    Places places;
    for (const double reach : {b + c, b - c})
      for (const int sign : {-1, 1})
        if (const auto tip = test::intersect_circles({0, 0}, a, far(), std::fabs(reach), sign))
          places.push_back(at(*tip, *tip + (b / reach) * (far() - *tip)));
    return places;
  }
  /// A B C in line: |A C| = a + b, or |a − b|.
  Places inverse() const {
    Places places;
    for (const double reach : {a + b, a - b})
      for (const int sign : {-1, 1})
        if (const auto end = test::intersect_circles({0, 0}, std::fabs(reach), far(), c, sign))
          places.push_back(at((a / reach) * *end, *end));
    return places;
  }
  /// Both assembly modes at n angles of the crank.
  Places all(int n) const {
    Places places;
    for (int k = 0; k < n; ++k)
      for (const int sign : {-1, 1}) {
        const Point tip = a * test::direction(0.001 + 2 * M_PI * k / n);
        if (const auto end = test::intersect_circles(tip, b, far(), c, sign)) places.push_back(at(tip, *end));
      }
    return places;
  }
};

TEST(FourBar, HasItsDeadPointsWhereTwoLinksAreInLine) {
  struct Type {
    const char* model;
    FourBar lengths;
    std::size_t forward, inverse;
  };
  for (const auto& [model, lengths, forward, inverse] : {Type{"four_bar_crank_rocker", {2, 4.5, 3, 5}, 0, 4},
                                                         {"four_bar_double_crank", {4, 4.5, 5, 2}, 0, 0},
                                                         {"four_bar_double_rocker", {4, 2, 4.5, 5}, 4, 4},
                                                         {"four_bar_triple_rocker", {3, 4, 2, 6}, 2, 2}}) {
    SCOPED_TRACE(model);
    ASSERT_EQ(lengths.forward().size(), forward);
    ASSERT_EQ(lengths.inverse().size(), inverse);
    const study::Model m = test::planar_model(model);
    expect_points(m, SingularitySet::forward, lengths.forward());
    expect_points(m, SingularitySet::inverse, lengths.inverse());
    expect_points(m, SingularitySet::cspace_singular, {});
    const System cspace = test::set_of(m.mechanism, SingularitySet::cspace);
    const Cover cover = test::cover_of(cspace, 0.1, 0.1);
    EXPECT_TRUE(cover.complete());
    EXPECT_EQ(cover.count(Verdict::regular), cover.boxes.size());
    EXPECT_EQ(test::lost(cspace, cover, lengths.all(1000)), 0u);
  }
}

TEST(FourBar, ThatIsAParallelogramBranchesInItsChangePoints) {
  const study::Model m = test::planar_model("parallelogram");
  for (const SingularitySet set : {SingularitySet::forward, SingularitySet::inverse, SingularitySet::cspace_singular}) {
    SCOPED_TRACE(to_string(set));
    const System system = test::set_of(m.mechanism, set);
    const Cover cover = test::answer_to(m.mechanism, set);
    EXPECT_TRUE(cover.complete());
    EXPECT_EQ(cover.count(Verdict::isolated) + cover.count(Verdict::exact), cover.boxes.size());
    EXPECT_EQ(cover.points.size(), 4u);  // two, each on two branches
    for (const double crosswise : {0.0, M_PI}) {
      const Places folded{{{"theta", 0}, {"phi_coupler", 0}, {"psi", 0}, {"crosswise", crosswise}},
                          {{"theta", M_PI}, {"phi_coupler", 0}, {"psi", M_PI}, {"crosswise", crosswise}}};
      EXPECT_EQ(test::lost(system, cover, folded, 1e-12), 0u);
    }
  }
  const System cspace = test::set_of(m.mechanism, SingularitySet::cspace);
  const Cover cover = test::cover_of(cspace, 0.1, 0.1);
  // Parallelogram and antiparallelogram: two solutions for each theta, one of them psi = theta.
  Places all = FourBar{1, 2, 1, 2}.all(1000);
  for (Configuration& q : all)
    q["crosswise"] = std::fabs(std::remainder(q.at("psi") - q.at("theta"), 2 * M_PI)) < 1e-9 ? 0 : M_PI;
  EXPECT_EQ(test::lost(cspace, cover, all), 0u);
  EXPECT_GT(cover.count(Verdict::regular), 100u);
  EXPECT_EQ(cover.count(Verdict::undecided), 0u);
}

TEST(FourBar, ThatIsARhombusTurnsWhileItsCrankStands) {
  const study::Model m = test::planar_model("parallelogram", {{"b", "1"}});
  const System system = test::set_of(m.mechanism, SingularitySet::forward);
  const Cover cover = test::answer_to(m.mechanism, SingularitySet::forward, 0.1);
  EXPECT_TRUE(cover.complete());
  Places circle;  // B = D: the coupler lies on the rocker
  for (int k = 0; k < 1000; ++k) {
    const double psi = 0.002 + 2 * M_PI * k / 1000;
    circle.push_back({{"theta", 0}, {"phi_coupler", psi}, {"psi", psi}, {"crosswise", M_PI / 2}});
  }
  EXPECT_EQ(test::lost(system, cover, circle), 0u);
  ASSERT_FALSE(cover.self_motions.empty());
  EXPECT_EQ(cover.self_motions[0].dimension, 1);
  EXPECT_GT(cover.count(Verdict::regular), 20u);
}

// A crank-rocker whose passive joint at B is limited: the coupler's angle from the crank.
TEST(FourBar, WithALimitedPassiveJointLosesThatPartOfItsCspace) {
  std::ifstream in(CORANK_SOURCE_DIR "/models/planar/four_bar_crank_rocker.cuik");
  std::string text{std::istreambuf_iterator<char>(in), {}};
  const std::string joint = "coupler B + (0, 0, 1)\n";
  const auto at = text.find(joint);
  ASSERT_NE(at, std::string::npos);
  text.replace(at, joint.size(), "coupler B + (0, 0, 1)   limits [-1, 2]\n");
  const auto assembly = kinematics::assemble(kinematics::parse_parts(text, "limited.cuik"));
  const System system = test::set_of(assembly.mechanism, SingularitySet::cspace);
  constexpr double kSigma = 0.02;
  const Cover cover = test::cover_of(system, kSigma, kSigma);
  EXPECT_TRUE(cover.complete());
  Places inside, outside;
  for (const Configuration& q : FourBar{2, 4.5, 3, 5}.all(1000)) {
    const double turn = std::remainder(q.at("phi_coupler") - q.at("theta"), 2 * M_PI);
    if (turn > -1 && turn < 2) inside.push_back(q);
    if (turn < -1 - 3 * kSigma || turn > 2 + 3 * kSigma) outside.push_back(q);
  }
  EXPECT_GT(inside.size(), 300u);
  EXPECT_GT(outside.size(), 300u);
  EXPECT_EQ(test::lost(system, cover, inside), 0u);
  EXPECT_EQ(test::lost(system, cover, outside, 0), outside.size());
  EXPECT_GT(cover.count(Verdict::boundary), 0u);
  // Of the four dead points of the rocker those within the limits are left.
  Places dead;
  for (const Configuration& q : FourBar{2, 4.5, 3, 5}.inverse())
    if (std::fabs(std::remainder(q.at("phi_coupler") - q.at("theta"), 2 * M_PI)) < 1) dead.push_back(q);
  EXPECT_EQ(dead.size(), 2u);
  const System inverse = test::set_of(assembly.mechanism, SingularitySet::inverse);
  test::expect_points(inverse, solve::solve(inverse), dead);
}

TEST(SliderCrank, HasItsDeadPointsWhereCrankAndRodAreInLine) {
  struct Lengths {
    const char *r_text, *l_text;
    double r, l;
  };
  for (const auto& [r_text, l_text, r, l] : {Lengths{"1", "2", 1, 2}, {"2", "1", 2, 1}}) {
    SCOPED_TRACE(r_text);
    const study::Model m = test::planar_model("slider_crank", {{"r", r_text}, {"l", l_text}});
    Places forward, inverse;
    for (const int side : {-1, 1})
      for (const int folded : {-1, 1}) {
        const double theta = side > 0 ? 0 : M_PI, x = side * (r + folded * l);
        inverse.push_back({{"theta", theta}, {"phi_rod", folded > 0 ? theta : theta + M_PI}, {"x", x}});
        if (l >= r) continue;
        const double crank =
            folded > 0 ? std::asin(side * l / r) : M_PI - std::asin(side * l / r);  // the rod across the rail
        forward.push_back({{"theta", crank}, {"phi_rod", -side * M_PI / 2}, {"x", r * std::cos(crank)}});
      }
    expect_points(m, SingularitySet::forward, forward);
    expect_points(m, SingularitySet::inverse, inverse);
    expect_points(m, SingularitySet::cspace_singular, {});
  }
}

TEST(SliderCrank, WithARodAsLongAsItsCrankTurnsWhileItsBlockStands) {
  const study::Model m = test::planar_model("slider_crank", {{"l", "1"}});
  const System inverse = test::set_of(m.mechanism, SingularitySet::inverse);
  const Cover cover = test::answer_to(m.mechanism, SingularitySet::inverse, 0.1);
  EXPECT_TRUE(cover.complete());
  Places circle, crossings;
  for (int k = 0; k < 1000; ++k) {
    const double theta = 0.002 + 2 * M_PI * k / 1000;
    circle.push_back({{"theta", theta}, {"phi_rod", theta + M_PI}, {"x", 0}});
  }
  for (const double theta : {0.0, M_PI})
    circle.push_back({{"theta", theta}, {"phi_rod", theta}, {"x", 2 * std::cos(theta)}});
  EXPECT_EQ(test::lost(inverse, cover, circle), 0u);
  ASSERT_FALSE(cover.self_motions.empty());
  EXPECT_EQ(cover.self_motions[0].dimension, 1);
  for (const double theta : {-M_PI / 2, M_PI / 2}) crossings.push_back({{"theta", theta}, {"phi_rod", -theta}, {"x", 0}});
  for (const SingularitySet set : {SingularitySet::forward, SingularitySet::cspace_singular}) {
    SCOPED_TRACE(to_string(set));
    const System system = test::set_of(m.mechanism, set);
    const Cover crossing = test::answer_to(m.mechanism, set);
    EXPECT_TRUE(crossing.complete());
    EXPECT_EQ(crossing.count(Verdict::exact), 2u);
    EXPECT_EQ(crossing.boxes.size(), 2u);
    EXPECT_EQ(test::lost(system, crossing, crossings), 0u);
  }
}

// D = (4, 0), G = (9, −1); a four-bar A B C D, then D E F G with E across D C.
TEST(Watt, HasTheSingularitiesOfItsTwoFourBars) {
  const double a = 3, b = 4, c = 2.5, e = 3, f = 4, g = 3;
  const Point first{0, 0}, middle{4, 0}, last{9, -1};
  const auto place = [&](Point tip, double phi, Point end) -> Configuration {
    const Point joint = middle + c * test::direction(phi), corner = middle + e * test::direction(phi + M_PI / 2);
    return {{"theta", angle_of(tip)},
            {"phi_coupler", angle_of(joint - tip)},
            {"phi", phi},
            {"phi_second", angle_of(end - corner)},
            {"psi", angle_of(end - last)}};
  };
  // The ternary link's angle given, and one of the four-bars' joints, where it is known; else both.
  const auto close = [&](double phi, const Point* tip, const Point* end, Places& places) {
    const Point joint = middle + c * test::direction(phi), corner = middle + e * test::direction(phi + M_PI / 2);
    for (const int sign : {-1, 1}) {
      const auto other =
          tip ? test::intersect_circles(corner, f, last, g, sign) : test::intersect_circles(first, a, joint, b, sign);
      if (other) places.push_back(tip ? place(*tip, phi, *other) : place(*other, phi, *end));
    }
  };
  Places forward, inverse;
  for (const int sign : {-1, 1}) {
    for (const double reach : {b + c, b - c})
      if (const auto tip = test::intersect_circles(first, a, middle, reach, sign)) {
        const Point joint = *tip + (b / reach) * (middle - *tip);
        close(angle_of(joint - middle), &*tip, nullptr, forward);
      }
    for (const double reach : {f + g, f - g})
      if (const auto corner = test::intersect_circles(middle, e, last, reach, sign)) {
        const Point end = *corner + (f / reach) * (last - *corner);
        close(angle_of(*corner - middle) - M_PI / 2, nullptr, &end, forward);
      }
    for (const double reach : {a + b, a - b})
      if (const auto joint = test::intersect_circles(first, std::fabs(reach), middle, c, sign)) {
        const Point tip = (a / reach) * *joint;
        close(angle_of(*joint - middle), &tip, nullptr, inverse);
      }
    for (const double reach : {e + f, e - f})
      if (const auto end = test::intersect_circles(middle, std::fabs(reach), last, g, sign)) {
        const Point corner = middle + (e / reach) * (*end - middle);
        close(angle_of(corner - middle) - M_PI / 2, nullptr, &*end, inverse);
      }
  }
  EXPECT_GE(forward.size(), 2u);
  EXPECT_GE(inverse.size(), 2u);
  const study::Model m = test::planar_model("watt");
  expect_points(m, SingularitySet::forward, forward);
  expect_points(m, SingularitySet::inverse, inverse);
}

TEST(Stephenson, HasTheSingularitiesOfItsLoops) {
  const Loops loops{{"theta", "phi_coupler", "phi", "phi_link", "psi"},
                    {},
                    {{{2, 0}, {4.5, 1}, {-3, 2}, {-5}},                     // A B C D
                     {{2, 0}, {{2, 3}, 1}, {4, 3}, {-3, 4}, {{-4, -7}}}}};  // A B P F G
  const study::Model m = test::planar_model("stephenson");
  const Places forward = loops.singular("theta", 200), inverse = loops.singular("psi", 200);
  EXPECT_GE(forward.size(), 2u);
  EXPECT_GE(inverse.size(), 2u);
  expect_points(m, SingularitySet::forward, forward);
  expect_points(m, SingularitySet::inverse, inverse);
}

TEST(DoubleButterfly, HasTheSingularitiesOfItsLoops) {
  const Loops loops{{"theta", "psi", "phi_right", "phi_left", "phi_bar2", "phi_bar3", "phi_bar4"},
                    {},
                    {
                        // K by C, by F, by H and by M
                        {{4}, {6, 0}, {{-4, 1}, 2}, {{-2, -2}, 1}, {-3.5, 4}, {{2, -2}, 2}},
                        {{4}, {6, 0}, {{-4, 1}, 2}, {{1, -3}, 1}, {-3, 5}, {{-2, -1}, 3}},
                        {{4}, {6, 0}, {{-4, 1}, 2}, {5}, {-6, 6}, {{-4, -1}, 3}},
                    }};
  const study::Model m = test::planar_model("double_butterfly");
  const Places forward = loops.singular("theta", 300);
  EXPECT_GE(forward.size(), 2u);
  expect_points(m, SingularitySet::forward, forward);
}

// The same in Cartesian coordinates, as a plain list of distances: |O P| |O Q| = 21, so Q stands at x = 21/5 with
// y_Q = 21 tan(θ)/5 for P in the direction θ, whose rate is 0 nowhere. The kernel has seven unknowns, of whose directions
// a search knows nothing before the points are narrow.
TEST(Peaucellier, InCartesianCoordinatesIsStoppedNowhereByItsOutput) {
  const study::Model model = study::parse_model({
      R"([SYSTEM VARS]
a_x : [-5, 5]
a_y : [-5, 5]
b_x : [-5, 5]
b_y : [-5, 5]
p_x : [-7, 7]
p_y : [-7, 7]
q_x : [-7, 7]
q_y : [-7, 7]
[SYSTEM EQS]
a_x^2 + a_y^2 = 25;
b_x^2 + b_y^2 = 25;
(a_x - p_x)^2 + (a_y - p_y)^2 = 4;
(b_x - p_x)^2 + (b_y - p_y)^2 = 4;
(a_x - q_x)^2 + (a_y - q_y)^2 = 4;
(b_x - q_x)^2 + (b_y - q_y)^2 = 4;
(p_x - 5/2)^2 + p_y^2 = 25/4;
(a_x - b_x)^2 + (a_y - b_y)^2 >= 1/4;
(p_x - q_x)^2 + (p_y - q_y)^2 >= 1/4;
[INPUTS] p_y
[OUTPUTS] q_y
)",
      "inversor.cuik"});
  solve::Options options;
  options.max_boxes = 100000;
  const Cover cover = solve::solve(test::set_of(model.mechanism, SingularitySet::inverse), options);
  EXPECT_TRUE(cover.complete());
  EXPECT_TRUE(cover.boxes.empty());
}

// |O B| |O P| = m² − s²: P runs on a straight line.
TEST(Peaucellier, GuidesItsPointAlongALine) {
  constexpr double k = 1, m = 3, s = 1.5, kSigma = 0.05;
  const study::Model model = test::planar_model("peaucellier");
  const System system = test::set_of(model.mechanism, SingularitySet::cspace);
  const Cover cover = test::cover_of(system, kSigma, kSigma);
  EXPECT_TRUE(cover.complete());
  EXPECT_EQ(cover.dimension, 1);
  Places samples;
  for (int i = 0; i < 2000; ++i) {
    const double theta = 2 * M_PI * i / 2000;
    const Point b = Point{k, 0} + k * test::direction(theta);
    const auto c = test::intersect_circles({0, 0}, m, b, s, 1), d = test::intersect_circles({0, 0}, m, b, s, -1);
    if (!c || !d) continue;
    const double opening = angle_of(*c) - angle_of(*d);
    if (opening < 0.1) continue;
    const Point p = *c + *d - b;
    EXPECT_NEAR(p.x, (m * m - s * s) / (2 * k), 1e-9);
    samples.push_back({{"theta", theta},
                       {"psi", angle_of(*c)},
                       {"phi_OD", angle_of(*d)},
                       {"phi_BC", angle_of(*c - b)},
                       {"phi_BD", angle_of(*d - b)},
                       {"phi_PC", angle_of(*c - p)},
                       {"phi_PD", angle_of(*d - p)}});
  }
  EXPECT_GT(samples.size(), 500u);
  EXPECT_EQ(test::lost(system, cover, samples), 0u);
  const auto at = [&](const CoverBox& box, const char* name) {
    return box.box[static_cast<std::size_t>(system.find(name))].mid();
  };
  for (const CoverBox& b : cover.boxes) {
    EXPECT_TRUE(b.verdict == Verdict::regular || b.verdict == Verdict::boundary);
    EXPECT_NEAR(m * at(b, "c_psi") - s * at(b, "c_phi_PC"), (m * m - s * s) / (2 * k), 4 * kSigma);
  }
  expect_points(model, SingularitySet::forward, {});
  // A, B, C in line.
  const Point a{k, 0}, c = m * test::direction(std::acos(5.0 / 8)), b = a + (k / (k + s)) * (c - a);
  const Point d = *test::intersect_circles({0, 0}, m, b, s, -1), p = c + d - b;
  expect_points(model, SingularitySet::inverse,
                {{{"theta", angle_of(b - a)},
                  {"psi", angle_of(c)},
                  {"phi_OD", angle_of(d)},
                  {"phi_BC", angle_of(c - b)},
                  {"phi_BD", angle_of(d - b)},
                  {"phi_PC", angle_of(c - p)},
                  {"phi_PD", angle_of(d - p)}}});
}

}  // namespace
}  // namespace corank
