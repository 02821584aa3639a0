// Random systems that fall apart into groups over two parameters, with known zeros: none is lost, none is invented, and
// groups are found wherever variables and equations stand.
#include "corank/solve/step/product_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "corank/core/rounding.h"
#include "corank/tests/applied_steps.h"
#include "corank/tests/seeds.h"
#include "corank/tests/system_builder.h"

namespace corank::solve {
namespace {

using Point = std::vector<double>;

struct PlantedGroups {
  System system;
  std::vector<int> parameters;
  std::size_t groups = 0;
  bool ordered = false;  // the first two unknowns have a positive sum
  std::function<std::vector<Point>(double, double)> zeros;
};

// Groups x² = c + a p + b q and, of two unknowns, x² = c + a p + b q, y = x + b q; a third of the systems has one without a
// zero, x² + c + … = 0.
class GroupGenerator {
 public:
  explicit GroupGenerator(unsigned seed) : random_(seed) {}

  PlantedGroups run() {
    PlantedGroups planted;
    planted.groups = 1 + below(4);
    const bool impossible = below(3) == 0;
    struct Group {
      int x, y;
      int c, a, b;  // tenths
    };
    test::SystemBuilder builder;
    std::vector<Group> groups;
    const std::size_t before = below(planted.groups + 1);
    for (std::size_t g = 0; g <= planted.groups; ++g) {
      if (g == before)
        for (const char* name : {"p", "q"}) planted.parameters.push_back(builder.variable(name, "0", "1"));
      if (g == planted.groups) break;
      Group group{.x = builder.variable("x" + std::to_string(g), "-4", "4"), .y = -1, .c = 0, .a = 0, .b = 0};
      if (below(2) == 0) group.y = builder.variable("y" + std::to_string(g), "-6", "6");
      group.c = static_cast<int>((g == 1 ? 40 : 11) + below(10));
      group.a = static_cast<int>(1 + below(4)), group.b = static_cast<int>(1 + below(4));
      groups.push_back(group);
    }
    const int p = planted.parameters[0], q = planted.parameters[1];
    const auto tenths = [](int k) { return std::to_string(k) + "/10"; };
    std::vector<std::vector<test::SystemBuilder::Term>> rows;
    for (std::size_t g = 0; g < groups.size(); ++g) {
      const Group& it = groups[g];
      const int sign = impossible && g == 0 ? 1 : -1;
      rows.push_back(
          {{"1", {{it.x, 2}}}, {tenths(sign * it.c), {}}, {tenths(sign * it.a), {{p, 1}}}, {tenths(sign * it.b), {{q, 1}}}});
      if (it.y >= 0) rows.push_back({{"1", {{it.y, 1}}}, {"-1", {{it.x, 1}}}, {tenths(-it.b), {{q, 1}}}});
    }
    std::ranges::shuffle(rows, random_);
    for (const auto& row : rows) builder.equation(row);
    planted.ordered = planted.groups > 1 && below(2) == 0;
    if (planted.ordered) builder.at_least_zero({{"1", {{groups[0].x, 1}}}, {"1", {{groups[1].x, 1}}}});
    planted.system = builder.system();
    for (const int v : planted.parameters)
      planted.system.variables[v].lower_implied = planted.system.variables[v].upper_implied = true;
    planted.zeros = [groups, impossible, p, q, ordered = planted.ordered, n = planted.system.variables.size()](double at_p,
                                                                                                               double at_q) {
      std::vector<Point> all;
      if (impossible) return all;
      all.emplace_back(n);
      all[0][p] = at_p, all[0][q] = at_q;
      for (const Group& g : groups) {
        std::vector<Point> longer;
        for (const Point& point : all)
          for (const int sign : {-1, 1}) {
            Point& next = longer.emplace_back(point);
            next[g.x] = sign * std::sqrt(0.1 * (g.c + g.a * at_p + g.b * at_q));
            if (g.y >= 0) next[g.y] = next[g.x] + 0.1 * g.b * at_q;
          }
        all = std::move(longer);
      }
      if (ordered) std::erase_if(all, [&](const Point& z) { return z[groups[0].x] + z[groups[1].x] < 0; });
      return all;
    };
    return planted;
  }

  double uniform() { return std::uniform_real_distribution<double>(0, 1)(random_); }

 private:
  std::size_t below(std::size_t n) { return random_() % n; }
  std::mt19937 random_;
};

bool holds(const std::vector<Interval>& box, const Point& z) {
  for (std::size_t j = 0; j < z.size(); ++j)
    if (z[j] < box[j].lo() - 1e-9 || z[j] > box[j].hi() + 1e-9) return false;
  return true;
}

// Is it a combination of points of sheets?
bool is_known(const ProductProblem& product, const ProductCell& cell, const Point& z) {
  for (std::size_t g = 0; g < product.groups.size(); ++g) {
    Point own;
    for (const int v : product.groups[g].variables) own.push_back(z[v]);
    if (std::ranges::none_of(cell.parts[g].sheets, [&](const certify::Sheet& s) { return holds(s.image, own); }))
      return false;
  }
  return true;
}

TEST(ProductSearch, FindsAllCombinationsOfPlantedZeros) {
  int answered = 0;
  const unsigned cases = test::seeds(300);
  for (unsigned seed = 0; seed < cases; ++seed) {
    SCOPED_TRACE(seed);
    GroupGenerator generator(seed);
    const PlantedGroups planted = generator.run();
    certify::Reduction as_given = certify::apply(planted.system, {});
    const ProductProblem product(as_given, planted.parameters, 1);
    EXPECT_EQ(product.groups.size(), planted.groups);
    const Problem whole(planted.system, as_given, [] { return false; });
    const UpwardRounding rounding;
    ProductSearch search(product, whole);
    const Box all{Interval(0.0, 1.0), Interval(0.0, 1.0)};
    ProductCell coarse = search.whole(all, planted.system.domain());
    Control control;
    ASSERT_TRUE(search.refine(coarse, 0.5, 1000, control));
    const double p = 0.9 * generator.uniform(), q = 0.9 * generator.uniform();
    const Interval side_p(p, p + 0.1), side_q(q, q + 0.1);
    ProductCell cell = search.part(coarse, {side_p, side_q});
    ASSERT_TRUE(search.refine(cell, 0.01, 1000, control));
    const auto found = search.solutions(cell);
    for (int k = 0; k < 3; ++k) {
      const std::vector<Point> zeros = planted.zeros(p + 0.1 * generator.uniform(), q + 0.1 * generator.uniform());
      if (!found) {  // each zero is in an open box, or on known sheets
        const std::vector<Box> open = search.open(cell);
        for (const Point& z : zeros)
          EXPECT_TRUE(std::ranges::any_of(open, [&](const Box& x) { return holds(x, z); }) || is_known(product, cell, z));
        continue;
      }
      EXPECT_EQ(found->size(), zeros.size());
      for (const Point& z : zeros)
        EXPECT_EQ(std::ranges::count_if(*found, [&](const certify::Sheet& s) { return holds(s.image, z); }), 1);
    }
    answered += found.has_value();
  }
  EXPECT_GE(answered, static_cast<int>(cases * 9 / 10));
}

TEST(ProductSearch, IsOneGroupWhereEquationsAreShared) {
  test::SystemBuilder b;
  const int x = b.variable("x", "-2", "2"), y = b.variable("y", "-2", "2"), p = b.variable("p", "0", "1");
  b.equation({{"1", {{x, 2}}}, {"-1", {{p, 1}}}, {"-1", {}}}).equation({{"1", {{x, 1}, {y, 1}}}, {"-1", {}}});
  const auto groups = certify::independent_groups(b.system(), {p});
  ASSERT_EQ(groups.size(), 1U);
  EXPECT_EQ(groups[0].equations, (std::vector<int>{0, 1}));
}

TEST(ProductSearch, IsOneGroupWhereOneHasMoreEquationsThanUnknowns) {
  test::SystemBuilder b;
  const int x = b.variable("x", "-2", "2"), p = b.variable("p", "0", "1");
  b.variable("y", "-2", "2");
  b.equation({{"1", {{x, 2}}}, {"-1", {{p, 1}}}}).equation({{"1", {{x, 1}}}, {"-1", {{p, 1}}}});
  EXPECT_EQ(certify::independent_groups(b.system(), {p}).size(), 1U);
}

}  // namespace
}  // namespace corank::solve
