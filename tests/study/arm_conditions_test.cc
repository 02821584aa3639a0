// The parts of random arms' inverse sets, against the determinant of a Jacobian by other kinematics. CORANK_SEEDS=1000 looks
// further.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <iostream>
#include <map>
#include <numbers>
#include <optional>
#include <random>

#include "corank/result/files/verification.h"
#include "corank/study/answer.h"
#include "corank/study/model.h"
#include "corank/symbolic/model/evaluate.h"
#include "corank/tests/seeds.h"

namespace corank::study {
namespace {

using std::numbers::pi;
using symbolic::SingularitySet;

// Six revolute joints by rows of Denavit and Hartenberg, their axes parallel or perpendicular to the next; and the
// determinant of the Jacobian by the textbook: columns (z × (p − o), z).
struct RandomArm {
  struct Row {
    double a, d;
    int quarters;  // of a turn, alpha
  };

  explicit RandomArm(unsigned seed) {
    std::mt19937 random(seed);
    const auto below = [&](unsigned n) { return static_cast<int>(random() % n); };
    for (int i = 0; i < 6; ++i) {
      const auto length = [&] { return below(2) == 0 ? 0.0 : (1 + below(40)) / 20.0; };
      rows.push_back({length(), length(), i == 5 ? 0 : below(4) == 0 ? 0 : below(2) == 0 ? 1 : -1});
    }
  }

  /// `after`: of each row, " range [0, 1]".
  std::string text(const std::array<std::string, 6>& after = {}) const {
    std::string text = "[DH]\nstandard\na alpha d theta\n";
    for (std::size_t i = 0; i < 6; ++i)
      text += fmt::format("{} {}deg {} q{}{}\n", rows[i].a, 90 * rows[i].quarters, rows[i].d, i + 1, after[i]);
    return text + "[OUTPUTS]\nhand : pose of tool\n";
  }

  /// Axes that meet in the hand's place: the last three joints do not move it.
  void set_wrist() {
    rows[3].a = 0;
    for (const std::size_t i : {4U, 5U}) rows[i].a = rows[i].d = 0;
  }

  double determinant(const std::map<std::string, double>& q) const { return jacobian(q).determinant(); }
  double position_determinant(const std::map<std::string, double>& q) const {
    return jacobian(q).topLeftCorner<3, 3>().determinant();
  }

  Eigen::Matrix<double, 6, 6> jacobian(const std::map<std::string, double>& q) const {
    Eigen::Matrix3d turned = Eigen::Matrix3d::Identity();
    Eigen::Vector3d at = Eigen::Vector3d::Zero();
    std::vector<Eigen::Vector3d> axes, places;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      axes.emplace_back(turned.col(2));
      places.push_back(at);
      const double t = q.at(fmt::format("q{}", i + 1)), alpha = rows[i].quarters * pi / 2;
      Eigen::Matrix3d about_z, about_x;
      about_z << std::cos(t), -std::sin(t), 0, std::sin(t), std::cos(t), 0, 0, 0, 1;
      about_x << 1, 0, 0, 0, std::cos(alpha), -std::sin(alpha), 0, std::sin(alpha), std::cos(alpha);
      at += turned * (about_z * Eigen::Vector3d(rows[i].a, 0, rows[i].d));
      turned = turned * about_z * about_x;
    }
    Eigen::Matrix<double, 6, 6> jacobian;
    for (std::size_t i = 0; i < axes.size(); ++i)
      jacobian.col(static_cast<Eigen::Index>(i)) << axes[i].cross(at - places[i]), axes[i];
    return jacobian;
  }

  std::vector<Row> rows;
};

double value_of(const symbolic::Component& part, const std::map<std::string, double>& q) {
  if (!part.conditions.empty()) return symbolic::evaluate(part.conditions.front(), q);
  const symbolic::DependentAngle& angle = part.dependent_angle.value();
  return std::sin((q.at(angle.angle) - angle.sign * q.at(angle.other) - angle.quarters * pi / 2) / 2);
}

using Posture = std::map<std::string, double>;

// Between two postures, by bisection.
template <class Function>
std::optional<Posture> zero_between(Posture from, Posture to, const Function& f) {
  const bool positive = f(from) > 0;
  if (positive == (f(to) > 0)) return std::nullopt;
  for (int step = 0; step < 60; ++step) {
    Posture middle = from;
    for (auto& [name, value] : middle) value = (value + to.at(name)) / 2;
    ((f(middle) > 0) == positive ? from : to) = middle;
  }
  return from;
}

/// Postures on parts and on a determinant that these parts are meant to be.
struct Drawn {
  int on_parts = 0, on_determinants = 0;

  void compare(const std::vector<symbolic::Component>& parts, const auto& determinant, const auto& zero) {
    constexpr double kZero = 1e-7;
    for (const symbolic::Component& part : parts)
      for (int trial = 0; trial < 5; ++trial)
        if (const auto at = zero([&](const auto& q) { return value_of(part, q); })) {
          ++on_parts;
          EXPECT_LT(std::fabs(determinant(*at)), kZero) << part.name;
        }
    for (int trial = 0; trial < 10; ++trial)
      if (const auto at = zero(determinant)) {
        ++on_determinants;
        double least = 1;
        for (const symbolic::Component& part : parts) least = std::min(least, std::fabs(value_of(part, *at)));
        EXPECT_LT(least, 1e-4);  // of a factor that is there twice the square root
      }
  }
};

TEST(SetPartsOf, RandomArmsOfSixJointsAreConditionsOnTheirJoints) {
  int arms = 0, with_vectors = 0;
  Drawn drawn;
  for (unsigned seed = 1; seed <= test::seeds(10); ++seed) {
    SCOPED_TRACE(seed);
    const RandomArm arm(seed);
    std::mt19937 random(seed);
    const auto point = [&] {
      Posture q;
      for (int i = 1; i <= 6; ++i) q[fmt::format("q{}", i)] = std::uniform_real_distribution<>(-pi, pi)(random);
      return q;
    };
    const auto zero = [&](const auto& f) { return zero_between(point(), point(), f); };
    const auto determinant = [&](const std::map<std::string, double>& q) { return arm.determinant(q); };
    if (std::fabs(determinant(point())) < 1e-12) continue;  // it is singular everywhere
    const Model robot = parse_model({arm.text(), "arm.cuik"});
    const std::vector<Question> questions =
        parts_of({.model = robot.mechanism, .set = SingularitySet::inverse, .assembly = robot.assembly, .in_parts = true});
    std::vector<symbolic::Component> parts;
    for (const Question& question : questions)
      if (question.part) parts.push_back(std::get<symbolic::Component>(*question.part));
    const auto in_joints = [](const symbolic::Component& part) {
      return part.dependent_angle ||
             (!part.conditions.empty() && part.conditions.front().text().find("_link") == std::string::npos);
    };
    if (parts.empty() || !std::all_of(parts.begin(), parts.end(), in_joints)) {
      ++with_vectors;
      continue;
    }
    ++arms;
    drawn.compare(parts, determinant, zero);
    if (HasFailure()) break;
  }
  std::cout << arms << " arms, " << with_vectors << " with kernel vectors\n";
  EXPECT_EQ(with_vectors, 0);
  EXPECT_GT(drawn.on_parts, 2 * arms);
  EXPECT_GT(drawn.on_determinants, 2 * arms);
}

// Of a position by six joints, which three of them make.
TEST(SetPartsOf, BoundariesOfRandomArmsWithAWristAreConditionsOnThreeJoints) {
  int arms = 0, with_multipliers = 0;
  Drawn drawn;
  for (unsigned seed = 1; seed <= test::seeds(12); ++seed) {
    SCOPED_TRACE(seed);
    RandomArm arm(seed);
    arm.set_wrist();
    std::mt19937 random(seed);
    const auto point = [&] {
      Posture q;
      for (int i = 1; i <= 6; ++i) q[fmt::format("q{}", i)] = std::uniform_real_distribution<>(-pi, pi)(random);
      return q;
    };
    const auto zero = [&](const auto& f) { return zero_between(point(), point(), f); };
    const auto determinant = [&](const Posture& q) { return arm.position_determinant(q); };
    if (std::fabs(determinant(point())) < 1e-12) continue;
    const Model robot = parse_model({arm.text(), "arm.cuik"});
    std::vector<symbolic::Component> parts;
    for (const symbolic::SetPart& part : symbolic::set_parts(robot.mechanism, SingularitySet::boundary))
      if (const symbolic::Component* component = component_of(part)) parts.push_back(*component);
    if (parts.empty()) {
      ++with_multipliers;
      continue;
    }
    ++arms;
    drawn.compare(parts, determinant, zero);
    if (HasFailure()) break;
  }
  std::cout << arms << " arms, " << with_multipliers << " with multipliers\n";
  EXPECT_EQ(with_multipliers, 0);
  EXPECT_GT(arms, 3);
  EXPECT_GT(drawn.on_parts, arms);
  EXPECT_GT(drawn.on_determinants, arms);
}

// Joints 1 and 6 move the robot as a whole, and its hand: no condition is about them. Of the others one or two are locked.
class LargeArm {
 public:
  explicit LargeArm(unsigned seed) : random_(seed), arm_(seed) {
    std::array<std::string, 6> after;
    std::array<int, 4> inner{1, 2, 3, 4};
    std::ranges::shuffle(inner, random_);
    const std::size_t locked = 1 + random_() % 2;
    for (std::size_t k = 0; k < locked; ++k) {
      const double value = (static_cast<int>(random_() % 49) - 24) / 8.0;
      ends_[inner[k]] = {value, value};
    }
    if (random_() % 2 == 0) ends_[0] = {-2, 1};
    if (random_() % 3 == 0) ends_[inner[3]] = {-1, 2.5};
    for (std::size_t i = 0; i < 6; ++i)
      if (ends_[i] != kTurn) after[i] = fmt::format(" range [{}, {}]", ends_[i][0], ends_[i][1]);
    text = arm_.text(after);
  }

  double determinant(const Posture& q) const { return arm_.determinant(q); }
  Posture posture() {
    Posture q;
    for (std::size_t i = 0; i < 6; ++i)
      q[fmt::format("q{}", i + 1)] = std::uniform_real_distribution<>(ends_[i][0], std::nextafter(ends_[i][1], 4))(random_);
    return q;
  }
  /// Where the determinant is 0.
  std::optional<Posture> singular() {
    return zero_between(posture(), posture(), [this](const Posture& q) { return determinant(q); });
  }

  std::string text;

 private:
  static constexpr std::array<double, 2> kTurn{-pi, pi};
  std::mt19937 random_;
  RandomArm arm_;
  std::array<std::array<double, 2>, 6> ends_{kTurn, kTurn, kTurn, kTurn, kTurn, kTurn};
};

bool holds(const result::Result& result, const CoverBox& box, const Posture& q) {
  constexpr double kRounding = 1e-7;
  return std::ranges::all_of(result.angles, [&](const Angle& angle) {
    const auto is_near = [&](int v, double x) {
      return box.box[v].lo() - kRounding <= x && x <= box.box[v].hi() + kRounding;
    };
    const double value = q.at(angle.name);
    return is_near(angle.cosine, std::cos(value)) && is_near(angle.sine, std::sin(value));
  });
}

TEST(SetPartsOf, LargeSetsOfRandomArmsAreProductsInWhichNothingIsLost) {
  constexpr double kZero = 1e-7;
  std::size_t products = 0, incomplete = 0, points = 0, lost = 0, refused = 0, wrong = 0;
  for (unsigned seed = 1; seed <= test::seeds(20); ++seed) {
    SCOPED_TRACE(seed);
    LargeArm arm(seed);
    if (std::fabs(arm.determinant(arm.posture())) < 1e-12) continue;
    const Model robot = parse_model({arm.text, "arm.cuik"});
    solve::Control control({.boxes = 4'000});
    const Systems systems =
        systems_of({.model = robot.mechanism, .set = SingularitySet::inverse, .assembly = robot.assembly}, control);
    const auto* part = systems.parts[0].part ? std::get_if<symbolic::Component>(&*systems.parts[0].part) : nullptr;
    if (!part || !part->factor) continue;
    ++products;
    Options options;
    options.search.surfaces_whole = true;
    options.search.threads = 1;
    const result::Result whole = answer(systems, options, control);
    incomplete += !whole.cover.complete();
    EXPECT_FALSE(whole.free_coordinates.empty());
    for (int trial = 0; trial < 20; ++trial) {
      std::optional<Posture> q = arm.singular();
      if (!q) continue;
      ++points;
      lost += std::ranges::none_of(whole.cover.boxes, [&](const CoverBox& box) { return holds(whole, box, *q); });
      const Posture other = arm.posture();
      for (const std::string& name : whole.free_coordinates) (*q)[name] = other.at(name);
      wrong += std::fabs(arm.determinant(*q)) > kZero;
    }
    const result::Verification verification = result::verify(whole);
    refused += !verification.verified();
  }
  std::cout << fmt::format(
      "{} products, {} not searched to the end; {} points, {} lost; {} results refused, {} no products\n", products,
      incomplete, points, lost, refused, wrong);
  EXPECT_GT(products, 6u);
  EXPECT_GT(points, 20u);
  EXPECT_EQ(lost + refused + wrong, 0u);
}

// The cosine of a joint x would be c_x, and so is called the x of a hand c.
TEST(ArmConditions, TellAHandFromAJointOfALikeName) {
  ModelText file = read_text(CORANK_SOURCE_DIR "/models/serial/puma_560.cuik");
  for (const auto& [from, to] : {std::pair("theta5", "x"),
                                 {"hand : pose", "c : pose"},
                                 {"range [t1, t1]", ""},
                                 {"range [t4, t4]", ""},
                                 {"range [t6, t6]", ""}})
    for (std::size_t at; (at = file.text.find(from)) != std::string::npos;) file.text.replace(at, std::strlen(from), to);
  const result::Result arm = answer({.model = parse_model(file).mechanism, .set = SingularitySet::inverse}, {});
  const auto hand = std::ranges::find(arm.variables, "c_x", &result::ResultVariable::name);
  ASSERT_NE(hand, arm.variables.end());
  ASSERT_EQ(hand->kind, VariableKind::length);
  for (const CoverBox& box : arm.cover.boxes) ASSERT_EQ(box.box[hand - arm.variables.begin()], hand->domain);
  EXPECT_TRUE(result::verify(arm).verified());
}

}  // namespace
}  // namespace corank::study
