#include "corank/report/heat_map.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "corank/report/layout_svg.h"

namespace corank::report {
namespace {

constexpr double kLeft = 46, kTop = 22, kWidth = 300, kScaleWidth = 12, kScaleGap = 14, kText = 8.5, kLine = 0.5;
constexpr int kShades = 64;

// Dark blue, green, yellow: its lightness grows evenly, so it can be read in grey as well.
Color shade(double t) {
  constexpr std::array<Color, 5> kStops = {
      Color{0.27, 0.0, 0.33}, {0.23, 0.32, 0.55}, {0.13, 0.57, 0.55}, {0.37, 0.79, 0.38}, {0.99, 0.91, 0.14}};
  const double at = std::clamp(t, 0.0, 1.0) * (kStops.size() - 1);
  const auto k = std::min(static_cast<std::size_t>(at), kStops.size() - 2);
  const double share = at - static_cast<double>(k);
  const Color &a = kStops[k], &b = kStops[k + 1];
  return {a.red + share * (b.red - a.red), a.green + share * (b.green - a.green), a.blue + share * (b.blue - a.blue)};
}

}  // namespace

std::string to_svg(const HeatMap& map) {
  const double ratio = std::clamp(map.y_range.width() / std::max(map.x_range.width(), 1e-300), 0.2, 2.0);
  const double height = kWidth * ratio, right = kLeft + kWidth, bottom = kTop + height;
  const auto x_at = [&](double x) { return kLeft + (x - map.x_range.lo()) / map.x_range.width() * kWidth; };
  const auto y_at = [&](double y) { return bottom - (y - map.y_range.lo()) / map.y_range.width() * height; };
  Layout out;
  const auto text = [&](double x, double y, Layout::Anchor anchor, Label label, bool upward = false) {
    out.texts.push_back({x, y, kText, anchor, upward, std::move(label)});
  };
  const auto line = [&](double x0, double y0, double x1, double y1) { out.lines.push_back({x0, y0, x1, y1, kLine}); };
  const auto frame = [&](double x0, double y0, double x1, double y1) {
    line(x0, y0, x1, y0), line(x1, y0, x1, y1), line(x1, y1, x0, y1), line(x0, y1, x0, y0);
  };
  double most = 0;
  for (const HeatMap::Cell& c : map.cells) most = std::max(most, c.value);
  for (const HeatMap::Cell& c : map.cells)
    out.swatches.push_back({x_at(c.x.lo()), y_at(c.y.hi()), x_at(c.x.hi()) - x_at(c.x.lo()), y_at(c.y.lo()) - y_at(c.y.hi()),
                            shade(most > 0 ? c.value / most : 0), 1});
  frame(kLeft, kTop, right, bottom);
  for (const Tick& t : ticks(map.x_range.lo(), map.x_range.hi(), false, 7)) {
    line(x_at(t.at), bottom, x_at(t.at), bottom + 3);
    text(x_at(t.at), bottom + 12, Layout::Anchor::middle, {{t.text}});
  }
  for (const Tick& t : ticks(map.y_range.lo(), map.y_range.hi(), false, 7)) {
    line(kLeft - 3, y_at(t.at), kLeft, y_at(t.at));
    text(kLeft - 5, y_at(t.at) + 3, Layout::Anchor::end, {{t.text}});
  }
  text((kLeft + right) / 2, bottom + 24, Layout::Anchor::middle, math_label(map.x_name));
  text(12, (kTop + bottom) / 2, Layout::Anchor::middle, math_label(map.y_name), true);
  text(kLeft, kTop - 8, Layout::Anchor::start, {{map.title}});

  const double scale = right + kScaleGap;
  for (int k = 0; k < kShades; ++k)
    out.swatches.push_back(
        {scale, bottom - height * (k + 1) / kShades, kScaleWidth, height / kShades, shade((k + 0.5) / kShades), 1});
  frame(scale, kTop, scale + kScaleWidth, bottom);
  if (most > 0)
    for (const Tick& t : ticks(0, most, false, 6)) {
      const double y = bottom - t.at / most * height;
      line(scale + kScaleWidth, y, scale + kScaleWidth + 3, y);
      text(scale + kScaleWidth + 5, y + 3, Layout::Anchor::start, {{t.text}});
    }
  text(scale + kScaleWidth + 38, (kTop + bottom) / 2, Layout::Anchor::middle, {{map.value_name}}, true);
  if (map.mark) {
    const double x = x_at(map.mark->x), y = y_at(map.mark->y);
    line(x - 5, y, x + 5, y), line(x, y - 5, x, y + 5);
    text(kLeft, bottom + 38, Layout::Anchor::start, {{"+ " + map.mark->label}});
  }
  out.width = scale + kScaleWidth + 46, out.height = bottom + 44;
  return to_svg(out, map.title);
}

}  // namespace corank::report
