// Cusps and nodes on maps of orthogonal 3R arms: against the image of their inverse locus, traced in doubles.
#include "corank/analyze/maps/critical_points.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "corank/analyze/maps/parameter_map.h"
#include "corank/study/model.h"

namespace corank::analyze {
namespace {

study::Question section(const std::string& d3, const std::string& d4, const std::string& r2) {
  return {.model = study::read_model(CORANK_SOURCE_DIR "/models/serial/orthogonal_3r_section.cuik",
                                     {{"d3", d3}, {"d4", d4}, {"r2", r2}})
                       .mechanism,
          .set = symbolic::SingularitySet::cspace};
}

CriticalPoints points_of(const study::Question& question, const Box& region) {
  solve::Control control;
  return critical_points(question, {"rho2", "z"}, region, 1, control);
}

using Place = std::array<double, 2>;

// sin θ3 + cos θ2 (d3 sin θ3 − r2 cos θ3) = 0: for each θ2 two θ3. Where the image turns about.
std::vector<Place> traced_cusps(double d3, double d4, double r2) {
  constexpr int kSamples = 20'000;
  std::vector<Place> list;
  for (const double half : {0.0, M_PI}) {
    const auto at = [&](int i) {
      const double t2 = 2 * M_PI * (i + 0.37) / kSamples, c = std::cos(t2), t3 = std::atan2(r2 * c, 1 + d3 * c) + half,
                   w = d3 + d4 * std::cos(t3);
      return Place{std::pow(1 + w * c, 2) + std::pow(r2 + d4 * std::sin(t3), 2), -w * std::sin(t2)};
    };
    for (int i = 0; i < kSamples; ++i) {
      const Place a = at(i - 1), b = at(i), c = at(i + 1);
      if ((b[0] - a[0]) * (c[0] - b[0]) + (b[1] - a[1]) * (c[1] - b[1]) < 0) list.push_back(b);
    }
  }
  return list;
}

TEST(CriticalPoints, OfOrthogonalArmsAreThoseOfTheTracedCurve) {
  struct Case {
    const char *d3, *d4, *r2;
    std::size_t nodes;  // models/serial/orthogonal_3r_section.cuik
  };
  for (const auto& [d3, d4, r2, nodes] :
       {Case{"2", "1.5", "1", 0}, {"0.91", "0.5", "1.15", 2}, {"0.85", "0.26", "0.59", 0}}) {
    SCOPED_TRACE(d3);
    const CriticalPoints found = points_of(section(d3, d4, r2), {Interval(0, 25), Interval(-4, 4)});
    EXPECT_FALSE(found.forward);
    EXPECT_TRUE(found.cusps_known && found.nodes_known);
    EXPECT_EQ(found.nodes.size(), nodes);
    EXPECT_EQ(found.aspects, "2 aspects, 1 assembly mode, 2 working modes");
    const std::vector<Place> traced = traced_cusps(std::stod(d3), std::stod(d4), std::stod(r2));
    EXPECT_EQ(found.cusps.size(), traced.size());
    for (const Place& p : traced)
      EXPECT_EQ(std::ranges::count_if(found.cusps,
                                      [&](const CriticalPoint& c) {
                                        return c.proven &&
                                               std::hypot(c.sides[0].mid() - p[0], c.sides[1].mid() - p[1]) < 0.01;
                                      }),
                1);
  }
}

TEST(CriticalPoints, AreThoseOfTheMapsRegion) {
  const CriticalPoints upper = points_of(section("0.91", "0.5", "1.15"), {Interval(0, 25), Interval(0.1, 4)});
  EXPECT_EQ(upper.cusps.size(), 2u);
  EXPECT_EQ(upper.nodes.size(), 1u);
  const CriticalPoints left = points_of(section("0.91", "0.5", "1.15"), {Interval(0, 2), Interval(-4, 4)});
  EXPECT_TRUE(left.cusps.empty() && left.nodes.empty() && left.cusps_known && left.nodes_known);
}

// A five-bar with arms that are alike: a folded arm's circle has one image, and cusps lie along it.
TEST(CriticalPoints, AreNotSaidToBeAllWhereTheyFillACurve) {
  solve::Control control;
  const CriticalPoints found =
      critical_points({.model = study::read_model(CORANK_SOURCE_DIR "/models/dextar.cuik").mechanism}, {"J3x", "J3y"},
                      {Interval(-1, 1), Interval(-1, 1)}, 1, control);
  EXPECT_FALSE(found.cusps_known);
  EXPECT_FALSE(found.nodes_known);
}

TEST(CriticalPoints, StandInTheMapAndItsJson) {
  const MapQuestion question{.question = section("0.91", "0.5", "1.15"), .over = {{"rho2", 0, 4}, {"z", -2, 2}}};
  solve::Control control;
  const ParameterMap map = parameter_map(question, {.resolution = 8, .boundary = false, .cusps = true}, control);
  EXPECT_THAT(to_table(map), testing::HasSubstr("inverse cusps         4, proven to be all on the plane"));
  const auto json = nlohmann::json::parse(to_json(map));
  ASSERT_EQ(json["nodes"].size(), 2u);
  EXPECT_EQ(json["nodes"][0][4], true);
  EXPECT_EQ(json["cusps_known"], true);
  const ParameterMap without = parameter_map(question, {.resolution = 8, .boundary = false}, control);
  EXPECT_TRUE(nlohmann::json::parse(to_json(without))["cusps"].is_null());
}

TEST(CriticalPoints, AreRefusedOverOtherPlanes) {
  solve::Control control;
  EXPECT_THROW(critical_points(section("2", "1.5", "1"), {"d3", "z"}, {Interval(1, 2), Interval(0, 1)}, 1, control),
               symbolic::ModelError);
  EXPECT_THROW(critical_points(section("2", "1.5", "1"), {"theta2", "theta3"}, {Interval(1, 2), Interval(0, 1)}, 1, control),
               symbolic::ModelError);
}

}  // namespace
}  // namespace corank::analyze
