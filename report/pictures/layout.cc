#include "corank/report/pictures/layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>
#include <numeric>
#include <set>

#include "corank/core/check.h"
#include "corank/symbolic/model/display_name.h"

namespace corank::report {
namespace {

constexpr double kPointsPerMm = 72 / 25.4, kCell = 72.0 / 1200;
constexpr int kMostCells = 8192;
constexpr double kTitleSize = 9, kNameSize = 8.5, kTickSize = 7.5, kLegendSize = 7.5;
constexpr double kEdge = 3, kGap = 3, kTickLength = 2.5, kLineWidth = 0.5;

// What an axis shows.
Interval view(std::span<const Picture> pictures, std::size_t j) {
  double lo = HUGE_VAL, hi = -HUGE_VAL;
  for (const Picture& picture : pictures)
    for (const PictureLayer& layer : picture.layers)
      for (const PictureBox& box : layer.boxes) lo = std::min(lo, box.sides[j].lo()), hi = std::max(hi, box.sides[j].hi());
  const auto& range = pictures.front().axes[j].range;
  if (range && range->width() < 2 * (hi - lo)) return *range;
  const double least = 1e-9 * std::max({1e-3, std::fabs(lo), std::fabs(hi)});  // a point has an extent, too
  const double margin = std::max(0.04 * (hi - lo), least);
  return {lo - margin, hi + margin};
}

// Height of the frame over its width.
double proportion(const Picture& picture, const Interval& x, const Interval& y) {
  constexpr double kFree = 0.75, kLeast = 0.3, kMost = 2;
  if (picture.axes[0].angle != picture.axes[1].angle) return kFree;
  const double equal = y.width() / x.width();
  return equal >= kLeast && equal <= kMost ? equal : kFree;
}

// Outward to cells of the frame.
struct Scale {
  double lo, cells_per_unit;
  int cells;
  int below(double v) const { return static_cast<int>(std::clamp(std::floor((v - lo) * cells_per_unit), 0.0, cells - 1.0)); }
  int above(double v, int at_least) const {
    return std::max(at_least, static_cast<int>(std::clamp(std::ceil((v - lo) * cells_per_unit), 0.0, double(cells))));
  }
};

Layout::Shape shape(const PictureLayer& layer, const Scale& x, const Scale& y, double mark_cells) {
  CellUnion cells(x.cells, y.cells);
  for (const PictureBox& box : layer.boxes) {
    const int x0 = x.below(box.sides[0].lo()), x1 = x.above(box.sides[0].hi(), x0 + 1);
    const int y0 = y.below(box.sides[1].lo()), y1 = y.above(box.sides[1].hi(), y0 + 1);
    cells.add(x0, y.cells - y1, x1, y.cells - y0);
  }
  Layout::Shape result{layer.label, layer.set, layer.color, layer.opacity, cells.outlines(), {}};
  for (const GridPolygon& p : result.polygons) {
    const auto [left, right] = std::ranges::minmax(p, {}, &GridPoint::x);
    const auto [top, bottom] = std::ranges::minmax(p, {}, &GridPoint::y);
    if (std::max(right.x - left.x, bottom.y - top.y) >= 2 * mark_cells) continue;
    const GridPoint first =
        *std::ranges::min_element(p, [](auto& a, auto& b) { return a.y < b.y || (a.y == b.y && a.x < b.x); });
    if (cells.holds(first.x, first.y)) result.marked.push_back(p);  // else a hole
  }
  return result;
}

// Swatches and their words in rows from y on, as many to a row as there is room. Returns the y below.
double add_legend(const Picture& picture, const TextWidth& text_width, double left, double right, double y, Layout& out) {
  constexpr double kSwatch = 6, kSpace = 9, kRow = 10.5;
  std::vector<std::string> seen;
  double x = left;
  y += kRow;
  for (const PictureLayer& layer : picture.layers) {
    const Label label{{layer.label + (layer.boxes.empty() ? " (none)" : "")}};
    if (std::ranges::find(seen, label[0].text) != seen.end()) continue;
    seen.push_back(label[0].text);
    const double width = kSwatch + kGap + text_width(label, kLegendSize);
    if (x > left && x + width > right) x = left, y += kRow;
    out.swatches.push_back({x, y - kSwatch + 0.3, kSwatch, kSwatch, layer.color, layer.opacity});
    out.texts.push_back({x + kSwatch + kGap, y, kLegendSize, Layout::Anchor::start, false, label});
    x += width + kSpace;
  }
  return y + 5;
}

double widest(const std::vector<Tick>& marks, const TextWidth& text_width) {
  double width = 0;
  for (const Tick& t : marks) width = std::max(width, text_width({{t.text}}, kTickSize));
  return width;
}

// Strokes of one length, none close to another of much the same direction.
void add_hatches(const Picture& picture, Layout& out) {
  constexpr double kLength = 4, kApart = 3.5;
  constexpr int kDirections = 8;
  std::set<std::array<long, 3>> taken;
  for (const PictureHatch& hatch : picture.hatches) {
    const double x_scale = out.frame_width / out.x_range.width(), y_scale = out.frame_height / out.y_range.width();
    const double x0 = (hatch.from[0] - out.x_range.lo()) * x_scale,
                 y0 = out.frame_height - (hatch.from[1] - out.y_range.lo()) * y_scale;
    // A normal of the plane of the outputs, where a unit has another length along the other axis.
    const double dx = hatch.direction[0] / x_scale, dy = -hatch.direction[1] / y_scale, size = std::hypot(dx, dy);
    if (!(size > 0) || x0 < 0 || x0 > out.frame_width || y0 < 0 || y0 > out.frame_height) continue;
    const auto turn = std::lround(std::atan2(dy, dx) / (2 * std::numbers::pi) * kDirections) % kDirections;
    if (!taken.insert({std::lround(x0 / kApart), std::lround(y0 / kApart), turn}).second) continue;
    const double left = out.frame_x + x0, top = out.frame_y + y0;
    out.lines.push_back({left, top, left + kLength * dx / size, top + kLength * dy / size, kLineWidth});
  }
}

// With a real minus sign.
std::string number_text(double x, int decimals) {
  std::string text = fmt::format("{:.{}f}", x, decimals);
  if (text.find_first_not_of("-0.") == std::string::npos) return fmt::format("{:.{}f}", 0.0, decimals);
  return text.front() == '-' ? "−" + text.substr(1) : text;
}

// k·π/n: "−π/2", "3π/4".
std::string pi_text(long k, long n) {
  if (k == 0) return "0";
  const long common = std::gcd(k, n), top = std::labs(k / common), bottom = n / common;
  const std::string text = (k < 0 ? "−" : "") + (top == 1 ? std::string() : std::to_string(top)) + "π";
  return bottom == 1 ? text : text + "/" + std::to_string(bottom);
}

std::vector<Tick> multiples(double lo, double hi, double step, const std::function<std::string(long)>& text) {
  std::vector<Tick> result;
  const double slack = 1e-6 * step;
  for (long k = std::lround(std::ceil((lo - slack) / step)); static_cast<double>(k) * step <= hi + slack; ++k)
    result.push_back({std::clamp(static_cast<double>(k) * step, lo, hi), text(k)});
  return result;
}

}  // namespace

std::pair<double, double> centre(const GridPolygon& p) {
  const auto [left, right] = std::ranges::minmax(p, {}, &GridPoint::x);
  const auto [top, bottom] = std::ranges::minmax(p, {}, &GridPoint::y);
  return {0.5 * (left.x + right.x), 0.5 * (top.y + bottom.y)};
}

void add_frame(Layout& out, double x0, double y0, double x1, double y1, double line) {
  out.lines.insert(out.lines.end(),
                   {{x0, y0, x1, y0, line}, {x1, y0, x1, y1, line}, {x1, y1, x0, y1, line}, {x0, y1, x0, y0, line}});
}

void add_axes(Layout& out, const std::array<Label, 2>& names, const std::array<std::vector<Tick>, 2>& marks,
              const AxesStyle& style) {
  using enum Layout::Anchor;
  const double left = out.frame_x, top = out.frame_y, right = left + out.frame_width, bottom = top + out.frame_height;
  add_frame(out, left, top, right, bottom, style.line);
  for (const Tick& t : marks[0]) {
    const double x = out.x_at(t.at);
    out.lines.push_back({x, bottom, x, bottom + style.tick, style.line});
    out.texts.push_back({x, bottom + style.below, style.numbers, middle, false, {{t.text}}});
  }
  for (const Tick& t : marks[1]) {
    const double y = out.y_at(t.at);
    out.lines.push_back({left - style.tick, y, left, y, style.line});
    out.texts.push_back({left - style.beside, y + style.lower, style.numbers, end, false, {{t.text}}});
  }
  out.texts.push_back({(left + right) / 2, bottom + style.name_below, style.names, middle, false, names[0]});
  out.texts.push_back({style.name_x, (top + bottom) / 2, style.names, middle, true, names[1]});
}

std::array<Interval, 2> common_ranges(std::span<const Picture> pictures) {
  CORANK_CHECK(!pictures.empty());
  return {view(pictures, 0), view(pictures, 1)};
}

Layout lay_out(const Picture& picture, const PortraitOptions& options, const TextWidth& text_width) {
  CORANK_CHECK(picture.axes.size() == 2 && (options.ranges || !is_empty(picture)));
  const auto [x, y] = options.ranges ? *options.ranges : common_ranges({&picture, 1});
  const double ratio = proportion(picture, x, y);
  Layout out;
  out.width = options.width_mm * kPointsPerMm;
  out.x_range = x, out.y_range = y;
  out.outline = options.outline, out.mark = options.mark;
  const auto tick_count = [](double length, double spacing) { return std::clamp(static_cast<int>(length / spacing), 2, 9); };
  // The frame's width depends on that of the numbers beside it, which depend on its height: a guess settles it.
  const std::vector<Tick> y_ticks = ticks(y.lo(), y.hi(), picture.axes[1].angle, tick_count((out.width - 40) * ratio, 28));
  const double y_tick_width = widest(y_ticks, text_width);
  out.frame_x = kEdge + kNameSize + 4 + y_tick_width + 2 + kTickLength;
  const std::vector<Tick> x_ticks = ticks(x.lo(), x.hi(), picture.axes[0].angle, tick_count(out.width - out.frame_x, 36));
  const double overhang = x_ticks.empty() ? 0 : 0.5 * text_width({{x_ticks.back().text}}, kTickSize);
  const double room = std::max(20.0, out.width - out.frame_x - std::max(kEdge, overhang));
  out.cell = std::max(kCell, room / kMostCells);
  const int columns = static_cast<int>(room / out.cell), rows = std::max(1, static_cast<int>(std::lround(columns * ratio)));
  out.frame_width = columns * out.cell, out.frame_height = rows * out.cell;
  out.frame_y = kEdge;
  if (!options.title.empty()) {
    out.frame_y += kTitleSize + 3;
    out.texts.push_back({out.frame_x, out.frame_y - 3, kTitleSize, Layout::Anchor::start, false, {{options.title}}});
  }
  if (options.legend) out.frame_y = add_legend(picture, text_width, out.frame_x, out.width - kEdge, out.frame_y, out);
  if (options.title.empty() && !options.legend) out.frame_y += 0.5 * kTickSize;
  add_axes(out, {axis_label(picture.axes[0]), axis_label(picture.axes[1])}, {x_ticks, y_ticks},
           {.line = kLineWidth,
            .numbers = kTickSize,
            .names = kNameSize,
            .below = kTickLength + kTickSize,
            .name_below = kTickLength + kTickSize + kGap + kNameSize,
            .name_x = out.frame_x - kTickLength - 2 - y_tick_width - 4,
            .tick = kTickLength,
            .beside = kTickLength + 2,
            .lower = 0.36 * kTickSize});
  out.height = out.frame_y + out.frame_height + kTickLength + kTickSize + kGap + kNameSize + 4;
  add_hatches(picture, out);
  const Scale across{x.lo(), columns / x.width(), columns}, up{y.lo(), rows / y.width(), rows};
  for (const PictureLayer& layer : picture.layers) out.shapes.push_back(shape(layer, across, up, out.mark / out.cell));
  return out;
}

Layout lay_out_legend(const Picture& picture, double width, const TextWidth& text_width) {
  Layout out;
  out.width = width;
  out.height = add_legend(picture, text_width, kEdge, width - kEdge, 0, out);
  return out;
}

Label math_label(const std::string& name) {
  const symbolic::DisplayName shown = symbolic::display_name(name);
  const bool greek = !name.starts_with(shown.base);
  const bool letter = shown.base.size() == 1 && std::isalpha(static_cast<unsigned char>(shown.base[0])) != 0;
  const auto is_plain = [](unsigned char c) { return std::isalnum(c) != 0; };
  if (!(greek || letter) || shown.subscript.size() > 6 || !std::ranges::all_of(shown.subscript, is_plain)) return {{name}};
  Label label{{shown.base, true, false}};
  if (!shown.subscript.empty()) label.push_back({shown.subscript, false, true});
  return label;
}

Label axis_label(const PictureAxis& axis) {
  Label label = math_label(axis.name);
  if (!axis.function.empty()) label.insert(label.begin(), {axis.function + " "});
  if (axis.angle) label.push_back({" (rad)"});
  return label;
}

std::vector<Tick> ticks(double lo, double hi, bool angle, int count) {
  const double rough = (hi - lo) / std::max(1, count);
  if (angle && hi - lo > 2) {  // multiples of π/4, π/2, π, 2π …
    long numerator = 1, denominator = 4;
    while (std::numbers::pi * static_cast<double>(numerator) / static_cast<double>(denominator) < 0.8 * rough)
      denominator > 1 ? denominator /= 2 : numerator *= 2;
    return multiples(lo, hi, std::numbers::pi * static_cast<double>(numerator) / static_cast<double>(denominator),
                     [=](long k) { return pi_text(k * numerator, denominator); });
  }
  const double power = std::pow(10, std::floor(std::log10(rough)));
  const double digit = rough / power < 1.5 ? 1 : rough / power < 3.5 ? 2 : rough / power < 7.5 ? 5 : 10;
  const double step = digit * power;
  const int decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9)));
  if (decimals <= 6 && std::max(std::fabs(lo), std::fabs(hi)) < 1e6)
    return multiples(lo, hi, step, [=](long k) { return number_text(static_cast<double>(k) * step, decimals); });
  return multiples(lo, hi, step, [=](long k) { return fmt::format("{:.6g}", static_cast<double>(k) * step); });
}

}  // namespace corank::report
