#include "corank/solve/cutting/slicer.h"

#include <algorithm>
#include <functional>
#include <numeric>

#include "corank/certify/sheet_range.h"
#include "corank/core/box.h"
#include "corank/solve/step/heuristics.h"

namespace corank::solve {
namespace {
using certify::Location;
using certify::NewtonStep;
using certify::Preconditioner;
using certify::Sheet;

}  // namespace

NewtonStep Slicer::tighten(const Task& task, Slice& slice, const Preconditioner*& p, Preconditioner& own) {
  Box& sides = slice.sides;
  const Preconditioner* const inherited = p;
  const auto renew = [&] {
    own = preconditioners_.at_midpoint(sides, &task.sheet.dependent, &task.sheet.equations);
    p = &own;
  };
  std::optional<NewtonStep> last;
  const auto step = [&] {
    last.reset();  // its memory knows Y already
    last.emplace(certify::tighten_sheet(problem_.compiled, *p, sides, workspace_));
    slice.spread = last->outcome().spread;
  };
  sides.resize(problem_.compiled.variables());
  const bool is_point = task.cuttable.empty();
  if (!is_point && slice.spread > kStaleSpread) renew();  // the parts of such a slice are hardly better
  double width = HUGE_VAL;
  for (int k = 0; k < (is_point ? kPointTightenings : kTightenings); ++k) {
    if (is_point && k > 0) renew();
    step();
    if (slice.spread > kStaleSpread && p == inherited && !is_point) {
      renew();
      step();
    }
    const double tightened = is_point ? problem_.relative_width(sides) : Problem::excess(sides, task.sigma);
    if (is_point ? tightened == width : tightened <= 1 || tightened > 0.9 * width) break;
    if (!is_point && tightened > kNearSigma) break;  // to be cut anyway
    width = tightened;
  }
  if (is_point || Problem::excess(sides, task.sigma) <= kNearSigma) {
    problem_.append_values_at_zeros(*last, sides);
  } else {
    problem_.append_values(sides);
  }
  return *std::move(last);
}

bool Slicer::trim(const Task& task, NewtonStep& step, const Preconditioner* own, Box& sides) {
  const std::size_t n = problem_.compiled.variables();
  bool inside = true;
  for (std::size_t j = 0; j < n; ++j) {
    if (!sides[j].overlaps(task.x[j])) return false;
    inside = inside && task.x[j].contains(sides[j]);
  }
  if (inside) return true;
  met_.assign(sides.begin(), sides.begin() + static_cast<std::ptrdiff_t>(n));
  for (std::size_t j = 0; j < n; ++j) met_[j].intersect(task.x[j]);
  if (!step.contract_free(met_)) return false;
  bool narrower = false;
  for (int f : task.cuttable) {
    const std::size_t j = f;
    narrower = narrower || met_[j].width() < kTrimShare * sides[j].width();
    sides[j] = met_[j];
  }
  if (narrower) {  // so are the other sides
    if (own) {
      step = certify::tighten_sheet(problem_.compiled, *own, sides, workspace_);
    } else {
      step.tighten_part(sides);
    }
    problem_.append_values_at_zeros(step, sides);
  }
  return true;
}

std::optional<Location> Slicer::place(const Task& task, NewtonStep& step, const Preconditioner* own, Box& sides) {
  if (!trim(task, step, own, sides)) return std::nullopt;
  const Location location = problem_.domain.locate_zeros(step, sides);
  return location == Location::outside ? std::nullopt : std::optional(location);
}

bool Slicer::holds_on_parts(const Sheet& sheet, const std::vector<int>& free, Box slice, int depth) {
  const auto& p = preconditioners_.at_midpoint(slice, &sheet.dependent, &sheet.equations);
  if (p.rank() != static_cast<int>(sheet.dependent.size())) return false;
  const NewtonStep step = certify::tighten_sheet(problem_.compiled, p, slice, workspace_);
  if (problem_.is_partial(sheet)) {
    if (problem_.redundant.hold(problem_.domain, step, slice)) return true;
  } else {
    const Location location = problem_.domain.locate_zeros(step, slice);
    if (location != Location::across) return location == Location::inside;
  }
  if (depth == 0 || free.empty() || free.size() > kMostHalvedSides || problem_.ended()) return false;
  // Halves every free side: part number `index` takes the upper half of side f where bit f is set.
  for (unsigned index = 0; index < 1u << free.size(); ++index) {
    Box part = slice;
    for (std::size_t f = 0; f < free.size(); ++f) {
      Interval& side = part[free[f]];
      side = index >> f & 1u ? Interval(side.mid(), side.hi()) : Interval(side.lo(), side.mid());
    }
    if (!holds_on_parts(sheet, free, std::move(part), depth - 1)) return false;
  }
  return true;
}

void Slicer::leave_room(const Task& task, Box& slice) const {
  for (std::size_t j = 0; j < slice.size(); ++j) {
    if (std::ranges::find(task.free, static_cast<int>(j)) != task.free.end()) continue;
    Interval& side = slice[j];
    const double sigma = task.sigma[j];
    const double size = j < problem_.compiled.scales().size() ? problem_.compiled.scales()[j] : 0;  // also about 0
    const double room =
        std::min(kRoom * side.width() + kLeastRoom * std::max(side.mag(), size), 0.49 * (sigma - side.width()));
    if (!(room > 0)) continue;
    // Inside the region, where the solution is the only one, and not across an end of the domain that the side keeps.
    Interval wider = side + Interval(-room, room);
    if (!wider.intersect((*task.region)[j])) continue;
    if (std::cmp_less(j, problem_.compiled.variables()) && !wider.intersect(Interval::hull(side, problem_.domain.side(j))))
      continue;
    side = Interval::hull(side, wider);
  }
}

void Slicer::add(Task& task, Box slice, Location location) {
  const Sheet& sheet = task.sheet;
  Verdict verdict = task.cuttable.empty() ? Verdict::isolated : Verdict::regular;
  if (problem_.is_partial(sheet)) {
    verdict = holds_on_parts(sheet, task.free, slice, kPartialDepth) ? Verdict::partial : Verdict::undecided;
  } else if (location == Location::across && !holds_on_parts(sheet, task.free, slice, kBoundaryDepth)) {
    verdict = Verdict::boundary;
  }
  Found found{{std::move(slice), verdict, task.free}, {}, verdict == Verdict::undecided ? nullptr : task.region, {}};
  if (task.cuttable.empty() && verdict != Verdict::undecided) {
    Sheet narrow = sheet;
    narrow.image.assign(found.box.box.begin(), found.box.box.begin() + problem_.compiled.variables());
    found.sheet = std::make_unique<const Sheet>(std::move(narrow));
  }
  // That the sheet's other equations hold on it is not shown within the tolerance.
  if (verdict == Verdict::undecided) found.box.reason = problem_.ended() ? Reason::limit : Reason::tolerance;
  found.box.motion = sheet.motion;
  leave_room(task, found.box.box);
  if (recorder_) recorder_->leaf_box(task.found.size());
  task.found.push_back(std::move(found));
}

void Slicer::leave(FoundList& found, Box sides) {
  if (problem_.domain.locate(problem_.compiled, sides) == Location::outside) return leave_elsewhere();
  problem_.append_values(sides);
  if (recorder_) recorder_->leaf_box(found.size());
  found.push_back({{std::move(sides), Verdict::pending, {}}, {}, nullptr, {}});
}

std::optional<std::vector<int>> Slicer::better_chart(const Task& task, const Box& sides) {
  const Sheet& sheet = task.sheet;
  if (sheet.motion >= 0 || problem_.is_partial(sheet)) return std::nullopt;
  const std::size_t n = problem_.compiled.variables();
  std::vector<double> sizes(n);
  for (std::size_t j = 0; j < n; ++j)
    sizes[j] = std::isfinite(problem_.sigma[j]) ? problem_.sigma[j] : kNoSigma * problem_.compiled.scales()[j];
  const auto& p = preconditioners_.at_midpoint(sides, &sheet.dependent, &sheet.equations);
  if (p.dependent.size() < sheet.dependent.size()) return std::nullopt;
  std::vector<int> dependent = preconditioners_.chart_of_last(sizes, kGainOfAChart);
  if (std::is_permutation(dependent.begin(), dependent.end(), sheet.dependent.begin(), sheet.dependent.end()))
    return std::nullopt;
  return dependent;
}

bool Slicer::slice_in_chart(Task& task, Box sides, const std::vector<int>& dependent) {
  sides.resize(problem_.compiled.variables());
  if (!intersect(sides, task.x)) return false;
  const auto& p = preconditioners_.at_midpoint(sides, &dependent, &task.sheet.equations);
  if (p.dependent.size() < dependent.size()) return false;
  const Sheet sheet = certify::newton_prove(problem_.compiled, p, sides, workspace_);
  if (sheet.proven) slice(sheet, sides, task.found, false, false);
  return sheet.proven;
}

void Slicer::add_part(const Sheet& sheet, FoundList& found) {
  Box sides = sheet.image, region = sheet.region, narrower = sides;
  const NewtonStep step(problem_.compiled, preconditioners_.at_midpoint(sides, &sheet.dependent), narrower, workspace_);
  const Location location = problem_.domain.locate_zeros(step, narrower);
  if (location == Location::outside) return leave_elsewhere();
  problem_.append_values(region);
  problem_.append_values_at_zeros(step, narrower);
  for (std::size_t j = sides.size(); j < region.size(); ++j) {
    const Interval value = Interval::hull(narrower[j], region[j]);
    const double room = kRoom * value.width();  // as leave_room
    sides.push_back(value + Interval(-room, room));
  }
  const Verdict verdict = location == Location::inside ? Verdict::regular : Verdict::boundary;
  if (recorder_) recorder_->leaf_box(found.size());
  found.push_back({{std::move(sides), verdict, all_but(sheet.dependent, problem_.compiled.variables())},
                   {},
                   std::make_shared<const Box>(std::move(region)),
                   {}});
}

void Slicer::slice(const Sheet& sheet, std::span<const Interval> x, FoundList& found, bool whole, bool rechartable) {
  if (!sheet.spans_image()) return add_part(sheet, found);
  if (!whole && problem_.ended()) {
    left_some_ = true;
    leave(found, Box(x.begin(), x.begin() + problem_.compiled.variables()));
    return;
  }
  Box region = sheet.region;
  problem_.append_values(region);
  const std::vector<int> free = all_but(sheet.dependent, problem_.compiled.variables());
  const Preconditioner p = preconditioners_.at_midpoint(sheet.image, &sheet.dependent, &sheet.equations);
  Task task{sheet,
            x,
            found,
            free,
            problem_.without_parameters(free),
            std::make_shared<const Box>(std::move(region)),
            sigma_for(sheet, p),
            whole,
            rechartable};
  descend(task, {sheet.image}, p);
}

std::vector<double> Slicer::sigma_for(const Sheet& sheet, const Preconditioner& p) {
  if (problem_.compiled.parameters().empty()) return problem_.sigma;
  Box sides = sheet.image;
  const NewtonStep step = certify::tighten_sheet(problem_.compiled, p, sides, workspace_);
  return planner_.widened_sigma(step, sides);
}

void Slicer::leave_slice(Task& task, Box sides) {
  left_some_ = true;
  sides.resize(problem_.compiled.variables());
  if (!intersect(sides, task.x)) return leave_elsewhere();
  leave(task.found, std::move(sides));
}

void Slicer::descend(Task& task, Slice slice, const Preconditioner& inherited) {
  const std::vector<int>& free = task.cuttable;
  Box& sides = slice.sides;
  task.ended = task.ended || (!task.whole && task.turns++ % kPiecesBetweenChecks == 0 && problem_.ended());
  if (task.ended) return leave_slice(task, std::move(sides));
  Preconditioner renewed;
  const Preconditioner* p = &inherited;
  std::optional<NewtonStep> step = tighten(task, slice, p, renewed);
  // Every solution in x with these free values lies in the slice: one that does not meet x is another box's business.
  const std::optional<Location> location = place(task, *step, p, sides);
  if (!location) return leave_elsewhere();
  double width = Problem::excess(sides, task.sigma);
  std::vector<int> parts;
  if (width > 1 && !free.empty() && !task.whole) {
    parts = planner_.parts(*step, free, sides, task.sigma);
    const double number = std::accumulate(parts.begin(), parts.end(), 1.0, std::multiplies<>());
    if (task.rechartable && slice.charts_tried < kMostChartsTried && number >= kPartsForAChart) {
      const auto dependent = better_chart(task, sides);
      slice.charts_tried = dependent ? slice.charts_tried + 1 : kMostChartsTried;
      if (dependent && slice_in_chart(task, sides, *dependent)) return;
      if (dependent) step.reset();
    }
    // Small enough but for overestimation: look closer.
    if (std::ranges::all_of(parts, [](int count) { return count == 1; })) {
      certify::shrink_to_faces(problem_.compiled, task.sheet, *p, task.sigma, sides, workspace_);
      if (problem_.domain.locate(problem_.compiled, sides) == Location::outside) return leave_elsewhere();
      step.reset();
      width = Problem::excess(sides, task.sigma);
    }
  }
  // Rounding may keep the dependents of an ill-conditioned sheet wider than σ however narrow its free sides are: where cuts
  // in a row gain nothing, the slice stays as it is, proven.
  const int futile_cuts = width > kFutileShare * slice.former_width ? slice.futile_cuts + 1 : 0;
  const auto divisible = [&](int j) { return split_point(sides[j]).has_value(); };
  if (width <= 1 || task.whole || futile_cuts > kFutileCuts || std::ranges::none_of(free, divisible)) {
    add(task, std::move(sides), *location);
    return;
  }
  slice.former_width = width;
  slice.futile_cuts = futile_cuts;
  cut(task, slice, *p, std::move(step), planner_.places(sides, free, std::move(parts)));
}

void Slicer::settle(const Task& task, NewtonStep& step, CutSlice& part) {
  const auto small = [&] {
    for (std::size_t j = 0; std::cmp_less(j, problem_.compiled.variables()); ++j)
      if (part.sides[j].width() > task.sigma[j]) return false;
    return true;
  };
  step.tighten_part(part.sides);
  if (!small()) step.tighten_part(part.sides);  // the dependents' own share is smaller now
  if (!small()) return;
  problem_.append_values_at_zeros(step, part.sides);
  const double excess = Problem::excess(part.sides, task.sigma);
  if (excess > 1) return;
  const std::optional<Location> location = place(task, step, nullptr, part.sides);
  if (location == Location::across) return;  // a closer look may find it inside
  if (location && task.cuttable.size() == 1 && excess <= kPossibleFragment) return;
  part.fate = location ? CutSlice::Fate::found : CutSlice::Fate::elsewhere;
}

void Slicer::cut(Task& task, const Slice& slice, const Preconditioner& p, std::optional<NewtonStep> step,
                 const std::vector<std::vector<double>>& places) {
  const std::vector<int>& free = task.cuttable;
  std::size_t count = 1;
  for (const std::vector<double>& along : places) count *= along.size() + 1;
  std::vector<CutSlice> all(count, CutSlice{.sides = slice.sides});
  for (std::size_t index = 0; index < count; ++index) {
    // The index as a number whose last digit counts the parts along the last free side.
    std::size_t rest = index;
    for (std::size_t f = free.size(); f-- > 0; rest /= places[f].size() + 1) {
      const std::size_t k = rest % (places[f].size() + 1);
      Interval& side = all[index].sides[free[f]];
      side = Interval(k == 0 ? side.lo() : places[f][k - 1], k == places[f].size() ? side.hi() : places[f][k]);
    }
    if (step) settle(task, *step, all[index]);
  }
  step.reset();  // its buffers are the parts'
  const auto finish = [&](CutSlice& part) {
    switch (part.fate) {
      case CutSlice::Fate::found: return add(task, std::move(part.sides), Location::inside);
      case CutSlice::Fate::elsewhere: return leave_elsewhere();
      case CutSlice::Fate::open:
        return descend(task,
                       {std::move(part.sides), slice.former_width, slice.futile_cuts, slice.spread, slice.charts_tried}, p);
    }
  };
  std::size_t next = 0;
  const auto go_on = [&](const auto& self, std::size_t f) -> void {
    if (f == free.size()) return finish(all[next++]);
    if (recorder_ && !places[f].empty()) recorder_->cut(free[f], places[f]);
    for (std::size_t k = 0; k <= places[f].size(); ++k) self(self, f + 1);
  };
  go_on(go_on, 0);
}

}  // namespace corank::solve
