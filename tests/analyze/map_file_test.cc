// A file of a map: what is written is read and verified; what is changed is found out.
#include "corank/result/files/hdf5_file.h"
#include "corank/result/values/claim_files.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "corank/tests/analyze/map_files.h"

namespace corank::analyze {
namespace {

using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;

std::size_t first_with(const MapFile& file, int count) {
  for (std::size_t c = 0; c < file.claims.cells.size(); ++c)
    if (file.claims.cells[c].count == count) return c;
  throw std::logic_error("no such cell");
}

void expect_complete(const MapFile& file) {
  const check::MapReport report = result::verify(file);
  EXPECT_TRUE(report.complete()) << result::to_table(report, file);
  EXPECT_EQ(report.completed(), file.claims.cells.size());
  EXPECT_THAT(result::to_table(report, file), EndsWith("\nverified\n"));
}

TEST(MapFile, IsReadAsItWasWritten) {
  MapFile file = circles();
  file.family.fixed = {};
  const std::string path = ::testing::TempDir() + "map_file_test.h5";
  result::write_map(path, file);
  EXPECT_EQ(result::format_of(path), result::kMapKind.format);
  const MapFile read = result::read_map(path);
  EXPECT_EQ(read.model_text, file.model_text);
  EXPECT_EQ(read.family.set, file.family.set);
  ASSERT_EQ(read.family.over.size(), 2U);
  EXPECT_EQ(read.family.over[1].name, "r2");
  EXPECT_EQ(read.family.over[1].upper.text(), "5/2");
  EXPECT_EQ(read.claims.reduction, file.claims.reduction);
  ASSERT_EQ(read.claims.cells.size(), file.claims.cells.size());
  for (std::size_t c = 0; c < file.claims.cells.size(); ++c) {
    const MapCellClaim &now = read.claims.cells[c], &before = file.claims.cells[c];
    EXPECT_EQ(now.sides, before.sides);
    EXPECT_EQ(now.count, before.count);
    ASSERT_EQ(now.sheets.size(), before.sheets.size());
    for (std::size_t k = 0; k < now.sheets.size(); ++k) {
      EXPECT_EQ(now.sheets[k].box, before.sheets[k].box);
      EXPECT_EQ(now.sheets[k].region, before.sheets[k].region);
    }
  }
  expect_complete(read);
}

// Constants, the equations' own unknowns, angles, fixed coordinates; kernel vectors, of which the negatives count once.
TEST(MapFile, OfMechanismsIsVerified) {
  const symbolic::SingularitySet cspace = symbolic::SingularitySet::cspace;
  const study::Question dextar = model_question("dextar.cuik", cspace);
  MapFile lengths = make_file({.question = dextar,
                               .over = {{"l2", "1/2", "3/2"}, {"l3", "1/2", "3/2"}},
                               .fixed = {{"theta2", "pi/3"}, {"theta5", "2"}}},
                              8);
  const std::string path = ::testing::TempDir() + "map_file_test_lengths.h5";
  result::write_map(path, lengths);
  lengths = result::read_map(path);
  ASSERT_EQ(lengths.family.fixed.size(), 2U);
  expect_complete(lengths);
  lengths.family.fixed[1].value = symbolic::Expression("1");
  EXPECT_FALSE(result::verify(lengths).complete());

  expect_complete(make_file({.question = dextar, .over = {{"theta2", "1", "2"}, {"theta5", "1", "2"}}}, 8));
  const MapFile slider = make_file({.question = model_question("three_slider.cuik", symbolic::SingularitySet::forward),
                                    .over = {{"L1", "1", "2"}, {"L2", "1/2", "9/10"}}},
                                   8);
  expect_complete(slider);
  EXPECT_GT(slider.claims.cells[0].sheets.size(), static_cast<std::size_t>(slider.claims.cells[0].count));
}

TEST(MapFile, OfEquationsThatContradictEachOtherIsVerified) {
  const MapFile file =
      make_file({.question = question_of("[CONSTANTS]\na := 0\nb := 0\n[SYSTEM VARS]\nx : [-4, 4]\ny : [-4, "
                                         "4]\n[SYSTEM EQS]\nx + y = a + b;\nx + y = a + b + 1;"),
                 .over = {{"a", "0", "1"}, {"b", "0", "1"}}},
                8);
  EXPECT_EQ(file.claims.cells.at(0).count, 0);
  expect_complete(file);
}

// Solutions that are known at every value: (x − f₁(p, q)) (x − f₂(p, q)) … with y = x², in a domain that some leave.
TEST(MapFile, OfPlantedSolutionsConfirmsTheirNumber) {
  std::mt19937 random(5);
  std::uniform_int_distribution<int> digit(-9, 9);
  std::uniform_real_distribution<double> share(0, 1);
  int several = 0, confirmed = 0;
  for (int trial = 0; trial < 8; ++trial) {
    std::string text;
    std::vector<std::array<int, 3>> planted;
    for (int k = 0; k < 2 + trial % 3; ++k) {
      const std::array<int, 3>& f = planted.emplace_back(std::array{digit(random), digit(random), digit(random)});
      text += fmt::format("{}(x - ({} + ({})*p + ({})*q)/10)", k > 0 ? "*" : "", f[0], f[1], f[2]);
    }
    const MapFile file =
        make_file({.question = question_of("[CONSTANTS]\np := 0\nq := 0\n[SYSTEM VARS]\nx : [-1, 1]\ny : [0, 1]\n"
                                           "[SYSTEM EQS]\n" +
                                           text + " = 0;\ny = x^2;"),
                   .over = {{"p", "-1", "1"}, {"q", "-1", "1"}}},
                  16);
    const check::MapReport report = result::verify(file);
    EXPECT_TRUE(report.complete()) << text << "\n" << result::to_table(report, file);
    for (const MapCellClaim& cell : file.claims.cells) {
      const double p = cell.sides[0].lo() + share(random) * cell.sides[0].width(),
                   q = cell.sides[1].lo() + share(random) * cell.sides[1].width();
      const auto inside = std::count_if(planted.begin(), planted.end(), [&](const std::array<int, 3>& f) {
        return std::fabs(f[0] + f[1] * p + f[2] * q) <= 10;
      });
      EXPECT_EQ(cell.count, inside) << text << " at " << p << ", " << q;
      several += inside > 1;
      ++confirmed;
    }
  }
  EXPECT_GT(confirmed, 200);
  EXPECT_GT(several, 100);
}

// What is verified as before, but for that there are no more.
void expect_open(const MapFile& file, std::size_t cells) {
  const check::MapReport report = result::verify(file);
  EXPECT_TRUE(report.verified()) << result::to_table(report, file);
  EXPECT_EQ(report.completed() + cells, report.cells.size());
  EXPECT_THAT(result::to_table(report, file), HasSubstr("verified, except for completeness"));
}

// Nothing speaks against it but the search.
TEST(MapFile, ThatHidesSolutionsIsNotComplete) {
  MapFile file = cubic();
  for (const std::size_t hidden : {std::size_t{0}, std::size_t{1}, std::size_t{2}}) {
    file = cubic();
    MapCellClaim& cell = file.claims.cells[first_with(file, 3)];
    cell.sheets.erase(cell.sheets.begin() + static_cast<std::ptrdiff_t>(hidden));
    --cell.count;
    expect_open(file, 1);
  }
  file = circles();
  file.claims.cells.clear();
  for (std::size_t c = 0; c < circles().claims.cells.size(); c += 3) file.claims.cells.push_back(circles().claims.cells[c]);
  const auto with = std::count_if(file.claims.cells.begin(), file.claims.cells.end(),
                                  [](const MapCellClaim& cell) { return cell.count > 0; });
  EXPECT_GT(with, 0);
  for (MapCellClaim& cell : file.claims.cells) cell.sheets.clear(), cell.count = 0;
  expect_open(file, static_cast<std::size_t>(with));
}

// Four solutions, each with a side of two others; the search divides y first.
TEST(MapFile, ThatHidesASolutionBesideOthersIsNotComplete) {
  const MapFile good =
      make_file({.question = question_of("[CONSTANTS]\na := 0\nb := 0\n[SYSTEM VARS]\nx : [-2, 2]\ny : [-2, "
                                         "2]\n[SYSTEM EQS]\nx^2 + x*y/100 = a;\n3*y^2 = 3*b;"),
                 .over = {{"a", "1", "2"}, {"b", "1", "2"}}},
                8);
  expect_complete(good);
  for (std::size_t hidden = 0; hidden < 4; ++hidden) {
    MapFile file = good;
    MapCellClaim& cell = file.claims.cells[hidden];
    ASSERT_EQ(cell.sheets.size(), 4U);
    cell.sheets.erase(cell.sheets.begin() + static_cast<std::ptrdiff_t>(hidden));
    --cell.count;
    expect_open(file, 1);
  }
}

// 36 solutions: more than the search of one cell by itself tells apart.
TEST(MapFile, OfManySolutionsIsSearchedInGroupsOfCells) {
  MapFile file = make_file({.question = question_of("[CONSTANTS]\na := 0\nb := 0\n[SYSTEM VARS]\nx : [-4, 4]\ny : [-4, "
                                                    "4]\n[SYSTEM EQS]\n(x^2 - 1)*(x^2 - 4)*(x^2 - 9) = a + y/100;\n(y^2 - "
                                                    "1)*(y^2 - 4)*(y^2 - 9) = b;"),
                            .over = {{"a", "0", "1"}, {"b", "0", "1"}}},
                           8);
  file.claims.cells.resize(9);
  for (const MapCellClaim& cell : file.claims.cells) ASSERT_EQ(cell.count, 36);
  expect_complete(file);
  EXPECT_GT(result::verify(file).boxes, 9 * 20U);
  for (const std::size_t c : {1, 4}) {
    MapCellClaim& cell = file.claims.cells[c];
    cell.sheets.erase(cell.sheets.begin() + static_cast<std::ptrdiff_t>(7 * c));
    --cell.count;
  }
  const check::MapReport report = result::verify(file);
  EXPECT_TRUE(report.verified());
  for (std::size_t c = 0; c < 9; ++c) EXPECT_EQ(report.cells[c].complete, c != 1 && c != 4);
}

// One root there is for every value, and two others meet within. Two others are there in one half of a cell.
TEST(MapFile, OfACellAcrossTheBoundaryIsNotComplete) {
  MapFile file = cubic();
  file.claims.cells = {{{Interval(-1, 0), Interval(-0.5, 0.5)}, 0, {}}};
  expect_open(file, 1);
  for (const char* right : {"a + b - 1", "1 - a - b"}) {
    file = make_file({.question = question_of(std::string("[CONSTANTS]\na := 0\nb := 0\n[SYSTEM VARS]\nx : [-2, 2]\n[SYSTEM "
                                                          "EQS]\nx^2 = ") +
                                              right + ";"),
                      .over = {{"a", "0", "1"}, {"b", "0", "1"}}},
                     8);
    file.claims.cells = {{{Interval(0, 1), Interval(0, 1)}, 0, {}}};
    expect_open(file, 1);
  }
}

struct MapChange {
  const char* name;
  std::function<void(MapFile&)> apply;
  const char* words;
};

TEST(MapFile, ThatSomebodyChangedIsRefused) {
  const auto three = [](MapFile& f) -> MapCellClaim& { return f.claims.cells[first_with(f, 3)]; };
  const auto shift = [](Box& box, double by) {
    for (std::size_t j = 0; j < box.size(); ++j)
      if (j < 1) box[j] = Interval(box[j].lo() + by, box[j].hi() + by);
  };
  const std::vector<MapChange> changes{
      {"a solution more", [&](MapFile& f) { ++three(f).count; }, "not have as many sheets"},
      {"a solution fewer", [&](MapFile& f) { --three(f).count; }, "not have as many sheets"},
      {"a solution twice",
       [&](MapFile& f) {
         MapCellClaim& cell = three(f);
         ++cell.count;
         cell.sheets.push_back(cell.sheets[0]);
       },
       "sheets 1 and 4 may be the same"},
      {"a sheet in place of another", [&](MapFile& f) { three(f).sheets[1] = three(f).sheets[2]; },
       "sheets 2 and 3 may be the same"},
      {"a sheet beside the set",
       [&](MapFile& f) {
         shift(three(f).sheets[0].box, 0.5);
         shift(three(f).sheets[0].region, 0.5);
       },
       "sheet 1: "},
      {"a box beside its solution", [&](MapFile& f) { shift(three(f).sheets[0].box, 1e-2); }, "sheet 1: "},
      {"a wider cell", [&](MapFile& f) { three(f).sides[0] = Interval(-2, 1); }, "a sheet is not over the cell"},
      {"a wider cell with its sheets",
       [&](MapFile& f) {
         MapCellClaim cell = three(f);
         cell.sides = {Interval(-2, 1), Interval(-1, 1)};
         for (MapSheet& sheet : cell.sheets)
           for (Box* box : {&sheet.box, &sheet.region}) (*box)[1] = cell.sides[0], (*box)[2] = cell.sides[1];
         f.claims.cells = {cell};
       },
       "sheet 1: "},
      {"a cell beyond the map", [&](MapFile& f) { f.claims.cells[0].sides[0] = Interval(-3, -2); }, "not within the map"},
      {"a cell twice", [&](MapFile& f) { f.claims.cells.push_back(f.claims.cells[0]); }, "it overlaps cell 1"},
      {"a smaller map", [&](MapFile& f) { f.family.over[0].upper = symbolic::Expression("1/2"); }, "not within the map"},
      {"a cell of one side", [&](MapFile& f) { f.claims.cells[0].sides.pop_back(); },
       "not have one side for each parameter"},
      {"a sheet with a side too few", [&](MapFile& f) { three(f).sheets[0].box.pop_back(); },
       "not have one side for each variable"},
      {"a negative number",
       [&](MapFile& f) {
         three(f).sheets.clear();
         three(f).count = -1;
       },
       "not have as many sheets"},
      {"a parameter is eliminated",
       [&](MapFile& f) {
         f.claims.reduction.emplace_back(Elimination{2, 0});
       },
       "reduction"},
      {"a reduction of nothing",
       [&](MapFile& f) {
         f.claims.reduction.emplace_back(SumOfEquations{0, 7, 1});
       },
       "reduction"},
  };
  for (const MapChange& change : changes) {
    SCOPED_TRACE(change.name);
    MapFile file = cubic();
    change.apply(file);
    const check::MapReport report = result::verify(file);
    EXPECT_FALSE(report.verified());
    EXPECT_FALSE(report.failures.empty());
    EXPECT_THAT(result::to_table(report, file), HasSubstr(change.words));
    EXPECT_THAT(result::to_table(report, file), EndsWith("NOT VERIFIED\n"));
  }
}

// The linear equation gives either unknown, or a parameter: that one must stay.
TEST(MapFile, WithAParameterEliminatedIsRefused) {
  MapFile file = make_file({.question = question_of("[CONSTANTS]\na := 0\nb := 0\n[SYSTEM VARS]\nx : [-1, 1]\n[SYSTEM EQS]\n"
                                                    "x + a + b = 0;"),
                            .over = {{"a", "-1", "1"}, {"b", "-1", "1"}}},
                           8);
  expect_complete(file);
  file.claims.reduction = {Elimination{1, 0}};
  for (MapCellClaim& cell : file.claims.cells) cell.count = 0, cell.sheets.clear();
  EXPECT_THAT(result::verify(file).failures, ElementsAre("the reduction eliminates a parameter"));
}

// Of a smaller domain fewer roots are solutions.
TEST(MapFile, WithRootsBeyondTheDomainIsRefused) {
  MapFile file = cubic();
  const std::string from = "x : [-4, 4]", to = "x : [-1, 1]";
  ASSERT_NE(file.model_text.find(from), std::string::npos);
  file.model_text.replace(file.model_text.find(from), from.size(), to);
  const check::MapReport report = result::verify(file);
  EXPECT_FALSE(report.verified());
  EXPECT_THAT(result::to_table(report, file), HasSubstr("the domain of x"));
}

TEST(MapFile, IsNotCheckedFurtherOnceStopped) {
  const std::atomic<bool> stop = true;
  check::Options options;
  options.ended = [&stop] { return stop.load(); };
  const check::MapReport report = result::verify(cubic(), options);
  EXPECT_TRUE(report.interrupted);
  EXPECT_FALSE(report.verified());
  EXPECT_THAT(result::to_table(report, cubic()), HasSubstr("nothing is said about the rest"));
}

}  // namespace
}  // namespace corank::analyze
