#include <algorithm>
#include <cmath>

#include "corank/solve/assembly.h"
#include "corank/solve/preconditioner.h"

namespace corank::solve {
namespace {

constexpr double kFragment = 0.85;  // of σ: a wider box is not worth an attempt
constexpr int kTightenings = 2;

class Merger {
 public:
  Merger(const Problem& problem, std::vector<Found*>& found, const Ended& ended)
      : problem_(problem),
        found_(found),
        ended_(ended),
        preconditioners_(problem.compiled, ended),
        removed_(found.size(), false) {}

  void run() {
    for (std::size_t i = 0; i < found_.size(); ++i)
      if (found_[i]->box.verdict == Verdict::regular && found_[i]->box.free.size() == 1 &&
          problem_.excess(found_[i]->box.box) <= kFragment)
        cells_.push_back({0, i});
    if (cells_.size() < 2) return;
    choose_axes();
    for (Cell& cell : cells_) cell.key = key_of(cell.index, 0, 0);
    std::sort(cells_.begin(), cells_.end(),
              [](const Cell& a, const Cell& b) { return a.key != b.key ? a.key < b.key : a.index < b.index; });
    std::vector<std::size_t> order;
    for (const Cell& cell : cells_) order.push_back(cell.index);
    std::sort(order.begin(), order.end());
    for (std::size_t i : order)
      while (!removed_[i] && grow(i)) {
      }
    std::size_t kept = 0;
    for (std::size_t i = 0; i < found_.size(); ++i)
      if (!removed_[i]) found_[kept++] = found_[i];
    found_.resize(kept);
  }

 private:
  struct Cell {
    long key;
    std::size_t index;
  };

  // The two variables that spread the boxes most, in their σ.
  void choose_axes() {
    const std::size_t n = problem_.compiled.variables();
    std::vector<double> spread(n);
    for (std::size_t j = 0; j < n; ++j) {
      double least = HUGE_VAL, greatest = -HUGE_VAL;
      for (const Cell& cell : cells_) {
        least = std::min(least, found_[cell.index]->box.box[j].lo());
        greatest = std::max(greatest, found_[cell.index]->box.box[j].lo());
      }
      spread[j] = (greatest - least) / problem_.sigma[j];
    }
    axes_[0] = std::max_element(spread.begin(), spread.end()) - spread.begin();
    spread[axes_[0]] = -1;
    axes_[1] = std::max_element(spread.begin(), spread.end()) - spread.begin();
  }

  // Boxes in one box of size σ have lower ends at most σ apart.
  long key_of(std::size_t i, long d0, long d1) const {
    constexpr long kStride = 1L << 30;
    const auto cell = [&](std::size_t axis) {
      return std::lround(std::floor(std::clamp(found_[i]->box.box[axis].lo() / problem_.sigma[axis], -5e8, 5e8)));
    };
    return (cell(axes_[0]) + d0) * kStride + cell(axes_[1]) + d1;
  }

  // Merges box i with one neighbour.
  bool grow(std::size_t i) {
    for (long d0 = -1; d0 <= 1; ++d0) {
      // Three neighbouring cells are one range of keys.
      const long first = key_of(i, d0, -1), last = key_of(i, d0, 1);
      auto at = std::lower_bound(cells_.begin(), cells_.end(), first, [](const Cell& c, long key) { return c.key < key; });
      for (; at != cells_.end() && at->key <= last; ++at) {
        const std::size_t j = at->index;
        if (is_over(ended_)) return false;
        if (j == i || removed_[j] || found_[i]->box.free != found_[j]->box.free) continue;
        if (!merge(*found_[i], found_[j]->box)) continue;
        found_[i]->leaves.insert(found_[i]->leaves.end(), found_[j]->leaves.begin(), found_[j]->leaves.end());
        removed_[j] = true;
        return true;
      }
    }
    return false;
  }

  // Puts the proven hull of both in a's place. False: there is none.
  bool merge(Found& found, const CoverBox& b) {
    const CoverBox& a = found.box;
    const auto& system = problem_.compiled;
    const std::size_t n = system.variables();
    Box hull(a.box.size());
    for (std::size_t j = 0; j < hull.size(); ++j) {
      if (!a.box[j].overlaps(b.box[j])) return false;
      hull[j] = Interval::hull(a.box[j], b.box[j]);
      if (hull[j].width() > problem_.sigma[j]) return false;
    }
    hull.resize(n);
    const std::vector<int> dependent = other_variables(a.free, system.variables());
    const auto& p = preconditioners_.at_midpoint(hull, &dependent);
    if (p.rank() < system.equations()) return false;
    certify::Sheet sheet = certify::newton_prove(system, p, hull, workspace_);
    if (!sheet.proven) return false;
    Box& image = sheet.image;
    certify::NewtonStep step = certify::tighten_sheet(system, p, image, workspace_);
    for (int k = 1; k < kTightenings; ++k) step = certify::tighten_sheet(system, p, image, workspace_);
    if (problem_.domain.locate_zeros(step, image) != certify::Location::inside) return false;
    problem_.append_values_at_zeros(step, image);
    if (problem_.excess(image) > 1) return false;
    problem_.append_values(sheet.region);
    found.region = std::make_shared<const Box>(std::move(sheet.region));
    found.box.box = std::move(image);
    return true;
  }

  const Problem& problem_;
  std::vector<Found*>& found_;
  const Ended& ended_;
  PreconditionerFactory preconditioners_;
  certify::NewtonWorkspace workspace_;
  std::vector<bool> removed_;
  std::vector<Cell> cells_;
  std::size_t axes_[2] = {0, 0};
};

}  // namespace

void merge_regular(const Problem& problem, std::vector<Found*>& found, const Ended& ended) {
  Merger(problem, found, ended).run();
}

}  // namespace corank::solve
