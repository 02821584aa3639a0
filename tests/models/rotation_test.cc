// A robot whose output is a rotation matrix R, all nine entries tied by seven equations: a platform on a universal joint
// (its y axis b stays at a right angle to the fixed x axis), tilted by two legs that see its axes a and b. With p1 = (cos
// t1, 0, sin t1) and p2 = (0, cos t2, sin t2): b_x = 0, a·p1 = 1/2, b·p2 = 1/3.
//   inverse: a·p1' = 0 or b·p2' = 0; since b is a unit vector in the plane of p2, the second is never
//   forward: an angular velocity ω ≠ 0 with ω·(b × e_x) = ω·(a × p1) = ω·(b × p2) = 0, so their determinant is 0
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "corank/core/rounding.h"
#include "corank/solve/search/solve.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/tests/cover_lookup.h"

namespace corank {
namespace {
using symbolic::SingularitySet;
template <class T>
using Vector = std::array<T, 3>;
using RotationConfiguration = std::array<double, 13>;  // R row by row, c1, s1, c2, s2

constexpr const char* kModel = R"(
[SYSTEM VARS]
R @ rotation
t1 ~
t2 ~
[SYSTEM EQS]
R_xy = 0;
R_xx*cos(t1) + R_zx*sin(t1) = 1/2;
R_yy*cos(t2) + R_zy*sin(t2) = 1/3;
[INPUTS] t1, t2
[OUTPUTS] R
)";

System system_of(SingularitySet set) {
  return symbolic::algebrize(symbolic::singularity_system(symbolic::parse_model(kModel, "platform.cuik"), set));
}

Cover solve_at(SingularitySet set, double sigma) {
  solve::Options options;
  options.sigma = sigma;
  return solve::solve(system_of(set), options);
}

template <class T>
T dot(const Vector<T>& a, const Vector<T>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class T>
Vector<T> cross(const Vector<T>& a, const Vector<T>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

template <class T>
T forward_determinant(const Vector<T>& a, const Vector<T>& b, const Vector<T>& p1, const Vector<T>& p2) {
  return dot(cross(b, Vector<T>{1.0, 0.0, 0.0}), cross(cross(a, p1), cross(b, p2)));
}

/// b = (0, cos φ, sin φ), a at the angle ψ from e_x about b; the legs' two ways each.
struct Parameters {
  double phi, psi;
  int leg1, leg2;
};

struct Platform {
  Vector<double> a, b, p1, p2;
  double reach;  ///< of leg 1: it can hold a where this is at least 1/2

  explicit Platform(const Parameters& q) {
    a = {std::cos(q.psi), -std::sin(q.psi) * std::sin(q.phi), std::sin(q.psi) * std::cos(q.phi)};
    b = {0, std::cos(q.phi), std::sin(q.phi)};
    reach = std::hypot(a[0], a[2]);
    const double t1 = std::atan2(a[2], a[0]) + q.leg1 * std::acos(std::min(1.0, 0.5 / reach)),
                 t2 = q.phi + q.leg2 * std::acos(1.0 / 3);
    p1 = {std::cos(t1), 0, std::sin(t1)};
    p2 = {0, std::cos(t2), std::sin(t2)};
  }
  RotationConfiguration configuration() const {
    const Vector<double> c = cross(a, b);
    return {a[0], b[0], c[0], a[1], b[1], c[1], a[2], b[2], c[2], p1[0], p1[2], p2[1], p2[2]};
  }
  double determinant() const { return forward_determinant(a, b, p1, p2); }
};

std::vector<RotationConfiguration> inverse_samples() {
  std::vector<RotationConfiguration> samples;
  for (int i = 0; i < 500; ++i)
    for (const double side : {-1.0, 1.0})
      for (const double sign : {-1.0, 1.0})
        for (const int leg2 : {-1, 1}) {
          const double t = 0.01 + 2 * M_PI * i / 500;
          const Vector<double> a = {0.5 * std::cos(t), side * std::sqrt(0.75), 0.5 * std::sin(t)};
          const double norm = std::hypot(a[1], a[2]), phi = std::atan2(sign * a[1] / norm, -sign * a[2] / norm);
          Platform p({phi, 0, 1, leg2});
          p.a = a, p.p1 = {std::cos(t), 0, std::sin(t)};
          samples.push_back(p.configuration());
        }
  return samples;
}

// Zeros of the determinant along lines of constant φ, by bisection.
std::vector<RotationConfiguration> forward_samples() {
  std::vector<RotationConfiguration> samples;
  constexpr int kSteps = 400;
  for (int i = 0; i < 200; ++i)
    for (int k = 0; k < kSteps; ++k)
      for (const int leg1 : {-1, 1})
        for (const int leg2 : {-1, 1}) {
          Parameters low{0.01 + 2 * M_PI * i / 200, 2 * M_PI * k / kSteps, leg1, leg2}, high = low;
          high.psi += 2 * M_PI / kSteps;
          if (Platform(low).reach < 0.5 || Platform(high).reach < 0.5) continue;
          if (!(Platform(low).determinant() * Platform(high).determinant() < 0)) continue;
          for (int step = 0; step < 60; ++step) {
            Parameters middle = low;
            middle.psi = 0.5 * (low.psi + high.psi);
            (Platform(low).determinant() * Platform(middle).determinant() <= 0 ? high : low) = middle;
          }
          if (std::fabs(Platform(low).determinant()) < 1e-9) samples.push_back(Platform(low).configuration());
        }
  return samples;
}

void expect_holds_all(const Cover& cover, const std::vector<RotationConfiguration>& samples) {
  ASSERT_GT(samples.size(), 500u);
  const test::CoverLookup lookup(cover);
  std::size_t lost = 0;
  for (const RotationConfiguration& q : samples) lost += !lookup.holds(q, 1e-7);
  EXPECT_EQ(lost, 0u) << "of " << samples.size() << " samples";
}

struct Axes {
  Vector<Interval> a, b, p1, p2;
  explicit Axes(const Box& x)
      : a{x[0], x[3], x[6]}, b{x[1], x[4], x[7]}, p1{x[9], Interval(), x[10]}, p2{Interval(), x[11], x[12]} {}
};

TEST(RotationOutput, HasTheInverseSingularitiesOfItsClosedForm) {
  const Cover cover = solve_at(SingularitySet::inverse, 0.05);
  EXPECT_TRUE(cover.complete());
  EXPECT_EQ(cover.dimension, 1);
  EXPECT_EQ(cover.count(Verdict::regular), cover.boxes.size()) << "that |R_ij| <= 1 is implied";
  expect_holds_all(cover, inverse_samples());
  const UpwardRounding rounding;
  for (const auto& box : cover.boxes) {
    const Axes x(box.box);
    ASSERT_TRUE((x.a[2] * x.p1[0] - x.a[0] * x.p1[2]).contains_zero());
  }
}

TEST(RotationOutput, HasTheForwardSingularitiesOfItsDeterminant) {
  const Cover cover = solve_at(SingularitySet::forward, 0.05);
  EXPECT_TRUE(cover.complete());
  EXPECT_EQ(cover.dimension, 1);
  EXPECT_EQ(cover.count(Verdict::undecided), 0u);
  expect_holds_all(cover, forward_samples());
  const UpwardRounding rounding;
  for (const auto& box : cover.boxes) {
    const Axes x(box.box);
    ASSERT_TRUE(forward_determinant(x.a, x.b, x.p1, x.p2).contains_zero());
  }
}

TEST(RotationOutput, HasASmoothCspace) { EXPECT_TRUE(solve_at(SingularitySet::cspace_singular, 0.1).boxes.empty()); }

}  // namespace
}  // namespace corank
