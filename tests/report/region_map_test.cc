#include "corank/report/region_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
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

TEST(RegionMap, HasAPanelForEachRegionAndItsLabel) {
  const std::string svg = to_svg(two_squares());
  EXPECT_EQ(count(svg, "class=\"region\""), 2);
  EXPECT_THAT(svg, HasSubstr(">1 +<"));
  EXPECT_THAT(svg, HasSubstr("a &lt; b"));
  EXPECT_THAT(svg, HasSubstr("θ"));
}

// Else polygons over one another would make a hole.
TEST(RegionMap, DrawsPolygonsOfBothSensesInOne) {
  const std::string svg = to_svg(two_squares());
  const auto path = [&](std::size_t k) {
    std::size_t at = 0;
    for (; k-- > 0;) at = svg.find("class=\"region\"", at + 1);
    const std::size_t from = svg.find("d=\"", at) + 3;
    return svg.substr(from, svg.find('"', from) - from);
  };
  const auto clockwise = [](const std::string& d) {
    std::vector<double> v;
    for (const char* p = d.c_str(); *p != 0;) {
      char* end = nullptr;
      const double x = std::strtod(p, &end);
      if (end == p) {
        ++p;
        continue;
      }
      v.push_back(x), p = end;
    }
    return (v[2] - v[0]) * (v[5] - v[1]) - (v[3] - v[1]) * (v[4] - v[0]) > 0;
  };
  EXPECT_EQ(clockwise(path(1)), clockwise(path(2)));
}

TEST(RegionMap, RepeatsAnAngleAtItsOtherEnd) {
  RegionMap map = two_squares();
  map.planes[0].y_angle = true;
  const std::string inside = to_svg(map);
  map.planes[0].regions[0][0] = {{0, 3}, {1, 3}, {1, 4}, {0, 4}};
  EXPECT_EQ(count(to_svg(map), "M"), count(inside, "M") + 2);  // in its panel, and among the rest
}

}  // namespace
}  // namespace corank::report
