#include "corank/solve/box_processor.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "corank/certify/check.h"
#include "corank/certify/projection.h"

namespace corank::solve {
namespace {

using certify::Interval;
using certify::Location;
using certify::Verdict;

// Measured on Dextar's sets, see bench/HISTORY.md.
constexpr double kWorthwhileShare = 0.1;  // a projection that gains less is not followed up
constexpr double kNewtonGain = 0.3;       // repeat Newton while some variable loses this share
constexpr int kNewtonRepeats = 4;
constexpr double kProofSpread = 1.5;   // try a proof below this spread |I − Y·S|
constexpr double kFreeCutShare = 0.1;  // cut a free side unless it is already so much narrower than the others or σ
constexpr double kLastCutShare = 1.0 / 64;
constexpr int kTightenings = 3;
constexpr int kPointTightenings = 20;             // an isolated solution is tightened until its box stops shrinking
constexpr int kPartialDepth = 8;                  // halvings of a piece on which redundant equations are bounded
constexpr double kRedundantRankTolerance = 1e-7;  // of redundant equations near their solution
constexpr double kRoundedRankTolerance = 1e-4;    // of such with rounded coefficients
constexpr int kBoundaryDepth = 2;                 // halvings of a piece that may leave the domain
constexpr double kCutMargin = 0.97;               // aim a little below σ: the linearization is not exact
constexpr double kMaxCells = 256;                 // of one cut; a piece that needs more is first cut into kCoarseParts
constexpr int kCoarseParts = 16;
constexpr double kFutileShare = 0.95;
constexpr int kFutileCuts = 10;
constexpr unsigned kPiecesBetweenChecks = 16;

// The cells of the grid that cuts side free[j] of the piece into parts[j] equal parts.
std::vector<std::vector<Interval>> grid(const std::vector<Interval>& piece, const std::vector<int>& free,
                                        const std::vector<int>& parts) {
  std::vector<std::vector<Interval>> cells{piece};
  for (std::size_t f = 0; f < free.size(); ++f) {
    const Interval side = piece[free[f]];
    std::vector<std::vector<Interval>> finer;
    finer.reserve(cells.size() * parts[f]);
    double from = side.lo();
    for (int k = 1; k <= parts[f]; ++k) {
      const double to = k == parts[f] ? side.hi() : std::clamp(side.lo() + side.width() * k / parts[f], from, side.hi());
      for (const auto& cell : cells) {
        finer.push_back(cell);
        finer.back()[free[f]] = Interval(from, to);
      }
      from = to;
    }
    cells = std::move(finer);
  }
  return cells;
}

double widest(const std::vector<Interval>& x) {
  double width = 0;
  for (const Interval& side : x) width = std::max(width, side.width());
  return width;
}

std::vector<certify::Polynomial> values_of(const certify::Reduction& reduction) {
  std::vector<certify::Polynomial> values;
  for (const auto& definition : reduction.definitions) values.push_back(definition.value);
  return values;
}

}  // namespace

Problem::Problem(const certify::Reduction& reduction, double s, std::function<bool()> e)
    : compiled(reduction.system, values_of(reduction)),
      redundant(reduction.system),
      domain(reduction.system),
      rank_tolerance(reduction.tolerant ? kRoundedRankTolerance : kRedundantRankTolerance),
      branching(reduction.system),
      sigma(s),
      ended(std::move(e)) {}

BoxProcessor::BoxProcessor(const Problem& problem) : problem_(problem), preconditioners_(problem.compiled) {
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
    if (!certify::project(system, row, x, kWorthwhileShare, changed_.data())) return false;
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
  worth_proving_ = false;
  if (!propagate(x)) return false;
  const int n = problem_.compiled.variables();
  std::vector<double> before(n);
  for (int repeat = 0; repeat < kNewtonRepeats; ++repeat) {
    for (int j = 0; j < n; ++j) before[j] = x[j].width();
    const auto& p = preconditioners_.at_midpoint(x);
    const auto newton = certify::newton_contract(problem_.compiled, p, x, workspace_);
    ++statistics_.newton_steps;
    if (newton.empty) return false;
    worth_proving_ = newton.regular && newton.spread < kProofSpread && p.rank() == problem_.compiled.equations();
    bool gained = false;
    for (int j = 0; j < n && !gained; ++j) gained = x[j].width() < (1 - kNewtonGain) * before[j];
    if (!gained) return true;
    if (!propagate(x)) return false;
  }
  return true;
}

void BoxProcessor::append_values(std::vector<Interval>& sides) const {
  const auto& system = problem_.compiled;
  sides.resize(static_cast<std::size_t>(system.variables()));
  for (int k = 0; k < system.values(); ++k) sides.push_back(system.evaluate(system.value_row(k), sides.data()));
}

void BoxProcessor::tighten(const certify::Preconditioner& p, std::vector<Interval>& piece) {
  const auto& system = problem_.compiled;
  certify::tighten_sheet(system, p, piece.data(), workspace_);
  piece.resize(static_cast<std::size_t>(system.variables()));
  for (int k = 0; k < system.values(); ++k) {
    Interval value = system.evaluate(system.value_row(k), piece.data());
    value.intersect(certify::value_at_zeros(system, p, system.value_row(k), piece.data(), workspace_));
    piece.push_back(value);
  }
}

bool BoxProcessor::holds_on_parts(const certify::Sheet& sheet, const std::vector<int>& free, std::vector<Interval> piece,
                                  int depth) {
  const auto& p = preconditioners_.at_midpoint(piece.data(), &sheet.dependent, &sheet.equations);
  if (p.rank() != static_cast<int>(sheet.dependent.size())) return false;
  certify::tighten_sheet(problem_.compiled, p, piece.data(), workspace_);
  if (is_partial(sheet)) {
    if (problem_.redundant.hold(problem_.compiled, problem_.domain, p, piece.data(), workspace_)) return true;
  } else {
    const Location location = problem_.domain.locate_zeros(problem_.compiled, p, piece.data(), workspace_);
    if (location != Location::across) return location == Location::inside;
  }
  if (depth == 0 || free.empty()) return false;
  const auto parts = grid(piece, free, std::vector<int>(free.size(), 2));
  return std::all_of(parts.begin(), parts.end(),
                     [&](const auto& part) { return holds_on_parts(sheet, free, part, depth - 1); });
}

certify::Sheet BoxProcessor::prove(const Interval* x) {
  const auto& p = preconditioners_.at_midpoint(x);
  if (p.rank() < problem_.compiled.equations()) return {};
  return certify::newton_prove(problem_.compiled, p, x, workspace_);
}

certify::Sheet BoxProcessor::prove_partially(const Interval* x) {
  certify::Sheet narrow =
      certify::newton_prove(problem_.compiled, preconditioners_.near_solution(x, problem_.rank_tolerance), x, workspace_);
  if (!narrow.proven || !is_partial(narrow) || free_variables(narrow).empty()) return narrow;
  std::vector<Interval> wide(x, x + problem_.compiled.variables());
  for (Interval& side : wide) {
    const double half = 0.5 * problem_.sigma;
    side = Interval::hull(side, Interval(side.mid() - half, side.mid() + half));
  }
  const auto& p = preconditioners_.near_solution(wide.data(), problem_.rank_tolerance);
  certify::Sheet sheet = certify::newton_prove(problem_.compiled, p, wide.data(), workspace_);
  if (!sheet.proven || !is_partial(sheet)) return sheet;
  const std::vector<int> free = free_variables(sheet);
  if (!holds_on_parts(sheet, free, sheet.image, kPartialDepth)) return {};
  for (int j : free) sheet.region[j] = sheet.image[j] = x[j];  // for every value of the free variables: so for x's too
  return sheet;
}

bool BoxProcessor::certify(Interval* x, Proof proof) {
  const auto start = std::chrono::steady_clock::now();
  ++statistics_.proofs_tried;
  const certify::Sheet sheet = proof == Proof::full ? prove(x) : prove_partially(x);
  if (sheet.proven) slice(sheet, x);
  statistics_.seconds_certify += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return sheet.proven;
}

void BoxProcessor::add(const certify::Sheet& sheet, const std::vector<int>& free, std::vector<Interval> piece,
                       Location location) {
  Verdict verdict = free.empty() ? Verdict::isolated : Verdict::regular;
  if (is_partial(sheet)) {
    verdict = holds_on_parts(sheet, free, piece, kPartialDepth) ? Verdict::partial : Verdict::undecided;
  } else if (location == Location::across && !holds_on_parts(sheet, free, piece, kBoundaryDepth)) {
    verdict = Verdict::boundary;
  }
  Found found{{std::move(piece), verdict, free}, {}};
  if (free.empty() && verdict != Verdict::undecided) {
    found.sheet = sheet;
    found.sheet.image.assign(found.box.box.begin(), found.box.box.begin() + problem_.compiled.variables());
  }
  found_.push_back(std::move(found));
}

void BoxProcessor::add_unproven(const Interval* x, Verdict verdict) {
  Found found;
  found.box.box.assign(x, x + problem_.compiled.variables());
  append_values(found.box.box);
  found.box.verdict = verdict;
  found_.push_back(std::move(found));
}

std::vector<double> BoxProcessor::steepness_over(const std::vector<Interval>& piece, const std::vector<int>& dependent,
                                                 const std::vector<int>& free) {
  const auto& system = problem_.compiled;
  std::vector<double> steepness;
  for (std::size_t a = 0; a < dependent.size(); ++a)
    for (int f : free) steepness.push_back(std::fabs(preconditioners_.sensitivity(static_cast<int>(a), f)));
  std::vector<double> center(static_cast<std::size_t>(system.variables())), gradient(center.size());
  for (std::size_t j = 0; j < center.size(); ++j) center[j] = piece[j].mid();
  workspace_.slope.resize(static_cast<std::size_t>(system.entries()));
  for (int k = 0; k < system.values(); ++k) {
    const int row = system.value_row(k);
    system.slopes(row, piece.data(), center.data(), workspace_.slope.data());
    std::fill(gradient.begin(), gradient.end(), 0.0);
    for (int e = system.row_begin(row); e < system.row_begin(row + 1); ++e)
      gradient[static_cast<std::size_t>(system.column(e))] = workspace_.slope[static_cast<std::size_t>(e)].mid();
    for (int f : free) {
      double slope = gradient[static_cast<std::size_t>(f)];
      for (std::size_t a = 0; a < dependent.size(); ++a)
        slope += gradient[static_cast<std::size_t>(dependent[a])] * preconditioners_.sensitivity(static_cast<int>(a), f);
      steepness.push_back(std::fabs(slope));
    }
  }
  return steepness;
}

std::vector<std::vector<Interval>> BoxProcessor::cut(const std::vector<Interval>& piece, const std::vector<int>& dependent,
                                                     const std::vector<int>& free) {
  // The linearized width of dependent (or eliminated variable) a is Σ_j |∂a/∂j| w_j; find few parts k_j with
  // Σ_j |∂a/∂j| w_j/k_j ≤ σ for all a.
  const std::vector<double> steepness = steepness_over(piece, dependent, free);
  const double sigma = kCutMargin * problem_.sigma;
  std::vector<int> parts;
  double cells = 1;
  std::size_t longest = 0;
  for (int j : free) {
    const double wanted = std::max(1.0, std::ceil(piece[j].width() / problem_.sigma));
    if (piece[j].width() > piece[free[longest]].width()) longest = parts.size();
    parts.push_back(static_cast<int>(std::min(wanted, kMaxCells)));
    cells *= wanted;
  }
  if (cells > kMaxCells) {
    std::fill(parts.begin(), parts.end(), 1);
    parts[longest] = kCoarseParts;
    return grid(piece, free, parts);
  }
  while (cells < kMaxCells) {
    double worst = sigma;
    std::size_t grow = free.size();
    for (std::size_t a = 0; a * free.size() < steepness.size(); ++a) {
      double width = 0, best = 0;
      std::size_t best_free = 0;
      for (std::size_t f = 0; f < free.size(); ++f) {
        const double share = steepness[a * free.size() + f] * piece[free[f]].width() / parts[f];
        width += share;
        // One part more takes share/(k+1) off at the price of a factor (k+1)/k in cells.
        if (const double gain = share * parts[f] / (parts[f] + 1); gain > best) best = gain, best_free = f;
      }
      if (width > worst && best > 0) worst = width, grow = best_free;
    }
    if (grow == free.size()) break;
    cells *= (parts[grow] + 1.0) / parts[grow];
    ++parts[grow];
  }
  if (std::all_of(parts.begin(), parts.end(), [](int k) { return k == 1; })) parts[longest] = 2;
  return grid(piece, free, parts);
}

std::vector<int> BoxProcessor::free_variables(const certify::Sheet& sheet) const {
  std::vector<int> free;
  for (int j = 0; j < problem_.compiled.variables(); ++j)
    if (std::find(sheet.dependent.begin(), sheet.dependent.end(), j) == sheet.dependent.end()) free.push_back(j);
  return free;
}

void BoxProcessor::slice(const certify::Sheet& sheet, const Interval* x) {
  const int n = problem_.compiled.variables();
  const std::vector<int> free = free_variables(sheet);
  struct Piece {
    std::vector<Interval> sides;
    double former_width;  // of the widest edge of the piece that it was cut from
    int futile_cuts;      // in a row
  };
  std::vector<Piece> pieces{{sheet.image, HUGE_VAL, 0}};
  append_values(pieces[0].sides);
  for (unsigned turn = 1; !pieces.empty(); ++turn) {
    if (turn % kPiecesBetweenChecks == 0 && problem_.ended()) {
      for (auto& rest : pieces) found_.push_back({{std::move(rest.sides), Verdict::pending, {}}, {}});
      return;
    }
    auto [piece, former_width, futile_cuts] = std::move(pieces.back());
    pieces.pop_back();
    double width = widest(piece);
    for (int k = 0; k < (free.empty() ? kPointTightenings : kTightenings); ++k) {
      const auto& p = preconditioners_.at_midpoint(piece.data(), &sheet.dependent, &sheet.equations);
      tighten(p, piece);
      const double tightened = widest(piece);
      if (!free.empty() && (tightened <= problem_.sigma || tightened > 0.9 * width)) break;
      if (free.empty() && tightened == width) break;
      width = tightened;
    }
    width = widest(piece);
    // Every solution in x with these free values lies in the piece: one that does not meet x is another box's business.
    bool meets = true;
    for (int j = 0; j < n && meets; ++j) meets = piece[j].overlaps(x[j]);
    if (!meets) continue;
    const Location location =
        problem_.domain.locate_zeros(problem_.compiled, preconditioners_.last(), piece.data(), workspace_);
    if (location == Location::outside) continue;
    // Rounding may keep the dependents of an ill-conditioned sheet wider than σ however narrow its free sides are: where cuts in a row
    // gain nothing, the piece stays as it is, proven.
    futile_cuts = width > kFutileShare * former_width ? futile_cuts + 1 : 0;
    const bool stuck = futile_cuts > kFutileCuts ||
                       std::none_of(free.begin(), free.end(), [&](int j) { return split_point(piece[j]).has_value(); });
    if (width <= problem_.sigma || stuck) {
      add(sheet, free, std::move(piece), location);
      continue;
    }
    for (auto& part : cut(piece, sheet.dependent, free)) pieces.push_back({std::move(part), width, futile_cuts});
  }
}

int BoxProcessor::widest_free(const Interval* x) {
  const auto& dependent = preconditioners_.at_midpoint(x).dependent;
  int widest = -1;
  for (int j = 0; j < problem_.compiled.variables(); ++j) {
    if (std::find(dependent.begin(), dependent.end(), j) != dependent.end()) continue;
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
  if (!contract(x)) return Outcome::done;
  if (worth_proving_ && certify(x, Proof::full)) return Outcome::done;
  split_variable_ = problem_.branching.choose(x, problem_.sigma);
  if (split_variable_ < 0) split_variable_ = choose_for_values(x);
  // Where Newton is regular, the solutions in x are a sheet over the free variables: cutting along those alone gives parts whose
  // sheets do not overlap.
  // Small boxes whose proof is near are cut on below σ, a bounded number of times.
  if (worth_proving_) {
    const int free = widest_free(x);
    const double least = split_variable_ >= 0 ? kFreeCutShare * x[split_variable_].width() : kLastCutShare * problem_.sigma;
    if (free >= 0 && x[free].width() > least && split_point(x[free])) split_variable_ = free;
  }
  if (split_variable_ >= 0) return Outcome::split;
  // At its final size: where equations may be redundant, the box gets its one chance of such a proof here, where its rank shows.
  if (problem_.redundant.applies() && certify(x, Proof::partial)) return Outcome::done;
  add_unproven(x, Verdict::undecided);
  return Outcome::done;
}

}  // namespace corank::solve
