// Clearances of robots against singular configurations that are found otherwise: by closed forms, and along many rays.
#include "corank/analyze/clearance/clearance.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <regex>

#include "corank/result/files/verification.h"
#include "corank/study/model.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/tests/seeds.h"

namespace corank::analyze {
namespace {

study::Question robot(const std::filesystem::path& file) {
  study::Model model = study::read_model(file);
  return {
      .model = std::move(model.mechanism), .set = symbolic::SingularitySet::forward, .assembly = std::move(model.assembly)};
}
study::Question model(const std::string& name) { return robot(std::filesystem::path(CORANK_SOURCE_DIR) / "models" / name); }

Clearance clearance_of(const study::Question& question, const BallOptions& ball, double precision = 0.01) {
  solve::Control control;
  solve::Options search;
  search.threads = 2;
  return clearance(question, ball, {.precision = precision}, search, control);
}

double value(const Clearance& c, const std::string& name) {
  for (const CoordinateValue& v : c.values)
    if (v.name == name) return v.value.mid();
  ADD_FAILURE() << "no " << name;
  return NAN;
}

void expect_close(const Clearance& c, double precision = 0.01) {
  ASSERT_TRUE(c.nearest.complete);
  ASSERT_TRUE(c.nearest.upper);
  EXPECT_GE(c.nearest.lower, (1 - precision) * *c.nearest.upper * (1 - 1e-12));
}

TEST(Clearance, OfDextarIsThatOfItsClosedForm) {
  std::mt19937 random(3);
  std::uniform_int_distribution<int> place(-60, 60);
  const study::Question dextar = model("dextar.cuik");
  const double l = 0.9, d = 1.18;
  const int places = test::long_run() ? 6 : 2;
  int tried = 0;
  while (tried < places) {
    const double x = 0.59 + place(random) / 100.0, y = place(random) / 64.0;
    if (std::hypot(x, y) > 1.75 || std::hypot(x - d, y) > 1.75) continue;
    ++tried;
    // J2, J3, J4 in a line: J3 is halfway where J2 and J4 are 2 l apart, or anywhere about J2 = J4.
    double least = 1e9;
    for (int k = 0; k < 40'000; ++k) {
      const double theta2 = 2 * M_PI * k / 40'000, ax = d + l * std::cos(theta2), ay = l * std::sin(theta2);
      const double a = std::hypot(ax, ay), cosine = (a * a + l * l - 4 * l * l) / (2 * a * l);
      if (std::fabs(cosine) > 1) continue;
      for (const double sign : {-1, 1}) {
        const double theta5 = std::atan2(ay, ax) + sign * std::acos(cosine);
        least = std::min(least, std::hypot((ax + l * std::cos(theta5)) / 2 - x, (ay + l * std::sin(theta5)) / 2 - y));
      }
    }
    const double height = std::sqrt(l * l - d * d / 4);
    for (const double h : {-height, height}) least = std::min(least, std::fabs(std::hypot(x - d / 2, y - h) - l));
    const auto number = [](double v) { return symbolic::parse_expression(ExactNumber::dyadic(v).text()); };
    const Clearance c = clearance_of(dextar, {.at = {{"J3x", number(x)}, {"J3y", number(y)}}, .in = {"J3x", "J3y"}});
    expect_close(c);
    EXPECT_EQ(c.center, Clearance::Center::assembled);
    EXPECT_LE(c.nearest.lower, least);
    EXPECT_GE(*c.nearest.upper, least - 1e-4) << "sampled in steps";
    EXPECT_NEAR(std::hypot(value(c, "J3x") - x, value(c, "J3y") - y), *c.nearest.upper, 1e-6);
    EXPECT_NEAR(std::sin(value(c, "theta3") - value(c, "theta4")), 0, 1e-6) << "a forward singularity";
  }
}

TEST(Clearance, DoesNotDependOnTheUnitOfLength) {
  std::uint64_t processed = 0;
  for (const double unit : {1.0, 1e-3, 1e3, 1e6}) {
    const auto times = [unit](const std::string& text) {
      return symbolic::parse_expression("(" + text + ")*" + ExactNumber::dyadic(unit > 1 ? unit : 1 / unit).text() +
                                        (unit > 1 ? "" : "^(-1)"));
    };
    study::Question dextar = model("dextar.cuik");
    dextar.model.set_constant("l", times("9/10"));
    dextar.model.set_constant("d", times("59/50"));
    const Clearance c =
        clearance_of(dextar, {.at = {{"J3x", times("-7/100")}, {"J3y", times("-3/10")}}, .in = {"J3x", "J3y"}});
    expect_close(c);
    EXPECT_NEAR(c.nearest.lower / unit, 0.03558, 1e-4) << unit;
    EXPECT_NEAR(*c.nearest.upper / unit, 0.03594, 1e-4) << unit;
    if (processed == 0) processed = c.nearest.statistics.processed;
    EXPECT_LT(c.nearest.statistics.processed, 2 * processed) << unit;
  }
}

// The rows of the platform's statics: the legs' directions and moments. Nothing where a leg is out of its range.
struct Platform {
  Eigen::Matrix<double, 3, 6> base, platform;
  std::optional<double> determinant(const Eigen::Vector3d& p, const Eigen::Matrix3d& r) const {
    Eigen::Matrix<double, 6, 6> m;
    for (int i = 0; i < 6; ++i) {
      const Eigen::Vector3d arm = r * platform.col(i), leg = p + arm - base.col(i);
      if (leg.norm() < 0.1 || leg.norm() > 4) return std::nullopt;
      m.row(i) << leg.transpose(), arm.cross(leg).transpose();
    }
    return m.determinant();
  }
};

Platform stewart() {
  Platform s;
  const int base[6] = {1, 7, 9, 15, 17, 23}, platform[6] = {3, 5, 11, 13, 19, 21};
  for (int i = 0; i < 6; ++i) {
    s.base.col(i) << std::cos(base[i] * M_PI / 12), std::sin(base[i] * M_PI / 12), 0;
    s.platform.col(i) << 0.6 * std::cos(platform[i] * M_PI / 12), 0.6 * std::sin(platform[i] * M_PI / 12), 0;
  }
  return s;
}

Eigen::Matrix3d kept() {
  using Eigen::AngleAxisd;
  return (AngleAxisd(0.2, Eigen::Vector3d::UnitZ()) * AngleAxisd(0.1, Eigen::Vector3d::UnitY()) *
          AngleAxisd(0.3, Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

Eigen::Vector3d direction(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized();
}

// The least distance along random rays at which the determinant changes its sign, with an orientation within the range.
double sampled(const Eigen::Vector3d& center, double range, int rays) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> angle(0, range);
  const Platform s = stewart();
  double least = 1e9;
  for (int k = 0; k < rays; ++k) {
    const Eigen::Matrix3d r =
        Eigen::AngleAxisd(k % 2 == 0 ? range : angle(random), direction(random)).toRotationMatrix() * kept();
    const Eigen::Vector3d ray = direction(random);
    std::optional<double> before = s.determinant(center, r);
    for (double t = 0.01; t < std::min(least, 0.9); t += 0.01) {
      const std::optional<double> now = s.determinant(center + t * ray, r);
      if (before && now && *before * *now <= 0) least = t;  // between t − 0.01 and t
      before = now;
    }
  }
  return least;
}

TEST(Clearance, OfAStewartPlatformInOneOrientationIsThatOfManyRays) {
  const Clearance c = clearance_of(model("platforms/stewart.cuik"),
                                   {.at = {{"P_x", 0}, {"P_y", 0}, {"P_z", 1}}, .in = {"P_x", "P_y", "P_z"}});
  expect_close(c);
  const double least = sampled({0, 0, 1}, 0, 400);
  EXPECT_GT(least, c.nearest.lower);
  EXPECT_LT(least, 1.2 * *c.nearest.upper) << "rays enough";
  const auto at = stewart().determinant({value(c, "P_x"), value(c, "P_y"), value(c, "P_z")}, kept());
  ASSERT_TRUE(at);
  EXPECT_NEAR(*at, 0, 1e-6) << "a singular configuration";
}

TEST(Clearance, OfAStewartPlatformThatMayTurnIsThatOfManyRays) {
  const auto file = std::filesystem::path(testing::TempDir()) / "turning_stewart.cuik";
  std::ifstream in(std::filesystem::path(CORANK_SOURCE_DIR) / "models/platforms/stewart.cuik");
  std::string text{std::istreambuf_iterator<char>(in), {}};
  std::ofstream(file) << std::regex_replace(text, std::regex("keeps [^\n]*"), "");
  const double range = 5 * M_PI / 180;
  const Clearance c = clearance_of(robot(file),
                                   {.at = {{"P_x", 0}, {"P_y", 0}, {"P_z", 1}},
                                    .in = {"P_x", "P_y", "P_z"},
                                    .orientation_range = symbolic::parse_expression("5*pi/180"),
                                    .orientation = parse_rotation("Rz(yaw)*Ry(pitch)*Rx(roll)")},
                                   0.1);
  expect_close(c, 0.1);
  const double least = sampled({0, 0, 1}, range, 400);
  EXPECT_GT(least, c.nearest.lower);
  EXPECT_LT(least, 1.4 * *c.nearest.upper) << "rays enough";
  Eigen::Matrix3d r;
  for (int i = 0; i < 3; ++i) {
    const std::string axis(1, "xyz"[i]);
    r(i, 0) = value(c, "w_platform_" + axis), r(i, 1) = value(c, "u_platform_" + axis);
  }
  r.col(2) = r.col(0).cross(r.col(1));
  EXPECT_LE(Eigen::AngleAxisd(r * kept().transpose()).angle(), range);
  const auto at = stewart().determinant({value(c, "P_x"), value(c, "P_y"), value(c, "P_z")}, r);
  ASSERT_TRUE(at);
  EXPECT_NEAR(*at, 0, 1e-6);
}

// det of the legs' lines of models/planar/3rpr.cuik at a pose.
std::optional<double> three_rpr(double x, double y, double phi) {
  const double base[3][2] = {{0, 0}, {2, 0}, {0.8, 1.5}}, arm[3][2] = {{0, 0}, {1, 0}, {0.6, 0.4}};
  Eigen::Matrix3d m;
  for (int i = 0; i < 3; ++i) {
    const double ax = std::cos(phi) * arm[i][0] - std::sin(phi) * arm[i][1],
                 ay = std::sin(phi) * arm[i][0] + std::cos(phi) * arm[i][1];
    const double lx = x + ax - base[i][0], ly = y + ay - base[i][1];
    if (std::hypot(lx, ly) < 0.5 || std::hypot(lx, ly) > 2) return std::nullopt;
    m.row(i) << lx, ly, ax * ly - ay * lx;
  }
  return m.determinant();
}

double sampled_3rpr(double x, double y, double phi, double range, bool measured) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::normal_distribution<double> normal;
  double least = 1e9;
  for (int k = 0; k < 2000; ++k) {
    Eigen::Vector3d ray(normal(random), normal(random), measured ? normal(random) : 0);
    ray.normalize();
    const double start = phi + (k % 2 == 0 ? range * unit(random) : std::copysign(range, unit(random)));
    std::optional<double> before;
    for (double t = 0; t < std::min(least, 1.0); t += 0.01) {
      const auto now = three_rpr(x + t * ray(0), y + t * ray(1), start + t * ray(2));
      if (before && now && *before * *now <= 0) least = t;
      before = now;
    }
  }
  return least;
}

TEST(Clearance, OfAThreeRprIsThatOfManyRays) {
  const study::Question question = model("planar/3rpr.cuik");
  const std::vector<NamedValue> at = {{"pose_x", "0.8"}, {"pose_y", "0.5"}, {"pose_phi", "0.1"}};
  const std::vector<std::string> plane = {"pose_x", "pose_y"};
  const struct {
    const char* what;
    BallOptions ball;
    double range;
    bool measured;
  } cases[] = {
      {"fixed", {.at = at, .in = plane}, 0, false},
      {"free within 15 degrees",
       {.at = at, .in = plane, .orientation_range = symbolic::parse_expression("pi/12")},
       M_PI / 12,
       false},
      {"within the ball", {.at = at, .in = {"pose_x", "pose_y", "pose_phi"}}, 0, true},
  };
  for (const auto& [what, ball, range, measured] : cases) {
    const Clearance c = clearance_of(question, ball);
    SCOPED_TRACE(what);
    expect_close(c);
    const double least = sampled_3rpr(0.8, 0.5, 0.1, range, measured);
    EXPECT_GT(least, c.nearest.lower);
    EXPECT_LT(least, 1.2 * *c.nearest.upper) << "rays enough";
    const auto at_nearest = three_rpr(value(c, "pose_x"), value(c, "pose_y"), value(c, "pose_phi"));
    ASSERT_TRUE(at_nearest);
    EXPECT_NEAR(*at_nearest, 0, 1e-6);
  }
}

TEST(Clearance, OfOneModeIsNoSmaller) {
  const study::Question dextar = model("dextar.cuik");
  const BallOptions all{.at = {{"J3x", "0.5"}, {"J3y", 1}}, .in = {"J3x", "J3y"}};
  BallOptions one = all;
  one.ranges = {{"theta2", 2, 4}};
  const Clearance c = clearance_of(dextar, all), of_mode = clearance_of(dextar, one);
  expect_close(of_mode);
  EXPECT_GT(of_mode.nearest.lower, *c.nearest.upper) << "the nearest one has theta2 = 1.3";
  EXPECT_GE(std::cos(value(of_mode, "theta2") - 3), std::cos(1) - 1e-9);
}

// The same balls with limits of the angles and without: inside them nothing changes. Radius and limit are both said.
TEST(Clearance, AcceptsCoordinatesWithLimitsAndSaysWhereItMeetsThem) {
  const BallOptions ball{.at = {{"theta2", "2"}, {"theta5", "1"}}, .in = {"theta2", "theta5"}};
  const Clearance limited = clearance_of(model("dextar_limits.cuik"), ball);
  expect_close(limited);
  EXPECT_NEAR(limited.ball.room, 1, 1e-12) << "theta5 is in [0, pi]";
  EXPECT_EQ(limited.ball.end, "the lower limit of theta5");
  EXPECT_NEAR(*limited.nearest.upper, *clearance_of(model("dextar.cuik"), ball).nearest.upper, 0.01);
  EXPECT_EQ(limited.free_radius(), limited.nearest.lower);
  EXPECT_NE(to_table(limited).find("at the radius 1 the ball meets the lower limit of theta5"), std::string::npos);
}

// The centre is at the end of a range: what lies beyond was not searched, and no ball about it is claimed.
TEST(Clearance, ClaimsNoBallLargerThanWhatWasSearched) {
  const Clearance c = clearance_of(
      model("dextar.cuik"), {.at = {{"J3x", "0.5"}, {"J3y", "1"}}, .in = {"J3x", "J3y"}, .ranges = {{"J3y", "1", "1.5"}}});
  EXPECT_EQ(c.free_radius(), 0);
  EXPECT_GT(c.nearest.lower, 0);
  const std::string text = to_table(c), second = text.substr(text.find('\n') + 1);
  EXPECT_TRUE(second.starts_with(
      "radius 0: there the ball meets the lower end of the range given for J3y; it is proven that the ball holds no "
      "singularity"))
      << text;
  EXPECT_NE(to_json(c).find("\"ball\": 0"), std::string::npos);
}

TEST(Clearance, RefusesACentreWithoutAConfiguration) {
  EXPECT_THROW(clearance_of(model("dextar.cuik"), {.at = {{"J3x", "-1.5"}, {"J3y", "0"}}, .in = {"J3x", "J3y"}}),
               symbolic::ModelError);
}

TEST(Clearance, RefusesASetOfParts) {
  study::Question boundary = model("dextar.cuik");
  boundary.set = symbolic::SingularitySet::boundary;
  EXPECT_THROW(clearance_of(boundary, {.at = {{"J3x", "0.5"}, {"J3y", 1}}, .in = {"J3x", "J3y"}}), symbolic::ModelError);
}

TEST(Clearance, IsTheSameForAnyNumberOfThreads) {
  const study::Question question = model("planar/3rpr.cuik");
  const BallOptions ball{.at = {{"pose_x", "0.8"}, {"pose_y", "0.5"}, {"pose_phi", "0.1"}}, .in = {"pose_x", "pose_y"}};
  std::vector<Clearance> found;
  for (const int threads : {1, 2}) {
    solve::Control control;
    solve::Options search;
    search.threads = threads;
    found.push_back(clearance(question, ball, {}, search, control));
  }
  EXPECT_EQ(found[0].nearest.lower, found[1].nearest.lower);
  EXPECT_EQ(found[0].nearest.upper, found[1].nearest.upper);
  EXPECT_EQ(found[0].nearest.statistics.processed, found[1].nearest.statistics.processed);
}

TEST(Claims, AreVerifiedAndFailWhereTheyAreFalse) {
  const study::Question dextar = model("dextar.cuik");
  Clearance c = clearance_of(dextar, {.at = {{"J3x", "0.5"}, {"J3y", 1}}, .in = {"J3x", "J3y"}});
  solve::Control control;
  const result::Result free = claim_free(c, {}, control);
  EXPECT_TRUE(free.cover.boxes.empty());
  EXPECT_TRUE(result::verify(free).complete());
  const auto nearest = claim_nearest(c, control);
  ASSERT_TRUE(nearest);
  ASSERT_EQ(nearest->cover.boxes.size(), 1u);
  EXPECT_TRUE(result::verify(*nearest).verified());
  EXPECT_FALSE(result::verify(*nearest).complete());

  // Narrower ranges scale a kernel vector otherwise: the claim keeps the scales of the search.
  const Clearance turning = clearance_of(
      model("planar/3rpr.cuik"),
      {.at = {{"pose_x", "0.8"}, {"pose_y", "0.5"}, {"pose_phi", "0.1"}}, .in = {"pose_x", "pose_y", "pose_phi"}});
  const auto in_turning = claim_nearest(turning, control);
  ASSERT_TRUE(in_turning);
  EXPECT_TRUE(result::verify(*in_turning).verified());

  // A larger ball is not free, and says so; no singularity is in a smaller one.
  Clearance wrong = c;
  wrong.nearest.lower = 1.02 * *c.nearest.upper;
  EXPECT_FALSE(claim_free(wrong, {}, control).cover.boxes.empty());
  wrong.nearest.upper = 0.98 * c.nearest.lower;
  EXPECT_FALSE(claim_nearest(wrong, control));
  // The proof of a small ball does not prove a larger one.
  result::Result tampered = claim_free(wrong, {}, control);
  tampered.cover = free.cover;
  EXPECT_FALSE(result::verify(tampered).complete());
}

TEST(Claims, ThatThereIsNoSingularityAtAllAreVerified) {
  const study::Question arm = {.model = symbolic::parse_model("[SYSTEM VARS]\n  x :\n  q ~\n[SYSTEM EQS]\n  x = cos(q);\n"
                                                              "[INPUTS] q\n[OUTPUTS] x\n",
                                                              "arm"),
                               .set = symbolic::SingularitySet::forward};
  const Clearance c = clearance_of(arm, {.at = {{"q", 1}}, .in = {"q"}});
  ASSERT_TRUE(c.nearest.empty);
  solve::Control control;
  const result::Result free = claim_free(c, {}, control);
  EXPECT_TRUE(free.cover.boxes.empty());
  EXPECT_TRUE(result::verify(free).complete());
  EXPECT_FALSE(claim_nearest(c, control));
}

}  // namespace
}  // namespace corank::analyze
