#include "corank/analyze/pieces/sign_cells.h"

#include <algorithm>
#include <cmath>
#include <map>

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
                     const std::vector<Polynomial>& limits, const Ended& ended)
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
      for (const int d : solve::other_variables(box.free, system.size())) cell.sides[d] = region(cell)[d];
    if (is_over(ended)) {
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
  const std::vector<int> dependent = solve::other_variables(cell.free, system_.size());
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
  if (open.size() > 2) return result;
  for (std::size_t number = 0; number < std::size_t{1} << open.size(); ++number) {
    for (std::size_t k = 0; k < open.size(); ++k) signs[open[k]] = (number >> k & 1) != 0 ? 1 : -1;
    result.push_back(signs);
  }
  return result;
}

std::vector<std::vector<double>> SignCells::directions(const SignCell& cell) const {
  std::vector<std::vector<double>> result;
  const std::vector<int>& frees = cell.free;
  const auto width = [&](std::size_t f) { return cover_.boxes[cell.box].box[frees[f]].width(); };
  for (std::size_t a = 0; a < frees.size(); ++a) {
    std::vector<double> d(frees.size(), 0.0);
    d[a] = width(a);
    result.push_back(d);
    for (std::size_t b = 0; b < a; ++b)
      for (const double share : {-4.0, -2.0, -1.0, -0.5, -0.25, 0.25, 0.5, 1.0, 2.0, 4.0}) {
        d[b] = share * width(b);
        result.push_back(d);
        d[b] = 0;
      }
  }
  // Where three limits meet.
  for (std::size_t signs = 0; frees.size() == 3 && signs < 4; ++signs)
    for (const double share : {1.0, 0.4})
      result.push_back(
          {width(0), ((signs & 1) != 0 ? share : -share) * width(1), ((signs & 2) != 0 ? share : -share) * width(2)});
  constexpr std::size_t kBits = 64;
  if (result.size() > kBits) result.resize(kBits);
  return result;
}

// Lemma 3; false: there are none for some choice of signs.
bool SignCells::find_directions(SignCell& cell) {
  certify::SignCellTest::Slopes s;
  cell.directions = {};
  const std::vector<std::vector<int>> all = choices(cell);
  if (all.empty() || !proof_.slopes(cell, s)) return false;
  for (std::size_t c = all.size(); c < cell.directions.size(); ++c) cell.directions[c] = ~std::uint64_t{0};
  std::uint64_t bit = 1;
  for (const std::vector<double>& d : directions(cell)) {
    for (std::size_t c = 0; c < all.size(); ++c)
      if (certify::SignCellTest::growth(cell, s, d, all[c]) != 0) cell.directions[c] |= bit;
    bit <<= 1;
  }
  if (cell.free.size() == 2 && cell.mixed.size() <= 2) add_convex_limits(cell, s);
  return std::ranges::find(cell.directions, 0U) == cell.directions.end();
}

// Lemma 5, which holds for each choice of the other function's sign. A limit that grows in some direction and is alone
// does not need it.
void SignCells::add_convex_limits(SignCell& cell, const certify::SignCellTest::Slopes& slopes) {
  const auto grows = [&](std::size_t k) {
    return std::ranges::any_of(slopes[k], [](const Interval& by) { return sign_of(by) != 0; });
  };
  std::optional<std::vector<certify::SheetDerivatives>> mixed;
  const auto add = [&](std::uint64_t bit) {
    for (std::uint64_t& known : cell.directions) known |= bit;
  };
  for (std::size_t k = 0; k < cell.mixed.size(); ++k) {
    if (!is_limit(cell.mixed[k]) || (cell.mixed.size() == 1 && grows(k))) continue;
    if (!mixed) mixed = proof_.second_order(cell);
    if (!mixed) return;
    const certify::SheetDerivatives& e = (*mixed)[k];
    if (cell.mixed.size() == 1) {
      const std::vector<std::vector<double>> lines = directions(cell);
      for (std::size_t d = 0; d < lines.size(); ++d)
        if (certify::SignCellTest::convex_on_lines(e, lines[d])) add(std::uint64_t{1} << (kLines + d));
      continue;
    }
    if (certify::SignCellTest::convex_on_levels(e, (*mixed)[1 - k])) add(std::uint64_t{1} << (kLevels + k));
  }
}

bool SignCells::resolve(SignCell& cell) {
  if (cell.mixed.empty()) return true;
  if (cell.mixed.size() == 1) {
    const bool limit = is_limit(cell.mixed.front());
    if (part_of_one(cell, 1) != 0 && (limit || part_of_one(cell, -1) != 0)) return true;
    if (!limit || !find_directions(cell)) return false;
    // A limit that grows somewhere is cut on until its part is known.
    return has_convex_limit(cell);
  }
  return find_directions(cell);
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

// Those of several mixed functions in groups that share no direction, but for those whose parts are known.
std::vector<std::vector<std::size_t>> SignCells::touching_passages() {
  std::vector<std::size_t> cells;
  std::vector<std::vector<std::size_t>> result;
  for (std::size_t c = 0; c < cells_.size(); ++c)
    if (cells_[c].resolved && (cells_[c].mixed.size() > 1 || has_convex_limit(cells_[c])) && !has_known_parts(cells_[c]))
      cells.push_back(c);
  const auto sides_of = [&](std::size_t c) -> const Box& { return cells_[c].sides; };
  const std::vector<std::size_t> group = box_tree(cells, sides_of).groups(0, {});
  std::map<std::size_t, std::vector<std::size_t>> members;
  for (std::size_t k = 0; k < cells.size(); ++k) members[group[k]].push_back(cells[k]);
  for (const auto& [number, list] : members) {
    std::array<std::uint64_t, 4> common{};
    for (std::size_t k = 0; k < common.size(); ++k) common[k] = common_directions(list, [&](std::size_t) { return k; });
    if (list.size() > 1 && std::ranges::find(common, 0U) != common.end()) result.push_back(list);
  }
  return result;
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
  box.free = solve::other_variables(sheet.dependent, system_.size());
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
      if (!now.cell.resolved && !control.ended()) now.cell.resolved = find_directions(now.cell);
      done.push_back(std::move(now.cell));
    }
    cells_ = std::move(done);
    done.clear();
  };
  work();
  for (int round = 0; round < rounds && !control.ended(); ++round) {
    std::vector<std::size_t> touching;
    for (const std::vector<std::size_t>& group : touching_passages()) {
      touching.insert(touching.end(), group.begin(), group.end());
      if (auto cell = sheet_over(group)) waiting.push_back({std::move(*cell), halvings / 2});
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
