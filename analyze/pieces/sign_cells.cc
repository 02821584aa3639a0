#include "corank/analyze/pieces/sign_cells.h"

#include <algorithm>
#include <cmath>

#include "corank/core/box.h"
#include "corank/core/check.h"
#include "corank/core/rounding.h"
#include "corank/solve/step/problem.h"

namespace corank::analyze {
namespace {

std::vector<Polynomial> joined(std::vector<Polynomial> a, const std::vector<Polynomial>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

// The largest term that is not constant, where each variable has its typical size: so that functions which are lengths and
// others count alike, in every unit.
std::vector<double> sizes_of(const System& system, const std::vector<Polynomial>& functions) {
  std::vector<double> sizes;
  for (const Polynomial& f : functions) {
    double size = 0;
    for (const Monomial& m : f.monomials) {
      double term = m.enclosure.mag();
      for (const Factor& x : m.factors) term *= std::pow(system.variables[x.variable].size, x.power);
      if (!m.factors.empty()) size = std::max(size, term);
    }
    sizes.push_back(size > 0 && std::isfinite(size) ? size : 1);
  }
  return sizes;
}

}  // namespace

SignCells::SignCells(const System& system, const Cover& cover, const std::vector<Polynomial>& functions,
                     const std::vector<Polynomial>& limits, const solve::Control& control)
    : system_(system),
      cover_(cover),
      given_(cover.boxes.size()),
      limits_(static_cast<int>(limits.size())),
      sizes_(sizes_of(system, joined(functions, limits))),
      proof_(system, joined(functions, limits)),
      test_(system) {
  const UpwardRounding rounding;
  for (std::size_t i = 0; i < cover.boxes.size(); ++i) {
    const CoverBox& box = cover.boxes[i];
    CORANK_CHECK(is_sheet(box) && box.region >= 0);
    SignCell cell{{box.free, box.box}, static_cast<int>(i)};
    // The sheet of a `boundary` box may go on beyond the domain.
    if (box.verdict == Verdict::boundary)
      for (const int d : all_but(box.free, system.size())) cell.sides[d] = region(cell)[d];
    if (control.ended()) {
      for (int k = 0; k < this->functions(); ++k) cell.mixed.push_back(k);
      cell.range.assign(cell.mixed.size(), Interval(-HUGE_VAL, HUGE_VAL));
    } else {
      widen_region(cell);
      evaluate(cell);
    }
    if (!is_outside(cell)) cells_.push_back(std::move(cell));
  }
  boxes_ = box_tree(cover_.boxes, &CoverBox::box);
}

// A region that was lifted from a reduced system may have no width where another sheet's differs by rounding.
void SignCells::widen_region(const SignCell& cell) {
  certify::Sheet sheet = proof_.sheet_over(cell);
  if (!sheet.proven) return;
  CoverBox& box = cover_.boxes[cell.box];
  box.region = static_cast<int>(cover_.regions.size());
  cover_.regions.push_back(std::move(sheet.region));
}

// Those that were added first of all: they are there to take over.
bool SignCells::comes_before(int a, int b) const {
  const auto added = [&](int i) { return i >= static_cast<int>(given_); };
  return added(a) != added(b) ? added(a) : a < b;
}

// Do all of the cell's solutions lie in a box that comes before its own? That box's cells hold them, too.
bool SignCells::is_covered_before(const SignCell& cell) const {
  bool covered = false;
  boxes_.for_each_overlapping(cell.sides, 0.0, [&](std::size_t b) {
    if (covered || !comes_before(static_cast<int>(b), cell.box)) return;
    const CoverBox& other = cover_.boxes[b];
    covered = contains(cover_.regions[other.region], cell.sides) && contains_over(other.free, other.box, cell.sides);
  });
  return covered;
}

const Box& SignCells::region(const SignCell& cell) const { return cover_.regions[cover_.boxes[cell.box].region]; }

void SignCells::evaluate(SignCell& cell) {
  const std::vector<int> dependent = all_but(cell.free, system_.size());
  const auto widest = [&] {
    double most = 0;
    for (const int j : dependent) most = std::max(most, cell.sides[j].width() / proof_.compiled().scales()[j]);
    return most;
  };
  const double before = widest();
  proof_.bound(cell, 2);
  cell.resolved = resolve(cell);
  // Of a part of a large sheet no step may contract; then halving would go on for nothing.
  constexpr double kHardlyLess = 0.99;
  if (cell.resolved || widest() < kHardlyLess * before || !proof_.narrow(cell, region(cell))) return;
  proof_.bound(cell, 1);
  cell.resolved = resolve(cell);
}

SignCell SignCells::cell_over(const SignCell& cell, Box sides) {
  SignCell result{{cell.free, std::move(sides)}, cell.box};
  proof_.bound(result, 1);
  return result;
}

Box SignCells::solution_over_middle(const SignCell& cell, const Box& box) {
  Box at = cell.sides;
  for (const int f : cell.free) at[f] = Interval(box[f].mid());
  return solution_over(cell, std::move(at));
}

bool SignCells::is_outside(const SignCell& cell) const {
  return std::ranges::any_of(cell.mixed, [&](int k) { return is_limit(k) && cell.range[k].hi() <= 0; }) ||
         std::any_of(cell.range.end() - limits_, cell.range.end(), [](const Interval& g) { return g.hi() < 0; });
}

std::size_t SignCells::choice(const SignCell& cell, const std::vector<int>& signs) const {
  std::size_t result = 0, bit = 1;
  for (const int k : cell.mixed) {
    if (is_limit(k)) continue;
    if (signs[k] > 0) result |= bit;
    bit *= 2;
  }
  return result;
}

std::vector<std::vector<int>> SignCells::choices(const SignCell& cell) const {
  std::vector<int> open, signs;
  for (const Interval& g : cell.range) signs.push_back(g.hi() < 0 ? -1 : 1);
  for (const int k : cell.mixed)
    if (!is_limit(k)) open.push_back(k);
  std::vector<std::vector<int>> result;
  if (open.size() > (cell.free.size() == 2 ? 2 : 3)) return result;
  for (std::size_t number = 0; number < std::size_t{1} << open.size(); ++number) {
    for (std::size_t k = 0; k < open.size(); ++k) signs[open[k]] = (number >> k & 1) != 0 ? 1 : -1;
    result.push_back(signs);
  }
  return result;
}

bool SignCells::resolve(SignCell& cell) {
  if (cell.mixed.empty()) return true;
  if (cell.mixed.size() == 1) {
    const bool limit = is_limit(cell.mixed.front());
    if (part_of_one(cell, 1) != 0 && (limit || part_of_one(cell, -1) != 0)) return true;
    if (!limit || !find_directions(cell, cell.free.size() > 2)) return false;
    // A limit that grows somewhere is cut on until its part is known.
    return has_convex_limit(cell);
  }
  return find_directions(cell, cell.free.size() > 2);
}

// Cut where the functions vary most; nothing where rounding leaves no room.
std::optional<std::vector<SignCell>> SignCells::halves(const SignCell& cell) {
  certify::SignCellTest::Slopes s;
  const std::vector<int>& frees = cell.free;
  const bool known = proof_.slopes(cell, s);
  std::size_t best = 0;
  double most = -1;
  for (std::size_t f = 0; f < frees.size(); ++f) {
    const std::size_t j = frees[f];
    const double width = cell.sides[j].width();
    double variation = known ? 0 : width / system_.variables[j].size;
    if (known)
      for (std::size_t k = 0; k < s.size(); ++k)
        variation = std::max(variation, s[k][f].mag() * width / sizes_[cell.mixed[k]]);
    if (variation > most) most = variation, best = f;
  }
  const std::size_t j = frees[best];
  const Interval side = cell.sides[j];
  const double cut = side.lo() + 0.47 * (side.hi() - side.lo());
  if (!(side.lo() < cut && cut < side.hi())) return std::nullopt;
  std::vector<SignCell> result;
  for (const Interval& half : {Interval(side.lo(), cut), Interval(cut, side.hi())}) {
    SignCell child{{cell.free, cell.sides}, cell.box};
    child.sides[j] = half;
    evaluate(child);
    if (!is_outside(child) && !is_covered_before(child)) result.push_back(std::move(child));
  }
  return result;
}

bool SignCells::has_known_parts(SignCell& cell) {
  if (!cell.known_parts) {
    const std::vector<std::vector<int>> all = choices(cell);
    cell.known_parts = !all.empty() && std::ranges::all_of(all, [&](const std::vector<int>& signs) {
      return part_by_outflow(cell, signs) != 0;
    });
  }
  return *cell.known_parts;
}

// One whose region holds all of the cells' solutions.
std::optional<SignCell> SignCells::sheet_over(const std::vector<std::size_t>& cells) {
  Box hull = cells_[cells.front()].sides;
  for (const std::size_t c : cells) include(hull, cells_[c].sides);
  double radius = 0;
  for (std::size_t j = 0; j < hull.size(); ++j) radius = std::max(radius, hull[j].width() / proof_.compiled().scales()[j]);
  certify::Sheet sheet = test_.sheet_about(hull, radius);
  if (!sheet.proven || !contains(sheet.region, hull)) return std::nullopt;
  CoverBox box;
  box.box = std::move(sheet.image);
  box.verdict = Verdict::regular;
  box.free = all_but(sheet.dependent, system_.size());
  box.region = static_cast<int>(cover_.regions.size());
  cover_.regions.push_back(std::move(sheet.region));
  cover_.boxes.push_back(std::move(box));
  SignCell cell{{cover_.boxes.back().free, cover_.boxes.back().box}, static_cast<int>(cover_.boxes.size()) - 1};
  evaluate(cell);
  return cell;
}

void SignCells::refine(int halvings, int rounds, solve::Control& control) {
  struct Waiting {
    SignCell cell;
    int depth;
  };
  const UpwardRounding rounding;
  std::vector<Waiting> waiting;
  std::vector<SignCell> done;
  for (SignCell& cell : cells_) cell.resolved ? done.push_back(std::move(cell)) : waiting.push_back({std::move(cell), 0});
  const auto work = [&] {
    while (!waiting.empty()) {
      Waiting now = std::move(waiting.back());
      waiting.pop_back();
      if (!now.cell.resolved && now.depth < halvings && !control.ended())
        if (auto parts = halves(now.cell)) {
          for (SignCell& part : *parts) waiting.push_back({std::move(part), now.depth + 1});
          continue;
        }
      // A corner on the zeros themselves: the third lemma does.
      if (!now.cell.resolved && !control.ended()) now.cell.resolved = find_directions(now.cell, true);
      done.push_back(std::move(now.cell));
    }
    cells_ = std::move(done);
    done.clear();
  };
  work();
  // A few that are left are divided deeper, as where two loci cross at a small angle.
  constexpr int kDeeper = 20;
  constexpr std::ptrdiff_t kFew = 2'000;
  for (int level = 0; level < kDeeper && !control.ended(); ++level) {
    const auto left = std::ranges::count_if(cells_, [](const SignCell& cell) { return !cell.resolved; });
    if (left == 0 || left > kFew) break;
    for (SignCell& cell : cells_)
      cell.resolved ? done.push_back(std::move(cell)) : waiting.push_back({std::move(cell), halvings - 1});
    work();
  }
  for (int round = 0; round < rounds && !control.ended(); ++round) {
    std::vector<std::size_t> touching;
    for (const std::vector<std::size_t>& group : touching_passages()) {
      touching.insert(touching.end(), group.begin(), group.end());
      const auto is_of_first = [&](std::size_t c) { return cells_[c].box == cells_[group.front()].box; };
      if (cover_.dimension > 2 && std::ranges::all_of(group, is_of_first)) continue;
      if (auto cell = sheet_over(group)) waiting.push_back({std::move(*cell), cover_.dimension > 2 ? 0 : halvings / 2});
    }
    if (touching.empty()) return;
    std::ranges::sort(touching);
    boxes_ = box_tree(cover_.boxes, &CoverBox::box);
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      std::optional<std::vector<SignCell>> parts;
      const bool asked = std::ranges::binary_search(touching, c);
      if (asked && is_covered_before(cells_[c])) continue;
      if (asked) parts = halves(cells_[c]);
      if (!parts) done.push_back(std::move(cells_[c]));
      if (parts)
        for (SignCell& part : *parts) waiting.push_back({std::move(part), halvings / 2});
    }
    work();
  }
}

bool SignCells::has_graph_over(const Box& at, const std::vector<int>& free, const std::vector<Interval>& over,
                               const std::vector<int>& wanted) {
  const std::optional<Box> point = test_.solution_in(at, at);
  if (!point) return false;
  const certify::Sheet sheet = proof_.graph_over(*point, free, over);
  return sheet.proven && signs(sheet.image) == wanted;
}

}  // namespace corank::analyze
