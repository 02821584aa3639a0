// Conformations of cyclohexane's ring against those found from distances between its atoms.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>

#include "corank/core/dense.h"
#include "corank/solve/search/solve.h"
#include "corank/study/model.h"
#include "corank/study/question.h"

namespace corank {
namespace {

using Eigen::Vector3d;

constexpr double kBond = 1.526;

struct Solved {
  System system;
  Cover cover;
};

const Solved& solved() {
  static const Solved s = [] {
    const study::Model model = study::read_model(CORANK_SOURCE_DIR "/models/spatial/cyclohexane.cuik");
    Solved result{study::system({.model = model.mechanism, .assembly = model.assembly, .tolerance = 1e-6}), {}};
    solve::Options options;
    options.sigma = 0.02;
    result.cover = solve::solve(result.system, options);
    return result;
  }();
  return s;
}

using Ring = Eigen::Matrix<double, 18, 1>;

Vector3d atom(const Ring& ring, int i) { return ring.segment<3>(3 * ((i + 6) % 6)); }

// Newton's method on the distances of neighbours and of those two apart, which hold the angles; steps of least length.
bool close(Ring& ring) {
  for (int step = 0; step < 100; ++step) {
    Eigen::Matrix<double, 12, 1> f;
    Eigen::Matrix<double, 12, 18> j = Eigen::Matrix<double, 12, 18>::Zero();
    for (int i = 0; i < 6; ++i)
      for (const int apart : {1, 2}) {
        const int row = 2 * i + apart - 1, other = (i + apart) % 6;
        const Vector3d way = atom(ring, other) - atom(ring, i);
        f[row] = way.squaredNorm() - kBond * kBond * (apart == 1 ? 1 : 8.0 / 3);
        j.block<1, 3>(row, 3 * i) = -2 * way.transpose();
        j.block<1, 3>(row, 3 * other) = 2 * way.transpose();
      }
    if (f.norm() < 1e-13) return true;
    ring -= least_squares(j, f, 1e-9).x;
  }
  return false;
}

/// About the bond between atoms i and i + 1.
double torsion(const Ring& ring, int i) {
  const Vector3d axis = (atom(ring, i + 1) - atom(ring, i)).normalized(), before = atom(ring, i - 1) - atom(ring, i),
                 behind = atom(ring, i + 2) - atom(ring, i + 1);
  const Vector3d a = before - before.dot(axis) * axis, b = behind - behind.dot(axis) * axis;
  return std::atan2(axis.dot(a.cross(b)), a.dot(b));
}

bool is_chair(const Ring& ring) {
  return std::fabs(std::fabs(torsion(ring, 0)) + std::fabs(torsion(ring, 1)) - 2 * M_PI / 3) < 1e-4 &&
         torsion(ring, 0) * torsion(ring, 3) < 0;
}

bool holds(const CoverBox& b, const Ring& ring) {
  const System& system = solved().system;
  const auto near = [&](std::size_t variable, double value) {
    return b.box[variable].lo() - 1e-5 <= value && value <= b.box[variable].hi() + 1e-5;
  };
  for (const Angle& a : system.angles) {
    const double t = torsion(ring, a.name == "t1" ? 0 : 5);
    if (!near(a.cosine, std::cos(t)) || !near(a.sine, std::sin(t))) return false;
  }
  // Bonds 3 and 4 in the first atom's frame: x to the next, y on the side of the one before.
  const Vector3d x = (atom(ring, 1) - atom(ring, 0)).normalized(), before = atom(ring, 5) - atom(ring, 0);
  const Vector3d y = (before - before.dot(x) * x).normalized(), z = x.cross(y);
  for (const int bond : {3, 4}) {
    const Vector3d way = (atom(ring, bond) - atom(ring, bond - 1)).normalized();
    const Vector3d seen(way.dot(x), way.dot(y), way.dot(z));
    for (int i = 0; i < 3; ++i)
      if (!near(static_cast<std::size_t>(system.find("axis_t" + std::to_string(bond) + "_" + "xyz"[i])), seen[i]))
        return false;
  }
  return true;
}

TEST(Cyclohexane, HasTwoRigidChairs) {
  const Solved& s = solved();
  EXPECT_TRUE(s.cover.complete());
  EXPECT_EQ(s.cover.count(Verdict::isolated), 2u);
  for (const CoverBox& b : s.cover.boxes) {
    if (b.verdict != Verdict::isolated) continue;
    for (const Angle& a : s.system.angles)
      EXPECT_NEAR(std::fabs(std::atan2(b.box[a.sine].mid(), b.box[a.cosine].mid())), M_PI / 3, 1e-4);
  }
}

TEST(Cyclohexane, MovesAlongACurveOfPartialBoxes) {
  const Solved& s = solved();
  EXPECT_EQ(s.cover.dimension, 1);
  EXPECT_EQ(s.cover.count(Verdict::partial) + 2, s.cover.boxes.size());
  EXPECT_GT(s.cover.count(Verdict::partial), 100u);
}

TEST(Cyclohexane, LosesNoConformation) {
  const Solved& s = solved();
  std::mt19937 random(1);
  std::uniform_real_distribution<> place(-2, 2);
  int chairs = 0, boats = 0, lost = 0;
  while (boats < 100 || chairs < 10) {
    Ring ring;
    for (double& c : ring) c = place(random);
    if (!close(ring)) continue;
    ++(is_chair(ring) ? chairs : boats);
    EXPECT_NEAR(torsion(ring, 0), (is_chair(ring) ? -1 : 1) * torsion(ring, 3), 1e-5) << "opposite torsion angles";
    lost += std::none_of(s.cover.boxes.begin(), s.cover.boxes.end(), [&](const CoverBox& b) { return holds(b, ring); });
  }
  EXPECT_EQ(lost, 0) << "of " << chairs << " chairs and " << boats << " boats";
}

}  // namespace
}  // namespace corank
