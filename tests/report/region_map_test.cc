#include "corank/report/pictures/region_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cctype>
#include <string>
#include <vector>

namespace corank::report {
namespace {

using ::testing::HasSubstr;

int count(const std::string& text, const std::string& word) {
  int result = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++result;
  return result;
}

RegionMap two_squares() {
  const RegionMap::Polygon forth{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, back{{0, 0}, {0, 1}, {1, 1}, {1, 0}};
  return {.title = "a < b",
          .labels = {"1 +", "2 −"},
          .planes = {{.x_name = "x", .y_name = "theta2", .regions = {{forth}, {back}}}}};
}

// What is drawn of region `k`.
std::string path(const std::string& svg, std::size_t k) {
  std::size_t at = svg.find("class=\"region\"");
  for (; k > 0; --k) at = svg.find("class=\"region\"", at + 1);
  const std::size_t from = svg.find(" d=\"", at) + 4;
  return svg.substr(from, svg.find('"', from) - from);
}

std::size_t numbers(const std::string& d) {
  std::size_t result = 0;
  for (std::size_t k = 1; k < d.size(); ++k)
    result += std::isdigit(static_cast<unsigned char>(d[k])) != 0 && std::isdigit(static_cast<unsigned char>(d[k - 1])) == 0;
  return result;
}

TEST(RegionMap, HasAPanelForEachRegionAndItsLabel) {
  const std::string svg = to_svg(two_squares());
  EXPECT_EQ(count(svg, "class=\"region\""), 2);
  EXPECT_THAT(svg, HasSubstr(">1 +<"));
  EXPECT_THAT(svg, HasSubstr("a &lt; b"));
  EXPECT_THAT(svg, HasSubstr("θ"));
}

// Polygons side by side are one shape, and of two senses over one another they make no hole.
TEST(RegionMap, DrawsPolygonsThatTouchOrOverlapAsOneShape) {
  RegionMap map = two_squares();
  map.planes[0].regions[0] = {
      {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {{1, 0}, {1, 1}, {2, 1}, {2, 0}}, {{0.5, 0.5}, {0.5, 1.5}, {1.5, 1.5}, {1.5, 0.5}}};
  const std::string d = path(to_svg(map), 0);
  EXPECT_EQ(count(d, "M"), 1) << d;
  EXPECT_EQ(count(d, "Z"), 1);
}

TEST(RegionMap, KeepsAHoleAndLeavesOutPointsThatNobodySees) {
  RegionMap map = two_squares();
  map.planes[0].regions[0].clear();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (i != 1 || j != 1) {
        const double x = i, y = j;
        map.planes[0].regions[0].push_back({{x, y}, {x + 0.5, y}, {x + 1, y}, {x + 1, y + 1}, {x, y + 1}});
      }
  const std::string d = path(to_svg(map), 0);
  EXPECT_EQ(count(d, "M"), 2) << d;
  EXPECT_EQ(numbers(d), 2 * 2 * 4u) << d;
}

TEST(RegionMap, RepeatsAnAngleAtItsOtherEnd) {
  RegionMap map = two_squares();
  map.planes[0].y_angle = true;
  const std::string inside = to_svg(map);
  map.planes[0].regions[0][0] = {{0, 3}, {1, 3}, {1, 4}, {0, 4}};
  EXPECT_EQ(count(to_svg(map), "M"), count(inside, "M") + 1);
}

}  // namespace
}  // namespace corank::report
