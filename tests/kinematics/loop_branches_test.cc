// The branches of parallelograms that are written out, against positions found with circles.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <random>

#include "corank/tests/kinematics/assembled.h"

namespace corank::kinematics {
namespace {

using Point = std::complex<double>;
using std::numbers::pi;

// A four-bar on the ground: the ground and the coupler of length a, the others of length b; the coupler may be a rod. Hinges
// lie where random frames of the links put them.
class FourBar {
 public:
  FourBar(int a, int b, int ground_turn, bool has_rod) : a_(a), b_(b), turn_(ground_turn), has_rod_(has_rod) {}

  std::string text(bool keeps = false) const {
    const auto [c, s] = turned();
    const std::string across = fmt::format("({}*{}, {}*{}, 0)+(0,0,1)", a_, c, a_, s);
    return fmt::format("[LINKS]\nG\nB\n{}D\n[JOINTS]\n{}revolute t : G (0,0,0)+(0,0,1) D (0,0,0)+(0,0,1) actuated\n",
                       has_rod_ ? "" : "C\n", keeps ? "keep parallelograms\n" : "") +
           fmt::format("revolute s : G {} B (1,2,0)+(0,0,1)\n", across) +
           (has_rod_ ? fmt::format("sph_sph rod : D ({},0,0) B (1,{},0) length {}\n", b_, 2 + b_, a_)
                     : fmt::format("revolute : D ({},0,0)+(0,0,1) C (3,0,0)+(0,0,1)\n"
                                   "revolute : C ({},0,0)+(0,0,1) B (1,{},0)+(0,0,1)\n",
                                   b_, 3 - a_, 2 + b_));
  }
  Point ground() const {
    const std::array<Point, 3> turns{Point{1, 0}, Point{0.6, 0.8}, Point{-5.0 / 13, 12.0 / 13}};
    return static_cast<double>(a_) * turns[static_cast<std::size_t>(turn_)];
  }

  /// Coordinates where the tips of D and B are p4 and p3. B's way to its tip is (0, b) in its frame, C's (−a, 0).
  std::map<std::string, double> at(Point p4, Point p3, double crosswise) const {
    std::map<std::string, double> values{{"t", std::arg(p4)}, {"s", std::arg(p3 - ground()) - pi / 2}};
    if (!has_rod_) values["phi_C"] = std::arg(p3 - p4) - pi;
    values["crosswise"] = crosswise;
    return values;
  }
  /// The configuration is one of the branch's.
  static bool holds(const Assembly& robot, std::map<std::string, double> values) {
    for (const symbolic::Constant& c : robot.mechanism.constants()) values[c.name] = symbolic::evaluate(c.value, values);
    for (const symbolic::Coordinate& c : robot.mechanism.coordinates()) EXPECT_TRUE(values.contains(c.name)) << c.name;
    for (const symbolic::Constraint& c : robot.mechanism.constraints()) {
      const double value = symbolic::evaluate(c.relation.lhs, values) - symbolic::evaluate(c.relation.rhs, values);
      if (c.relation.kind == symbolic::Relation::Kind::equal ? std::fabs(value) > 1e-9 : value < 1e-3) return false;
    }
    return true;
  }

  int a() const { return a_; }
  int b() const { return b_; }

 private:
  std::pair<const char*, const char*> turned() const {
    const std::array<std::pair<const char*, const char*>, 3> turns{{{"1", "0"}, {"(3/5)", "(4/5)"}, {"(-5/13)", "(12/13)"}}};
    return turns[static_cast<std::size_t>(turn_)];
  }

  int a_, b_, turn_;
  bool has_rod_;
};

// Where circles of radii b about p2 and a about p4 meet, apart from the point that completes the parallelogram.
Point other_meeting(Point p2, Point p4) {
  const Point way = p4 - p2, parallel = p4 + p2;
  const Point foot = p2 + way * ((parallel - p2) * std::conj(way)).real() / std::norm(way);
  return 2.0 * foot - parallel;
}

TEST(LoopBranches, HoldEachConfigurationOfTheirOwnAndNoOther) {
  std::mt19937_64 random(19);
  const auto pick = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
  std::uniform_real_distribution<double> angle(-pi, pi);
  int rhombi = 0;
  for (int round = 0; round < 60; ++round) {
    const int a = pick(1, 6), b = pick(0, 3) == 0 ? a : pick(1, 6);
    const FourBar bar(a, b, pick(0, 2), pick(0, 1) == 1);
    SCOPED_TRACE(bar.text());
    const Assembly robot = assembled(bar.text());
    ASSERT_EQ(robot.parallelograms.size(), 1u);
    ASSERT_EQ(robot.parallelograms[0].angle, "crosswise");
    EXPECT_EQ(robot.parallelograms[0].is_rhombus, a == b);
    EXPECT_EQ(robot.mobility, 1);
    EXPECT_EQ(robot.mobility_by_rank, 1);
    rhombi += a == b;
    for (int trial = 0; trial < 20; ++trial) {
      const double t = angle(random);
      const Point p2 = bar.ground(), p4 = std::polar(static_cast<double>(b), t);
      if (std::fabs((std::conj(p2) * p4).imag()) < 0.05 * a * b) continue;  // nearly flat
      const Point parallel = p2 + p4, other = other_meeting(p2, p4);
      for (const double way : {0.0, pi / 2, pi}) {
        EXPECT_EQ(FourBar::holds(robot, bar.at(p4, parallel, way)), way == 0) << t << ' ' << way;
        EXPECT_EQ(FourBar::holds(robot, bar.at(p4, other, way)), way == pi) << t << ' ' << way;
        // What closes no loop.
        EXPECT_FALSE(FourBar::holds(robot, bar.at(p4, p2 - p4, way))) << t << ' ' << way;
        EXPECT_FALSE(FourBar::holds(robot, bar.at(p4, p2 + std::polar(static_cast<double>(b), t + 1), way)));
        if (a != b) continue;
        // Folded upon itself: D lies on the ground, B on C.
        EXPECT_EQ(FourBar::holds(robot, bar.at(p2, p2 + p4, way)), way == pi / 2) << t << ' ' << way;
      }
    }
    // Flat positions are both.
    for (const double sign : {1.0, -1.0}) {
      const Point p2 = bar.ground(), p4 = sign * p2 * static_cast<double>(b) / static_cast<double>(a);
      EXPECT_TRUE(FourBar::holds(robot, bar.at(p4, p2 + p4, 0)));
      EXPECT_TRUE(a == b || FourBar::holds(robot, bar.at(p4, p2 + p4, pi)));
    }
  }
  EXPECT_GT(rhombi, 8);
}

TEST(LoopBranches, AreNotToldApartInAParallelogramThatIsKept) {
  const Assembly robot = assembled(FourBar(3, 2, 1, false).text(true));
  EXPECT_TRUE(robot.parallelograms.empty());
  EXPECT_EQ(coordinate_names(robot), std::vector<std::string>{"t"});
}

}  // namespace
}  // namespace corank::kinematics
