#include "corank/analyze/aspects/divided_space.h"

#include <algorithm>

#include "corank/analyze/topology/topology_with_ends.h"
#include "corank/solve/search/solve.h"

namespace corank::analyze {

DividedSpace divided_space(System system, const AspectsOptions& options, solve::Control& control) {
  DividedSpace space{.system = std::move(system), .cover = nullptr, .ends = {}, .limits = {}, .reason = {}};
  const solve::Options search{
      .sigma = solve::kWhole, .threads = options.threads, .proof = options.certificate, .proof_of_parts = false};
  space.cover = std::make_shared<const Cover>(solve::solve(solve::prepare(space.system, search, control), control));
  if (control.ended()) {  // a box that a limit has left is no sheet
    space.reason = "the analysis was ended by a limit";
    return space;
  }
  if (!std::ranges::all_of(space.cover->boxes, is_sheet)) {
    space.reason = "C-space is not shown to be smooth in the search domain";
    return space;
  }
  space.system = with_single_values(std::move(space.system));
  if (!space.cover->complete() || !is_square_over(space.system, space.cover->dimension)) {
    space.reason = "C-space could not be covered";
    return space;
  }
  const std::vector<Limit> touched = limits(space.system, *space.cover);
  for (const Limit& limit : touched) space.ends.push_back(limit.function);
  std::uint64_t processed = 0;
  if (!touched.empty())
    for (const Limit& limit : without_unreached(space.system, touched, {.threads = options.threads}, processed, control))
      space.limits.push_back(limit.name);
  return space;
}

SignCells cells_of(const DividedSpace& space, const std::vector<Polynomial>& functions, const AspectsOptions& options,
                   solve::Control& control) {
  SignCells cells(space.system, *space.cover, functions, space.ends, control);
  cells.refine(options.halvings, options.rounds, control);
  return cells;
}

}  // namespace corank::analyze
