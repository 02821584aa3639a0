// In which aspect the boxes of another cover lie.
#include "corank/analyze/pieces/pieces.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>

#include "corank/analyze/aspects/aspects.h"
#include "corank/solve/search/solve.h"
#include "corank/study/model.h"

namespace corank::analyze {
namespace {

struct Placed {
  Cover cover;
  System system;
  Aspects aspects;
};

Placed placed(const std::string& model, double sigma) {
  const study::Question question{
      .model = study::read_model(std::string(CORANK_SOURCE_DIR) + "/models/" + model + ".cuik").mechanism,
      .set = symbolic::SingularitySet::cspace};
  Placed result;
  result.system = study::system(question);
  solve::Options search;
  search.sigma = sigma;
  solve::Control control;
  result.cover = solve::solve(solve::prepare(result.system, search, control), control);
  AspectsOptions options;
  options.placed = &result.cover;
  result.aspects = aspects(question, options, control);
  return result;
}

// The arcs of the three-slider's C-space: two curves by the sign of y_A; det L_y = 0 where x_C y_B = 0.
TEST(PiecePlaces, OfTheThreeSlidersBoxesAreThoseOfTheirSigns) {
  const Placed p = placed("three_slider", 0.02);
  ASSERT_EQ(p.aspects.places.size(), p.cover.boxes.size());
  const auto x_c = static_cast<std::size_t>(p.system.find("x_C")), y_a = static_cast<std::size_t>(p.system.find("y_A")),
             y_b = static_cast<std::size_t>(p.system.find("y_B"));
  const auto sign = [](const Interval& x) { return x.lo() > 0 ? 1 : x.hi() < 0 ? -1 : 0; };
  int clear = 0;
  for (std::size_t i = 0; i < p.cover.boxes.size(); ++i) {
    const Box& box = p.cover.boxes[i].box;
    const int place = p.aspects.places[i];
    ASSERT_GE(place, 0) << i;
    const Box& there = p.aspects.aspects.representatives[static_cast<std::size_t>(place)];
    for (const std::size_t j : {x_c, y_a, y_b}) {
      if (sign(box[j]) == 0) continue;  // a locus passes, or may
      EXPECT_EQ(sign(box[j]), sign(there[j])) << i;
      ++clear;
    }
  }
  EXPECT_GT(clear, 2 * static_cast<int>(p.cover.boxes.size()));
}

// Next to a locus a box has the aspect of a solution near its middle: so it is on the side on which that is.
TEST(PiecePlaces, OfABoxThatALocusPassesIsTheOneOfItsMiddle) {
  const Placed p = placed("three_slider", 0.3);
  const auto x_c = static_cast<std::size_t>(p.system.find("x_C"));
  int passed = 0;
  for (std::size_t i = 0; i < p.cover.boxes.size(); ++i) {
    const Interval& x = p.cover.boxes[i].box[x_c];
    if (!x.contains(0.0) || std::fabs(x.mid()) < 0.02) continue;
    ASSERT_GE(p.aspects.places[i], 0);
    const Box& there = p.aspects.aspects.representatives[static_cast<std::size_t>(p.aspects.places[i])];
    EXPECT_EQ(x.mid() > 0, there[x_c].mid() > 0) << i;
    ++passed;
  }
  EXPECT_GT(passed, 0);
}

TEST(PiecePlaces, AreUnknownOnceTheWorkIsStopped) {
  const Placed p = placed("three_slider", 0.1);
  const std::atomic<bool> stop{true};
  const solve::Control ended({.stop = &stop});
  SignCells cells(p.system, p.cover, {}, {}, ended);
  const std::vector<int> places = piece_places(cells, p.aspects.aspects, p.cover.boxes, ended);
  EXPECT_EQ(places, std::vector<int>(p.cover.boxes.size(), -1));
}

}  // namespace
}  // namespace corank::analyze
