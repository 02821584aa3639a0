#include "corank/analyze/paths/solution_family.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "corank/certify/numeric.h"
#include "corank/core/box.h"
#include "corank/core/check.h"
#include "corank/core/dense.h"
#include "corank/core/rounding.h"

namespace corank::analyze {
namespace {

constexpr double kTiny = 1e-12;                 // about a point, for a proof to begin with
constexpr double kNarrowest = 1.0 / (1 << 12);  // of a cell, relative to the whole

}  // namespace

SolutionFamily::SolutionFamily(const System& system, std::vector<int> free)
    : system_(system), compiled_(system), free_(std::move(free)), dependent_(all_but(free_, system.size())) {
  CORANK_CHECK(static_cast<int>(dependent_.size()) == compiled_.equations());
}

bool SolutionFamily::approach(Values& x) const {
  constexpr int kSteps = 20;
  const UpwardRounding rounding;
  double before = HUGE_VAL;
  for (int step = 0; step < kSteps; ++step) {
    const Eigen::MatrixXd inverse = corank::inverse(certify::approximate_jacobian(compiled_, x)(Eigen::all, dependent_));
    Eigen::VectorXd f(compiled_.equations());
    for (int i = 0; i < compiled_.equations(); ++i) f(i) = compiled_.evaluate_at(i, x.data()).mid();
    const Eigen::VectorXd change = -inverse * f;
    if (!change.allFinite()) return false;
    double size = 0;
    for (std::size_t a = 0; a < dependent_.size(); ++a) {
      x[dependent_[a]] += change(static_cast<Eigen::Index>(a));
      size = std::max(size, std::fabs(change(static_cast<Eigen::Index>(a))) / system_.variables[dependent_[a]].size);
    }
    if (size < 1e-13 || (size < 1e-10 && size >= before / 2)) return true;
    before = size;
  }
  return false;
}

certify::Sheet SolutionFamily::prove(const Box& over, const Values& near) {
  const UpwardRounding rounding;
  Box x(over);
  for (const int j : dependent_) {
    const double room = kTiny * system_.variables[j].size;
    x[j] = Interval(near[j] - room, near[j] + room);
  }
  return newton_prove(compiled_, certify::midpoint_preconditioner(compiled_, near, dependent_), x, workspace_);
}

std::optional<Box> SolutionFamily::solution(const Box& at, const Values& near) {
  Values x = near;
  for (const int j : free_) x[j] = at[j].mid();
  if (!approach(x)) return std::nullopt;
  certify::Sheet sheet = prove(at, x);
  if (!sheet.proven) return std::nullopt;
  return std::move(sheet.image);
}

// The free variable over whose side the solution moves most, to first order; −1: all sides are as narrow as they may be.
int SolutionFamily::widest(const Box& over, const Values& at, const Box& whole) const {
  const Eigen::MatrixXd jacobian = certify::approximate_jacobian(compiled_, at);
  const Eigen::MatrixXd moves = inverse(jacobian(Eigen::all, dependent_)) * jacobian(Eigen::all, free_);
  int result = -1;
  double most = -1;
  for (std::size_t k = 0; k < free_.size(); ++k) {
    const int j = free_[k];
    if (!(over[j].width() > kNarrowest * whole[j].width())) continue;
    double effect = 0;
    for (std::size_t a = 0; a < dependent_.size(); ++a)
      effect += std::fabs(moves(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(k))) /
                system_.variables[dependent_[a]].size;
    effect = std::isfinite(effect) ? effect * over[j].width() : over[j].width() / whole[j].width();
    if (effect > most) most = effect, result = j;
  }
  return result;
}

bool SolutionFamily::cover(const Box& over, Values near, const std::function<bool(const Box& image)>& keeps,
                           std::vector<Cell>& cells, int& effort, const solve::Control& control) {
  return cover(over, near, over, keeps, cells, effort, control);
}

bool SolutionFamily::cover(const Box& over, const Values& near, const Box& whole,
                           const std::function<bool(const Box& image)>& keeps, std::vector<Cell>& cells, int& effort,
                           const solve::Control& control) {
  if (--effort < 0 || control.ended()) return false;
  Values middle = near;
  for (const int j : free_) middle[j] = over[j].mid();
  if (approach(middle)) {
    certify::Sheet sheet = prove(over, middle);
    if (sheet.proven && keeps(sheet.image)) {
      cells.push_back(std::move(sheet.region));
      return true;
    }
  } else {
    middle = near;
  }
  const int j = widest(over, middle, whole);
  if (j < 0) return false;
  const double at = over[j].mid();
  if (!(over[j].lo() < at && at < over[j].hi())) return false;
  Box half = over, side = over;
  half[j] = Interval(over[j].lo(), at);
  const std::size_t first = cells.size();
  if (!cover(half, middle, whole, keeps, cells, effort, control)) return false;
  half[j] = Interval(at, over[j].hi());
  const std::size_t second = cells.size();
  if (!cover(half, middle, whole, keeps, cells, effort, control)) return false;
  for (const int f : free_) side[f] = Interval(f == j ? at : over[f].mid());
  const std::optional<Box> shared = solution(side, middle);
  const std::span<const Cell> both(cells.begin() + static_cast<std::ptrdiff_t>(first), cells.end());
  return shared && holds(both.first(second - first), *shared) && holds(both.subspan(second - first), *shared);
}

bool holds(std::span<const SolutionFamily::Cell> cells, const Box& solution) {
  return std::ranges::any_of(cells, [&](const SolutionFamily::Cell& cell) { return contains(cell, solution); });
}

}  // namespace corank::analyze
