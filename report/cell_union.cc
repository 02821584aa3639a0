#include "corank/report/cell_union.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <tuple>

namespace corank::report {

CellUnion::CellUnion(int columns, int rows)
    : columns_(columns),
      rows_(rows),
      words_(columns / 64 + 1),  // the last bit is never a cell: every run ends in its row
      cells_(words_ * rows, 0) {}

void CellUnion::add(int x0, int y0, int x1, int y1) {
  x0 = std::max(x0, 0), y0 = std::max(y0, 0), x1 = std::min(x1, columns_), y1 = std::min(y1, rows_);
  if (x0 >= x1) return;
  const std::size_t first = x0 / 64, last = (x1 - 1) / 64;
  const std::uint64_t head = ~std::uint64_t{0} << (x0 % 64), tail = ~std::uint64_t{0} >> (63 - (x1 - 1) % 64);
  for (int y = y0; y < y1; ++y) {
    std::uint64_t* const row = cells_.data() + y * words_;
    for (std::size_t k = first; k <= last; ++k)
      row[k] |= (k == first ? head : ~std::uint64_t{0}) & (k == last ? tail : ~std::uint64_t{0});
  }
}

bool CellUnion::holds(int x, int y) const {
  if (x < 0 || y < 0 || x >= columns_ || y >= rows_) return false;
  return (word(y, x / 64) >> (x % 64) & 1) != 0;
}

std::uint64_t CellUnion::word(int row, std::size_t k) const {
  return row < 0 || row >= rows_ ? 0 : cells_[row * words_ + k];
}

std::vector<GridPolygon> CellUnion::outlines() const {
  // A unit edge belongs to the outline where one of its two cells is in the union. About a vertex their number is even:
  // where there are two in line, or four, edges run straight on (even-odd rule); else one horizontal and one vertical edge
  // end there. So the ends of the horizontal runs are the corners, in pairs, and, sorted by columns, the ends of the
  // vertical runs in pairs, too.
  std::vector<GridPoint> corners;
  for (int y = 0; y <= rows_; ++y) {
    std::uint64_t carry = 0;  // is the cell before the word's first one on a run?
    for (std::size_t k = 0; k < words_; ++k) {
      const std::uint64_t runs = word(y - 1, k) ^ word(y, k);
      for (std::uint64_t ends = runs ^ (runs << 1 | carry); ends != 0; ends &= ends - 1)
        corners.push_back({static_cast<int>(k * 64) + std::countr_zero(ends), y});
      carry = runs >> 63;
    }
  }
  std::vector<std::size_t> by_column(corners.size()), vertical_partner(corners.size());
  std::iota(by_column.begin(), by_column.end(), std::size_t{0});
  std::sort(by_column.begin(), by_column.end(), [&](std::size_t a, std::size_t b) {
    return std::tie(corners[a].x, corners[a].y) < std::tie(corners[b].x, corners[b].y);
  });
  for (std::size_t k = 0; k + 1 < by_column.size(); k += 2) {
    vertical_partner[by_column[k]] = by_column[k + 1];
    vertical_partner[by_column[k + 1]] = by_column[k];
  }
  std::vector<GridPolygon> polygons;
  std::vector<bool> seen(corners.size(), false);
  for (std::size_t start = 0; start < corners.size(); ++start) {
    if (seen[start]) continue;
    GridPolygon& polygon = polygons.emplace_back();
    for (std::size_t at = start; !seen[at]; at = vertical_partner[at ^ 1]) {
      seen[at] = seen[at ^ 1] = true;
      polygon.push_back(corners[at]);
      polygon.push_back(corners[at ^ 1]);
    }
  }
  return polygons;
}

}  // namespace corank::report
