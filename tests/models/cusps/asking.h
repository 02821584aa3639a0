// Questions about cusps and nodes, and what is in the answer.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "corank/study/answer.h"
#include "corank/study/model.h"

namespace corank::test {

using symbolic::SingularitySet;
using Place = std::map<std::string, double>;  // coordinates by name, angles in radians
using Constants = std::vector<result::ConstantOverride>;

inline result::Result ask(const symbolic::Mechanism& mechanism, SingularitySet set, const Constants& constants = {}) {
  study::Question question;
  question.model = mechanism;
  question.set = set;
  question.constants = constants;
  return study::answer(question);
}

inline result::Result ask(const std::string& model, SingularitySet set, const Constants& constants = {}) {
  return ask(study::read_model(CORANK_SOURCE_DIR "/models/" + model + ".cuik", constants).mechanism, set, constants);
}

inline Place place_of(const result::Result& result, const CoverBox& point) {
  Place place;
  for (int v = 0; v < result.configuration_size; ++v)
    place[result.variables[static_cast<std::size_t>(v)].name] = point.box[static_cast<std::size_t>(v)].mid();
  for (const Angle& a : result.angles)
    place[a.name] =
        std::atan2(point.box[static_cast<std::size_t>(a.sine)].mid(), point.box[static_cast<std::size_t>(a.cosine)].mid());
  return place;
}

inline double distance(double a, double b, bool angle) {
  return angle ? std::fabs(std::remainder(a - b, 2 * M_PI)) : std::fabs(a - b);
}

inline bool is_at(const result::Result& result, const CoverBox& point, const Place& expected, double tolerance) {
  const Place place = place_of(result, point);
  return std::all_of(expected.begin(), expected.end(), [&](const auto& e) {
    const bool angle =
        std::any_of(result.angles.begin(), result.angles.end(), [&](const Angle& a) { return a.name == e.first; });
    return distance(place.at(e.first), e.second, angle) < tolerance;
  });
}

/// All points are isolated, the cover is complete, and each of these places is one of them, none lost, none false.
inline void expect_points(const result::Result& result, const std::vector<Place>& expected, double tolerance = 1e-6) {
  EXPECT_TRUE(result.cover.complete());
  EXPECT_EQ(result.cover.boxes.size(), expected.size());
  EXPECT_EQ(result.cover.points.size(), expected.size());
  for (const CoverBox& point : result.cover.points) EXPECT_EQ(point.verdict, Verdict::isolated);
  for (const Place& place : expected) {
    const auto n = std::count_if(result.cover.points.begin(), result.cover.points.end(),
                                 [&](const CoverBox& p) { return is_at(result, p, place, tolerance); });
    EXPECT_EQ(n, 1);
  }
}

}  // namespace corank::test
