// Shapes of sets with ends that are known: pieces of spheres, tori and of a surface of genus two; and random ones, whose
// characteristic, boundary curves and components a triangulation counts.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <boost/pending/disjoint_sets.hpp>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <random>
#include <set>

#include "corank/analyze/topology/topology.h"
#include "corank/study/model.h"
#include "corank/symbolic/model/model_file.h"
#include "corank/tests/analyze/topologies.h"
#include "corank/tests/seeds.h"

namespace corank::analyze {
namespace {

using ::testing::ElementsAre;

std::string in_space(const std::string& x, const std::string& y, const std::string& z, const std::string& equations) {
  return "[SYSTEM VARS]\nx : " + x + "\ny : " + y + "\nz : " + z + "\n[SYSTEM EQS]\n" + equations;
}

const std::string kWide = "[-3, 3]";
const std::string kSphere = "x^2+y^2+z^2 = 1;\n";
const std::string kTorus = "(x^2+y^2+z^2+15/16)^2 = 4*(x^2+y^2);\n";  // radii 1 and 1/4

void expect_surface(const Topology& t, int euler, int boundary, int genus) {
  EXPECT_TRUE(t.with_ends) << t.reason;
  EXPECT_FALSE(t.smooth);
  EXPECT_TRUE(t.components.exact()) << t.components.reason;
  EXPECT_EQ(t.components.at_least, 1);
  EXPECT_EQ(t.euler_characteristic, euler);
  EXPECT_EQ(t.boundary, boundary);
  EXPECT_THAT(t.genus, ElementsAre(genus));
  EXPECT_EQ(t.heights.size(), 2u);
}

TEST(TopologyWithEnds, OfAHemisphereIsADisk) { expect_surface(of_text(in_space(kWide, kWide, "[0, 3]", kSphere)), 1, 1, 0); }

TEST(TopologyWithEnds, OfASphereBetweenTwoPlanesIsAnAnnulus) {
  expect_surface(of_text(in_space(kWide, kWide, "[-1/2, 1/3]", kSphere)), 0, 2, 0);
}

// Three arcs, three corners, one curve.
TEST(TopologyWithEnds, OfAnOctantOfTheSphereIsADisk) {
  expect_surface(of_text(in_space("[0, 3]", "[0, 3]", "[0, 3]", kSphere)), 1, 1, 0);
}

TEST(TopologyWithEnds, CountsTheHolesOfASphere) {
  expect_surface(of_text(in_space("[-4/5, 4/5]", "[-9/10, 3]", "[-3, 3]", kSphere)), -1, 3, 0);
}

TEST(TopologyWithEnds, KnowsATorusWithAWindow) {
  expect_surface(of_text(in_space(kWide, kWide, kWide, kTorus + "(x-1)^2+y^2+(z-1/4)^2 >= 1/25;\n")), -1, 1, 1);
}

TEST(TopologyWithEnds, KnowsHalfATorusInBothDirections) {
  expect_surface(of_text(in_space("[0, 3]", kWide, kWide, kTorus)), 0, 2, 0);
  const Topology rings = of_text(in_space(kWide, kWide, "[0, 3]", kTorus));
  EXPECT_EQ(rings.euler_characteristic, 0);
  EXPECT_EQ(rings.boundary, 2);
}

TEST(TopologyWithEnds, KnowsHalfASurfaceOfGenusTwo) {
  expect_surface(of_text(in_space(kWide, kWide, "[0, 3]", "(x^2*(1-x^2)-y^2)^2 + z^2 = 1/25;\n")), -1, 3, 0);
}

TEST(TopologyWithEnds, CountsTheComponentsOfWhatIsCutApart) {
  const Topology t = of_text(in_space("[-3, 3]", "[-3, 3]", "[-3, 3]", kSphere + "z^2 >= 1/4;\n"));
  EXPECT_EQ(t.euler_characteristic, 2);
  EXPECT_EQ(t.components.at_least, 2);
  EXPECT_TRUE(t.components.exact());
  EXPECT_EQ(t.boundary, 2);
}

TEST(TopologyWithEnds, TellsArcsFromClosedCurves) {
  const Topology t = of_text("[SYSTEM VARS]\nx : [-3, 2]\ny : [-2, 2]\n[SYSTEM EQS]\n(x^2+y^2-6)*(x^2+y^2-1) = 0;\n");
  ASSERT_TRUE(t.components.exact()) << t.components.reason;
  EXPECT_EQ(t.components.at_least, 4);
  EXPECT_EQ(t.euler_characteristic, 3);
}

// Of three dimensions: a quarter of the 3-sphere is a ball, and where x² + y² ≤ 1/2 it is a solid torus.
TEST(TopologyWithEnds, OfThreeDimensions) {
  const std::string vars = "[SYSTEM VARS]\nx : [0, 2]\ny : [0, 2]\nz : [-2, 2]\nw : [-2, 2]\n";
  const Topology ball = of_text(vars + "[SYSTEM EQS]\nx^2+y^2+z^2+w^2 = 1;\n");
  EXPECT_EQ(ball.euler_characteristic, 1) << ball.reason;
  const Topology ring = of_text(
      "[SYSTEM VARS]\nx : [-2, 2]\ny : [-2, 2]\nz : [-2, 2]\nw : [-2, 2]\n[SYSTEM EQS]\n"
      "x^2+y^2+z^2+w^2 = 1;\nx^2+y^2 <= 1/2;\n");
  EXPECT_EQ(ring.euler_characteristic, 0) << ring.reason;
}

std::string with_limits(std::string text, const std::string& end) {
  for (std::size_t at = 0; (at = text.find("END", at)) != std::string::npos;) text.replace(at, 3, end);
  return text;
}

// A limit that ends where an angle's sine is 0, at π or −π, is like one that ends just before: of a curve, of surfaces, one
// of them with corners there, and of three dimensions.
TEST(TopologyWithEnds, OfALimitAtAStraightAngle) {
  const std::string bars =
      "[SYSTEM VARS]\nt1 ~ [-pi, pi]\nt2 ~ [-pi, pi]\nt3 ~ [-pi, pi]\nt4 ~ [-pi, pi]\n[SYSTEM EQS]\n"
      "1*cos(t1)+1.5*cos(t2)=2+1.4*cos(t4)+1.3*cos(t3);\n1*sin(t1)+1.5*sin(t2)=1.4*sin(t4)+1.3*sin(t3);\n[LIMITS]\n";
  const std::string curve =
      "[SYSTEM VARS]\nt1 ~ [-pi, pi]\nt2 ~ [-pi, pi]\n[SYSTEM EQS]\ncos(t1)+1.5*cos(t2)=0;\n[LIMITS]\n";
  const std::string product = "[SYSTEM VARS]\nt ~ [-pi, pi]\nx : [-2, 2]\ny : [-2, 2]\nz : [-2, 2]\n[SYSTEM EQS]\n";
  struct Known {
    std::string text;
    int euler, components;
    std::optional<int> boundary;
  };
  for (const Known& k :
       {Known{curve + "t1 : [1, END]\n", 2, 2, {}}, Known{curve + "t1 : [-END, -1]\n", 2, 2, {}},
        Known{bars + "t1 : [2, 3]\nt4 : [1, END]\n", 1, 1, 1}, Known{bars + "t1 : [-3, -2]\nt4 : [-END, -1]\n", 1, 1, 1},
        Known{product + "x^2+y^2+z^2=1;\n[LIMITS]\nt : [1, END]\n", 2, 1, {}}})
    for (const char* end : {"pi", "(pi-1/1000)"}) {
      SCOPED_TRACE(with_limits(k.text, end));
      const Topology t = of_text(with_limits(k.text, end));
      EXPECT_TRUE(t.with_ends) << t.reason;
      EXPECT_EQ(t.euler_characteristic, k.euler);
      EXPECT_EQ(t.components.at_least, k.components);
      EXPECT_EQ(t.boundary, k.boundary);
    }
}

// No manifold with corners: an end that touches the sphere, one that passes through a corner, one that is there twice, one
// that is tangent to an edge.
TEST(TopologyWithEnds, SaysNothingOfWhatIsNoManifoldWithCorners) {
  for (const std::string& text : {in_space(kWide, kWide, kWide, kSphere + "3*x + 4*z + 5 >= 0;\n"),
                                  in_space("[0, 3]", "[0, 3]", kWide, kSphere + "x + y + z >= 1;\n"),
                                  in_space(kWide, kWide, "[0, 3]", kSphere + "z + x*z >= 0;\n"),
                                  in_space(kWide, kWide, "[0, 3]", kSphere + "2*z >= 0;\n"),
                                  in_space(kWide, kWide, "[0, 3]", kSphere + "x + z <= 1;\n")}) {
    SCOPED_TRACE(text);
    const Topology t = of_text(text);
    EXPECT_FALSE(t.with_ends);
    EXPECT_FALSE(t.euler_characteristic);
    EXPECT_FALSE(t.boundary);
    EXPECT_FALSE(t.reason.empty());
  }
}

// A range that the sphere does not reach is no end.
TEST(TopologyWithEnds, IsThatOfAClosedSurfaceWhereNoEndIsReached) {
  const Topology t = of_text(in_space(kWide, kWide, "[-10001/10000, 3]", kSphere + "x + y + z <= 2;\n"));
  EXPECT_TRUE(t.smooth) << t.reason;
  EXPECT_TRUE(t.ends.empty());
  EXPECT_EQ(t.euler_characteristic, 2);
  EXPECT_FALSE(t.boundary);
}

// Dextar between limits of its motors is cut off there, and so are the legs of a 3-RPR platform, in thousandths of its unit,
// too.
TEST(TopologyWithEnds, OfMechanismsWithLimits) {
  const auto model = [](const std::string& name, const std::vector<result::ConstantOverride>& constants) {
    SCOPED_TRACE(name);
    Topology t = of(study::read_model(std::string(CORANK_SOURCE_DIR) + "/models/" + name + ".cuik", constants).mechanism);
    EXPECT_FALSE(t.ends.empty());
    return t;
  };
  expect_surface(model("dextar_limits", {}), -1, 1, 1);
  const auto in_thousandths = model("planar/3rpr_innocenti", {{"a2", "15910"},
                                                              {"a3", "10000"},
                                                              {"d1", "17040"},
                                                              {"d2", "16540"},
                                                              {"d3", "20840"},
                                                              {"leg1", "14980"},
                                                              {"lower2", "1000"},
                                                              {"upper2", "35000"},
                                                              {"lower3", "1000"},
                                                              {"upper3", "35000"}});
  expect_surface(in_thousandths, -5, 5, 1);
  expect_surface(model("planar/3rpr", {{"lower1", "6/5"}, {"upper1", "6/5"}}), -1, 3, 0);
  if (test::long_run()) {
    expect_surface(model("planar/3rpr_innocenti", {}), -5, 5, 1);
    expect_surface(model("planar/3rpr", {{"lower1", "4/5"}, {"upper1", "4/5"}}), -2, 4, 0);
  }
  const Topology sliders = model("planar/five_bar_sliders", {});
  EXPECT_FALSE(sliders.smooth);
  EXPECT_TRUE(sliders.with_ends) << sliders.reason;
  EXPECT_TRUE(sliders.components.exact()) << sliders.components.reason;
  EXPECT_EQ(sliders.components.at_least, 2);
  EXPECT_EQ(sliders.euler_characteristic, 0);
  EXPECT_EQ(sliders.boundary, 4);
}

// The set {value ≥ 0} on a triangulated closed surface.
struct Triangulation {
  int vertices = 0;
  std::vector<std::array<int, 3>> triangles;
  std::vector<std::array<double, 3>> points;
  struct Edge {
    int p, q;
    std::size_t one, other;  // its triangles
  };
  std::vector<Edge> edges;

  void find_edges() {
    std::vector<std::vector<std::pair<int, std::size_t>>> first(points.size());  // of each edge's lower end: the other end
    for (std::size_t k = 0; k < triangles.size(); ++k)
      for (std::size_t i = 0; i < 3; ++i) {
        const auto [p, q] = std::minmax(triangles[k][i], triangles[k][(i + 1) % 3]);
        auto& from_p = first[static_cast<std::size_t>(p)];
        std::size_t n = 0;
        while (n < from_p.size() && from_p[n].first != q) ++n;
        if (n < from_p.size())
          edges.push_back({p, q, from_p[n].second, k});
        else
          from_p.emplace_back(q, k);
      }
  }
};

struct Count {
  int euler = 0, boundary = 0, components = 0;
  friend bool operator==(const Count&, const Count&) = default;
};

// Of the triangulation's part that the vertices inside span: the set contracts onto it where triangles are small. Boundary
// curves: triangles with vertices on both sides, joined over edges with ends on both sides.
Count count(const Triangulation& t, const std::function<double(const std::array<double, 3>&)>& value) {
  std::vector<bool> inside;
  for (const auto& p : t.points) inside.push_back(value(p) > 0);
  const auto in = [&](int v) { return static_cast<bool>(inside[static_cast<std::size_t>(v)]); };
  Count result;
  boost::disjoint_sets_with_storage<> parts(t.points.size()), strips(t.triangles.size());
  for (std::size_t v = 0; v < t.points.size(); ++v) parts.make_set(v), result.euler += inside[v];
  for (std::size_t k = 0; k < t.triangles.size(); ++k) strips.make_set(k);
  std::vector<std::size_t> mixed;
  for (std::size_t k = 0; k < t.triangles.size(); ++k) {
    const auto& [a, b, c] = t.triangles[k];
    const int within = in(a) + in(b) + in(c);
    result.euler += within == 3;
    if (within % 3 != 0) mixed.push_back(k);
  }
  for (const Triangulation::Edge& edge : t.edges) {
    if (in(edge.p) != in(edge.q)) strips.union_set(edge.one, edge.other);
    if (!in(edge.p) || !in(edge.q)) continue;
    --result.euler;
    parts.union_set(static_cast<std::size_t>(edge.p), static_cast<std::size_t>(edge.q));
  }
  std::set<std::size_t> classes;
  for (std::size_t v = 0; v < t.points.size(); ++v)
    if (inside[v]) classes.insert(parts.find_set(v));
  result.components = static_cast<int>(classes.size());
  classes.clear();
  for (const std::size_t k : mixed) classes.insert(strips.find_set(k));
  result.boundary = static_cast<int>(classes.size());
  return result;
}

Triangulation torus(int n) {
  Triangulation t;
  const double step = 2 * std::acos(-1.0) / n;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double u = (i + 0.3) * step, v = (j + 0.4) * step, r = 1 + 0.25 * std::cos(v);
      t.points.push_back({r * std::cos(u), r * std::sin(u), 0.25 * std::sin(v)});
      const auto at = [&](int a, int b) { return (a % n) * n + b % n; };
      t.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      t.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  t.find_edges();
  return t;
}

// Rings of n points between two poles.
Triangulation sphere(int n) {
  Triangulation t;
  const double pi = std::acos(-1.0);
  const int rings = n / 2;
  for (int i = 1; i < rings; ++i)
    for (int j = 0; j < n; ++j) {
      const double u = pi * i / rings, v = 2 * pi * (j + 0.3) / n;
      t.points.push_back({std::sin(u) * std::cos(v), std::sin(u) * std::sin(v), std::cos(u)});
    }
  const int north = static_cast<int>(t.points.size()), south = north + 1;
  t.points.push_back({0, 0, 1});
  t.points.push_back({0, 0, -1});
  for (int j = 0; j < n; ++j) {
    const int k = (j + 1) % n, last = (rings - 2) * n;
    t.triangles.push_back({north, j, k});
    t.triangles.push_back({south, last + k, last + j});
    for (int i = 0; i + 2 < rings; ++i) {
      t.triangles.push_back({i * n + j, i * n + n + j, i * n + n + k});
      t.triangles.push_back({i * n + j, i * n + n + k, i * n + k});
    }
  }
  t.find_edges();
  return t;
}

// Spheres and tori cut by one to three half-spaces or balls. No number may be wrong; few may be missing.
// CORANK_SURFACES=N: N of them.
TEST(TopologyWithEnds, OfRandomCutsOfSpheresAndToriIsTheOneOfATriangulation) {
  const char* asked = std::getenv("CORANK_SURFACES");
  const int all = asked ? std::atoi(asked) : test::long_run() ? 10 : 4;
  std::mt19937 random(20261122);
  const auto hundredths = [&](int least, int most) { return std::uniform_int_distribution<int>(least, most)(random); };
  const std::array coarse_surfaces{torus(200), sphere(200)}, fine_surfaces{torus(420), sphere(420)};
  int known = 0, counted = 0, compared = 0;
  for (int k = 0; k < all; ++k) {
    const bool round = k % 2 == 0;
    std::string text = round ? kSphere : kTorus;
    struct Cut {
      std::array<double, 3> a;
      double b;
      bool ball;
    };
    std::vector<Cut> cuts;
    for (int c = hundredths(1, 3); c > 0; --c) {
      const std::array<int, 3> a{hundredths(-100, 100), hundredths(-100, 100), hundredths(-100, 100)};
      const bool ball = hundredths(0, 2) == 0;
      const int b = ball ? hundredths(10, 120) : hundredths(-20, 60);
      const auto h = [](int x) { return "(" + std::to_string(x) + "/100)"; };
      if (ball)
        text += "(x-" + h(a[0]) + ")^2 + (y-" + h(a[1]) + ")^2 + (z-" + h(a[2]) + ")^2 >= " + h(b) + ";\n";
      else
        text += h(a[0]) + "*x + " + h(a[1]) + "*y + " + h(a[2]) + "*z + " + h(b) + " >= 0;\n";
      cuts.push_back({{a[0] / 100.0, a[1] / 100.0, a[2] / 100.0}, b / 100.0, ball});
    }
    const auto value = [&](const std::array<double, 3>& p) {
      double least = 1e9;
      for (const Cut& c : cuts) {
        double g = c.ball ? -c.b : c.b;
        for (std::size_t i = 0; i < 3; ++i) g += c.ball ? (p[i] - c.a[i]) * (p[i] - c.a[i]) : p[i] * c.a[i];
        least = std::min(least, g);
      }
      return least;
    };
    SCOPED_TRACE(text);
    const Count coarse = count(coarse_surfaces[round], value), fine = count(fine_surfaces[round], value);
    const Topology t = of_text(in_space(kWide, kWide, kWide, text));
    known += t.euler_characteristic.has_value();
    counted += t.boundary.has_value() || t.ends.empty();
    if (!(coarse == fine)) continue;  // something too small to see
    ++compared;
    EXPECT_LE(t.components.at_least, fine.components);
    EXPECT_GE(t.components.at_most.value_or(fine.components), fine.components);
    EXPECT_EQ(t.euler_characteristic.value_or(fine.euler), fine.euler);
    EXPECT_EQ(t.boundary.value_or(fine.boundary), fine.boundary);
    if (t.genus.size() == 1 && t.boundary) {
      EXPECT_EQ(2 - 2 * t.genus.front() - fine.boundary, fine.euler);
    }
  }
  RecordProperty("known", known);
  RecordProperty("counted", counted);
  RecordProperty("compared", compared);
  EXPECT_GE(10 * known, 9 * all);
  EXPECT_GE(10 * counted, 9 * all);
  EXPECT_GE(10 * compared, 8 * all);
}

}  // namespace
}  // namespace corank::analyze
