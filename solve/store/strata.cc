#include "corank/solve/store/strata.h"

#include <algorithm>
#include <random>
#include <utility>

#include "corank/core/rounding.h"
#include "corank/solve/step/heuristics.h"
#include "corank/solve/step/local_solution.h"
#include "corank/solve/step/preconditioner.h"
#include "corank/solve/store/self_motion_search.h"

namespace corank::solve {
namespace {

// The rows with a derivative that vanishes nowhere in the box. Of a row like s (a − b) = 0 where s = 0 and a = b nothing
// follows there, though it is as good as any other a step away.
std::vector<int> steady_rows(const certify::CompiledSystem& system, const Box& x) {
  const UpwardRounding rounding;
  std::vector<Interval> jacobian(system.entries());
  system.jacobian(x, jacobian);
  std::vector<int> result;
  for (int row = 0; row < system.equations(); ++row)
    for (int k = system.row_begin(row); k < system.row_begin(row + 1); ++k)
      if (jacobian[k].mig() > 0) {
        result.push_back(row);
        break;
      }
  return result;
}

// A degenerate solution in the domain to which a random start leads.
std::optional<LocalSolution> degenerate_sample(const Problem& problem, const Box& domain, std::mt19937& random) {
  const std::vector<double>& scales = problem.compiled.scales();
  std::vector<double> start;
  for (std::size_t j = 0; j < domain.size(); ++j) {
    const double middle = std::clamp(0.0, domain[j].lo(), domain[j].hi());
    const double lo = std::max(domain[j].lo(), middle - 2 * scales[j]),
                 hi = std::min(domain[j].hi(), middle + 2 * scales[j]);
    start.push_back(lo < hi ? std::uniform_real_distribution<double>(lo, hi)(random) : lo);
  }
  auto sample = local_solution(problem, std::move(start), kSampleTolerance);
  if (!sample || sample->rank >= std::min(problem.compiled.equations(), problem.compiled.unknowns())) return std::nullopt;
  for (std::size_t j = 0; j < domain.size(); ++j) {
    const double room = kSolutionTolerance * scales[j];
    if (sample->x[j] < domain[j].lo() - room || sample->x[j] > domain[j].hi() + room) return std::nullopt;
  }
  if (breaks_inequality(problem, sample->x, 0)) return std::nullopt;
  return sample;
}

std::vector<Stratum> find_strata(const Problem& problem, const System& system) {
  const UpwardRounding rounding;  // everywhere: the strata are to be the same
  std::vector<Stratum> strata;
  std::mt19937 random(1);
  const Box domain = system.domain();
  int failures = 0;
  for (int start = 0, met = 0; start < kStarts && (start < kFirstStarts || met > 0) && !problem.ended(); ++start) {
    const auto sample = degenerate_sample(problem, domain, random);
    if (!sample) continue;
    ++met;
    const bool known = std::ranges::any_of(strata, [&](const Stratum& s) { return holds_at(s.motion, problem, sample->x); });
    if (known) continue;
    MotionCandidate candidate = find_self_motion(problem, system, *sample);
    if (candidate.motion) {
      strata.push_back({std::move(*candidate.motion), candidate.dimension});
    } else if (++failures >= kMotionAttempts) {
      break;
    }
  }
  return strata;
}

}  // namespace

Problem problem_with_strata(const Prepared& prepared, std::function<bool()> ended) {
  Problem problem(prepared.system, prepared.reduction, std::move(ended));
  const certify::CompiledSystem& system = problem.compiled;
  const bool exact = prepared.reduction.consistent && !problem.tolerant && system.parameters().empty();
  problem.parts_of_sheets = exact && prepared.options.allows_parts() && problem.has_surfaces();
  if (problem.parts_of_sheets && prepared.options.leaves_whole())
    problem.heuristics.sheet_spread = 0;  // it need not stay inside
  const bool any_set = system.equations() > 0 && system.unknowns() > system.equations();
  if (exact && any_set && prepared.options.roots.empty()) problem.strata = find_strata(problem, prepared.reduction.system);
  return problem;
}

MotionProof prove_on_stratum(const Problem& problem, const certify::SelfMotion& motion, int index, const Box& x,
                             certify::NewtonWorkspace& workspace) {
  PreconditionerFactory of_system(problem.compiled), of_motion(motion.compiled);
  const std::vector<int> steady = steady_rows(problem.compiled, x);
  for (const std::vector<int>* rows : {static_cast<const std::vector<int>*>(nullptr), &steady}) {
    certify::Preconditioner e = of_system.near_solution(x, kMotionRankTolerance, rows);
    if (e.rank() != static_cast<int>(motion.sufficient.size())) continue;
    const certify::Preconditioner r = of_motion.at_midpoint(x, &e.dependent, &motion.sufficient);
    if (r.rank() != e.rank()) continue;
    certify::Sheet sheet = certify::prove_self_motion(problem.compiled, motion, e, r, x, workspace);
    if (!sheet.proven) continue;
    sheet.motion = index;
    return {std::move(sheet), std::move(e)};
  }
  return {};
}

}  // namespace corank::solve
