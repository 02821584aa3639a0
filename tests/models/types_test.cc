// The six types of singularity: proven of every box of known mechanisms, as doc/types.md tells; sets of one type; redundant
// mechanisms against closed forms and samples.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <Eigen/Dense>
#include <cmath>
#include <fstream>
#include <iterator>
#include <numbers>
#include <random>

#include "corank/result/files/verification.h"
#include "corank/result/values/tallies.h"
#include "corank/study/answer.h"
#include "corank/study/model.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/tests/cover_lookup.h"
#include "corank/tests/seeds.h"

namespace corank {
namespace {
using symbolic::SingularitySet;
using testing::HasSubstr;
using enum SingularityType;

const std::string kModels = CORANK_SOURCE_DIR "/models/";

result::Result solved(const symbolic::Mechanism& model, SingularitySet set, std::optional<double> sigma = {},
                      std::optional<symbolic::KernelSide> side = {}) {
  study::Options options;
  options.search.sigma = sigma;
  return study::answer({.model = model, .set = set, .kernel = side}, options);
}

result::Result three_slider(SingularitySet set, const std::string& l2) {
  study::Question question{
      .model = symbolic::read_model(kModels + "three_slider.cuik"), .set = set, .constants = {{"L2", l2}}};
  result::put_in(question.constants, question.model);
  return study::answer(question);
}

result::Result dextar_result(SingularitySet set, std::optional<double> sigma = {},
                             std::optional<symbolic::KernelSide> side = {}) {
  return solved(symbolic::read_model(kModels + "dextar.cuik"), set, sigma, side);
}

bool verified(const result::Result& r) {
  const result::Verification v = result::verify(r);
  for (const auto& f : v.report.failures) ADD_FAILURE() << f.index << ": " << f.reason;
  return v.verified();
}

// A line of the document's table. Of a curve it does not tell how many boxes there are.
std::string row(const std::string& what, const result::Result& r) {
  const result::TypeTally tally = result::type_tally(r.cover);
  const std::size_t all = r.cover.boxes.size();
  const auto share = [all](std::size_t n) { return n == 0 ? "none" : n == all ? "all" : std::to_string(n); };
  std::string text =
      fmt::format("| {} | `{}` | {}", what, r.set, r.cover.dimension > 0 ? "curves" : std::to_string(all) + " points");
  for (const SingularityType type : kSingularityTypes) text += " | " + share(tally.proven.at(type));
  return text + " | " + share(tally.unproven) + " |";
}

std::string document() {
  std::ifstream in(CORANK_SOURCE_DIR "/doc/types.md");
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(Types, OfTheThreeSliderAreInTheDocument) {
  const std::string text = document();
  for (const auto& [l2, what] : {std::pair("4/5", "three sliders, L2 = 4/5"), std::pair("1", "three sliders, L1 = L2")})
    for (const auto set : {SingularitySet::forward, SingularitySet::inverse, SingularitySet::cspace_singular,
                           SingularitySet::forward_inverse}) {
      const result::Result r = three_slider(set, l2);
      EXPECT_THAT(text, HasSubstr(row(what, r)));
      EXPECT_EQ(result::type_tally(r.cover).unproven, 0u) << row(what, r);
      EXPECT_TRUE(verified(r));
    }
}

TEST(Types, OfDextarAreInTheDocument) {
  const std::string text = document();
  for (const auto set : {SingularitySet::forward, SingularitySet::inverse, SingularitySet::cspace_singular,
                         SingularitySet::forward_inverse}) {
    const result::Result r = dextar_result(set, 0.1);
    EXPECT_THAT(text, HasSubstr(row("Dextar, sigma 0.1", r)));
    EXPECT_TRUE(verified(r));
  }
}

// By hand (doc/theory.md): L = [2y_A 0 2x_C; 0 2y_B 2x_C].
TEST(Types, OfTheThreeSliderArePointByPointThoseOfItsMatrix) {
  const auto types_at = [](const result::Result& r, std::array<double, 3> q) {
    for (const CoverBox& p : r.cover.points) {
      bool inside = true;
      for (std::size_t j = 0; j < 3; ++j) inside = inside && std::fabs(p.box[j].mid() - q[j]) < 1e-2;
      if (inside) return p.types.proven;
    }
    return TypeSet{};
  };
  const result::Result forward = three_slider(SingularitySet::forward, "4/5");
  ASSERT_EQ(forward.cover.points.size(), 8u);
  EXPECT_EQ(types_at(forward, {1, -0.8, 0}), bit(rpm) | bit(ii) | bit(io)) << "x_C alone moves; neither block does";
  EXPECT_EQ(types_at(forward, {0.6, 0, -0.8}), bit(ro) | bit(ii));
  const result::Result inverse = three_slider(SingularitySet::inverse, "4/5");
  ASSERT_EQ(inverse.cover.points.size(), 4u);
  EXPECT_EQ(types_at(inverse, {1, 0.8, 0}), bit(rpm) | bit(ii) | bit(io));
  const result::Result equal = three_slider(SingularitySet::forward_inverse, "1");
  EXPECT_EQ(types_at(equal, {0, 0, 1}), bit(ro) | bit(ri) | bit(iim)) << "C-space crosses itself";
  EXPECT_EQ(types_at(equal, {1, -1, 0}), bit(rpm) | bit(ii) | bit(io));
}

// Where J5, J4, J3, J2 are on one line, or J1, J2, J3, J4: 0.9 (±1 ± 1 ± 1) = ±0.9 in three ways for each of two J2.
TEST(Types, OfDextarsTwelveForwardAndInversePointsAreAllFour) {
  const result::Result r = dextar_result(SingularitySet::forward_inverse);
  EXPECT_TRUE(r.cover.complete());
  EXPECT_EQ(r.cover.dimension, 0);
  EXPECT_EQ(r.cover.points.size(), 12u);
  for (const CoverBox& p : r.cover.points) {
    EXPECT_EQ(p.verdict, Verdict::isolated);
    EXPECT_EQ(p.types, (TypeLabels{bit(ro) | bit(ii) | bit(ri) | bit(io), bit(rpm) | bit(iim)}));
  }
  EXPECT_TRUE(verified(r));
}

TEST(TypeSets, OfDextarAreItsLociSinceItHasNoPassiveMotionAndNoIncreasedMobility) {
  EXPECT_TRUE(dextar_result(SingularitySet::rpm).cover.boxes.empty());
  EXPECT_TRUE(dextar_result(SingularitySet::iim).cover.boxes.empty());
  EXPECT_EQ(dextar_result(SingularitySet::ro, 0.2).cover.boxes.size(),
            dextar_result(SingularitySet::forward, 0.2, symbolic::KernelSide::right).cover.boxes.size());
  EXPECT_EQ(dextar_result(SingularitySet::io, 0.2).cover.boxes.size(),
            dextar_result(SingularitySet::inverse, 0.2, symbolic::KernelSide::left).cover.boxes.size());
}

TEST(TypeSets, OfTheThreeSliderLeaveOutWhatIsNotOfTheirType) {
  const auto points = [](SingularitySet set, const char* l2) { return three_slider(set, l2).cover.points.size(); };
  EXPECT_EQ(points(SingularitySet::ro, "4/5"), 4u);
  EXPECT_EQ(points(SingularitySet::rpm, "4/5"), 4u);
  EXPECT_EQ(points(SingularitySet::ii, "4/5"), 8u);
  EXPECT_EQ(points(SingularitySet::ri, "4/5"), 0u);
  EXPECT_EQ(points(SingularitySet::io, "4/5"), 4u);
  EXPECT_EQ(points(SingularitySet::iim, "4/5"), 0u);
  EXPECT_EQ(points(SingularitySet::ro, "1"), 2u);
  EXPECT_EQ(points(SingularitySet::ri, "1"), 2u);
  EXPECT_EQ(points(SingularitySet::ii, "1"), 4u);
  EXPECT_EQ(points(SingularitySet::iim, "1"), 2u);
  const result::Result ro_set = three_slider(SingularitySet::ro, "4/5");
  EXPECT_EQ(ro_set.cover.types.left_out, 4u);
  EXPECT_TRUE(verified(ro_set));
}

// Input v and output u = v²; a dyad with links of length 1 between them. Stretched it is held by nothing: v² - v = ±2.
TEST(TypeSets, OfAStretchedDyadIsRedundantPassiveMotion) {
  const auto model = symbolic::parse_model(
      "[SYSTEM VARS]\nv : [-3, 3]\nu : [-1, 9]\na ~ [-pi, pi]\nb ~ [-pi, pi]\n[SYSTEM EQS]\nv + cos(a) - cos(b) = u;\n"
      "sin(a) = sin(b);\nu = v^2;\n[INPUTS] v\n[OUTPUTS] u\n",
      "dyad.cuik");
  const result::Result r = solved(model, SingularitySet::rpm);
  EXPECT_TRUE(r.cover.complete());
  const test::CoverLookup lookup(r.cover);
  // v, u, cos a, sin a, cos b, sin b: stretched, and folded with any direction.
  EXPECT_TRUE(lookup.holds(std::array{2.0, 4.0, 1.0, 0.0, -1.0, 0.0}, 1e-9));
  EXPECT_TRUE(lookup.holds(std::array{-1.0, 1.0, 1.0, 0.0, -1.0, 0.0}, 1e-9));
  for (const double v : {0.0, 1.0})
    for (double a = -3; a < 3; a += 0.1)
      EXPECT_TRUE(lookup.holds(std::array{v, v, std::cos(a), std::sin(a), std::cos(a), std::sin(a)}, 1e-9)) << v << ' ' << a;
  for (const CoverBox& box : r.cover.boxes) EXPECT_TRUE(!holds_a_solution(box) || box.types.proven & bit(rpm));
}

study::Model planar(const std::string& name) { return study::read_model(kModels + "planar/" + name + ".cuik"); }

TEST(RedundantMechanisms, AnArmOfFourJointsIsSingularWhereItsLinksAreParallel) {
  const symbolic::Mechanism model = planar("arm_4r").mechanism;
  const result::Result r = solved(model, SingularitySet::inverse, 0.2);
  EXPECT_EQ(r.options.kernel, "left");
  EXPECT_TRUE(r.cover.complete());
  EXPECT_EQ(r.cover.dimension, 1);
  const System system = result::system_of(r);
  std::vector<std::size_t> end{static_cast<std::size_t>(system.find("P_x")), static_cast<std::size_t>(system.find("P_y"))};
  const auto radius_fits = [](double from, double to) {
    for (const int s : {0, 1, 2, 3, 4, 5, 6, 7}) {
      const double sum = 1 + (s & 1 ? -0.8 : 0.8) + (s & 2 ? -0.6 : 0.6) + (s & 4 ? -0.5 : 0.5);
      if (std::fabs(sum) >= from - 1e-9 && std::fabs(sum) <= to + 1e-9) return true;
    }
    return false;
  };
  for (const CoverBox& box : r.cover.boxes) {
    const Interval &x = box.box[end[0]], &y = box.box[end[1]];
    EXPECT_TRUE(radius_fits(std::hypot(x.mig(), y.mig()), std::hypot(x.mag(), y.mag()))) << x << ' ' << y;
    EXPECT_TRUE(box.verdict == Verdict::regular || box.verdict == Verdict::boundary) << "the half-space of xi";
    EXPECT_TRUE(box.types.proven & bit(io));
    EXPECT_TRUE(box.types.excluded & bit(iim));
  }
  // Every such circle is covered.
  for (int s = 0; s < 8; ++s)
    for (double t = 0; t < 6.3; t += 0.01) {
      const double sum = 1 + (s & 1 ? -0.8 : 0.8) + (s & 2 ? -0.6 : 0.6) + (s & 4 ? -0.5 : 0.5);
      const double x = sum * std::cos(t), y = sum * std::sin(t);
      const bool found = std::any_of(r.cover.boxes.begin(), r.cover.boxes.end(), [&](const CoverBox& b) {
        const auto has = [](const Interval& side, double v) { return side.lo() - 1e-9 <= v && v <= side.hi() + 1e-9; };
        return has(b.box[end[0]], x) && has(b.box[end[1]], y);
      });
      EXPECT_TRUE(found) << s << ' ' << t;
    }
  EXPECT_TRUE(verified(r));
  EXPECT_TRUE(solved(model, SingularitySet::forward).cover.boxes.empty());
}

/// |P - s_i r_i (cos psi, sin psi) - A_i| = l_i, i = 1, 2, 3, by Newton's method from many starts; (P, psi), psi in [0, π).
std::vector<Eigen::Vector3d> parallel_rods() {
  const std::array<Eigen::Vector2d, 3> base{Eigen::Vector2d(0, 0), Eigen::Vector2d(1.25, 0.2), Eigen::Vector2d(0.5, 1.2)};
  const std::array<double, 3> crank{0.8, 0.7, 0.75}, rod{0.9, 1, 0.85};
  std::mt19937 random(4);
  std::uniform_real_distribution<double> place(-2, 3), angle(0, std::numbers::pi);
  std::vector<Eigen::Vector3d> found;
  const int starts = test::long_run() ? 1500 : 500;
  for (int pattern = 0; pattern < 8; ++pattern)
    for (int start = 0; start < starts; ++start) {
      Eigen::Vector3d x(place(random), place(random), angle(random)), f;
      Eigen::Matrix3d j;
      for (int step = 0; step < 40; ++step) {
        for (int i = 0; i < 3; ++i) {
          const double s = (pattern >> i & 1 ? -1 : 1) * rod[static_cast<std::size_t>(i)];
          const Eigen::Vector2d d =
              x.head<2>() - s * Eigen::Vector2d(std::cos(x[2]), std::sin(x[2])) - base[static_cast<std::size_t>(i)];
          f[i] = d.squaredNorm() - crank[static_cast<std::size_t>(i)] * crank[static_cast<std::size_t>(i)];
          j.row(i) << 2 * d.x(), 2 * d.y(), 2 * s * (d.x() * std::sin(x[2]) - d.y() * std::cos(x[2]));
        }
        x -= j.fullPivLu().solve(f);
        if (f.norm() < 1e-13) break;
      }
      if (!(f.norm() < 1e-12) || !x.allFinite()) continue;
      x[2] = std::fmod(std::fmod(x[2], 2 * std::numbers::pi) + 2 * std::numbers::pi, 2 * std::numbers::pi);
      if (x[2] >= std::numbers::pi) continue;  // that of the opposite pattern
      if (std::none_of(found.begin(), found.end(), [&](const Eigen::Vector3d& y) { return (x - y).norm() < 1e-6; }))
        found.push_back(x);
    }
  return found;
}

TEST(RedundantMechanisms, APointHeldByThreeArmsIsLostWhereTheirRodsAreParallel) {
  const result::Result r = solved(planar("three_arms").mechanism, SingularitySet::forward);
  EXPECT_EQ(r.options.kernel, "right");
  EXPECT_TRUE(r.cover.complete());
  EXPECT_EQ(r.cover.dimension, 0);
  const System system = result::system_of(r);
  const auto x = static_cast<std::size_t>(system.find("P_x")), y = static_cast<std::size_t>(system.find("P_y"));
  const std::vector<Eigen::Vector3d> sampled = parallel_rods();
  EXPECT_GT(sampled.size(), 4u);
  std::size_t isolated = 0;
  for (const CoverBox& p : r.cover.points) {
    isolated += p.verdict == Verdict::isolated;
    EXPECT_EQ(p.types.proven & (bit(ro) | bit(rpm) | bit(ii)), bit(ro)) << "II is everywhere, and no label";
  }
  EXPECT_EQ(isolated, r.cover.points.size());
  EXPECT_GE(isolated, sampled.size());
  for (const Eigen::Vector3d& s : sampled)
    EXPECT_TRUE(std::any_of(r.cover.points.begin(), r.cover.points.end(), [&](const CoverBox& p) {
      return std::fabs(p.box[x].mid() - s[0]) < 1e-6 && std::fabs(p.box[y].mid() - s[1]) < 1e-6;
    })) << s.transpose();
  EXPECT_TRUE(verified(r));
}

TEST(RedundantMechanisms, AThirdMotorRidsAFiveBarOfItsForwardSingularities) {
  const symbolic::Mechanism model = planar("five_bar_three_motors").mechanism;
  const result::Result r = solved(model, SingularitySet::forward);
  EXPECT_TRUE(r.cover.complete());
  EXPECT_TRUE(r.cover.boxes.empty());
  const result::Result inverse = solved(model, SingularitySet::inverse, 0.1);
  EXPECT_GT(inverse.cover.count(Verdict::regular), 50u);
  EXPECT_TRUE(verified(inverse)) << "the column of an arm that is folded is 0 but for roundings in the middle of its box";
  EXPECT_EQ(result::type_tally(inverse.cover).unproven, 0u) << "what is undecided names an exact point";
}

std::string refusal(const symbolic::Mechanism& model, SingularitySet set, std::optional<symbolic::KernelSide> side = {}) {
  try {
    symbolic::singularity_system(model, set, side);
  } catch (const symbolic::ModelError& error) {
    return error.what();
  }
  return "none";
}

TEST(RedundantMechanisms, HaveOneKernelThatTellsAnything) {
  using symbolic::KernelSide;
  const symbolic::Mechanism arm = planar("arm_4r").mechanism, arms = planar("three_arms").mechanism;
  EXPECT_THAT(refusal(arm, SingularitySet::inverse, KernelSide::right),
              HasSubstr("so every configuration has a right kernel; expected the left kernel"));
  EXPECT_THAT(refusal(arm, SingularitySet::ri),
              HasSubstr("so every configuration is one of the set ri; expected the set io"));
  EXPECT_THAT(refusal(arms, SingularitySet::forward, KernelSide::left),
              HasSubstr("so every configuration has a left kernel; expected the right kernel"));
  EXPECT_THAT(refusal(arms, SingularitySet::ii),
              HasSubstr("so every configuration is one of the set ii; expected the set ro"));
  EXPECT_THAT(refusal(arm, SingularitySet::rpm), HasSubstr("there are no passive coordinates, so L_p has no columns"));
  EXPECT_EQ(refusal(arms, SingularitySet::ro), "none");
  EXPECT_EQ(refusal(arm, SingularitySet::io), "none");
  EXPECT_THAT(refusal(arms, SingularitySet::ro, KernelSide::left), HasSubstr("every configuration has a left kernel"));
}

}  // namespace
}  // namespace corank
