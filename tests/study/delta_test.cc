// A Delta with both rods of each parallelogram, in its mode of translations: its matrix decomposes into the robot's own
// singularities and those of its constraints. Configurations by closed forms that know nothing of corank.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>

#include "corank/study/answer.h"
#include "corank/study/model.h"
#include "corank/symbolic/sets/determinant_factors.h"
#include "corank/tests/cover_lookup.h"
#include "corank/tests/study/samples.h"

namespace corank::study {
namespace {

using symbolic::SingularitySet;

constexpr double kBase = 1, kPlatform = 0.5, kArm = 1, kRod = 2, kLeast = -1, kGreatest = 1.5;  // the model's

Question delta(SingularitySet set) {
  ModelText file = read_text(CORANK_SOURCE_DIR "/models/platforms/delta.cuik");
  const auto replace = [&](const std::string& from, const std::string& to) {
    std::size_t at = 0, places = 0;
    for (; (at = file.text.find(from, at)) != std::string::npos; at += to.size(), ++places)
      file.text.replace(at, from.size(), to);
    EXPECT_GT(places, 0u) << from;
  };
  replace("actuated ", "actuated range [-1, 3/2] ");
  replace("P : position of platform.C", "P : pose of platform.C keeps id");
  const Model robot = parse_model(file);
  return {.model = robot.mechanism, .set = set, .assembly = robot.assembly};
}

struct Place {
  double x, y, z;
};

// In the frame of leg k.
Place turned(const Place& p, int k) {
  const double angle = -2 * k * std::numbers::pi / 3, c = std::cos(angle), s = std::sin(angle);
  return {c * p.x - s * p.y, s * p.x + c * p.y, p.z};
}

bool is_in_range(double angle) { return angle > kLeast && angle < kGreatest; }

// The arm's angles at which a rod reaches from the elbow to the platform, within the range.
std::vector<double> arm_angles(const Place& platform, int k) {
  const Place p = turned(platform, k);
  const double u = p.x + kPlatform - kBase, far = std::hypot(u, p.z),
               share = (u * u + p.y * p.y + p.z * p.z + kArm * kArm - kRod * kRod) / (2 * kArm * far);
  std::vector<double> angles;
  if (std::fabs(share) > 1) return angles;
  for (const double turn : {std::acos(share), -std::acos(share)})
    if (const double angle = std::remainder(std::atan2(-p.z, u) + turn, 2 * std::numbers::pi); is_in_range(angle))
      angles.push_back(angle);
  return angles;
}

// Its rods in the plane of the arm and the axis of its motor.
Place singular_leg(double angle, double along, double sign, int k) {
  const double across = sign * std::sqrt(kRod * kRod - along * along);
  return turned({kBase - kPlatform + (kArm + along) * std::cos(angle), across, -(kArm + along) * std::sin(angle)}, -k);
}

TEST(Delta, InItsModeOfTranslationsHasPartsOfThreeRows) {
  for (const auto& [set, count] : {std::pair(SingularitySet::forward, 2u), std::pair(SingularitySet::inverse, 4u)}) {
    const std::vector<Question> parts = parts_of(delta(set));
    EXPECT_EQ(parts.size(), count);
    for (const Question& part : parts) EXPECT_FALSE(std::get<symbolic::Component>(*part.part).block) << text(*part.part);
    const symbolic::Mechanism& model = parts[0].model;  // those that divide C-space into aspects are the same
    EXPECT_EQ(symbolic::determinant_factors(model, symbolic::locked_matrix(model, set)).size(), count);
  }
}

TEST(Delta, HasNoForwardSingularitiesWithinItsMotorsRanges) {
  const result::Result result = answer(delta(SingularitySet::forward), {});
  EXPECT_TRUE(result.cover.complete());
  EXPECT_TRUE(result.cover.boxes.empty());
}

TEST(Delta, LosesNoInverseSingularity) {
  const result::Result result = answer(delta(SingularitySet::inverse), {});
  EXPECT_TRUE(result.cover.complete());
  EXPECT_EQ(result.cover.count(Verdict::undecided), 0u);
  const std::vector<std::string> known{"c_P_turn_z", "s_P_turn_z", "c_P_turn_y", "s_P_turn_y", "c_P_turn_x", "s_P_turn_x"};
  for (std::size_t j = 0; j < known.size(); ++j) ASSERT_EQ(result.variables[j].name, known[j]);
  const test::CoverLookup lookup(result.cover);
  std::mt19937_64 random(7);
  const auto between = [&](double low, double high) { return std::uniform_real_distribution<>(low, high)(random); };
  int found = 0, lost = 0;
  for (int trial = 0; trial < 60000; ++trial) {
    const int singular = trial % 3;
    const double angle = between(kLeast, kGreatest);
    const Place platform = singular_leg(angle, between(-kRod, kRod), trial % 2 == 0 ? 1 : -1, singular);
    std::array<std::vector<double>, 3> angles;
    for (int k = 0; k < 3; ++k) angles[k] = k == singular ? std::vector{angle} : arm_angles(platform, k);
    for (const double a : angles[0])
      for (const double b : angles[1])
        for (const double c : angles[2]) {
          const std::vector<double> place{1,           0,           1,           0,           1,           0,
                                          std::cos(a), std::sin(a), std::cos(b), std::sin(b), std::cos(c), std::sin(c)};
          ++found;
          lost += !lookup.holds(place, test::kSampleTolerance);
        }
  }
  EXPECT_GT(found, 100);
  EXPECT_EQ(lost, 0) << "of " << found;
}

}  // namespace
}  // namespace corank::study
