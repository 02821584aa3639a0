// Labels of curves that are solved in parts, with an equation in place of a kernel vector, against ranks in doubles:
// random five-bars, at configurations with a leg or with the distal links in a line, and where both legs are.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>

#include "corank/result/files/verification.h"
#include "corank/result/values/tallies.h"
#include "corank/study/answer.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/tests/seeds.h"

namespace corank {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
constexpr double kPi = std::numbers::pi;

Vector2d e(double t) { return {std::cos(t), std::sin(t)}; }

/// Bases at (0, 0) and (base, 0), lengths in tenths.
struct FiveBarLinkage {
  double base, proximal[2], distal[2];
  struct Place {
    Vector2d p;
    double t[2], a[2];
    double value(const std::string& name) const {  // of a variable, or of an angle
      if (name == "x" || name == "y") return p[name == "y"];
      const std::string angle = name.substr(name.size() - 2);
      const double value = (angle[0] == 't' ? t : a)[angle[1] - '1'];
      return name == angle ? value : name[0] == 'c' ? std::cos(value) : std::sin(value);
    }
  };

  std::string text() const {
    return fmt::format(
        "[SYSTEM VARS]\nx : [-9, 9]\ny : [-9, 9]\nt1 ~\nt2 ~\na1 ~\na2 ~\n[SYSTEM EQS]\n"
        "x = {0}*cos(t1) + {1}*cos(a1);\ny = {0}*sin(t1) + {1}*sin(a1);\n"
        "x = {2} + {3}*cos(t2) + {4}*cos(a2);\ny = {3}*sin(t2) + {4}*sin(a2);\n[INPUTS] t1, t2\n[OUTPUTS] x, y\n",
        proximal[0], distal[0], base, proximal[1], distal[1]);
  }
  Vector2d foot(int leg) const { return {leg * base, 0}; }

  // The leg's angles for a tip there, its elbow on either side; exactly in a line where it just reaches.
  bool reach(int leg, const Vector2d& p, double side, Place& place) const {
    const Vector2d d = p - foot(leg);
    const double r = d.norm(), c = (r * r + std::pow(proximal[leg], 2) - std::pow(distal[leg], 2)) / (2 * r * proximal[leg]);
    if (std::fabs(c) > 1 + 1e-12) return false;
    place.t[leg] = std::atan2(d[1], d[0]) + side * std::acos(std::clamp(c, -1.0, 1.0));
    const Vector2d rest = d - proximal[leg] * e(place.t[leg]);
    place.a[leg] = std::atan2(rest[1], rest[0]);
    return true;
  }
  MatrixXd jacobian(const Place& q) const {  // by x, y, t1, t2, a1, a2
    MatrixXd j = MatrixXd::Zero(4, 6);
    for (int leg = 0; leg < 2; ++leg) {
      j.block<2, 2>(2 * leg, 0).setIdentity();
      const Vector2d t = e(q.t[leg] + kPi / 2), a = e(q.a[leg] + kPi / 2);
      j.block<2, 1>(2 * leg, 2 + leg) = -proximal[leg] * t;
      j.block<2, 1>(2 * leg, 4 + leg) = -distal[leg] * a;
    }
    return j;
  }
};

int rank_in_doubles(const MatrixXd& m) {
  const Eigen::VectorXd s = Eigen::JacobiSVD<MatrixXd>(m).singularValues();
  return static_cast<int>((s.array() > 1e-6 * s[0]).count());
}

struct Tally {
  std::size_t samples = 0, in_boxes = 0, settled = 0, single = 0, crossings = 0, wrong = 0;
};

// What boxes of the parts that have the configuration say of it.
void compare(const FiveBarLinkage& robot, const result::Result& result, const FiveBarLinkage::Place& q, bool forward,
             Tally& tally) {
  using enum SingularityType;
  const MatrixXd j = robot.jacobian(q);
  MatrixXd y(4, 4), z = j.rightCols(4);
  y << j.leftCols(2), j.rightCols(2);
  const int all = rank_in_doubles(j), of_y = rank_in_doubles(y), of_z = rank_in_doubles(z),
            p = rank_in_doubles(j.rightCols(2)), kernel = 4 - (forward ? of_y : of_z);
  ASSERT_GT(kernel, 0);
  TypeSet types = 0;
  const auto set = [&](SingularityType type, bool is_so) { types |= is_so ? bit(type) : TypeSet{0}; };
  set(ro, of_y < 2 + p), set(ri, of_z < 2 + p), set(rpm, p < 2), set(ii, of_y < all), set(io, of_z < all), set(iim, all < 4);
  const auto has = [&](const std::string& name) {  // "a1 = t1", "a2 = t2 + pi", "a2 = a1"
    const std::string left = name.substr(0, 2), right = name.substr(5, 2);
    return std::fabs(std::remainder(q.value(left) - q.value(right) - (name.size() > 7 ? kPi : 0), 2 * kPi)) < 1e-6;
  };
  ++tally.samples;
  tally.crossings += kernel > 1;
  bool found = false;
  for (const CoverBox& box : result.cover.boxes) {
    bool inside = true;
    for (std::size_t v = 0; v < result.variables.size() && inside; ++v) {
      const double x = q.value(result.variables[v].name);
      inside = x > box.box[v].lo() - 1e-9 && x < box.box[v].hi() + 1e-9;
    }
    if (!inside || !has(result.parts[static_cast<std::size_t>(box.part)].part)) continue;
    found = true;
    ++tally.in_boxes;
    tally.settled += box.types.settle(result.cover.types.of_set);
    tally.single += box.kernel_at_most == 1;
    tally.wrong += (box.types.proven & ~types) != 0 || (box.types.excluded & types) != 0;
    tally.wrong += box.kernel_at_most >= 0 && kernel > box.kernel_at_most;
  }
  tally.wrong += !found;
}

class Samples {
 public:
  explicit Samples(unsigned seed) : random_(seed) {
    const auto length = [&] { return draw(5, 15) / 10.0; };
    robot = {draw(5, 20) / 10.0, {length(), length()}, {length(), length()}};
  }
  // Leg 1 or 2 in a line, stretched or folded.
  std::optional<FiveBarLinkage::Place> leg_in_line() {
    const int leg = draw(0, 1);
    FiveBarLinkage::Place q;
    q.t[leg] = angle();
    q.a[leg] = q.t[leg] + kPi * draw(0, 1);
    q.p = robot.foot(leg) + robot.proximal[leg] * e(q.t[leg]) + robot.distal[leg] * e(q.a[leg]);
    return robot.reach(1 - leg, q.p, 2 * draw(0, 1) - 1, q) ? std::optional(q) : std::nullopt;
  }
  // Both: the tip is on two circles.
  std::optional<FiveBarLinkage::Place> legs_in_line() {
    const double r0 = robot.proximal[0] + (2 * draw(0, 1) - 1) * robot.distal[0],
                 r1 = robot.proximal[1] + (2 * draw(0, 1) - 1) * robot.distal[1],
                 x = (r0 * r0 - r1 * r1 + robot.base * robot.base) / (2 * robot.base), y = r0 * r0 - x * x;
    if (!(y > 1e-3)) return std::nullopt;
    FiveBarLinkage::Place q;
    q.p = {x, (2 * draw(0, 1) - 1) * std::sqrt(y)};
    for (const int leg : {0, 1}) {
      const double r = leg == 0 ? r0 : r1;
      const Vector2d d = (q.p - robot.foot(leg)) / r;
      q.t[leg] = std::atan2(d[1], d[0]);
      q.a[leg] = q.t[leg] + (r == robot.proximal[leg] + robot.distal[leg] ? 0 : kPi);
    }
    return q;
  }
  // The distal links in a line: a root of |elbow 2 − foot 2| = its link.
  std::optional<FiveBarLinkage::Place> distal_in_line() {
    FiveBarLinkage::Place q;
    q.t[0] = angle();
    const double turn = kPi * draw(0, 1);
    const auto elbow = [&](double a) -> Vector2d {
      return robot.proximal[0] * e(q.t[0]) + robot.distal[0] * e(a) - robot.distal[1] * e(a + turn);
    };
    const auto gap = [&](double a) { return (elbow(a) - robot.foot(1)).norm() - robot.proximal[1]; };
    double lo = angle(), hi = angle();
    const bool rises = gap(lo) < 0;
    if (rises == (gap(hi) < 0)) return std::nullopt;
    for (int i = 0; i < 60; ++i) ((gap((lo + hi) / 2) < 0) == rises ? lo : hi) = (lo + hi) / 2;
    q.a[0] = lo;
    q.a[1] = lo + turn;
    const Vector2d d = elbow(lo) - robot.foot(1);
    q.t[1] = std::atan2(d[1], d[0]);
    q.p = robot.proximal[0] * e(q.t[0]) + robot.distal[0] * e(lo);
    return q;
  }

  FiveBarLinkage robot{};

 private:
  int draw(int from, int to) { return std::uniform_int_distribution(from, to)(random_); }
  double angle() { return std::uniform_real_distribution(-kPi, kPi)(random_); }
  std::mt19937 random_;
};

TEST(LabelsOfParts, AreThoseOfTheRanks) {
  Tally tally;
  const unsigned count = test::seeds(10);
  for (unsigned seed = 0; seed < count && tally.wrong == 0; ++seed) {
    Samples samples(seed);
    for (const bool forward : {true, false}) {
      const study::Question question{.model = symbolic::parse_model(samples.robot.text(), "bar.cuik"),
                                     .set = forward ? symbolic::SingularitySet::forward : symbolic::SingularitySet::inverse,
                                     .in_parts = true};
      const result::Result result = study::answer(question, {.search = {.sigma = 0.05}});
      ASSERT_FALSE(result.parts.empty());
      EXPECT_TRUE(result.cover.complete());
      for (int k = 0; k < 60; ++k) {
        if (const auto q = forward ? samples.distal_in_line() : samples.leg_in_line())
          compare(samples.robot, result, *q, forward, tally);
        if (const auto q = samples.legs_in_line(); q && !forward) compare(samples.robot, result, *q, forward, tally);
      }
      if (seed % 5 == 0) {
        EXPECT_TRUE(result::verify(result).verified()) << samples.robot.text();
      }
    }
  }
  EXPECT_EQ(tally.wrong, 0u);
  EXPECT_GT(tally.samples, 20 * count);
  EXPECT_GT(tally.crossings, 5 * count);
  EXPECT_GT(tally.settled, tally.in_boxes * 9 / 10);
  EXPECT_GT(tally.single, tally.in_boxes / 3);
  if (test::long_run())
    std::cout << tally.samples << " samples, " << tally.crossings << " of them crossings, " << tally.in_boxes << " boxes, "
              << tally.settled << " typed, " << tally.single << " with a kernel of dimension 1; wrong " << tally.wrong
              << "\n";
}

// What is said of the parts is said of the whole, in its file as well, and nothing else is taken for it.
TEST(LabelsOfParts, AreThoseOfTheWhole) {
  const FiveBarLinkage symmetric{1, {0.9, 0.9}, {0.7, 0.7}};
  const result::Result result = study::answer({.model = symbolic::parse_model(symmetric.text(), "bar.cuik"),
                                               .set = symbolic::SingularitySet::inverse,
                                               .in_parts = true});
  const result::TypeTally types = result::type_tally(result.cover);
  EXPECT_EQ(types.proven.at(SingularityType::ri), result.cover.boxes.size());
  EXPECT_EQ(result::kernel_tally(result).at_most.at(1) + result::kernel_tally(result).at_most[2], result.cover.boxes.size());
  EXPECT_TRUE(result::is_made_of_parts(result));
  result::Result claimed = result;
  claimed.cover.boxes[0].types.excluded |= bit(SingularityType::ri);
  EXPECT_FALSE(result::is_made_of_parts(claimed));
  claimed = result;
  for (result::Result& part : claimed.parts)
    for (CoverBox& box : part.cover.boxes) box.types = {bit(SingularityType::rpm), 0};
  result::merge_parts(claimed);
  EXPECT_FALSE(result::verify(claimed).verified());
  claimed = result;
  for (result::Result& part : claimed.parts)
    for (CoverBox& box : part.cover.boxes) box.kernel_at_most = 1;
  result::merge_parts(claimed);
  EXPECT_FALSE(result::verify(claimed).verified()) << "legs may be in a line at once";
}

}  // namespace
}  // namespace corank
