// The planar 3-RRR against its geometry: a configuration is a forward singularity exactly where the lines B_i C_i of the
// three links at the platform meet in one point or are parallel (Bonev2003).
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <ostream>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include "corank/solve/search/solve.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/symbolic/writing/printer.h"
#include "corank/tests/cover_lookup.h"
#include "corank/tests/models/closed_forms.h"
#include "corank/tests/models/given_rates.h"
#include "corank/tests/seeds.h"

namespace corank {
namespace {
using symbolic::SingularitySet;
using test::Point;

// As in the model files.
constexpr double kBase = 2, kPlatform = 0.5, kLink1 = 1, kLink2 = 1;

const std::array<Point, 3> kBaseJoints{Point{0, 0}, Point{kBase, 0}, Point{kBase / 2, kBase* std::sqrt(3) / 2}};

// In the order of the algebrized model: x, y, then cosine and sine of phi, theta1 … theta3, psi1 … psi3, then the kernel
// vector, the velocities of x, y, phi, psi1 … psi3 with the motors locked.
constexpr int kVariables = 22, kConfigurationSize = 16, kPhi = 2, kTheta1 = 4, kPsi1 = 10;
using Values = std::array<double, kVariables>;

std::array<Point, 3> platform_joints(Point c1, Point e_phi) {
  const Point e_3{0.5 * e_phi.x - std::sqrt(0.75) * e_phi.y, std::sqrt(0.75) * e_phi.x + 0.5 * e_phi.y};
  return {c1, c1 + kPlatform * e_phi, c1 + kPlatform * e_3};
}

// Row i: a unit force along B_i C_i and its moment about C_1.
std::array<std::array<double, 3>, 3> lines(const std::array<Point, 3>& c, const std::array<Point, 3>& u) {
  std::array<std::array<double, 3>, 3> rows{};
  for (std::size_t i = 0; i < 3; ++i) rows[i] = {u[i].x, u[i].y, cross(c[i] - c[0], u[i])};
  return rows;
}

std::array<double, 3> vector_product(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double scalar_product(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// 0 exactly where the lines meet in one point or are parallel.
double determinant(const std::array<std::array<double, 3>, 3>& rows) {
  return scalar_product(rows[0], vector_product(rows[1], rows[2]));
}

// C_1 and phi given, and for each leg the side of its elbow by a bit of the mode.
struct Posture {
  double phi;
  std::array<Point, 3> b, c;

  /// Nothing out of reach. One leg's elbow may be given, where it is stretched or folded.
  static std::optional<Posture> at(Point c1, double phi, int mode, std::size_t leg = 3, Point its_elbow = {}) {
    Posture q{phi, {}, platform_joints(c1, test::direction(phi))};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto elbow = i == leg ? std::optional(its_elbow)
                                  : test::intersect_circles(kBaseJoints[i], kLink1, q.c[i], kLink2, mode >> i & 1 ? 1 : -1);
      if (!elbow) return std::nullopt;
      q.b[i] = *elbow;
    }
    return q;
  }

  std::array<Point, 3> directions() const {
    std::array<Point, 3> u;
    for (std::size_t i = 0; i < 3; ++i) u[i] = (1 / kLink2) * (c[i] - b[i]);
    return u;
  }
  double determinant() const { return corank::determinant(lines(c, directions())); }

  std::array<double, kConfigurationSize> coordinates() const {
    std::array<double, kConfigurationSize> x{c[0].x, c[0].y, std::cos(phi), std::sin(phi)};
    const auto u = directions();
    for (std::size_t i = 0; i < 3; ++i) {
      const Point e = (1 / kLink1) * (b[i] - kBaseJoints[i]);
      x[kTheta1 + 2 * i] = e.x, x[kTheta1 + 2 * i + 1] = e.y;
      x[kPsi1 + 2 * i] = u[i].x, x[kPsi1 + 2 * i + 1] = u[i].y;
    }
    return x;
  }
};

// A forward singularity's coordinates and kernel vector, the latter up to its sign.
Values values(const Posture& q) {
  // The platform's twist does no work along any of the lines: orthogonal to two rows that are independent.
  const auto u = q.directions();
  const auto rows = lines(q.c, u);
  std::array<double, 3> twist{};
  for (const auto& [i, j] : {std::pair(0u, 1u), std::pair(1u, 2u), std::pair(2u, 0u)}) {
    const auto candidate = vector_product(rows[i], rows[j]);
    if (scalar_product(candidate, candidate) > scalar_product(twist, twist)) twist = candidate;
  }
  std::array<double, kVariables - kConfigurationSize> xi{twist[0], twist[1], twist[2]};
  for (std::size_t i = 0; i < 3; ++i) {
    const Point arm = q.c[i] - q.c[0], velocity{twist[0] - twist[2] * arm.y, twist[1] + twist[2] * arm.x};
    xi[3 + i] = cross(u[i], velocity) / kLink2;
  }
  double square = 0;
  for (const double component : xi) square += component * component;
  Values x{};
  std::ranges::copy(q.coordinates(), x.begin());
  for (std::size_t i = 0; i < xi.size(); ++i) x[kConfigurationSize + i] = xi[i] / std::sqrt(square);
  return x;
}

// Singular configurations with orientation phi and C_1 on the segment from a to b, in all eight working modes: the sign
// changes of the determinant between `steps` equidistant points, bisected.
void add_samples(Point a, Point b, double phi, int steps, std::vector<Values>& samples) {
  for (int mode = 0; mode < 8; ++mode) {
    const auto at = [&](double t) { return Posture::at(a + t * (b - a), phi, mode); };
    auto before = at(0);
    for (int k = 1; k <= steps; ++k) {
      double from = (k - 1.0) / steps, to = static_cast<double>(k) / steps;
      const auto after = at(to);
      if (before && after && before->determinant() * after->determinant() < 0) {
        const bool rises = after->determinant() > 0;
        auto middle = before;
        for (int halving = 0; halving < 60 && middle; ++halving) {
          const double t = (from + to) / 2;
          middle = at(t);
          if (middle) (middle->determinant() > 0) == rises ? to = t : from = t;
        }
        // All of a segment between two points in reach, a disc for links alike, is in reach.
        EXPECT_TRUE(middle && std::fabs(middle->determinant()) < 1e-9) << mode << ' ' << k;
        if (middle) samples.push_back(values(*middle));
      }
      before = after;
    }
  }
}

bool holds(const test::CoverLookup& cover, Values x) {
  if (cover.holds(x, test::kSampleTolerance)) return true;
  for (std::size_t i = kConfigurationSize; i < kVariables; ++i) x[i] = -x[i];
  return cover.holds(x, test::kSampleTolerance);
}

void expect_holds_all(const Cover& cover, const std::vector<Values>& samples) {
  const test::CoverLookup lookup(cover);
  std::size_t lost = 0;
  for (const Values& x : samples) lost += !holds(lookup, x);
  EXPECT_EQ(lost, 0u) << "of " << samples.size() << " samples";
}

System forward(const char* model, const char* phi0 = nullptr) {
  auto mechanism = symbolic::read_model(std::string(CORANK_SOURCE_DIR "/models/") + model + ".cuik");
  if (phi0) mechanism.set_constant("phi0", symbolic::Expression(phi0));
  return symbolic::algebrize(symbolic::singularity_system(mechanism, SingularitySet::forward));
}

Cover solve_3rrr_at(const System& system, double sigma, std::uint64_t max_boxes = 0) {
  solve::Options options;
  options.sigma = sigma;
  options.threads = max_boxes > 0 ? 1 : 0;
  options.max_boxes = max_boxes;
  return solve::solve(system, options);
}

bool is_proven(const CoverBox& b) { return b.verdict == Verdict::regular || b.verdict == Verdict::boundary; }

Point middle(const Box& box, std::size_t first) { return {box[first].mid(), box[first + 1].mid()}; }

TEST(Planar3Rrr, HasTheVariablesThatTheGeometryAssumes) {
  for (const char* model : {"3rrr", "3rrr_fixed_orientation"}) {
    std::vector<std::string> names;
    for (const auto& v : forward(model).variables) names.push_back(v.name);
    EXPECT_EQ(names, (std::vector<std::string>{"x",        "y",        "c_phi",    "s_phi",    "c_theta1", "s_theta1",
                                               "c_theta2", "s_theta2", "c_theta3", "s_theta3", "c_psi1",   "s_psi1",
                                               "c_psi2",   "s_psi2",   "c_psi3",   "s_psi3",   "xi1",      "xi2",
                                               "xi3",      "xi4",      "xi5",      "xi6"}));
  }
}

struct Orientation {
  const char* text;
  double phi;
  friend void PrintTo(const Orientation& o, std::ostream* out) { *out << "phi = " << o.text; }
};

class FixedOrientation : public testing::TestWithParam<std::tuple<Orientation, double>> {};

TEST_P(FixedOrientation, HasItsForwardSingularitiesWhereThreeLinesMeet) {
  const auto [orientation, sigma] = GetParam();
  const Cover cover = solve_3rrr_at(forward("3rrr_fixed_orientation", orientation.text), sigma);
  EXPECT_TRUE(cover.complete());
  EXPECT_EQ(cover.dimension, 1);
  EXPECT_LE(test::widest_edge(cover, 12), sigma);

  std::vector<Values> samples;
  constexpr int kLines = 100, kSteps = 200;
  for (int k = 0; k < kLines; ++k) {
    const double at = -2 + 4 * (k + 0.37) / kLines;
    add_samples({-2, at}, {2, at}, orientation.phi, kSteps, samples);
    add_samples({at, -2}, {at, 2}, orientation.phi, kSteps, samples);
  }
  EXPECT_GT(samples.size(), 1000u);
  expect_holds_all(cover, samples);

  // A proven box has a solution at most σ/2 away in each coordinate. The determinant is multilinear in rows of length ≤
  // √1.25, each off by at most √1.25·σ/√2.
  const double most = 3 * std::pow(1.25, 1.5) * std::sqrt(0.5) * sigma * (1 + sigma);
  std::size_t turning = 0;
  for (const auto& b : cover.boxes) {
    ASSERT_TRUE(is_proven(b));
    ASSERT_EQ(b.free.size(), 1u);
    const auto c = platform_joints(middle(b.box, 0), middle(b.box, kPhi));
    const std::array<Point, 3> u{middle(b.box, kPsi1), middle(b.box, kPsi1 + 2), middle(b.box, kPsi1 + 4)};
    ASSERT_LE(std::fabs(determinant(lines(c, u))), most);
    turning += !b.box[kConfigurationSize + 2].contains_zero();
  }
  // The platform turns about the point where the lines meet: its orientation is fixed in the set, not in the velocities.
  EXPECT_GE(static_cast<double>(turning), 0.9 * static_cast<double>(cover.boxes.size()));
  EXPECT_GE(static_cast<double>(cover.count(Verdict::regular)), 0.9 * static_cast<double>(cover.boxes.size()));
}

INSTANTIATE_TEST_SUITE_P(Planar3Rrr, FixedOrientation,
                         testing::Combine(testing::Values(Orientation{"pi/10", M_PI / 10}, Orientation{"0", 0}),
                                          testing::Values(0.1, 0.01)));

// By three screws: six rates in place of nine, no passive one.
TEST(Planar3Rrr, HasTheSameSingularitiesByTheScrewsOfItsLegs) {
  constexpr double kSigma = 0.05;
  const auto m = test::with_rates("3rrr_fixed_orientation", test::kLegScrews);
  const Cover cover = solve_3rrr_at(test::study_system(m, SingularitySet::forward), kSigma);
  EXPECT_TRUE(cover.complete());
  std::vector<Values> samples;
  constexpr int kLines = 200, kSteps = 200;
  for (int k = 0; k < kLines; ++k) {
    const double at = -2 + 4 * (k + 0.37) / kLines;
    add_samples({-2, at}, {2, at}, M_PI / 10, kSteps, samples);
    add_samples({at, -2}, {at, 2}, M_PI / 10, kSteps, samples);
  }
  EXPECT_GT(samples.size(), 2000u);
  const test::CoverLookup lookup(cover);
  std::size_t lost = 0;
  for (const Values& x : samples) {
    std::array<double, kConfigurationSize> q{};
    std::copy_n(x.begin(), q.size(), q.begin());
    lost += !lookup.holds(q, test::kSampleTolerance);
  }
  EXPECT_EQ(lost, 0u) << "of " << samples.size() << " samples";
  const double most = 3 * std::pow(1.25, 1.5) * std::sqrt(0.5) * kSigma * (1 + kSigma);
  for (const auto& b : cover.boxes) {
    ASSERT_TRUE(is_proven(b));
    const auto c = platform_joints(middle(b.box, 0), middle(b.box, kPhi));
    const std::array<Point, 3> u{middle(b.box, kPsi1), middle(b.box, kPsi1 + 2), middle(b.box, kPsi1 + 4)};
    ASSERT_LE(std::fabs(determinant(lines(c, u))), most);
  }

  const Cover inverse = solve_3rrr_at(test::study_system(m, SingularitySet::inverse), kSigma),
              derived = solve_3rrr_at(
                  test::study_system(symbolic::read_model(CORANK_SOURCE_DIR "/models/3rrr_fixed_orientation.cuik"),
                                     SingularitySet::inverse),
                  kSigma);
  EXPECT_TRUE(inverse.complete());
  for (const auto& [from, to] : {std::pair(&inverse, &derived), std::pair(&derived, &inverse)}) {
    const test::CoverLookup other(*to);
    for (const auto& b : from->boxes) {
      if (!is_proven(b)) continue;
      std::array<double, kConfigurationSize> q{};
      for (std::size_t j = 0; j < q.size(); ++j) q[j] = b.box[j].mid();
      ASSERT_TRUE(other.holds(q, kSigma));
    }
  }
}

TEST(Planar3Rrr, WithAFixedOrientationHasItsInverseSingularitiesWhereALegIsStretchedOrFolded) {
  constexpr double kSigma = 0.2;
  const auto mechanism = symbolic::read_model(CORANK_SOURCE_DIR "/models/3rrr_fixed_orientation.cuik");
  const Cover cover =
      solve_3rrr_at(symbolic::algebrize(symbolic::singularity_system(mechanism, SingularitySet::inverse)), kSigma);
  EXPECT_TRUE(cover.complete());
  EXPECT_EQ(cover.dimension, 1);
  for (const auto& b : cover.boxes) {
    int aligned = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Point e = middle(b.box, kTheta1 + 2 * i), u = middle(b.box, kPsi1 + 2 * i);
      aligned += std::fabs(cross(e, u)) <= std::sqrt(2) * kSigma * (1 + kSigma);
    }
    ASSERT_GE(aligned, is_proven(b) ? 1 : 2) << "only where two legs are aligned at once may a box be undecided";
  }

  const test::CoverLookup lookup(cover);
  const int kSteps = test::long_run() ? 500 : 150;
  const auto offsets = platform_joints({0, 0}, test::direction(M_PI / 10));
  std::size_t samples = 0, lost = 0;
  for (std::size_t leg = 0; leg < 3; ++leg)
    for (int k = 0; k < kSteps; ++k)
      for (const double reach : {kLink1 + kLink2, kLink1 - kLink2})
        for (int mode = 0; mode < 8; ++mode) {
          const Point e = test::direction(0.01 + 2 * M_PI * k / kSteps), c1 = kBaseJoints[leg] + reach * e - offsets[leg];
          const auto q = Posture::at(c1, M_PI / 10, mode, leg, kBaseJoints[leg] + kLink1 * e);
          if (!q) continue;
          ++samples;
          lost += !lookup.holds(q->coordinates(), test::kSampleTolerance);
        }
  EXPECT_GT(samples, 10u * static_cast<unsigned>(kSteps));
  EXPECT_EQ(lost, 0u) << "of " << samples << " samples";
}

TEST(Planar3Rrr, WithAFixedOrientationGivesTheSameBoxesFromItsAlgebrizedFile) {
  const auto system = forward("3rrr_fixed_orientation");
  auto again = symbolic::algebrize(symbolic::plain_system(symbolic::parse_model(symbolic::to_cuik(system), "derived.cuik")));
  // Of a plain system sigma concerns every variable.
  for (std::size_t v = 0; v < system.variables.size(); ++v) again.variables[v].kind = system.variables[v].kind;
  const Cover direct = solve_3rrr_at(system, 0.2), derived = solve_3rrr_at(again, 0.2);
  ASSERT_EQ(direct.boxes.size(), derived.boxes.size());
  for (std::size_t k = 0; k < direct.boxes.size(); ++k) {
    ASSERT_EQ(direct.boxes[k].box, derived.boxes[k].box);
    ASSERT_EQ(direct.boxes[k].verdict, derived.boxes[k].verdict);
  }
}

TEST(Planar3Rrr, LosesNoForwardSingularityWhenALimitEndsTheSearch) {
  const Cover cover = solve_3rrr_at(forward("3rrr"), 0.4, 5000);
  EXPECT_FALSE(cover.complete());
  EXPECT_EQ(cover.dimension, 2);
  EXPECT_GT(cover.count(Verdict::regular), 20u);
  std::vector<Values> samples;
  std::mt19937_64 random(20260);
  std::uniform_real_distribution<double> angle(-M_PI, M_PI), place(-2, 2);
  for (int k = 0; k < 300; ++k) {
    const double phi = angle(random);
    const Point from{place(random), place(random)}, to{place(random), place(random)};
    add_samples(from, to, phi, 50, samples);
  }
  EXPECT_GT(samples.size(), 500u);
  expect_holds_all(cover, samples);
}

}  // namespace
}  // namespace corank
