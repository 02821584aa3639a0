// Singularities of robots from parts against computations that know nothing of their equations: hundreds of singular
// configurations of each, in long runs thousands, none missed.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "corank/solve/search/solve.h"
#include "corank/study/model.h"
#include "corank/study/question.h"
#include "corank/tests/seeds.h"

namespace corank {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using symbolic::SingularitySet;

const int kSamples = test::long_run() ? 2000 : 600;
constexpr double kSampleTolerance = 1e-7;

/// Values of some coordinates of a configuration: angles, lengths and components of vectors, by their names.
using Configuration = std::map<std::string, double>;

struct Answer {
  System system;
  Cover cover;
};

Answer solved(const std::string& model, SingularitySet set, const std::vector<result::ConstantOverride>& constants = {},
              double sigma = 0) {
  const study::Model read = study::read_model(CORANK_SOURCE_DIR "/models/" + model + ".cuik", constants);
  Answer answer{study::system({.model = read.mechanism, .set = set, .assembly = read.assembly}), {}};
  solve::Options options;
  if (sigma > 0) options.sigma = sigma;
  answer.cover = solve::solve(answer.system, options);
  return answer;
}

/// The sample's values of the system's variables.
std::vector<std::pair<std::size_t, double>> variables(const System& system, const Configuration& q) {
  std::vector<std::pair<std::size_t, double>> values;
  for (const auto& [name, value] : q) {
    const auto angle = std::find_if(system.angles.begin(), system.angles.end(),
                                    [&, &name = name](const Angle& a) { return a.name == name; });
    if (angle != system.angles.end()) {
      values.emplace_back(angle->cosine, std::cos(value));
      values.emplace_back(angle->sine, std::sin(value));
    } else {
      const int variable = system.find(name);
      if (variable < 0) throw std::invalid_argument("no coordinate " + name);
      values.emplace_back(variable, value);
    }
  }
  return values;
}

/// How many of the samples, which name the same coordinates, are in no box.
std::size_t missed(const Answer& answer, const std::vector<Configuration>& samples) {
  std::vector<const Box*> boxes;
  for (const CoverBox& b : answer.cover.boxes) boxes.push_back(&b.box);
  const std::size_t first = variables(answer.system, samples.front()).front().first;
  const auto begin = [&](const Box* b) { return (*b)[first].lo() - kSampleTolerance; };
  std::sort(boxes.begin(), boxes.end(), [&](const Box* a, const Box* b) { return begin(a) < begin(b); });
  double widest = 0;
  for (const Box* b : boxes) widest = std::max(widest, (*b)[first].width());
  std::size_t lost = 0;
  for (const Configuration& q : samples) {
    const auto values = variables(answer.system, q);
    const double at = values.front().second;
    bool found = false;
    for (auto b = std::lower_bound(boxes.begin(), boxes.end(), at - widest - 1e-6,
                                   [&](const Box*box, double value) { return begin(box) < value; });
         b != boxes.end() && begin(*b) <= at && !found; ++b)
      found = std::all_of(values.begin(), values.end(), [&](const auto& v) {
        return v.second >= (**b)[v.first].lo() - kSampleTolerance && v.second <= (**b)[v.first].hi() + kSampleTolerance;
      });
    lost += !found;
  }
  return lost;
}

void expect_all(const Answer& answer, const std::vector<Configuration>& samples) {
  EXPECT_TRUE(answer.cover.complete());
  ASSERT_GE(samples.size(), static_cast<std::size_t>(kSamples));
  EXPECT_EQ(missed(answer, samples), 0u) << "of " << samples.size();
}

double middle(const Answer& answer, const CoverBox& b, const std::string& name) {
  for (const Angle& a : answer.system.angles)
    if (a.name == name) return std::atan2(b.box[a.sine].mid(), b.box[a.cosine].mid());
  return b.box[answer.system.find(name)].mid();
}

/// Does no box lie where the closed form is far from 0? In proven boxes it is 0 somewhere, so at most its change over one.
template <class ClosedForm>
void expect_near_zero(const Answer& answer, const ClosedForm& closed_form, double tolerance) {
  for (const CoverBox& b : answer.cover.boxes)
    ASSERT_LT(std::fabs(closed_form([&](const char* name) { return middle(answer, b, name); })), tolerance);
}

// --- serial arms: the Jacobian of the last link's twist, by Denavit and Hartenberg ---------------------------------------

struct Row {
  double a, d, alpha;
};

/// Columns of angular velocity over velocity of the last frame's origin.
Eigen::MatrixXd arm_jacobian(const std::vector<Row>& arm, const std::vector<double>& theta) {
  Matrix3d r = Matrix3d::Identity();
  Vector3d p = Vector3d::Zero();
  std::vector<Vector3d> axes, points;
  for (std::size_t i = 0; i < arm.size(); ++i) {
    axes.push_back(r.col(2));
    points.push_back(p);
    r = r * Eigen::AngleAxisd(theta[i], Vector3d::UnitZ()).toRotationMatrix();
    p += arm[i].d * r.col(2) + arm[i].a * r.col(0);
    r = r * Eigen::AngleAxisd(arm[i].alpha, Vector3d::UnitX()).toRotationMatrix();
  }
  Eigen::MatrixXd j(6, static_cast<Eigen::Index>(arm.size()));
  for (std::size_t i = 0; i < arm.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    j.block<3, 1>(0, column) = axes[i];
    j.block<3, 1>(3, column) = axes[i].cross(p - points[i]);
  }
  return j;
}

/// The same constant multiple at random angles, to which the sign of a product of joint angles counts for nothing.
template <class ClosedForm>
void expect_determinant(const std::vector<Row>& arm, Eigen::Index first_row, const ClosedForm& closed_form) {
  std::mt19937 random(1);
  std::uniform_real_distribution<> angle(-M_PI, M_PI);
  double ratio = 0;
  for (int k = 0; k < 100; ++k) {
    std::vector<double> theta;
    for (std::size_t i = 0; i < arm.size(); ++i) theta.push_back(angle(random));
    const Eigen::MatrixXd j = arm_jacobian(arm, theta);
    const double determinant = j.bottomRows(j.rows() - first_row).determinant(), value = closed_form(theta);
    if (k == 0) ratio = determinant / value;
    EXPECT_NEAR(determinant, ratio * value, 1e-12);
  }
  EXPECT_GT(std::fabs(ratio), 1e-6);
}

/// Where f changes its sign over [−π, π]: zeros by bisection.
template <class Function>
std::vector<double> zeros(const Function& f, int cells = 400) {
  std::vector<double> list;
  const auto at = [&](int i) { return -M_PI + 1e-4 + 2 * M_PI * i / cells; };
  for (int i = 0; i < cells; ++i) {
    double lo = at(i), hi = at(i + 1);
    if (f(lo) * f(hi) > 0) continue;
    for (int k = 0; k < 60; ++k) (f(lo) * f((lo + hi) / 2) <= 0 ? hi : lo) = (lo + hi) / 2;
    list.push_back((lo + hi) / 2);
  }
  return list;
}

double orthogonal(double t2, double t3) { return std::sin(t3) + std::cos(t2) * (2 * std::sin(t3) - std::cos(t3)); }

TEST(Orthogonal3R, IsSingularWhereItsDeterminantVanishes) {
  // In the standard convention the offset along the second axis is the second row's.
  const std::vector<Row> arm{{1, 0, -M_PI / 2}, {2, 1, M_PI / 2}, {1.5, 0, 0}};
  expect_determinant(arm, 3,
                     [](const std::vector<double>& t) { return (2 + 1.5 * std::cos(t[2])) * orthogonal(t[1], t[2]); });
  const Answer answer = solved("serial/orthogonal_3r", SingularitySet::inverse);
  std::vector<Configuration> samples;
  for (int i = 0; i < 2 * kSamples; ++i) {
    const double t3 = -M_PI + 2 * M_PI * (i + 0.5) / (2 * kSamples);
    const double c = -std::sin(t3) / (2 * std::sin(t3) - std::cos(t3));
    if (!(std::fabs(c) <= 1)) continue;
    for (const int sign : {-1, 1}) samples.push_back({{"theta1", 0}, {"theta2", sign * std::acos(c)}, {"theta3", t3}});
  }
  expect_all(answer, samples);
  expect_near_zero(
      answer, [](const auto& q) { return orthogonal(q("theta2"), q("theta3")); }, 0.05);
  EXPECT_EQ(answer.cover.count(Verdict::undecided), 0u);
  // Directions that are 1 in some component are no ends of what was searched.
  for (std::size_t v = 0; v < answer.system.variables.size(); ++v) {
    const Variable& variable = answer.system.variables[v];
    if (!variable.auxiliary) continue;
    for (const CoverBox& b : answer.cover.boxes)
      ASSERT_TRUE(b.box[v].lo() > variable.domain.lo() && b.box[v].hi() < variable.domain.hi()) << variable.name;
  }
}

struct Factors {
  double elbow, shoulder, wrist;
};

Factors puma(double t2, double t3, double t5) {
  const double a2 = 0.4318, a3 = 0.0203, d4 = 0.4318;
  return {d4 * std::cos(t3) + a3 * std::sin(t3), a2 * std::cos(t2) + a3 * std::cos(t2 + t3) - d4 * std::sin(t2 + t3),
          std::sin(t5)};
}
Factors ur5(double t2, double t3, double t4, double t5) {
  return {std::sin(t3), -0.425 * std::cos(t2) - 0.39225 * std::cos(t2 + t3) + 0.09465 * std::sin(t2 + t3 + t4),
          std::sin(t5)};
}

TEST(Puma560, IsSingularAtElbowShoulderAndWrist) {
  const double quarter = M_PI / 2;
  const std::vector<Row> arm{{0, 0, quarter},      {0.4318, 0, 0},   {0.0203, 0.15005, -quarter},
                             {0, 0.4318, quarter}, {0, 0, -quarter}, {0, 0, 0}};
  expect_determinant(arm, 0, [](const std::vector<double>& t) {
    const Factors f = puma(t[1], t[2], t[4]);
    return f.elbow * f.shoulder * f.wrist;
  });
  // With joint 5 locked: curves of the elbow and the shoulder. Where they cross they are dear; over this part of a turn of
  // joint 2 they do so as well.
  std::vector<result::ConstantOverride> ranges{{"lo5", "1"}, {"up5", "1"}};
  double from = -M_PI, to = M_PI;
  if (!test::long_run()) {
    ranges.push_back({"lo2", "0"});
    ranges.push_back({"up2", "1"});
    from = 0, to = 1;
  }
  const Answer bent = solved("serial/puma_560", SingularitySet::inverse, ranges, 0.05);
  std::vector<Configuration> samples;
  for (int i = 0; i < kSamples; ++i) {
    const double t2 = from + (to - from) * (i + 0.5) / kSamples;
    for (const double t3 : zeros([&](double t) { return puma(t2, t, 1).shoulder; }, 40))
      samples.push_back({{"theta2", t2}, {"theta3", t3}});
    for (const double t3 : zeros([&](double t) { return puma(t2, t, 1).elbow; }, 40))
      samples.push_back({{"theta2", t2}, {"theta3", t3}});
  }
  expect_all(bent, samples);
  const auto product = [](const auto& q) {
    const Factors f = puma(q("theta2"), q("theta3"), q("theta5"));
    return f.elbow * f.shoulder * f.wrist;
  };
  expect_near_zero(bent, product, 0.02);
}

// Joints 2, 3 and 5 are free, within ranges: the sets are surfaces, which cross.
TEST(Puma560, IsSingularOnThreeSurfaces) {
  std::mt19937 random(1);
  const auto between = [&](double lo, double hi) { return std::uniform_real_distribution<>(lo, hi)(random); };
  const auto covered = [&](const std::vector<result::ConstantOverride>& ranges) {
    Answer answer = solved("serial/puma_560", SingularitySet::inverse, ranges, 0.2);
    EXPECT_EQ(answer.cover.dimension, 2);
    return answer;
  };
  const auto sample = [](double t2, double t3, double t5) {
    return Configuration{{"theta2", t2}, {"theta3", t3}, {"theta5", t5}};
  };
  std::vector<Configuration> elbow, shoulder, wrist;
  while (std::min(elbow.size(), shoulder.size()) < static_cast<std::size_t>(kSamples)) {
    const double t2 = between(0, 2), t5 = between(0.5, 1);
    for (const double t3 : zeros([&](double t) { return puma(t2, t, t5).elbow; }, 40))
      if (t3 > -3 && t3 < 0) elbow.push_back(sample(t2, t3, t5));
    for (const double t3 : zeros([&](double t) { return puma(t2, t, t5).shoulder; }, 40))
      if (t3 > -3 && t3 < 0) shoulder.push_back(sample(t2, t3, t5));
  }
  const Answer arm = covered({{"lo2", "0"}, {"up2", "2"}, {"lo3", "-3"}, {"up3", "0"}, {"lo5", "1/2"}, {"up5", "1"}});
  expect_all(arm, elbow);
  expect_all(arm, shoulder);
  for (int k = 0; k < kSamples; ++k) {
    const double t2 = between(0, 1), t3 = between(-1, -0.5);
    for (const double t5 : {0.0, M_PI}) wrist.push_back(sample(t2, t3, t5));
  }
  const Answer hand = covered({{"lo2", "0"}, {"up2", "1"}, {"lo3", "-1"}, {"up3", "-1/2"}});
  expect_all(hand, wrist);
}

TEST(Ur5, IsSingularAtElbowWristAndShoulder) {
  const double quarter = M_PI / 2;
  const std::vector<Row> arm{{0, 0.089159, quarter}, {-0.425, 0, 0},         {-0.39225, 0, 0},
                             {0, 0.10915, quarter},  {0, 0.09465, -quarter}, {0, 0.0823, 0}};
  expect_determinant(arm, 0, [](const std::vector<double>& t) {
    const Factors f = ur5(t[1], t[2], t[3], t[4]);
    return f.elbow * f.shoulder * f.wrist;
  });
  const Answer answer = solved("serial/ur5", SingularitySet::inverse, {{"lo5", "1"}, {"up5", "1"}}, 0.05);
  std::vector<Configuration> samples;
  for (int i = 0; i < kSamples; ++i) {
    const double t2 = -M_PI + 2 * M_PI * (i + 0.5) / kSamples;
    for (const double elbow : {0.0, M_PI}) samples.push_back({{"theta2", t2}, {"theta3", elbow}, {"theta4", 0}});
    for (const double t3 : zeros([&](double t) { return ur5(t2, t, 0, 1).shoulder; }, 40))
      samples.push_back({{"theta2", t2}, {"theta3", t3}, {"theta4", 0}});
  }
  expect_all(answer, samples);
}

// --- the spherical five-bar, by the determinants of its directions -------------------------------------------------------

double determinant(const Vector3d& a, const Vector3d& b, const Vector3d& c) { return a.dot(b.cross(c)); }

/// The unit vectors u with u·a = p, u·b = q.
std::vector<Vector3d> meeting(const Vector3d& a, double p, const Vector3d& b, double q) {
  const double g = a.dot(b), d = 1 - g * g;
  if (d < 1e-12) return {};
  const Vector3d base = (p - q * g) / d * a + (q - p * g) / d * b;
  const double rest = 1 - base.squaredNorm();
  if (rest < 0) return {};
  const Vector3d n = std::sqrt(rest / d) * a.cross(b);
  return {base + n, base - n};
}

struct FiveBar {
  static constexpr double c = 0.6, s = 0.8, k = 5.0 / 13;
  static Vector3d end1(double t) { return {s * std::cos(t), s * std::sin(t), c}; }
  static Vector3d end2(double t) { return {c, s * std::cos(t), s * std::sin(t)}; }
  static Configuration at(const Vector3d& e1, const Vector3d& e2, const Vector3d& w) {
    Configuration q{{"theta1", std::atan2(e1.y(), e1.x())}, {"theta2", std::atan2(e2.z(), e2.y())}};
    for (int i = 0; i < 3; ++i) q[std::string("w_") + "xyz"[i]] = w[i];
    return q;
  }
};

TEST(SphericalFiveBarOfParts, HasTheSingularitiesOfItsDeterminants) {
  const Vector3d n1 = Vector3d::UnitZ(), n2 = Vector3d::UnitX();
  std::vector<Configuration> forward, inverse;
  const double alpha = std::acos(FiveBar::c), delta = std::acos(FiveBar::k);
  for (int i = 0; i < kSamples; ++i) {
    const double t = 0.01 + 2 * M_PI * i / kSamples;
    const Vector3d e1 = FiveBar::end1(t), e2 = FiveBar::end2(t);
    for (const Vector3d& other : meeting(e1, std::cos(2 * delta), n2, FiveBar::c))
      forward.push_back(FiveBar::at(e1, other, (e1 + other).normalized()));
    for (const Vector3d& e : meeting(n1, FiveBar::c, n2, FiveBar::c)) {  // the cranks' ends meet
      const Vector3d u = e.unitOrthogonal(), v = e.cross(u);
      forward.push_back(FiveBar::at(e, e, std::cos(delta) * e + std::sin(delta) * (std::cos(t) * u + std::sin(t) * v)));
    }
    for (const double reach : {alpha + delta, alpha - delta}) {
      const Vector3d w1 = std::sin(reach) * Vector3d(std::cos(t), std::sin(t), 0) + std::cos(reach) * n1,
                     w2 = std::sin(reach) * Vector3d(0, std::cos(t), std::sin(t)) + std::cos(reach) * n2;
      for (const Vector3d& other : meeting(w1, FiveBar::k, n2, FiveBar::c)) inverse.push_back(FiveBar::at(e1, other, w1));
      for (const Vector3d& other : meeting(w2, FiveBar::k, n1, FiveBar::c)) inverse.push_back(FiveBar::at(other, e2, w2));
    }
  }
  for (const SingularitySet set : {SingularitySet::forward, SingularitySet::inverse}) {
    SCOPED_TRACE(to_string(set));
    const Answer answer = solved("spatial/spherical_five_bar", set, {}, 0.05);
    expect_all(answer, set == SingularitySet::forward ? forward : inverse);
    const auto vector = [](const auto& q) { return Vector3d(q("w_x"), q("w_y"), q("w_z")); };
    expect_near_zero(
        answer,
        [&](const auto& q) {
          const Vector3d e1 = FiveBar::end1(q("theta1")), e2 = FiveBar::end2(q("theta2")), w = vector(q);
          return set == SingularitySet::forward ? determinant(e1, e2, w) : determinant(n1, e1, w) * determinant(n2, e2, w);
        },
        0.1);
  }
}

TEST(SphericalFourBar, HasTheSingularitiesOfItsDeterminants) {
  const double ca = 12.0 / 13, sa = 5.0 / 13, cb = 0.6, cc = 0.6, sc = 0.8;
  const auto end1 = [&](double t) { return Vector3d(sa * std::cos(t), sa * std::sin(t), ca); };
  const auto end2 = [&](double t) { return Vector3d(cc, sc * std::cos(t), sc * std::sin(t)); };
  for (const SingularitySet set : {SingularitySet::forward, SingularitySet::inverse}) {
    SCOPED_TRACE(to_string(set));
    // Zeros of one closed form along the curve e1·e2 = cos of the coupler: over the crank, both positions of e2.
    const auto form = [&](const Vector3d& e1, const Vector3d& e2) {
      return set == SingularitySet::forward ? determinant(e1, e2, Vector3d::UnitX())
                                            : determinant(Vector3d::UnitZ(), e1, e2);
    };
    const Answer answer = solved("spatial/spherical_four_bar", set);
    EXPECT_TRUE(answer.cover.complete());
    ASSERT_EQ(answer.cover.count(Verdict::isolated), answer.cover.boxes.size());
    std::vector<std::pair<double, double>> expected;  // Newton on both equations from random angles
    std::mt19937 random(1);
    std::uniform_real_distribution<> angle(-M_PI, M_PI);
    for (int k = 0; k < kSamples; ++k) {
      Eigen::Vector2d x(angle(random), angle(random));
      const auto f = [&](const Eigen::Vector2d& y) {
        const Vector3d e1 = end1(y[0]), e2 = end2(y[1]);
        return Eigen::Vector2d(e1.dot(e2) - cb, form(e1, e2));
      };
      for (int step = 0; step < 50; ++step) {
        Eigen::Matrix2d j;
        for (int i = 0; i < 2; ++i)
          j.col(i) = (f(x + 1e-6 * Eigen::Vector2d::Unit(i)) - f(x - 1e-6 * Eigen::Vector2d::Unit(i))) / 2e-6;
        const Eigen::Vector2d change = j.fullPivLu().solve(f(x));
        x -= change;
        if (change.norm() < 1e-13) break;
      }
      if (!(f(x).norm() < 1e-10)) continue;
      const std::pair<double, double> q(std::remainder(x[0], 2 * M_PI), std::remainder(x[1], 2 * M_PI));
      EXPECT_EQ(missed(answer, {{{"theta", q.first}, {"psi", q.second}}}), 0u);
      if (std::none_of(expected.begin(), expected.end(), [&](const auto& known) {
            return std::hypot(std::remainder(q.first - known.first, 2 * M_PI),
                              std::remainder(q.second - known.second, 2 * M_PI)) < 1e-6;
          }))
        expected.push_back(q);
    }
    EXPECT_EQ(answer.cover.points.size(), expected.size());
  }
}

// --- the Agile Eye, by its legs' wrenches ---------------------------------------------------------------------------------

struct Eye {
  Eigen::Matrix3d rotation;  ///< columns: the axes on the platform
  std::array<double, 3> theta;
  /// Across the motor's axis, where the crank's end is.
  Vector3d end(int leg) const {
    const Vector3d u = Vector3d::Unit((leg + 1) % 3), v = Vector3d::Unit((leg + 2) % 3);
    // Motors 1 and 3 turn from y to z and from x to y, motor 2 from z to x.
    return std::cos(theta[static_cast<std::size_t>(leg)]) * u + std::sin(theta[static_cast<std::size_t>(leg)]) * v;
  }
  Vector3d wrench(int leg) const { return end(leg).cross(rotation.col(leg)); }
  double inverse() const {
    double product = 1;
    for (int leg = 0; leg < 3; ++leg) product *= wrench(leg)[leg];
    return product;
  }
  double forward() const { return determinant(wrench(0), wrench(1), wrench(2)); }
  Configuration configuration() const {
    Configuration q;
    for (int leg = 0; leg < 3; ++leg) {
      q["theta" + std::to_string(leg + 1)] = theta[static_cast<std::size_t>(leg)];
      for (int i = 0; i < 3; ++i)
        q[std::array{"axis_v1_", "axis_v2_", "n_eye_"}[static_cast<std::size_t>(leg)] + std::string(1, "xyz"[i])] =
            rotation(i, leg);
    }
    return q;
  }
};

// The curves of one leg, stretched and folded: its motor is held, the eye turns about it in two ways, and each of the other
// legs has two postures.
TEST(AgileEye, IsSingularOnTwoCurvesForEachLeg) {
  constexpr double kNear = 2.9, kHeld = 0.5;
  for (int leg = 0; leg < 3; ++leg) {
    SCOPED_TRACE(leg + 1);
    std::vector<Configuration> samples;
    for (int k = 0; k < kSamples / 8; ++k) {
      const double t = -M_PI + 2 * M_PI * (k + 0.5) / (kSamples / 8);
      for (int way = 0; way < 4; ++way) {
        const double sign = way & 1 ? 1 : -1, other = way & 2 ? 1 : -1;
        Vector3d diagonal;
        diagonal[leg] = sign;
        diagonal[(leg + 1) % 3] = other;
        diagonal[(leg + 2) % 3] = sign * other;
        Eye eye{Eigen::AngleAxisd(t, Vector3d::Unit(leg)).toRotationMatrix() * diagonal.asDiagonal(), {}};
        if (eye.rotation.diagonal().squaredNorm() > kNear) continue;
        for (int posture = 0; posture < 4; ++posture) {
          for (int i = 0; i < 3; ++i) {
            const Vector3d v = eye.rotation.col(i);
            eye.theta[static_cast<std::size_t>(i)] =
                std::atan2(-v[(i + 1) % 3], v[(i + 2) % 3]) + (posture >> (i == (leg + 1) % 3) & 1) * M_PI;
          }
          eye.theta[static_cast<std::size_t>(leg)] = kHeld;
          for (int i = 0; i < 3; ++i) ASSERT_NEAR(eye.end(i).dot(eye.rotation.col(i)), 0, 1e-12) << "the links' angles";
          ASSERT_NEAR(eye.inverse(), 0, 1e-12);
          ASSERT_NEAR(eye.forward(), 0, 1e-12);
          samples.push_back(eye.configuration());
        }
      }
    }
    const std::string number = std::to_string(leg + 1);
    for (const SingularitySet set : {SingularitySet::forward, SingularitySet::inverse}) {
      // The legs are alike: both sets of one, and one set of each of the others.
      if (!test::long_run() && leg != 0 && (leg == 1) != (set == SingularitySet::forward)) continue;
      SCOPED_TRACE(to_string(set));
      const Answer answer =
          solved("spatial/agile_eye", set, {{"near", "2.9"}, {"lo" + number, "1/2"}, {"up" + number, "1/2"}}, 0.1);
      expect_all(answer, samples);
      EXPECT_EQ(answer.cover.dimension, 1);
      EXPECT_EQ(answer.cover.count(Verdict::undecided), 0u);
      // It is singular nowhere else: every box has the leg's axes on one line.
      const int along = answer.system.find(std::array{"axis_v1_x", "axis_v2_y", "n_eye_z"}[static_cast<std::size_t>(leg)]);
      for (const CoverBox& b : answer.cover.boxes) ASSERT_NEAR(std::fabs(b.box[along].mid()), 1, 0.01);
    }
  }
}

// --- RSSR: the rod's line against the cranks' circles --------------------------------------------------------------------

TEST(RssrOfParts, HasTheSingularitiesOfItsRodsLine) {
  const double a = 0.5, b = 0.9, h = 0.3, l = 1.25, d = 1;
  for (const SingularitySet set : {SingularitySet::forward, SingularitySet::inverse}) {
    SCOPED_TRACE(to_string(set));
    // The locked crank cannot stop the other where the rod does no work on it.
    const auto f = [&](const Eigen::Vector2d& q) {
      const Vector3d ball1(a * std::cos(q[0]), a * std::sin(q[0]), h), ball2(d, b * std::cos(q[1]), b * std::sin(q[1]));
      const Vector3d rod = ball2 - ball1, v1 = Vector3d::UnitZ().cross(ball1), v2 = Vector3d::UnitX().cross(ball2);
      return Eigen::Vector2d(rod.squaredNorm() - l * l, rod.dot(set == SingularitySet::forward ? v2 : v1));
    };
    const Answer answer = solved("spatial/rssr", set);
    EXPECT_TRUE(answer.cover.complete());
    ASSERT_EQ(answer.cover.count(Verdict::isolated), answer.cover.boxes.size());
    std::vector<Eigen::Vector2d> expected;
    std::mt19937 random(1);
    std::uniform_real_distribution<> angle(-M_PI, M_PI);
    int found = 0;
    for (int k = 0; found < kSamples && k < 10 * kSamples; ++k) {
      Eigen::Vector2d x(angle(random), angle(random));
      for (int step = 0; step < 50; ++step) {
        Eigen::Matrix2d j;
        for (int i = 0; i < 2; ++i) {
          const Eigen::Vector2d by = 1e-6 * Eigen::Vector2d::Unit(i);
          j.col(i) = (f(x + by) - f(x - by)) / 2e-6;
        }
        const Eigen::Vector2d change = j.fullPivLu().solve(f(x));
        x -= change;
        if (change.norm() < 1e-13) break;
      }
      if (!(f(x).norm() < 1e-10)) continue;
      ++found;
      x = {std::remainder(x[0], 2 * M_PI), std::remainder(x[1], 2 * M_PI)};
      EXPECT_EQ(missed(answer, {{{"t", x[0]}, {"p", x[1]}}}), 0u);
      const auto is_near = [&](const Eigen::Vector2d& y) {
        return std::hypot(std::remainder(x[0] - y[0], 2 * M_PI), std::remainder(x[1] - y[1], 2 * M_PI)) < 1e-6;
      };
      if (std::none_of(expected.begin(), expected.end(), is_near)) expected.push_back(x);
    }
    EXPECT_EQ(found, kSamples);
    EXPECT_EQ(answer.cover.points.size(), expected.size());
  }
}

}  // namespace
}  // namespace corank
