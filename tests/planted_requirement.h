// Random requirements on a matrix whose entries are affine in two offsets but for a small rest, and whether a matrix meets
// them, found without a proof.
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "corank/core/requirement.h"

namespace corank::test {

struct PlantedRequirement {
  struct Entry {
    double constant = 0, slopes[2] = {0, 0}, rest = 0;  // rest: at most that far from affine
  };

  Requirement requirement;
  std::vector<Entry> entries;  // of the variable of that index
  double width = 0;            // offsets are in [−width, width]

  explicit PlantedRequirement(unsigned seed) : random_(seed) {
    const int kernel = 1 + seed % 3, rows = 1 + static_cast<int>(random_() % 4);
    VelocityTest test;
    test.columns = rows + kernel;
    width = std::pow(10.0, number(-3, 0));
    for (int k = 0; k < rows * test.columns; ++k) {
      if (random_() % 5 == 0) {
        test.matrix.push_back({-1, static_cast<int>(random_() % 3) - 1});
        continue;
      }
      test.matrix.push_back({static_cast<int>(entries.size()), {}});
      entries.push_back({number(-1, 1), {number(-1, 1), number(-1, 1)}, random_() % 2 == 0 ? 0 : 0.1 * width * width});
    }
    const auto decimal = [&](double x) { return ExactNumber::rational(std::to_string(x)); };
    if (kernel == 1 && random_() % 2 == 0) {
      const int first = 1 + static_cast<int>(random_() % rows);
      test.groups.push_back({{}, decimal(number(0.1, 2))});
      for (int j = 0; j < first; ++j) test.groups[0].columns.push_back(j);
      if (first < rows) test.groups.push_back({{first}, decimal(number(0.1, 2))});
      test.bound = decimal(std::pow(10.0, number(-1, 1)));
      test.ends = 1 + static_cast<int>(random_() % std::min(3, test.columns - 1));
    } else {
      for (int j = 0; j < test.columns; ++j)
        test.form.push_back(j < kernel ? decimal(std::pow(10.0, number(-1, 2))) : ExactNumber(j % 2 == 0 ? -1 : 0));
    }
    requirement.tests.push_back(std::move(test));
  }

  double number(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random_); }

  /// Does it hold for random offsets and rests? Negative: it does not; by how much, relatively.
  double margin() {
    const VelocityTest& test = requirement.tests[0];
    const double offsets[2] = {at_random(), at_random()};
    Eigen::MatrixXd a(test.rows(), test.columns);
    for (int k = 0; k < static_cast<int>(test.matrix.size()); ++k) {
      const MatrixEntry& e = test.matrix[k];
      double value = e.number.enclose().mid();
      if (e.variable >= 0) {
        const Entry& entry = entries[e.variable];
        value = entry.constant + entry.slopes[0] * offsets[0] + entry.slopes[1] * offsets[1] + entry.rest * number(-1, 1);
      }
      a(k / test.columns, k % test.columns) = value;
    }
    const Eigen::MatrixXd kernel = Eigen::FullPivLU<Eigen::MatrixXd>(a).kernel();
    if (!test.form.empty()) {
      Eigen::VectorXd form(test.columns);
      for (int j = 0; j < test.columns; ++j) form(j) = test.form[j].enclose().mid();
      const Eigen::MatrixXd basis = Eigen::HouseholderQR<Eigen::MatrixXd>(kernel).householderQ() *
                                    Eigen::MatrixXd::Identity(kernel.rows(), kernel.cols());
      const Eigen::MatrixXd q = basis.transpose() * form.asDiagonal() * basis;
      return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(q).eigenvalues()(0) / form.cwiseAbs().maxCoeff();
    }
    const Eigen::VectorXd v = kernel.col(0).normalized();
    double sum = 0;
    for (const VelocityTest::Group& g : test.groups) sum += g.weight.enclose().mid() * Eigen::VectorXd(v(g.columns)).norm();
    return test.bound.enclose().mid() * v.tail(test.ends).lpNorm<1>() - sum;
  }

 private:
  // The ends more often than values between them.
  double at_random() { return random_() % 2 == 0 ? number(-width, width) : random_() % 2 == 0 ? width : -width; }

  std::mt19937 random_;
};

/// What first-order terms alone would wrongly show, by conditions of one kind each.
struct SecondOrderCase {
  VelocityTest test;
  std::vector<PlantedRequirement::Entry> entries;
  double width;
  Standing expected;
};

inline std::vector<SecondOrderCase> second_order_cases() {
  const PlantedRequirement::Entry first{0, {1, 0}, 0}, second{0, {0, 1}, 0}, beside_one{1, {1, 0}, 0};
  // x + δ1 y + δ2 z = 0, y² + z² − x² > 0: not at δ1 = δ2 = 0.8, where the diagonal is positive.
  const VelocityTest form{3, {{-1, 1}, {0, {}}, {1, {}}}, {-1, 1, 1}, {}, {}};
  // x = δ1 w, y = w: ‖(x, y)‖ < 1.05 |w| is √(1 + δ1²) < 1.05.
  const VelocityTest norm{
      3, {{-1, -1}, {-1, 0}, {0, {}}, {-1, 0}, {-1, -1}, {-1, 1}}, {}, {{{0, 1}, 1}}, ExactNumber::rational("1.05")};
  // (1 + δ1) x = y/2: |x| < 2 |y| is 1/2 < 2 (1 + δ1).
  const VelocityTest slow{2, {{0, {}}, {-1, ExactNumber::rational("-1/2")}}, {-1, 4}, {}, {}};
  // x = 1/2 + δ1, y = 1/10 + δ1: |x| < |y| at δ1 = −1, not at 0, though x − y = 2/5 everywhere.
  const VelocityTest turned{3, {{-1, 1}, {0, {}}, {-1, 0}, {-1, 0}, {1, {}}, {-1, 1}}, {}, {{{0}, 1}}, 1};
  const PlantedRequirement::Entry half{-0.5, {-1, 0}, 0}, tenth{-0.1, {-1, 0}, 0};
  return {{form, {first, second}, 0.8, Standing::open}, {form, {first, second}, 0.6, Standing::satisfied},
          {norm, {first}, 0.5, Standing::open},         {norm, {first}, 0.3, Standing::satisfied},
          {slow, {beside_one}, 0.9, Standing::open},    {slow, {beside_one}, 0.5, Standing::satisfied},
          {turned, {half, tenth}, 1, Standing::open},   {turned, {half, tenth}, 0.05, Standing::violated}};
}

/// How often `standing(planted)` was decided, and contradicted by a sample.
struct PlantedCount {
  int satisfied = 0, violated = 0, open = 0, contradicted = 0;
};

template <typename Planted, typename Decide>
PlantedCount count_planted(unsigned seeds, int samples, const Decide& standing) {
  PlantedCount count;
  for (unsigned seed = 0; seed < seeds; ++seed) {
    Planted planted(seed);
    const Standing claimed = standing(planted);
    ++(claimed == Standing::satisfied ? count.satisfied : claimed == Standing::violated ? count.violated : count.open);
    if (claimed == Standing::open) continue;
    for (int sample = 0; sample < samples; ++sample) {
      const double margin = planted.margin();
      if (claimed == Standing::satisfied ? margin < -1e-9 : margin > 1e-9) {
        ++count.contradicted;
        break;
      }
    }
  }
  return count;
}

}  // namespace corank::test
