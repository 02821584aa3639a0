#include "corank/report/gcl.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "corank/certify/check.h"

namespace corank::report {
namespace {

using Range = std::array<double, 2>;
using Cuboid = std::array<Range, 3>;
using Verdict = certify::Verdict;

Cuboid cuboid(const certify::Box& box, const GclOptions& options) {
  Cuboid out{};
  for (std::size_t k = 0; k < options.axes.size(); ++k) {
    const certify::Interval& x = box.at(static_cast<std::size_t>(options.axes[k]));
    const double half = options.size / 2;
    out[k] = options.size > 0 ? Range{x.mid() - half, x.mid() + half} : Range{x.lo(), x.hi()};
  }
  return out;
}

// One mesh for many boxes. A box is 8 corners and 6 faces; in the plane 4 corners and 1 face.
std::string mesh(const std::vector<Cuboid>& cuboids, bool flat) {
  static constexpr std::array<std::array<int, 3>, 8> kCorners{
      {{0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}, {0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}}};
  static constexpr std::array<std::array<int, 4>, 6> kFaces{
      {{3, 2, 1, 0}, {4, 5, 6, 7}, {0, 1, 5, 4}, {2, 3, 7, 6}, {3, 0, 4, 7}, {1, 2, 6, 5}}};
  const std::size_t corners = flat ? 4 : 8, faces = flat ? 1 : 6;
  std::string out = fmt::format("OFF {} {} 1\n", corners * cuboids.size(), faces * cuboids.size());
  for (const Cuboid& c : cuboids) {
    for (std::size_t i = 0; i < corners; ++i) {
      const auto at = [&](std::size_t k) { return c[k][static_cast<std::size_t>(kCorners[i][k])]; };
      fmt::format_to(std::back_inserter(out), "{:.9g} {:.9g} {:.9g}\n", at(0), at(1), at(2));
    }
  }
  for (std::size_t b = 0; b < cuboids.size(); ++b) {
    for (std::size_t f = 0; f < faces; ++f) {
      const auto at = [&](std::size_t k) { return corners * b + static_cast<std::size_t>(kFaces[f][k]); };
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
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == '{' || c == '}') c = '_';
  }
  return text;
}

std::string identifier(std::string text) {
  for (char& c : text) {
    const bool good = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    if (!good) c = '_';
  }
  return text.empty() ? "boxes" : text;
}

}  // namespace

Color verdict_color(std::optional<Verdict> verdict) {
  if (!verdict) return {0, 0, 1};
  switch (*verdict) {
    case Verdict::regular: return {0, 0, 1};
    case Verdict::isolated: return {0, 0.6, 0};
    case Verdict::exact: return {0, 0.4, 0.4};
    case Verdict::boundary: return {0.55, 0, 0.75};
    case Verdict::undecided: return {1, 0, 0};
    case Verdict::partial: return {1, 0.55, 0};
    case Verdict::pending: return {0.6, 0.6, 0.6};
  }
  return {0, 0, 0};
}

std::string to_gcl(const SolFile& boxes, const GclOptions& options) {
  CORANK_CHECK(options.axes.size() == 2 || options.axes.size() == 3);
  if (boxes.boxes.empty()) throw ResultFileError("there are no boxes to draw; expected at least one");
  const bool flat = options.axes.size() == 2;
  std::map<std::optional<Verdict>, std::vector<Cuboid>> groups;
  for (const SolBox& box : boxes.boxes) {
    groups[options.color_by_verdict ? box.verdict : std::nullopt].push_back(cuboid(box.box, options));
  }
  const std::string name = identifier(options.name);
  std::string out =
      fmt::format("# Boxes in {} coordinates, for Geomview\n# {}\n", options.axes.size(), plain(options.comment));
  out += "(progn (normalization World all)\n(bbox-draw World no)\n(backcolor World 1.0 1.0 1.0))\n";
  out += fmt::format("(geometry {} {{ LIST\n", name);
  for (const auto& [verdict, cuboids] : groups) {
    if (options.color_by_verdict)
      out += fmt::format("# {}: {}\n", verdict ? to_string(*verdict) : "no verdict", cuboids.size());
    out += fmt::format("{{ {}\n{}}}\n", appearance(verdict_color(verdict), flat), mesh(cuboids, flat));
  }
  return out + "})\n";
}

}  // namespace corank::report
