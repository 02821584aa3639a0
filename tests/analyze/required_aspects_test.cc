// Aspects in which requirements are met: of waves by their closed forms, of five-bars against a grid of places; their files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <random>

#include "corank/analyze/aspects/aspects.h"
#include "corank/certify/angle.h"
#include "corank/result/values/claim_files.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/tests/analyze/required_robots.h"
#include "corank/tests/seeds.h"

namespace corank::analyze {
namespace {

using ::testing::HasSubstr;

Aspects aspects_within(symbolic::Mechanism model, const std::vector<std::string>& texts) {
  solve::Control control;
  AspectsOptions options;
  options.certificate = true;
  return aspects(required({.model = std::move(model)}, texts), options, control);
}

result::PiecesFile file_of(symbolic::Mechanism model, const std::vector<std::string>& texts) {
  const study::Question question = required({.model = std::move(model)}, texts);
  solve::Control control;
  AspectsOptions options;
  options.certificate = true;
  return to_file(question, aspects(question, options, control));
}

void expect_numbers(const Aspects& a, int aspects, int assembly_modes, int working_modes) {
  EXPECT_TRUE(a.aspects.exact() && a.assembly_modes.exact() && a.working_modes.exact()) << a.reason << a.aspects.reason;
  EXPECT_EQ(a.aspects.at_least, aspects);
  EXPECT_EQ(a.assembly_modes.at_least, assembly_modes);
  EXPECT_EQ(a.working_modes.at_least, working_modes);
}

void expect_complete_file(const result::PiecesFile& file, int aspects) {
  const check::PiecesReport report = result::verify(file);
  EXPECT_TRUE(report.complete()) << result::to_table(report, file);
  EXPECT_EQ(report.lists.at(0).at_least, aspects) << result::to_table(report, file);
  EXPECT_EQ(report.lists.at(0).at_most, aspects) << result::to_table(report, file);
}

std::string wave(char angle, char length, int n, int shift) {
  return std::string(1, length) + " = sin(" + std::to_string(n) + "*" + angle + " + 1/" + std::to_string(shift) + ");\n";
}

// du/dv = n cos(n v + a), which is 0 at 2n places; |du/dv| < k about each of them where k < n, everywhere where k > n.
int arcs_of_wave(int n, double k) { return k < n ? 4 * n : 2 * n; }

TEST(RequiredAspects, OfAWaveAreItsArcs) {
  std::mt19937 random(3);
  std::uniform_int_distribution<int> harmonic(1, 3), shift(2, 9), quarters(1, 7);
  for (unsigned trial = 0; trial < test::seeds(6); ++trial) {
    const int n = harmonic(random), a = shift(random), k = 2 * quarters(random) + 1;
    const std::string text =
        "[SYSTEM VARS]\nv ~ [-pi, pi]\nu : [-2, 2]\n[SYSTEM EQS]\n" + wave('v', 'u', n, a) + "[INPUTS] v\n[OUTPUTS] u\n";
    SCOPED_TRACE(text + std::to_string(k));
    const auto model = symbolic::parse_model(text, "wave.cuik");
    const std::string most = "amplification(outputs) <= " + std::to_string(k) + "/4";
    const bool divided = k < 4 * n;
    expect_numbers(aspects_within(model, {most}), arcs_of_wave(n, k / 4.0), divided ? 2 * n : 1, arcs_of_wave(n, k / 4.0));
    expect_complete_file(file_of(model, {most}), arcs_of_wave(n, k / 4.0));
    // At least k/8, at most k/4.
    if (k >= 8 * n) continue;
    const std::string least = "amplification(inputs) <= 8/" + std::to_string(k);
    const int both = divided ? 4 * n : 2 * n;
    expect_numbers(aspects_within(model, {most, least}), both, both, both);
    expect_complete_file(file_of(model, {most, least}), both);
  }
}

// Two waves: J is diagonal, and its determinant's factors are conditions of their own. det L_y is constant.
TEST(RequiredAspects, OfTwoWavesAreTheirProduct) {
  std::mt19937 random(5);
  std::uniform_int_distribution<int> harmonic(1, 2), shift(2, 9), quarters(1, 5);
  for (unsigned trial = 0; trial < test::seeds(2); ++trial) {
    const int n = harmonic(random), m = harmonic(random), k = 2 * quarters(random) + 1;
    const auto model = symbolic::parse_model(
        "[SYSTEM VARS]\nv ~ [-pi, pi]\nw ~ [-pi, pi]\nx : [-2, 2]\ny : [-2, 2]\n[SYSTEM EQS]\n" +
            wave('v', 'x', n, shift(random)) + wave('w', 'y', m, shift(random)) + "[INPUTS] v, w\n[OUTPUTS] x, y\n",
        "waves.cuik");
    SCOPED_TRACE(std::to_string(n) + " " + std::to_string(m) + " " + std::to_string(k));
    const std::string most = "amplification(outputs) <= " + std::to_string(k) + "/4";
    const int all = arcs_of_wave(n, k / 4.0) * arcs_of_wave(m, k / 4.0);
    expect_numbers(aspects_within(model, {most}), all, (k < 4 * n ? 2 * n : 1) * (k < 4 * m ? 2 * m : 1), all);
    expect_complete_file(file_of(model, {most}), all);
  }
}

// A comparison is an inequality: a circle of radius 1 within x ≤ c.
TEST(RequiredAspects, OfAComparisonAreWithinIt) {
  const auto model = symbolic::parse_model(
      "[SYSTEM VARS]\nx : [-2, 2]\ny : [-2, 2]\n[SYSTEM EQS]\nx^2 + y^2 = 1;\n[INPUTS] x\n[OUTPUTS] y\n", "circle.cuik");
  // Forward where y = 0, inverse where x = 0.
  expect_numbers(aspects_within(model, {"x <= 2"}), 4, 2, 2);
  expect_numbers(aspects_within(model, {"x <= 1/2"}), 4, 2, 3);
  expect_numbers(aspects_within(model, {"x <= -1/2"}), 2, 2, 1);
  expect_complete_file(file_of(model, {"x <= 1/2"}), 4);
}

TEST(RequiredAspects, OfWhatIsNeverMetAreRefused) {
  const auto model = symbolic::parse_model(
      "[SYSTEM VARS]\nx : [-2, 2]\ny : [-4, 4]\n[SYSTEM EQS]\ny = 2*x;\n[INPUTS] x\n[OUTPUTS] y\n", "lever.cuik");
  EXPECT_THROW(aspects_within(model, {"amplification(outputs) <= 1"}), symbolic::ModelError);
  EXPECT_THROW(aspects_within(model, {"amplification(outputs) <= 2"}), symbolic::ModelError);
  expect_numbers(aspects_within(model, {"amplification(outputs) <= 3"}), 1, 1, 1);
}

// A five-bar's place of J3 and its working mode say its configuration.
struct FiveBar {
  double l, d, most;
  static constexpr int kRows = 120;
  // Of each mode and place the amplification and the sign of det J; none: 0.
  std::array<std::vector<double>, 4> speed{};
  std::array<std::vector<int>, 4> sign{};

  double step() const { return 4.4 * l / kRows; }
  double x(int i) const { return d / 2 + (i - kRows / 2.0) * step(); }
  double y(int j) const { return (j - kRows / 2.0) * step(); }
  static std::size_t index(int i, int j) { return static_cast<std::size_t>(i * kRows + j); }

  void find() {
    for (int mode = 0; mode < 4; ++mode) speed[mode].assign(kRows * kRows, 0), sign[mode].assign(kRows * kRows, 0);
    for (int i = 0; i < kRows; ++i)
      for (int j = 0; j < kRows; ++j) {
        const auto all = five_bar_postures(x(i), y(j), l, d);
        for (std::size_t mode = 0; mode < all.size(); ++mode) {
          speed[mode][index(i, j)] = amplification(all[mode]);
          sign[mode][index(i, j)] = all[mode].determinant() > 0 ? 1 : -1;
        }
      }
  }

  // Of a working mode: numbers of what is joined without a singularity, with less than a share of the most. 0: none.
  std::vector<int> flood(int mode, double share) const {
    std::vector<int> number(kRows * kRows, 0);
    const auto inside = [&](int i, int j) {
      return i >= 0 && j >= 0 && i < kRows && j < kRows && sign[mode][index(i, j)] != 0 &&
             speed[mode][index(i, j)] < share * most && number[index(i, j)] == 0;
    };
    int pieces = 0;
    for (int i = 0; i < kRows; ++i)
      for (int j = 0; j < kRows; ++j) {
        if (!inside(i, j)) continue;
        std::vector<std::pair<int, int>> stack{{i, j}};
        number[index(i, j)] = ++pieces;
        while (!stack.empty()) {
          const auto [a, b] = stack.back();
          stack.pop_back();
          for (const auto& [p, q] : {std::pair(a + 1, b), {a - 1, b}, {a, b + 1}, {a, b - 1}})
            if (inside(p, q) && sign[mode][index(p, q)] == sign[mode][index(a, b)])
              number[index(p, q)] = pieces, stack.emplace_back(p, q);
        }
      }
    return number;
  }
};

double value_of(const System& system, const Box& box, const std::string& name) { return box[system.find(name)].mid(); }

// The mode in which five_bar_postures has the configuration of a representative.
int mode_of(const FiveBar& robot, const System& system, const Box& box) {
  const auto angle = [&](const std::string& name) {
    const Angle& a = *std::ranges::find(system.angles, name, &Angle::name);
    return std::atan2(box[a.sine].mid(), box[a.cosine].mid());
  };
  const double x = value_of(system, box, "J3x"), y = value_of(system, box, "J3y");
  const auto side = [&](double ground, double theta) {  // as there: the crank is to the left of the line to J3, or not
    return (x - ground) * std::sin(theta) - y * std::cos(theta) > 0 ? 1 : 0;
  };
  return side(robot.d, angle("theta2")) + 2 * side(0, angle("theta5"));
}

// No claim of random robots that a grid contradicts: representatives meet what is required; two that are claimed to differ
// are not joined on the grid; a square that meets it, well within, lies in some aspect with the same signs.
TEST(RequiredAspects, OfRandomFiveBarsContradictNoGrid) {
  std::mt19937 random(11);
  const auto in = [&](double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(random); };
  int exact = 0, representatives = 0;
  for (unsigned trial = 0; trial < test::seeds(1); ++trial) {
    FiveBar robot{std::round(100 * in(0.8, 1)) / 100, std::round(100 * in(1.1, 1.3)) / 100,
                  std::round(10 * in(1.2, 3)) / 10};
    SCOPED_TRACE(std::to_string(robot.l) + " " + std::to_string(robot.d) + " " + std::to_string(robot.most));
    study::Question question{.model = symbolic::read_model(CORANK_SOURCE_DIR "/models/dextar.cuik")};
    result::put_in({{"l", std::to_string(robot.l)}, {"d", std::to_string(robot.d)}}, question.model);
    const Aspects a = aspects_within(question.model, {"amplification(outputs) <= " + std::to_string(robot.most)});
    ASSERT_EQ(a.reason, "");
    exact += a.aspects.exact();
    robot.find();
    std::map<int, std::vector<int>> floods;
    std::map<std::pair<int, int>, std::size_t> seen;  // of a mode and a piece of the grid which representative is there
    std::map<std::pair<int, int>, int> signs;         // of a mode and a sign of det J how many representatives
    for (std::size_t k = 0; k < a.aspects.representatives.size(); ++k, ++representatives) {
      const Box& at = a.aspects.representatives[k];
      const double x = value_of(a.system, at, "J3x"), y = value_of(a.system, at, "J3y");
      const int mode = mode_of(robot, a.system, at);
      const MatrixXd j = five_bar_postures(x, y, robot.l, robot.d).at(mode);
      EXPECT_LT(amplification(j), robot.most);
      ++signs[{mode, j.determinant() > 0 ? 1 : -1}];
      if (!floods.contains(mode)) floods[mode] = robot.flood(mode, 0.9);
      const int row = static_cast<int>(std::lround((x - robot.x(0)) / robot.step())),
                column = static_cast<int>(std::lround((y - robot.y(0)) / robot.step()));
      const int piece = floods[mode].at(FiveBar::index(row, column));
      if (piece == 0 || static_cast<int>(k) >= a.aspects.at_least) continue;
      const auto [place, fresh] = seen.try_emplace({mode, piece}, k);
      EXPECT_TRUE(fresh) << "aspects " << place->second + 1 << " and " << k + 1 << " are one";
    }
    if (!a.aspects.exact()) continue;
    for (int mode = 0; mode < 4; ++mode)
      for (int i = 0; i < FiveBar::kRows; ++i)
        for (int j = 0; j < FiveBar::kRows; ++j) {
          const int sign = robot.sign[mode][FiveBar::index(i, j)];
          if (sign == 0 || robot.speed[mode][FiveBar::index(i, j)] > 0.99 * robot.most) continue;
          EXPECT_GT(signs.count({mode, sign}), 0u) << robot.x(i) << " " << robot.y(j) << " " << mode;
        }
  }
  EXPECT_GT(exact, 0);
  EXPECT_GT(representatives, 0);
}

TEST(RequiredAspects, OfDextarAreCountedAndChecked) {
  const result::PiecesFile file =
      file_of(symbolic::read_model(CORANK_SOURCE_DIR "/models/dextar.cuik"), {"amplification(outputs) <= 2"});
  EXPECT_EQ(file.lists[0].members_with(1), 10);
  EXPECT_EQ(file.lists[0].at_most, 10);
  if (test::long_run()) expect_complete_file(file, 10);  // half a minute
}

// What a member says of the requirements is found out, and what the text asks for is part of it.
TEST(RequiredAspects, InADamagedFileAreRefused) {
  const auto model = symbolic::parse_model(
      "[SYSTEM VARS]\nv ~ [-pi, pi]\nw ~ [-pi, pi]\nx : [-2, 2]\ny : [-2, 2]\n[SYSTEM EQS]\nx = sin(v);\ny = sin(w);\n"
      "[INPUTS] v, w\n[OUTPUTS] x, y\n",
      "waves.cuik");
  const result::PiecesFile good = file_of(model, {"amplification(outputs) <= 1/2"});
  PieceClaims claims = good.lists[0];
  EXPECT_EQ(claims.members_with(1), 16);
  EXPECT_GT(claims.members_with(-1), 0);
  for (std::size_t k = 0; k < claims.members.size(); ++k) {
    result::PiecesFile file = good;
    file.lists[0].members[k].requirements *= -1;
    const check::PiecesReport report = result::verify(file);
    EXPECT_FALSE(report.verified());
    EXPECT_THAT(result::to_table(report, file), HasSubstr("what it says of the requirements is not shown"));
    if (!test::long_run() && k == 2) break;
  }
  result::PiecesFile other = good;
  const std::string from = "<= 1/2", to = "<= 1/3";
  other.model_text.replace(other.model_text.find(from), from.size(), to);
  EXPECT_FALSE(result::verify(other).covered());
  result::PiecesFile none = good;
  none.model_text.erase(none.model_text.find("[REQUIREMENTS]"));
  EXPECT_FALSE(result::verify(none).covered());
}

// A member's solution was found over the free variables of a neighbour's cell.
TEST(RequiredAspects, HaveFilesWhoseMembersLieInTheirBoxes) {
  const auto parse = [](const std::string& text) { return symbolic::parse_model(text, "circle.cuik"); };
  expect_complete_file(
      file_of(parse("[SYSTEM VARS]\nx : [-1/2, 2]\ny : [-2, 2]\n[SYSTEM EQS]\nx^2 + y^2 = 1;\n[INPUTS] x\n[OUTPUTS] y\n"),
              {"amplification(outputs) <= 1"}),
      4);
  expect_complete_file(file_of(parse("[SYSTEM VARS]\nv ~ [-pi, pi]\nw ~ [-pi, pi]\nx : [-3, 3]\ny : [-3, 3]\n[SYSTEM EQS]\n"
                                     "x = sin(v) + sin(w);\ny = sin(v) - sin(w);\n[INPUTS] v, w\n[OUTPUTS] x, y\n"),
                               {"amplification(outputs) <= 1"}),
                       16);
}

// Determinants have signs at members that meet what is required, not at those that follow.
TEST(RequiredAspects, ClaimNoSignsOfDeterminantsBesides) {
  const result::PiecesFile file =
      file_of(symbolic::parse_model("[SYSTEM VARS]\nv ~ [-pi, pi]\nw ~ [-pi, pi]\nx : [-3, 3]\ny : [-3, 3]\n[SYSTEM EQS]\n"
                                    "x = sin(v) + sin(w);\ny = sin(v) - sin(w);\n[INPUTS] v, w\n[OUTPUTS] x, y\n",
                                    "waves.cuik"),
              {"error(x) <= 4/5 under v <= 1, w <= 1", "error(y) <= 7/10 under inputs <= 1"});
  const check::PiecesReport report = result::verify(file);
  for (const std::string& failure : report.lists.at(0).failures)
    EXPECT_THAT(failure, ::testing::Not(HasSubstr("determinant")));
}

}  // namespace
}  // namespace corank::analyze
