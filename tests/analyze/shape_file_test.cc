// A shape's file: what is written is read and verified; whatever is changed in it is found out, or the counts that are
// left are true all the same.
#include "corank/result/files/hdf5_file.h"
#include "corank/result/values/claim_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <map>
#include <random>

#include "corank/analyze/topology/topology.h"
#include "corank/study/model.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/tests/seeds.h"

namespace corank::analyze {
namespace {

using result::ShapeFile;
using ::testing::HasSubstr;

ShapeFile make_file(symbolic::Mechanism model) {
  const study::Question question{.model = std::move(model)};
  solve::Control control;
  TopologyOptions options;
  options.certificate = true;
  return to_file(question, topology(question, options, control));
}

ShapeFile of_text(const std::string& text) { return make_file(symbolic::parse_model(text, "m.cuik")); }

const ShapeFile& sphere() {
  static const ShapeFile file =
      of_text("[SYSTEM VARS]\nx : [-3, 3]\ny : [-3, 3]\nz : [-3, 3]\n[SYSTEM EQS]\nx^2+y^2+z^2 = 1;\n");
  return file;
}

// Two ovals that nearly touch.
const ShapeFile& ovals() {
  static const ShapeFile file =
      of_text("[SYSTEM VARS]\nx : [-3, 3]\ny : [-3, 3]\n[SYSTEM EQS]\n(x^2+y^2)^2 - 2*(x^2-y^2) = -1/1000;\n");
  return file;
}

const ShapeFile& slider() {
  static const ShapeFile file =
      make_file(study::read_model(std::string(CORANK_SOURCE_DIR) + "/models/three_slider.cuik").mechanism);
  return file;
}

TEST(ShapeFile, IsReadAsItWasWritten) {
  const std::string path = ::testing::TempDir() + "shape_file_test.h5";
  result::write_shape(path, slider());
  EXPECT_EQ(result::format_of(path), result::kShapeKind.format);
  const ShapeFile read = result::read_shape(path);
  EXPECT_EQ(read.model_text, slider().model_text);
  EXPECT_EQ(read.shape.at_most, slider().shape.at_most);
  EXPECT_EQ(read.shape.genus, slider().shape.genus);
  ASSERT_EQ(read.shape.links.size(), slider().shape.links.size());
  EXPECT_EQ(read.shape.links.back().point, slider().shape.links.back().point);
  EXPECT_EQ(read.shape.links.back().held, slider().shape.links.back().held);
  ASSERT_EQ(read.shape.bridges.size(), slider().shape.bridges.size());
  EXPECT_FALSE(read.shape.bridges.empty());
  EXPECT_EQ(read.shape.bridges.back().region, slider().shape.bridges.back().region);
  EXPECT_EQ(read.shape.space.regions, slider().shape.space.regions);
  EXPECT_TRUE(result::verify(read).complete());
}

TEST(ShapeFile, OfKnownShapesIsVerified) {
  for (const ShapeFile* file : {&sphere(), &ovals(), &slider()}) {
    const check::ShapeReport report = result::verify(*file);
    EXPECT_TRUE(report.complete()) << result::to_table(report, *file);
    EXPECT_EQ(report.at_least, file->shape.at_least);
    EXPECT_EQ(report.at_most, file->shape.at_most);
  }
}

// The C-space of a planar pentagon, a linkage like Dextar's.
TEST(ShapeFile, OfALinkageIsVerified) {
  const ShapeFile file = of_text(
      "[SYSTEM VARS]\nt0 ~ [-pi, pi]\nt1 ~ [-pi, pi]\nt2 ~ [-pi, pi]\nt3 ~ [-pi, pi]\n[SYSTEM EQS]\n"
      "100/100*cos(t0) + 101/100*cos(t1) + 202/100*cos(t2) + 303/100*cos(t3) = 404/100;\n"
      "100/100*sin(t0) + 101/100*sin(t1) + 202/100*sin(t2) + 303/100*sin(t3) = 0;\n");
  const check::ShapeReport report = result::verify(file);
  EXPECT_TRUE(report.complete()) << result::to_table(report, file);
  EXPECT_EQ(file.shape.genus, std::vector<int>{2});
}

TEST(ShapeFile, OfDextarIsVerified) {
  const ShapeFile file = make_file(study::read_model(std::string(CORANK_SOURCE_DIR) + "/models/dextar.cuik").mechanism);
  const check::ShapeReport report = result::verify(file);
  EXPECT_TRUE(report.complete()) << result::to_table(report, file);
  EXPECT_EQ(file.shape.genus, std::vector<int>{4});
}

// An arm's torus: its sheets' regions end at the same value of a joint where they touch, so that a solution is shown to lie
// in both only where that value is given.
TEST(ShapeFile, OfAnArmHoldsTheValuesInWhichSheetsTouch) {
  const ShapeFile file =
      make_file(study::read_model(std::string(CORANK_SOURCE_DIR) + "/models/serial/orthogonal_3r.cuik").mechanism);
  const Cover& space = file.shape.space;
  std::vector<std::vector<int>> free(space.regions.size());
  for (const CoverBox& box : space.boxes) free.at(box.region) = box.free;
  int touching = 0;
  for (const SheetLink& link : file.shape.links) {
    if (std::max<std::size_t>(link.first, link.second) >= free.size()) continue;  // a bridge's
    for (const int f : free[link.first]) {
      Interval common = space.regions[link.first][f];
      ASSERT_TRUE(common.intersect(space.regions[link.second][f]));
      if (common.lo() < common.hi()) continue;
      EXPECT_THAT(link.held, ::testing::Contains(f));
      ++touching;
    }
  }
  EXPECT_GT(touching, 0);
  if (!test::long_run()) return;
  EXPECT_TRUE(result::verify(file).complete());
}

TEST(ShapeFile, IsNotGivenOfASetWithAnEnd) {
  const study::Question question{
      .model = symbolic::parse_model("[SYSTEM VARS]\nx : [-3, 1/2]\ny : [-3, 3]\n[SYSTEM EQS]\nx^2+y^2 = 1;\n", "m.cuik")};
  solve::Control control;
  TopologyOptions options;
  options.certificate = true;
  EXPECT_EQ(topology(question, options, control).certificate, nullptr);
}

// y² = 1 − x in a strip that ends before the vertex: two arcs, written down by hand, in boxes that touch.
ShapeFile arcs() {
  ShapeFile file;
  file.model = "m";
  file.model_text = "[SYSTEM VARS]\nx : [-3, 99/100]\ny : [-3, 3]\n[SYSTEM EQS]\nx + y^2 = 1;\n";
  Cover& cover = file.shape.space;
  cover.dimension = 1;
  cover.sigma = {10, 10};
  const Interval x(-3, 0.99);
  cover.regions = {{x, {-2.1, 0}}, {x, {0, 2.1}}};
  for (int k = 0; k < 2; ++k) cover.boxes.push_back({cover.regions[static_cast<std::size_t>(k)], Verdict::regular, {0}, k});
  file.shape.at_least = file.shape.at_most.emplace(2);
  return file;
}

TEST(ShapeFile, TellsBoxesThatTouchApart) {
  const check::ShapeReport report = result::verify(arcs());
  EXPECT_TRUE(report.verified()) << result::to_table(report, arcs());
  EXPECT_EQ(report.at_least, 2);
  EXPECT_EQ(report.apart, 1U);
}

// They meet beyond the end of the range, which joins nothing inside; and no critical point says how many there are.
TEST(ShapeFile, ThatJoinsArcsBeyondTheEndOfARangeIsRefused) {
  ShapeFile file = arcs();
  file.shape.at_least = file.shape.at_most.emplace(1);
  file.shape.bridges = {{{1}, {{0.9, 1.1}, {-0.15, 0.15}}}};
  file.shape.links = {{0, 2, {1}, {0.9856, -0.12}}, {1, 2, {1}, {0.9856, 0.12}}};
  check::ShapeReport report = result::verify(file);
  EXPECT_FALSE(report.verified());
  EXPECT_THAT(report.failures, testing::ElementsAre(HasSubstr("violate the domain of x")));
  file = arcs();
  file.shape.euler_characteristic = 0;
  report = result::verify(file);
  EXPECT_THAT(report.failures, testing::ElementsAre(HasSubstr("may come to an end of x")));
}

// The arcs of a circle that a range cuts off are joined beyond its end, and not inside.
TEST(ShapeFile, ThatHasACutSetForAClosedOneIsRefused) {
  ShapeFile file = sphere();
  const std::string from = "z : [-3, 3]", to = "z : [-3, 9/10]";
  file.model_text.replace(file.model_text.find(from), from.size(), to);
  EXPECT_FALSE(result::verify(file).verified());
}

// Without the sheets of odd numbers, their boxes and their links, and without the proof that nothing is missing.
ShapeFile with_every_other_sheet(const ShapeFile& whole) {
  ShapeFile file = whole;
  Shape& s = file.shape;
  Cover& cover = s.space;
  const int sheets = static_cast<int>(cover.regions.size());
  const auto is_out = [&](int sheet) { return sheet < sheets && sheet % 2 != 0; };
  const auto renumber = [&](int& sheet) { sheet -= sheet < sheets ? sheet / 2 : sheets / 2; };
  std::erase_if(cover.boxes, [&](const CoverBox& box) { return is_out(box.region); });
  std::erase_if(s.links, [&](const SheetLink& link) { return is_out(link.first) || is_out(link.second); });
  for (CoverBox& box : cover.boxes) renumber(box.region);
  for (SheetLink& link : s.links) {
    renumber(link.first);
    renumber(link.second);
  }
  for (int sheet = sheets - 1; sheet >= 0; --sheet)
    if (is_out(sheet)) cover.regions.erase(cover.regions.begin() + sheet);
  cover.proof = nullptr;
  return file;
}

// What is left of the ovals hangs together nowhere, though two minima allow two components only.
TEST(ShapeFile, WhoseBoxesContradictItsCriticalPointsIsRefused) {
  const ShapeFile file = with_every_other_sheet(ovals());
  const check::ShapeReport report = result::verify(file);
  EXPECT_GT(report.at_least, report.at_most);
  EXPECT_EQ(report.at_most, 2);
  EXPECT_FALSE(report.verified());
  EXPECT_THAT(result::to_table(report, file),
              testing::AllOf(HasSubstr("they contradict each other"), HasSubstr("NOT VERIFIED")));
}

// One of a height's points is made a box along which there may be more, in all that the file says.
ShapeFile with_a_point_along_a_set() {
  ShapeFile file = sphere();
  HeightCover& height = file.shape.heights[0];
  Cover& cover = height.cover;
  CoverBox& box = cover.boxes[0];
  std::erase_if(cover.points, [&](const CoverBox& point) { return point.box == box.box; });
  cover.regions.erase(cover.regions.begin() + box.region);
  for (CoverBox* other : {&cover.boxes[1], &cover.points[0]}) other->region -= other->region > box.region ? 1 : 0;
  box.verdict = Verdict::undecided;
  box.reason = Reason::degenerate_set;
  box.region = -1;
  cover.proof = nullptr;
  file.shape.heights = {height};
  file.shape.euler_characteristic = 1;
  file.shape.genus.clear();
  return file;
}

TEST(ShapeFile, WhoseCriticalPointsMayLieAlongASetIsRefused) {
  for (const std::vector<int>& by_index : {std::vector<int>{1, 0, 0}, {0, 0, 1}}) {
    ShapeFile file = with_a_point_along_a_set();
    file.shape.heights[0].by_index = by_index;
    const check::ShapeReport report = result::verify(file);
    EXPECT_TRUE(report.heights.at(0).verified());
    EXPECT_FALSE(report.verified());
    EXPECT_THAT(report.failures, testing::ElementsAre("height 1, box 1: critical points along a set may lie in it"));
  }
}

// Nothing is claimed of the characteristic, and the first height has a point less.
ShapeFile without_a_critical_point(const ShapeFile& whole) {
  ShapeFile file = whole;
  file.shape.euler_characteristic.reset();
  file.shape.genus.clear();
  Cover& cover = file.shape.heights[0].cover;
  const CoverBox last = cover.boxes.back();
  cover.boxes.pop_back();
  cover.regions.erase(cover.regions.begin() + last.region);
  for (std::vector<CoverBox>* list : {&cover.boxes, &cover.points})
    for (CoverBox& box : *list) box.region -= box.region > last.region ? 1 : 0;
  std::erase_if(cover.points, [&](const CoverBox& point) { return point.box == last.box; });
  cover.proof = nullptr;
  return file;
}

// Refused for that reason where the numbers by index are those of the points that are left.
void expect_contradiction(ShapeFile file, std::size_t last_index) {
  const std::vector<int> all = file.shape.heights[0].by_index;
  int found = 0;
  for (const std::size_t index : {std::size_t{0}, last_index}) {
    std::vector<int>& by_index = file.shape.heights[0].by_index = all;
    --by_index[index];
    const check::ShapeReport report = result::verify(file);
    EXPECT_FALSE(report.verified());
    for (const std::string& f : report.failures)
      found += f.find("contradict each other, as some are missing") != std::string::npos;
  }
  EXPECT_EQ(found, 1);
}

// Each oval has a minimum and a maximum: without one of them a height contradicts that the set is closed.
TEST(ShapeFile, WhoseHeightLacksACriticalPointIsRefusedThoughNoCharacteristicIsClaimed) {
  ShapeFile file = without_a_critical_point(ovals());
  file.shape.heights.resize(1);
  expect_contradiction(file, 1);
}

TEST(ShapeFile, WhoseHeightsDifferIsRefusedThoughNoCharacteristicIsClaimed) {
  ASSERT_EQ(sphere().shape.heights.size(), 2U);
  expect_contradiction(without_a_critical_point(sphere()), 2);
}

struct ShapeChange {
  const char* name;
  const ShapeFile& (*of)();
  std::function<void(Shape&)> apply;
  const char* words;
};

TEST(ShapeFile, ThatSomebodyChangedIsRefused) {
  const std::vector<ShapeChange> changes{
      {"a component more", ovals, [](Shape& s) { ++s.at_least; }, "3 components are claimed"},
      {"two components of one, without a link", sphere,
       [](Shape& s) {
         s.links.clear();
         s.heights.clear();
         s.genus.clear();
         s.at_most.reset();
         s.euler_characteristic.reset();
         s.at_least = 2;
       },
       "2 components are claimed, 1 shown"},
      {"a component fewer", ovals, [](Shape& s) { s.at_most = 1; }, "at most 1 components are claimed"},
      {"another characteristic", sphere, [](Shape& s) { *s.euler_characteristic -= 2; }, "Euler characteristic 2"},
      {"a characteristic of a curve", ovals, [](Shape& s) { s.euler_characteristic = 2; }, "odd dimension"},
      {"a characteristic without a height", sphere, [](Shape& s) { s.heights.clear(), s.genus.clear(); }, "no height"},
      {"a handle", sphere, [](Shape& s) { s.genus = {1}; }, "the genus"},
      {"a second surface", sphere,
       [](Shape& s) {
         s.genus = {0, 0};
       },
       "the genus"},
      {"a genus of a curve", ovals,
       [](Shape& s) {
         s.genus = {0, 0};
       },
       "closed surfaces"},
      {"a maximum for a minimum", sphere,
       [](Shape& s) {
         s.heights[0].by_index = {2, 0, 0};
       },
       "numbers by index"},
      {"a critical point is dropped", sphere,
       [](Shape& s) {
         s.heights[0].cover.points.erase(s.heights[0].cover.points.begin());
         s.heights[0].by_index = {0, 0, 1};
       },
       "the list of points has no entry"},
      {"a link that names no sheet", sphere, [](Shape& s) { s.links[0].second = 1'000'000; },
       "names a sheet that does not exist"},
      {"a link that holds a variable twice", sphere, [](Shape& s) { s.links[0].held[1] = s.links[0].held[0]; },
       "holds a variable that does not exist, or one twice"},
      {"a link that holds too few", sphere, [](Shape& s) { s.links[0].held.pop_back(); },
       "the number of variables that it holds"},
      {"a link's point is moved away", sphere,
       [](Shape& s) { s.links[0].point[static_cast<std::size_t>(s.links[0].held[0])] += 0.5; }, "link 1"},
      {"a link between the ovals", ovals,
       [](Shape& s) {
         const SheetLink& first = s.links.front();
         for (std::size_t k = 0; k < s.space.boxes.size(); ++k)
           if ((s.space.boxes[k].box[0].mid() > 0) != (first.point[0] > 0)) {
             s.links.push_back(first);
             s.links.back().second = s.space.boxes[k].region;
             return;
           }
       },
       "both sheets"},
      {"a sheet as wide as both ovals", ovals,
       [](Shape& s) {
         s.space.regions[0] = {{-1.5, 1.5}, {-1, 1}};
       },
       "box 1"},
      {"a bridge that is not a sheet", slider,
       [](Shape& s) {
         s.bridges[0].region[0] = {-0.9, 0.9};
       },
       "sheet 13"},
      {"a box that is not regular", sphere, [](Shape& s) { s.space.boxes[0].verdict = Verdict::boundary; }, "not regular"}};
  for (const ShapeChange& change : changes) {
    SCOPED_TRACE(change.name);
    ShapeFile file = change.of();
    change.apply(file.shape);
    const check::ShapeReport report = result::verify(file);
    EXPECT_FALSE(report.verified());
    std::string all;
    for (const std::string& f : report.failures) all += f + "\n";
    for (const check::Report& r : report.heights)
      for (const check::Failure& f : r.failures) all += f.reason + "\n";
    EXPECT_THAT(all, HasSubstr(change.words));
  }
}

TEST(ShapeFile, WithoutAProofOfCompletenessIsNotShownComplete) {
  for (const bool of_space : {true, false}) {
    ShapeFile file = sphere();
    (of_space ? file.shape.space : file.shape.heights[0].cover).proof = nullptr;
    const check::ShapeReport report = result::verify(file);
    EXPECT_TRUE(report.verified());
    EXPECT_FALSE(report.complete());
    EXPECT_THAT(result::to_table(report, file), HasSubstr("verified, except for completeness"));
  }
}

// Changes one thing, whatever it is. What is still confirmed has to be true.
class Damage {
 public:
  explicit Damage(unsigned seed) : random_(seed) {}

  std::string apply(Shape& s) {
    const auto number = below(kinds().size());
    kinds()[number].second(*this, s);
    return kinds()[number].first;
  }

 private:
  using Kind = std::pair<const char*, std::function<void(Damage&, Shape&)>>;

  std::size_t below(std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random_); }
  template <class List>
  auto& any(List& items) {
    return items[below(items.size())];
  }
  double small() { return std::array{-1e-1, -1e-3, -1e-9, 1e-9, 1e-3, 1e-1}[below(6)]; }
  int one() { return below(2) == 0 ? 1 : -1; }
  void move(Interval& side) {
    const double a = side.lo() + (below(2) == 0 ? small() : 0), b = side.hi() + (below(2) == 0 ? small() : 0);
    side = Interval(std::min(a, b), std::max(a, b));
  }
  static void erase(auto& items, std::size_t k) { items.erase(items.begin() + static_cast<std::ptrdiff_t>(k)); }

  static const std::vector<Kind>& kinds() {
    static const std::vector<Kind> list{
        {"at_least", [](Damage& d, Shape& s) { s.at_least += d.one(); }},
        {"at_most", [](Damage& d, Shape& s) { *s.at_most += d.one(); }},
        {"characteristic", [](Damage& d, Shape& s) { *s.euler_characteristic += 2 * d.one(); }},
        {"genus", [](Damage& d, Shape& s) { s.genus.empty() ? s.genus.push_back(0) : void(d.any(s.genus) += 1); }},
        {"index", [](Damage& d, Shape& s) { d.any(d.any(s.heights).by_index) += d.one(); }},
        {"index moved",
         [](Damage& d, Shape& s) {
           auto& numbers = d.any(s.heights).by_index;
           std::swap(numbers.front(), numbers[1 + d.below(numbers.size() - 1)]);
         }},
        {"height", [](Damage& d, Shape& s) { d.any(s.heights).height += 1; }},
        {"critical point dropped",
         [](Damage& d, Shape& s) {
           HeightCover& h = d.any(s.heights);
           const std::size_t k = d.below(h.cover.points.size());
           erase(h.cover.points, k);
           if (d.below(2) == 0) erase(h.cover.boxes, std::min(k, h.cover.boxes.size() - 1));
           h.by_index[d.below(h.by_index.size())] -= 1;
         }},
        {"critical point moved",
         [](Damage& d, Shape& s) {
           auto& p = d.any(d.any(s.heights).cover.points);
           d.move(d.any(p.box));
         }},
        {"box dropped", [](Damage& d, Shape& s) { erase(s.space.boxes, d.below(s.space.boxes.size())); }},
        {"box moved", [](Damage& d, Shape& s) { d.move(d.any(d.any(s.space.boxes).box)); }},
        {"region moved", [](Damage& d, Shape& s) { d.move(d.any(d.any(s.space.regions))); }},
        {"region of another box",
         [](Damage& d, Shape& s) { d.any(s.space.boxes).region = static_cast<int>(d.below(s.space.regions.size())); }},
        {"free variable",
         [](Damage& d, Shape& s) {
           d.any(s.space.boxes).free.front() = static_cast<int>(d.below(s.space.boxes[0].box.size()));
         }},
        {"link dropped", [](Damage& d, Shape& s) { erase(s.links, d.below(s.links.size())); }},
        {"link to another sheet",
         [](Damage& d, Shape& s) {
           auto& link = d.any(s.links);
           (d.below(2) == 0 ? link.first : link.second) = static_cast<int>(d.below(s.space.regions.size()));
         }},
        {"link's point", [](Damage& d, Shape& s) { d.any(d.any(s.links).point) += d.small(); }},
        {"link's held variable",
         [](Damage& d, Shape& s) {
           auto& link = d.any(s.links);
           link.held.front() = static_cast<int>(d.below(link.point.size()));
         }},
        {"link of two components, and one fewer claimed",
         [](Damage& d, Shape& s) {
           s.links.push_back(d.any(s.links));
           s.links.back().second = static_cast<int>(d.below(s.space.regions.size()));
           *s.at_most -= 1;
           s.at_least = std::min(s.at_least, *s.at_most);
         }},
        {"bridge",
         [](Damage& d, Shape& s) {
           if (s.bridges.empty()) {
             s.bridges.push_back({s.space.boxes[0].free, s.space.regions[0]});
             s.links.push_back(d.any(s.links));
             s.links.back().second = static_cast<int>(s.space.regions.size());
             *s.at_most -= 1;
           }
           for (Interval& side : d.any(s.bridges).region) side = Interval(side.lo() - 1, side.hi() + 1);
         }},
        {"proof's step", [](Damage& d, Shape& s) {
           Cover& cover = d.below(2) == 0 ? s.space : d.any(s.heights).cover;
           auto proof = std::make_shared<Proof>(*cover.proof);
           d.any(proof->steps) ^= 1;
           cover.proof = proof;
         }}};
    return list;
  }

  std::mt19937 random_;
};

bool is_true(const Shape& claimed, const Shape& truth) {
  return claimed.at_least <= truth.at_least && claimed.at_most.value_or(1 << 30) >= *truth.at_most &&
         (!claimed.euler_characteristic || claimed.euler_characteristic == truth.euler_characteristic) &&
         (claimed.genus.empty() || claimed.genus == truth.genus);
}

TEST(ShapeFile, ThatIsDamagedAtRandomClaimsNothingFalse) {
  int refused = 0, weaker = 0, count = 0;
  std::map<std::string, int> refused_of;
  for (const ShapeFile* good : {&sphere(), &ovals(), &slider()})
    for (unsigned seed = 0; seed < test::seeds(50); ++seed, ++count) {
      ShapeFile file = *good;
      const std::string kind = Damage(seed).apply(file.shape);
      SCOPED_TRACE(kind + ", " + std::to_string(seed));
      const check::ShapeReport report = result::verify(file);
      if (!report.complete()) {
        ++refused;
        ++refused_of[kind];
        continue;
      }
      ++weaker;
      EXPECT_TRUE(is_true(file.shape, good->shape)) << result::to_table(report, file);
    }
  EXPECT_GT(refused, count / 2);
  // What moves a claim the wrong way half of the time, or takes away what it rests on.
  for (const char* kind :
       {"at_least", "at_most", "characteristic", "genus", "index", "critical point dropped", "box dropped"})
    EXPECT_GT(refused_of[kind], 0) << kind;
  RecordProperty("refused", refused);
  RecordProperty("true_all_the_same", weaker);
  std::printf("%d damages: %d refused, %d true all the same\n", count, refused, weaker);
}

}  // namespace
}  // namespace corank::analyze
