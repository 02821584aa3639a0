// Mechanisms whose cusps and nodes are known: maps of the plane with a normal form, between random affine maps.
#include <random>

#include "corank/tests/models/cusps/asking.h"

namespace corank::test {
namespace {

using symbolic::Expression;
using symbolic::Mechanism;

struct Affine {
  int a, b, c, d, e, f;  // tenths: (a x + b y + e, c x + d y + f)
  Affine(std::mt19937& random, int spread)
      : a(10 + tenths(random, spread)),
        b(tenths(random, spread)),
        c(tenths(random, spread)),
        d(10 + tenths(random, spread)),
        e(tenths(random, 5)),
        f(tenths(random, 5)) {}
  static int tenths(std::mt19937& random, int spread) { return std::uniform_int_distribution(-spread, spread)(random); }
  static Expression tenth(int n) { return Expression(n) / Expression(10); }
  Expression first(const Expression& x, const Expression& y) const { return tenth(a) * x + tenth(b) * y + tenth(e); }
  Expression second(const Expression& x, const Expression& y) const { return tenth(c) * x + tenth(d) * y + tenth(f); }
  std::array<double, 2> inverse(double x, double y) const {
    const double det = a * d - b * c, u = 10 * x - e, v = 10 * y - f;
    return {(d * u - b * v) / det, (a * v - c * u) / det};
  }
};

// (u, v) = P(W(A(x, y))), W(a, b) = (a, w(a, b)); the locked coordinates are u and v.
Mechanism composed(const Affine& inner, const Affine& outer, const std::string& w, bool forward) {
  Mechanism m("planted");
  const Expression x = m.length("x", -3, 3), y = m.length("y", -3, 3), a = m.length_without_range("a"),
                   b = m.length_without_range("b"), u = m.length_without_range("u"), v = m.length_without_range("v");
  m.constrain(a == inner.first(x, y));
  m.constrain(b == inner.second(x, y));
  m.constrain(u == outer.first(a, Expression(w)));
  m.constrain(v == outer.second(a, Expression(w)));
  m.inputs(forward ? std::vector{u, v} : std::vector{x, y});
  m.outputs(forward ? std::vector{x, y} : std::vector{u, v});
  return m;
}

struct Form {
  const char* w;
  std::vector<std::array<double, 2>> cusps;  // (a, b)
  std::vector<std::array<std::array<double, 2>, 2>> nodes;
};

// Whitney's cusp; a section of the swallowtail, with two cusps and a node: a = 2b − 4b³ on its locus.
const double kCuspB = 1 / std::sqrt(6.0), kNodeB = std::sqrt(0.5);
const std::array kForms{
    Form{"b^3 + a*b", {{0, 0}}, {}},
    Form{"b^4 - b^2 + a*b",
         {{2 * kCuspB - 4 * std::pow(kCuspB, 3), kCuspB}, {-2 * kCuspB + 4 * std::pow(kCuspB, 3), -kCuspB}},
         {{{{0, kNodeB}, {0, -kNodeB}}}}},
};

TEST(PlantedCusps, AreAllFoundAndNoOthers) {
  std::mt19937 random(17);
  for (const Form& form : kForms)
    for (int k = 0; k < 8; ++k) {
      const Affine inner(random, 4), outer(random, 4);
      std::vector<Place> expected;
      for (const auto& [a, b] : form.cusps) {
        const auto [x, y] = inner.inverse(a, b);
        expected.push_back({{"x", x}, {"y", y}});
      }
      const bool forward = k % 2 == 0;
      expect_points(ask(composed(inner, outer, form.w, forward),
                        forward ? SingularitySet::forward_cusps : SingularitySet::inverse_cusps),
                    expected);
    }
}

TEST(PlantedNodes, AreAllFoundOnceEachAndNoOthers) {
  std::mt19937 random(18);
  for (const Form& form : kForms)
    for (int k = 0; k < 6; ++k) {
      const Affine inner(random, 4), outer(random, 4);
      const bool forward = k % 2 == 0;
      const result::Result result = ask(composed(inner, outer, form.w, forward),
                                        forward ? SingularitySet::forward_nodes : SingularitySet::inverse_nodes);
      EXPECT_TRUE(result.cover.complete());
      EXPECT_EQ(result.cover.boxes.size(), form.nodes.size());
      for (const auto& node : form.nodes) {
        const auto [x, y] = inner.inverse(node[0][0], node[0][1]);
        const auto [x2, y2] = inner.inverse(node[1][0], node[1][1]);
        std::size_t n = 0;
        for (const CoverBox& point : result.cover.points) {
          EXPECT_EQ(point.verdict, Verdict::isolated);
          n += is_at(result, point, {{"x", x}, {"y", y}, {"x_2", x2}, {"y_2", y2}}, 1e-6);
          n += is_at(result, point, {{"x", x2}, {"y", y2}, {"x_2", x}, {"y_2", y}}, 1e-6);
        }
        EXPECT_EQ(n, 1u);
      }
    }
}

}  // namespace
}  // namespace corank::test
