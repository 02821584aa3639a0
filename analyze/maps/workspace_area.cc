#include "corank/analyze/maps/area_by_boundary.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <queue>

#include "corank/certify/domain.h"
#include "corank/certify/implied.h"
#include "corank/certify/newton.h"
#include "corank/certify/projection.h"
#include "corank/core/box.h"
#include "corank/core/check.h"
#include "corank/core/cover.h"
#include "corank/core/dense.h"
#include "corank/core/rounding.h"

namespace corank::analyze {
namespace {

using certify::CompiledSystem;
using certify::NewtonStep;
using certify::Preconditioner;

constexpr int kSweeps = 4, kSplits = 12, kSamples = 4, kIterations = 15;

/// With the configurations over it that are not excluded yet.
struct Cell {
  Interval x, y;
  std::vector<Box> left;
  double size() const { return x.width() * y.width(); }
  bool operator<(const Cell& other) const { return size() < other.size(); }
};

System with_implied_sides(System system) {
  const std::vector<certify::ImpliedSides> implied = certify::implied_domains(system);
  for (std::size_t j = 0; j < implied.size(); ++j) {
    system.variables[j].lower_implied = implied[j].lower;
    system.variables[j].upper_implied = implied[j].upper;
  }
  return system;
}

class Measure {
 public:
  Measure(System system, int x, int y)
      : system_(with_implied_sides(std::move(system))),
        compiled_(system_),
        domain_(system_),
        x_(x),
        y_(y),
        n_(system_.size()),
        m_(static_cast<int>(system_.equations.size())) {}

  Cell whole() {
    Cell cell{{}, {}, {system_.domain()}};
    const Box domain = system_.domain();
    for (const Interval& side : domain) widths_.push_back(side.width() > 0 ? side.width() : side.mag() > 0 ? side.mag() : 1);
    compiled_.set_scales(widths_);
    if (!contract(cell.left[0])) cell.left.clear();
    cell.x = cell.left.empty() ? domain[x_] : cell.left[0][x_];
    cell.y = cell.left.empty() ? domain[y_] : cell.left[0][y_];
    return cell;
  }

  enum class Finding { in, out, undecided };

  Finding examine(Cell& cell) {
    std::vector<Box> open;
    for (Box& box : cell.left)
      if (box[x_].intersect(cell.x) && box[y_].intersect(cell.y) && contract(box)) open.push_back(std::move(box));
    for (int k = 0; k < kSplits && !open.empty(); ++k) {
      const auto largest = std::ranges::max_element(open, [this](const Box& a, const Box& b) {
        return a[widest(a)].width() / widths_[widest(a)] < b[widest(b)].width() / widths_[widest(b)];
      });
      const int v = widest(*largest);
      const Interval side = (*largest)[v];
      const double middle = side.mid();
      if (!(side.lo() < middle && middle < side.hi())) break;
      Box upper = *largest;
      upper[v] = Interval(middle, side.hi());
      (*largest)[v] = Interval(side.lo(), middle);
      if (!contract(*largest)) open.erase(largest);
      if (contract(upper)) open.push_back(std::move(upper));
    }
    cell.left = std::move(open);
    if (cell.left.empty()) return Finding::out;
    const std::size_t samples = std::min<std::size_t>(kSamples, cell.left.size());
    for (std::size_t k = 0; k < samples; ++k)
      if (is_in(cell, cell.left[k * cell.left.size() / samples])) return Finding::in;
    return Finding::undecided;
  }

  /// In two, along the longer side.
  static std::array<Cell, 2> halves(Cell cell, double x_unit, double y_unit) {
    std::array<Cell, 2> parts{cell, cell};
    const bool across = cell.x.width() / x_unit >= cell.y.width() / y_unit;
    const Interval side = across ? cell.x : cell.y;
    const double middle = side.mid();
    (across ? parts[0].x : parts[0].y) = Interval(side.lo(), middle);
    (across ? parts[1].x : parts[1].y) = Interval(middle, side.hi());
    return parts;
  }

 private:
  // Of the coordinates beside the outputs, which are divided elsewhere.
  int widest(const Box& box) const {
    int best = n_;
    for (int j = 0; j < n_; ++j)
      if (j != x_ && j != y_ && (best == n_ || box[j].width() / widths_[j] > box[best].width() / widths_[best])) best = j;
    return best == n_ ? x_ : best;
  }

  // False: no configuration in the box.
  bool contract(Box& box) {
    std::vector<std::uint8_t> changed(n_);
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
      std::ranges::fill(changed, std::uint8_t{0});
      for (int row = 0; row < compiled_.rows(); ++row)
        if (!certify::project(compiled_, row, box, 0.1, changed.data())) return false;
      if (std::ranges::find(changed, 1) == changed.end()) break;
    }
    std::vector<double> middle = midpoint(box);
    const std::optional<Preconditioner> p = preconditioner(middle, true);
    if (!p) return true;
    const NewtonStep step(compiled_, *p, box, workspace_);
    if (step.outcome().empty) return false;
    return domain_.locate(compiled_, box) != certify::Location::outside;
  }

  Eigen::MatrixXd jacobian(const std::vector<double>& at) const {
    std::vector<double> entries(compiled_.entries());
    compiled_.approximate_jacobian(at.data(), entries.data());
    Eigen::MatrixXd j = Eigen::MatrixXd::Zero(m_, n_);
    for (int row = 0; row < m_; ++row)
      for (int k = compiled_.row_begin(row); k < compiled_.row_begin(row + 1); ++k) j(row, compiled_.column(k)) = entries[k];
    return j;
  }

  // As many dependent variables as equations; the outputs are none of them but where `any`. Any choice is valid.
  std::optional<Preconditioner> preconditioner(const std::vector<double>& at, bool any) const {
    Eigen::MatrixXd j = jacobian(at);
    if (!j.allFinite()) return std::nullopt;
    for (int v = 0; v < n_; ++v) j.col(v) *= !any && (v == x_ || v == y_) ? 0 : widths_[v];
    const Eigen::FullPivLU<Eigen::MatrixXd> lu(j);
    if (lu.rank() < m_) return std::nullopt;
    Preconditioner p;
    Eigen::MatrixXd block(m_, m_);
    for (int i = 0; i < m_; ++i) {
      p.equations.push_back(i);
      p.dependent.push_back(static_cast<int>(lu.permutationQ().indices()(i)));
      block.col(i) = j.col(p.dependent.back()) / widths_[p.dependent.back()];
    }
    const Eigen::MatrixXd y = inverse(block);
    if (!y.allFinite()) return std::nullopt;
    for (int i = 0; i < m_; ++i)
      for (int k = 0; k < m_; ++k) p.y.push_back(y(i, k));
    return p;
  }

  // Gauss–Newton steps of minimal norm with the outputs fixed; nothing is proven by them.
  std::optional<std::vector<double>> solution(std::vector<double> at) const {
    for (int k = 0; k < kIterations; ++k) {
      Eigen::VectorXd f(m_);
      for (int row = 0; row < m_; ++row) f[row] = compiled_.evaluate_at(row, at.data()).mid();
      Eigen::MatrixXd j = jacobian(at);
      if (!f.allFinite() || !j.allFinite()) return std::nullopt;
      for (int v = 0; v < n_; ++v) j.col(v) *= v == x_ || v == y_ ? 0 : widths_[v];
      const Eigen::VectorXd step = least_squares(j, f).x;
      double size = 0;
      for (int v = 0; v < n_; ++v) {
        at[v] -= widths_[v] * step[v] * (v == x_ || v == y_ ? 0 : 1);
        size = std::max(size, std::fabs(step[v]));
      }
      if (size < 1e-12) return at;
      if (!std::isfinite(size)) return std::nullopt;
    }
    return std::nullopt;
  }

  bool is_in(const Cell& cell, const Box& near) {
    std::vector<double> at = midpoint(near);
    at[x_] = cell.x.mid(), at[y_] = cell.y.mid();
    const auto sample = solution(at);
    if (!sample) return false;
    const std::optional<Preconditioner> p = preconditioner(*sample, false);
    if (!p) return false;
    // Free: the outputs in the cell, the others at the sample's values. Dependent: about as far as the cell moves them.
    Box box;
    for (const double value : *sample) box.emplace_back(value);
    box[x_] = cell.x, box[y_] = cell.y;
    const Eigen::MatrixXd j = jacobian(*sample);
    for (int a = 0; a < m_; ++a) {
      const int d = p->dependent[a];
      double radius = 1e-9 * widths_[d];
      for (const int v : {x_, y_}) {
        double slope = 0;
        for (int k = 0; k < m_; ++k) slope += p->y[a * m_ + k] * j(k, v);
        radius += std::fabs(slope) * box[v].width();
      }
      box[d] = Interval((*sample)[d] - radius, (*sample)[d] + radius);
      if (!box[d].is_bounded()) return false;
    }
    const certify::Sheet sheet = certify::newton_prove(compiled_, *p, box, workspace_);
    if (!sheet.proven || std::cmp_not_equal(sheet.equations.size(), m_)) return false;
    return domain_.locate(compiled_, sheet.image) == certify::Location::inside;
  }

  System system_;
  CompiledSystem compiled_;
  certify::DomainTest domain_;
  certify::NewtonWorkspace workspace_;
  const int x_, y_, n_, m_;
  std::vector<double> widths_;
};

}  // namespace

int membership(const System& configurations, int x, int y, const Interval& cell_x, const Interval& cell_y, int tries) {
  const UpwardRounding rounding;
  Measure measure(configurations, x, y);
  Cell cell = measure.whole();
  cell.x = cell_x;
  cell.y = cell_y;
  for (int k = 0; k < tries; ++k) {
    const Measure::Finding finding = measure.examine(cell);
    if (finding != Measure::Finding::undecided) return finding == Measure::Finding::in ? 1 : -1;
  }
  return 0;
}

AreaBounds workspace_area(const System& configurations, int x, int y, const AreaOptions& options) {
  CORANK_CHECK(x >= 0 && y >= 0 && x != y && x < configurations.size() && y < configurations.size() &&
               configurations.coefficient_tolerance == 0);
  const UpwardRounding rounding;
  Measure measure(configurations, x, y);
  const auto area = [](const Cell& c) {
    return (Interval(c.x.hi()) - Interval(c.x.lo())) * (Interval(c.y.hi()) - Interval(c.y.lo()));
  };
  AreaBounds bounds;
  Interval in;  // of the cells that are in
  std::priority_queue<Cell> open;
  Cell whole = measure.whole();
  const double x_unit = std::max(whole.x.width(), 1e-300), y_unit = std::max(whole.y.width(), 1e-300);
  double undecided = area(whole).hi();  // about; the bound is summed at the end
  if (!whole.left.empty()) open.push(std::move(whole));
  while (!open.empty()) {
    const double most = in.hi() + undecided;
    if (undecided <= options.share * most || bounds.cells >= options.max_cells || (options.stop && options.stop())) break;
    Cell cell = open.top();
    open.pop();
    undecided -= area(cell).hi();
    for (Cell& half : Measure::halves(std::move(cell), x_unit, y_unit)) {
      ++bounds.cells;
      switch (measure.examine(half)) {
        case Measure::Finding::in: in += area(half); break;
        case Measure::Finding::out: break;
        case Measure::Finding::undecided:
          undecided += area(half).hi();
          open.push(std::move(half));
          break;
      }
    }
  }
  Interval left;
  for (; !open.empty(); open.pop()) left += area(open.top());
  bounds.lo = std::max(0.0, in.lo());
  bounds.hi = (in + left).hi();
  return bounds;
}

}  // namespace corank::analyze
