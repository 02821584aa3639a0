#include "corank/report/pictures/layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <pugixml.hpp>
#include <sstream>

namespace corank::report {
namespace {

const char* const kFont = "Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif";

std::string color_text(const Color& c) {
  const auto byte = [](double x) { return static_cast<int>(std::lround(255 * x)); };
  return fmt::format("#{:02x}{:02x}{:02x}", byte(c.red), byte(c.green), byte(c.blue));
}

std::string number(double x) { return fmt::format("{:.6g}", std::round(x * 1000) / 1000 + 0.0); }

pugi::xml_node append(pugi::xml_node parent, const char* name,
                      std::initializer_list<std::pair<const char*, std::string>> attributes) {
  pugi::xml_node node = parent.append_child(name);
  for (const auto& [key, value] : attributes) node.append_attribute(key).set_value(value.c_str());
  return node;
}

// "m10 20h3v4h-3z": horizontal and vertical steps from corner to corner.
std::string path_data(const std::vector<GridPolygon>& polygons) {
  std::string data;
  const auto out = std::back_inserter(data);
  for (const GridPolygon& p : polygons) {
    fmt::format_to(out, "M{} {}", p[0].x, p[0].y);
    for (std::size_t k = 1; k < p.size(); ++k)
      k % 2 == 1 ? fmt::format_to(out, "h{}", p[k].x - p[k - 1].x) : fmt::format_to(out, "v{}", p[k].y - p[k - 1].y);
    data += 'z';
  }
  return data;
}

void add_shape(pugi::xml_node parent, const Layout& drawing, const Layout::Shape& shape) {
  const std::string color = color_text(shape.color);
  pugi::xml_node group = append(parent, "g", {{"class", "layer"}, {"fill", color}});
  if (!shape.set.empty()) group.append_attribute("data-set").set_value(shape.set.c_str());
  if (shape.opacity < 1) group.append_attribute("opacity").set_value(number(shape.opacity).c_str());
  group.append_child("title").text().set(shape.label.c_str());
  pugi::xml_node path = append(group, "path", {{"fill-rule", "evenodd"}, {"d", path_data(shape.polygons)}});
  if (drawing.outline > 0) {
    path.append_attribute("stroke").set_value(color.c_str());
    path.append_attribute("stroke-width").set_value(number(drawing.outline / drawing.cell).c_str());
  }
  for (const GridPolygon& p : shape.marked) {
    const auto [x, y] = centre(p);
    append(group, "circle", {{"cx", number(x)}, {"cy", number(y)}, {"r", number(drawing.mark / drawing.cell)}});
  }
}

void add_text(pugi::xml_node parent, const Layout::Text& text) {
  pugi::xml_node node = append(parent, "text", {{"font-size", number(text.size)}});
  if (text.upward) {
    node.append_attribute("transform")
        .set_value(fmt::format("translate({} {}) rotate(-90)", number(text.x), number(text.y)).c_str());
  } else {
    node.append_attribute("x").set_value(number(text.x).c_str());
    node.append_attribute("y").set_value(number(text.y).c_str());
  }
  if (text.anchor != Layout::Anchor::start)
    node.append_attribute("text-anchor").set_value(text.anchor == Layout::Anchor::middle ? "middle" : "end");
  bool lowered = false;
  for (const TextRun& run : text.label) {
    if (!run.italic && !run.subscript && !lowered) {
      node.append_child(pugi::node_pcdata).set_value(run.text.c_str());
      continue;
    }
    pugi::xml_node span = node.append_child("tspan");
    if (run.italic) span.append_attribute("font-style").set_value("italic");
    if (run.subscript) span.append_attribute("font-size").set_value(number(kSubscriptSize * text.size).c_str());
    if (run.subscript != lowered)
      span.append_attribute("dy").set_value(number((run.subscript ? 1 : -1) * kSubscriptDrop * text.size).c_str());
    lowered = run.subscript;
    span.text().set(run.text.c_str());
  }
}

void add_plot(pugi::xml_node svg, const Layout& drawing) {
  // A script that knows the ranges can tell coordinates.
  pugi::xml_node plot = append(svg, "g",
                               {{"class", "plot"},
                                {"transform", fmt::format("translate({} {}) scale({:.9g})", number(drawing.frame_x),
                                                          number(drawing.frame_y), drawing.cell)},
                                {"data-width", fmt::format("{:.0f}", drawing.frame_width / drawing.cell)},
                                {"data-height", fmt::format("{:.0f}", drawing.frame_height / drawing.cell)},
                                {"data-x", fmt::format("{} {}", drawing.x_range.lo(), drawing.x_range.hi())},
                                {"data-y", fmt::format("{} {}", drawing.y_range.lo(), drawing.y_range.hi())}});
  for (const Layout::Shape& shape : drawing.shapes)
    if (!shape.polygons.empty()) add_shape(plot, drawing, shape);
}

void add_drawing(pugi::xml_node svg, const Layout& drawing) {
  if (drawing.cell > 0) add_plot(svg, drawing);  // else a legend alone
  for (const Layout::Swatch& s : drawing.swatches)
    append(svg, "rect",
           {{"class", "swatch"},
            {"x", number(s.x)},
            {"y", number(s.y)},
            {"width", number(s.width)},
            {"height", number(s.height)},
            {"fill", color_text(s.color)},
            {"fill-opacity", number(s.opacity)}});
  std::string lines;
  for (const Layout::Line& l : drawing.lines)
    lines += fmt::format("M{} {}L{} {}", number(l.x0), number(l.y0), number(l.x1), number(l.y1));
  if (!lines.empty())
    append(svg, "path",
           {{"d", lines},
            {"stroke", "black"},
            {"fill", "none"},
            {"stroke-linecap", "square"},
            {"stroke-width", number(drawing.lines[0].width)}});
  for (const Layout::Text& text : drawing.texts) add_text(svg, text);
}

pugi::xml_node add_page(pugi::xml_document& document, double page_width, double page_height, const std::string& title) {
  const std::string width = number(page_width), height = number(page_height);
  pugi::xml_node svg = append(document, "svg",
                              {{"xmlns", "http://www.w3.org/2000/svg"},
                               {"width", width + "pt"},
                               {"height", height + "pt"},
                               {"viewBox", "0 0 " + width + " " + height},
                               {"font-family", kFont},
                               {"xml:space", "preserve"}});
  if (!title.empty()) svg.append_child("title").text().set(title.c_str());
  append(svg, "rect", {{"width", width}, {"height", height}, {"fill", "white"}});
  return svg;
}

std::string text_of(const pugi::xml_document& document) {
  std::ostringstream out;
  document.save(out, "", pugi::format_raw | pugi::format_no_declaration);
  return out.str() + "\n";
}

}  // namespace

std::string to_svg(const Layout& drawing, const std::string& title) {
  pugi::xml_document document;
  add_drawing(add_page(document, drawing.width, drawing.height, title), drawing);
  return text_of(document);
}

std::string to_svg(const std::vector<PlacedDrawing>& drawings, const std::string& title) {
  double width = 0, height = 0;
  for (const PlacedDrawing& d : drawings) {
    width = std::max(width, d.x + d.drawing.width);
    height = std::max(height, d.y + d.drawing.height);
  }
  pugi::xml_document document;
  pugi::xml_node svg = add_page(document, width, height, title);
  for (const PlacedDrawing& d : drawings) {
    const std::string place = fmt::format("translate({} {})", number(d.x), number(d.y));
    add_drawing(append(svg, "g", {{"class", "member"}, {"transform", place}}), d.drawing);
  }
  return text_of(document);
}

}  // namespace corank::report
