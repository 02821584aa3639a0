// An RSSR linkage by the twist of its coupler against its equations. A crank about the z axis with the ball A = (r cos t,
// r sin t, 0), a rocker about the axis through C along x with the ball B = C + s (0, cos f, sin f), a coupler of length l
// from A to B. With the coupler's vector d = B - A, forward (the crank locked): (x × (B - C))·d = 0, inverse: (z × A)·d = 0.
#include <gtest/gtest.h>

#include <cmath>

#include "corank/solve/search/solve.h"
#include "corank/tests/models/given_rates.h"

namespace corank {
namespace {
using symbolic::KernelSide;
using symbolic::SingularitySet;

// All lengths in a unit u.
const std::string kLinkage =
    "[CONSTANTS]\nu := 1\nr := 3/2*u\ns := 3/2*u\nl := 2*u\na := 1/2*u\nb := 1/4*u\nh := 3/2*u\n[SYSTEM VARS]\nt ~\nf ~\n"
    "dx :\ndy :\ndz :\n[SYSTEM EQS]\nr*cos(t) + dx = a;\nr*sin(t) + dy = b + s*cos(f);\ndz = h + s*sin(f);\n"
    "dx^2 + dy^2 + dz^2 = l^2;\n";
// v is the velocity of A, w the coupler's angular velocity, without its spin about d.
const std::string kTwist =
    "[RATES]\nw1 ~ input\nw2 ~ output\nwx ~ passive\nwy ~ passive\nwz ~ passive\nvx : passive\nvy : passive\nvz : passive\n"
    "[VELOCITY EQS]\nvx = -r*sin(t)*w1;\nvy = r*cos(t)*w1;\nvz = 0;\nvx + wy*dz - wz*dy = 0;\n"
    "vy + wz*dx - wx*dz = -s*sin(f)*w2;\nvz + wx*dy - wy*dx = s*cos(f)*w2;\nwx*dx + wy*dy + wz*dz = 0;\n";

symbolic::Mechanism linkage(const std::string& more, const char* unit = "1") {
  auto m = symbolic::parse_model(kLinkage + more, "rssr.cuik");
  m.set_constant("u", symbolic::Expression(unit));
  return m;
}

// Middles of the configurations of isolated points, lengths in u.
std::vector<std::vector<double>> points(const Cover& cover, const System& system, double unit) {
  std::vector<std::vector<double>> list;
  for (const CoverBox& p : cover.points) {
    EXPECT_EQ(p.verdict, Verdict::isolated);
    std::vector<double> q;
    for (std::size_t j = 0; j < static_cast<std::size_t>(system.configuration_size); ++j)
      q.push_back(p.box[j].mid() / (system.variables[j].kind == VariableKind::length ? unit : 1));
    list.push_back(q);
  }
  std::sort(list.begin(), list.end());
  return list;
}

double size_of_work(const std::vector<double>& q, SingularitySet set) {  // c_t, s_t, c_f, s_f, dx, dy, dz
  return std::fabs(set == SingularitySet::forward ? -1.5 * q[3] * q[5] + 1.5 * q[2] * q[6]
                                                  : 1.5 * (-q[1] * q[4] + q[0] * q[5]));
}

TEST(Rssr, HasTheSameSingularitiesByTheTwistOfItsCoupler) {
  for (const SingularitySet set : {SingularitySet::forward, SingularitySet::inverse}) {
    SCOPED_TRACE(to_string(set));
    const System by_equations = test::study_system(linkage("[INPUTS] t\n[OUTPUTS] f\n"), set);
    const Cover derived = solve::solve(by_equations);
    ASSERT_TRUE(derived.complete());
    const std::vector<std::vector<double>> expected = points(derived, by_equations, 1);
    EXPECT_GE(expected.size(), 2u);
    for (const KernelSide side : {KernelSide::right, KernelSide::left})
      for (const auto& [text, unit] : {std::pair("1", 1.0), std::pair("1/1000", 1e-3), std::pair("1000", 1e3)}) {
        const System system = test::study_system(linkage(kTwist, text), set, side);
        const Cover given = solve::solve(system);
        EXPECT_TRUE(given.complete());
        EXPECT_EQ(given.count(Verdict::undecided), 0u);
        const std::vector<std::vector<double>> found = points(given, system, unit);
        ASSERT_EQ(found.size(), expected.size()) << text;
        for (std::size_t k = 0; k < found.size(); ++k) {
          EXPECT_LT(size_of_work(found[k], set), 1e-9);
          for (std::size_t j = 0; j < found[k].size(); ++j) EXPECT_NEAR(found[k][j], expected[k][j], 1e-9);
        }
      }
  }
}

}  // namespace
}  // namespace corank
