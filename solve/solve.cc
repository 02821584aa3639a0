#include "corank/solve/solve.h"

#include "corank/solve/assembly.h"
#include "corank/solve/passes.h"

namespace corank::solve {

double printed_tolerance(const System& system) {
  constexpr double kPrintedDecimals = 1e-6;
  return system.equations.size() > system.variables.size() ? kPrintedDecimals : 0;
}

Cover solve(const System& system, const Options& options) {
  Control control(limits_of(options));
  return solve(prepare(system, options, control), control);
}

Cover solve(const Prepared& prepared, Control& control, std::uint64_t most) {
  Tally tally(prepared, control, most);
  Pool pool(prepared, tally);
  SelfMotions motions;
  const Work first = first_pass(prepared);
  Sigma sigma = sigma_of_search(prepared, pool.problem());
  pool.set_sigma(sigma);
  if (prepared.reduction.consistent) {
    const InStage stage(control, Stage::search);
    for (Work pass = first; !pass.boxes.empty();
         pass = next_pass(prepared, pass, take_postponed(pool.shards()), pool, motions))
      pool.search(pass);
    if (!pool.problem().tolerant) sigma = sigma_of_set(prepared, pool.problem(), pool.shards());
    pool.set_sigma(sigma);
    pool.cut(pool.shards());
  }
  Cover cover;
  pool.execute([&] { cover = assemble(prepared, pool.problem(), pool.shards(), first, motions, sigma, control); });
  cover.statistics.seconds_certify /= pool.threads();
  cover.statistics.seconds_total = tally.seconds();
  cover.statistics.seconds_search = cover.statistics.seconds_total - cover.statistics.seconds_certify;
  tally.report(true);
  return cover;
}

}  // namespace corank::solve
