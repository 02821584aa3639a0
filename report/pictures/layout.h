// A flat picture laid out on a page: shapes, lines and words at their places, the same for every format. Lengths in points
// (1/72 inch) from the upper left corner.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "corank/report/pictures/cell_union.h"
#include "corank/report/pictures/portrait.h"

namespace corank::report {

struct TextRun {
  std::string text;
  bool italic = false, subscript = false;
  friend bool operator==(const TextRun&, const TextRun&) = default;
};
using Label = std::vector<TextRun>;

/// A name as mathematics sets it: theta2 → θ₂, J3x → J with the subscript 3x, phi_a → φ with the subscript a; other names as
/// they are.
Label math_label(const std::string& name);
/// The name of an axis, with its unit where that is known.
Label axis_label(const PictureAxis& axis);

/// A text's width in points at a font size.
using TextWidth = std::function<double(const Label&, double)>;

inline constexpr double kSubscriptSize = 0.72, kSubscriptDrop = 0.22;  ///< in font sizes

/// Of pictures over a plane of two parameters, in points: margins, width, font size and lines.
inline constexpr double kPlaneLeft = 50, kPlaneTop = 26, kPlaneWidth = 300, kPlaneText = 9, kPlaneLine = 0.6;

struct Layout {
  struct Line {
    double x0, y0, x1, y1, width;
  };
  enum class Anchor { start, middle, end };
  struct Text {
    double x, y;  ///< of the base line's start, middle or end
    double size;
    Anchor anchor;
    bool upward;  ///< turned by a quarter to the left
    Label label;
  };
  struct Swatch {
    double x, y, width, height;
    Color color;
    double opacity;
  };
  /// In cells from the frame's upper left corner.
  struct Shape {
    std::string label, set;
    Color color;
    double opacity;
    std::vector<GridPolygon> polygons;  ///< even-odd rule
    std::vector<GridPolygon> marked;    ///< those that need a mark, about the centres of their bounds
  };

  double width = 0, height = 0;
  double frame_x = 0, frame_y = 0, frame_width = 0, frame_height = 0;
  Interval x_range, y_range;     ///< of the coordinates over the frame
  double cell = 0;               ///< edge of a cell
  double outline = 0, mark = 0;  ///< width of the shapes' line, radius of a mark
  std::vector<Shape> shapes;
  std::vector<Swatch> swatches;
  std::vector<Line> lines;
  std::vector<Text> texts;

  double x_at(double x) const { return frame_x + (x - x_range.lo()) / x_range.width() * frame_width; }
  double y_at(double y) const { return frame_y + frame_height - (y - y_range.lo()) / y_range.width() * frame_height; }
};

/// The ranges that the axes have to show for the boxes of these pictures, which have the same two axes and a box among them.
std::array<Interval, 2> common_ranges(std::span<const Picture> pictures);

/// Requires two axes, and a box where the options give no ranges.
Layout lay_out(const Picture& picture, const PortraitOptions& options, const TextWidth& text_width);

/// The legend of a picture alone.
Layout lay_out_legend(const Picture& picture, double width, const TextWidth& text_width);

/// The centre of the bounds.
std::pair<double, double> centre(const GridPolygon& polygon);

/// Numbers at the ticks of an axis over [lo, hi], about `count` of them.
struct Tick {
  double at;
  std::string text;
};
std::vector<Tick> ticks(double lo, double hi, bool angle, int count);

void add_frame(Layout& out, double x0, double y0, double x1, double y1, double line);
struct AxesStyle {
  double line, numbers, names;             ///< a line's width; sizes of the numbers and of the axes' names
  double below, name_below, name_x;        ///< base lines: numbers, a name below the frame; the other name from the left
  double tick = 3, beside = 5, lower = 3;  ///< a tick's length; how far numbers are beside the frame, and below a tick
};
/// The frame, the ticks of both axes with their numbers, and the axes' names.
void add_axes(Layout& out, const std::array<Label, 2>& names, const std::array<std::vector<Tick>, 2>& marks,
              const AxesStyle& style);

/// Any layout as a file: .svg, .pdf or .png, which the name says. Throws std::invalid_argument for another name,
/// ResultFileError where the file cannot be written.
void write_drawing(const std::filesystem::path& path, const Layout& drawing, const std::string& title,
                   double dots_per_inch = 300);

/// Text stays text, a shape is one path of whole numbers.
std::string to_svg(const Layout& drawing, const std::string& title);

/// Several on one page, each with its upper left corner at (x, y).
struct PlacedDrawing {
  double x = 0, y = 0;
  Layout drawing;
};
std::string to_svg(const std::vector<PlacedDrawing>& drawings, const std::string& title);

// What knows a font: widths of texts for every picture, and the formats that are drawn with it. Cairo does that
// (canvas_cairo.cc). Without it (canvas_missing.cc) widths are those of Helvetica, the font that pictures ask for, and .svg
// is the only format; CMake chooses.

/// Widths at any size, whatever the resolution.
TextWidth font_widths();

/// The bytes of the file `name`. Throw ResultFileError where they cannot be made.
std::string to_pdf(const Layout& drawing, const std::string& title, const std::string& name);
std::string to_png(const Layout& drawing, double dots_per_inch, const std::string& name);

}  // namespace corank::report
