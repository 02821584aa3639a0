// Flat pictures, read back: their structure, and that what is drawn is the union of the boxes.
#include "corank/report/pictures/portrait.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

#include "corank/report/pictures/layout.h"
#include "corank/tests/report/portrait_reader.h"

namespace corank::report {
namespace {
using ::testing::HasSubstr;

PictureSource boxes_about_a_circle(const std::string& set, double radius, int count, double half) {
  PictureSource source{set + ".h5", set, {}, {}, 2};
  source.boxes.variables = {"J3x", "J3y"};
  for (int k = 0; k < count; ++k) {
    const double t = 2 * M_PI * k / count, x = radius * std::cos(t), y = radius * std::sin(t);
    source.boxes.boxes.push_back({{{x - half, x + half}, {y - half, y + half / 3}}, Verdict::regular, {}});
  }
  return source;
}

// Boxes of all sizes, some thin, some points, some apart.
PictureSource random_boxes(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-1, 1), exponent(-14, -0.5);
  PictureSource source{"random.h5", "inverse", {}, {}, 2};
  source.boxes.variables = {"x", "y"};
  for (int k = 0; k < 150; ++k) {
    const double x = place(random), y = place(random), w = std::pow(10, exponent(random)),
                 h = std::pow(10, exponent(random));
    source.boxes.boxes.push_back({{{x, x + w}, {y, y + h}}, Verdict::regular, {}});
  }
  return source;
}

Picture picture(const std::vector<PictureSource>& sources, std::vector<std::string> axes = {"1", "2"}) {
  return make_picture(sources, {std::move(axes), ColorScheme::set, 0});
}

// Without the line and the marks that make thin boxes visible.
PortraitOptions bare(double width_mm = 85) {
  PortraitOptions options;
  options.width_mm = width_mm;
  options.outline = options.mark = 0;
  return options;
}

TEST(Svg, HasALayerForEachSetTicksNamesAndALegend) {
  const PictureFolder folder;
  PortraitOptions options;
  options.title = "Two circles & a <title>";
  const PictureSource none{"none.h5", "cspace-singular", {{"J3x", "J3y"}, {}}, {}, 2};
  write_portrait(folder.file("a.svg"),
                 picture({boxes_about_a_circle("forward", 1, 100, 0.02), boxes_about_a_circle("cspace", 2, 100, 0.3), none}),
                 options);
  SvgPortrait svg;
  read_svg(folder.file("a.svg"), svg);
  ASSERT_EQ(svg.layers.size(), 2u);
  EXPECT_EQ(svg.layers[0].set, "cspace");
  EXPECT_EQ(svg.layers[1].title, "forward locus");
  const pugi::xml_node root = svg.document.child("svg");
  EXPECT_STREQ(root.child("title").text().get(), "Two circles & a <title>");
  std::vector<std::string> texts;
  for (const pugi::xml_node text : root.children("text")) {
    std::string all;
    for (const pugi::xml_node part : text) all += part.type() == pugi::node_pcdata ? part.value() : part.text().get();
    texts.push_back(all);
  }
  EXPECT_THAT(texts, testing::IsSupersetOf({"Two circles & a <title>", "C-space", "forward locus",
                                            "C-space singularities (none)", "J3x", "J3y", "−1", "0", "1"}));
  EXPECT_EQ(std::count(texts.begin(), texts.end(), "C-space"), 1);
  const auto swatches = root.find_child_by_attribute("rect", "class", "swatch");
  EXPECT_STREQ(swatches.attribute("fill").value(), "#8c8f94");
  EXPECT_NEAR(root.attribute("width").as_double(), 85 * 72 / 25.4, 0.01);
  options.legend = false;
  write_portrait(folder.file("b.svg"), picture({boxes_about_a_circle("forward", 1, 100, 0.02)}), options);
  EXPECT_THAT(bytes_of(folder.file("b.svg")), testing::Not(HasSubstr("swatch")));
}

TEST(Svg, DrawsTheUnionOfTheBoxesRoundedOutwardByLessThanACell) {
  const PictureFolder folder;
  for (const unsigned seed : {1u, 2u, 3u}) {
    const PictureSource source = random_boxes(seed);
    write_portrait(folder.file("a.svg"), picture({source}), bare(30));
    SvgPortrait svg;
    read_svg(folder.file("a.svg"), svg);
    ASSERT_EQ(svg.layers.size(), 1u);
    const double unit_x = (svg.x_hi - svg.x_lo) / svg.columns, unit_y = (svg.y_hi - svg.y_lo) / svg.rows;
    std::vector<bool> must(svg.layers[0].cells.size()), may(must);
    for (const result::SolBox& b : source.boxes.boxes) {
      const double left = (b.box[0].lo() - svg.x_lo) / unit_x, right = (b.box[0].hi() - svg.x_lo) / unit_x;
      const double top = (svg.y_hi - b.box[1].hi()) / unit_y, bottom = (svg.y_hi - b.box[1].lo()) / unit_y;
      for (int r = 0; r < svg.rows; ++r)
        for (int c = std::max(0, static_cast<int>(left) - 2); c <= right + 2 && c < svg.columns; ++c) {
          constexpr double kRounding = 1e-6;
          const std::size_t k =
              static_cast<std::size_t>(r) * static_cast<std::size_t>(svg.columns) + static_cast<std::size_t>(c);
          const auto overlap = [](double lo, double hi, double from, double to) {
            return std::min(hi, to) - std::max(lo, from);
          };
          const double across = overlap(left, right, c, c + 1), down = overlap(top, bottom, r, r + 1);
          must[k] = must[k] || (across > kRounding && down > kRounding);
          may[k] = may[k] || (across >= -kRounding && down >= -kRounding);
        }
    }
    std::size_t missing = 0, excess = 0, drawn = 0;
    for (std::size_t k = 0; k < must.size(); ++k) {
      missing += must[k] && !svg.layers[0].cells[k];
      excess += svg.layers[0].cells[k] && !may[k];
      drawn += svg.layers[0].cells[k];
    }
    EXPECT_EQ(missing, 0u) << "cells with a part of a box, seed " << seed;
    EXPECT_EQ(excess, 0u) << "cells without one, seed " << seed;
    EXPECT_GT(drawn, 1000u);
    for (const result::SolBox& b : source.boxes.boxes)  // also points
      ASSERT_TRUE(svg.holds(0, b.box[0].mid(), b.box[1].mid())) << b.box[0] << b.box[1];
  }
}

TEST(Svg, StaysSmallHoweverManyBoxesThereAre) {
  const PictureFolder folder;
  write_portrait(folder.file("a.svg"), picture({boxes_about_a_circle("forward", 1, 100'000, 0.05)}), {});
  EXPECT_LT(std::filesystem::file_size(folder.file("a.svg")), 60'000u);
}

TEST(Svg, MarksPointsSoThatTheyAreSeen) {
  const PictureFolder folder;
  PictureSource source = boxes_about_a_circle("forward", 1, 8, 1e-12);  // eight points
  source.boxes.boxes.push_back({{{-0.5, 0.5}, {-0.5, 0.5}}, Verdict::regular, {}});
  source.boxes.boxes.push_back({{{-0.001, 0.001}, {-0.001, 0.001}}, Verdict::regular, {}});  // inside the square
  write_portrait(folder.file("a.svg"), picture({source}), {});
  SvgPortrait svg;
  read_svg(folder.file("a.svg"), svg);
  EXPECT_EQ(svg.layers.at(0).marks, 8);
}

TEST(Svg, HasOneScaleForLengthsAndAWholeTurnForAngles) {
  const PictureFolder folder;
  PictureSource source{"a.h5", "cspace", {}, {{"t", 1, 2, {-M_PI, M_PI}}}, 2};
  source.boxes.variables = {"x", "c_t", "s_t"};
  for (int k = 0; k < 60; ++k) {
    const double t = 0.1 * k;
    source.boxes.boxes.push_back({{{t, t + 0.1}, std::cos(t), std::sin(t)}, Verdict::regular, {}});
  }
  write_portrait(folder.file("a.svg"), picture({source}, {"x", "t"}), {});
  SvgPortrait mixed, lengths;
  read_svg(folder.file("a.svg"), mixed);
  EXPECT_NEAR(mixed.y_lo, -M_PI, 1e-9);
  EXPECT_NEAR(mixed.y_hi, M_PI, 1e-9);
  EXPECT_THAT(bytes_of(folder.file("a.svg")), HasSubstr("−π/2"));
  write_portrait(folder.file("b.svg"), picture({source}, {"c_t", "s_t"}), {});
  read_svg(folder.file("b.svg"), lengths);
  EXPECT_NEAR((lengths.x_hi - lengths.x_lo) / lengths.columns, (lengths.y_hi - lengths.y_lo) / lengths.rows, 1e-5);
}

TEST(Png, ShowsThePixelsOfTheBoxesAndNoOthers) {
  const PictureFolder folder;
  const PictureSource source = boxes_about_a_circle("forward", 1, 200, 0.04);
  PortraitOptions options = bare(60);
  options.dots_per_inch = 150;
  write_portrait(folder.file("a.svg"), picture({source}), options);
  write_portrait(folder.file("a.png"), picture({source}), options);
  SvgPortrait svg;
  read_svg(folder.file("a.svg"), svg);
  const Pixels png = read_png(folder.file("a.png"));
  const Color red = set_color("forward");
  const std::array<int, 3> full{static_cast<int>(std::lround(255 * red.red)), static_cast<int>(std::lround(255 * red.green)),
                                static_cast<int>(std::lround(255 * red.blue))};
  const double scale = options.dots_per_inch / 72, cells = 1 / (scale * svg.cell);  // in a pixel
  int inside = 0, outside = 0;
  for (int py = 0; py < png.height; ++py)
    for (int px = 0; px < png.width; ++px) {
      // The cells under the pixel; those at the frame are under its line.
      const double c0 = (px / scale - svg.x) / svg.cell, r0 = (py / scale - svg.y) / svg.cell;
      if (c0 < 2 * cells || r0 < 2 * cells || c0 + 3 * cells > svg.columns || r0 + 3 * cells > svg.rows) continue;
      int held = 0, all = 0;
      for (int r = static_cast<int>(r0); r <= static_cast<int>(r0 + cells); ++r)
        for (int c = static_cast<int>(c0); c <= static_cast<int>(c0 + cells); ++c) {
          ++all;
          held +=
              svg.layers[0]
                  .cells[static_cast<std::size_t>(r) * static_cast<std::size_t>(svg.columns) + static_cast<std::size_t>(c)];
        }
      const auto pixel = png.at(px, py);
      if (held == all) {
        ++inside;
        for (std::size_t k = 0; k < 3; ++k) ASSERT_NEAR(pixel[k], full[k], 2) << px << ' ' << py;
      } else if (held == 0) {
        ++outside;
        ASSERT_EQ(pixel, (std::array<int, 3>{255, 255, 255})) << px << ' ' << py;
      }
    }
  EXPECT_GT(inside, 3000);
  EXPECT_GT(outside, 30000);
}

TEST(Png, LaysTranslucentBoxesOverEachOtherOnce) {
  const PictureFolder folder;
  PictureSource source{"a.h5", "cspace", {}, {}, 2};
  for (int k = 0; k < 50; ++k) source.boxes.boxes.push_back({{{0, 1 + 0.001 * k}, {0, 1}}, Verdict::regular, {}});
  write_portrait(folder.file("a.png"), picture({source}), {});
  const Pixels png = read_png(folder.file("a.png"));
  const auto middle = png.at(png.width / 2, png.height / 2);
  const Color grey = set_color("cspace");
  EXPECT_NEAR(middle[0], 255 * (0.4 * grey.red + 0.6), 2);
}

TEST(Pdf, IsDrawnByAnotherProgramAsThePngIs) {
  if (std::system("command -v pdftoppm >/dev/null") != 0) GTEST_SKIP() << "pdftoppm is not installed (scripts/packages.txt)";
  const PictureFolder folder;
  PortraitOptions options;
  options.title = "θ against ω";
  options.dots_per_inch = 100;
  const Picture both =
      picture({boxes_about_a_circle("cspace", 1.2, 300, 0.1), boxes_about_a_circle("inverse", 1, 300, 0.05)});
  write_portrait(folder.file("a.pdf"), both, options);
  write_portrait(folder.file("a.png"), both, options);
  write_portrait(folder.file("a.svg"), both, options);
  EXPECT_EQ(bytes_of(folder.file("a.pdf")).substr(0, 5), "%PDF-");
  const std::string command =
      "cd '" + folder.file("").string() + "' && pdftoppm -r 100 -singlefile -png a.pdf b 2>log && test ! -s log";
  ASSERT_EQ(std::system(command.c_str()), 0) << bytes_of(folder.file("log"));
  const Pixels a = read_png(folder.file("a.png")), b = read_png(folder.file("b.png"));
  EXPECT_NEAR(a.width, b.width, 1);
  EXPECT_NEAR(a.height, b.height, 1);
  // Within the frame the boxes are the same ones; beyond it there is text in both, in whichever fonts there are.
  SvgPortrait svg;
  read_svg(folder.file("a.svg"), svg);
  constexpr double kLine = 3;  // pixels
  const double scale = options.dots_per_inch / 72;
  const auto is_inside = [&](int x, int y) {
    return x > scale * svg.x + kLine && x < scale * (svg.x + svg.cell * svg.columns) - kLine && y > scale * svg.y + kLine &&
           y < scale * (svg.y + svg.cell * svg.rows) - kLine;
  };
  int same = 0, blue = 0, all = 0;
  std::array<int, 2> dark{};
  for (int y = 0; y < std::min(a.height, b.height); ++y)
    for (int x = 0; x < std::min(a.width, b.width); ++x) {
      const auto p = a.at(x, y), q = b.at(x, y);
      if (!is_inside(x, y)) {
        dark[0] += p[0] + p[1] + p[2] < 300;
        dark[1] += q[0] + q[1] + q[2] < 300;
        continue;
      }
      ++all;
      same += std::abs(p[0] - q[0]) + std::abs(p[1] - q[1]) + std::abs(p[2] - q[2]) < 100;
      blue += q[2] > q[0] + 80;
    }
  EXPECT_GT(all, 50000);
  EXPECT_GT(same, all * 98 / 100) << same << " of " << all;
  EXPECT_GT(blue, 2000);
  for (const int pixels : dark) EXPECT_GT(pixels, 300) << "the frame, its ticks and their numbers";
}

TEST(Portrait, RefusesWhatItCannotDraw) {
  const PictureFolder folder;
  const Picture flat = picture({boxes_about_a_circle("forward", 1, 10, 0.1)});
  const auto write = [&](const std::string& name, const Picture& p, const PortraitOptions& options = {}) {
    write_portrait(folder.file(name), p, options);
  };
  EXPECT_THROW(write("a.jpg", flat), std::invalid_argument);
  EXPECT_THROW(write("a.svg", picture({boxes_about_a_circle("forward", 1, 10, 0.1)}, {"1", "2", "1"})),
               std::invalid_argument);
  EXPECT_THROW(write("a.svg", picture({boxes_about_a_circle("forward", 1, 0, 0.1)})), std::invalid_argument);
  EXPECT_THROW(write("a.svg", flat, bare(5)), std::invalid_argument);
  EXPECT_THROW(write("no/such/folder/a.svg", flat), result::ResultFileError);
  EXPECT_TRUE(std::filesystem::is_empty(folder.file("")));
}

TEST(Portrait, DrawsOnePointAndHugeAndTinyCoordinates) {
  const PictureFolder folder;
  for (const double scale : {1.0, 1e200, 1e-200}) {
    for (const double width : {0.0, 1e-14, 0.5}) {
      PictureSource source{"a.h5", "", {}, {}, 2};
      source.boxes.boxes.push_back({{{scale, scale * (1 + width)}, {-scale, -scale * (1 - width)}}, std::nullopt, {}});
      write_portrait(folder.file("a.svg"), picture({source}), bare(20));
      SvgPortrait svg;
      read_svg(folder.file("a.svg"), svg);
      ASSERT_EQ(svg.layers.size(), 1u);
      EXPECT_GT(std::count(svg.layers[0].cells.begin(), svg.layers[0].cells.end(), true), 0) << scale << ' ' << width;
    }
  }
}

}  // namespace
}  // namespace corank::report
