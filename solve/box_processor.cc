#include "corank/solve/box_processor.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "corank/certify/check.h"
#include "corank/certify/projection.h"
#include "corank/solve/chart.h"

namespace corank::solve {
namespace {

using certify::Interval;
using certify::Verdict;

// Measured on Dextar's sets, see bench/HISTORY.md.
constexpr double kWorthwhileShare = 0.1;  // a projection that gains less is not followed up
constexpr double kNewtonGain = 0.3;       // repeat Newton while some variable loses this share
constexpr int kNewtonRepeats = 4;
constexpr double kProofSpread = 1.5;   // try a proof below this spread |I − Y·S|
constexpr double kFreeCutShare = 0.1;  // cut a free side unless it is already so much narrower than the others or σ
constexpr double kLastCutShare = 1.0 / 64;
constexpr double kRegularCutShare = 1.0 / 8;

}  // namespace

BoxProcessor::BoxProcessor(const Problem& problem, Recorder* recorder)
    : problem_(problem),
      recorder_(recorder),
      preconditioners_(problem.compiled, problem.ended),
      slicer_(problem, preconditioners_, workspace_, recorder) {
  changed_.resize(problem.compiled.variables());
  pending_rows_.resize(problem.compiled.rows());
}

bool BoxProcessor::propagate(Interval* x) {
  const auto& system = problem_.compiled;
  // Rows wait in order; a row comes back when one of its variables has shrunk noticeably. Bounded by a share of the rows, since
  // each return costs a variable a tenth of its width.
  queue_.clear();
  for (int row = 0; row < system.rows(); ++row) queue_.push_back(row);
  std::fill(pending_rows_.begin(), pending_rows_.end(), 1);
  const std::size_t limit = static_cast<std::size_t>(system.rows()) * 8;
  for (std::size_t head = 0; head < queue_.size() && head < limit; ++head) {
    const int row = queue_[head];
    pending_rows_[row] = 0;
    std::fill(changed_.begin(), changed_.end(), 0);
    if (recorder_) before_.assign(x, x + system.variables());
    const bool empty = !certify::project(system, row, x, kWorthwhileShare, changed_.data());
    if (recorder_ && (empty || !std::equal(before_.begin(), before_.end(), x))) recorder_->row(row);
    if (empty) return false;
    for (int k = system.row_begin(row); k < system.row_begin(row + 1); ++k) {
      if (!changed_[system.column(k)]) continue;
      for (int other : system.rows_of(system.column(k)))
        if (other != row && !pending_rows_[other]) {
          pending_rows_[other] = 1;
          queue_.push_back(other);
        }
    }
  }
  return true;
}

bool BoxProcessor::contract(Interval* x) {
  worth_proving_ = regular_ = false;
  if (!propagate(x)) return false;
  const int n = problem_.compiled.variables();
  widths_.resize(static_cast<std::size_t>(n));
  for (int repeat = 0; repeat < kNewtonRepeats; ++repeat) {
    for (int j = 0; j < n; ++j) widths_[j] = x[j].width();
    const auto& p = preconditioners_.at_midpoint(x);
    if (recorder_) recorder_->newton(p, x);
    const auto newton = certify::newton_contract(problem_.compiled, p, x, workspace_);
    ++statistics_.newton_steps;
    if (newton.empty || !certify::contract_free(p, x, workspace_)) return false;
    regular_ = newton.regular && p.rank() == problem_.compiled.equations();
    worth_proving_ = regular_ && newton.spread < kProofSpread;
    bool gained = false;
    for (int j = 0; j < n && !gained; ++j) gained = x[j].width() < (1 - kNewtonGain) * widths_[j];
    if (!gained) return true;
    if (!propagate(x)) return false;
  }
  return true;
}

std::vector<int> BoxProcessor::chart_of_last() const {
  const auto& system = problem_.compiled;
  const auto& p = preconditioners_.last();
  const std::size_t n = static_cast<std::size_t>(system.variables()), k = n - static_cast<std::size_t>(p.rank());
  Chart chart;
  chart.tangent.assign(n * k, 0.0);
  chart.free = other_variables(p.dependent, system.variables());
  for (std::size_t f = 0; f < k; ++f) {
    chart.tangent[static_cast<std::size_t>(chart.free[f]) * k + f] = 1;
    for (int a = 0; a < p.rank(); ++a)
      chart.tangent[static_cast<std::size_t>(p.dependent[static_cast<std::size_t>(a)]) * k + f] =
          preconditioners_.sensitivity(a, chart.free[f]);
  }
  improve(chart);
  return other_variables(chart.free, system.variables());
}

certify::Sheet BoxProcessor::prove(const Interval* x) {
  if (preconditioners_.at_midpoint(x).rank() < problem_.compiled.equations()) {
    dependent_ = preconditioners_.last().dependent;
    return {};
  }
  std::vector<int> pivots = preconditioners_.last().dependent;
  std::sort(pivots.begin(), pivots.end());
  dependent_ = chart_of_last();
  const auto& p = pivots == dependent_ ? preconditioners_.last() : preconditioners_.at_midpoint(x, &dependent_);
  if (p.rank() < problem_.compiled.equations()) return {};
  return certify::newton_prove(problem_.compiled, p, x, workspace_);
}

certify::Sheet BoxProcessor::prove_partially(const Interval* x) {
  certify::Sheet narrow =
      certify::newton_prove(problem_.compiled, preconditioners_.near_solution(x, problem_.rank_tolerance), x, workspace_);
  if (!narrow.proven || !problem_.is_partial(narrow) || narrow.dependent.size() == narrow.region.size()) return narrow;
  std::vector<Interval> wide(x, x + problem_.compiled.variables());
  for (Interval& side : wide) {
    const double half = 0.5 * problem_.sigma;
    side = Interval::hull(side, Interval(side.mid() - half, side.mid() + half));
  }
  const auto& p = preconditioners_.near_solution(wide.data(), problem_.rank_tolerance);
  certify::Sheet sheet = certify::newton_prove(problem_.compiled, p, wide.data(), workspace_);
  if (!sheet.proven || !problem_.is_partial(sheet)) return sheet;
  const std::vector<int> free = other_variables(sheet.dependent, problem_.compiled.variables());
  if (!slicer_.holds_on_parts(sheet, free, sheet.image, kPartialDepth)) return {};
  for (int j : free) sheet.region[j] = sheet.image[j] = x[j];  // for every value of the free variables: so for x's too
  return sheet;
}

bool BoxProcessor::certify(Interval* x, Proof proof) {
  const auto start = std::chrono::steady_clock::now();
  ++statistics_.proofs_tried;
  const certify::Sheet sheet = proof == Proof::full ? prove(x) : prove_partially(x);
  if (sheet.proven) {
    if (recorder_) recorder_->newton(preconditioners_.last(), x);
    slicer_.slice(sheet, x, found_);
  }
  statistics_.seconds_certify += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return sheet.proven;
}

void BoxProcessor::add_unproven(const Interval* x, Verdict verdict) {
  Found found;
  found.box.box.assign(x, x + problem_.compiled.variables());
  problem_.append_values(found.box.box);
  found.box.verdict = verdict;
  if (recorder_) recorder_->leaf_box(found_.size());
  found_.push_back(std::move(found));
}

int BoxProcessor::widest_free(const Interval* x) {
  int widest = -1;
  for (int j : other_variables(dependent_, problem_.compiled.variables())) {
    if (widest < 0 || x[j].width() > x[widest].width()) widest = j;
  }
  return widest;
}

int BoxProcessor::choose_for_values(const Interval* x) const {
  const auto& system = problem_.compiled;
  std::vector<Interval> slope(static_cast<std::size_t>(system.entries()));
  std::vector<double> center(static_cast<std::size_t>(system.variables()));
  for (int j = 0; j < system.variables(); ++j) center[j] = x[j].mid();
  for (int k = 0; k < system.values(); ++k) {
    const int row = system.value_row(k);
    if (system.evaluate(row, x).width() <= problem_.sigma) continue;
    system.slopes(row, x, center.data(), slope.data());
    int best = -1;
    double most = 0;
    for (int e = system.row_begin(row); e < system.row_begin(row + 1); ++e) {
      const int j = system.column(e);
      if (const double share = slope[e].mag() * x[j].width(); share > most && split_point(x[j])) most = share, best = j;
    }
    if (best >= 0) return best;
  }
  return -1;
}

BoxProcessor::Outcome BoxProcessor::process(Interval* x) {
  ++statistics_.processed;
  if (!contract(x)) {
    if (recorder_) recorder_->leaf_empty();
    return Outcome::done;
  }
  if (preconditioners_.over()) {  // the search ends
    leave(x);
    return Outcome::done;
  }
  if (worth_proving_ && certify(x, Proof::full)) return Outcome::done;
  split_variable_ = problem_.branching.choose(problem_.compiled, x, problem_.sigma);
  if (split_variable_ < 0) split_variable_ = choose_for_values(x);
  // A small box in which Newton is regular may be proven when it is smaller still.
  if (split_variable_ < 0 && regular_)
    split_variable_ = problem_.branching.choose(problem_.compiled, x, problem_.sigma, kRegularCutShare);
  // Where a proof is near, the solutions in x are a sheet over the free variables: cutting along those alone gives parts whose sheets do
  // not overlap. Such boxes are cut on below σ, too, a bounded number of times.
  if (worth_proving_) {
    const int free = widest_free(x);
    if (free >= 0 && split_point(x[free])) {
      const double least = split_variable_ >= 0 ? kFreeCutShare * x[split_variable_].width()
                                                : kLastCutShare * problem_.branching.limit(free, problem_.sigma);
      if (x[free].width() > least) split_variable_ = free;
    }
  }
  if (split_variable_ >= 0) {
    if (recorder_) recorder_->keep(x);
    return Outcome::split;
  }
  // At its final size: where equations may be redundant, the box gets its one chance of such a proof here, where its rank shows.
  if (problem_.redundant.applies() && certify(x, Proof::partial)) return Outcome::done;
  add_unproven(x, Verdict::undecided);
  return Outcome::done;
}

}  // namespace corank::solve
