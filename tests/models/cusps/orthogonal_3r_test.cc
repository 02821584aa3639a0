// Cusps and nodes of orthogonal 3R arms against the traced image of their inverse locus, in doubles and without any of
// corank's equations.
#include "corank/result/files/verification.h"
#include "corank/result/values/sentences.h"
#include "corank/tests/models/cusps/asking.h"

namespace corank::test {
namespace {

struct Arm {
  std::string d3, d4, r2, band;
  std::size_t cusps, nodes;  // as the model's comment says
};

struct Sample {
  double theta2, theta3, rho2, z;
};

constexpr int kSamples = 6000;

// d2 sin θ3 + cos θ2 (d3 sin θ3 − r2 cos θ3) = 0: for each θ2 two θ3, half a turn apart.
std::vector<Sample> branch(double d3, double d4, double r2, int number) {
  std::vector<Sample> list;
  for (int i = 0; i < kSamples; ++i) {
    const double t2 = 2 * M_PI * (i + 0.37) / kSamples, c2 = std::cos(t2),
                 t3 = std::atan2(r2 * c2, 1 + d3 * c2) + number * M_PI, a = d3 + d4 * std::cos(t3);
    list.push_back({t2, t3, std::pow(1 + a * c2, 2) + std::pow(r2 + d4 * std::sin(t3), 2), -a * std::sin(t2)});
  }
  return list;
}

double cross(const Sample& o, const Sample& a, const Sample& b) {
  return (a.rho2 - o.rho2) * (b.z - o.z) - (a.z - o.z) * (b.rho2 - o.rho2);
}

// Where the tangent of the image turns about.
std::vector<Place> cusps_of(const std::vector<Sample>& curve) {
  std::vector<Place> list;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const Sample &a = curve[i], &b = curve[(i + 1) % curve.size()], &c = curve[(i + 2) % curve.size()];
    if ((b.rho2 - a.rho2) * (c.rho2 - b.rho2) + (b.z - a.z) * (c.z - b.z) < 0)
      list.push_back({{"theta2", b.theta2}, {"theta3", b.theta3}});
  }
  return list;
}

// Where two pieces of it cross; not in the band about the curve whose image is a point.
std::vector<std::array<Place, 2>> nodes_of(const std::vector<std::vector<Sample>>& curves, double d3, double d4,
                                           double band) {
  struct Piece {
    const Sample *from, *to;
    std::size_t curve, index;
  };
  std::vector<Piece> pieces;
  for (std::size_t c = 0; c < curves.size(); ++c)
    for (std::size_t i = 0; i < curves[c].size(); ++i)
      pieces.push_back({&curves[c][i], &curves[c][(i + 1) % curves[c].size()], c, i});
  const auto low = [](const Piece& p) { return std::min(p.from->rho2, p.to->rho2); };
  const auto high = [](const Piece& p) { return std::max(p.from->rho2, p.to->rho2); };
  std::sort(pieces.begin(), pieces.end(), [&](const Piece& a, const Piece& b) { return low(a) < low(b); });
  std::vector<std::array<Place, 2>> list;
  for (std::size_t i = 0; i < pieces.size(); ++i)
    for (std::size_t k = i + 1; k < pieces.size() && low(pieces[k]) <= high(pieces[i]); ++k) {
      const Piece &a = pieces[i], &b = pieces[k];
      const std::size_t apart = a.index > b.index ? a.index - b.index : b.index - a.index;
      if (a.curve == b.curve && std::min(apart, kSamples - apart) <= 2) continue;
      if (cross(*a.from, *a.to, *b.from) * cross(*a.from, *a.to, *b.to) >= 0 ||
          cross(*b.from, *b.to, *a.from) * cross(*b.from, *b.to, *a.to) >= 0)
        continue;
      if (std::pow(d3 + d4 * std::cos(a.from->theta3), 2) < band) continue;
      list.push_back({Place{{"theta2", a.from->theta2}, {"theta3", a.from->theta3}},
                      Place{{"theta2", b.from->theta2}, {"theta3", b.from->theta3}}});
    }
  return list;
}

class Orthogonal3R : public testing::TestWithParam<Arm> {
 protected:
  result::Result solved(SingularitySet set) const {
    const Arm& arm = GetParam();
    return ask("serial/orthogonal_3r_section", set, {{"d3", arm.d3}, {"d4", arm.d4}, {"r2", arm.r2}, {"band", arm.band}});
  }
  double number(const std::string& text) const { return std::stod(text); }
  std::vector<std::vector<Sample>> curves() const {
    const Arm& a = GetParam();
    return {branch(number(a.d3), number(a.d4), number(a.r2), 0), branch(number(a.d3), number(a.d4), number(a.r2), 1)};
  }
};

TEST_P(Orthogonal3R, HasTheCuspsOfItsTracedLocus) {
  std::vector<Place> expected;
  for (const auto& curve : curves())
    for (const Place& place : cusps_of(curve)) expected.push_back(place);
  EXPECT_EQ(expected.size(), GetParam().cusps);
  const result::Result result = solved(SingularitySet::inverse_cusps);
  expect_points(result, expected, 0.01);
  EXPECT_EQ(result::locus_sentence(result),
            expected.empty()
                ? "there is no cusp in the search domain; postures may still change without a singularity in another way"
                : "it is proven that around these 4 cusps postures can change without an inverse singularity");
}

TEST_P(Orthogonal3R, HasTheNodesOfItsTracedLocusOnceEach) {
  const Arm& arm = GetParam();
  const auto expected = nodes_of(curves(), number(arm.d3), number(arm.d4), number(arm.band));
  EXPECT_EQ(expected.size(), arm.nodes);
  const result::Result result = solved(SingularitySet::inverse_nodes);
  EXPECT_TRUE(result.cover.complete());
  EXPECT_EQ(result.cover.boxes.size(), expected.size());
  for (const auto& pair : expected) {
    std::size_t n = 0;
    for (const CoverBox& point : result.cover.points) {
      EXPECT_EQ(point.verdict, Verdict::isolated);
      for (const bool swapped : {false, true}) {
        const Place &first = pair[swapped], &second = pair[!swapped];
        n += is_at(result, point, first, 0.01) &&
             is_at(result, point, {{"theta2_2", second.at("theta2")}, {"theta3_2", second.at("theta3")}}, 0.01);
      }
    }
    EXPECT_EQ(n, 1u);
  }
}

TEST(Orthogonal3RArm, HasCuspsWhoseCompletenessIsReplayed) {
  study::Question question;
  question.constants = {{"d3", "0.91"}, {"d4", "0.5"}, {"r2", "1.15"}};
  question.model =
      study::read_model(CORANK_SOURCE_DIR "/models/serial/orthogonal_3r_section.cuik", question.constants).mechanism;
  question.set = SingularitySet::inverse_cusps;
  study::Options options;
  options.search.proof = true;
  EXPECT_TRUE(result::verify(study::answer(question, options)).complete());
}

INSTANTIATE_TEST_SUITE_P(Arms, Orthogonal3R,
                         testing::Values(Arm{"0.85", "0.26", "0.59", "0", 0, 0}, Arm{"2", "1.5", "1", "0", 4, 0},
                                         Arm{"0.91", "0.5", "1.15", "0", 4, 2}, Arm{"1.9", "3.55", "0.44", "0.01", 4, 2}));

}  // namespace
}  // namespace corank::test
