// Reads pictures back: the shapes of a .svg, the pixels of a .png, and where coordinates are in both.
#pragma once

#include <cairo.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <pugixml.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "corank/report/pictures/portrait.h"

namespace corank::report {

/// A folder for pictures that lives as long as the object.
class PictureFolder {
 public:
  PictureFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "corank-portrait-XXXXXX").string();
    EXPECT_NE(mkdtemp(pattern.data()), nullptr);
    path_ = pattern;
  }
  ~PictureFolder() { std::filesystem::remove_all(path_); }
  PictureFolder(const PictureFolder&) = delete;
  PictureFolder& operator=(const PictureFolder&) = delete;
  std::filesystem::path file(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

inline std::string bytes_of(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

/// The frame of a .svg, in points and in coordinates, and its layers as cells.
struct SvgPortrait {
  double x = 0, y = 0, cell = 0;  ///< of the frame's upper left corner, in points
  int columns = 0, rows = 0;
  double x_lo = 0, x_hi = 0, y_lo = 0, y_hi = 0;
  struct Layer {
    std::string set, title;
    std::vector<bool> cells;  ///< row by row, from above
    int marks = 0;
    std::size_t path_size = 0;
  };
  std::vector<Layer> layers;
  pugi::xml_document document;

  double per_cell() const { return (x_hi - x_lo) / columns; }
  /// Does the layer hold the cell of the point?
  bool holds(std::size_t layer, double px, double py) const {
    const int c = static_cast<int>(std::floor((px - x_lo) / (x_hi - x_lo) * columns));
    const int r = static_cast<int>(std::floor((y_hi - py) / (y_hi - y_lo) * rows));
    return c >= 0 && r >= 0 && c < columns && r < rows &&
           layers[layer]
               .cells[static_cast<std::size_t>(r) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(c)];
  }
};

/// The cells inside the path by the even-odd rule. Its polygons begin with a horizontal edge: the one that closes them is
/// vertical.
inline std::vector<bool> cells_of_path(const std::string& data, int columns, int rows) {
  std::vector<bool> cells(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), false);
  std::istringstream in(data);
  const auto toggle_right_of = [&](int x, int from, int to) {
    for (int r = std::min(from, to); r < std::max(from, to); ++r)
      for (int c = x; c < columns; ++c) {
        auto cell = cells[static_cast<std::size_t>(r) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(c)];
        cell = !cell;
      }
  };
  int x = 0, y = 0, start = 0;
  for (char command = 0; in >> command;) {
    int step = 0;
    if (command == 'M') in >> x >> y, start = y;
    if (command == 'h') in >> step, x += step;
    if (command == 'v') in >> step, toggle_right_of(x, y, y + step), y += step;
    if (command == 'z') toggle_right_of(x, y, start);
  }
  return cells;
}

inline void read_svg(const std::filesystem::path& path, SvgPortrait& out) {
  ASSERT_TRUE(out.document.load_file(path.c_str()));
  const pugi::xml_node svg = out.document.child("svg"), plot = svg.find_child_by_attribute("g", "class", "plot");
  ASSERT_EQ(std::sscanf(plot.attribute("transform").value(), "translate(%lf %lf) scale(%lf)", &out.x, &out.y, &out.cell), 3);
  ASSERT_EQ(std::sscanf(plot.attribute("data-x").value(), "%lf %lf", &out.x_lo, &out.x_hi), 2);
  ASSERT_EQ(std::sscanf(plot.attribute("data-y").value(), "%lf %lf", &out.y_lo, &out.y_hi), 2);
  out.columns = plot.attribute("data-width").as_int();
  out.rows = plot.attribute("data-height").as_int();
  for (const pugi::xml_node layer : plot.children("g")) {
    const std::string data = layer.child("path").attribute("d").value();
    EXPECT_STREQ(layer.child("path").attribute("fill-rule").value(), "evenodd");
    const auto circles = layer.children("circle");
    out.layers.push_back({layer.attribute("data-set").value(), layer.child("title").text().get(),
                          cells_of_path(data, out.columns, out.rows),
                          static_cast<int>(std::distance(circles.begin(), circles.end())), data.size()});
  }
}

struct Pixels {
  int width = 0, height = 0;
  std::vector<std::array<int, 3>> rgb;
  std::array<int, 3> at(int x, int y) const {
    return rgb[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
  }
};

inline Pixels read_png(const std::filesystem::path& path) {
  const std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface(
      cairo_image_surface_create_from_png(path.c_str()), cairo_surface_destroy);
  EXPECT_EQ(cairo_surface_status(surface.get()), CAIRO_STATUS_SUCCESS);
  Pixels out;
  out.width = cairo_image_surface_get_width(surface.get());
  out.height = cairo_image_surface_get_height(surface.get());
  const unsigned char* const data = cairo_image_surface_get_data(surface.get());
  const int stride = cairo_image_surface_get_stride(surface.get());
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x) {
      std::uint32_t pixel;
      std::memcpy(&pixel, data + y * stride + 4 * x, sizeof pixel);
      out.rgb.push_back(
          {static_cast<int>(pixel >> 16 & 255), static_cast<int>(pixel >> 8 & 255), static_cast<int>(pixel & 255)});
    }
  return out;
}

}  // namespace corank::report
