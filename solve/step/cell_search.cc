#include "corank/solve/step/cell_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "corank/core/box.h"
#include "corank/core/check.h"
#include "corank/core/rounding.h"
#include "corank/solve/step/heuristics.h"

namespace corank::solve {
CellSearch::CellSearch(const Problem& problem, std::vector<int> parameters)
    : problem_(problem),
      parameters_(std::move(parameters)),
      unknowns_(all_but(parameters_, problem.compiled.variables())),
      preconditioners_(problem.compiled, problem.ended) {
  CORANK_CHECK(static_cast<int>(unknowns_.size()) == problem.compiled.equations());
}

void CellSearch::put_in(const Box& sides, Box& x) const {
  for (std::size_t k = 0; k < parameters_.size(); ++k) x[parameters_[k]] = sides[k];
}

ParameterCell CellSearch::whole(const Box& sides, const Box& domain) const {
  ParameterCell cell{sides, {}, {domain}};
  put_in(sides, cell.open[0]);
  return cell;
}

ParameterCell CellSearch::part(const ParameterCell& cell, const Box& sides) {
  ParameterCell part{sides, {}, cell.open};
  for (Box& x : part.open) put_in(sides, x);
  Box box(problem_.compiled.variables());
  put_in(sides, box);
  for (const certify::Sheet& sheet : cell.sheets)
    part.sheets.push_back(certify::restricted(problem_.compiled, sheet, box, workspace_));
  return part;
}

CellSearch::Outcome CellSearch::shrink(const ParameterCell& cell, Box& x, std::optional<certify::Sheet>& sheet) {
  const certify::CompiledSystem& system = problem_.compiled;
  bool near = false;
  for (int repeat = 0; repeat < kForCells.repeats; ++repeat) {
    if (!propagator_.run(system, x)) return Outcome::empty;
    const Box before = x;
    const certify::NewtonStep step(system, preconditioners_.at_midpoint(x, &unknowns_), x, workspace_);
    if (step.outcome().empty || !step.contract_free(x)) return Outcome::empty;
    near = step.outcome().regular && step.outcome().spread < kForCells.proof_spread;
    bool gained = false;
    for (std::size_t j = 0; j < x.size() && !gained; ++j) gained = x[j].width() < (1 - kForCells.gain) * before[j].width();
    if (!gained) break;
  }
  // What holds the solutions over a part of the cell holds them over all of it where there are none over the rest.
  put_in(cell.sides, x);
  for (const certify::Sheet& known : cell.sheets)
    if (certify::lies_on(known, x)) return Outcome::empty;
  if (!near) return Outcome::open;
  const certify::Preconditioner& p = preconditioners_.at_midpoint(x, &unknowns_);
  if (p.rank() < system.equations()) return Outcome::open;
  certify::Sheet proof = certify::newton_prove(system, p, x, workspace_);
  if (!proof.proven) return Outcome::open;
  sheet = std::move(proof);
  return Outcome::proven;
}

std::vector<double> CellSearch::limits(const Box& x, double share) {
  const certify::Preconditioner& p = preconditioners_.at_midpoint(x, &unknowns_);
  std::vector<double> limits = problem_.limits(share);  // where the solutions move without bounds, next to a fold
  const std::vector<double>& scales = problem_.compiled.scales();
  std::vector<double> moves(scales.size(), 0);
  double most = kFinestCell;  // of the typical sizes
  for (int a = 0; a < p.rank(); ++a) {
    const std::size_t j = p.dependent[a];
    for (const int k : parameters_) moves[j] += std::fabs(preconditioners_.sensitivity(a, k)) * x[k].width();
    most = std::max(most, moves[j] / scales[j]);
  }
  for (const int d : p.dependent) {
    const std::size_t j = d;
    limits[j] = std::min(limits[j], kFollow * std::max(moves[j], kLeastMovement * most * scales[j]));
  }
  for (const int k : parameters_) limits[k] = std::numeric_limits<double>::infinity();
  return limits;
}

bool CellSearch::refine(ParameterCell& cell, double share, std::uint64_t most, Control& control) {
  CORANK_CHECK(UpwardRounding::active());
  std::vector<Box> waiting = std::exchange(cell.open, {});
  std::uint64_t processed = 0;
  bool ended = false;
  while (!waiting.empty()) {
    Box x = std::move(waiting.back());
    waiting.pop_back();
    ended = ended || control.search_ended() || !control.count_box();
    if (ended || processed++ >= most) {
      cell.open.push_back(std::move(x));
      continue;
    }
    ++processed_;
    std::optional<certify::Sheet> sheet;
    switch (shrink(cell, x, sheet)) {
      case Outcome::empty: continue;
      case Outcome::proven: {
        // Its zeros are those of a known sheet where both are one: boxes that overlap find the same.
        const bool is_new = std::ranges::none_of(cell.sheets, [&](const certify::Sheet& known) {
          return certify::compare_over(problem_.compiled, known, *sheet, workspace_) == certify::Identity::same;
        });
        if (is_new) cell.sheets.push_back(std::move(*sheet));
        continue;
      }
      case Outcome::open: break;
    }
    const int split = problem_.branching.choose(problem_.compiled, x, limits(x, share));
    const std::optional<double> at = split < 0 ? std::nullopt : split_point(x[split]);
    if (!at) {
      cell.open.push_back(std::move(x));
      continue;
    }
    Box upper = x;
    const std::size_t j = split;
    upper[j] = Interval(*at, x[j].hi());
    x[j] = Interval(x[j].lo(), *at);
    waiting.push_back(std::move(upper));
    waiting.push_back(std::move(x));
  }
  return !ended;
}

std::optional<std::vector<std::size_t>> CellSearch::solutions(ParameterCell& cell) {
  CORANK_CHECK(UpwardRounding::active());
  if (!cell.open.empty() || !certify::keep_distinct(problem_.compiled, cell.sheets, workspace_)) return std::nullopt;
  return certify::sheets_inside(problem_.compiled, problem_.domain, cell.sheets, workspace_);
}

}  // namespace corank::solve
