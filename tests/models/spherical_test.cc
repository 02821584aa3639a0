// Spherical five-bars, whose outputs are three direction cosines tied by one equation, against their determinants in closed
// form: with a crank's end e1, e2 on each motor's axis n1 = z, n2 = x, forward det(e1, e2, w) = 0, inverse det(n1, e1,
// w)·det(n2, e2, w) = 0.
#include <gtest/gtest.h>

#include <array>
#include <cfenv>
#include <cmath>
#include <filesystem>

#include "corank/core/rounding.h"
#include "corank/solve/search/solve.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/tests/cover_lookup.h"
#include "corank/tests/models/given_rates.h"

namespace corank {
namespace {
using symbolic::KernelSide;
using symbolic::SingularitySet;

template <class T>
using Vector = std::array<T, 3>;
using SphericalConfiguration = std::array<double, 7>;  // c1, s1, c2, s2, w

constexpr int kSphericalSamples = 2000;

template <class T>
T determinant(const Vector<T>& a, const Vector<T>& b, const Vector<T>& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

Vector<double> operator+(const Vector<double>& a, const Vector<double>& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
Vector<double> operator*(double k, const Vector<double>& a) { return {k * a[0], k * a[1], k * a[2]}; }
double dot(const Vector<double>& a, const Vector<double>& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector<double> cross(const Vector<double>& a, const Vector<double>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

const Vector<double> kAxis1 = {0, 0, 1}, kAxis2 = {1, 0, 0};

/// The robot with cranks of angle alpha and links of angle delta.
struct Robot {
  std::filesystem::path file;
  double alpha, delta;
  std::array<int, 7> columns;  ///< of c1, s1, c2, s2, w among the model's variables
  const char* rates = "";      ///< a velocity equation of its own

  System system(SingularitySet set, std::optional<KernelSide> side = std::nullopt) const {
    if (*rates) return test::study_system(test::with_rates(file.stem().string(), rates), set, side);
    return symbolic::algebrize(symbolic::singularity_system(symbolic::read_model(file), set, side));
  }

  /// Crank ends for cosines and sines of the inputs.
  template <class T>
  std::array<Vector<T>, 2> ends(const std::array<T, 7>& q) const {
    const T c = std::cos(alpha), s = std::sin(alpha);
    return {Vector<T>{s * q[0], s * q[1], c}, Vector<T>{c, s * q[2], s * q[3]}};
  }
  template <class T>
  static Vector<T> pointing(const std::array<T, 7>& q) {
    return {q[4], q[5], q[6]};
  }

  /// In the order of the model's variables.
  SphericalConfiguration in_order(const Vector<double>& e1, const Vector<double>& e2, const Vector<double>& w) const {
    const double s = std::sin(alpha);
    const SphericalConfiguration q = {e1[0] / s, e1[1] / s, e2[1] / s, e2[2] / s, w[0], w[1], w[2]};
    SphericalConfiguration result{};
    for (std::size_t i = 0; i < q.size(); ++i) result[static_cast<std::size_t>(columns[i])] = q[i];
    return result;
  }

  std::vector<SphericalConfiguration> inverse_samples() const;
  std::vector<SphericalConfiguration> forward_samples() const;
};

Vector<double> unit(const Vector<double>& a) { return (1 / std::sqrt(dot(a, a))) * a; }

/// The unit vectors u with u·a = p, u·b = q.
std::vector<Vector<double>> meeting(const Vector<double>& a, double p, const Vector<double>& b, double q) {
  const double g = dot(a, b), d = 1 - g * g;
  if (d < 1e-12) return {};
  const Vector<double> base = ((p - q * g) / d) * a + ((q - p * g) / d) * b;
  const double rest = 1 - dot(base, base);
  if (rest < 0) return {};
  const Vector<double> n = std::sqrt(rest / d) * cross(a, b);
  return {base + n, base + (-1.0) * n};
}

std::vector<SphericalConfiguration> Robot::inverse_samples() const {
  std::vector<SphericalConfiguration> result;
  const double k = std::cos(delta), c = std::cos(alpha), s = std::sin(alpha);
  for (int i = 0; i < kSphericalSamples; ++i) {
    const double t = 0.01 + 2 * M_PI * i / kSphericalSamples;
    for (const double reach : {alpha + delta, alpha - delta}) {
      const Vector<double> e1 = {s * std::cos(t), s * std::sin(t), c}, e2 = {c, s * std::cos(t), s * std::sin(t)},
                           w1 = {std::sin(reach) * std::cos(t), std::sin(reach) * std::sin(t), std::cos(reach)},
                           w2 = {std::cos(reach), std::sin(reach) * std::cos(t), std::sin(reach) * std::sin(t)};
      for (const auto& other : meeting(w1, k, kAxis2, c)) result.push_back(in_order(e1, other, w1));
      for (const auto& other : meeting(w2, k, kAxis1, c)) result.push_back(in_order(other, e2, w2));
    }
  }
  return result;
}

std::vector<SphericalConfiguration> Robot::forward_samples() const {
  std::vector<SphericalConfiguration> result;
  const double c = std::cos(alpha), s = std::sin(alpha);
  // The ends are 2 delta apart, and w is between them.
  for (int i = 0; i < kSphericalSamples; ++i) {
    const double t = 0.01 + 2 * M_PI * i / kSphericalSamples;
    const Vector<double> e1 = {s * std::cos(t), s * std::sin(t), c};
    for (const auto& e2 : meeting(e1, std::cos(2 * delta), kAxis2, c)) result.push_back(in_order(e1, e2, unit(e1 + e2)));
  }
  // Or they meet, and w is anywhere about them.
  for (const auto& e : meeting(kAxis1, c, kAxis2, c)) {
    const Vector<double> u = unit(cross(e, kAxis1)), v = cross(e, u);
    for (int i = 0; i < kSphericalSamples; ++i) {
      const double t = 2 * M_PI * i / kSphericalSamples;
      const Vector<double> w = std::cos(delta) * e + std::sin(delta) * (std::cos(t) * u + std::sin(t) * v);
      result.push_back(in_order(e, e, w));
    }
  }
  return result;
}

// Which of the determinants may vanish in a box: forward, leg 1, leg 2.
std::array<bool, 3> may_vanish(const Robot& robot, const Box& box) {
  std::array<Interval, 7> q;
  for (std::size_t i = 0; i < q.size(); ++i) q[i] = box[static_cast<std::size_t>(robot.columns[i])];
  const auto [e1, e2] = robot.ends(q);
  const auto w = Robot::pointing(q);
  // Allow for the rounding of cos alpha and sin alpha.
  const auto near = [](const Interval& x) { return x.lo() <= 1e-12 && x.hi() >= -1e-12; };
  return {near(determinant(e1, e2, w)), near(determinant(Vector<Interval>{0.0, 0.0, 1.0}, e1, w)),
          near(determinant(Vector<Interval>{1.0, 0.0, 0.0}, e2, w))};
}

void expect_closed_forms(const Robot& robot, std::optional<KernelSide> side) {
  for (const SingularitySet set : {SingularitySet::forward, SingularitySet::inverse}) {
    solve::Options options;
    options.sigma = 0.02;
    const Cover cover = solve::solve(robot.system(set, side), options);
    EXPECT_TRUE(cover.complete());
    EXPECT_EQ(cover.dimension, 1);
    const auto samples = set == SingularitySet::forward ? robot.forward_samples() : robot.inverse_samples();
    ASSERT_GT(samples.size(), 1000u);
    const test::CoverLookup lookup(cover);
    std::size_t lost = 0;
    for (const SphericalConfiguration& q : samples) lost += !lookup.holds(q, test::kSampleTolerance);
    EXPECT_EQ(lost, 0u) << "of " << samples.size() << " samples of " << to_string(set);
    const UpwardRounding rounding;
    for (const auto& b : cover.boxes) {
      const auto [forward, leg1, leg2] = may_vanish(robot, b.box);
      ASSERT_TRUE(set == SingularitySet::forward ? forward : leg1 || leg2) << "nothing is singular in this box";
      // Where both legs are stretched at once the kernel has dimension 2: in such a box, or next to it.
      if (b.verdict == Verdict::undecided) {
        Box wider = b.box;
        for (Interval& own : wider) own = Interval(own.lo() - own.width(), own.hi() + own.width());
        const auto [forward_near, leg1_near, leg2_near] = may_vanish(robot, wider);
        EXPECT_TRUE(set == SingularitySet::inverse && leg1_near && leg2_near);
      }
    }
  }
}

Robot own_robot() {
  return {
      CORANK_SOURCE_DIR "/models/spherical_five_bar.cuik", std::acos(0.6), std::acos(5.0 / 13), {0, 1, 2, 3, 4, 5, 6}, ""};
}

Robot shared_robot() {
  return {CORANK_SOURCE_DIR "/../shared/models/spherical5_3out.cuik", M_PI / 2, 7 * M_PI / 18, {0, 1, 2, 3, 4, 5, 6}, ""};
}

class SphericalFiveBar : public testing::TestWithParam<KernelSide> {};

TEST_P(SphericalFiveBar, HasTheSingularitiesOfItsDeterminants) { expect_closed_forms(own_robot(), GetParam()); }

TEST_P(SphericalFiveBar, OfRightAngledCranksHasThemToo) {
  if (!std::filesystem::exists(shared_robot().file)) GTEST_SKIP() << shared_robot().file << " is not there";
  expect_closed_forms(shared_robot(), GetParam());
}

TEST_P(SphericalFiveBar, HasThemByTheAngularVelocitiesOfItsLinks) {
  Robot robot = own_robot();
  robot.rates = test::kAngularVelocities;
  expect_closed_forms(robot, GetParam());
}

INSTANTIATE_TEST_SUITE_P(Kernels, SphericalFiveBar, testing::Values(KernelSide::right, KernelSide::left));

TEST(SphericalFiveBar, WithTwoOfThreeCosinesHasThatChoicesSingularities) {
  const Robot robot = own_robot();
  auto text = symbolic::read_model(robot.file).source_text();
  const std::string outputs = "[OUTPUTS]  w";
  const auto at = text.find(outputs + "\n");
  ASSERT_NE(at, std::string::npos);
  text.replace(at, outputs.size(), "[OUTPUTS]  w_x, w_z");
  solve::Options options;
  options.sigma = 0.02;
  const Cover cover = solve::solve(
      symbolic::algebrize(symbolic::singularity_system(symbolic::parse_model(text, "chart.cuik"), SingularitySet::inverse)),
      options);
  const UpwardRounding rounding;
  std::size_t own = 0, of_the_choice = 0;
  for (const auto& b : cover.boxes) {
    const auto [forward, leg1, leg2] = may_vanish(robot, b.box);
    ++(leg1 || leg2 ? own : of_the_choice);
    if (leg1 || leg2) continue;
    EXPECT_TRUE(b.box[5].contains_zero()) << "w_y = 0";
  }
  EXPECT_GT(own, 500u);
  EXPECT_GT(of_the_choice, 500u) << "which the robot does not have";
}

TEST(SphericalFiveBar, HasASmoothCspace) {
  EXPECT_TRUE(solve::solve(own_robot().system(SingularitySet::cspace_singular)).boxes.empty());
}

}  // namespace
}  // namespace corank
