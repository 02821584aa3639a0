#include "corank/analyze/aspect_cusps.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "corank/analyze/aspects.h"
#include "corank/analyze/piece_places.h"
#include "corank/analyze/topology.h"
#include "corank/core/rounding.h"
#include "corank/core/signs.h"
#include "corank/result/locus_words.h"
#include "corank/study/answer.h"
#include "corank/symbolic/algebrizer.h"
#include "corank/symbolic/cusp_system.h"
#include "corank/symbolic/kernel_scale.h"

namespace corank::analyze {
namespace {

// The same configuration in C-space's variables; nothing where they are not all there.
std::optional<Box> configuration(const System& from, const Box& box, const System& to) {
  Box result;
  for (const Variable& v : to.variables) {
    const int j = from.find(v.name);
    if (j < 0) return std::nullopt;
    result.push_back(box[static_cast<std::size_t>(j)]);
  }
  return result;
}

class Sides {
 public:
  Sides(const LocusFactors& locus, SignCells& cells, const Pieces& pieces) : locus_(locus), cells_(cells), pieces_(pieces) {}

  // `outer`: of each factor the sign of its function cusp_sides() over the cusp.
  void find(AspectCusp& cusp, const std::vector<int>& outer) const {
    std::vector<int> signs = cells_.signs(cusp.at);
    if (std::count(signs.begin(), signs.end(), 0) != 1) return;
    const auto zero = static_cast<std::size_t>(std::find(signs.begin(), signs.end(), 0) - signs.begin());
    const auto own = std::find(locus_.functions.begin(), locus_.functions.end(), zero);
    if (own == locus_.functions.end()) return;
    const int sign = outer[static_cast<std::size_t>(own - locus_.functions.begin())];
    if (sign == 0) return;
    signs[zero] = sign;
    cusp.around = only_piece(cells_, pieces_, cusp.at, signs);
    signs[zero] = -sign;
    cusp.between = only_piece(cells_, pieces_, cusp.at, signs);
  }

 private:
  const LocusFactors& locus_;
  SignCells& cells_;
  const Pieces& pieces_;
};

void add_cusps(study::Question question, const LocusFactors& locus, SignCells& cells, const Pieces& pieces, int threads,
               solve::Control& control, AspectCusps& cusps) {
  const symbolic::SingularitySet set =
      locus.forward ? symbolic::SingularitySet::forward_cusps : symbolic::SingularitySet::inverse_cusps;
  const char* name = locus.forward ? "forward" : "inverse";
  question.set = set;
  study::Options options;
  options.search.threads = threads;
  const symbolic::TrigonometricSystem equations = study::equations(question);
  const System system = study::system(question, equations);
  const result::Result found = study::answer(question, system, options, control);
  const std::vector<const CoverBox*> proven = result::proven_cusps(found);
  const std::vector<symbolic::Expression> sides =
      symbolic::cusp_sides(question.model, set, symbolic::kernel_scales(question.model, set), locus.factors);
  const certify::CompiledSystem compiled(system, symbolic::polynomials(equations, sides));
  const Sides find(locus, cells, pieces);
  const UpwardRounding rounding;
  for (const CoverBox* point : proven) {
    AspectCusp cusp{locus.forward, {}};
    const std::optional<Box> at = configuration(system, point->box, cells.system());
    if (!at) continue;
    cusp.at = *at;
    std::vector<int> outer;
    for (int k = 0; k < compiled.values(); ++k)
      outer.push_back(sign_of(compiled.evaluate(compiled.value_row(k), point->box)));
    find.find(cusp, outer);
    cusps.list.push_back(std::move(cusp));
  }
  const std::size_t which = locus.forward ? 0 : 1;
  cusps.looked_for[which] = true;
  cusps.all[which] = found.cover.complete() && found.cover.boxes.size() == proven.size();
  if (!cusps.all[which]) cusps.reasons.push_back(fmt::format("{} cusps: {}", name, result::locus_sentence(found)));
}

}  // namespace

AspectCusps aspect_cusps(const study::Question& question, const std::vector<LocusFactors>& loci, SignCells& cells,
                         const Pieces& pieces, int threads, solve::Control& control) {
  AspectCusps cusps;
  if (!pieces.exact()) {
    cusps.reasons.emplace_back("the aspects are not exact");
    return cusps;
  }
  // Cusps are those of the derivative of Φ; another L may be singular elsewhere.
  if (question.model.has_own_velocity_equation()) {
    cusps.reasons.emplace_back("the model brings its own velocity equation");
    return cusps;
  }
  for (const LocusFactors& locus : loci) {
    const std::size_t which = locus.forward ? 0 : 1;
    if (locus.factors.empty()) cusps.looked_for[which] = cusps.all[which] = true;
    if (locus.factors.empty() || control.ended()) continue;
    try {
      add_cusps(question, locus, cells, pieces, threads, control, cusps);
    } catch (const symbolic::ModelError& error) {
      cusps.reasons.push_back(fmt::format("{} cusps: {}", locus.forward ? "forward" : "inverse", error.what()));
    }
  }
  if (control.ended()) cusps.reasons.emplace_back("the analysis was ended by a limit");
  return cusps;
}

void check_parity(const study::Question& question, int threads, solve::Control& control, AspectCusps& cusps) {
  if (!cusps.all[0] && !cusps.all[1]) return;
  constexpr std::uint64_t kMostForAHeight = 200'000;
  const Topology shape = topology(question, {.threads = threads, .most_for_a_height = kMostForAHeight}, control);
  if (shape.dimension != 2 || !shape.smooth || !shape.ends.empty() || !shape.euler_characteristic) return;
  cusps.euler_characteristic = shape.euler_characteristic;
  for (const bool forward : {true, false}) {
    bool& all = cusps.all[forward ? 0 : 1];
    const auto count =
        std::count_if(cusps.list.begin(), cusps.list.end(), [&](const AspectCusp& c) { return c.forward == forward; });
    if (!all || (count - *shape.euler_characteristic) % 2 == 0) continue;
    all = false;
    cusps.reasons.push_back(fmt::format(
        "{} cusps: their number, {}, does not have the parity of the Euler characteristic {} of the closed C-space, "
        "as it has for a generic map; there may be others",
        forward ? "forward" : "inverse", count, *shape.euler_characteristic));
  }
}

}  // namespace corank::analyze
