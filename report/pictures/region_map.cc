#include "corank/report/pictures/region_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "corank/report/pictures/cell_union.h"
#include "corank/report/pictures/layout.h"
#include "corank/symbolic/model/display_name.h"

namespace corank::report {
namespace {

constexpr double kPanel = 150, kPanelGap = 16, kMapLeft = 46, kMapTop = 40, kMapText = 10;
constexpr int kMapColumns = 5;
constexpr const char* kRest = "#e4e6e8";
constexpr std::array kColors{"#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9", "#d55e00",
                             "#7f5fb8", "#9aa61c", "#8c564b", "#17909e", "#b03060", "#4d6f39"};

std::string runs(const Label& label) {
  std::string result;
  for (const TextRun& run : label)
    result += fmt::format("<tspan{}{}>{}</tspan>", run.italic ? " font-style=\"italic\"" : "",
                          run.subscript ? " font-size=\"72%\" baseline-shift=\"sub\"" : "", symbolic::html_text(run.text));
  return result;
}

std::string text(double x, double y, const char* anchor, const std::string& content, const std::string& more = "") {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>\n", x, y, anchor, more, content);
}

// Points are told apart to a tenth of a pixel, and what is nearer than that is one.
constexpr int kSteps = 10;
constexpr double kSeen = 1.2;

// "M120 34l5-3 2 7Z": each point from the one before.
std::string ring_data(const std::vector<GridPolygon>& rings) {
  std::string out;
  GridPoint last;
  const auto add = [&](int number, bool after_letter) {
    if (number >= 0 && !after_letter) out += ' ';
    out += std::to_string(number);
  };
  for (const GridPolygon& ring : rings) {
    for (std::size_t k = 0; k < ring.size(); ++k) {
      if (k < 2) out += k == 0 ? 'M' : 'l';
      const GridPoint from = k == 0 ? GridPoint{} : last;
      add(ring[k].x - from.x, k < 2);
      add(ring[k].y - from.y, false);
      last = ring[k];
    }
    out += 'Z';
  }
  return out;
}

// One plane's panels, `top` the first row's upper edge.
class Block {
 public:
  Block(const RegionMap& map, std::size_t plane, double top)
      : map_(map),
        plane_(map.planes[plane]),
        name_(plane),
        top_(top),
        x_(range(plane_.x_angle, 0)),
        y_(range(plane_.y_angle, 1)) {
    // One scale where both are lengths, or both angles.
    const bool alike = plane_.x_angle == plane_.y_angle;
    height_ = kPanel * (alike ? std::clamp(y_.width() / x_.width(), 0.3, 2.0) : 1.0);
  }

  double height() const { return rows() * (height_ + kMapTop) + 26; }

  std::string svg() const {
    std::string rest, out;
    for (std::size_t k = 0; k < plane_.regions.size(); ++k) rest += fmt::format("<use href=\"#region{}-{}\"/>", name_, k);
    out += fmt::format(
        "<defs><g id=\"rest{0}\" fill=\"{2}\" stroke=\"{2}\">{1}</g>"
        "<clipPath id=\"panel{0}\"><rect width=\"{3:.1f}\" height=\"{4:.1f}\"/></clipPath></defs>\n",
        name_, rest, kRest, kPanel, height_);
    for (std::size_t k = 0; k < plane_.regions.size(); ++k) out += panel(k);
    const double middle = kMapLeft + (columns() * (kPanel + kPanelGap) - kPanelGap) / 2,
                 bottom = top_ + rows() * (height_ + kMapTop);
    out += text(middle, bottom + 10, "middle", runs(math_label(plane_.x_name)), " font-size=\"12\"");
    out += fmt::format("<g transform=\"translate({:.1f},{:.1f}) rotate(-90)\">{}</g>\n", 12.0,
                       top_ + rows() * (height_ + kMapTop) / 2,
                       text(0, 0, "middle", runs(math_label(plane_.y_name)), " font-size=\"12\""));
    return out;
  }

 private:
  Interval range(bool angle, std::size_t j) const {
    if (angle) return {-std::numbers::pi, std::numbers::pi};
    double lo = HUGE_VAL, hi = -HUGE_VAL;
    for (const auto& region : plane_.regions)
      for (const RegionMap::Polygon& polygon : region)
        for (const auto& point : polygon) lo = std::min(lo, point[j]), hi = std::max(hi, point[j]);
    const double margin = 0.03 * std::max(hi - lo, 1e-9);
    return {lo - margin, hi + margin};
  }
  int columns() const { return std::min(kMapColumns, std::max(1, static_cast<int>(plane_.regions.size()))); }
  int rows() const { return (static_cast<int>(plane_.regions.size()) + kMapColumns - 1) / kMapColumns; }
  double x_at(double x) const { return (x - x_.lo()) / x_.width() * kPanel; }
  double y_at(double y) const { return (y_.hi() - y) / y_.width() * height_; }

  std::string path(const std::vector<RegionMap::Polygon>& region) const {
    std::vector<GridPolygon> polygons;
    const auto add = [&](const RegionMap::Polygon& polygon, double dx, double dy) {
      GridPolygon& points = polygons.emplace_back();
      for (const auto& [x, y] : polygon)
        points.push_back(
            {static_cast<int>(std::lround(kSteps * x_at(x + dx))), static_cast<int>(std::lround(kSteps * y_at(y + dy)))});
    };
    // An angle's polygons go on at the other end.
    const auto turns = [](bool angle, const RegionMap::Polygon& polygon, std::size_t j) {
      std::vector<double> result{0};
      if (!angle) return result;
      const auto [lo, hi] =
          std::minmax_element(polygon.begin(), polygon.end(), [&](const auto& p, const auto& q) { return p[j] < q[j]; });
      if ((*lo)[j] < -std::numbers::pi) result.push_back(2 * std::numbers::pi);
      if ((*hi)[j] > std::numbers::pi) result.push_back(-2 * std::numbers::pi);
      return result;
    };
    for (const RegionMap::Polygon& polygon : region)
      for (const double dx : turns(plane_.x_angle, polygon, 0))
        for (const double dy : turns(plane_.y_angle, polygon, 1)) add(polygon, dx, dy);
    return ring_data(outlines_of_union(polygons, kSeen));
  }

  std::string panel(std::size_t k) const {
    const int row = static_cast<int>(k) / kMapColumns, column = static_cast<int>(k) % kMapColumns;
    const double left = kMapLeft + column * (kPanel + kPanelGap), top = top_ + row * (height_ + kMapTop);
    const char* color = region_color(k);
    std::string out = fmt::format("<g transform=\"translate({:.1f},{:.1f})\">\n", left, top);
    out += text(0, -6, "start", symbolic::html_text(map_.labels[k]), fmt::format(" font-size=\"11\" fill=\"{}\"", color));
    out += fmt::format(
        "<g clip-path=\"url(#panel{0})\"><g transform=\"scale({4:g})\" stroke-width=\"{5:g}\" fill-rule=\"evenodd\">"
        "<use href=\"#rest{0}\"/><g fill=\"{3}\" stroke=\"{3}\"><path class=\"region\" id=\"region{0}-{1}\" "
        "d=\"{2}\"/></g></g></g>\n",
        name_, k, path(plane_.regions[k]), color, 1.0 / kSteps, 0.6 * kSteps);
    out += fmt::format("<rect width=\"{:.1f}\" height=\"{:.1f}\" fill=\"none\" stroke=\"#333\" stroke-width=\"0.6\"/>\n",
                       kPanel, height_);
    for (const Tick& t : ticks(x_.lo(), x_.hi(), plane_.x_angle, 4)) {
      out += fmt::format("<path d=\"M{0:.1f} {1:.1f}v3\" stroke=\"#333\" stroke-width=\"0.6\"/>\n", x_at(t.at), height_);
      out += text(x_at(t.at), height_ + 13, "middle", symbolic::html_text(t.text));
    }
    for (const Tick& t : ticks(y_.lo(), y_.hi(), plane_.y_angle, 4)) {
      out += fmt::format("<path d=\"M0 {:.1f}h-3\" stroke=\"#333\" stroke-width=\"0.6\"/>\n", y_at(t.at));
      if (column == 0) out += text(-5, y_at(t.at) + 3, "end", symbolic::html_text(t.text));
    }
    return out + "</g>\n";
  }

  const RegionMap& map_;
  const RegionMap::Plane& plane_;
  std::size_t name_;
  double top_;
  Interval x_, y_;
  double height_;
};

}  // namespace

const char* region_color(std::size_t k) { return kColors[k % kColors.size()]; }

std::string to_svg(const RegionMap& map) {
  std::string body;
  double top = kMapTop + 14;
  for (std::size_t p = 0; p < map.planes.size(); ++p) {
    const Block block(map, p, top);
    body += block.svg();
    top += block.height();
  }
  const int columns = std::min(kMapColumns, std::max(1, static_cast<int>(map.labels.size())));
  const double width = kMapLeft + columns * (kPanel + kPanelGap), height = top - kMapTop + 14;
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
      "font-family=\"Helvetica, Arial, sans-serif\" font-size=\"{2}\">\n<title>{3}</title>\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n<text x=\"{4}\" y=\"22\" "
      "font-size=\"14\">{3}</text>\n{5}</svg>\n",
      width, height, kMapText, symbolic::html_text(map.title), kMapLeft, body);
}

}  // namespace corank::report
