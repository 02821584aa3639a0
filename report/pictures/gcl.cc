#include "corank/report/pictures/picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

namespace corank::report {
namespace {

// One mesh for many boxes. A box is 8 corners and 6 faces; in the plane 4 corners and 1 face.
std::string mesh(const std::vector<PictureBox>& boxes, bool flat) {
  static constexpr std::array<std::array<int, 3>, 8> kCorners{
      {{0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}, {0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}}};
  static constexpr std::array<std::array<int, 4>, 6> kFaces{
      {{3, 2, 1, 0}, {4, 5, 6, 7}, {0, 1, 5, 4}, {2, 3, 7, 6}, {3, 0, 4, 7}, {1, 2, 6, 5}}};
  const std::size_t corners = flat ? 4 : 8, faces = flat ? 1 : 6;
  std::string out = fmt::format("OFF {} {} 1\n", corners * boxes.size(), faces * boxes.size());
  for (const PictureBox& box : boxes) {
    for (std::size_t i = 0; i < corners; ++i) {
      const auto at = [&](std::size_t k) { return (kCorners[i][k] == 0 ? box.sides[k].lo() : box.sides[k].hi()) + 0.0; };
      fmt::format_to(std::back_inserter(out), "{:.9g} {:.9g} {:.9g}\n", at(0), at(1), at(2));
    }
  }
  for (std::size_t b = 0; b < boxes.size(); ++b) {
    for (std::size_t f = 0; f < faces; ++f) {
      const auto at = [&](std::size_t k) { return corners * b + kFaces[f][k]; };
      fmt::format_to(std::back_inserter(out), "4 {} {} {} {}\n", at(0), at(1), at(2), at(3));
    }
  }
  return out;
}

// Flat shading by a light where there is depth; the bare colour in the plane.
std::string appearance(const Color& color, bool flat) {
  const std::string rgb = fmt::format("{:.6f} {:.6f} {:.6f}", color.red, color.green, color.blue);
  return fmt::format("appearance {{ +face +edge shading {} material {{ kd 0.75 ambient {} *diffuse {} edgecolor {} }} }}",
                     flat ? "constant" : "flat", rgb, rgb, rgb);
}

// No line end, no brace.
std::string plain(std::string text) {
  std::ranges::replace_if(
      text, [](unsigned char c) { return c < 0x20 || c == '{' || c == '}'; }, '_');
  return text;
}

std::string identifier(std::string text) {
  std::ranges::replace_if(
      text, [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return text.empty() ? "boxes" : text;
}

}  // namespace

std::string to_gcl(const Picture& picture, const std::string& name, const std::string& comment) {
  if (is_empty(picture)) throw result::ResultFileError("there are no boxes to draw; expected at least one");
  const bool flat = picture.axes.size() == 2;
  std::string out = fmt::format("# Boxes in {} coordinates, for Geomview\n# {}\n", picture.axes.size(), plain(comment));
  out += "(progn (normalization World all)\n(bbox-draw World no)\n(backcolor World 1.0 1.0 1.0))\n";
  out += fmt::format("(geometry {} {{ LIST\n", identifier(name));
  for (const PictureLayer& layer : picture.layers) {
    if (layer.boxes.empty()) continue;
    out += fmt::format("# {}: {}\n", plain(layer.label), layer.boxes.size());
    out += fmt::format("{{ {}\n{}}}\n", appearance(layer.color, flat), mesh(layer.boxes, flat));
  }
  return out + "})\n";
}

}  // namespace corank::report
