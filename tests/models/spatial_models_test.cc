// Models in space that users brought, whose equations share products: what elimination makes of them is searched in few
// boxes. Skipped where the models are absent.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "corank/solve/search/solve.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/symbolic/sets/kernel_scale.h"

namespace corank {
namespace {
using symbolic::SingularitySet;

struct Expectation {
  const char* model;
  std::optional<SingularitySet> set;
  double sigma;
  std::uint64_t processed;  ///< at most
  std::size_t points;       ///< 0: a curve or a surface
};
void PrintTo(const Expectation& e, std::ostream* out) { *out << e.model; }

class SpatialModel : public testing::TestWithParam<Expectation> {};

TEST_P(SpatialModel, IsProvenWithFewBoxes) {
  const std::filesystem::path file =
      std::string(CORANK_SOURCE_DIR "/../shared/models/spatial/") + GetParam().model + ".cuik";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
  const auto model = symbolic::read_model(file);
  const System system = GetParam().set
                            ? symbolic::algebrize(symbolic::singularity_system(
                                  model, *GetParam().set, std::nullopt, symbolic::kernel_scales(model, *GetParam().set)))
                            : symbolic::algebrize(symbolic::plain_system(model));
  solve::Options options;
  if (GetParam().sigma > 0) options.sigma = GetParam().sigma;
  options.max_boxes = 2 * GetParam().processed;
  const Cover cover = solve::solve(system, options);
  EXPECT_TRUE(cover.complete());
  EXPECT_EQ(cover.count(Verdict::undecided), 0u);
  EXPECT_LE(cover.statistics.processed, GetParam().processed);
  if (GetParam().points > 0) {
    EXPECT_EQ(cover.points.size(), GetParam().points);
  }
}

INSTANTIATE_TEST_SUITE_P(Users, SpatialModel,
                         testing::Values(Expectation{"stewart_rotation_matrix", SingularitySet::forward, 0.1, 5000, 0},
                                         Expectation{"stewart_twist", std::nullopt, 0.1, 5000, 0},
                                         Expectation{"stewart_twist_12_digits", std::nullopt, 0.1, 5000, 0},
                                         Expectation{"3rps_one_mode", SingularitySet::forward, 0.1, 60'000, 0},
                                         Expectation{"delta_position", std::nullopt, 0, 3000, 8},
                                         Expectation{"delta_position_by_legs", std::nullopt, 0, 1000, 8}),
                         [](const auto& e) { return std::string("of_") + e.param.model; });

}  // namespace
}  // namespace corank
