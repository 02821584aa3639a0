// Workspace boundaries against closed forms: sampled configurations are in boxes of their part, and what is said of the
// passage there is what second derivatives in floating point say.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <random>
#include <set>

#include "corank/core/dense.h"
#include "corank/result/files/verification.h"
#include "corank/study/answer.h"
#include "corank/study/model.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/sets/boundary.h"
#include "corank/tests/seeds.h"

namespace corank {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;
constexpr double kPi = std::numbers::pi;

struct Sample {
  std::map<std::string, double> at;
  std::string part;
  Passage passage = Passage::unproven;  ///< unproven: too close to another limit or to no answer
  Vector2d side = Vector2d::Zero();     ///< where a barrier leaves the outputs
};

result::Result boundary_of(const std::string& file, const std::vector<std::string>& outputs = {}) {
  study::Question question{.model = symbolic::read_model(CORANK_SOURCE_DIR "/models/" + file),
                           .set = symbolic::SingularitySet::boundary};
  result::put_in(outputs, question.model);
  question.outputs = outputs;
  return study::answer(question);
}

/// Of a part's name that without the condition: which limits are reached.
std::string limits_of(const result::Result& part) { return part.part.substr(0, part.part.find(':')); }

std::size_t choices_of_limits(const result::Result& result) {
  std::set<std::string> names;
  for (const result::Result& part : result.parts) names.insert(limits_of(part));
  return names.size();
}

/// What the samples found.
struct Tally {
  std::size_t proven = 0, unproven = 0, barriers = 0, traversable = 0;
};

Tally expect_found(const result::Result& result, const std::vector<Sample>& samples) {
  constexpr double kRoom = 1e-9;
  Tally tally;
  EXPECT_TRUE(result.cover.complete());
  EXPECT_FALSE(samples.empty());
  std::map<std::string, std::vector<const CoverBox*>> boxes;
  for (const CoverBox& box : result.cover.boxes)
    boxes[limits_of(result.parts[static_cast<std::size_t>(box.part)])].push_back(&box);
  for (const Sample& sample : samples) {
    std::vector<double> p;
    for (const result::ResultVariable& v : result.variables) {
      const bool plain = sample.at.contains(v.name);
      const double value = sample.at.at(plain ? v.name : v.name.substr(2));
      p.push_back(plain ? value : v.name[0] == 'c' ? std::cos(value) : std::sin(value));
    }
    const auto holds = [&](const CoverBox* box) {
      for (std::size_t j = 0; j < p.size(); ++j)
        if (p[j] < box->box[j].lo() - kRoom || p[j] > box->box[j].hi() + kRoom) return false;
      return true;
    };
    bool found = false, said = false;
    for (const CoverBox* box : boxes[sample.part]) {
      if (!holds(box)) continue;
      found = true;
      if (sample.passage == Passage::unproven || box->passage == Passage::unproven) continue;
      said = true;
      EXPECT_EQ(box->passage, sample.passage) << sample.part;
      if (sample.passage == Passage::barrier && box->side.size() == 2) {
        EXPECT_GT(box->side[0] * sample.side[0] + box->side[1] * sample.side[1], 0) << sample.part;
      }
    }
    EXPECT_TRUE(found) << sample.part << " lost a configuration";
    if (sample.passage == Passage::unproven) continue;
    ++(said ? tally.proven : tally.unproven);
    ++(sample.passage == Passage::barrier ? tally.barriers : tally.traversable);
  }
  return tally;
}

// Of a form's numbers and the normal that it belongs to, n·ü = −form.
void set_passage(const VectorXd& form, const Vector2d& normal, double least, Sample& sample) {
  if (form.cwiseAbs().minCoeff() < least || normal.norm() < least) return;
  const bool definite = (form.array() > 0).all() || (form.array() < 0).all();
  sample.passage = definite ? Passage::barrier : Passage::traversable;
  sample.side = form[0] > 0 ? -normal : normal;
}

/// An arm of joints that turn in the plane.
struct Arm {
  std::vector<double> lengths, lower, upper;

  std::size_t size() const { return lengths.size(); }
  Vector2d end(const std::vector<double>& t) const {
    Vector2d p(0, 0);
    double angle = 0;
    for (std::size_t i = 0; i < size(); ++i) angle += t[i], p += lengths[i] * Vector2d(std::cos(angle), std::sin(angle));
    return p;
  }
  // The end less the joint's place; turned by a quarter it is ∂end/∂t_j.
  Vector2d lever(const std::vector<double>& t, std::size_t j) const {
    std::vector<double> before = t;
    Arm shorter{lengths, {}, {}};
    for (std::size_t i = j; i < size(); ++i) shorter.lengths[i] = 0;
    return end(t) - shorter.end(before);
  }
  static Vector2d turned(const Vector2d& v) { return {-v[1], v[0]}; }

  bool inside(const std::vector<double>& t, double room) const {
    for (std::size_t i = 0; i < size(); ++i)
      if (t[i] < lower[i] + room || t[i] > upper[i] - room) return false;
    return true;
  }

  // The configuration t, which is one of the boundary's part: −1 joint at its lower limit, 1 at its upper, 0 at none.
  Sample sample(const std::vector<double>& t, const std::vector<int>& at) const {
    Sample s;
    const Vector2d p = end(t);
    s.at = {{"x", p[0]}, {"y", p[1]}};
    std::vector<std::size_t> moving;
    std::vector<double> slack;
    Vector2d direction(0, 0);
    bool clear = true;
    for (std::size_t i = 0; i < size(); ++i) {
      s.at["t" + std::to_string(i + 1)] = t[i];
      if (at[i] != 0) {
        s.part +=
            (s.part.empty() ? "t" : ", t") + std::to_string(i + 1) + " at its " + (at[i] > 0 ? "upper" : "lower") + " limit";
        continue;
      }
      moving.push_back(i);
      clear = clear && t[i] > lower[i] + 0.05 && t[i] < upper[i] - 0.05;
      if (lever(t, i).norm() > direction.norm()) direction = lever(t, i);
    }
    if (s.part.empty()) s.part = "no limit";
    if (!clear) return s;
    const Vector2d n = direction.normalized();
    // ∂²end/∂t_i∂t_j = −lever of the later joint. v: rates that keep the end.
    const auto m = static_cast<Eigen::Index>(moving.size());
    MatrixXd hessian(m, m), jacobian(2, m);
    for (Eigen::Index a = 0; a < m; ++a) {
      const std::size_t i = moving[static_cast<std::size_t>(a)];
      jacobian.col(a) = turned(lever(t, i));
      for (Eigen::Index b = 0; b < m; ++b)
        hessian(a, b) = -n.dot(lever(t, std::max(i, moving[static_cast<std::size_t>(b)])));
    }
    VectorXd form(0);
    if (m > 1) {
      const MatrixXd v = decompose(jacobian).v.rightCols(m - 1);
      form = -symmetric_eigen(v.transpose() * hessian * v).values;
    }
    for (std::size_t i = 0; i < size(); ++i) {
      if (at[i] == 0) continue;
      form.conservativeResize(form.size() + 1);
      form[form.size() - 1] = at[i] * n.dot(turned(lever(t, i)));  // ẗ_i = ∓τ²
    }
    set_passage(form, n, 0.03, s);
    return s;
  }
};

std::vector<double> steps(double from, double to, int n) {
  std::vector<double> list;
  for (int i = 0; i <= n; ++i) list.push_back(from + (to - from) * (i + 0.013) / (n + 0.026));
  return list;
}

// An angle as the limits count it.
double wrapped(double t) { return std::remainder(t, 2 * kPi); }

TEST(WorkspaceBoundary, OfATwoLinkArmHasItsClosedForm) {
  const Arm arm{{1, 0.8}, {-kPi / 6, -kPi / 4}, {kPi / 2, 3 * kPi / 4}};
  std::vector<Sample> samples;
  for (const double t1 : steps(arm.lower[0], arm.upper[0], 60)) {
    samples.push_back(arm.sample({t1, 0}, {0, 0}));
    for (const int side : {-1, 1}) samples.push_back(arm.sample({t1, side < 0 ? arm.lower[1] : arm.upper[1]}, {0, side}));
  }
  for (const double t2 : steps(arm.lower[1], arm.upper[1], 60))
    for (const int side : {-1, 1}) samples.push_back(arm.sample({side < 0 ? arm.lower[0] : arm.upper[0], t2}, {side, 0}));
  const result::Result result = boundary_of("planar/arm_2r_limits.cuik");
  EXPECT_EQ(choices_of_limits(result), 5u);
  const Tally tally = expect_found(result, samples);
  EXPECT_EQ(tally.traversable, 0u) << "as many joints as outputs: the output never passes";
  EXPECT_GT(tally.barriers, 200u);
  EXPECT_LE(tally.unproven, tally.proven / 50);
  // Nothing else: every box lies along one of the arcs.
  for (const CoverBox& box : result.cover.boxes) {
    if (box.verdict == Verdict::undecided) continue;
    const double x = box.box[0].mid(), y = box.box[1].mid(), r = std::hypot(x, y);
    double off = std::fabs(r - 1.8);
    for (const double t2 : {arm.lower[1], arm.upper[1]})
      off = std::min(off, std::fabs(r - std::sqrt(1.64 + 1.6 * std::cos(t2))));
    for (const double t1 : {arm.lower[0], arm.upper[0]})
      off = std::min(off, std::fabs(std::hypot(x - std::cos(t1), y - std::sin(t1)) - 0.8));
    EXPECT_LT(off, 0.05);
  }
}

TEST(WorkspaceBoundary, OfAThreeLinkArmHasBarriersAndPassagesWhereTheFormSaysSo) {
  const Arm arm{{1, 0.8, 0.5}, {-kPi / 3, -3 * kPi / 4, -kPi / 2}, {2 * kPi / 3, 3 * kPi / 4, kPi / 2}};
  const auto end_of = [&](std::size_t i, int side) { return side < 0 ? arm.lower[i] : arm.upper[i]; };
  std::vector<Sample> samples;
  const auto add = [&](std::vector<double> t, const std::vector<int>& at) {
    for (double& angle : t) angle = wrapped(angle);
    if (arm.inside(t, -1e-12)) samples.push_back(arm.sample(t, at));
  };
  for (const double t1 : steps(arm.lower[0], arm.upper[0], 40))
    for (const double t2 : {0.0, kPi})
      for (const double t3 : {0.0, kPi}) add({t1, t2, t3}, {0, 0, 0});
  for (const int side : {-1, 1}) {
    // The third joint stays: the end is on the line through the first two. The second: on that through the first and third.
    const double t3 = end_of(2, side), t2 = end_of(1, side);
    const double behind2 = std::atan2(0.5 * std::sin(t3), 0.8 + 0.5 * std::cos(t3));
    const double behind3 = std::atan2(0.8 * std::sin(t2), 1 + 0.8 * std::cos(t2)) - t2;
    for (const double t1 : steps(arm.lower[0], arm.upper[0], 40))
      for (const double turn : {0.0, kPi}) {
        add({t1, -behind2 + turn, t3}, {0, 0, side});
        add({t1, t2, behind3 + turn}, {0, side, 0});
      }
    for (const double t : steps(arm.lower[1], arm.upper[1], 40))
      for (const double folded : {0.0, kPi}) add({end_of(0, side), t, folded}, {side, 0, 0});
    for (const int other : {-1, 1}) {
      for (const double t : steps(arm.lower[0], arm.upper[0], 40))
        add({t, end_of(1, side), end_of(2, other)}, {0, side, other});
      for (const double t : steps(arm.lower[1], arm.upper[1], 40))
        add({end_of(0, side), t, end_of(2, other)}, {side, 0, other});
      for (const double t : steps(arm.lower[2], arm.upper[2], 40))
        add({end_of(0, side), end_of(1, other), t}, {side, other, 0});
    }
  }
  const result::Result result = boundary_of("planar/arm_3r_limits.cuik");
  EXPECT_EQ(choices_of_limits(result), 1u + 6 + 12);
  const Tally tally = expect_found(result, samples);
  EXPECT_GT(tally.traversable, 100u);
  EXPECT_GT(tally.barriers, 100u);
  EXPECT_LE(tally.unproven, tally.proven / 50);
}

/// The platform of planar/3rpr_limits.cuik.
struct Platform {
  std::array<double, 3> anchor{-1, 1, 2}, arm{-1, -1, 1}, lower{std::sqrt(2.0), std::sqrt(2.0), 1}, upper{2, 2, 3};

  Vector2d leg(std::size_t i, const Vector2d& p, double phi) const {
    return p + arm[i] * Vector2d(std::cos(phi), std::sin(phi)) - Vector2d(anchor[i], 0);
  }
  // Half of ∂(length²)/∂φ and its derivative by φ.
  double slope(std::size_t i, const Vector2d& p, double phi) const {
    return leg(i, p, phi).dot(arm[i] * Vector2d(-std::sin(phi), std::cos(phi)));
  }
  double bend(std::size_t i, const Vector2d& p, double phi) const {
    return arm[i] * arm[i] - leg(i, p, phi).dot(arm[i] * Vector2d(std::cos(phi), std::sin(phi)));
  }

  // Nothing where a leg is beyond its limits.
  std::optional<Sample> sample(const Vector2d& p, double phi, const std::array<int, 3>& at) const {
    Sample s;
    s.at = {{"x", p[0]}, {"y", p[1]}, {"phi", phi}};
    bool clear = true;
    std::vector<std::size_t> active;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::string name = "rho" + std::to_string(i + 1);
      const double length = leg(i, p, phi).norm();
      s.at[name] = length;
      if (at[i] != 0) {
        active.push_back(i);
        s.part += (s.part.empty() ? "" : ", ") + name + " at its " + (at[i] > 0 ? "upper" : "lower") + " limit";
        continue;
      }
      if (length < lower[i] || length > upper[i]) return std::nullopt;
      clear = clear && length > lower[i] + 0.02 && length < upper[i] - 0.02;
    }
    if (!clear) return s;
    // Of λ·(length² − …)/2 the velocities that keep the output are those of φ where one leg is at its limit.
    VectorXd form(2);
    Vector2d normal;
    const auto slack = [&](std::size_t i) { return at[i] > 0 ? 1.0 : -1.0; };  // of −λ (length²)¨/2
    if (active.size() == 1) {
      normal = leg(active[0], p, phi);
      form << bend(active[0], p, phi), slack(active[0]);
    } else {
      const std::size_t i = active[0], j = active[1];
      const double a = slope(j, p, phi), b = -slope(i, p, phi);
      normal = a * leg(i, p, phi) + b * leg(j, p, phi);
      form << a * slack(i), b * slack(j);
    }
    set_passage(form, normal, 0.05, s);
    return s;
  }
};

TEST(WorkspaceBoundary, OfAPlatformOnLegsWithRangesHasEverySampledConfiguration) {
  const Platform robot;
  std::vector<Sample> samples;
  const auto add = [&](const Vector2d& p, double phi, const std::array<int, 3>& at) {
    if (const auto s = robot.sample(p, phi, at)) samples.push_back(*s);
  };
  for (std::size_t i = 0; i < 3; ++i)
    for (const int side : {-1, 1}) {
      std::array<int, 3> at{};
      at[i] = side;
      const double r = side < 0 ? robot.lower[i] : robot.upper[i];
      // Leg and platform in line.
      for (const double angle : steps(-kPi, kPi, 300))
        for (const double turn : {0.0, kPi}) {
          const Vector2d along(std::cos(angle), std::sin(angle));
          const double phi = wrapped(angle + turn);
          add(Vector2d(robot.anchor[i], 0) + r * along - robot.arm[i] * Vector2d(std::cos(phi), std::sin(phi)), phi, at);
        }
      for (std::size_t j = i + 1; j < 3; ++j)
        for (const int other : {-1, 1}) {
          std::array<int, 3> both = at;
          both[j] = other;
          const double s = other < 0 ? robot.lower[j] : robot.upper[j];
          for (const double phi : steps(-kPi, kPi, 300)) {
            // The middle is on two circles.
            const Vector2d direction(std::cos(phi), std::sin(phi));
            const Vector2d c = Vector2d(robot.anchor[i], 0) - robot.arm[i] * direction,
                           d = Vector2d(robot.anchor[j], 0) - robot.arm[j] * direction;
            const double distance = (d - c).norm(), x = (r * r - s * s + distance * distance) / (2 * distance);
            if (x * x > r * r) continue;
            const Vector2d e = (d - c) / distance;
            for (const double sign : {-1.0, 1.0})
              add(c + x * e + sign * std::sqrt(r * r - x * x) * Arm::turned(e), phi, both);
          }
        }
    }
  const result::Result result = boundary_of("planar/3rpr_limits.cuik");
  EXPECT_EQ(choices_of_limits(result), 1u + 6 + 12);
  EXPECT_EQ(result.parts[0].cover.boxes.size(), 0u) << "legs of no length";
  const Tally tally = expect_found(result, samples);
  EXPECT_GT(tally.traversable, 100u);
  EXPECT_GT(tally.barriers, 100u);
  EXPECT_LE(tally.unproven, tally.proven / 50);
}

TEST(WorkspaceBoundary, OfDextarWithLimitedInputsHasEverySampledConfiguration) {
  constexpr double l = 0.9, d = 1.18;
  const auto bar = [](double t) { return Vector2d(l * std::cos(t), l * std::sin(t)); };
  const Vector2d base1(d, 0), base5(0, 0);
  std::vector<Sample> samples;
  // J3 at p, with J2 and J4 there; each angle in (−π, π].
  const auto add = [&](const Vector2d& p, const Vector2d& j2, const Vector2d& j4, const std::string& part, int slack_sign,
                       const Vector2d& normal, double along) {
    const auto angle = [](const Vector2d& v) { return std::atan2(v[1], v[0]); };
    const double t2 = angle(j2 - base1), t5 = angle(j4 - base5);
    if (t2 < -1e-9 || t5 < -1e-9) return;
    Sample s;
    s.at = {{"J3x", p[0]}, {"J3y", p[1]}, {"theta2", t2}, {"theta3", angle(p - j2)}, {"theta4", angle(j4 - p)},
            {"theta5", t5}};
    s.part = part;
    const bool two = part.find("theta2") != std::string::npos, five = part.find("theta5") != std::string::npos;
    const auto clear = [](double t) { return t > 0.02 && t < kPi - 0.02; };
    if ((two || clear(t2)) && (five || clear(t5)) && std::fabs(along) > 0.03) {
      s.passage = Passage::barrier;
      s.side = slack_sign * along * normal;
    }
    samples.push_back(s);
  };
  // The elbow between two points, on either side.
  const auto elbows = [&](const Vector2d& a, const Vector2d& p) {
    std::vector<Vector2d> list;
    const Vector2d way = p - a;
    const double height2 = l * l - way.squaredNorm() / 4;
    if (way.norm() < 1e-6 || height2 < 0) return list;
    for (const double sign : {-1.0, 1.0})
      list.push_back(a + way / 2 + sign * std::sqrt(height2) * Arm::turned(way).normalized());
    return list;
  };
  for (const double t : steps(-kPi, kPi, 240)) {
    for (const double limit : {0.0, kPi}) {
      const std::string word = limit == 0 ? " at its lower limit" : " at its upper limit";
      // An input at its limit: its elbow stays, J3 is on a circle about it. Opening it moves J3 along that circle's normal.
      {
        const Vector2d j2 = base1 + bar(limit), p = j2 + bar(t), n = bar(t) / l;
        const double along = n.dot(Arm::turned(bar(limit))) * (limit == 0 ? 1 : -1);
        for (const Vector2d& j4 : elbows(base5, p)) add(p, j2, j4, "theta2" + word, 1, n, along);
      }
      const Vector2d j4 = base5 + bar(limit), p = j4 + bar(t), n = bar(t) / l;
      const double along = n.dot(Arm::turned(bar(limit))) * (limit == 0 ? 1 : -1);
      for (const Vector2d& j2 : elbows(base1, p)) add(p, j2, j4, "theta5" + word, 1, n, along);
    }
    // An arm stretched: J3 can only come closer.
    for (const Vector2d& j4 : elbows(base5, base1 + 2 * bar(t)))
      add(base1 + 2 * bar(t), base1 + bar(t), j4, "no limit", -1, bar(t), 1);
    for (const Vector2d& j2 : elbows(base1, base5 + 2 * bar(t)))
      add(base5 + 2 * bar(t), j2, base5 + bar(t), "no limit", -1, bar(t), 1);
  }
  const result::Result result = boundary_of("dextar_limits.cuik");
  EXPECT_EQ(choices_of_limits(result), 5u);
  const Tally tally = expect_found(result, samples);
  EXPECT_GT(tally.barriers, 300u);
  EXPECT_LE(tally.unproven, tally.proven / 50);
}

study::Question about_boundary(symbolic::Mechanism model) {
  return {.model = std::move(model), .set = symbolic::SingularitySet::boundary};
}

// Uncut, as the program does where no sigma is given; or cut.
result::Result surface_of(const study::Model& model, const std::optional<double>& sigma = std::nullopt) {
  study::Options options;
  options.search.sigma = sigma;
  options.search.surfaces_whole = !sigma;
  return study::answer(about_boundary(model.mechanism), options);
}

// A Gough platform in one orientation, its legs' lengths limited: with a leg at its limit the output moves to one side of
// the sphere on which the platform's joint is.
TEST(WorkspaceBoundary, OfAPlatformInOneOrientationIsThatOfItsLegs) {
  const std::string text = R"([CONSTANTS]
r := 3/5
[LINKS]
base : point A1 (1, 0, 0) point A2 (0, 1, 0) point A3 (-1, 0, 0) point A4 (-1/2, -1, 0)
  point A5 (1/5, -1, 0) point A6 (1, -1/2, 0)
plate : point C (0, 0, 0) point B1 (r, 1/5, 0) point B2 (1/5, r, 0) point B3 (-r, 1/5, 0) point B4 (-r, -1/5, 0)
  point B5 (0, -r, 0) point B6 (r, -1/5, 0)
[JOINTS]
)";
  std::string legs;
  for (int i = 1; i <= 6; ++i) legs += fmt::format("sph_prs_sph leg{0} : base A{0} plate B{0} range [1, 3/2] actuated\n", i);
  const study::Model model = study::parse_model(
      {text + legs + "[OUTPUTS]\nP : pose of plate.C range x [-2, 2] y [-2, 2] z [0, 2] keeps Rz(1/5)*Rx(1/10)\n",
       "gough.cuik"});
  const result::Result result = surface_of(model, 0.3);
  EXPECT_TRUE(result.cover.complete());
  EXPECT_TRUE(result::verify(result).verified());
  EXPECT_EQ(choices_of_limits(result), 13u);
  // a_i and R b_i.
  const Eigen::Matrix3d turn =
      (Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitX()))
          .toRotationMatrix();
  const std::array<Eigen::Vector3d, 6> a{{{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {-0.5, -1, 0}, {0.2, -1, 0}, {1, -0.5, 0}}},
      b{{{0.6, 0.2, 0}, {0.2, 0.6, 0}, {-0.6, 0.2, 0}, {-0.6, -0.2, 0}, {0, -0.6, 0}, {0.6, -0.2, 0}}};
  const auto leg = [&](std::size_t i, const Eigen::Vector3d& p) { return Eigen::Vector3d(p + turn * b[i] - a[i]); };
  std::array<int, 3> at{};
  for (std::size_t v = 0; v < result.variables.size(); ++v)
    for (int k = 0; k < 3; ++k)
      if (result.variables[v].name == std::array{"P_x", "P_y", "P_z"}[k]) at[k] = static_cast<int>(v);
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  std::size_t samples = 0, barriers = 0;
  for (int k = 0; k < 4000; ++k) {
    const std::size_t i = k % 6;
    const bool upper = k % 12 < 6;
    const Eigen::Vector3d direction = Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized();
    const Eigen::Vector3d p = a[i] - turn * b[i] + (upper ? 1.5 : 1.0) * direction;
    bool inside = p[2] > 0 && p.cwiseAbs().maxCoeff() < 2;
    for (std::size_t j = 0; j < 6; ++j) inside = inside && (j == i || (leg(j, p).norm() > 1 && leg(j, p).norm() < 1.5));
    if (!inside) continue;
    ++samples;
    bool found = false;
    for (const CoverBox& box : result.cover.boxes) {
      bool holds = limits_of(result.parts[static_cast<std::size_t>(box.part)]) ==
                   fmt::format("leg{} at its {} limit", i + 1, upper ? "upper" : "lower");
      for (int j = 0; j < 3; ++j) holds = holds && box.box[at[j]].lo() - 1e-9 <= p[j] && p[j] <= box.box[at[j]].hi() + 1e-9;
      if (!holds) continue;
      found = true;
      EXPECT_NE(box.passage, Passage::traversable);
      if (box.passage != Passage::barrier) continue;
      ++barriers;
      const Eigen::Vector3d side(box.side[0], box.side[1], box.side[2]);
      EXPECT_GT((upper ? -1 : 1) * side.dot(leg(i, p)), 0) << "towards lengths that the leg can have";
    }
    EXPECT_TRUE(found) << p.transpose();
  }
  EXPECT_GT(samples, 50u);
  EXPECT_GT(barriers, 50u);
}

// The wrist of a PUMA 560 does not move its hand's place: the boundary is where the forearm is on a line with the upper arm.
TEST(WorkspaceBoundary, OfAnArmWithAWristIsThatOfItsOtherJoints) {
  const study::Model model = study::read_model(CORANK_SOURCE_DIR "/models/serial/puma_560.cuik");
  const result::Result result = surface_of(model);
  EXPECT_TRUE(result.cover.complete());
  EXPECT_EQ(result.cover.count(Verdict::undecided), 0u);
  EXPECT_LT(result.cover.boxes.size(), 5000u);
  EXPECT_TRUE(result::verify(result).verified());
  const auto side = [&](const CoverBox& box, const std::string& angle) {
    const auto own = std::ranges::find(result.angles, angle, &Angle::name);
    return std::pair(box.box[static_cast<std::size_t>(own->cosine)], box.box[static_cast<std::size_t>(own->sine)]);
  };
  const double elbow = std::atan2(-0.4318, 0.0203);
  for (const double t2 : steps(-kPi, kPi, 30))
    for (const double t3 : {elbow, elbow + kPi})
      EXPECT_TRUE(std::ranges::any_of(result.cover.boxes, [&](const CoverBox& box) {
        const auto holds = [&](const std::string& name, double t) {
          const auto [c, s] = side(box, name);
          return std::fabs(c.mid() - std::cos(t)) <= c.width() / 2 + 1e-9 &&
                 std::fabs(s.mid() - std::sin(t)) <= s.width() / 2 + 1e-9;
        };
        return holds("theta2", t2) && holds("theta3", t3);
      })) << t2;
}

// An arm of a turning and a sliding joint whose base is given by lengths of one value, with an equation in these alone.
TEST(WorkspaceBoundary, LeavesOutEquationsInHeldCoordinates) {
  const result::Result result = study::answer(
      {.model = symbolic::parse_model("[SYSTEM VARS]\nx : [-9, 9]\ny : [-9, 9]\nc : [3/5, 3/5]\ns : [4/5, 4/5]\nr : [0, 9]\n"
                                      "t ~\n[SYSTEM EQS]\nc^2 + s^2 = 1;\nx = r*cos(t) + c;\ny = r*sin(t) + s;\n"
                                      "[OUTPUTS] x, y\n[LIMITS]\nr : [1, 2]\n",
                                      "base.cuik"),
       .set = symbolic::SingularitySet::boundary});
  EXPECT_TRUE(result.cover.complete());
  EXPECT_EQ(result.cover.count(Verdict::undecided), 0u);
  EXPECT_TRUE(result::verify(result).verified());
  for (const double r : {1.0, 2.0})
    for (double t = -3; t < 3.1; t += 0.1) {
      const double x = r * std::cos(t) + 0.6, y = r * std::sin(t) + 0.8;
      const auto holds = [&](const CoverBox& b) {
        return b.box[0].lo() <= x && x <= b.box[0].hi() && b.box[1].lo() <= y && y <= b.box[1].hi() &&
               b.passage == Passage::barrier;
      };
      EXPECT_TRUE(std::ranges::any_of(result.cover.boxes, holds)) << r << " " << t;
    }
}

}  // namespace
}  // namespace corank
