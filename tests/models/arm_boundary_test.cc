// Workspace boundaries of arms of many joints, solved in these, against kinematics in floating point: random arms by
// Denavit and Hartenberg with limits, sampled configurations with every number of limits reached, and the passage there.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <sstream>

#include "corank/core/dense.h"
#include "corank/result/files/verification.h"
#include "corank/study/answer.h"
#include "corank/study/images.h"
#include "corank/study/model.h"
#include "corank/tests/seeds.h"

namespace corank {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using Random = std::mt19937;

constexpr double kDegree = std::numbers::pi / 180;

double uniform(Random& random, double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(random); }
int pick(Random& random, int n) { return std::uniform_int_distribution<int>(0, n - 1)(random); }

/// Lengths in hundredths, angles in degrees.
struct Joint {
  int a = 0, alpha = 0, d = 0, lower = 0, upper = 0;
  bool slides = false;
};

struct Motion {
  Vector3d tip;
  MatrixXd first;                             // by the joints
  std::vector<std::vector<Vector3d>> second;  // by two of them
};

struct RandomArm {
  std::vector<Joint> joints;
  std::size_t size() const { return joints.size(); }
  double lower(std::size_t j) const { return joints[j].lower * (joints[j].slides ? 0.01 : kDegree); }
  double upper(std::size_t j) const { return joints[j].upper * (joints[j].slides ? 0.01 : kDegree); }

  std::string text() const {
    std::string rows = "[CONSTANTS]\nunit m\n[DH]\nstandard\na alpha d theta\n";
    for (std::size_t j = 0; j < size(); ++j) {
      const Joint& q = joints[j];
      const std::string unit = q.slides ? "/100" : "deg", range = fmt::format("[{}{}, {}{}]", q.lower, unit, q.upper, unit);
      rows += fmt::format("{}/100 {}deg {} {} limits {}\n", q.a, q.alpha,
                          q.slides ? fmt::format("q{}", j + 1) : fmt::format("{}/100", q.d),
                          q.slides ? "0" : fmt::format("q{}", j + 1), range);
    }
    return rows + "[OUTPUTS]\ntip : position of tool\n";
  }

  // Of the tip: a turning joint's is z × (tip − o), and what comes behind turns with it.
  Motion motion(const VectorXd& q) const {
    Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
    std::vector<Vector3d> axes, origins;
    for (std::size_t j = 0; j < size(); ++j) {
      axes.push_back(frame.linear().col(2));
      origins.push_back(frame.translation());
      frame = frame * Eigen::AngleAxisd(joints[j].slides ? 0 : q[j], Vector3d::UnitZ()) *
              Eigen::Translation3d(0.01 * joints[j].a, 0, joints[j].slides ? q[j] : 0.01 * joints[j].d) *
              Eigen::AngleAxisd(joints[j].alpha * kDegree, Vector3d::UnitX());
    }
    Motion m{frame.translation(), MatrixXd(3, size()), {}};
    for (std::size_t j = 0; j < size(); ++j) m.first.col(j) = joints[j].slides ? axes[j] : axes[j].cross(m.tip - origins[j]);
    m.second.assign(size(), std::vector<Vector3d>(size()));
    for (std::size_t j = 0; j < size(); ++j)
      for (std::size_t k = 0; k < size(); ++k) {
        const std::size_t before = std::min(j, k), behind = std::max(j, k);
        m.second[j][k] = joints[before].slides ? Vector3d::Zero() : axes[before].cross(Vector3d(m.first.col(behind)));
      }
    return m;
  }
};

RandomArm random_arm(Random& random, std::size_t joints) {
  constexpr std::array kTwists{-90, 90, 90, 0};
  RandomArm arm;
  const int slider = random() % 3 == 0 ? 1 + pick(random, static_cast<int>(joints) - 1) : -1;
  for (std::size_t j = 0; j < joints; ++j) {
    Joint q{10 * pick(random, 5), kTwists[pick(random, 4)], 10 * pick(random, 4), 0, 0, static_cast<int>(j) == slider};
    q.lower = q.slides ? 10 + pick(random, 20) : -60 - pick(random, 100);
    q.upper = q.slides ? q.lower + 30 + pick(random, 30) : 40 + pick(random, 110);
    if (j + 1 == joints) q.a = 15 + pick(random, 20);
    arm.joints.push_back(q);
  }
  return arm;
}

/// A configuration from which the tip cannot move along λ: −1 at a joint's lower limit, 1 at its upper.
struct Sample {
  VectorXd q;
  Vector3d lambda;
  std::vector<int> at;
};

// By Gauss and Newton on the free columns' λᵀJ = 0 and ‖λ‖ = 1. Nothing where these are nearly dependent: it is not precise.
std::optional<Sample> sample(const RandomArm& arm, std::size_t most, Random& random) {
  const std::size_t n = arm.size();
  Sample s{VectorXd(n), Vector3d::Random().normalized(), std::vector<int>(n, 0)};
  for (std::size_t k = pick(random, static_cast<int>(most) + 1); k > 0; --k)
    s.at[pick(random, static_cast<int>(n))] = random() % 2 ? 1 : -1;
  std::vector<int> free;
  for (std::size_t j = 0; j < n; ++j) {
    s.q[j] = s.at[j] < 0 ? arm.lower(j) : s.at[j] > 0 ? arm.upper(j) : uniform(random, arm.lower(j), arm.upper(j));
    if (s.at[j] == 0) free.push_back(static_cast<int>(j));
  }
  const auto k = static_cast<Eigen::Index>(free.size());
  for (int step = 0; step < 60; ++step) {
    const Motion m = arm.motion(s.q);
    const MatrixXd j = m.first(Eigen::all, free);
    VectorXd residual(k + 1);
    residual << j.transpose() * s.lambda, s.lambda.squaredNorm() - 1;
    if (residual.norm() < 1e-13) {
      for (std::size_t i = 0; i < n; ++i)
        if (s.q[i] < arm.lower(i) - 1e-12 || s.q[i] > arm.upper(i) + 1e-12) return std::nullopt;
      return s;
    }
    MatrixXd jacobian = MatrixXd::Zero(k + 1, k + 3);
    for (Eigen::Index a = 0; a < k; ++a)
      for (Eigen::Index b = 0; b < k; ++b) jacobian(a, b) = s.lambda.dot(m.second[free[a]][free[b]]);
    jacobian.block(0, k, k, 3) = j.transpose();
    jacobian.block(k, k, 1, 3) = 2 * s.lambda.transpose();
    if (Eigen::JacobiSVD<MatrixXd>(jacobian).singularValues().minCoeff() < 1e-4) return std::nullopt;
    const VectorXd change = jacobian.completeOrthogonalDecomposition().solve(residual);
    s.q(free) -= change.head(k);
    s.lambda -= change.tail(3);
  }
  return std::nullopt;
}

/// What second derivatives say; `unproven`: another limit is near, or a number near 0.
struct Said {
  Passage passage = Passage::unproven;
  Vector3d side = Vector3d::Zero();
};

Said said(const RandomArm& arm, const Sample& s) {
  constexpr double kClear = 0.02, kLeast = 1e-3;
  const Motion m = arm.motion(s.q);
  std::vector<int> free;
  std::vector<double> values;
  for (std::size_t j = 0; j < arm.size(); ++j) {
    if (s.at[j] == 0) {
      free.push_back(static_cast<int>(j));
      if (s.q[j] < arm.lower(j) + kClear || s.q[j] > arm.upper(j) - kClear) return {};
    } else {
      values.push_back(-s.at[j] * s.lambda.dot(m.first.col(j)));
    }
  }
  const MatrixXd j = m.first(Eigen::all, free);
  const Eigen::JacobiSVD<MatrixXd> svd(j, Eigen::ComputeFullV);
  const auto k = static_cast<Eigen::Index>(free.size());
  if (k < 2 || svd.singularValues()[1] < kLeast) return {};
  const MatrixXd basis = svd.matrixV().rightCols(k - 2);
  MatrixXd form(k, k);
  for (Eigen::Index a = 0; a < k; ++a)
    for (Eigen::Index b = 0; b < k; ++b) form(a, b) = s.lambda.dot(m.second[free[a]][free[b]]);
  if (k > 2) {
    const VectorXd own = symmetric_eigen(basis.transpose() * form * basis).values;
    values.insert(values.end(), own.begin(), own.end());
  }
  for (const double x : values)
    if (std::fabs(x) < kLeast) return {};
  const auto positive = std::ranges::count_if(values, [](double x) { return x > 0; });
  if (values.empty()) return {};
  const bool barrier = positive == 0 || positive == std::ssize(values);
  return {barrier ? Passage::barrier : Passage::traversable, positive > 0 ? s.lambda : Vector3d(-s.lambda)};
}

std::set<std::string> limits_of(const Sample& s) {
  std::set<std::string> limits;
  for (std::size_t j = 0; j < s.at.size(); ++j)
    if (s.at[j] != 0) limits.insert(fmt::format("q{} at its {} limit", j + 1, s.at[j] < 0 ? "lower" : "upper"));
  return limits;
}

std::set<std::string> limits_of(const result::Result& part) {
  std::set<std::string> limits;
  std::istringstream words(part.part.substr(0, part.part.find(':')));
  for (std::string limit; std::getline(words >> std::ws, limit, ',');)
    if (limit != "no limit") limits.insert(limit);
  return limits;
}

// Is the configuration in the box, as far as it has sides for the joints?
bool holds(const result::Result& part, const CoverBox& box, const VectorXd& q) {
  for (std::size_t v = 0; v < part.variables.size(); ++v) {
    const std::string& name = part.variables[v].name;
    const bool plain = name.starts_with("q");
    if (!plain && !name.starts_with("c_q") && !name.starts_with("s_q")) continue;
    const double value = q[std::stoi(name.substr(plain ? 1 : 3)) - 1];
    const double x = plain ? value : name[0] == 'c' ? std::cos(value) : std::sin(value);
    if (x < box.box[v].lo() - 1e-9 || x > box.box[v].hi() + 1e-9) return false;
  }
  return true;
}

struct Tally {
  std::size_t samples = 0, lost = 0, said = 0, open = 0, contradicted = 0, barriers = 0;
};

void look_for(const RandomArm& arm, const result::Result& result, Random& random, int samples, Tally& tally) {
  std::map<std::set<std::string>, std::vector<const result::Result*>> parts;
  for (const result::Result& part : result.parts) parts[limits_of(part)].push_back(&part);
  for (int k = 0; k < samples; ++k) {
    const std::optional<Sample> s = sample(arm, arm.size() - 2, random);
    if (!s) continue;
    ++tally.samples;
    const Said expected = said(arm, *s);
    bool found = false, known = false;
    for (const result::Result* part : parts[limits_of(*s)])
      for (const CoverBox& box : part->cover.boxes) {
        if (!holds(*part, box, s->q)) continue;
        found = true;
        if (expected.passage == Passage::unproven || box.passage == Passage::unproven) continue;
        known = true;
        const bool right =
            box.passage == expected.passage && (box.passage != Passage::barrier || box.side.empty() ||
                                                Eigen::Map<const Vector3d>(box.side.data()).dot(expected.side) > 0);
        EXPECT_TRUE(right) << arm.text() << fmt::format("{}", fmt::join(limits_of(*s), ", "))
                           << ", q = " << s->q.transpose();
        tally.contradicted += !right;
      }
    EXPECT_TRUE(found) << arm.text() << fmt::format("{}", fmt::join(limits_of(*s), ", ")) << ", q = " << s->q.transpose();
    tally.lost += !found;
    if (expected.passage == Passage::unproven) continue;
    ++(known ? tally.said : tally.open);
    tally.barriers += known && expected.passage == Passage::barrier;
  }
}

result::Result boundary_of(const RandomArm& arm) {
  const study::Model model = study::parse_model({arm.text(), "arm.cuik"});
  study::Options options;
  options.search.surfaces_whole = true;
  return study::answer({.model = model.mechanism, .set = symbolic::SingularitySet::boundary}, options);
}

// Has the arm a joint that the tip does not depend on, or fewer than three dimensions to move in?
bool is_simpler(const RandomArm& arm, Random& random) {
  VectorXd q(arm.size());
  for (std::size_t j = 0; j < arm.size(); ++j) q[j] = uniform(random, arm.lower(j), arm.upper(j));
  const MatrixXd first = arm.motion(q).first;
  return first.colwise().norm().minCoeff() < 1e-6 || Eigen::JacobiSVD<MatrixXd>(first).singularValues()[2] < 1e-6;
}

TEST(ArmBoundary, OfRandomArmsHasEverySampledConfiguration) {
  Tally tally;
  for (unsigned seed = 1; seed <= test::seeds(5); ++seed) {
    Random random(seed);
    srand(seed);
    const RandomArm arm = random_arm(random, seed % 4 == 0 ? 5 : 4);
    if (is_simpler(arm, random)) continue;
    const result::Result result = boundary_of(arm);
    EXPECT_TRUE(result.cover.complete()) << arm.text();
    look_for(arm, result, random, 1500, tally);
    EXPECT_TRUE(seed != 3 || result::verify(result).verified()) << arm.text();
  }
  std::printf("%zu samples, %zu lost; passages: %zu known, %zu open, %zu contradicted, %zu barriers\n", tally.samples,
              tally.lost, tally.said, tally.open, tally.contradicted, tally.barriers);
  EXPECT_GT(tally.samples, 1000u);
  EXPECT_GT(tally.barriers, 300u);
  EXPECT_GT(tally.said - tally.barriers, 300u);
}

// At q4 = 90° the tip is on the axis of q3, and q1 and q2 move it in one plane: every configuration is in the part. Where q1
// to q3 turn about one point they move it on a sphere, whatever q4 is.
TEST(ArmBoundary, HasPartsOfAllConfigurations) {
  RandomArm planar{{{40, 0, 0, -180, 180}, {40, 90, 0, -180, 180}, {0, -90, 0, -180, 180}, {10, 0, 0, 0, 90}}},
      shoulder{{{0, 90, 0, -180, 180}, {0, -90, 0, -180, 180}, {0, 90, 50, -180, 180}, {40, 0, 0, 0, 89}}};
  for (const RandomArm& arm : {planar, shoulder}) {
    const result::Result result = boundary_of(arm);
    EXPECT_TRUE(result.cover.complete());
    EXPECT_LT(result.cover.boxes.size(), 20'000u);
    Random random(3);
    for (int k = 0; k < 100; ++k) {
      Sample s{VectorXd(4), Vector3d::Zero(), {0, 0, 0, 1}};
      for (int j = 0; j < 3; ++j) s.q[j] = uniform(random, -3, 3);
      s.q[3] = arm.upper(3);
      EXPECT_TRUE(std::ranges::any_of(result.parts, [&](const result::Result& part) {
        return limits_of(part) == limits_of(s) &&
               std::ranges::any_of(part.cover.boxes, [&](const CoverBox& box) { return holds(part, box, s.q); });
      })) << s.q.transpose();
    }
  }
}

// Wherever the joints are in a box, the tip is in one of its images.
TEST(ArmBoundary, HasImagesForPictures) {
  Random random(1);
  const RandomArm arm = random_arm(random, 4);
  const result::Result result = boundary_of(arm);
  EXPECT_FALSE(study::with_images(result, result.cover.boxes.size())) << "steps too wide for a picture";
  const std::optional<result::Result> images = study::with_images(result, 40 * result.cover.boxes.size());
  ASSERT_TRUE(images);
  std::set<int> drawn;
  for (int i = 0; i < std::ssize(result.parts); ++i) {
    const result::Result& part = result.parts[i];
    if (part.cover.boxes.empty()) continue;
    const CoverBox& own = part.cover.boxes[pick(random, static_cast<int>(part.cover.boxes.size()))];
    VectorXd q(4);
    for (int j = 0; j < 4; ++j) {
      q[j] = uniform(random, arm.lower(j), arm.upper(j));
      for (std::size_t v = 0; v < part.variables.size(); ++v) {
        if (part.variables[v].name == fmt::format("c_q{}", j + 1)) q[j] = std::atan2(own.box[v + 1].mid(), own.box[v].mid());
        if (part.variables[v].name == fmt::format("q{}", j + 1)) q[j] = own.box[v].mid();
      }
    }
    if (!holds(part, own, q)) continue;
    drawn.insert(i);
    const Vector3d tip = arm.motion(q).tip;
    const auto has_tip = [&](const CoverBox& box) {
      for (std::size_t v = 0; v < images->variables.size(); ++v)
        if (const std::string& name = images->variables[v].name; name.starts_with("tip_"))
          if (!Interval(box.box[v].lo() - 1e-9, box.box[v].hi() + 1e-9).contains(tip[name[4] - 'x'])) return false;
      return true;
    };
    EXPECT_TRUE(std::ranges::any_of(
        images->cover.boxes, [&](const CoverBox& box) { return box.part == i && has_tip(box) && holds(*images, box, q); }))
        << part.part << ", q = " << q.transpose();
  }
  EXPECT_GT(drawn.size(), 10u);
}

}  // namespace
}  // namespace corank
