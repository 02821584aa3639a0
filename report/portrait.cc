#include "corank/report/portrait.h"

#include <cairo-pdf.h>
#include <cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>

#include "corank/report/drawing_file.h"
#include "corank/report/layout_svg.h"
#include "corank/result/result_file.h"

namespace corank::report {
namespace {

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using Context = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;

void check(cairo_status_t status, const std::string& what) {
  if (status != CAIRO_STATUS_SUCCESS) throw result::ResultFileError(what + ": " + cairo_status_to_string(status));
}

cairo_status_t append(void* text, const unsigned char* data, unsigned int size) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(data), size);
  return CAIRO_STATUS_SUCCESS;
}

void set_font(cairo_t* c, const TextRun& run, double size) {
  cairo_select_font_face(c, "Helvetica", run.italic ? CAIRO_FONT_SLANT_ITALIC : CAIRO_FONT_SLANT_NORMAL,
                         CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(c, run.subscript ? kSubscriptSize * size : size);
}

double text_width(cairo_t* c, const Label& label, double size) {
  double width = 0;
  for (const TextRun& run : label) {
    set_font(c, run, size);
    cairo_text_extents_t extents;
    cairo_text_extents(c, run.text.c_str(), &extents);
    width += extents.x_advance;
  }
  return width;
}

void draw(cairo_t* c, const Layout::Text& text) {
  const double width = text.anchor == Layout::Anchor::start ? 0 : text_width(c, text.label, text.size);
  cairo_save(c);
  cairo_translate(c, text.x, text.y);
  if (text.upward) cairo_rotate(c, -std::numbers::pi / 2);
  double x = text.anchor == Layout::Anchor::middle ? -width / 2 : -width;
  for (const TextRun& run : text.label) {
    set_font(c, run, text.size);
    cairo_move_to(c, x, run.subscript ? kSubscriptDrop * text.size : 0);
    cairo_show_text(c, run.text.c_str());
    x += text_width(c, {run}, text.size);
  }
  cairo_restore(c);
}

// Where outline and marks overlap the filling, a translucent shape is put together first.
void draw(cairo_t* c, const Layout& drawing, const Layout::Shape& shape) {
  const bool overlaps = shape.opacity < 1 && (drawing.outline > 0 || !shape.marked.empty());
  if (overlaps) cairo_push_group(c);
  cairo_save(c);
  cairo_translate(c, drawing.frame_x, drawing.frame_y);
  cairo_scale(c, drawing.cell, drawing.cell);
  cairo_set_source_rgba(c, shape.color.red, shape.color.green, shape.color.blue, overlaps ? 1 : shape.opacity);
  for (const GridPolygon& p : shape.polygons) {
    cairo_new_sub_path(c);
    for (const GridPoint& at : p) cairo_line_to(c, at.x, at.y);
    cairo_close_path(c);
  }
  cairo_fill_preserve(c);
  cairo_set_line_width(c, drawing.outline / drawing.cell);
  if (drawing.outline > 0) cairo_stroke_preserve(c);
  cairo_new_path(c);
  for (const GridPolygon& p : shape.marked) {
    const auto [x, y] = centre(p);
    cairo_new_sub_path(c);
    cairo_arc(c, x, y, drawing.mark / drawing.cell, 0, 2 * std::numbers::pi);
  }
  cairo_fill(c);
  cairo_restore(c);
  if (!overlaps) return;
  cairo_pop_group_to_source(c);
  cairo_paint_with_alpha(c, shape.opacity);
}

void draw(cairo_t* c, const Layout& drawing) {
  cairo_set_fill_rule(c, CAIRO_FILL_RULE_EVEN_ODD);
  for (const Layout::Shape& shape : drawing.shapes) draw(c, drawing, shape);
  for (const Layout::Swatch& s : drawing.swatches) {
    cairo_set_source_rgba(c, s.color.red, s.color.green, s.color.blue, s.opacity);
    cairo_rectangle(c, s.x, s.y, s.width, s.height);
    cairo_fill(c);
  }
  cairo_set_source_rgb(c, 0, 0, 0);
  cairo_set_line_cap(c, CAIRO_LINE_CAP_SQUARE);
  for (const Layout::Line& l : drawing.lines) {
    cairo_set_line_width(c, l.width);
    cairo_move_to(c, l.x0, l.y0);
    cairo_line_to(c, l.x1, l.y1);
    cairo_stroke(c);
  }
  for (const Layout::Text& text : drawing.texts) draw(c, text);
}

// Calls `use` with the font's own widths, whatever the resolution.
template <typename Use>
Layout measured(const Use& use) {
  const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1), cairo_surface_destroy);
  const Context c(cairo_create(surface.get()), cairo_destroy);
  cairo_font_options_t* const exact = cairo_font_options_create();
  cairo_font_options_set_hint_metrics(exact, CAIRO_HINT_METRICS_OFF);
  cairo_set_font_options(c.get(), exact);
  cairo_font_options_destroy(exact);
  return use([&](const Label& label, double size) { return text_width(c.get(), label, size); });
}

Layout laid_out(const Picture& picture, const PortraitOptions& options) {
  return measured([&](const TextWidth& text_width) { return lay_out(picture, options, text_width); });
}

std::string to_pdf(const Layout& drawing, const std::string& title, const std::string& path) {
  std::string bytes;
  const Surface surface(cairo_pdf_surface_create_for_stream(append, &bytes, drawing.width, drawing.height),
                        cairo_surface_destroy);
  if (!title.empty()) cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_TITLE, title.c_str());
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATOR, ("corank " + result::version()).c_str());
  {
    const Context c(cairo_create(surface.get()), cairo_destroy);
    draw(c.get(), drawing);
    check(cairo_status(c.get()), path);
  }
  cairo_surface_finish(surface.get());
  check(cairo_surface_status(surface.get()), path);
  return bytes;
}

std::string to_png(const Layout& drawing, double dots_per_inch, const std::string& path) {
  const double scale = dots_per_inch / 72;
  const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(std::ceil(drawing.width * scale)),
                                                   static_cast<int>(std::ceil(drawing.height * scale))),
                        cairo_surface_destroy);
  const Context c(cairo_create(surface.get()), cairo_destroy);
  cairo_set_source_rgb(c.get(), 1, 1, 1);
  cairo_paint(c.get());
  cairo_scale(c.get(), scale, scale);
  draw(c.get(), drawing);
  check(cairo_status(c.get()), path);
  std::string bytes;
  check(cairo_surface_write_to_png_stream(surface.get(), append, &bytes), path);
  return bytes;
}

}  // namespace

bool is_portrait_format(const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  return extension == ".svg" || extension == ".pdf" || extension == ".png";
}

void write_drawing(const std::filesystem::path& path, const Layout& drawing, const std::string& title,
                   double dots_per_inch) {
  if (!is_portrait_format(path))
    throw std::invalid_argument(path.string() + ": the picture has an unknown format; expected .svg, .pdf or .png");
  const std::string extension = path.extension().string();
  result::write_text(path, extension == ".svg"   ? to_svg(drawing, title)
                           : extension == ".pdf" ? to_pdf(drawing, title, path.string())
                                                 : to_png(drawing, dots_per_inch, path.string()));
}

double drawn_width(const Label& label, double size) {
  double width = 0;
  measured([&](const TextWidth& text_width) {
    width = text_width(label, size);
    return Layout{};
  });
  return width;
}

void write_portrait(const std::filesystem::path& path, const Picture& picture, const PortraitOptions& options) {
  if (!is_portrait_format(path))
    throw std::invalid_argument(path.string() + ": the picture has an unknown format; expected .svg, .pdf or .png");
  if (picture.axes.size() != 2) throw std::invalid_argument(path.string() + ": a flat picture; expected two axes");
  if (!(options.width_mm >= 20 && options.width_mm <= 1000) ||
      !(options.dots_per_inch >= 10 && options.dots_per_inch <= 2400))
    throw std::invalid_argument(path.string() + ": expected a width from 20 to 1000 mm and 10 to 2400 dots per inch");
  if (!options.ranges && is_empty(picture)) throw std::invalid_argument(path.string() + ": there are no boxes to draw");
  write_drawing(path, laid_out(picture, options), options.title, options.dots_per_inch);
}

std::vector<std::string> write_small_multiples(const std::filesystem::path& folder, const std::vector<Picture>& pictures,
                                               const std::vector<std::string>& titles) {
  constexpr std::size_t kColumns = 4;
  if (std::all_of(pictures.begin(), pictures.end(), is_empty)) return {};
  PortraitOptions options;
  options.ranges = common_ranges(pictures);
  std::vector<std::string> files;
  std::vector<PlacedDrawing> all;
  for (std::size_t k = 0; k < pictures.size(); ++k) {
    options.title = titles.at(k);
    options.legend = true;
    options.width_mm = 85;
    files.push_back("member-" + std::to_string(k + 1) + ".svg");
    write_portrait(folder / files.back(), pictures[k], options);
    options.legend = false;
    options.width_mm = 45;
    Layout drawing = laid_out(pictures[k], options);
    all.push_back({drawing.width * static_cast<double>(k % kColumns), drawing.height * static_cast<double>(k / kColumns),
                   std::move(drawing)});
  }
  const Layout& last = all.back().drawing;
  const double width = last.width * static_cast<double>(std::min(kColumns, all.size())), below = all.back().y + last.height;
  all.push_back({0, below, measured([&](const TextWidth& text_width) {
                   return lay_out_legend(pictures.front(), width, text_width);
                 })});
  files.push_back("family.svg");
  result::write_text(folder / files.back(), to_svg(all, "small multiples"));
  return files;
}

}  // namespace corank::report
