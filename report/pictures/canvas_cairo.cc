#include <cairo-pdf.h>
#include <cairo.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "corank/report/pictures/layout.h"
#include "corank/report/pictures/portrait.h"

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

double width_of(cairo_t* c, const Label& label, double size) {
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
  const double width = text.anchor == Layout::Anchor::start ? 0 : width_of(c, text.label, text.size);
  cairo_save(c);
  cairo_translate(c, text.x, text.y);
  if (text.upward) cairo_rotate(c, -std::numbers::pi / 2);
  double x = text.anchor == Layout::Anchor::middle ? -width / 2 : -width;
  for (const TextRun& run : text.label) {
    set_font(c, run, text.size);
    cairo_move_to(c, x, run.subscript ? kSubscriptDrop * text.size : 0);
    cairo_show_text(c, run.text.c_str());
    x += width_of(c, {run}, text.size);
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

}  // namespace

bool can_write_pdf() { return true; }

TextWidth font_widths() {
  const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1), cairo_surface_destroy);
  const std::shared_ptr<cairo_t> c(cairo_create(surface.get()), cairo_destroy);
  cairo_font_options_t* const exact = cairo_font_options_create();
  cairo_font_options_set_hint_metrics(exact, CAIRO_HINT_METRICS_OFF);
  cairo_set_font_options(c.get(), exact);
  cairo_font_options_destroy(exact);
  return [c](const Label& label, double size) { return width_of(c.get(), label, size); };
}

std::string to_pdf(const Layout& drawing, const std::string& title, const std::string& name) {
  std::string bytes;
  const Surface surface(cairo_pdf_surface_create_for_stream(append, &bytes, drawing.width, drawing.height),
                        cairo_surface_destroy);
  if (!title.empty()) cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_TITLE, title.c_str());
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATOR, ("corank " + result::version()).c_str());
  {
    const Context c(cairo_create(surface.get()), cairo_destroy);
    draw(c.get(), drawing);
    check(cairo_status(c.get()), name);
  }
  cairo_surface_finish(surface.get());
  check(cairo_surface_status(surface.get()), name);
  return bytes;
}

std::string to_png(const Layout& drawing, double dots_per_inch, const std::string& name) {
  const double scale = dots_per_inch / 72;
  const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(std::ceil(drawing.width * scale)),
                                                   static_cast<int>(std::ceil(drawing.height * scale))),
                        cairo_surface_destroy);
  const Context c(cairo_create(surface.get()), cairo_destroy);
  cairo_set_source_rgb(c.get(), 1, 1, 1);
  cairo_paint(c.get());
  cairo_scale(c.get(), scale, scale);
  draw(c.get(), drawing);
  check(cairo_status(c.get()), name);
  std::string bytes;
  check(cairo_surface_write_to_png_stream(surface.get(), append, &bytes), name);
  return bytes;
}

}  // namespace corank::report
