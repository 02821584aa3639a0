// cuikequations, cuik, cuikplot3d, cuikatan2 and the subcommands behind them, as a user runs them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "corank/result/cuik/cuik_files.h"
#include "corank/tests/cuik/shell.h"
#include "corank/tests/cuik/suite_files.h"

namespace corank::cuik {
namespace {

using result::SolFile;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

// The unit circle: a curve of dimension 1.
constexpr const char* kCircle =
    "[SYSTEM VARS]\nc : [-1, 1]\ns : [-1, 1]\n[DUMMY VARS]\np : [-1, 1]\n[SYSTEM EQS]\nc^2 + s^2 = 1;\n[DUMMY EQS]\nc*s - p "
    "= 0;\n";

double widest(const SolFile& file) {
  double width = 0;
  for (const result::SolBox& box : file.boxes) {
    for (const Interval& x : box.box) width = std::max(width, x.hi() - x.lo());
  }
  return width;
}

TEST(Cuik, SolvesWithTheParameterFileBesideTheModel) {
  const Folder folder;
  folder.write("circle.cuik", kCircle);
  folder.write("circle.param", "SIGMA = 0.05\nRHO = 0.95 % tuning\n");
  const Outcome run = folder.run("cuik circle");
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("circle.param: these parameters have no effect here: RHO\n"));
  EXPECT_THAT(run.out, HasSubstr("sigma 0.05"));
  const SolFile file = result::read_sol(folder.file("circle.sol"));
  EXPECT_THAT(file.variables, ElementsAre("c", "s"));  // no dummy variables, as in the suite
  EXPECT_GT(file.boxes.size(), 100u);
  EXPECT_LE(widest(file), 0.051);
  for (int degree = 0; degree < 360; ++degree) {
    const double t = degree * std::numbers::pi / 180;
    EXPECT_TRUE(std::any_of(file.boxes.begin(), file.boxes.end(), [&](const result::SolBox& b) {
      return b.box[0].contains(std::cos(t)) && b.box[1].contains(std::sin(t));
    })) << degree;
  }
}

TEST(Cuik, LeavesItsOwnVariablesForSinesOfLengthsOut) {
  const Folder folder;
  folder.write("wave.cuik", "[SYSTEM VARS]\ny : [1, 2]\nt : [0, 9]\n[SYSTEM EQS]\ny*sin(t) = 1;\n");
  ASSERT_EQ(folder.run("cuik wave").status, 0);
  const SolFile file = result::read_sol(folder.file("wave.sol"));
  EXPECT_THAT(file.variables, ElementsAre("y", "t"));
  for (int k = 0; k <= 50; ++k) {
    const double t = 7 + k / 50.0, y = 1 / std::sin(t);
    EXPECT_TRUE(std::any_of(file.boxes.begin(), file.boxes.end(), [&](const result::SolBox& b) {
      return b.box[0].lo() <= y + 1e-12 && y - 1e-12 <= b.box[0].hi() && b.box[1].contains(t);
    })) << t;
  }
}

TEST(Cuik, TakesNamesWithExtensionAndInFoldersAndRunsWithoutParameters) {
  const Folder folder;
  folder.write("circle.cuik", kCircle);
  EXPECT_EQ(folder.run("mkdir sub && mv circle.cuik sub && cuik sub/circle.cuik").status, 0);
  EXPECT_GT(result::read_sol(folder.file("sub/circle.sol")).boxes.size(), 50u);
}

TEST(Cuik, HasTheExitStatusesOfCorankSolve) {
  const Folder folder;
  EXPECT_EQ(folder.run("cuik").status, 2);
  EXPECT_EQ(folder.run("cuik --help").status, 0);
  const Outcome missing = folder.run("cuik nothing");
  EXPECT_EQ(missing.status, 1);
  EXPECT_THAT(missing.err, HasSubstr("cuik: nothing.cuik: there is no such file"));
  folder.write("circle.cuik", kCircle);
  folder.write("circle.param", "SIGMA = 0.1\nDUMIFY = 1\n");
  const Outcome unknown = folder.run("cuik circle");
  EXPECT_EQ(unknown.status, 1);
  EXPECT_THAT(unknown.err, HasSubstr("circle.param:2: the parameter 'DUMIFY' is unknown"));
  EXPECT_THAT(unknown.err, HasSubstr("did you mean DUMMIFY?"));
  folder.write("circle.param", "SIGMA = 0.001\n");
  EXPECT_EQ(folder.run("cuik circle --max-boxes 3").status, 3);
  EXPECT_EQ(folder.run("cuikplot3d circle 1 2 1 0 a").status, 3);  // an incomplete cover stays one
  EXPECT_EQ(folder.run("cuikatan2 circle 2 1 a").status, 3);
}

TEST(Cuik, RefinesIsolatedSolutionsToSmallSigma) {
  const Folder folder;
  folder.write("root.cuik", "[SYSTEM VARS]\nx : [0, 2]\n[SYSTEM EQS]\nx^2 = 2;\n");
  folder.write("root.param", "SIGMA = 0.1\nSMALL_SIGMA = 1e-5\n");
  EXPECT_THAT(folder.run("cuik root").out, HasSubstr("sigma 1e-05"));
  EXPECT_THAT(folder.run("corank solve root.cuik --param root.param --sigma 0.01").out, HasSubstr("sigma 0.01"));
}

TEST(Cuik, EndsAfterAsManySolutionsAsTheParametersAskFor) {
  const Folder folder;
  folder.write("circle.cuik", kCircle);
  folder.write("circle.param", "SIGMA = 0.01\nN_SOLUTIONS = 30\n");
  const Outcome run = folder.run("cuik circle --threads 1");
  EXPECT_EQ(run.status, 3) << run.err;
  EXPECT_EQ(run.err, "corank: stopped by the solution limit, in the stage search; the result is incomplete\n");
  EXPECT_THAT(folder.read("circle.sol"), HasSubstr("   SIGMA = 0.01\n   N_SOLUTIONS = 30\n"));
  const auto regular = [&] {
    const SolFile file = result::read_sol(folder.file("circle.sol"));
    return std::count_if(file.boxes.begin(), file.boxes.end(),
                         [](const result::SolBox& b) { return b.verdict == Verdict::regular; });
  };
  EXPECT_GE(regular(), 30);
  EXPECT_LE(regular(), 50);
  EXPECT_EQ(folder.run("cuik circle --max-solutions 60").status, 3);
  EXPECT_GE(regular(), 60);
  const Outcome all = folder.run("cuik circle --max-solutions 0");
  EXPECT_EQ(all.status, 0) << all.err;
  EXPECT_GT(regular(), 500);
  folder.write("circle.param", "SIGMA = 0.01\nN_SOLUTIONS = 0\n");
  EXPECT_EQ(folder.run("cuik circle").status, 0);
  EXPECT_GT(regular(), 500);
}

// A four-bar linkage of our own lengths whose crank turns round: 0.8 + 2 < 1.75 + 1.5.
constexpr const char* kFourBar =
    "[CONSTANTS]\nd := 2\nc := 0.8\nk := 1.75\nr := 1.5\n"
    "[LINKS]\nground\ncrank\ncoupler\nrocker\n"
    "[JOINTS]\nREVOLUTE: ground (0, 0, 0) (0, 0, 1) crank (0, 0, 0) (0, 0, 1)\n"
    "REVOLUTE: crank (c, 0, 0) (c, 0, 1) coupler (0, 0, 0) (0, 0, 1)\n"
    "REVOLUTE: coupler (k, 0, 0) (k, 0, 1) rocker (r, 0, 0) (r, 0, 1)\n"
    "REVOLUTE: rocker (0, 0, 0) (0, 0, 1) ground (d, 0, 0) (d, 0, 1)\n";

bool covers(const SolFile& file, const std::vector<std::pair<std::string, double>>& angles) {
  return std::any_of(file.boxes.begin(), file.boxes.end(), [&](const result::SolBox& b) {
    return std::all_of(angles.begin(), angles.end(), [&](const auto& angle) {
      const auto side = [&](const char* kind) { return b.box.at(static_cast<std::size_t>(file.find(kind + angle.first))); };
      const Interval c = side("c_"), s = side("s_");
      return c.lo() - 1e-9 <= std::cos(angle.second) && std::cos(angle.second) <= c.hi() + 1e-9 &&
             s.lo() - 1e-9 <= std::sin(angle.second) && std::sin(angle.second) <= s.hi() + 1e-9;
    });
  });
}

TEST(Cuikequations, WritesEquationsThatCuikSolvesAndCuikplot3dDraws) {
  const Folder folder;
  folder.write("fourbar.world", kFourBar);
  folder.write("fourbar.param", "SIGMA = 0.05\n");
  const Outcome run = folder.run("cuikequations fourbar && cuik fourbar && cuikplot3d fourbar 1 2 3 0 fourbar");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.err, "");
  EXPECT_THAT(run.out, HasSubstr("6 variables, 5 equations, 0 inequalities; dimension 1\nsigma 0.05\ncomplete"));
  EXPECT_THAT(folder.read("fourbar.cuik"), HasSubstr("% planar, 4 links, mobility 1\n"));
  EXPECT_THAT(folder.read("fourbar.gcl"), HasSubstr("OFF "));
  const SolFile file = result::read_sol(folder.file("fourbar.sol"));
  EXPECT_LE(widest(file), 0.0501);
  for (int degree = 0; degree < 360; degree += 5) {
    const double t = degree * std::numbers::pi / 180, x = 0.8 * std::cos(t) - 2, y = 0.8 * std::sin(t), q = std::hypot(x, y);
    for (const int side : {-1, 1}) {  // the triangle of rocker and coupler over their feet's distance q
      const double rocker = std::atan2(y, x) + side * std::acos((1.5 * 1.5 + q * q - 1.75 * 1.75) / (2 * 1.5 * q));
      const double coupler = std::atan2(1.5 * std::sin(rocker) - y, 1.5 * std::cos(rocker) - x);
      EXPECT_TRUE(covers(file, {{"phi_crank", t}, {"phi_rocker", rocker}, {"phi_coupler", coupler}})) << degree;
    }
  }
}

TEST(Cuikequations, WritesAllConfigurationsWhateverTheInputs) {
  const Folder folder;
  folder.write("a.world", std::string(kFourBar) + "[OUTPUTS]\nP : position of coupler (1, 0, 0)\n");
  EXPECT_EQ(folder.run("corank solve a.world").status, 2) << "a mechanism has sets";
  const Outcome run = folder.run("cuikequations a.world && cuik a --sigma 0.1");
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("8 variables, 7 equations"));
  EXPECT_EQ(folder.run("cuikequations a -D c=0.5").status, 0) << "it may write its own file again";
  EXPECT_THAT(folder.read("a.cuik"), HasSubstr("0.5*c_phi_crank"));
}

TEST(Cuikequations, NeverWritesOverAModel) {
  const Folder folder;
  folder.write("a.world", kFourBar);
  folder.write("a.cuik", kCircle);
  const Outcome kept = folder.run("cuikequations a");
  EXPECT_EQ(kept.status, 2);
  EXPECT_THAT(kept.err, HasSubstr("cuikequations: a.cuik: not overwritten"));
  EXPECT_EQ(folder.read("a.cuik"), kCircle);
  for (const char* input : {"a.world", "a.cuik", "./a.world"})
    EXPECT_EQ(folder.run(std::string("corank derive a.world --format cuik -o ") + input).status, 2) << input;
  EXPECT_EQ(folder.read("a.world"), kFourBar);
  EXPECT_EQ(folder.run("corank derive a.world -o a.txt && corank derive a.world --format latex -o a.txt").status, 0);
}

TEST(Cuikequations, HasTheExitStatusesOfCorankDerive) {
  const Folder folder;
  EXPECT_EQ(folder.run("cuikequations").status, 2);
  EXPECT_EQ(folder.run("cuikequations --help").status, 0);
  EXPECT_EQ(folder.run("cuikequations nothing").status, 1);
  folder.write("open.world", "[LINKS]\nground\narm\n[JOINTS]\nrevolute: ground (0,0,0)(0,0,1) arm (0,0,0)(0,0,1)\n");
  const Outcome open = folder.run("cuikequations open");
  EXPECT_EQ(open.status, 1);
  EXPECT_THAT(open.err, HasSubstr("open.world: there are no equations to write"));
  EXPECT_FALSE(std::filesystem::exists(folder.file("open.cuik")));
  folder.write("wrong.world", "[LINKS]\nground\narm\n[JOINTS]\nrevolute: ground (0,0,0)(0,0,1) amr (0,0,0)(0,0,1)\n");
  const Outcome wrong = folder.run("cuikequations wrong");
  EXPECT_EQ(wrong.status, 1);
  EXPECT_THAT(wrong.err, HasSubstr("cuikequations: wrong.world:5:"));
}

TEST(CorankSolve, TakesTheParametersBesideAWorld) {
  const Folder folder;
  folder.write("fourbar.world", kFourBar);
  const auto run = [&](const std::string& options) { return folder.run("corank solve fourbar.world " + options); };
  EXPECT_THAT(run("").err, Not(HasSubstr("param")));
  folder.write("fourbar.param", "SIGMA = 0.07\n");
  folder.write("other.param", "SIGMA = 0.09\n");
  const Outcome beside = run("");
  EXPECT_EQ(beside.status, 0) << beside.err;
  EXPECT_THAT(beside.out, HasSubstr("sigma 0.07\n"));
  EXPECT_EQ(beside.err, "fourbar.world: note: takes the parameters of fourbar.param that the command line does not give\n");
  EXPECT_THAT(run("--sigma 0.08").out, HasSubstr("sigma 0.08\n"));
  const Outcome other = run("--param other.param");
  EXPECT_THAT(other.out, HasSubstr("sigma 0.09\n"));
  EXPECT_EQ(other.err, "");
  folder.write("fourbar.param", "SIGMA = \n");
  EXPECT_EQ(run("").status, 1);
}

// With four equal bars the C-space is three circles that cross where all bars are on one line.
TEST(SuiteTutorial, FourBarsRuns) {
  SKIP_WITHOUT_SUITE_FILES();
  const std::filesystem::path source = suite_folder() / "worlds/FourBars";
  if (!std::filesystem::exists(source)) GTEST_SKIP() << "no mechanism files in " << suite_folder();
  const Folder folder;
  for (const char* name : {"FourBars.world", "FourBars.param"}) folder.write(name, read_text(source / name));
  const Outcome run = folder.run("cuikequations FourBars && cuik FourBars && cuikplot3d FourBars 1 3 5 0 fb.gcl");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(folder.read("fb.gcl"), HasSubstr("OFF "));
  const SolFile file = result::read_sol(folder.file("FourBars.sol"));
  EXPECT_LE(widest(file), 0.0501);
  for (int degree = 0; degree < 360; degree += 5) {
    const double t = degree * std::numbers::pi / 180;
    EXPECT_TRUE(covers(file, {{"phi_link2", std::numbers::pi}, {"phi_link3", t + std::numbers::pi}, {"phi_link4", t}}))
        << degree;
    EXPECT_TRUE(covers(file, {{"phi_link2", t}, {"phi_link3", std::numbers::pi}, {"phi_link4", t + std::numbers::pi}}))
        << degree;
    EXPECT_TRUE(covers(file, {{"phi_link2", t}, {"phi_link3", t + std::numbers::pi}, {"phi_link4", std::numbers::pi}}))
        << degree;
  }
  const auto undecided = std::count_if(file.boxes.begin(), file.boxes.end(),
                                       [](const result::SolBox& b) { return b.verdict == Verdict::undecided; });
  EXPECT_LE(undecided, 20) << "at the three crossings";
}

TEST(CorankSolve, WritesSolByItsExtensionAndNeverOverInputs) {
  const Folder folder;
  folder.write("circle.cuik", kCircle);
  EXPECT_EQ(folder.run("corank solve circle.cuik -o a.sol && corank solve circle.cuik -o a.h5").status, 0);
  EXPECT_THAT(folder.read("a.sol"), HasSubstr("END OF THE SOLUTION FILE"));
  EXPECT_EQ(folder.read("a.h5").substr(1, 3), "HDF");
  EXPECT_EQ(folder.run("corank solve circle.cuik -o circle.cuik").status, 2);
  EXPECT_EQ(folder.run("corank solve circle.cuik -o circle.param").status, 2);
  EXPECT_EQ(folder.read("circle.cuik"), kCircle);
}

TEST(Cuikplot3d, DrawsASolutionFile) {
  const Folder folder;
  folder.write("a.sol", "{ 3  x[0,1] y[2,3] z[4,5] } % regular\n{ 3  x[1,2] y[2,3] z[4,5] } % undecided\n");
  EXPECT_EQ(folder.run("cuikplot3d a 1 2 3 0 a.gcl && cuikplot3d a.sol 3 2 1 0.5 b").status, 0);
  EXPECT_THAT(folder.read("a.gcl"), HasSubstr("OFF 16 12 1\n0 2 4\n"));
  EXPECT_THAT(folder.read("b.gcl"), HasSubstr("\n4.25 2.25 0.25\n"));
  EXPECT_EQ(folder.run("corank plot a.sol --axes z,y --color verdict -o c.gcl").status, 0);
  EXPECT_THAT(folder.read("c.gcl"), HasSubstr("# undecided: 1"));
}

TEST(Cuikplot3d, RefusesWhatItCannotDraw) {
  const Folder folder;
  folder.write("a.sol", "{ 3  x[0,1] y[2,3] z[4,5] }\n");
  EXPECT_EQ(folder.run("cuikplot3d a 1 2 3").status, 2);
  EXPECT_EQ(folder.run("cuikplot3d --help").status, 0);
  const Outcome outside = folder.run("cuikplot3d a 1 2 4 0 a");
  EXPECT_EQ(outside.status, 2);
  EXPECT_THAT(outside.err,
              HasSubstr("cuikplot3d: a.sol has no variable '4'; expected a number from 1 to 3 or one of x, y, z"));
  EXPECT_EQ(folder.run("cuikplot3d a 1 2 3 -1 a").status, 2);
  EXPECT_EQ(folder.run("cuikplot3d b 1 2 3 0 a").status, 1);
  EXPECT_EQ(folder.run("corank plot a.sol --axes 1,2 -o a.jpg").status, 2);
  EXPECT_EQ(folder.run("corank plot a.sol --axes 1 -o a.gcl").status, 2);
  EXPECT_FALSE(std::filesystem::exists(folder.file("a.gcl")));
}

// The original prints [3.0419, 3.2413]; the corners (−1, ±0.1) … (−0.9, ±0.1) span ±atan(0.1/0.9) about π.
TEST(Cuikatan2, EnclosesAnglesAcrossMinusPi) {
  const Folder folder;
  folder.write("a.sol", "{ 3  s[-0.1,0.1] x[5,6] c[-1,-0.9] } % regular, free s\n");
  EXPECT_EQ(folder.run("cuikatan2 a 1 3 b").status, 0);
  const SolFile file = result::read_sol(folder.file("b.sol"));
  EXPECT_THAT(file.variables, ElementsAre("x", "atan2_s_c"));
  const Interval angle = file.boxes.at(0).box.at(1);
  const double half = std::atan(0.1 / 0.9);
  EXPECT_NEAR(angle.lo(), std::numbers::pi - half, 1e-12);
  EXPECT_NEAR(angle.hi(), std::numbers::pi + half, 1e-12);
  EXPECT_LE(angle.lo(), 3.0309 + 1e-4);
  EXPECT_GE(angle.hi(), 3.2523 - 1e-4);
  EXPECT_EQ(file.boxes[0].box[0], Interval(5, 6));
  EXPECT_FALSE(file.boxes[0].verdict.has_value());  // regular speaks of the sines and cosines
}

TEST(Cuikatan2, EnclosesAtAnyWidth) {
  const Folder folder;
  folder.write("a.sol", "{ 4  [-1,1] [-1,1] [0.5,1] [-0.8,0.8] }\n");
  EXPECT_EQ(folder.run("cuikatan2 a 1 2 3 4 b").status, 0);
  const SolFile file = result::read_sol(folder.file("b.sol"));
  const Box box = file.boxes.at(0).box;
  ASSERT_EQ(box.size(), 2u);
  EXPECT_TRUE(box[0].contains(Interval(-3.1415926535, 3.1415926535)));
  EXPECT_TRUE(box[1].contains(Interval(std::atan2(0.5, 0.8), std::atan2(0.5, -0.8))));
}

TEST(Cuikatan2, RefusesPairsThatMakeNoSense) {
  const Folder folder;
  folder.write("a.sol", "{ 3  [0,1] [0,1] [0,1] }\n");
  EXPECT_EQ(folder.run("cuikatan2 a 1 b").status, 2);
  EXPECT_EQ(folder.run("cuikatan2 a 1 1 b").status, 2);
  EXPECT_EQ(folder.run("cuikatan2 a 1 2 3 b").status, 2);
  EXPECT_EQ(folder.run("cuikatan2 a 1 9 b").status, 2);
  EXPECT_EQ(folder.run("cuikatan2 b 1 2 c").status, 1);
  EXPECT_FALSE(std::filesystem::exists(folder.file("b.sol")));
}

}  // namespace
}  // namespace corank::cuik
