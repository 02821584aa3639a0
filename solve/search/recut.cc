#include "corank/solve/search/recut.h"

#include <map>
#include <stdexcept>
#include <utility>

#include "corank/certify/domain.h"
#include "corank/core/box.h"
#include "corank/core/rounding.h"
#include "corank/solve/search/passes.h"
#include "corank/solve/store/journal.h"
#include "corank/solve/store/strata.h"

namespace corank::solve {
namespace {

constexpr ShardNumber kNumber = 1;

// What a search knows when all of its sheets are there, from the cover that it made of them.
class StateOfCover {
 public:
  StateOfCover(const Prepared& prepared, Control& control)
      : reduction_(prepared.reduction),
        problem_(prepared.system, reduction_, [&control] { return control.ended(); }),
        all_rows_(reduction_.system.equations.size()) {
    for (std::size_t row = 0; row < all_rows_.size(); ++row) all_rows_[row] = static_cast<int>(row);
    for (std::size_t k = 0; k < reduction_.kept.size(); ++k) place_[reduction_.kept[k]] = static_cast<int>(k);
    if (const Options& options = prepared.options; options.allows_parts() && options.asked_length()) {
      problem_.parts_of_sheets = true;
      problem_.set_sigma({*options.asked_length(), *options.asked_angle()});
    }
  }

  SearchState of(Cover cover) {
    SearchState state;
    state.seconds = cover.statistics.seconds_total;
    motions_ = SelfMotions::restored(reduction_.system, {in_kept(cover.self_motions), cover.observed_dimension, 0});
    Shard shard(kNumber, false);
    shard.statistics = cover.statistics;
    std::vector<std::shared_ptr<const Box>> regions;
    for (const Box& region : cover.regions) regions.push_back(std::make_shared<const Box>(lowered(region)));
    std::vector<Box> parts;  // of sheets
    for (CoverBox& box : cover.boxes) {
      const auto region = box.region >= 0 ? regions.at(box.region) : nullptr;
      if (region && box.motion < 0 && !spans(cover, box) && !problem_.may_be_part(lowered(box.box))) {
        parts.push_back(std::move(box.box));
        continue;
      }
      certify::Sheet sheet = sheet_of(box, region.get());
      Box sides = lowered(box.box);
      if (sheet.proven) {
        sides.resize(reduction_.kept.size());
        certify::clip_to_domain(reduction_.system, sides);  // as a search's boxes are; sheets reach beyond
        shard.sheets.push_back({std::move(sides), std::move(sheet)});
      } else {
        for (int& j : box.free) j = place_of(j);
        box.box = std::move(sides);
        shard.found.push_back({std::move(box), {}, region, {}});
      }
    }
    state.first = state.pass = pass_over(reduction_, parts);
    state.motions = std::move(motions_);
    state.shards.push_back(std::move(shard));
    return state;
  }

 private:
  // The sides of the kept variables, then of the others: what Reduction::lift takes.
  Box lowered(const Box& box) const {
    Box sides;
    for (const int j : reduction_.kept) sides.push_back(box.at(j));
    for (const auto& definition : reduction_.definitions) sides.push_back(box.at(definition.variable));
    return sides;
  }

  // Of a kept variable among those that are kept.
  int place_of(int variable) const {
    const auto at = place_.find(variable);
    if (at == place_.end()) throw std::invalid_argument("the cover's free variables are none of its system");
    return at->second;
  }

  std::vector<SelfMotionRecord> in_kept(std::vector<SelfMotionRecord> records) const {
    for (SelfMotionRecord& record : records)
      for (Polynomial& f : record.relations)
        for (Monomial& m : f.monomials)
          for (Factor& factor : m.factors) factor.variable = place_of(factor.variable);
    return records;
  }

  // Not proven: the box is no sheet that can be cut. One on a self-motion is proven again, since a cover does not say which
  // equations its proof speaks of.
  certify::Sheet sheet_of(const CoverBox& box, const Box* region) {
    if ((box.verdict != Verdict::regular && box.verdict != Verdict::boundary) || !region || box.free.empty()) return {};
    const std::size_t n = reduction_.kept.size();
    Box sides = lowered(box.box);
    sides.resize(n);
    if (box.motion >= 0)
      return prove_on_stratum(problem_, motions_.known().at(box.motion).motion, box.motion, sides, workspace_).sheet;
    std::vector<int> free;
    for (const int j : box.free) free.push_back(place_of(j));
    certify::Sheet sheet;
    sheet.equations = all_rows_;
    sheet.dependent = all_but(free, static_cast<int>(n));
    sheet.region.assign(region->begin(), region->begin() + static_cast<std::ptrdiff_t>(n));
    sheet.image = std::move(sides);
    sheet.proven = sheet.dependent.size() == all_rows_.size();
    if (!sheet.spans_image()) return sheet;  // a part
    for (const int j : free) sheet.region[j] = sheet.image[j];
    sheet.proven = sheet.proven && contains(sheet.region, sheet.image);
    return sheet;
  }

  const certify::Reduction& reduction_;
  Problem problem_;
  certify::NewtonWorkspace workspace_;
  std::vector<int> all_rows_;
  std::map<int, int> place_;
  SelfMotions motions_;
};

}  // namespace

Cover recut(const Prepared& prepared, Cover cover, Control& control) {
  if (prepared.reduction.tolerant || cover.dimension == 0 || cover.boxes.empty()) return cover;
  if (cover.reduction != prepared.reduction.steps)
    throw std::invalid_argument("the cover is of another system, or of one that was reduced in another way");
  const UpwardRounding rounding;
  std::vector<ExactPoint> exact_points = std::move(cover.exact_points);
  SearchState state = StateOfCover(prepared, control).of(std::move(cover));
  Cover result = solve_on(prepared, control, nullptr, std::move(state));
  result.exact_points = std::move(exact_points);
  result.proof.reset();  // of the cutting alone, where the options ask for one
  return result;
}

}  // namespace corank::solve
