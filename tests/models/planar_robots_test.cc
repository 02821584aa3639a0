// Planar parallel robots from links and joints (models/planar): the same answers as from their equations, and no
// singular configuration lost that their geometry gives.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <random>
#include <regex>
#include <string>
#include <vector>

#include "corank/symbolic/model/model_file.h"
#include "corank/tests/models/closed_forms.h"
#include "corank/tests/models/planar_parts.h"

namespace corank {
namespace {
using symbolic::SingularitySet;
using test::Configuration;
using test::Constants;
using test::Point;

using Places = std::vector<Configuration>;

Point turned(Point p, double phi) {
  return {p.x * std::cos(phi) - p.y * std::sin(phi), p.x * std::sin(phi) + p.y * std::cos(phi)};
}

/// The platform's joints, and lines through them.
struct Lines {
  std::array<Point, 3> through, along;
  /// 0 exactly where the three meet in one point or are parallel.
  double determinant() const {
    std::array<std::array<double, 3>, 3> r{};
    for (std::size_t i = 0; i < 3; ++i) r[i] = {along[i].x, along[i].y, cross(through[i] - through[0], along[i])};
    return r[0][0] * (r[1][1] * r[2][2] - r[1][2] * r[2][1]) - r[0][1] * (r[1][0] * r[2][2] - r[1][2] * r[2][0]) +
           r[0][2] * (r[1][0] * r[2][1] - r[1][1] * r[2][0]);
  }
};
struct Pose {
  Lines lines;
  std::vector<double> values;  ///< of the coordinates
};
using Names = std::vector<std::string>;

Configuration named(const Names& names, const std::vector<double>& values) {
  Configuration q;
  for (std::size_t i = 0; i < names.size(); ++i) q[names[i]] = values.at(i);
  return q;
}

/// Where the lines' determinant changes its sign along t in [0, 1], between `steps` equidistant values, by halving.
void add_sign_changes(const std::function<std::optional<Pose>(double)>& at, int steps, const Names& names, Places& places) {
  auto before = at(0);
  for (int k = 1; k <= steps; ++k) {
    double from = (k - 1.0) / steps, to = static_cast<double>(k) / steps;
    const auto after = at(to);
    if (before && after && before->lines.determinant() * after->lines.determinant() < 0) {
      const bool rises = after->lines.determinant() > 0;
      auto middle = before;
      for (int halving = 0; halving < 60 && middle; ++halving) {
        const double t = (from + to) / 2;
        middle = at(t);
        if (middle) (middle->lines.determinant() > 0) == rises ? to = t : from = t;
      }
      if (middle && std::fabs(middle->lines.determinant()) < 1e-8) places.push_back(named(names, middle->values));
    }
    before = after;
  }
}

symbolic::Mechanism with_orientation(const study::Model& model, const std::string& phi) {
  const std::string text = std::regex_replace(model.mechanism.source_text(), std::regex("pose_phi ~ \\[[^\\]]*\\]"),
                                              "pose_phi ~ [" + phi + ", " + phi + "]");
  return symbolic::parse_model(text, "fixed_orientation.cuik");
}

void expect_holds(const System& system, const Cover& cover, const Places& places, std::size_t least) {
  EXPECT_TRUE(cover.complete());
  EXPECT_GE(places.size(), least);
  EXPECT_EQ(test::lost(system, cover, places), 0u) << "of " << places.size();
}

// The second system's boxes in the first one's configuration variables, by their names.
std::vector<Box> in_variables_of(const System& first, const System& second, const Cover& cover,
                                 const std::map<std::string, std::string>& names) {
  std::vector<std::size_t> column;
  for (int i = 0; i < first.configuration_size; ++i) {
    const std::string& name = first.variables[static_cast<std::size_t>(i)].name;
    const auto other = names.find(name);
    const int index = second.find(other == names.end() ? name : other->second);
    EXPECT_GE(index, 0) << name;
    if (index < 0) return {};
    column.push_back(static_cast<std::size_t>(index));
  }
  std::vector<Box> boxes;
  for (const CoverBox& b : cover.boxes) {
    Box& box = boxes.emplace_back();
    for (const std::size_t c : column) box.push_back(b.box[c]);
  }
  return boxes;
}

bool meet(const Box& a, const Box& b) {
  for (std::size_t j = 0; j < a.size(); ++j)
    if (a[j].lo() > b[j].hi() || b[j].lo() > a[j].hi()) return false;
  return true;
}

// The exact points' coordinates are the same: as numbers where they are rational, else as narrow boxes, since either side
// chooses a number field of its own.
void expect_same_exact_points(const System& first, const Cover& a, const System& second, const Cover& b,
                              const std::map<std::string, std::string>& names) {
  EXPECT_EQ(a.exact_points.size(), b.exact_points.size());
  Cover points;
  points.boxes = b.points;
  const std::vector<Box> others = in_variables_of(first, second, points, names);
  for (const CoverBox& p : a.points) {
    if (p.verdict != Verdict::exact) continue;
    const ExactPoint& known = a.exact_points.at(static_cast<std::size_t>(p.point));
    const Box box(p.box.begin(), p.box.begin() + first.configuration_size);
    int equal = 0;
    for (std::size_t k = 0; k < others.size(); ++k) {
      if (b.points[k].verdict != Verdict::exact || !meet(box, others[k])) continue;
      const ExactPoint& other = b.exact_points.at(static_cast<std::size_t>(b.points[k].point));
      bool same = known.corank == other.corank;
      for (std::size_t i = 0; known.polynomial.size() == 2 && i < box.size(); ++i) {
        const auto name = names.find(first.variables[i].name);
        const int index = second.find(name == names.end() ? first.variables[i].name : name->second);
        same = same && known.coordinates[i] == other.coordinates.at(static_cast<std::size_t>(index));
      }
      for (const Interval& side : box) same = same && side.width() < 1e-9;
      equal += same;
    }
    EXPECT_EQ(equal, 1);
  }
}

std::size_t without_a_partner(const std::vector<Box>& boxes, const std::vector<Box>& others) {
  return static_cast<std::size_t>(std::count_if(boxes.begin(), boxes.end(), [&](const Box& a) {
    return std::none_of(others.begin(), others.end(), [&](const Box& b) { return meet(a, b); });
  }));
}

void expect_near(std::size_t count, std::size_t other, double share) {
  EXPECT_NEAR(static_cast<double>(count), static_cast<double>(other), share * static_cast<double>(other) + 1e-9);
}

// Returns the number of exact points.
std::size_t expect_same_boxes(const std::string& model, const Constants& constants, SingularitySet set, double sigma,
                              const std::map<std::string, std::string>& names) {
  SCOPED_TRACE(model + " " + to_string(set));
  const auto by_equations = study::read_model(CORANK_SOURCE_DIR "/models/" + model + ".cuik", constants).mechanism;
  const auto by_parts = test::planar_model(model, constants).mechanism;
  const System equations = test::set_of(by_equations, set), parts = test::set_of(by_parts, set);
  const Cover a = test::answer_to(by_equations, set, sigma), b = test::answer_to(by_parts, set, sigma);
  EXPECT_TRUE(a.complete() && b.complete());
  EXPECT_EQ(a.dimension, b.dimension);
  expect_near(b.boxes.size(), a.boxes.size(), 0.03);
  EXPECT_EQ(a.points.size(), b.points.size());
  expect_same_exact_points(equations, a, parts, b, names);
  for (const Verdict verdict : {Verdict::isolated, Verdict::exact, Verdict::undecided})
    expect_near(b.count(verdict), a.count(verdict), 0.03);
  const std::vector<Box> first = in_variables_of(equations, equations, a, {}),
                         second = in_variables_of(equations, parts, b, names);
  EXPECT_EQ(without_a_partner(first, second), 0u);
  EXPECT_EQ(without_a_partner(second, first), 0u);
  return a.exact_points.size();
}

TEST(PlanarParts, OfDextarGiveTheBoxesOfItsEquations) {
  const std::map<std::string, std::string> names{{"J3x", "J3_x"},
                                                 {"J3y", "J3_y"},
                                                 {"c_theta3", "c_phi_link3"},
                                                 {"s_theta3", "s_phi_link3"},
                                                 {"c_theta4", "c_phi_link4"},
                                                 {"s_theta4", "s_phi_link4"}};
  expect_same_boxes("dextar", {}, SingularitySet::forward, 0.01, names);
  expect_same_boxes("dextar", {}, SingularitySet::inverse, 0.01, names);
  expect_same_boxes("dextar", {}, SingularitySet::cspace, 0.4, names);
}

TEST(PlanarParts, OfTheThreeSliderGiveTheBoxesOfItsEquations) {
  std::size_t exact = 0;
  for (const char* l2 : {"4/5", "1"})
    for (const SingularitySet set : {SingularitySet::forward, SingularitySet::inverse, SingularitySet::cspace})
      exact += expect_same_boxes("three_slider", {{"L2", l2}}, set, 0.05, {});
  EXPECT_GE(exact, 4u);  // (0, 0, ±1), where the C-space of equal rods crosses itself, in both loci
}

TEST(PlanarParts, OfDextarLoseNoSingularity) {
  const System system = test::set_of(test::planar_model("dextar").mechanism, SingularitySet::forward);
  const auto places = [](const std::vector<test::DextarConfiguration>& samples) {
    Places result;
    for (const auto& q : samples)
      result.push_back({{"J3_x", q[0]},
                        {"J3_y", q[1]},
                        {"theta2", std::atan2(q[3], q[2])},
                        {"phi_link3", std::atan2(q[5], q[4])},
                        {"phi_link4", std::atan2(q[7], q[6])},
                        {"theta5", std::atan2(q[9], q[8])}});
    return result;
  };
  expect_holds(system, test::cover_of(system, 0.02, 0.02), places(test::dextar_forward_samples(1000)), 2000);
  const System inverse = test::set_of(test::planar_model("dextar").mechanism, SingularitySet::inverse);
  expect_holds(inverse, test::cover_of(inverse, 0.02, 0.02), places(test::dextar_inverse_samples(1000)), 2000);
}

// A and B on the x axis, P where the links meet.
TEST(FiveBarSliders, HasItsSingularitiesWhereItsLinksAreInLineOrAcrossTheRail) {
  constexpr double l1 = 1, l2 = 1.2, kEnd = 1.5;
  const auto place = [](double a, double b, Point p) -> Configuration {
    return {{"a", a},     {"b", b},    {"theta1", angle_of(p - Point{a, 0})}, {"theta2", angle_of(p - Point{b, 0})},
            {"P_x", p.x}, {"P_y", p.y}};
  };
  Places forward, inverse;
  for (int k = 1; k < 2000; ++k) {
    const double t = -kEnd + 2 * kEnd * k / 2000;
    for (const int side : {-1, 1}) {
      for (const double b : {t + side * (l1 + l2), t - side * (l2 - l1)})
        if (std::fabs(b) <= kEnd) forward.push_back(place(t, b, {t + side * l1, 0}));
      for (const int other : {-1, 1})
        if (const double b = t + other * std::sqrt(l2 * l2 - l1 * l1); std::fabs(b) <= kEnd)
          inverse.push_back(place(t, b, {t, side * l1}));
    }
  }
  const study::Model model = test::planar_model("five_bar_sliders");
  for (const auto& [set, places] : {std::pair(SingularitySet::forward, forward), {SingularitySet::inverse, inverse}}) {
    SCOPED_TRACE(to_string(set));
    const System system = test::set_of(model.mechanism, set);
    const Cover cover = test::cover_of(system, 0.02, 0.02);
    expect_holds(system, cover, places, 2000);
    for (const CoverBox& b : cover.boxes) {  // P on the rail, or as far from it as its shorter link reaches
      const Interval& y = b.box[static_cast<std::size_t>(system.find("P_y"))];
      EXPECT_NEAR(std::fabs(y.mid()), set == SingularitySet::forward ? 0 : l1, 0.05);
    }
  }
}

/// Legs A_i B_i of variable lengths.
struct ThreeRpr {
  std::array<Point, 3> base, platform;

  static Names names() {
    return {"pose_x", "pose_y", "pose_phi", "P_x", "P_y", "rho1", "rho2", "rho3", "alpha1", "alpha2", "alpha3"};
  }
  Pose at(Point first, double phi) const {
    Pose pose;
    pose.values = {first.x, first.y, phi, first.x, first.y, 0, 0, 0, 0, 0, 0};
    for (std::size_t i = 0; i < 3; ++i) {
      pose.lines.through[i] = first + turned(platform[i], phi);
      pose.lines.along[i] = pose.lines.through[i] - base[i];
      pose.values[5 + i] = length(pose.lines.along[i]);
      pose.values[8 + i] = angle_of(pose.lines.along[i]);
    }
    return pose;
  }
  /// The first leg's length given, the others between two lengths.
  Places forward(double leg, double shortest, double longest, std::size_t most) const {
    Places places;
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> angle(-M_PI, M_PI);
    while (places.size() < most) {
      const Point first = base[0] + leg * test::direction(angle(random));
      Places all;
      add_sign_changes([&](double t) { return at(first, -M_PI + 2 * M_PI * t); }, 60, names(), all);
      for (const Configuration& q : all)
        if (std::min(q.at("rho2"), q.at("rho3")) >= shortest && std::max(q.at("rho2"), q.at("rho3")) <= longest)
          places.push_back(q);
    }
    return places;
  }
};

ThreeRpr innocenti() {
  const double d1 = 17.04, d2 = 16.54, d3 = 20.84, u = (d1 * d1 + d3 * d3 - d2 * d2) / (2 * d1);
  return {{{{0, 0}, {15.91, 0}, {0, 10}}}, {{{0, 0}, {d1, 0}, {u, std::sqrt(d3 * d3 - u * u)}}}};
}

TEST(ThreeRpr, WithALegHeldLosesNoSingularity) {
  const System published = test::set_of(test::planar_model("3rpr_innocenti").mechanism, SingularitySet::forward);
  const Cover cover = test::cover_of(published, 1, 0.05);
  EXPECT_EQ(cover.dimension, 1);
  EXPECT_EQ(cover.count(Verdict::undecided), 0u);
  expect_holds(published, cover, innocenti().forward(14.98, 1, 35, 2000), 2000);
  const ThreeRpr own{{{{0, 0}, {2, 0}, {0.8, 1.5}}}, {{{0, 0}, {1, 0}, {0.6, 0.4}}}};
  const study::Model model = test::planar_model("3rpr", {{"lower1", "1"}, {"upper1", "1"}});
  const System system = test::set_of(model.mechanism, SingularitySet::forward);
  expect_holds(system, test::cover_of(system, 0.05, 0.05), own.forward(1, 0.5, 2, 2000), 2000);
  EXPECT_TRUE(solve::solve(test::set_of(model.mechanism, SingularitySet::inverse)).boxes.empty());
}

// Two circles give B1 for each orientation; the third leg's length then changes sign about its own.
TEST(ThreeRpr, HasTheSixAssemblyModesOfInnocentiAndParentiCastelli) {
  const ThreeRpr robot = innocenti();
  Places places;
  for (const int sign : {-1, 1}) {
    const auto at = [&](double phi) -> std::optional<Point> {
      return test::intersect_circles({0, 0}, 14.98, robot.base[1] - turned(robot.platform[1], phi), 15.38, sign);
    };
    const auto gap = [&](double phi, Point first) { return robot.at(first, phi).values[7] - 12; };
    constexpr int kSteps = 2000;
    for (int k = 0; k < kSteps; ++k) {
      double from = -M_PI + 2 * M_PI * k / kSteps, to = from + 2 * M_PI / kSteps;
      const auto a = at(from), b = at(to);
      if (!a || !b || gap(from, *a) * gap(to, *b) > 0) continue;
      const bool rises = gap(to, *b) > 0;
      for (int halving = 0; halving < 50; ++halving) {
        const double middle = (from + to) / 2;
        (gap(middle, *at(middle)) > 0) == rises ? to = middle : from = middle;
      }
      places.push_back(named(ThreeRpr::names(), robot.at(*at(from), from).values));
    }
  }
  ASSERT_EQ(places.size(), 6u);
  const study::Model model =
      test::planar_model("3rpr_innocenti", {{"lower2", "15.38"}, {"upper2", "15.38"}, {"lower3", "12"}, {"upper3", "12"}});
  const System system = test::set_of(model.mechanism, SingularitySet::cspace);
  test::expect_points(system, solve::solve(system), places);
}

// Poses along random segments at one orientation, in all working modes.
void add_random_segments(const std::function<std::optional<Pose>(Point, int)>& at, double low, double high, std::size_t most,
                         const Names& names, Places& places) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> place(low, high);
  while (places.size() < most) {
    const Point from{place(random), place(random)}, to{place(random), place(random)};
    for (int mode = 0; mode < 8; ++mode)
      add_sign_changes([&](double t) { return at(from + t * (to - from), mode); }, 60, names, places);
  }
}

const std::array<Point, 3> kCorners{Point{0, 0}, Point{2, 0}, Point{1, std::sqrt(3.0)}},
    kPlatformCorners{Point{0, 0}, Point{0.5, 0}, Point{0.25, std::sqrt(3.0) / 4}};

TEST(ThreeRrr, AtOneOrientationLosesNoSingularity) {
  const double phi = M_PI / 10;
  Places places;
  const Names names{"pose_x", "pose_y", "pose_phi", "theta1", "theta2", "theta3", "phi_rod1", "phi_rod2", "phi_rod3"};
  const auto at = [&](Point first, int mode) -> std::optional<Pose> {
    Pose pose;
    pose.values = {first.x, first.y, phi, 0, 0, 0, 0, 0, 0};
    for (std::size_t i = 0; i < 3; ++i) {
      const Point c = first + turned(kPlatformCorners[i], phi);
      const auto b = test::intersect_circles(kCorners[i], 1, c, 1, mode >> i & 1 ? 1 : -1);
      if (!b) return std::nullopt;
      pose.lines.through[i] = c, pose.lines.along[i] = c - *b;
      pose.values[3 + i] = angle_of(*b - kCorners[i]), pose.values[6 + i] = angle_of(c - *b);
    }
    return pose;
  };
  add_random_segments(at, -1, 2.5, 2000, names, places);
  const System system = test::set_of(with_orientation(test::planar_model("3rrr"), "pi/10"), SingularitySet::forward);
  const Cover cover = test::cover_of(system, 0.1, 0.1);
  EXPECT_EQ(cover.dimension, 1);
  expect_holds(system, cover, places, 2000);
}

TEST(ThreePrr, AtOneOrientationLosesNoSingularity) {
  const double phi = M_PI / 10, l = 0.8;
  const std::array<Point, 3> rails{Point{1, 0}, Point{-0.5, std::sqrt(3.0) / 2}, Point{-0.5, -std::sqrt(3.0) / 2}};
  Places places, across;
  const Names names{"pose_x", "pose_y", "pose_phi", "s1", "s2", "s3", "psi1", "psi2", "psi3"};
  // B_i at the foot of C_i on its rail, and so far from it that the rod fits.
  const auto at = [&](Point first, int mode) -> std::optional<Pose> {
    Pose pose;
    pose.values = {first.x, first.y, phi, 0, 0, 0, 0, 0, 0};
    for (std::size_t i = 0; i < 3; ++i) {
      const Point c = first + turned(kPlatformCorners[i], phi), from = c - kCorners[i];
      const double foot = from.x * rails[i].x + from.y * rails[i].y, height = cross(rails[i], from);
      const double square = l * l - height * height;
      if (square < -1e-12) return std::nullopt;
      const double root = std::sqrt(std::max(0.0, square)), s = foot + (mode >> i & 1 ? 1 : -1) * root;
      if (s < 0 || s > 2) return std::nullopt;
      pose.lines.through[i] = c, pose.lines.along[i] = from - s * rails[i];
      pose.values[3 + i] = s, pose.values[6 + i] = angle_of(pose.lines.along[i]);
    }
    return pose;
  };
  add_random_segments(at, -0.5, 2, 2000, names, places);
  const auto mechanism = with_orientation(test::planar_model("3prr"), "pi/10");
  const System system = test::set_of(mechanism, SingularitySet::forward);
  const Cover cover = test::cover_of(system, 0.1, 0.1);
  EXPECT_EQ(cover.dimension, 1);
  expect_holds(system, cover, places, 2000);
  // A rod across the first rail: C1 as high above it, or below, as the rod is long.
  for (int k = 0; k <= 2000; ++k)
    for (const int side : {-1, 1})
      for (int mode = 0; mode < 8; mode += 2)
        if (const auto pose = at({2.0 * k / 2000, side * l}, mode)) across.push_back(named(names, pose->values));
  const System inverse = test::set_of(mechanism, SingularitySet::inverse);
  const Cover locus = test::cover_of(inverse, 0.1, 0.1);
  EXPECT_TRUE(locus.complete());
  EXPECT_GT(across.size(), 500u);
  EXPECT_EQ(test::lost(inverse, locus, across, 1e-5), 0u) << across.size();
}

TEST(PlanarParts, AreDrawnWithTheNamesOfTheirPointsAndBlocksOnRails) {
  const auto parts = [](const std::string& model, symbolic::DrawingPart::Kind kind) {
    std::vector<std::string> first;
    const symbolic::Drawing drawing = test::planar_model(model).mechanism.drawing();
    for (const symbolic::DrawingPart& part : drawing.parts)
      if (part.kind == kind) first.push_back(part.points.at(0));
    return first;
  };
  using Kind = symbolic::DrawingPart::Kind;
  EXPECT_EQ(parts("three_slider", Kind::slider), (Names{"A", "B", "C"}));
  EXPECT_EQ(parts("slider_crank", Kind::slider), (Names{"P"}));
  EXPECT_EQ(parts("slider_crank", Kind::ground), (Names{"A"}));
  EXPECT_EQ(parts("dextar", Kind::ground), (Names{"J5", "J1"}));
  EXPECT_EQ(parts("dextar", Kind::effector), (Names{"J3"}));
  EXPECT_EQ(parts("3prr", Kind::slider), (Names{"B1", "B2", "B3"}));
  EXPECT_EQ(parts("3rpr", Kind::slider), Names{}) << "a leg's cylinder is no rail of the ground";
  // From s = 0 to s = b, and a tenth over either end.
  const symbolic::Drawing drawing = test::planar_model("3prr").mechanism.drawing();
  for (const auto& [name, x] : {std::pair("s1_rail", "-0.2"), {"s1_rail_2", "2.2"}})
    EXPECT_EQ(drawing.points.at(static_cast<std::size_t>(drawing.find(name))).coordinates.at(0).text(), x);
}

TEST(PlanarParts, GiveAsManyBoxesInAnyUnit) {
  struct Robot {
    const char* model;
    std::vector<std::pair<std::string, std::string>> lengths;
    double sigma;
  };
  for (const auto& [model, lengths, sigma] :
       {Robot{"dextar", {{"l", "9/10"}, {"d", "59/50"}}, 0.05}, Robot{"3rpr_innocenti",
                                                                      {{"a2", "15.91"},
                                                                       {"a3", "10"},
                                                                       {"d1", "17.04"},
                                                                       {"d2", "16.54"},
                                                                       {"d3", "20.84"},
                                                                       {"leg1", "14.98"},
                                                                       {"lower2", "1"},
                                                                       {"upper2", "35"},
                                                                       {"lower3", "1"},
                                                                       {"upper3", "35"}},
                                                                      1}})
    for (const SingularitySet set : {SingularitySet::forward, SingularitySet::inverse}) {
      SCOPED_TRACE(std::string(model) + " " + to_string(set));
      const auto cover = [&, &name = model, &all = lengths, &edge = sigma](const std::string& unit, double factor) {
        Constants constants;
        for (const auto& [length, value] : all) constants.push_back({length, value + "*" + unit});
        return test::cover_of(test::set_of(test::planar_model(name, constants).mechanism, set), edge * factor, 0.05);
      };
      const Cover metres = cover("1", 1);
      EXPECT_TRUE(metres.complete());
      for (const auto& [unit, factor] : {std::pair("1/1000", 1e-3), {"1000", 1e3}}) {
        SCOPED_TRACE(unit);
        const Cover other = cover(unit, factor);
        EXPECT_TRUE(other.complete());
        expect_near(other.boxes.size(), metres.boxes.size(), 0.03);
        expect_near(other.count(Verdict::undecided), metres.count(Verdict::undecided), 0.03);
      }
    }
}

}  // namespace
}  // namespace corank
