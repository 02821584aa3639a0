#include "corank/analyze/aspects/aspect_cusps.h"

#include <fmt/format.h>

#include <algorithm>

#include "corank/analyze/aspects/aspect_equations.h"
#include "corank/analyze/sets/limits.h"
#include "corank/analyze/topology/topology.h"
#include "corank/core/rounding.h"
#include "corank/result/values/sentences.h"
#include "corank/study/answer.h"

namespace corank::analyze {
namespace {

// `outer`: of each factor of the locus the sign of its function cusp_sides() over the cusp.
void find_sides(AspectCusp& cusp, const std::vector<int>& outer, const std::vector<std::size_t>& places,
                const SignCells& cells, const Pieces& pieces) {
  std::vector<int> signs = cells.signs(cusp.at);
  if (std::ranges::count(signs, 0) != 1) return;
  const std::size_t zero = std::ranges::find(signs, 0) - signs.begin();
  const auto own = std::ranges::find(places, zero);
  if (own == places.end()) return;
  const int sign = outer[own - places.begin()];
  if (sign == 0) return;
  signs[zero] = sign;
  cusp.around = only_piece(cells, pieces, cusp.at, signs);
  signs[zero] = -sign;
  cusp.between = only_piece(cells, pieces, cusp.at, signs);
}

void add_cusps(const CuspEquations& asked, std::size_t locus, const SignCells& cells, const Pieces& pieces, int threads,
               solve::Control& control, AspectCusps& cusps) {
  study::Options options;
  options.search.threads = threads;
  const result::Result found = study::answer(asked.question, asked.system, options, control);
  const std::vector<const CoverBox*> proven = result::proven_cusps(found);
  const certify::CompiledSystem compiled(asked.system, asked.sides);
  const UpwardRounding rounding;
  for (const CoverBox* point : proven) {
    const std::optional<Box> at = same_configuration(asked.system, point->box, cells.system());
    if (!at) continue;
    AspectCusp cusp{locus == 0, *at};
    std::vector<int> outer;
    for (int k = 0; k < compiled.values(); ++k)
      outer.push_back(sign_of(compiled.evaluate(compiled.value_row(k), point->box)));
    find_sides(cusp, outer, asked.places, cells, pieces);
    cusps.list.push_back(std::move(cusp));
  }
  cusps.looked_for[locus] = true;
  cusps.all[locus] = found.cover.complete() && found.cover.boxes.size() == proven.size();
  if (!cusps.all[locus])
    cusps.reasons.push_back(fmt::format("{} cusps: {}", locus_name(locus), result::locus_sentence(found)));
}

}  // namespace

const char* locus_name(std::size_t locus) { return locus == 0 ? "forward" : "inverse"; }

AspectCusps aspect_cusps(const AspectEquations& asked, SignCells& cells, const Pieces& pieces, int threads,
                         solve::Control& control) {
  AspectCusps cusps;
  if (!pieces.exact()) {
    cusps.reasons.emplace_back("the aspects are not exact");
    return cusps;
  }
  if (asked.question.model.has_own_velocity_equation()) {
    cusps.reasons.emplace_back("the model brings its own velocity equation");
    return cusps;
  }
  for (std::size_t locus = 0; locus < 2; ++locus) {
    const std::optional<CuspEquations>& of_locus = asked.cusps[locus];
    if (!of_locus) cusps.looked_for[locus] = cusps.all[locus] = true;
    if (!of_locus || control.ended()) continue;
    std::string reason = of_locus->reason;
    try {
      if (reason.empty()) add_cusps(*of_locus, locus, cells, pieces, threads, control, cusps);
    } catch (const symbolic::ModelError& error) {
      reason = error.what();
    }
    if (!reason.empty()) cusps.reasons.push_back(fmt::format("{} cusps: {}", locus_name(locus), reason));
  }
  if (control.ended()) cusps.reasons.emplace_back("the analysis was ended by a limit");
  return cusps;
}

void check_parity(const study::Question& question, const System& system, int threads, solve::Control& control,
                  AspectCusps& cusps) {
  if (!cusps.all[0] && !cusps.all[1]) return;
  constexpr std::uint64_t kMostForAHeight = 200'000;
  const Topology shape =
      topology_of_one(question, system, {.threads = threads, .most_for_a_height = kMostForAHeight}, control);
  if (shape.dimension != 2 || !shape.smooth || !shape.ends.empty() || !shape.euler_characteristic) return;
  cusps.euler_characteristic = shape.euler_characteristic;
  for (std::size_t locus = 0; locus < 2; ++locus) {
    bool& all = cusps.all[locus];
    const auto count = std::ranges::count_if(cusps.list, [&](const AspectCusp& c) { return c.forward == (locus == 0); });
    if (!all || (count - *shape.euler_characteristic) % 2 == 0) continue;
    all = false;
    cusps.reasons.push_back(fmt::format(
        "{} cusps: their number, {}, does not have the parity of the Euler characteristic {} of the closed C-space, "
        "as it has for a generic map; there may be others",
        locus_name(locus), count, *shape.euler_characteristic));
  }
}

}  // namespace corank::analyze
