#include "corank/analyze/clearance/best_center.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <queue>

#include "corank/core/box.h"
#include "corank/core/rounding.h"

namespace corank::analyze {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kFinest = 1e-6;  // of the region's sides: cells are not divided further

struct Cell {
  double bound;
  Box x;
  bool operator<(const Cell& other) const { return bound < other.bound; }
};

class Search {
 public:
  Search(CenterField& field, const BestOptions& options, solve::Control& control, Best& best)
      : field_(field), options_(options), control_(control), best_(best) {}

  void run() {
    open_.push({kInfinity, field_.region()});
    best_.complete = true;
    while (!open_.empty() && open_.top().bound > target()) {
      if (control_.search_ended()) {
        best_.complete = false;
        break;
      }
      Cell cell = open_.top();
      open_.pop();
      examine(cell);
      if (best_.empty) return;
      if (options_.progress) options_.progress(best_.lower, finite(upper()), best_.cells);
    }
    best_.upper = finite(upper());
    best_.complete = best_.complete && stuck_ <= target();
    best_.unassembled = open_.empty() && stuck_ == 0 && best_.center.empty();
    if (best_.unassembled) best_.upper = 0;
  }

 private:
  static std::optional<double> finite(double x) { return x < kInfinity ? std::optional(x) : std::nullopt; }
  double target() const { return best_.center.empty() ? 0 : best_.lower / (1 - options_.precision); }
  double upper() const {
    return std::max({best_.center.empty() ? 0 : best_.lower, stuck_, open_.empty() ? 0 : open_.top().bound});
  }

  Nearest distance(const std::vector<double>& at, double at_most, double enough) {
    Nearest n = field_.distance(at, {.precision = options_.precision / 3,
                                     .at_most = at_most < kInfinity ? at_most : 0,
                                     .enough = std::max(0.0, enough)});
    best_.processed += n.statistics.processed;
    return n;
  }

  // Keeps the centre where its ball is larger than all before, and the robot has a configuration there. False: it has none,
  // or that is not known.
  bool offer(const std::vector<double>& at, const Nearest& n) {
    if (n.lower <= best_.lower && !best_.center.empty()) return true;
    const Box point(at.begin(), at.end());
    if (!field_.configurations(point).proven) return false;
    best_.lower = n.lower, best_.center = at;
    best_.nearest.clear();
    if (n.upper) best_.nearest = coordinate_values(field_.system(), n.box);
    return true;
  }

  void examine(Cell& cell) {
    ++best_.cells;
    const std::vector<double> at = midpoint(cell.x);
    const double h = reach(cell.x, at);
    const Nearest n = distance(at, cell.bound, target() - h);
    if (n.empty) {
      best_.empty = true;
      return;
    }
    if (n.upper) {
      const UpwardRounding rounding;
      cell.bound = std::min(cell.bound, *n.upper + h);
    }
    if (!offer(at, n) && cell.bound > target()) {
      const CenterField::Configurations there = field_.configurations(cell.x);
      if (there.excluded) return;
      if (there.proven) offer(there.near, distance(there.near, cell.bound, best_.lower));
    }
    divide(std::move(cell));
  }

  void divide(Cell cell) {
    const auto widest =
        std::ranges::max_element(cell.x, [](const Interval& a, const Interval& b) { return a.width() < b.width(); });
    const std::size_t j = widest - cell.x.begin();
    const Interval side = cell.x[j];
    const double where = side.mid();
    if (side.width() <= kFinest * field_.region()[j].width() || !(side.lo() < where && where < side.hi())) {
      stuck_ = std::max(stuck_, cell.bound);
      return;
    }
    Cell other = cell;
    cell.x[j] = Interval(side.lo(), where), other.x[j] = Interval(where, side.hi());
    open_.push(std::move(cell));
    open_.push(std::move(other));
  }

  CenterField& field_;
  const BestOptions& options_;
  solve::Control& control_;
  Best& best_;
  std::priority_queue<Cell> open_;
  double stuck_ = 0;  // the largest bound of cells that are not divided any more
};

}  // namespace

Best best_center(const study::Question& question, const BallOptions& ball, const std::vector<NamedRange>& region,
                 const BestOptions& options, const solve::Options& search, solve::Control& control) {
  const auto start = std::chrono::steady_clock::now();
  CenterField field(question, ball, region, search, control);
  Best best;
  best.ball = field.ball();
  best.names = field.names(), best.region = field.region();
  best.precision = options.precision;
  Search(field, options, control, best).run();
  if (!best.complete) best.stopped = solve::stopped_by(control);
  best.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return best;
}

}  // namespace corank::analyze
