// 6-UPS platforms at a fixed orientation: their forward singularities, a surface in x, y, z, against the determinant of
// their legs' lines (Merlet 2006, § 6): six lines are dependent where det (d_i, c_i × d_i) = 0, d_i from the base's joint to
// the platform's, c_i the platform's joint about its centre. How the model is written, exact or rounded to 12 digits, does
// not matter.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "corank/check/checker.h"
#include "corank/solve/search/solve.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/symbolic/sets/kernel_scale.h"
#include "corank/tests/cover_lookup.h"
#include "corank/tests/seeds.h"

namespace corank {
namespace {
using symbolic::SingularitySet;

constexpr std::array<int, 6> kBaseAngles{1, 7, 9, 15, 17, 23}, kPlatformAngles{3, 5, 11, 13, 19, 21};  // in π/12
constexpr double kRadius = 0.6;
// The first two columns of a rotation with rational entries.
constexpr std::array<const char*, 3> kU{"399/409", "84/409", "-32/409"}, kV{"-76/409", "393/409", "84/409"};
const Eigen::Vector3d kUValue(399.0 / 409, 84.0 / 409, -32.0 / 409), kVValue(-76.0 / 409, 393.0 / 409, 84.0 / 409);

// "3/5*cos(3/12*pi)", or its decimals.
std::string coordinate(const char* radius, double r, const char* function, int twelfths, bool exact) {
  if (exact) return fmt::format("{}*{}({}/12*pi)", radius, function, twelfths);
  const double angle = twelfths * std::numbers::pi / 12;
  return fmt::format("{:.12f}", r * (std::string(function) == "cos" ? std::cos(angle) : std::sin(angle)));
}

std::string model_text(bool exact) {
  std::string constants, variables = "x : [-1,1]\ny : [-1,1]\nz : [1/5,2]\n", equations, inputs;
  for (std::size_t k = 0; k < 3; ++k) {
    variables += fmt::format("u{0} : [{1},{1}]\n", "xyz"[k], kU[k]);
    variables += fmt::format("v{0} : [{1},{1}]\n", "xyz"[k], kV[k]);
  }
  equations = "ux^2+uy^2+uz^2=1;\nvx^2+vy^2+vz^2=1;\nux*vx+uy*vy+uz*vz=0;\n";
  for (std::size_t i = 0; i < 6; ++i) {
    const std::size_t n = i + 1;
    constants += fmt::format(
        "ax{} := {}\nay{} := {}\nbx{} := {}\nby{} := {}\n", n, coordinate("1", 1, "cos", kBaseAngles[i], exact), n,
        coordinate("1", 1, "sin", kBaseAngles[i], exact), n, coordinate("3/5", kRadius, "cos", kPlatformAngles[i], exact), n,
        coordinate("3/5", kRadius, "sin", kPlatformAngles[i], exact));
    variables += fmt::format("r{} : [1/10,4]\n", n);
    equations +=
        fmt::format("(x+bx{0}*ux+by{0}*vx-ax{0})^2+(y+bx{0}*uy+by{0}*vy-ay{0})^2+(z+bx{0}*uz+by{0}*vz)^2=r{0}^2;\n", n);
    inputs += fmt::format("{}r{}", i > 0 ? "," : "", n);
  }
  return "[CONSTANTS]\n" + constants + "[SYSTEM VARS]\n" + variables + "[SYSTEM EQS]\n" + equations + "[INPUTS] " + inputs +
         "\n[OUTPUTS] x,y,z,uy,uz,vz\n";
}

double determinant(const Eigen::Vector3d& p) {
  Eigen::Matrix<double, 6, 6> lines;
  for (int i = 0; i < 6; ++i) {
    const double a = kBaseAngles[static_cast<std::size_t>(i)] * std::numbers::pi / 12;
    const double b = kPlatformAngles[static_cast<std::size_t>(i)] * std::numbers::pi / 12;
    const Eigen::Vector3d c = kRadius * (std::cos(b) * kUValue + std::sin(b) * kVValue);
    const Eigen::Vector3d d = p + c - Eigen::Vector3d(std::cos(a), std::sin(a), 0);
    lines.row(i) << d.transpose(), c.cross(d).transpose();
  }
  return lines.determinant();
}

// On random chords of the domain, where the determinant changes its sign.
std::vector<std::array<double, 3>> singular_positions(std::size_t count) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  const auto position = [&] {
    return Eigen::Vector3d(2 * unit(random) - 1, 2 * unit(random) - 1, 0.2 + 1.8 * unit(random));
  };
  std::vector<std::array<double, 3>> found;
  while (found.size() < count) {
    Eigen::Vector3d a = position(), b = position();
    const bool a_is_negative = determinant(a) < 0;
    if (a_is_negative == (determinant(b) < 0)) continue;
    if (!a_is_negative) std::swap(a, b);
    for (int step = 0; step < 30; ++step) (determinant(0.5 * (a + b)) < 0 ? a : b) = 0.5 * (a + b);
    found.push_back({a.x(), a.y(), a.z()});
  }
  return found;
}

class StewartPlatform : public testing::TestWithParam<bool> {};

TEST_P(StewartPlatform, HasItsForwardSingularitiesEnclosedAndProvenWithFewBoxes) {
  const auto model = symbolic::parse_model(model_text(GetParam()), "stewart.cuik");
  const auto scales = symbolic::kernel_scales(model, SingularitySet::forward);
  const System system =
      symbolic::algebrize(symbolic::singularity_system(model, SingularitySet::forward, std::nullopt, scales));
  solve::Options options;
  options.sigma = 0.2;
  const Cover cover = solve::solve(system, options);
  EXPECT_TRUE(cover.complete());
  EXPECT_EQ(cover.boxes.size(), cover.count(Verdict::regular) + cover.count(Verdict::boundary));
  EXPECT_LE(cover.statistics.processed, 5000u);
  ASSERT_EQ(system.find("x"), 0);
  ASSERT_EQ(system.find("z"), 2);
  const test::CoverLookup lookup(cover);
  std::size_t lost = 0;
  for (const auto& p : singular_positions(test::long_run() ? 2000 : 500)) lost += !lookup.holds(p, 1e-7);
  EXPECT_EQ(lost, 0u);
  const check::Report report = check::check(system, cover);
  for (const auto& failure : report.failures) ADD_FAILURE() << "box " << failure.index << ": " << failure.reason;
}

INSTANTIATE_TEST_SUITE_P(Constants, StewartPlatform, testing::Bool(),
                         [](const auto& exact) { return exact.param ? "exact" : "of12Digits"; });

}  // namespace
}  // namespace corank
