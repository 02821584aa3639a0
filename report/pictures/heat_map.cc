#include "corank/report/pictures/heat_map.h"

#include <algorithm>
#include <array>

#include "corank/report/pictures/layout.h"

namespace corank::report {
namespace {

constexpr double kScaleWidth = 12, kScaleGap = 14;
constexpr int kScaleSteps = 64;

// Dark blue, green, yellow: its lightness grows evenly, so it can be read in grey as well.
constexpr std::array<Color, 5> kStops = {
    Color{0.27, 0.0, 0.33}, {0.23, 0.32, 0.55}, {0.13, 0.57, 0.55}, {0.37, 0.79, 0.38}, {0.99, 0.91, 0.14}};

}  // namespace

std::string to_svg(const HeatMap& map) {
  Layout out;
  out.frame_x = kPlaneLeft, out.frame_y = kPlaneTop, out.frame_width = kPlaneWidth;
  out.frame_height = kPlaneWidth * std::clamp(map.y_range.width() / std::max(map.x_range.width(), 1e-300), 0.2, 2.0);
  out.x_range = map.x_range, out.y_range = map.y_range;
  const double height = out.frame_height, right = kPlaneLeft + kPlaneWidth, bottom = kPlaneTop + height;
  const auto text = [&](double x, double y, Layout::Anchor anchor, const std::string& words, bool upward = false) {
    out.texts.push_back({x, y, kPlaneText, anchor, upward, {{words}}});
  };
  const auto line = [&](double x0, double y0, double x1, double y1) { out.lines.push_back({x0, y0, x1, y1, kPlaneLine}); };
  double most = 0;
  for (const HeatMap::Cell& c : map.cells) most = std::max(most, c.value);
  for (const HeatMap::Cell& c : map.cells)
    out.swatches.push_back({out.x_at(c.x.lo()), out.y_at(c.y.hi()), out.x_at(c.x.hi()) - out.x_at(c.x.lo()),
                            out.y_at(c.y.lo()) - out.y_at(c.y.hi()), between(kStops, most > 0 ? c.value / most : 0), 1});
  add_axes(out, {math_label(map.x_name), math_label(map.y_name)},
           {ticks(map.x_range.lo(), map.x_range.hi(), false, 7), ticks(map.y_range.lo(), map.y_range.hi(), false, 7)},
           {.line = kPlaneLine, .numbers = kPlaneText, .names = kPlaneText, .below = 12, .name_below = 24, .name_x = 12});
  text(kPlaneLeft, kPlaneTop - 8, Layout::Anchor::start, map.title);

  const double scale = right + kScaleGap;
  for (int k = 0; k < kScaleSteps; ++k)
    out.swatches.push_back({scale, bottom - height * (k + 1) / kScaleSteps, kScaleWidth, height / kScaleSteps,
                            between(kStops, (k + 0.5) / kScaleSteps), 1});
  add_frame(out, scale, kPlaneTop, scale + kScaleWidth, bottom, kPlaneLine);
  if (most > 0)
    for (const Tick& t : ticks(0, most, false, 6)) {
      const double y = bottom - t.at / most * height;
      line(scale + kScaleWidth, y, scale + kScaleWidth + 3, y);
      text(scale + kScaleWidth + 5, y + 3, Layout::Anchor::start, t.text);
    }
  text(scale + kScaleWidth + 38, (kPlaneTop + bottom) / 2, Layout::Anchor::middle, map.value_name, true);
  if (map.mark) {
    const double x = out.x_at(map.mark->x), y = out.y_at(map.mark->y);
    line(x - 5, y, x + 5, y), line(x, y - 5, x, y + 5);
    text(kPlaneLeft, bottom + 38, Layout::Anchor::start, "+ " + map.mark->label);
  }
  out.width = scale + kScaleWidth + 46, out.height = bottom + 44;
  return to_svg(out, map.title);
}

}  // namespace corank::report
