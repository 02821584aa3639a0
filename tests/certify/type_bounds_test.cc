// Types of singularity from ranks over boxes: never claimed where they are not, whatever the matrices; and settled wherever
// the definition settles them at an exact point.
#include "corank/certify/type_bounds.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <random>

#include "corank/core/rounding.h"
#include "corank/tests/system_builder.h"

namespace corank::certify {
namespace {
using Eigen::MatrixXd;
using enum SingularityType;

constexpr double kZero = 1e-9;

int rank_of(const MatrixXd& m) {
  if (m.size() == 0) return 0;
  Eigen::ColPivHouseholderQR<MatrixXd> qr(m);
  qr.setThreshold(kZero);
  return static_cast<int>(qr.rank());
}

// L(x) = A + x B in small integers; columns: outputs, inputs, passive.
struct Family {
  MatrixXd a, b;
  int outputs, inputs, passive;
  MatrixXd at(double x) const { return a + x * b; }
  MatrixXd y(double x) const {
    MatrixXd m(a.rows(), outputs + passive);
    m << at(x).leftCols(outputs), at(x).rightCols(passive);
    return m;
  }
  MatrixXd z(double x) const { return at(x).rightCols(inputs + passive); }
  MatrixXd p(double x) const { return at(x).rightCols(passive); }
};

// By the definitions, not by the ranks that TypeBounds compares: kernel vectors, and what a block's columns span.
TypeSet types_at(const Family& f, double x) {
  const MatrixXd l = f.at(x);
  const auto kernel_has = [](const MatrixXd& m, int first, int count) {  // a kernel vector ≠ 0 among these components
    const Eigen::FullPivHouseholderQR<MatrixXd> qr(m.transpose());
    const MatrixXd q = qr.matrixQ();
    const MatrixXd kernel = q.rightCols(m.cols() - rank_of(m));
    return kernel.cols() > 0 && kernel.middleRows(first, count).norm() > kZero;
  };
  TypeSet types = 0;
  const auto set = [&types](SingularityType type, bool is) {
    if (is) types = static_cast<TypeSet>(types | bit(type));
  };
  set(ro, kernel_has(f.y(x), 0, f.outputs));
  set(ri, kernel_has(f.z(x), 0, f.inputs));
  set(rpm, rank_of(f.p(x)) < f.passive);
  set(iim, rank_of(l) < l.rows());
  const auto spans = [](const MatrixXd& m, const MatrixXd& columns) {
    for (int j = 0; j < columns.cols(); ++j) {
      MatrixXd more(m.rows(), m.cols() + 1);
      more << m, columns.col(j);
      if (rank_of(more) > rank_of(m)) return false;
    }
    return true;
  };
  set(ii, !spans(f.y(x), l.middleCols(f.outputs, f.inputs)));
  set(io, !spans(f.z(x), l.leftCols(f.outputs)));
  return types;
}

PolynomialMatrix polynomials(const Family& f, const std::vector<int>& columns) {
  PolynomialMatrix m{static_cast<int>(f.a.rows()), static_cast<int>(columns.size()), {}};
  for (int i = 0; i < f.a.rows(); ++i)
    for (const int j : columns) {
      std::vector<test::SystemBuilder::Term> terms;
      if (f.a(i, j) != 0) terms.push_back({std::to_string(static_cast<int>(f.a(i, j))), {}});
      if (f.b(i, j) != 0) terms.push_back({std::to_string(static_cast<int>(f.b(i, j))), {{0, 1}}});
      m.entries.push_back(test::SystemBuilder::polynomial(terms));
    }
  return m;
}

VelocityBlocks blocks_of(const Family& f) {
  VelocityBlocks blocks;
  std::vector<int> all, y, z, p;
  for (int j = 0; j < f.a.cols(); ++j) {
    all.push_back(j);
    if (j < f.outputs || j >= f.outputs + f.inputs) y.push_back(j);
    if (j >= f.outputs) z.push_back(j);
    if (j >= f.outputs + f.inputs) p.push_back(j);
  }
  blocks.matrices = {polynomials(f, all), polynomials(f, y), polynomials(f, z), polynomials(f, p), {}, {}};
  blocks.outputs = f.outputs;
  blocks.inputs = f.inputs;
  blocks.passive = f.passive;
  blocks.asked = blocks.of_set = kAllTypes;
  for (std::size_t b = 0; b < blocks.at_most.size(); ++b)
    blocks.at_most[b] = std::min(blocks.matrices[b].rows, blocks.matrices[b].columns);
  return blocks;
}

// A(0) has dependent rows and columns as often as not, so that all six types come about at x = 0.
Family planted(std::mt19937& random) {
  std::uniform_int_distribution<int> entry(-3, 3), size(1, 2), passive(1, 3);
  Family f{{}, {}, size(random), 0, passive(random)};
  f.inputs = f.outputs;
  const int columns = f.outputs + f.inputs + f.passive, rows = columns - f.outputs;
  const auto matrix = [&](int m, int n) -> MatrixXd { return MatrixXd::NullaryExpr(m, n, [&] { return entry(random); }); };
  f.a = matrix(rows, columns);
  f.b = matrix(rows, columns);
  if (entry(random) > 0) f.a.row(rows - 1) = f.a.row(0);
  if (entry(random) > 0) f.a.col(columns - 1).setZero();
  if (entry(random) > 0) f.a.col(0).setZero();
  if (entry(random) > 0) f.a.col(f.outputs) = f.a.col(0);
  if (entry(random) > 0 && rows > 1) f.a.row(1).tail(columns - f.outputs).setZero();
  if (entry(random) > 0 && f.passive > 1) f.a.col(columns - 2) = f.a.col(columns - 1);
  return f;
}

System of_one_length() {
  test::SystemBuilder builder;
  builder.variable("x", "-1", "1");
  return builder.system();
}

ExactPoint origin() {
  ExactPoint point;
  point.polynomial = {ExactNumber(0), ExactNumber(1)};
  point.lower = ExactNumber(-1);
  point.upper = ExactNumber(1);
  point.coordinates = {{ExactNumber(0)}};
  return point;
}

TEST(TypeBounds, SettleEveryPlantedExactPointAsTheDefinitionsDo) {
  std::mt19937 random(17);
  const System system = of_one_length();
  std::array<int, 6> seen{};
  for (int k = 0; k < 400; ++k) {
    const Family f = planted(random);
    const VelocityBlocks blocks = blocks_of(f);
    const TypeSet truth = types_at(f, 0);
    const TypeLabels labels = TypeBounds(system, blocks).at(origin());
    EXPECT_EQ(labels.proven, truth) << f.a;
    EXPECT_EQ(labels.excluded, kAllTypes & ~truth) << f.a;
    for (const SingularityType type : kSingularityTypes) seen[static_cast<std::size_t>(type)] += (truth & bit(type)) != 0;
  }
  for (const int n : seen) EXPECT_GT(n, 40);
}

TEST(TypeBounds, OfBoxesHoldAtAllTheirPointsAndLoseFew) {
  std::mt19937 random(18);
  std::uniform_real_distribution<double> center(-1, 1), radius(0, 0.02);
  const System system = of_one_length();
  int lost = 0, all = 0;
  for (int k = 0; k < 1500; ++k) {
    const Family f = planted(random);
    const VelocityBlocks blocks = blocks_of(f);
    const double c = k % 3 == 0 ? 0.01 * center(random) : center(random), r = radius(random);
    TypeLabels labels;
    {
      const UpwardRounding rounding;
      labels = TypeBounds(system, blocks).in({Interval(c - r, c + r)}, 4);
    }
    const bool has_origin = c - r <= 0 && c + r >= 0;
    std::vector<double> samples{c - r, c, c + r, c + 0.3 * r};
    if (has_origin) samples.push_back(0);
    for (const double x : samples) {
      const TypeSet truth = types_at(f, x);
      EXPECT_EQ(labels.proven & ~truth, 0) << "at " << x << " in [" << c - r << ", " << c + r << "]\n" << f.at(x);
      EXPECT_EQ(labels.excluded & truth, 0) << "at " << x << " in [" << c - r << ", " << c + r << "]\n" << f.at(x);
    }
    if (has_origin) continue;
    ++all;
    // Where no type holds anywhere the ranks are full, and that is what boxes can show.
    if (types_at(f, c) == 0) lost += !labels.settle(kAllTypes);
  }
  EXPECT_GT(all, 800);
  EXPECT_LT(lost, all / 10);
}

TEST(TypeBounds, DoNotSeeARankThatIsLowEverywhereUnlessTheyAreTold) {
  // Columns u, v, p: L = [x 1 1; 1 0 0], whose L_z = [1 1; 0 0] is singular everywhere.
  const Family f{(MatrixXd(2, 3) << 0, 1, 1, 1, 0, 0).finished(), (MatrixXd(2, 3) << 1, 0, 0, 0, 0, 0).finished(), 1, 1, 1};
  VelocityBlocks blocks = blocks_of(f);
  const System system = of_one_length();
  const UpwardRounding rounding;
  const Box box{Interval(-0.1, 0.1)};
  EXPECT_EQ(TypeBounds(system, blocks).in(box), (TypeLabels{0, bit(ro) | bit(rpm) | bit(ii) | bit(iim)}));
  blocks.at_most[static_cast<std::size_t>(Block::inverse)] = 1;
  EXPECT_EQ(TypeBounds(system, blocks).in(box), (TypeLabels{bit(ri) | bit(io), bit(ro) | bit(rpm) | bit(ii) | bit(iim)}));
}

TEST(TypeBounds, SayNothingOfTypesThatWereNotAskedFor) {
  const Family f{(MatrixXd(2, 3) << 0, 1, 1, 1, 0, 0).finished(), MatrixXd::Zero(2, 3), 1, 1, 1};
  VelocityBlocks blocks = blocks_of(f);
  blocks.asked = bit(iim);
  const System system = of_one_length();
  const UpwardRounding rounding;
  const TypeBounds bounds(system, blocks);
  EXPECT_EQ(bounds.in({Interval(-0.1, 0.1)}), (TypeLabels{0, bit(iim)}));
  EXPECT_EQ(bounds.at(origin()), (TypeLabels{0, bit(iim)}));
}

// Columns u, v, p: L = [0 1 x; 1 0 0]. Its L_y = [0 x; 1 0] is singular at x = 0, since the passive column is 0 there.
TEST(TypeBounds, LeaveOpenWhetherAKernelMovesTheOutputWhereThePassiveColumnsMayLoseRank) {
  const Family f{(MatrixXd(2, 3) << 0, 1, 0, 1, 0, 0).finished(), (MatrixXd(2, 3) << 0, 0, 1, 0, 0, 0).finished(), 1, 1, 1};
  VelocityBlocks blocks = blocks_of(f);
  blocks.at_most[static_cast<std::size_t>(Block::forward)] = 1;
  const System system = of_one_length();
  const UpwardRounding rounding;
  const TypeBounds bounds(system, blocks);
  const TypeLabels labels = bounds.in({Interval(-0.1, 0.1)}, 3);
  EXPECT_EQ(labels.proven & (bit(ro) | bit(rpm)), 0);
  EXPECT_EQ(labels.excluded & (bit(ro) | bit(rpm)), 0);
  EXPECT_EQ(labels.proven & (bit(ii) | bit(iim)), bit(ii)) << "the columns of u and v are independent";
  EXPECT_EQ(bounds.at(origin()).proven & (bit(ro) | bit(rpm) | bit(ii)), bit(rpm) | bit(ii));
}

TEST(TypeBounds, SayNothingOfAPointThatIsNotKnownWhole) {
  const Family f{(MatrixXd(2, 3) << 0, 1, 1, 1, 0, 0).finished(), (MatrixXd(2, 3) << 1, 0, 0, 0, 0, 0).finished(), 1, 1, 1};
  const VelocityBlocks blocks = blocks_of(f);
  const System system = of_one_length();
  ExactPoint point = origin();
  const UpwardRounding rounding;
  EXPECT_NE(TypeBounds(system, blocks).at(point), TypeLabels{});
  point.coordinates[0].clear();
  EXPECT_EQ(TypeBounds(system, blocks).at(point), TypeLabels{});
}

// Inputs v1, v2 with the tie v1' + x v2' = 0 in the first row: II asks for inputs that the tie allows only.
TEST(TypeBounds, CountTiesOfInputs) {
  VelocityBlocks blocks;
  const auto matrix = [](int rows, int columns, const std::vector<std::string>& entries) {
    PolynomialMatrix m{rows, columns, {}};
    for (const std::string& e : entries)
      m.entries.push_back(e == "x"   ? test::SystemBuilder::polynomial({{"1", {{0, 1}}}})
                          : e == "0" ? Polynomial{}
                                     : test::SystemBuilder::polynomial({{e, {}}}));
    return m;
  };
  // Columns u, v1, v2; rows: v1 + x v2 = 0, u = v1.
  blocks.matrices = {matrix(2, 3, {"0", "1", "x", "1", "-1", "0"}),
                     matrix(2, 1, {"0", "1"}),
                     matrix(2, 2, {"1", "x", "-1", "0"}),
                     {},
                     matrix(1, 2, {"1", "x"}),
                     {}};
  blocks.outputs = 1;
  blocks.inputs = 2;
  blocks.asked = blocks.of_set = kAllTypes;
  blocks.at_most = {2, 1, 2, 0, 1, 0};
  const System system = of_one_length();
  const UpwardRounding rounding;
  const TypeBounds bounds(system, blocks);
  EXPECT_TRUE(bounds.in({Interval(0.5, 0.6)}).excluded & bit(ii)) << "rk L_y + rk g_v = 1 + 1 = rk L";
  EXPECT_EQ(bounds.at(origin()).proven, bit(ri) | bit(io)) << "at x = 0 v2 is free, and moves alone; u = v1 = 0";
}

}  // namespace
}  // namespace corank::certify
