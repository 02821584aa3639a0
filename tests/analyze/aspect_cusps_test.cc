// In which aspects cusps let a mechanism change its posture or its assembly mode: against the three configurations next
// to each cusp that Newton's method finds in doubles, and on planted maps.
#include "corank/analyze/aspects/aspect_cusps.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <random>
#include <vector>

#include "corank/analyze/aspects/aspects.h"
#include "corank/study/model.h"
#include "corank/tests/seeds.h"

namespace corank::analyze {
namespace {

using Pair = std::array<double, 2>;
using Map = std::function<Pair(const Pair&)>;
using symbolic::Expression;
using symbolic::Mechanism;

Aspects with_cusps(Mechanism model) {
  solve::Control control;
  return aspects({.model = std::move(model)}, {.cusps = true}, control);
}

double determinant(const Map& map, const Pair& q) {
  constexpr double h = 1e-5;
  const Pair a = map({q[0] + h, q[1]}), b = map({q[0] - h, q[1]}), c = map({q[0], q[1] + h}), d = map({q[0], q[1] - h});
  return ((a[0] - b[0]) * (c[1] - d[1]) - (a[1] - b[1]) * (c[0] - d[0])) / (4 * h * h);
}

// By Newton's method; false where it leaves the neighbourhood of the cusp.
bool solve_for(const Map& map, const Pair& image, const Pair& cusp, double radius, Pair& q) {
  constexpr double h = 1e-6;
  for (int step = 0; step < 60; ++step) {
    const Pair a = map({q[0] + h, q[1]}), b = map({q[0] - h, q[1]}), c = map({q[0], q[1] + h}), d = map({q[0], q[1] - h}),
               f = map(q);
    const double j00 = (a[0] - b[0]) / (2 * h), j01 = (c[0] - d[0]) / (2 * h), j10 = (a[1] - b[1]) / (2 * h),
                 j11 = (c[1] - d[1]) / (2 * h), det = j00 * j11 - j01 * j10, u = f[0] - image[0], v = f[1] - image[1];
    const double dx = (u * j11 - v * j01) / det, dy = (j00 * v - j10 * u) / det;
    q = {q[0] - dx, q[1] - dy};
    if (!(std::hypot(q[0] - cusp[0], q[1] - cusp[1]) < 2 * radius)) return false;
    if (std::hypot(dx, dy) < 1e-11) return true;
  }
  return false;
}

// The sign of the determinant at the outer two of the three configurations that come together at the cusp; 0: not
// found. From images of points next to the cusp: the three are as far from it as the square root.
int outer_sign(const Map& map, const Pair& cusp) {
  for (const double radius : {0.15, 0.07, 0.03})
    for (int start = 0; start < 24; ++start) {
      const double t = start * 2 * M_PI / 24, next = radius * radius;
      const Pair image = map({cusp[0] + next * std::cos(t), cusp[1] + next * std::sin(t)});
      std::vector<Pair> found;
      for (int i = -4; i <= 4; ++i)
        for (int j = -4; j <= 4; ++j) {
          Pair q{cusp[0] + radius * i / 4, cusp[1] + radius * j / 4};
          if (!solve_for(map, image, cusp, radius, q)) continue;
          bool fresh = true;
          for (const Pair& p : found) fresh = fresh && std::hypot(p[0] - q[0], p[1] - q[1]) > 1e-5;
          if (fresh) found.push_back(q);
        }
      if (found.size() != 3) continue;
      int sum = 0;
      for (const Pair& p : found) sum += determinant(map, p) > 0 ? 1 : -1;
      return sum > 0 ? 1 : -1;
    }
  return 0;
}

double angle(const Aspects& a, const Box& box, const std::string& name) {
  for (const Angle& t : a.system.angles)
    if (t.name == name)
      return std::atan2(box[static_cast<std::size_t>(t.sine)].mid(), box[static_cast<std::size_t>(t.cosine)].mid());
  ADD_FAILURE() << name;
  return 0;
}

double length(const Aspects& a, const Box& box, const std::string& name) {
  return box[static_cast<std::size_t>(a.system.find(name))].mid();
}

// Of each cusp both aspects are known, and their signs are those of the configurations nearby.
void expect_aspects(const Aspects& a, std::size_t cusps, bool forward, const Map& map,
                    const std::function<Pair(const Box&)>& place) {
  ASSERT_TRUE(a.aspects.exact() && a.cusps) << a.aspects.reason;
  EXPECT_TRUE(a.cusps->reasons.empty());
  ASSERT_EQ(a.cusps->list.size(), cusps);
  for (const AspectCusp& cusp : a.cusps->list) {
    EXPECT_EQ(cusp.forward, forward);
    ASSERT_TRUE(cusp.around && cusp.between);
    const auto sign = [&](int aspect) {
      return determinant(map, place(a.aspects.representatives[static_cast<std::size_t>(aspect)])) > 0 ? 1 : -1;
    };
    const int outer = outer_sign(map, place(cusp.at));
    ASSERT_NE(outer, 0);
    EXPECT_EQ(sign(*cusp.around), outer);
    EXPECT_EQ(sign(*cusp.between), -outer);
  }
}

TEST(AspectCusps, OfAnOrthogonalArmAreInTheAspectOfTwoOfTheThreePosturesNearby) {
  const auto model = [](const char* d3, const char* d4, const char* r2) {
    return study::read_model(CORANK_SOURCE_DIR "/models/serial/orthogonal_3r_section.cuik",
                             {{"d3", d3}, {"d4", d4}, {"r2", r2}})
        .mechanism;
  };
  for (const auto& [d3, d4, r2] : {std::array{"2", "1.5", "1"}, {"0.91", "0.5", "1.15"}}) {
    SCOPED_TRACE(d3);
    const double l3 = std::stod(d3), l4 = std::stod(d4), r = std::stod(r2);
    const Aspects a = with_cusps(model(d3, d4, r2));
    expect_aspects(
        a, 4, false,
        [&](const Pair& q) {
          const double w = l3 + l4 * std::cos(q[1]);
          return Pair{std::pow(1 + w * std::cos(q[0]), 2) + std::pow(r + l4 * std::sin(q[1]), 2), -w * std::sin(q[0])};
        },
        [&](const Box& box) {
          return Pair{angle(a, box, "theta2"), angle(a, box, "theta3")};
        });
    EXPECT_EQ(a.cusps->all, (std::array{true, true}));
    EXPECT_EQ(a.cusps->euler_characteristic, 0);  // a torus of two angles
  }
  const Aspects none = with_cusps(model("0.85", "0.26", "0.59"));
  ASSERT_TRUE(none.cusps);
  EXPECT_TRUE(none.cusps->list.empty() && none.cusps->reasons.empty());
}

// (u, v) = P(a, w(a, b)) of a, b, which are affine in x and y: the locus is where w_b = 0. The outer two of three
// configurations have w_b > 0 where w_bbb > 0. `bounded`: aspects that are not exact, so that nothing is said; `lost`:
// those that are not known. Usually the first six maps and the last, whose aspects are not exact.
TEST(AspectCusps, OfPlantedMapsAreKnownAndNoneIsFalse) {
  std::mt19937 random(23);
  const auto tenths = [&](int spread) { return std::uniform_int_distribution(-spread, spread)(random); };
  const auto tenth = [](int n) { return Expression(n) / Expression(10); };
  int bounded = 0, cusps = 0, lost = 0, wrong = 0;
  for (int k = 0; k < 12; ++k) {
    SCOPED_TRACE(k);
    const bool forward = k % 2 == 0, tail = k % 3 == 2;
    const std::array in{10 + tenths(4), tenths(4), tenths(4), 10 + tenths(4), 1 + 2 * (k % 3), 3 - k % 2};
    const std::array out{10 + tenths(4), tenths(4), tenths(4), 10};
    if (!test::long_run() && k > 5 && k < 11) continue;
    Mechanism m("planted");
    const Expression x = m.length("x", -3, 3), y = m.length("y", -3, 3), a = m.length_without_range("a"),
                     b = m.length_without_range("b"), u = m.length_without_range("u"), v = m.length_without_range("v"),
                     w(tail ? "b^4 - b^2 + a*b" : "b^3 + a*b");
    m.constrain(a == tenth(in[0]) * x + tenth(in[1]) * y + tenth(in[4]));
    m.constrain(b == tenth(in[2]) * x + tenth(in[3]) * y + tenth(in[5]));
    m.constrain(u == tenth(out[0]) * a + tenth(out[1]) * w);
    m.constrain(v == tenth(out[2]) * a + tenth(out[3]) * w);
    m.inputs(forward ? std::vector{u, v} : std::vector{x, y});
    m.outputs(forward ? std::vector{x, y} : std::vector{u, v});
    const Aspects found = with_cusps(m);
    ASSERT_TRUE(found.cusps);
    if (!found.aspects.exact()) {
      EXPECT_TRUE(found.cusps->list.empty());
      EXPECT_EQ(found.cusps->looked_for, (std::array{false, false}));
      EXPECT_NE(to_text({.model = m}, found).find("cusps           not searched for; the aspects are not exact"),
                std::string::npos);
      const auto json = nlohmann::json::parse(to_json({.model = m}, found));
      EXPECT_TRUE(json["cusps"].is_null());
      EXPECT_EQ(json["cusps_of"].size(), 0u);
      ++bounded;
      continue;
    }
    ASSERT_EQ(found.cusps->list.size(), tail ? 2u : 1u);
    for (const AspectCusp& cusp : found.cusps->list) {
      ++cusps;
      lost += !cusp.around || !cusp.between;
      const double third = tail ? length(found, cusp.at, "b") : 1;
      const auto sign = [&](const std::optional<int>& aspect) {
        const Box& at = found.aspects.representatives[static_cast<std::size_t>(aspect.value_or(0))];
        const double p = length(found, at, "a"), q = length(found, at, "b");
        return (tail ? 4 * q * q * q - 2 * q + p : 3 * q * q + p) * third > 0;
      };
      wrong += cusp.around && !sign(cusp.around);
      wrong += cusp.between && sign(cusp.between);
    }
  }
  EXPECT_GE(cusps, 6) << bounded;
  EXPECT_EQ(lost, 0);
  EXPECT_EQ(wrong, 0);
}

// The 3-RPR of Innocenti and Parenti-Castelli with its first leg held at 14.98 (lengths in tens), by the angles of leg 1 and
// of the platform, a torus, and the squares of the other legs, of which the second is at least `least`.
Mechanism held_3rpr(int least) {
  Mechanism m("torus");
  for (const auto& [name, value] : {std::pair{"l", "1.498"}, {"a2", "1.591"}, {"a3", "1"}, {"d1", "1.704"}, {"d3", "2.084"}})
    m.constant(name, Expression(value));
  m.constant("u", Expression("(d1^2 + d3^2 - 1.654^2)/(2*d1)"));
  m.constant("k", Expression("sqrt(d3^2 - u^2)"));
  const Expression leg = m.angle("leg"), phi = m.angle("phi"), s2 = m.length("s2", least, 40), s3 = m.length("s3", -1, 40);
  m.constrain(s2 == Expression("(l*cos(leg) + d1*cos(phi) - a2)^2 + (l*sin(leg) + d1*sin(phi))^2"));
  m.constrain(s3 == Expression("(l*cos(leg) + u*cos(phi) - k*sin(phi))^2 + (l*sin(leg) + u*sin(phi) + k*cos(phi) - a3)^2"));
  m.inputs({s2, s3});
  m.outputs({leg, phi});
  return m;
}

// Six cusps, and χ = 0.
TEST(AspectCusps, OfA3RprSliceAreInTheAspectOfTwoOfTheThreeModesNearbyAndHaveTheParityOfAClosedSurface) {
  const Mechanism m = held_3rpr(-1);
  const Aspects torus = with_cusps(m);
  const double l = 1.498, d1 = 1.704, d2 = 1.654, d3 = 2.084, u = (d1 * d1 + d3 * d3 - d2 * d2) / (2 * d1),
               k = std::sqrt(d3 * d3 - u * u);
  expect_aspects(
      torus, 6, true,
      [&](const Pair& q) {
        const double x = l * std::cos(q[0]), y = l * std::sin(q[0]), c = std::cos(q[1]), s = std::sin(q[1]);
        return Pair{std::hypot(x + d1 * c - 1.591, y + d1 * s), std::hypot(x + u * c - k * s, y + u * s + k * c - 1)};
      },
      [&](const Box& box) {
        return Pair{angle(torus, box, "leg"), angle(torus, box, "phi")};
      });
  ASSERT_TRUE(torus.cusps);
  EXPECT_EQ(torus.cusps->all, (std::array{true, true}));
  EXPECT_EQ(torus.cusps->euler_characteristic, 0);
  EXPECT_NE(to_text({.model = m}, torus).find("the number of forward ones has the parity of the Euler characteristic 0"),
            std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(to_json({.model = m}, torus))["euler_characteristic"], 0);
}

// A shortest length of the second leg cuts the torus, one cusp is cut off with a part of it, and nothing is said of the
// parity of the others.
void expect_no_parity(const Mechanism& model) {
  const Aspects cut = with_cusps(model);
  ASSERT_TRUE(cut.cusps);
  EXPECT_EQ(cut.cusps->list.size(), 5u);
  EXPECT_TRUE(cut.cusps->all[0]);
  EXPECT_FALSE(cut.cusps->euler_characteristic);
}

TEST(AspectCusps, OfACutSurfaceHaveNoParityToKeep) {
  expect_no_parity(held_3rpr(1));
  // The same robot as it is modelled, by ranges of the legs' lengths, which takes long.
  if (test::long_run())
    expect_no_parity(study::read_model(CORANK_SOURCE_DIR "/models/planar/3rpr_innocenti.cuik").mechanism);
}

TEST(AspectCusps, OfTheOtherParityAreNotSaidToBeAll) {
  const study::Question arm{.model =
                                study::read_model(CORANK_SOURCE_DIR "/models/serial/orthogonal_3r_section.cuik").mechanism};
  AspectCusps cusps;
  cusps.looked_for = cusps.all = {true, true};
  cusps.list.assign(3, AspectCusp{.forward = false});
  solve::Control control;
  study::Question cspace = arm;
  cspace.set = symbolic::SingularitySet::cspace;
  check_parity(cspace, study::system(cspace), 1, control, cusps);
  EXPECT_EQ(cusps.all, (std::array{true, false}));
  ASSERT_EQ(cusps.reasons.size(), 1u);
  EXPECT_NE(cusps.reasons[0].find("inverse cusps: their number, 3, does not have the parity"), std::string::npos);
}

TEST(AspectCusps, ThatNobodyAskedForAreNull) {
  solve::Control control;
  study::Question slider{.model = study::read_model(CORANK_SOURCE_DIR "/models/three_slider.cuik").mechanism};
  const Aspects a = aspects(slider, {}, control);
  EXPECT_TRUE(nlohmann::json::parse(to_json(slider, a))["cusps"].is_null());
  EXPECT_EQ(to_text(slider, a).find("cusps"), std::string::npos);
}

// Both arms of a five-bar are alike: its loci are covered twice, and cusps fill curves. Nothing is claimed. Of Dextar with
// its motors farther apart C-space is a sphere.
TEST(AspectCusps, AreNotClaimedWhereTheyAreNoPoints) {
  const Aspects a = with_cusps(study::read_model(CORANK_SOURCE_DIR "/models/dextar.cuik", {{"d", "33/10"}}).mechanism);
  ASSERT_TRUE(a.cusps);
  EXPECT_TRUE(a.cusps->list.empty());
  EXPECT_FALSE(a.cusps->reasons.empty());
}

}  // namespace
}  // namespace corank::analyze
