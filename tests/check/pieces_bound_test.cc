// How many pieces there are at most: parts of cells, covers by cells, and counts, against planted truth.
#include "corank/check/pieces_bound.h"

#include <random>

#include "corank/check/piece_sheets.h"
#include "corank/check/sign_parts.h"
#include "corank/tests/check/covers.h"

namespace corank::check {
namespace {

using Part = SignParts::Part;

const char* const kPlane = "[SYSTEM VARS]\nx : [-1, 1]\ny : [-1, 1]\nz : [-4, 4]\n[SYSTEM EQS]\n";

// Functions of x and y.
std::vector<Row> functions(const std::vector<std::string>& texts) {
  std::string text = kPlane;
  for (const std::string& f : texts) text += f + " = 0;\n";
  std::vector<Row> rows;
  for (const Polynomial& f : plain(text).equations) rows.emplace_back(Terms(f, 0), std::vector<int>{0, 1, 2});
  return rows;
}

// The sheet z = x y / 4.
struct Sheet {
  explicit Sheet(const std::vector<std::string>& texts) : rows(functions(texts)) {}

  Part part(double x0, double x1, double y0, double y1, const std::vector<int>& signs, std::vector<int> over = {0, 1}) {
    free = std::move(over);
    SignCell cell = parts.cell(free, {Enclosure(x0, x1), Enclosure(y0, y1), Enclosure(-4, 4)});
    EXPECT_TRUE(parts.bound(cell, 3));
    return parts.part(cell, signs, SignParts::directions({2, 2}));
  }

  System system = plain(std::string(kPlane) + "z = x*y/4;\n");
  Problem problem{system, {}};
  std::vector<Row> rows;
  std::vector<int> free;
  SignParts parts{problem, rows};
};

TEST(SignParts, OfTwoIntervalsOnTheirBorderAreNotConnected) {
  Sheet arch({"y + 3*x^2 - 2"});
  EXPECT_EQ(arch.part(-1, 1, 0, 1, {1}), Part::unknown);     // left and right of the arch
  EXPECT_EQ(arch.part(-1, 1, 0, 1, {-1}), Part::connected);  // under it
  EXPECT_EQ(arch.part(0, 1, 0, 1, {1}), Part::connected);
  EXPECT_EQ(arch.part(-0.5, 0.5, 0, 1, {1}), Part::empty);
}

TEST(SignParts, ThatNothingLeadsOutOfAreUnknown) {
  Sheet disc({"1/10 - x^2 - y^2"});
  EXPECT_EQ(disc.part(-0.9, 0.8, -0.7, 0.9, {1}), Part::unknown);
  EXPECT_EQ(disc.part(-0.2, 0.2, 0.05, 1, {1}), Part::connected);
  EXPECT_EQ(disc.part(-0.2, 0.2, 0.05, 1, {-1}), Part::connected);
}

TEST(SignParts, OfCrossingLinesAreKnownByTheirSigns) {
  Sheet cross({"x + y/3", "y - x/5"});
  for (const int a : {-1, 1})
    for (const int b : {-1, 1}) EXPECT_EQ(cross.part(-0.5, 0.6, -0.4, 0.7, {a, b}), Part::connected);
  Sheet parallel({"x + y/3", "1/5 + x + y/3"});
  EXPECT_EQ(parallel.part(-0.5, 0.6, -0.4, 0.7, {1, 1}), Part::connected);
  EXPECT_EQ(parallel.part(-0.5, 0.6, -0.4, 0.7, {-1, -1}), Part::connected);
  EXPECT_EQ(parallel.part(-0.5, 0.6, -0.4, 0.7, {-1, 1}), Part::unknown);  // the strip: nothing leads out for both
  EXPECT_EQ(parallel.part(-0.5, 0.6, -0.4, 0.7, {1, -1}), Part::unknown);
}

// Here the Jacobian that counts is that along the sheet: z = x y / 4.
TEST(SignParts, FollowTheSheet) {
  Sheet slope({"z - x*y/4 + x/10 - 1/100"});
  EXPECT_EQ(slope.part(-1, 1, 0.5, 0.7, {1}), Part::connected);
  EXPECT_EQ(slope.part(0.2, 1, 0.5, 0.7, {-1}), Part::empty);
  EXPECT_EQ(slope.part(0.2, 1, 0.5, 0.7, {1}), Part::connected);
}

struct Quadric {
  std::array<int, 6> c{};  // quarters

  double operator()(double x, double y) const {
    return 0.25 * (c[0] + c[1] * x + c[2] * y + c[3] * x * x + c[4] * x * y + c[5] * y * y);
  }
  std::string text() const {
    const std::array terms{"", "*x", "*y", "*x^2", "*x*y", "*y^2"};
    std::string result;
    for (std::size_t k = 0; k < 6; ++k) result += (k > 0 ? " + (" : "(") + std::to_string(c[k]) + ")/4" + terms[k];
    return result;
  }
};

Quadric random_quadric(std::mt19937& random) {
  std::uniform_int_distribution<int> coefficient(-5, 5);
  Quadric q;
  for (int& c : q.c) c = coefficient(random);
  q.c[1] += q.c[1] == 0;
  return q;
}

// Connected groups of grid points of like signs: how many points each has. Those of a few may be a grid's artefact.
using Groups = std::map<std::vector<int>, std::vector<int>>;
Groups groups(const std::vector<Quadric>& f, const std::array<double, 4>& box, int rows) {
  std::vector<unsigned> signs;  // a bit for each function: is it positive?
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < rows; ++j) {
      const double x = box[0] + (i + 0.5) / rows * (box[1] - box[0]), y = box[2] + (j + 0.5) / rows * (box[3] - box[2]);
      unsigned bits = 0;
      for (std::size_t k = 0; k < f.size(); ++k)
        if (f[k](x, y) > 0) bits |= 1U << k;
      signs.push_back(bits);
    }
  std::vector<char> seen(signs.size(), 0);
  Groups result;
  for (std::size_t start = 0; start < signs.size(); ++start) {
    if (seen[start]) continue;
    std::vector<std::size_t> open{start};
    seen[start] = 1;
    int size = 0;
    while (!open.empty()) {
      const int p = static_cast<int>(open.back());
      open.pop_back();
      ++size;
      for (int i = std::max(p / rows - 1, 0); i <= std::min(p / rows + 1, rows - 1); ++i)
        for (int j = std::max(p % rows - 1, 0); j <= std::min(p % rows + 1, rows - 1); ++j) {
          const auto next = static_cast<std::size_t>(i * rows + j);
          if (seen[next] || signs[next] != signs[start]) continue;
          seen[next] = 1;
          open.push_back(next);
        }
    }
    std::vector<int> of;
    for (std::size_t k = 0; k < f.size(); ++k) of.push_back((signs[start] >> k & 1U) != 0 ? 1 : -1);
    result[of].push_back(size);
  }
  return result;
}

auto count_of_at_least(int least, const std::vector<int>& sizes) {
  return std::count_if(sizes.begin(), sizes.end(), [&](int size) { return size >= least; });
}

TEST(SignParts, OfRandomQuadricsAreThoseOfAGrid) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-1, 0.6), width(0.1, 0.9);
  int known = 0, lost = 0;
  for (int trial = 0; trial < 60; ++trial) {
    std::vector<Quadric> f{random_quadric(random)};
    if (trial % 2 == 1) f.push_back(random_quadric(random));
    std::vector<std::string> texts;
    for (const Quadric& q : f) texts.push_back(q.text());
    Sheet sheet(texts);
    const double x = place(random), y = place(random);
    const std::array box{x, std::min(1.0, x + width(random)), y, std::min(1.0, y + width(random))};
    const Groups there = groups(f, box, 150);
    for (int choice = 0; choice < 1 << f.size(); ++choice) {
      std::vector<int> signs;
      for (std::size_t k = 0; k < f.size(); ++k) signs.push_back((choice >> k & 1) != 0 ? 1 : -1);
      const auto found = there.find(signs);
      const Part part = sheet.part(box[0], box[1], box[2], box[3], signs);
      ++(part == Part::unknown ? lost : known);
      if (part == Part::empty) {
        EXPECT_EQ(found, there.end()) << trial;
      }
      if (part == Part::connected && found != there.end()) {
        EXPECT_LE(count_of_at_least(12, found->second), 1) << trial;
      }
    }
  }
  EXPECT_GT(known, 120);
  std::printf("%d parts known, %d not, 0 false\n", known, lost);
}

TEST(OpenParts, AreWhatBoxesLeave) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(0, 1);
  const FreeSides whole{Interval(0, 1), Interval(0, 1)};
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<FreeSides> boxes;
    for (int k = 0; k < 12; ++k) {
      const double x = place(random), y = place(random);
      boxes.push_back({Interval(x, x + 0.5 * place(random)), Interval(y - 0.5 * place(random), y)});
    }
    std::vector<const FreeSides*> list;
    for (const FreeSides& box : boxes) list.push_back(&box);
    const std::vector<FreeSides> open = open_parts(whole, list, {});
    const auto in = [](const FreeSides& box, double x, double y) { return box[0].contains(x) && box[1].contains(y); };
    for (int k = 0; k < 300; ++k) {
      const double x = place(random), y = place(random);
      const auto holds = [&](const FreeSides& box) { return in(box, x, y); };
      EXPECT_NE(std::any_of(boxes.begin(), boxes.end(), holds), std::any_of(open.begin(), open.end(), holds));
    }
  }
  const FreeSides left{Interval(0, 0.3), Interval(0, 1)}, right{Interval(0.3, 1), Interval(0, 1)},
      gap{Interval(std::nextafter(0.3, 1), 1), Interval(0, 1)};
  EXPECT_TRUE(open_parts(whole, {&left, &right}, {}).empty());
  EXPECT_EQ(open_parts(whole, {&left, &gap}, {}).size(), 1U);
  EXPECT_EQ(open_parts({Interval(0.5), Interval(0, 1)}, {&left}, {}).size(), 1U);
  EXPECT_TRUE(open_parts({Interval(0.3), Interval(0, 1)}, {&left}, {}).empty());
}

// The plane's square strictly within its sides, divided by quadrics; the cells come from random cuts.
struct CutPlane {
  PieceBound bound(const std::vector<Quadric>& f, const PieceProof& proof) const {
    std::vector<std::string> texts;
    for (const Quadric& q : f) texts.push_back(q.text());
    return bound_pieces(whole, whole, cover, functions(texts), proof, 1);
  }

  System system = plain(std::string(kPlane) + "z = x*y/4;\n");
  Problem whole{system, {}};
  Cover cover = [this] {
    Cover result;
    CoverBox box;
    box.box = {Interval(-1, 1), Interval(-1, 1), Interval(-0.5, 0.5)};
    box.verdict = Verdict::regular;
    box.free = {0, 1};
    box.region = 0;
    result.boxes = {box};
    result.regions = {box.box};
    result.dimension = 2;
    return result;
  }();
};

void cut(std::vector<PieceCell>& cells, const std::vector<Interval>& sides, int depth, std::mt19937& random) {
  if (depth == 0) return cells.push_back({0, sides});
  const std::size_t along = sides[0].width() > sides[1].width() ? 0 : 1;
  const double at = sides[along].lo() + std::uniform_real_distribution<double>(0.4, 0.6)(random) * sides[along].width();
  std::vector<Interval> half = sides;
  half[along] = Interval(sides[along].lo(), at);
  cut(cells, half, depth - 1, random);
  half[along] = Interval(at, sides[along].hi());
  cut(cells, half, depth - 1, random);
}

TEST(PieceBound, OfRandomQuadricsIsNeverTooSmall) {
  const CutPlane plane;
  std::mt19937 random(17);
  int bounded = 0, exact = 0;
  constexpr int kTrials = 30;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<Quadric> f{random_quadric(random)};
    if (trial % 2 == 1) f.push_back(random_quadric(random));
    PieceProof proof;
    cut(proof.cells, {Interval(-1, 1), Interval(-1, 1)}, 5, random);
    const PieceBound found = plane.bound(f, proof);
    std::ptrdiff_t pieces = 0;
    for (const auto& [signs, sizes] : groups(f, {-1, 1, -1, 1}, 300)) pieces += count_of_at_least(20, sizes);
    if (!found.at_most) continue;
    ++bounded;
    EXPECT_GE(*found.at_most, pieces) << trial << ": " << f.front().text();
    exact += *found.at_most == pieces;
  }
  EXPECT_GT(bounded, kTrials / 3);
  EXPECT_GT(exact, kTrials / 4);
  std::printf("%d bounds of %d planted numbers of pieces, %d exact, 0 too small\n", bounded, kTrials, exact);
}

// Two sheets that are the same: what the one's cells leave out the other's may hold, but not what both leave out.
TEST(PieceBound, FindsWhatIsLeftOutInOtherSheets) {
  CutPlane plane;
  plane.cover.boxes.push_back(plane.cover.boxes.front());
  const Quadric line{{0, 1, 0, 0, 0, 0}};
  std::mt19937 random(4);
  PieceProof proof;
  cut(proof.cells, {Interval(-1, 1), Interval(-1, 1)}, 4, random);
  for (std::size_t k = 0; k < 16; ++k) proof.cells.push_back({1, proof.cells[k].sides});
  for (const std::size_t k : {0U, 5U, 11U}) {
    PieceProof less = proof;
    less.cells.erase(less.cells.begin() + static_cast<std::ptrdiff_t>(16 + k));
    EXPECT_TRUE(plane.bound({line}, less).at_most);
    less.cells.erase(less.cells.begin() + static_cast<std::ptrdiff_t>(k));
    EXPECT_FALSE(plane.bound({line}, less).at_most);
  }
}

// Both cells have points on both sides of x = 0.
TEST(PieceBound, IsJoinedByLinksOfLikeSigns) {
  const CutPlane plane;
  const Quadric line{{0, 1, 0, 0, 0, 0}};
  PieceProof proof;
  const Interval left(-1, -0.5), middle(-0.5, 0.5), right(0.5, 1);
  for (const auto& [x, y] : {std::pair(middle, Interval(-0.5, 0)),
                             {middle, Interval(0, 0.5)},
                             {left, Interval(-1, 1)},
                             {right, Interval(-1, 1)},
                             {middle, left},
                             {middle, right}})
    proof.cells.push_back({0, {x, y}});
  for (const double x : {-0.25, 0.25, 2.0}) proof.links.push_back({{x, 0, 0}, {0, 1}});
  proof.links.push_back({{0.5, 0, 0}, {}});
  proof.links.push_back({{}, {0, 1}});
  const PieceBound found = plane.bound({line}, proof);
  EXPECT_EQ(found.at_most, 2);
  EXPECT_EQ(found.links, 2U);
}

// A disc of radius 1/2 about a cell's corner, and what is outside of it.
TEST(PieceBound, CountsADiscThatSeveralCellsHideTogether) {
  const CutPlane plane;
  const Quadric disc{{1, 0, 0, -4, 0, -4}};
  PieceProof proof;
  for (const double x : {-0.99, 0.01})
    for (const double y : {-0.98, 0.02})
      proof.cells.push_back({0, {Interval(x < 0 ? -1 : x, x < 0 ? 0.01 : 1), Interval(y < 0 ? -1 : y, y < 0 ? 0.02 : 1)}});
  const PieceBound found = plane.bound({disc}, proof);
  if (found.at_most) {
    EXPECT_GE(*found.at_most, 2) << found.reason;
  }
}

TEST(PieceBound, LooksForEveryCell) {
  const CutPlane plane;
  const Quadric line{{0, 1, 0, 0, 0, 0}};
  std::mt19937 random(2);
  PieceProof proof;
  cut(proof.cells, {Interval(-1, 1), Interval(-1, 1)}, 4, random);
  EXPECT_EQ(plane.bound({line}, proof).at_most, 2);
  for (std::size_t k = 0; k < proof.cells.size(); ++k) {
    PieceProof less = proof;
    less.cells.erase(less.cells.begin() + static_cast<std::ptrdiff_t>(k));
    EXPECT_FALSE(plane.bound({line}, less).at_most);
  }
}

}  // namespace
}  // namespace corank::check
