// Mechanisms whose self-motions, or larger sets, are known in closed form: slider-crank, parallelogram, 3-RPR and
// Griffis-Duffy platform, Bennett linkage.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "corank/check/checker.h"
#include "corank/solve/exactness/exactness.h"
#include "corank/solve/search/solve.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/symbolic/sets/singularity_system.h"
#include "corank/tests/models/exactly_solved.h"

namespace corank {
namespace {
using symbolic::SingularitySet;
using test::exactly_solved;
using test::holds;

System system_of_text(const std::string& text, SingularitySet set) {
  return symbolic::algebrize(symbolic::singularity_system(symbolic::parse_model(text, "model.cuik"), set));
}
System plain(const std::string& text) {
  return symbolic::algebrize(symbolic::plain_system(symbolic::parse_model(text, "model.cuik")));
}

Cover solved_with_proof(const System& system) {
  solve::Options options;
  options.proof = system.coefficient_tolerance == 0;
  return exactly_solved(system, options);
}

template <class Choose>
bool covered(const Cover& cover, const std::vector<double>& q, Choose choose) {
  return std::any_of(cover.boxes.begin(), cover.boxes.end(), [&](const CoverBox& b) { return choose(b) && holds(b, q); });
}
bool covered(const Cover& cover, const std::vector<double>& q) {
  return covered(cover, q, [](const CoverBox&) { return true; });
}
const auto on_a_motion = [](const CoverBox& b) { return b.motion >= 0; };

void expect_consistent(const System& system, const Cover& cover) {
  const auto report = check::check(system, cover);
  EXPECT_TRUE(report.consistent()) << (report.failures.empty() ? "" : report.failures[0].reason);
  EXPECT_EQ(report.proof.verified, system.coefficient_tolerance == 0 && cover.complete());
}

// Crank and rod of one length: where the slider stands over the crank's axis the rod lies on the crank, and both turn.
const std::string kSliderCrank = R"(
[CONSTANTS]
r := 1
[SYSTEM VARS]
t1 ~ [-pi, pi]
t2 ~ [-pi, pi]
x : [-3, 3]
[SYSTEM EQS]
x = r*cos(t1) + r*cos(t2);
0 = r*sin(t1) + r*sin(t2);
[INPUTS] t1
[OUTPUTS] x
)";

TEST(SliderCrankWithEqualBars, TurnsFreelyWithItsSliderLocked) {
  const System system = system_of_text(kSliderCrank, SingularitySet::inverse);
  const Cover cover = solved_with_proof(system);
  EXPECT_TRUE(cover.complete());
  EXPECT_EQ(cover.count(Verdict::undecided), 0u);
  ASSERT_EQ(cover.self_motions.size(), 1u);
  EXPECT_EQ(cover.self_motions[0].dimension, 1);
  EXPECT_EQ(cover.points.size(), 2u) << "both bars stretched, to the right and to the left";
  EXPECT_EQ(cover.count(Verdict::isolated), 2u);
  for (const double end : {2.0, -2.0}) EXPECT_TRUE(covered(cover, {end / 2, 0, end / 2, 0, end}));
  for (int k = 0; k <= 400;
       ++k) {  // t1 = 0, where the sine is the one that is free, and pi/2, where pieces of C-space cross, included
    const double t = -std::numbers::pi + 2 * std::numbers::pi * k / 400;
    EXPECT_TRUE(covered(cover, {std::cos(t), std::sin(t), -std::cos(t), -std::sin(t), 0}, on_a_motion)) << t;
  }
  expect_consistent(system, cover);
}

TEST(SliderCrankWithEqualBars, IsNotVerifiedWithAChangedRelation) {
  const System system = system_of_text(kSliderCrank, SingularitySet::inverse);
  const Cover good = solved_with_proof(system);
  ASSERT_EQ(good.self_motions.size(), 1u);
  for (std::size_t k = 0; k < good.self_motions[0].relations.size(); ++k) {
    Cover changed = good;
    Monomial& m = changed.self_motions[0].relations[k].monomials[0];
    m = Monomial(-m.coefficient, m.factors);
    EXPECT_FALSE(check::check(system, changed).consistent()) << k;
    changed = good;
    changed.self_motions[0].relations[k].monomials.emplace_back(ExactNumber(1), std::vector<Factor>{});
    EXPECT_FALSE(check::check(system, changed).consistent()) << k;
  }
}

TEST(SliderCrankWithEqualBars, HasTwoForwardSingularities) {
  const Cover cover = solved_with_proof(system_of_text(kSliderCrank, SingularitySet::forward));
  EXPECT_TRUE(cover.complete());
  EXPECT_EQ(cover.boxes.size(), 2u);
  EXPECT_EQ(cover.count(Verdict::exact), 2u);
  for (const double side : {1.0, -1.0}) EXPECT_TRUE(covered(cover, {0, side, 0, -side, 0}));
}

// Opposite bars of equal lengths 1 and 2. Two modes: the parallelogram, t3 = t1 and t2 = 0, and the crossed one, whose joint
// C is the parallelogram's reflected in the line through the ends of the crank and the ground.
const std::string kParallelogram = R"(
[SYSTEM VARS]
t1 ~ [-pi, pi]
t2 ~ [-pi, pi]
t3 ~ [-pi, pi]
[SYSTEM EQS]
cos(t1) + 2*cos(t2) = 2 + cos(t3);
sin(t1) + 2*sin(t2) = sin(t3);
[INPUTS] t1
[OUTPUTS] t3
)";

TEST(ParallelogramFourBar, MovesInBothItsModes) {
  const System system = system_of_text(kParallelogram, SingularitySet::cspace);
  const Cover cover = solved_with_proof(system);
  EXPECT_TRUE(cover.complete());
  EXPECT_TRUE(cover.self_motions.empty()) << "a curve is what is expected";
  for (int k = 0; k < 400; ++k) {
    const double t = -std::numbers::pi + 2 * std::numbers::pi * k / 400, c = std::cos(t), s = std::sin(t);
    EXPECT_TRUE(covered(cover, {c, s, 1, 0, c, s})) << t;
    // B = (c, s), D = (2, 0), C0 = B + (2, 0).
    const double dx = 2 - c, dy = -s, along = 2 * (2 * dx) / (dx * dx + dy * dy);
    const double x = c + along * dx - 2, y = s + along * dy;
    EXPECT_TRUE(covered(cover, {c, s, (x - c) / 2, (y - s) / 2, x - 2, y})) << t;
  }
  for (const CoverBox& box : cover.boxes)
    if (box.verdict == Verdict::undecided) {
      EXPECT_TRUE(holds(box, {1, 0, 1, 0, 1, 0}) || holds(box, {-1, 0, 1, 0, -1, 0})) << "but where the modes meet";
    }
  expect_consistent(system, cover);
}

TEST(ParallelogramFourBar, IsSingularWhereItIsFlatAndNowhereElse) {
  for (const SingularitySet set : {SingularitySet::forward, SingularitySet::inverse}) {
    const Cover cover = solved_with_proof(system_of_text(kParallelogram, set));
    EXPECT_TRUE(cover.complete());
    EXPECT_EQ(cover.boxes.size(), 2u);
    EXPECT_EQ(cover.count(Verdict::exact), 2u);
    for (const double c : {1.0, -1.0}) EXPECT_TRUE(covered(cover, {c, 0, 1, 0, c, 0}));
  }
}

// A platform congruent to its base, on legs of one length: it keeps its orientation and moves on a circle.
std::string planar_platform(const std::string& third_leg, const std::string& more) {
  return R"(
[SYSTEM VARS]
x : [-3, 3]
y : [-3, 3]
phi ~ [-pi, pi]
)" + more +
         R"(
x^2 + y^2 = 4;
(x + cos(phi) - 1)^2 + (y + sin(phi))^2 = 4;
(x + 1/2*cos(phi) - sin(phi) - 1/2)^2 + (y + 1/2*sin(phi) + cos(phi) - 1)^2 = )" +
         third_leg + ";\n";
}

TEST(PlanarPlatform, MovesOnACircleThoughItsLegsAreLocked) {
  const System system = plain(planar_platform("4", "[SYSTEM EQS]"));
  const Cover cover = solved_with_proof(system);
  EXPECT_TRUE(cover.complete());
  EXPECT_EQ(cover.count(Verdict::regular), cover.boxes.size());
  ASSERT_EQ(cover.self_motions.size(), 1u);
  EXPECT_EQ(cover.self_motions[0].relations.size(), 2u) << "cos phi = 1, sin phi = 0";
  for (int k = 0; k < 300; ++k) {
    const double t = 2 * std::numbers::pi * k / 300;
    EXPECT_TRUE(covered(cover, {2 * std::cos(t), 2 * std::sin(t), 1, 0}, on_a_motion)) << t;
  }
  expect_consistent(system, cover);
}

TEST(PlanarPlatform, NamesEachSelfMotionOnce) {
  const System system = system_of_text(
      planar_platform("rho^2", "rho : [1, 3]\n[SYSTEM EQS]") + "[INPUTS] rho\n[OUTPUTS] phi\n", SingularitySet::forward);
  const Cover cover = solved_with_proof(system);
  EXPECT_TRUE(cover.complete());
  EXPECT_EQ(cover.count(Verdict::undecided), 0u);
  EXPECT_THAT(cover.points, testing::IsEmpty());
  EXPECT_EQ(cover.self_motions.size(), 2u) << "one for each sign of the kernel vector";
  for (int k = 0; k < 300; ++k) {
    const double t = 2 * std::numbers::pi * k / 300;
    EXPECT_TRUE(covered(cover, {2 * std::cos(t), 2 * std::sin(t), 1, 0, 2}, on_a_motion)) << t;
  }
  expect_consistent(system, cover);
}

// Griffis and Duffy's platform, the equilateral one: corners of one triangle on the other's midpoints, legs of one length
// √(13/4). Columns u, v of the rotation; py, uy, vx, vz are √3 times their values, so that all numbers are rational. U =
// p·u, V = √3 p·v, W = p·p.
std::string griffis_duffy() {
  std::string text = R"(
[SYSTEM VARS]
px : [-3, 3]
py : [-6, 6]
pz : [0, 3]
ux : [-1, 1]
uy : [-2, 2]
uz : [-1, 1]
vx : [-2, 2]
vy : [-1, 1]
vz : [-2, 2]
[DUMMY VARS]
U : [-10, 10]
V : [-20, 20]
W : [0, 20]
[SYSTEM EQS]
ux^2 + uy^2/3 + uz^2 = 1;
vx^2/3 + vy^2 + vz^2/3 = 1;
ux*vx + uy*vy + uz*vz = 0;
U = px*ux + py*uy/3 + pz*uz;
V = px*vx + py*vy + pz*vz;
W = px^2 + py^2/3 + pz^2;
)";
  constexpr std::array<std::array<const char*, 2>, 6> kCorners{
      {{"1", "0"}, {"1/2", "1/2"}, {"-1/2", "1/2"}, {"-1", "0"}, {"-1/2", "-1/2"}, {"1/2", "-1/2"}}};
  for (std::size_t i = 0; i < kCorners.size(); ++i) {
    const std::string x = kCorners[i][0], y = kCorners[i][1];  // y/√3
    const std::string a = i % 2 == 0 ? "1" : "1/2", b = i % 2 == 0 ? "1/2" : "1";
    const std::string ax = a + "*(" + x + ")", ay = a + "*(" + y + ")", bx = b + "*(" + x + ")", by = b + "*(" + y + ")";
    text += "W + 5/4 + 2*" + bx + "*U + 2*" + by + "*V - 2*" + ax + "*px - 2*" + ay + "*py - 2*" + ax + "*" + bx +
            "*ux - 2*" + ax + "*" + by + "*vx - 2*" + ay + "*" + bx + "*uy - 6*" + ay + "*" + by + "*vy = 13/4;\n";
  }
  return text;
}

TEST(GriffisDuffyPlatform, MovesThoughItsLegsAreLocked) {
  const System system = plain(griffis_duffy());
  EXPECT_EQ(system.equations.size(), system.variables.size());
  const Cover cover = solved_with_proof(system);
  EXPECT_TRUE(cover.complete());
  EXPECT_EQ(cover.dimension, 1) << "exact elimination finds that the legs' equations depend on each other";
  EXPECT_EQ(cover.count(Verdict::regular), cover.boxes.size());
  for (int k = 0; k < 300; ++k) {  // along its axis it turns by any angle psi: pz² = 2 + cos psi
    const double psi = 2 * std::numbers::pi * k / 300, c = std::cos(psi), s = std::sqrt(3) * std::sin(psi);
    EXPECT_TRUE(covered(cover, {0, 0, std::sqrt(2 + c), c, s, 0, -s, c, 0})) << psi;
  }
  expect_consistent(system, cover);
}

// Bennett's linkage by the directions of its axes: w1 = (0, 0, 1), w2 = (0, -4/5, 3/5), cos alpha = 3/5, cos beta = 5/13.
// With a/sin alpha = b/sin beta the bars close where (w1 - w3) x (w2 - w4) = 0: so w3 is w1 reflected in the plane across w2
// - w4, for every w4 on its cone.
const std::string kBennett = R"(
[SYSTEM VARS]
x3 : [-1, 1]
y3 : [-1, 1]
z3 : [-1, 1]
x4 : [-1, 1]
y4 : [-1, 1]
z4 : [-1, 1]
[SYSTEM EQS]
x3^2 + y3^2 + z3^2 = 1;
x4^2 + y4^2 + z4^2 = 1;
-4/5*y3 + 3/5*z3 = 5/13;
z4 = 5/13;
x3*x4 + y3*y4 + z3*z4 = 3/5;
-y3*(3/5 - z4) - (1 - z3)*(-4/5 - y4) = 0;
-(1 - z3)*x4 + x3*(3/5 - z4) = 0;
-x3*(-4/5 - y4) - y3*x4 = 0;
)";

std::vector<double> bennett(double t) {
  const double x = 12.0 / 13 * std::cos(t), y = 12.0 / 13 * std::sin(t), z = 5.0 / 13;
  const double dx = -x, dy = -0.8 - y, dz = 0.6 - z, mu = 2 * dz / (dx * dx + dy * dy + dz * dz);
  return {-mu * dx, -mu * dy, 1 - mu * dz, x, y, z};
}

TEST(BennettLinkage, IsALargerSetOfWhichNothingIsClaimedWhereItsEquationsAreExact) {
  const System system = system_of_text(kBennett + "[INPUTS] x4\n[OUTPUTS] x3\n", SingularitySet::cspace);
  const Cover cover = solved_with_proof(system);
  EXPECT_TRUE(cover.complete());
  EXPECT_EQ(cover.dimension, 0);
  EXPECT_EQ(cover.observed_dimension, 1);
  EXPECT_THAT(cover.points, testing::IsEmpty()) << "a curve is no point";
  EXPECT_THAT(cover.self_motions, testing::IsEmpty()) << "no linear relations hold on it that suffice";
  EXPECT_EQ(cover.count(Verdict::undecided), cover.boxes.size());
  EXPECT_LT(cover.statistics.processed, 10'000u);
  for (const CoverBox& box : cover.boxes) EXPECT_EQ(box.reason, Reason::degenerate_set);
  for (int k = 0; k < 300; ++k) EXPECT_TRUE(covered(cover, bennett(2 * std::numbers::pi * k / 300))) << k;
  expect_consistent(system, cover);
}

TEST(BennettLinkage, IsProvenAsACurveOfIndependentEquationsWithinATolerance) {
  System system = plain(kBennett);
  system.coefficient_tolerance = solve::printed_tolerance(system);
  const Cover cover = solve::solve(system);
  EXPECT_TRUE(cover.complete());
  EXPECT_EQ(cover.dimension, 1);
  EXPECT_EQ(cover.count(Verdict::partial), cover.boxes.size());
  for (int k = 0; k < 300; ++k) EXPECT_TRUE(covered(cover, bennett(2 * std::numbers::pi * k / 300))) << k;
}

TEST(BennettLinkage, IsProvenAsACurveByEquationsThatSuffice) {
  std::string text = kBennett;
  for (const char* line : {"x3*x4 + y3*y4", "-y3*(3/5",
                           "-(1 - z3)"}) {  // two of the directions' three conditions, and one bar, follow from the rest
    const auto at = text.find(line);
    text.erase(at, text.find('\n', at) + 1 - at);
  }
  const System system = system_of_text(text + "[INPUTS] x4\n[OUTPUTS] x3\n", SingularitySet::cspace);
  const Cover cover = solved_with_proof(system);
  EXPECT_TRUE(cover.complete());
  EXPECT_EQ(cover.count(Verdict::regular), cover.boxes.size());
  for (int k = 0; k < 300; ++k) EXPECT_TRUE(covered(cover, bennett(2 * std::numbers::pi * k / 300))) << k;
}

}  // namespace
}  // namespace corank
