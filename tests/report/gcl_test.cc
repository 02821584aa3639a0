#include "corank/report/pictures/picture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace corank::report {
namespace {
using ::testing::HasSubstr;
using ::testing::Not;

result::SolFile two_boxes() {
  result::SolFile file;
  file.variables = {"x", "y", "z", "w"};
  file.boxes = {{{{0, 1}, {2, 3}, {4, 6}, {7, 8}}, Verdict::regular, {}},
                {{{-1, -0.5}, {0, 0.25}, {0, 2}, {0, 0}}, Verdict::undecided, {}}};
  return file;
}

std::string gcl(const result::SolFile& file, const PictureOptions& options, const std::string& name = "boxes",
                const std::string& comment = "") {
  return to_gcl(make_picture({picture_source(file, "boxes.sol")}, options), name, comment);
}
PictureOptions plain_axes(std::vector<std::string> names, ColorScheme color = ColorScheme::plain) {
  return {std::move(names), color, 0};
}

TEST(Gcl, DrawsABoxByItsEightCornersAndSixFaces) {
  result::SolFile file = two_boxes();
  file.boxes.pop_back();
  const std::string text = gcl(file, plain_axes({"1", "2", "4"}));
  EXPECT_THAT(text, HasSubstr("OFF 8 6 1\n0 2 7\n0 3 7\n1 3 7\n1 2 7\n0 2 8\n0 3 8\n1 3 8\n1 2 8\n4 3 2 1 0\n"));
  EXPECT_THAT(text, HasSubstr("diffuse 0.000000 0.000000 1.000000"));
}

TEST(Gcl, DrawsManyBoxesAsOneMesh) {
  const std::string text = gcl(two_boxes(), plain_axes({"x", "y", "z"}));
  EXPECT_THAT(text, HasSubstr("OFF 16 12 1\n"));
  EXPECT_THAT(text, HasSubstr("\n4 11 10 9 8\n"));
}

TEST(Gcl, DrawsCubesOfTheSizeAskedForAboutTheCentres) {
  PictureOptions options = plain_axes({"x", "y", "z"});
  options.size = 0.5;
  EXPECT_THAT(gcl(two_boxes(), options), HasSubstr("\n0.25 2.25 4.75\n0.25 2.75 4.75\n0.75 2.75 4.75\n"));
}

TEST(Gcl, DrawsSquaresInThePlane) {
  EXPECT_THAT(gcl(two_boxes(), plain_axes({"y", "x"})), HasSubstr("OFF 8 2 1\n2 0 0\n2 1 0\n3 1 0\n3 0 0\n"));
}

TEST(Gcl, GivesEachVerdictItsColour) {
  const std::string text = gcl(two_boxes(), plain_axes({"x", "y", "z"}, ColorScheme::verdict));
  EXPECT_THAT(text, HasSubstr("diffuse 0.000000 0.000000 1.000000"));
  EXPECT_THAT(text, HasSubstr("diffuse 1.000000 0.000000 0.000000"));
  EXPECT_THAT(text, HasSubstr("OFF 8 6 1\n"));
}

TEST(Gcl, KeepsStrangeNamesOutOfGeomviewsLanguage) {
  const std::string text = gcl(two_boxes(), plain_axes({"x", "y", "z"}), "a (b) {c}", "line\n(exit)");
  EXPECT_THAT(text, HasSubstr("(geometry a__b___c_ { LIST"));
  EXPECT_THAT(text, Not(HasSubstr("\n(exit)")));
}

TEST(Gcl, RefusesToDrawNothing) { EXPECT_THROW(to_gcl(Picture{}, "boxes", ""), result::ResultFileError); }

struct Snapshot {
  int width = 0, height = 0;
  std::vector<unsigned char> rgb;
  // Pixels whose strongest channel is that one by far.
  int count(std::size_t channel) const {
    int pixels = 0;
    for (std::size_t i = 0; i + 2 < rgb.size(); i += 3) {
      const int own = rgb[i + channel], others = std::max(rgb[i + (channel + 1) % 3], rgb[i + (channel + 2) % 3]);
      pixels += own > others + 60 ? 1 : 0;
    }
    return pixels;
  }
};

Snapshot read_ppm(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::string magic;
  int depth = 0;
  Snapshot picture;
  in >> magic >> picture.width >> picture.height >> depth;
  in.get();
  if (magic != "P6" || depth != 255) return {};
  picture.rgb.resize(static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height) * 3);
  in.read(reinterpret_cast<char*>(picture.rgb.data()), static_cast<std::streamsize>(picture.rgb.size()));
  return in ? picture : Snapshot{};
}

// Geomview loads the file on a screen of its own, as a user's would, and takes a picture of its window.
TEST(Gcl, GeomviewShowsTheBoxesInTheirColours) {
  if (std::system("command -v geomview >/dev/null && command -v xvfb-run >/dev/null") != 0) {
    GTEST_SKIP() << "geomview and xvfb-run are not installed (scripts/packages.txt)";
  }
  std::string pattern = (std::filesystem::temp_directory_path() / "corank-gcl-XXXXXX").string();
  ASSERT_NE(mkdtemp(pattern.data()), nullptr);
  const std::filesystem::path folder = pattern;
  result::SolFile file;
  for (int i = 0; i < 40; ++i) {
    const double x = 0.5 * i, y = i < 20 ? x : 20 - x;
    file.boxes.push_back({{{x, x + 1}, {y, y + 1}, {0, 1}}, i < 20 ? Verdict::regular : Verdict::undecided, {}});
  }
  // A window exists before the file is loaded, and is photographed and closed behind it.
  std::ofstream(folder / "scene.gcl") << "(new-camera c0)\n"
                                      << gcl(file, plain_axes({"1", "2", "3"}, ColorScheme::verdict), "roof", "")
                                      << "(look World c0)\n(redraw c0)\n(snapshot c0 " << (folder / "shot.ppm").string()
                                      << " ppm)\n(exit)\n";
  const std::string at = "'" + folder.string() + "'";
  const std::string command =
      "cd " + at + " && HOME=" + at +
      " timeout 120 xvfb-run -a -s '-screen 0 800x600x24' geomview -nopanels -noinit -wpos 600,500@0,0 "
      "scene.gcl >log 2>&1";
  EXPECT_EQ(std::system(command.c_str()), 0);
  std::ostringstream log;
  log << std::ifstream(folder / "log").rdbuf();
  EXPECT_EQ(log.str().find("expected"), std::string::npos) << log.str();
  EXPECT_EQ(log.str().find("rror"), std::string::npos) << log.str();
  const Snapshot picture = read_ppm(folder / "shot.ppm");
  EXPECT_EQ(picture.width, 600);
  EXPECT_GT(picture.count(2), 2000) << "blue";
  EXPECT_GT(picture.count(0), 2000) << "red";
  EXPECT_LT(picture.count(0) + picture.count(2), 200000) << "the background";
  EXPECT_EQ(picture.count(1), 0) << "green";
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace corank::report
