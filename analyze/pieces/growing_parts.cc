// Lemma 3 of sign_cells.h: which directions a cell has, and where passages hang together.
#include <Eigen/QR>
#include <cmath>
#include <set>

#include "corank/analyze/pieces/sign_cells.h"
#include "corank/core/rounding.h"

namespace corank::analyze {

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

// In some direction: one in which all grow alike at the middle, to first order, or one of the usual ones.
bool SignCells::grows(const SignCell& cell, const certify::SignCellTest::Slopes& slopes,
                      const std::vector<int>& signs) const {
  const auto rows = static_cast<Eigen::Index>(slopes.size()), columns = static_cast<Eigen::Index>(cell.free.size());
  Eigen::MatrixXd gradients(rows, columns);
  Eigen::VectorXd wanted(rows);
  for (Eigen::Index k = 0; k < rows; ++k) {
    for (Eigen::Index f = 0; f < columns; ++f) gradients(k, f) = slopes[k][f].mid();
    wanted[k] = signs[cell.mixed[k]] * gradients.row(k).norm();
  }
  std::vector<double> alike(cell.free.size(), 0.0);
  if (gradients.allFinite())
    Eigen::Map<Eigen::VectorXd>(alike.data(), columns) = gradients.completeOrthogonalDecomposition().solve(wanted);
  const auto has_all = [&](const std::vector<double>& d) {
    return certify::SignCellTest::growth(cell, slopes, d, signs) != 0;
  };
  return (std::ranges::all_of(alike, [](double x) { return std::isfinite(x); }) && has_all(alike)) ||
         std::ranges::any_of(directions(cell), has_all);
}

// Lemma 3; false: there is no direction for some choice of signs. `any`: also directions that are the cell's own.
bool SignCells::find_directions(SignCell& cell, bool any) {
  certify::SignCellTest::Slopes s;
  cell.directions = {};
  cell.ascends = 0;
  const std::vector<std::vector<int>> all = choices(cell);
  if (all.empty() || !proof_.slopes(cell, s)) return false;
  for (std::size_t c = all.size(); c < cell.directions.size(); ++c) cell.directions[c] = ~std::uint64_t{0};
  std::uint64_t bit = 1;
  for (const std::vector<double>& d : directions(cell)) {
    for (std::size_t c = 0; c < all.size(); ++c)
      if (certify::SignCellTest::growth(cell, s, d, all[c]) != 0) cell.directions[c] |= bit;
    bit <<= 1;
  }
  for (std::size_t c = 0; c < all.size(); ++c)
    if (cell.directions[c] != 0 || (any && grows(cell, s, all[c]))) cell.ascends |= static_cast<std::uint8_t>(1U << c);
  if (cell.free.size() == 2 && cell.mixed.size() <= 2) add_convex_limits(cell, s);
  for (std::size_t c = 0; c < all.size(); ++c)
    if (cell.directions[c] == 0 && (cell.ascends >> c & 1) == 0) return false;
  return true;
}

bool SignCells::is_passage(std::size_t cell) {
  const UpwardRounding rounding;
  SignCell& c = cells_[cell];
  const std::size_t all = choices(c).size();
  if (c.ascends == 0) static_cast<void>(find_directions(c, c.free.size() > 2));
  return all > 0 && c.ascends == (1U << all) - 1;
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

// Is there a direction in which all mixed functions grow, and of K those that may be the least of K somewhere? `sizes`:
// of K.
bool SignCells::climbs(const SignCell& cell, const std::map<int, double>& sizes, const std::vector<int>& signs) const {
  const auto weighed = [&](int k, double size) { return Interval(signs[k] / size) * cell.range[k]; };
  double least = HUGE_VAL;
  for (const auto& [k, size] : sizes) least = std::min(least, weighed(k, size).hi());
  SignCell with_low{{cell.free, cell.sides, cell.range, cell.mixed}, cell.box};
  for (const auto& [k, size] : sizes)
    if (std::ranges::find(cell.mixed, k) == cell.mixed.end() && weighed(k, size).lo() <= least) with_low.mixed.push_back(k);
  certify::SignCellTest::Slopes s;
  return proof_.slopes(with_low, s) && grows(with_low, s, signs);
}

// The directions, as bits, that all of these cells have for a choice of signs of each.
template <class Choice>
std::uint64_t SignCells::common_directions(const std::vector<std::size_t>& cells, const Choice& choice) const {
  const SignCell& first = cells_[cells.front()];
  std::uint64_t common = ~std::uint64_t{0};
  for (const std::size_t c : cells) {
    const SignCell& cell = cells_[c];
    common &= cell.box == first.box && cell.mixed == first.mixed ? cell.directions[choice(cell)] : 0;
  }
  return common;
}

std::vector<std::size_t> SignCells::hiding_places(const std::vector<std::size_t>& cells,
                                                  const std::vector<int>& signs) const {
  if (common_directions(cells, [&](const SignCell& cell) { return choice(cell, signs); }) != 0) return {};
  bool ascend = true;
  std::vector<int> in_all = cells_[cells.front()].mixed;
  std::array<std::map<int, double>, 2> sizes;  // the largest and the smallest
  for (const std::size_t c : cells) {
    const SignCell& cell = cells_[c];
    ascend = ascend && (cell.ascends >> choice(cell, signs) & 1) != 0;
    std::erase_if(in_all, [&](int f) { return std::ranges::find(cell.mixed, f) == cell.mixed.end(); });
    for (const int f : cell.mixed) {
      const double size = cell.range[f].mag();
      sizes[0][f] = std::max(sizes[0][f], size);
      sizes[1][f] = std::min(sizes[1].emplace(f, size).first->second, size);
    }
  }
  if (ascend && !in_all.empty()) return {};
  // K: all, or all but one.
  const UpwardRounding rounding;
  const auto open = [&](const std::map<int, double>& of) {
    std::vector<std::size_t> result;
    std::ranges::copy_if(cells, std::back_inserter(result), [&](std::size_t c) { return !climbs(cells_[c], of, signs); });
    return result;
  };
  std::vector<std::size_t> result = cells;
  const auto keep_fewer = [&](const std::map<int, double>& of) {
    if (std::vector<std::size_t> fewer = open(of); fewer.size() < result.size()) result = std::move(fewer);
  };
  for (const std::map<int, double>& all : sizes) {
    if (result.empty()) break;
    keep_fewer(all);
    for (auto k = all.begin(); k != all.end() && all.size() > 1 && !result.empty(); ++k) {
      std::map<int, double> others = all;
      others.erase(k->first);
      keep_fewer(others);
    }
  }
  return result;
}

// Have the cells no direction in common for some choice of signs?
bool SignCells::differ_in_directions(const std::vector<std::size_t>& cells) const {
  for (std::size_t k = 0; k < SignCell{}.directions.size(); ++k)
    if (common_directions(cells, [k](const SignCell&) { return k; }) == 0) return true;
  return false;
}

// Those that are resolved by lemma 3 or 5 only, and in which a piece might hide together. In the plane, where loci cross at
// points, those that differ in their directions: in one sheet about them all the parts are seen to be connected.
std::vector<std::vector<std::size_t>> SignCells::touching_passages() {
  const bool plane = cover_.dimension == 2;
  std::map<std::vector<int>, std::vector<std::size_t>> cells_of;  // of the signs of their parts
  for (std::size_t c = 0; c < cells_.size(); ++c)
    if (cells_[c].resolved && (cells_[c].mixed.size() > 1 || has_convex_limit(cells_[c])) && !has_known_parts(cells_[c]))
      for (const std::vector<int>& signs : plane ? std::vector<std::vector<int>>{{}} : choices(cells_[c]))
        cells_of[signs].push_back(c);
  std::set<std::vector<std::size_t>> found;
  for (const auto& [signs, cells] : cells_of) {
    const auto sides_of = [&](std::size_t c) -> const Box& { return cells_[c].sides; };
    const std::vector<std::size_t> group = box_tree(cells, sides_of).groups(0, {});
    std::map<std::size_t, std::vector<std::size_t>> members;
    for (std::size_t k = 0; k < cells.size(); ++k) members[group[k]].push_back(cells[k]);
    for (const auto& [number, list] : members) {
      std::vector<std::size_t> open;
      if (!plane)
        open = hiding_places(list, signs);
      else if (list.size() > 1 && differ_in_directions(list))
        open = list;
      if (!open.empty()) found.insert(std::move(open));
    }
  }
  return {found.begin(), found.end()};
}

}  // namespace corank::analyze
