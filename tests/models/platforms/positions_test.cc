// Position problems of platforms: isolated postures, all of them proven; mobilities.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>

#include "corank/kinematics/language/part_file.h"
#include "corank/solve/search/solve.h"
#include "corank/study/model.h"
#include "corank/study/question.h"

namespace corank {
namespace {

std::filesystem::path model(const std::string& name) { return CORANK_SOURCE_DIR "/models/platforms/" + name + ".cuik"; }

struct Postures {
  System system;
  Cover cover;
};

Postures postures(const symbolic::Mechanism& mechanism) {
  study::Question question;
  question.model = mechanism;
  Postures result{study::system(question), {}};
  solve::Options options;
  options.threads = 1;
  result.cover = solve::solve(result.system, options);
  return result;
}

void expect_isolated(const Postures& p, std::size_t count) {
  EXPECT_TRUE(p.cover.complete());
  EXPECT_EQ(p.cover.points.size(), count);
  EXPECT_EQ(p.cover.count(Verdict::isolated), count);
  EXPECT_EQ(p.cover.boxes.size(), count);
}

TEST(PlatformPostures, OfDietmaiersAreForty) {
  const Postures p = postures(study::read_model(model("dietmaier")).mechanism);
  expect_isolated(p, 40);
  EXPECT_LE(p.cover.statistics.processed, 250'000u);
}

struct SuiteWorld {
  const char* file;
  std::size_t postures;
  std::uint64_t processed;  ///< at most
};
void PrintTo(const SuiteWorld& w, std::ostream* out) { *out << w.file; }
class PosturesInTheSuite : public testing::TestWithParam<SuiteWorld> {};

TEST_P(PosturesInTheSuite, AreIsolatedAndProven) {
  const std::filesystem::path file = std::string(CORANK_SOURCE_DIR "/../shared/cuik/worlds/") + GetParam().file;
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
  const Postures p = postures(study::read_model(file).mechanism);
  expect_isolated(p, GetParam().postures);
  EXPECT_LE(p.cover.statistics.processed, GetParam().processed);
}

INSTANTIATE_TEST_SUITE_P(Platforms, PosturesInTheSuite,
                         testing::Values(SuiteWorld{"ParallelPlatform/Dietmeier.world", 40, 250'000},
                                         SuiteWorld{"DeltaManipulator/DeltaManipulator.world", 8, 1000}),
                         [](const auto& w) { return std::filesystem::path(w.param.file).stem().string(); });

// The motors at given angles. In the base's orientation the platform's middle is where three spheres meet.
TEST(PlatformPostures, OfADeltaHoldThoseWhereThreeSpheresMeet) {
  std::ifstream in(model("delta"));
  std::string text{std::istreambuf_iterator<char>(in), {}};
  const std::array<std::pair<const char*, double>, 3> angles{{{"1/5", 0.2}, {"2/5", 0.4}, {"1/2", 0.5}}};
  for (const auto& [angle, value] : angles) {
    const std::size_t at = text.find("actuated");
    ASSERT_NE(at, std::string::npos);
    text.replace(at, 8, std::string("range [") + angle + ", " + angle + "]");
  }
  text.resize(text.find("[OUTPUTS]"));
  const kinematics::Assembly assembly = kinematics::assemble(kinematics::parse_parts(text, "delta.cuik"));
  const Postures p = postures(assembly.mechanism);
  EXPECT_TRUE(p.cover.complete());
  EXPECT_EQ(p.cover.count(Verdict::isolated), p.cover.boxes.size());
  // Spheres of radius 2 about c_i: 2 (c_i - c_1)·x = |c_i|² - |c_1|².
  std::array<Eigen::Vector3d, 3> centres;
  for (std::size_t i = 0; i < 3; ++i) {
    const double t = 2 * std::numbers::pi * static_cast<double>(i) / 3, reach = 0.5 + std::cos(angles[i].second);
    centres[i] = {reach * std::cos(t), reach * std::sin(t), -std::sin(angles[i].second)};
  }
  const Eigen::Vector3d a = centres[1] - centres[0], b = centres[2] - centres[0], n = a.cross(b);
  Eigen::Matrix3d planes;
  planes << a.transpose(), b.transpose(), n.transpose();
  const Eigen::Vector3d foot = centres[0] + planes.inverse() * Eigen::Vector3d(a.dot(a) / 2, b.dot(b) / 2, 0);
  const double height = std::sqrt(4 - (foot - centres[0]).squaredNorm());
  std::size_t found = 0;
  for (const double sign : {-1.0, 1.0}) {
    const Eigen::Vector3d middle = foot + sign * height / n.norm() * n;
    // Along the first rod: to the platform's L1 from the arm's L.
    const Eigen::Vector3d rod = middle - centres[0];
    for (const CoverBox& point : p.cover.points) {
      bool same = true;
      for (int i = 0; i < 3; ++i) {
        const int v = p.system.find(std::string("P_L1_") + "xyz"[i]);
        ASSERT_GE(v, 0);
        same = same && std::fabs(point.box[static_cast<std::size_t>(v)].mid() - rod[i]) < 1e-6;
      }
      found += same;
    }
  }
  EXPECT_EQ(found, 2u);
}

struct Mobility {
  const char* name;
  int by_joints, by_rank;
};
void PrintTo(const Mobility& m, std::ostream* out) { *out << m.name; }
class PlatformMobility : public testing::TestWithParam<Mobility> {};

TEST_P(PlatformMobility, IsAsThePapersSay) {
  const study::Model read = study::read_model(model(GetParam().name));
  ASSERT_TRUE(read.assembly);
  EXPECT_EQ(read.assembly->mobility_by_joints, GetParam().by_joints);
  ASSERT_TRUE(read.assembly->mobility_by_rank);
  EXPECT_EQ(*read.assembly->mobility_by_rank, GetParam().by_rank);
}

INSTANTIATE_TEST_SUITE_P(Models, PlatformMobility,
                         testing::Values(Mobility{"stewart", 6, 6}, Mobility{"dietmaier", 0, 0},
                                         Mobility{"griffis_duffy", 0, 1}, Mobility{"delta", 3, 3},
                                         Mobility{"delta_translation", 3, 3}, Mobility{"orthoglide", 3, 3},
                                         Mobility{"3rps", 3, 3}, Mobility{"3upu", 3, 3}, Mobility{"hexapod", 6, 6},
                                         Mobility{"tricept", 3, 3}),
                         [](const auto& m) { return std::string("of_") + m.param.name; });

}  // namespace
}  // namespace corank
