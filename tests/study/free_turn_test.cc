// Parts in which an angle turns freely: planted conditions, right and damaged, and an Agile Eye by closed forms.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <set>
#include <stdexcept>
#include <string>

#include "corank/study/answer.h"
#include "corank/study/model.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/sets/free_fold.h"
#include "corank/tests/cover_lookup.h"
#include "corank/tests/seeds.h"

namespace corank::study {
namespace {

std::optional<symbolic::FreeTurn> turn_of(const std::string& equation, const std::string& condition,
                                          const std::string& range = "[-pi, pi]", const std::string& also = "x*y - z = 0") {
  const symbolic::Mechanism model =
      symbolic::parse_model("[CONSTANTS]\nk := sqrt(3)\n[SYSTEM VARS]\nx : [-2, 2]\ny : [-2, 2]\nz : [-4, 4]\nt ~ " + range +
                                "\nother ~ [-pi, pi]\n[SYSTEM EQS]\n" + equation + ";\n" + also + ";\n",
                            "planted");
  return symbolic::without_free_turn(model, symbolic::parse_expression(condition));
}

TEST(FreeTurn, IsFoundWhereItIsPlantedAndNowhereElse) {
  for (unsigned seed = 0; seed < test::seeds(40); ++seed) {
    std::mt19937 random(seed);
    const auto number = [&] { return std::to_string(1 + random() % 5); };
    const auto polynomial = [&] { return "(" + number() + "*x - " + number() + "*y*z + k*" + number() + "*cos(other))"; };
    const std::string u = polynomial(), v = polynomial(), w = polynomial();
    const auto sum = [](const std::string& a, const std::string& b) { return a + "*cos(t) + " + b + "*sin(t)"; };
    const std::string equation = sum(u, v), condition = number() + "*(" + sum("(-1)*" + v, u) + ")";
    const auto turn = turn_of(equation + " = 0", condition);
    ASSERT_TRUE(turn) << seed;
    EXPECT_EQ(turn->angle, "t");
    EXPECT_EQ(turn->system.equations.size(), 3u) << "u, v and the other equation";
    EXPECT_TRUE(turn_of("0 = " + equation, condition)) << seed;
    EXPECT_TRUE(turn_of(equation + " = 0", "-1*(" + condition + ")")) << seed;
    // Damaged ones.
    EXPECT_FALSE(turn_of(equation + " = 0", sum(v, u))) << seed;
    EXPECT_FALSE(turn_of(equation + " = 0", sum("(-1)*" + v, "2*" + u))) << seed;
    EXPECT_FALSE(turn_of(equation + " = 0", condition + " + x/100")) << seed;
    EXPECT_FALSE(turn_of(equation + " = 1", condition)) << seed;
    EXPECT_FALSE(turn_of(sum(w, v) + " = 0", condition)) << seed;
    EXPECT_FALSE(turn_of(equation + " + cos(t)^2 = 0", condition)) << seed;
    EXPECT_FALSE(turn_of(equation + " = 0", "x*(" + condition + ")")) << seed;
    EXPECT_FALSE(turn_of(equation + " = 0", condition, "[-1, 1]")) << "it does not turn fully";
    EXPECT_FALSE(turn_of(equation + " = 0", condition, "[-pi, pi]", "x + sin(t) = z")) << "another equation is about it";
    EXPECT_FALSE(turn_of(equation + " = 0", condition, "[-pi, pi]", "x + sin(t) <= z")) << "and an inequality";
  }
}

// Two constants with one value hold an angle as one would.
TEST(FreeTurn, IsNoneOfALockedAngle) {
  using Changes = std::vector<std::pair<std::string, std::string>>;
  const auto free_in = [](const std::string& name, const Changes& changes) {
    ModelText file = read_text(CORANK_SOURCE_DIR "/models/" + name + ".cuik");
    for (const auto& [from, to] : changes) {
      const std::size_t at = file.text.find(from);
      if (at == std::string::npos) throw std::invalid_argument(from);
      file.text.replace(at, from.size(), to);
    }
    std::set<std::string> names;
    const symbolic::Mechanism model = parse_model(file).mechanism;
    for (const result::Result& part : answer({.model = model, .set = symbolic::SingularitySet::inverse}, {}).parts)
      names.insert(part.free_coordinates.begin(), part.free_coordinates.end());
    return names;
  };
  EXPECT_EQ(free_in("spatial/agile_eye", {}), (std::set<std::string>{"theta1", "theta2", "theta3"}));
  EXPECT_TRUE(free_in("spatial/agile_eye", {{"lo1 := -pi", "lo1 := 1/2"}, {"up1 := pi", "up1 := 1/2"}}).empty());
  Changes all{{"range [t1, t1]", ""}, {"range [t4, t4]", ""}, {"range [t6, t6]", ""}};
  EXPECT_TRUE(free_in("serial/puma_560", all).contains("theta5"));
  all.emplace_back("lo5 := -pi", "lo5 := 1/2");
  all.emplace_back("up5 := pi", "up5 := 1/2");
  EXPECT_EQ(free_in("serial/puma_560", all), (std::set<std::string>{"theta1", "theta2", "theta4", "theta6"}));
}

using Axis = std::array<double, 3>;

Axis cross(const Axis& a, const Axis& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// One outer axis is on its motor's, and the eye is turned about it; or in one of its four orientations, where all motors
// turn.
TEST(FreeTurn, OfAnAgileEyesLegsLosesNothing) {
  const Model robot = read_model(CORANK_SOURCE_DIR "/models/spatial/agile_eye.cuik");
  const result::Result result = answer({.model = robot.mechanism, .set = symbolic::SingularitySet::inverse}, {});
  EXPECT_TRUE(result.cover.complete());
  ASSERT_EQ(result.parts.size(), 3u);
  for (const result::Result& part : result.parts) EXPECT_EQ(part.free_coordinates.size(), 1u);
  EXPECT_LT(result.cover.count(Verdict::undecided), 150u);
  ASSERT_EQ(result.variables[0].name, "c_theta1");
  ASSERT_EQ(result.variables[6].name, "axis_v1_x");
  const test::CoverLookup lookup(result.cover);
  std::mt19937 random(3);
  const auto any_angle = [&] { return std::uniform_real_distribution<>(-std::numbers::pi, std::numbers::pi)(random); };
  for (int trial = 0; trial < 3000; ++trial) {
    const int leg = trial % 3, sign = random() % 2 == 0 ? 1 : -1;
    const bool all_turn = random() % 4 == 0;
    const double psi = all_turn ? (random() % 2 == 0 ? 0 : std::numbers::pi) : any_angle();
    std::array<Axis, 3> axes{};  // of the eye, each on a motor's axis where ψ = 0
    axes[leg][leg] = sign;
    const int next = (leg + 1) % 3, last = (leg + 2) % 3;
    axes[next][next] = std::cos(psi), axes[next][last] = std::sin(psi);
    axes[last] = cross(axes[leg], axes[next]);
    // Where the eye is turned, a leg's middle axis, (0, cos θ, sin θ) and so on in turn, is perpendicular to its outer one.
    std::array<double, 3> angles{any_angle(), any_angle(), any_angle()};
    for (int k = 0; k < 3 && !all_turn; ++k) {
      if (k == leg) continue;
      const bool half = random() % 2 == 0;
      const double away = k == next ? std::numbers::pi / 2 : 0;
      angles[k] = (half ? std::numbers::pi : 0) + away;
    }
    std::vector<double> place;
    for (const double angle : angles) place.push_back(std::cos(angle)), place.push_back(std::sin(angle));
    for (const Axis& axis : axes) place.insert(place.end(), axis.begin(), axis.end());
    EXPECT_TRUE(lookup.holds(place, test::kSampleTolerance)) << "trial " << trial << ", leg " << leg + 1;
  }
}

}  // namespace
}  // namespace corank::study
