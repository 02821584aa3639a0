#include "corank/certify/meeting.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "corank/certify/numeric.h"
#include "corank/certify/projection.h"
#include "corank/core/box.h"
#include "corank/core/check.h"
#include "corank/core/dense.h"
#include "corank/core/rounding.h"

namespace corank::certify {
namespace {

constexpr double kRadius = 1e-10;  // of the scales

// The columns times the weights, then each row and its side divided by the row's largest entry: in no unit.
Eigen::MatrixXd weighted(Eigen::MatrixXd j, const Eigen::VectorXd& weights, Eigen::VectorXd* side = nullptr) {
  j *= weights.asDiagonal();
  for (Eigen::Index i = 0; i < j.rows(); ++i) {
    const double largest = j.row(i).cwiseAbs().maxCoeff();
    if (!(largest > 0)) continue;
    j.row(i) /= largest;
    if (side) (*side)(i) /= largest;
  }
  return j;
}

// The box holds its solutions still: a projection takes none away (projection.h). A variable with an equation of its own
// gets its value, without what rounding has added.
void keep_values(const CompiledSystem& system, Box& box) {
  std::vector<std::uint8_t> changed(box.size());
  Box kept = box;
  for (int row = 0; row < system.equations(); ++row)
    if (system.row_begin(row + 1) - system.row_begin(row) == 1 && !certify::project(system, row, kept, 0, changed.data()))
      return;
  box = std::move(kept);
}

}  // namespace

bool MeetingTest::project(const Box& within, std::vector<double>& c) {
  constexpr int kSteps = 8;
  constexpr double kSmall = 1e-13;
  const int m = system_.equations(), n = system_.variables();
  Eigen::VectorXd weights(n), f(m);
  for (int j = 0; j < n; ++j) weights(j) = within[j].width();
  for (const int j : system_.parameters()) weights(j) = 0;  // they keep their values
  for (int step = 0; step < kSteps; ++step) {
    for (int i = 0; i < m; ++i) f(i) = system_.evaluate_at(i, c.data()).mid();
    // The least change, in widths of the sides.
    const Eigen::MatrixXd slopes = weighted(approximate_jacobian(system_, c), weights, &f);
    const Eigen::VectorXd change = weights.asDiagonal() * least_squares(slopes, -f).x;
    if (!change.allFinite()) return false;
    double largest = 0;
    for (int j = 0; j < n; ++j) {
      c[j] += change(j);
      largest = std::max(largest, std::fabs(change(j)) / system_.scales()[j]);
    }
    if (largest < kSmall) break;
  }
  return contains(within, Box(c.begin(), c.end()));
}

Sheet MeetingTest::prove(std::vector<Interval> x, const std::vector<double>& c, const std::vector<double>& weights) {
  const int m = system_.equations();
  Eigen::VectorXd w = Eigen::Map<const Eigen::VectorXd>(weights.data(), weights.size());
  for (const int j : system_.parameters()) w(j) = 0;
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(weighted(approximate_jacobian(system_, c), w));
  if (qr.rank() < m) return {};
  std::vector<int> dependent;
  for (int a = 0; a < m; ++a) {
    const int k = qr.colsPermutation().indices()(a);
    const double r = std::max(kRadius * system_.scales()[k], 0.5 * x[k].width());
    x[k] = Interval(c[k] - r, c[k] + r);
    dependent.push_back(k);
  }
  system_.free_parameters(x);
  return newton_prove(system_, midpoint_preconditioner(system_, c, dependent), x, workspace_);
}

std::optional<Sheet> MeetingTest::sheet_in(const Box& box, const Box& near) {
  CORANK_CHECK(UpwardRounding::active());
  const bool has_one_value = std::ranges::any_of(box, [](const Interval& side) { return side.width() == 0; });
  // From the middle, then from points on the way to the ends of its sides.
  for (const double share : {0.5, 0.2, 0.8, 0.05, 0.95}) {
    std::vector<double> c;
    for (std::size_t j = 0; j < box.size(); ++j) {
      Interval side = near[j];
      if (!side.intersect(box[j])) side = box[j];
      c.push_back(std::clamp(side.lo() + share * side.width(), box[j].lo(), box[j].hi()));
    }
    if (!project(box, c)) continue;
    std::vector<double> widths;
    for (std::size_t j = 0; j < box.size(); ++j)
      widths.push_back(box[j].width() > 0 ? box[j].width() : kRadius * system_.scales()[j]);
    Sheet sheet = prove({c.begin(), c.end()}, c, widths);
    if (sheet.proven && has_one_value) keep_values(system_, sheet.image);
    if (sheet.proven && contains(box, sheet.image)) return sheet;
  }
  return std::nullopt;
}

std::optional<Box> MeetingTest::solution_in(const Box& box, const Box& near) {
  std::optional<Sheet> sheet = sheet_in(box, near);
  if (!sheet) return std::nullopt;
  return std::move(sheet->image);
}

Sheet MeetingTest::sheet_about(const Box& near, double radius) {
  CORANK_CHECK(UpwardRounding::active());
  std::vector<double> c = midpoint(near);
  const std::vector<double>& scales = system_.scales();
  const auto around = [&](double reach) {
    Box box;
    for (std::size_t j = 0; j < c.size(); ++j) box.emplace_back(c[j] - reach * scales[j], c[j] + reach * scales[j]);
    return box;
  };
  return project(around(1), c) ? prove(around(radius), c, scales) : Sheet();
}

std::optional<Sheet> MeetingTest::common(const Box& a, const Box& b, const Box& near) {
  Box common = a;
  return intersect(common, b) ? sheet_in(common, near) : std::nullopt;
}

}  // namespace corank::certify
