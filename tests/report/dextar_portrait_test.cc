// Dextar's output portrait against closed forms. With all four links l: J3 reaches the lens of the discs of radius 2l about
// J5 = (0, 0) and J1 = (d, 0), and no other point; the inverse locus is the lens's outline (an arm stretched) with the
// points J5 and J1 (an arm folded).
#include <gtest/gtest.h>

#include "corank/solve/search/solve.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/symbolic/sets/algebrizer.h"
#include "corank/tests/report/portrait_reader.h"

namespace corank::report {
namespace {

using symbolic::SingularitySet;

constexpr double kReach = 1.8, kBase = 1.18;

// > 0 inside the lens: the distance to its outline where that is an arc.
double depth(double x, double y) { return kReach - std::max(std::hypot(x, y), std::hypot(x - kBase, y)); }

result::Result solved(SingularitySet set, const std::string& name, double sigma) {
  static const auto model = symbolic::read_model(CORANK_SOURCE_DIR "/models/dextar.cuik");
  const System system = symbolic::algebrize(symbolic::singularity_system(model, set, std::nullopt));
  solve::Options options;
  options.sigma = sigma;
  result::Result result;
  result.set = name;
  result.cover = solve::solve(system, options);
  result::describe_system(system, result);
  return result;
}

class DextarPortrait : public testing::Test {
 protected:
  static constexpr double kCspaceSigma = 0.2, kInverseSigma = 0.05;
  static void SetUpTestSuite() {
    const PictureFolder folder;
    const result::Result inverse = solved(SingularitySet::inverse, "inverse", kInverseSigma),
                         cspace = solved(SingularitySet::cspace, "cspace", kCspaceSigma);
    const Picture picture = make_picture({picture_view(inverse, "inverse.h5"), picture_view(cspace, "cspace.h5")},
                                         {{"J3x", "J3y"}, ColorScheme::set, 0});
    PortraitOptions options;
    options.width_mm = 40;
    portrait_ = new SvgPortrait;
    write_portrait(folder.file("dextar.svg"), picture, options);
    read_svg(folder.file("dextar.svg"), *portrait_);
  }
  static void TearDownTestSuite() { delete portrait_; }

  // Calls visit(x, y) for the middle of every third cell.
  template <class Visit>
  void for_each_place(Visit visit) const {
    const SvgPortrait& p = *portrait_;
    for (int r = 1; r < p.rows; r += 3)
      for (int c = 1; c < p.columns; c += 3)
        visit(p.x_lo + (c + 0.5) / p.columns * (p.x_hi - p.x_lo), p.y_hi - (r + 0.5) / p.rows * (p.y_hi - p.y_lo));
  }
  static SvgPortrait* portrait_;
};
SvgPortrait* DextarPortrait::portrait_ = nullptr;

TEST_F(DextarPortrait, CSpaceIsTheLensAndNothingBeyondABox) {
  ASSERT_EQ(portrait_->layers.size(), 2u);
  ASSERT_EQ(portrait_->layers[0].set, "cspace");
  int inside = 0, lost = 0, outside = 0, excess = 0;
  for_each_place([&](double x, double y) {
    const double here = depth(x, y);
    if (here > portrait_->per_cell()) {
      ++inside;
      lost += !portrait_->holds(0, x, y);
    } else if (here < -kCspaceSigma * std::sqrt(2) - 2 * portrait_->per_cell()) {  // beyond any box that reaches the lens
      ++outside;
      excess += portrait_->holds(0, x, y);
    }
  });
  EXPECT_EQ(lost, 0) << "places that can be reached";
  EXPECT_EQ(excess, 0) << "places that cannot";
  EXPECT_GT(inside, 10'000);
  EXPECT_GT(outside, 500);
}

TEST_F(DextarPortrait, TheInverseLocusIsTheOutlineAndTheTwoMotors) {
  ASSERT_EQ(portrait_->layers[1].set, "inverse");
  for (const double centre : {0.0, kBase}) {
    EXPECT_TRUE(portrait_->holds(1, centre, 0));
    int samples = 0;
    for (int k = 0; k < 5000; ++k) {
      const double t = 2 * M_PI * k / 5000, x = centre + kReach * std::cos(t), y = kReach * std::sin(t);
      if (std::hypot(x - (kBase - centre), y) > kReach) continue;
      ++samples;
      ASSERT_TRUE(portrait_->holds(1, x, y)) << x << ' ' << y;
    }
    EXPECT_GT(samples, 1000);
  }
  const double beyond = kInverseSigma * std::sqrt(2) + 2 * portrait_->per_cell();
  const double corner =
      std::sqrt(kReach * kReach - kBase * kBase / 4);  // beside it the outline is farther than the depth says
  int elsewhere = 0, excess = 0;
  for_each_place([&](double x, double y) {
    if (std::fabs(depth(x, y)) < beyond || std::hypot(x, y) < beyond || std::hypot(x - kBase, y) < beyond) return;
    if (std::hypot(x - kBase / 2, std::fabs(y) - corner) < 2 * beyond) return;
    ++elsewhere;
    excess += portrait_->holds(1, x, y);
  });
  EXPECT_EQ(excess, 0);
  EXPECT_GT(elsewhere, 10'000);
}

}  // namespace
}  // namespace corank::report
