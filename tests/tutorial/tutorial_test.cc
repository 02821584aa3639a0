// doc/tutorial.md and doc/tutorial_parts.md do what they say.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "corank/result/cuik/cuik_files.h"
#include "corank/tests/cuik/shell.h"
#include "corank/tests/seeds.h"

namespace corank::cuik {
namespace {

using result::SolFile;
using ::testing::HasSubstr;

// The blocks of a tutorial in this language, one after the other.
std::string blocks(const std::string& tutorial, const std::string& language) {
  const std::string text = read_text(CORANK_SOURCE_DIR "/doc/" + tutorial);
  const std::string open = "\n```" + language + "\n", close = "\n```\n";
  std::string commands;
  for (std::size_t at = text.find(open); at != std::string::npos; at = text.find(open, at)) {
    at += open.size();
    const std::size_t end = text.find(close, at);
    commands += text.substr(at, end - at) + "\n";
    at = end;
  }
  return commands;
}

std::string commands() { return blocks("tutorial.md", "sh"); }

bool covers(const SolFile& file, const std::vector<std::pair<std::string, double>>& point) {
  return std::any_of(file.boxes.begin(), file.boxes.end(), [&](const result::SolBox& box) {
    return std::all_of(point.begin(), point.end(), [&](const auto& value) {
      return box.box.at(static_cast<std::size_t>(file.find(value.first))).contains(value.second);
    });
  });
}

// Distance of J3 from the motors where both arms have a length between 0 and 2l.
constexpr double kL = 0.9, kD = 1.18;

TEST(Tutorial, RunsWordForWordAndShowsWhatItPromises) {
  const std::string text = commands();
  EXPECT_THAT(text, HasSubstr("cuikatan2 cspace 4 3 10 9 cspace_angles"));
  const Folder folder;
  const Outcome run = folder.run(text);
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.err, "");
  EXPECT_THAT(run.out,
              HasSubstr("cspace, system: 10 variables, 8 equations, 0 inequalities; dimension 2\nsigma 0.2\ncomplete"));
  for (const char* name :
       {"cspace", "fwd", "inv", "cspace_output", "fwd_output", "inv_output", "cspace_input", "fwd_input", "inv_input"}) {
    EXPECT_THAT(folder.read(std::string(name) + ".gcl"), HasSubstr("OFF ")) << name;
  }
  for (const char* name : {"output.svg", "input.svg"}) {
    for (const char* set : {"cspace", "forward", "inverse"})
      EXPECT_THAT(folder.read(name), HasSubstr(std::string("data-set=\"") + set + "\"")) << name;
  }

  // Inverse: the arcs of radius 2l about both motors, and J3 on a motor, the folded arm in any direction.
  const SolFile inv = result::read_sol(folder.file("inv.sol"));
  for (int i = 0; i <= 20; ++i) {
    const double t = std::acos(kD / 2 / (2 * kL)) * (i / 10.0 - 1);  // on the arc about the origin inside the other circle
    const double x = 2 * kL * std::cos(t), y = 2 * kL * std::sin(t);
    if (std::hypot(x - kD, y) < 2 * kL - 1e-9) {
      EXPECT_TRUE(covers(inv, {{"J3x", x}, {"J3y", y}})) << i;
      EXPECT_TRUE(covers(inv, {{"J3x", kD - x}, {"J3y", y}})) << i;
    }
    const double turn = std::numbers::pi * (i / 10.0 - 1);
    EXPECT_TRUE(covers(inv, {{"J3x", kD}, {"J3y", 0.0}, {"ct2", std::cos(turn)}, {"st2", std::sin(turn)}})) << i;
    EXPECT_TRUE(covers(inv, {{"J3x", 0.0}, {"J3y", 0.0}, {"ct5", std::cos(turn)}, {"st5", std::sin(turn)}})) << i;
  }
  // Forward: J2, J3, J4 on a line. θ3 = θ4 = 0 with θ2 = π − θ5 by symmetry: d + 2 l cosθ2 + 2 l = 0.
  const SolFile fwd = result::read_sol(folder.file("fwd.sol"));
  const double c2 = -(kD + 2 * kL) / (2 * kL), reach = -(kD - 2 * kL) / (2 * kL);
  EXPECT_LT(c2, -1);  // too far apart; so the links 3 and 4 point back, θ3 = θ4 = π
  const double s2 = std::sqrt(1 - reach * reach);
  EXPECT_TRUE(covers(fwd, {{"ct2", reach}, {"st2", s2}, {"ct3", -1.0}, {"st3", 0.0}, {"ct5", -reach}, {"st5", s2}}));
  // What is derived by corank covers the same, in its own names.
  const SolFile forward = result::read_sol(folder.file("forward.sol"));
  EXPECT_TRUE(covers(forward, {{"c_theta2", reach}, {"s_theta2", s2}, {"c_theta3", -1.0}, {"s_theta3", 0.0}}));
  EXPECT_TRUE(covers(result::read_sol(folder.file("inverse.sol")), {{"J3x", 0.0}, {"J3y", 0.0}}));
}

TEST(Tutorial, TheInputPortraitHoldsTheAnglesOfTheOutputPortrait) {
  // One assembly: J3 at (0.59, y) with the left arm's knee outward; its angles lie in a box of the converted C-space.
  const Folder folder;
  const std::string all = commands();
  const std::size_t end = all.find("cuikplot3d cspace");
  ASSERT_NE(end, std::string::npos);
  const Outcome run = folder.run(all.substr(0, end) + "cuikatan2 cspace 4 3 10 9 cspace_angles\n");
  ASSERT_EQ(run.status, 0) << run.err;
  const SolFile file = result::read_sol(folder.file("cspace_angles.sol"));
  ASSERT_EQ(file.size(), 8);
  const double x = kD / 2, y = 1.0, r = std::hypot(x, y), base = std::atan2(y, x), knee = std::acos(r / (2 * kL));
  const double theta5 = base + knee, theta2 = std::numbers::pi - theta5;
  EXPECT_TRUE(covers(file, {{"J3x", x}, {"J3y", y}, {"7", theta2}, {"8", theta5}}));
}

// What is shown of the output are whole lines of it. The page of the five-bar takes longer than all else, most of it for
// the aspects of C-space: a long run makes it word for word, another one without C-space.
TEST(PartsTutorial, RunsWordForWordAndShowsWhatItPrints) {
  const Folder folder;
  std::string text = blocks("tutorial_parts.md", "sh");
  const std::string last = " --time-limit 60 -o five_bar\n";
  const std::size_t at = text.find(last);
  ASSERT_NE(at, std::string::npos);
  if (!test::long_run()) text.insert(at, " --sets forward,inverse,cspace-singular");
  const Outcome run = folder.run(text);
  ASSERT_EQ(run.status, 0) << run.err;
  const std::string out = "\n" + run.out;
  std::istringstream shown(blocks("tutorial_parts.md", "text"));
  int lines = 0;
  for (std::string line; std::getline(shown, line);) {
    if (line.empty()) continue;
    EXPECT_THAT(out, HasSubstr("\n" + line + "\n"));
    ++lines;
  }
  EXPECT_GE(lines, 30);
  EXPECT_THAT(folder.read("fourbar.gcl"), HasSubstr("OFF "));
  for (const char* page : {"fourbar/index.html", "five_bar/index.html"})
    EXPECT_GT(folder.read(page).size(), 100'000u) << page;
  for (const char* result : {"inverse.h5", "forward.h5"})  // whose failure would have ended the run
    EXPECT_THAT(text, HasSubstr(std::string("\ncorank verify ") + result + "\n"));
}

}  // namespace
}  // namespace corank::cuik
