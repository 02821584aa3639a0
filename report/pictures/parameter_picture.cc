#include "corank/report/pictures/parameter_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "corank/report/pictures/layout.h"

namespace corank::report {
namespace {

constexpr int kGrid = 4096;
constexpr double kTitle = 10, kLegendGap = 16, kRow = 15;
constexpr double kSwatch = 9, kDot = 0.5;  // of a cell's side
constexpr double kPoint = 3.2;             // radius of a cusp's or a node's dot
constexpr Color kUnknownColor{0.83, 0.83, 0.83}, kCurve{0.13, 0.13, 0.15}, kMayMeet{0.55, 0.55, 0.57}, kCusp{0.85, 0.1, 0.1},
    kNode{0.0, 0.6, 0.25};

// Light enough for a dark curve beside them, told apart by the colour-blind and, in order, in grey: from pale yellow to
// dark blue for growing numbers.
constexpr std::array<Color, 6> kShades = {Color{0.98, 0.95, 0.76}, {0.98, 0.80, 0.47}, {0.94, 0.58, 0.44},
                                          {0.78, 0.44, 0.62},      {0.50, 0.42, 0.74}, {0.27, 0.38, 0.68}};

class Drawing {
 public:
  explicit Drawing(const ParameterPicture& picture) : in_(picture) {}

  Layout run() {
    out_.frame_x = kPlaneLeft, out_.frame_y = kPlaneTop, out_.frame_width = out_.frame_height = kPlaneWidth;
    out_.x_range = in_.x_range, out_.y_range = in_.y_range;
    out_.cell = kPlaneWidth / kGrid;
    // Shapes that touch are not to show the paper between them.
    out_.outline = 0.1;
    out_.mark = kPoint;
    choose_colors();
    add_regions();
    add_curve();
    add_points("cusps", kCusp, in_.cusps);
    add_points("nodes", kNode, in_.nodes);
    add_dots();
    add_frame();
    out_.width = add_legend() + 8;
    out_.height = kPlaneTop + kPlaneWidth + 34;
    return std::move(out_);
  }

 private:
  double x_share(double x) const { return (x - in_.x_range.lo()) / in_.x_range.width(); }
  double y_share(double y) const { return (in_.y_range.hi() - y) / in_.y_range.width(); }

  void add(CellUnion& cells, const Interval& x, const Interval& y, bool outward) const {
    const auto at = [&](double share, double push) {
      const double place = share * kGrid;
      const double rounded = outward ? (push < 0 ? std::floor(place) : std::ceil(place)) : std::round(place);
      return static_cast<int>(std::clamp(rounded, 0.0, static_cast<double>(kGrid)));
    };
    const int x0 = at(x_share(x.lo()), -1), x1 = at(x_share(x.hi()), 1), y0 = at(y_share(y.hi()), -1),
              y1 = at(y_share(y.lo()), 1);
    if (x1 > x0 && y1 > y0) cells.add(x0, y0, x1, y1);
  }

  void add_shape(const std::string& label, const Color& color, const CellUnion& cells) {
    Layout::Shape shape{label, "", color, 1, cells.outlines(), {}};
    if (!shape.polygons.empty()) out_.shapes.push_back(std::move(shape));
  }

  void choose_colors() {
    for (const auto& c : in_.cells)
      if (c.number) colors_[*c.number] = {};
    std::size_t k = 0;
    const std::size_t all = in_.words.empty() ? colors_.size() : in_.words.size();
    for (auto& [number, color] : colors_) {
      if (!in_.words.empty()) k = number;
      color = all == 1 ? kShades[1] : between(kShades, static_cast<double>(k++) / static_cast<double>(all - 1));
    }
  }

  std::string word(int number) const { return in_.words.empty() ? std::to_string(number) : in_.words.at(number); }

  void add_regions() {
    CellUnion unknown(kGrid, kGrid);
    std::map<int, CellUnion> regions;
    for (const auto& c : in_.cells) {
      if (c.proven && c.number) {
        add(regions.try_emplace(*c.number, kGrid, kGrid).first->second, c.x, c.y, false);
      } else {
        add(unknown, c.x, c.y, false);
        has_unknown_ = true;
      }
    }
    add_shape("not known for whole cells", kUnknownColor, unknown);
    for (const auto& [number, cells] : regions) {
      add_shape(word(number), colors_.at(number), cells);
      proven_.push_back(number);
    }
  }

  void add_curve() {
    CellUnion proven(kGrid, kGrid), others(kGrid, kGrid);
    for (const auto& b : in_.boundary) {
      add(b.proven ? proven : others, b.x, b.y, true);
      (b.proven ? has_curve_ : has_others_) = true;
    }
    add_shape("solutions may meet", kMayMeet, others);
    add_shape("solutions meet", kCurve, proven);
  }

  void add_points(const char* label, const Color& color, const std::vector<ParameterPicture::CurveBox>& points) {
    for (const bool proven : {false, true}) {
      CellUnion cells(kGrid, kGrid);
      for (const auto& p : points)
        if (p.proven == proven) add(cells, p.x, p.y, true);
      Layout::Shape shape{
          proven ? label : std::string("may be ") + label, "", proven ? color : kMayMeet, 1, cells.outlines(), {}};
      shape.marked = shape.polygons;
      if (shape.polygons.empty()) continue;
      points_.emplace_back(shape.label, shape.color);
      out_.shapes.push_back(std::move(shape));
    }
  }

  void add_dots() {
    for (const auto& c : in_.cells) {
      if (c.proven || !c.number) continue;
      const bool covered = std::ranges::any_of(
          in_.boundary, [&](const ParameterPicture::CurveBox& b) { return b.x.overlaps(c.x) && b.y.overlaps(c.y); });
      if (covered) continue;
      const double width = kPlaneWidth * c.x.width() / in_.x_range.width(),
                   height = kPlaneWidth * c.y.width() / in_.y_range.width();
      const double x = out_.x_at(c.x.mid()), y = out_.y_at(c.y.mid());
      out_.swatches.push_back(
          {x - kDot * width / 2, y - kDot * height / 2, kDot * width, kDot * height, colors_.at(*c.number), 1});
      dots_[*c.number] = true;
    }
  }

  void add_frame() {
    add_axes(out_, {math_label(in_.x_name), math_label(in_.y_name)},
             {ticks(in_.x_range.lo(), in_.x_range.hi(), false, 7), ticks(in_.y_range.lo(), in_.y_range.hi(), false, 7)},
             {.line = kPlaneLine, .numbers = kPlaneText, .names = kTitle, .below = 13, .name_below = 27, .name_x = 13});
    out_.texts.push_back({kPlaneLeft, kPlaneTop - 9, kTitle, Layout::Anchor::start, false, {{in_.title + ", " + in_.what}}});
  }

  double add_legend() {
    const TextWidth text_width = font_widths();
    const double x = kPlaneLeft + kPlaneWidth + kLegendGap;
    double y = kPlaneTop, right = x;
    const auto add = [&](const Color& color, const std::string& words, double size) {
      const double room = (1 - size) / 2 * kSwatch;
      if (size < 1) out_.swatches.push_back({x, y, kSwatch, kSwatch, kUnknownColor, 1});
      out_.swatches.push_back({x + room, y + room, size * kSwatch, size * kSwatch, color, 1});
      out_.texts.push_back({x + kSwatch + 6, y + kSwatch - 1, kPlaneText, Layout::Anchor::start, false, {{words}}});
      right = std::max(right, x + kSwatch + 6 + text_width({{words}}, kPlaneText));
      y += kRow;
    };
    // From the largest down, as they lie in most pictures.
    for (auto k = proven_.rbegin(); k != proven_.rend(); ++k) add(colors_.at(*k), word(*k), 1);
    for (auto k = dots_.rbegin(); k != dots_.rend(); ++k)
      add(colors_.at(k->first), fmt::format("{}, at the cell’s centre", k->first), kDot);
    if (has_unknown_) add(kUnknownColor, in_.words.empty() ? "not known for the whole cell" : "open", 1);
    if (has_curve_) add(kCurve, "solutions meet", 1);
    if (has_others_) add(kMayMeet, "solutions may meet", 1);
    for (const auto& [label, color] : points_) add(color, label, kDot);
    return right;
  }

  const ParameterPicture& in_;
  Layout out_;
  std::map<int, Color> colors_;
  std::vector<int> proven_;
  std::map<int, bool> dots_;
  std::vector<std::pair<std::string, Color>> points_;  // for the legend
  bool has_unknown_ = false, has_curve_ = false, has_others_ = false;
};

}  // namespace

void write_picture(const std::filesystem::path& path, const ParameterPicture& picture) {
  write_drawing(path, Drawing(picture).run(), picture.title + ", " + picture.what);
}

}  // namespace corank::report
