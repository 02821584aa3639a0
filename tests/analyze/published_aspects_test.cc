// Published numbers of families of arms, for members at random, each against a flood fill in doubles that knows nothing of
// corank's equations.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <string>

#include "corank/analyze/aspects/aspects.h"
#include "corank/study/answer.h"
#include "corank/study/model.h"
#include "corank/tests/analyze/data_sheet_arms.h"
#include "corank/tests/analyze/flood_fill.h"
#include "corank/tests/seeds.h"

namespace corank::analyze {
namespace {

using GridPoint = std::array<std::size_t, 3>;

Aspects aspects_of_arm(study::Question question) {
  solve::Control control;
  return aspects(std::move(question), {}, control);
}

void expect_exactly(const Aspects& found, std::size_t number) {
  EXPECT_EQ(static_cast<std::size_t>(found.aspects.at_least), number);
  EXPECT_TRUE(found.aspects.exact()) << found.reason << found.aspects.reason;
}

// The shoulder's function a2 cos θ2 + a3 cos θ23 + d5 sin θ234 and the elbow's, sin θ3, over the three partial sums of
// angles, which are angles of the same torus; the wrist's, sin θ5, divides a circle into two.
std::size_t ur_pieces(double a2, double a3, double d5) {
  constexpr std::size_t kAcross = 44;
  const auto angle = [](std::size_t i) { return 2 * M_PI * (static_cast<double>(i) + 0.53) / kAcross; };
  std::size_t pieces = 0;
  for (const int shoulder : {-1, 1})
    for (const int elbow : {-1, 1})
      pieces += flood_pieces({{kAcross, kAcross, kAcross}, {true, true, true}, 3}, [&](const GridPoint& p) {
        const double u = angle(p[0]), v = angle(p[1]), w = angle(p[2]);
        return shoulder * (a2 * std::cos(u) + a3 * std::cos(v) + d5 * std::sin(w)) > 0 && elbow * std::sin(v - u) > 0;
      });
  return 2 * pieces;
}

// J. Capco, M. Safey El Din, J. Schicho, "Robots, computer algebra and eight connected components", ISSAC 2020: of a generic
// arm like a UR5, the complement of the singularities, in all six joints, has eight components.
TEST(PublishedAspects, OfArmsLikeAUr5AreEight) {
  std::mt19937 random(20);
  const auto length = [&] { return std::uniform_int_distribution(60, 600)(random) / 1000.0; };
  for (unsigned n = 0; n < std::min(test::seeds(2), 20U); ++n) {
    const double sign = n % 2 == 0 ? -1 : 1;
    const Arm arm{"ur",
                  {{{0, 90, length()},
                    {sign * length(), 0, 0},
                    {sign * length(), 0, 0},
                    {0, 90, length()},
                    {0, -90, length()},
                    {0, 0, length()}}},
                  8};
    SCOPED_TRACE(testing::Message() << arm.rows[1].a << " " << arm.rows[2].a << " " << arm.rows[4].d);
    EXPECT_EQ(ur_pieces(arm.rows[1].a, arm.rows[2].a, arm.rows[4].d), 8U);
    expect_exactly(aspects_of_arm(arm_question(arm)), 8);
  }
}

struct OrthogonalArm {
  double d3, d4, r2;
  std::vector<result::ConstantOverride> constants() const {
    return {{"d3", fmt::format("{}", d3)}, {"d4", fmt::format("{}", d4)}, {"r2", fmt::format("{}", r2)}};
  }
};

// M. Baili, P. Wenger, D. Chablat 2004: the number of cusps changes on four surfaces d4 = …, here in their order; there are
// five domains.
struct CuspDomain {
  int domain, cusps;
  double margin;  // of d4 to the nearest surface
};
CuspDomain cusp_domain(const OrthogonalArm& arm) {
  const double d = arm.d3, r = arm.r2, a = std::hypot(d + 1, r), b = std::hypot(d - 1, r), s = d * d + r * r;
  const double first = std::sqrt((s - (s * s - d * d + r * r) / (a * b)) / 2), second = d * a / (d + 1),
               third = d * b / std::fabs(d - 1);
  double margin = 10;
  for (const double surface : {first, second, third}) margin = std::min(margin, std::fabs(arm.d4 - surface));
  if (arm.d4 < first) return {0, 0, margin};
  if (arm.d4 < second) return {1, 4, margin};
  if (arm.d4 < third) return {2, 2, margin};
  return d > 1 ? CuspDomain{3, 4, margin} : CuspDomain{4, 0, margin};
}

// The determinant's two functions, d3 + d4 cos θ3 and sin θ3 + cos θ2 (d3 sin θ3 − r2 cos θ3), over the torus of angles.
std::size_t orthogonal_pieces(const OrthogonalArm& arm) {
  constexpr std::size_t kAcross = 400;
  const auto angle = [](std::size_t i) { return 2 * M_PI * (static_cast<double>(i) + 0.53) / kAcross; };
  std::size_t pieces = 0;
  for (const int first : {-1, 1})
    for (const int second : {-1, 1})
      pieces += flood_pieces({{kAcross, kAcross, 1}, {true, true, false}, 15}, [&](const GridPoint& p) {
        const double t = angle(p[0]), c = std::cos(angle(p[1])), s = std::sin(angle(p[1]));
        return first * (arm.d3 + arm.d4 * c) > 0 && second * (s + std::cos(t) * (arm.d3 * s - arm.r2 * c)) > 0;
      });
  return pieces;
}

// The curve h = 0 where d4 > d3 is left out, whose image is one point.
void expect_cusps(const OrthogonalArm& arm, int number) {
  study::Question question{
      .model = study::read_model(CORANK_SOURCE_DIR "/gallery/orthogonal_3r_cusps.cuik", arm.constants()).mechanism};
  const result::Result found = study::answer(question);
  EXPECT_TRUE(found.cover.complete());
  EXPECT_EQ(found.cover.points.size(), static_cast<std::size_t>(number));
  EXPECT_TRUE(std::ranges::all_of(found.cover.points, [](const CoverBox& p) { return p.verdict == Verdict::isolated; }));
}

// Arms at random until each of the five domains has as many as asked for.
TEST(PublishedAspects, OfOrthogonalArmsAreThoseOfAFloodFillAndTheirCuspsThoseOfTheFiveDomains) {
  std::mt19937 random(2004);
  const auto hundredths = [&](int lo, int hi) { return std::uniform_int_distribution(lo, hi)(random) / 100.0; };
  const unsigned each = std::max(2U, test::seeds(10) / 5);
  std::array<unsigned, 5> tried{};
  std::set<std::size_t> numbers;
  for (unsigned n = 0; n < 400 * each && std::ranges::any_of(tried, [&](unsigned t) { return t < each; }); ++n) {
    const OrthogonalArm arm{hundredths(30, 250), hundredths(10, 400), hundredths(20, 150)};
    const CuspDomain domain = cusp_domain(arm);
    unsigned& so_far = tried.at(static_cast<std::size_t>(domain.domain));
    if (so_far == each || domain.margin < 0.04 || std::fabs(arm.d3 - arm.d4) < 0.1 || std::fabs(arm.d3 - 1) < 0.1) continue;
    ++so_far;
    SCOPED_TRACE(testing::Message() << "d3 " << arm.d3 << ", d4 " << arm.d4 << ", r2 " << arm.r2);
    expect_cusps(arm, domain.cusps);
    const std::size_t pieces = orthogonal_pieces(arm);
    numbers.insert(pieces);
    expect_exactly(
        aspects_of_arm(
            {.model = study::read_model(CORANK_SOURCE_DIR "/models/serial/orthogonal_3r.cuik", arm.constants()).mechanism}),
        pieces);
  }
  EXPECT_EQ(*std::ranges::min_element(tried), each);
  EXPECT_GE(numbers.size(), 3U);
}

}  // namespace
}  // namespace corank::analyze
