#include "corank/solve/reduction/flint.h"

#include <flint/nmod_vec.h>

#include <algorithm>
#include <vector>

namespace corank::solve {

// Of the rows from `from` on that are not 0 in the column the one with the fewest entries; the number of rows where there is
// no such row.
std::size_t PrimeMatrix::lightest_row(std::size_t from, std::size_t column) {
  const std::size_t rows = nmod_mat_nrows(m_), columns = nmod_mat_ncols(m_);
  std::size_t lightest = rows, least = columns + 1;
  for (std::size_t i = from; i < rows; ++i) {
    if (at(i, column) == 0) continue;
    const mp_limb_t* row = m_->rows[i];
    const std::size_t weight = std::count_if(row + column, row + columns, [](mp_limb_t c) { return c != 0; });
    if (weight < least) least = weight, lightest = i;
  }
  return lightest;
}

// Subtracts a multiple of row `pivot`, which is 1 in the column and 0 before it, from row `from`: that becomes 0 there.
void PrimeMatrix::subtract(std::size_t pivot, std::size_t from, std::size_t column) {
  const mp_limb_t c = at(from, column);
  if (c != 0)
    _nmod_vec_scalar_addmul_nmod(m_->rows[from] + column, m_->rows[pivot] + column, nmod_mat_ncols(m_) - column,
                                 nmod_neg(c, m_->mod), m_->mod);
}

bool PrimeMatrix::reduce(const Ended& ended) {
  const std::size_t rows = nmod_mat_nrows(m_), columns = nmod_mat_ncols(m_);
  std::vector<std::size_t> pivots;  // columns of the first rows' leading ones
  for (std::size_t j = 0; j < columns && pivots.size() < rows; ++j) {
    if (is_over(ended)) return false;
    const std::size_t top = pivots.size(), lightest = lightest_row(top, j);
    if (lightest == rows) continue;
    std::swap(m_->rows[top], m_->rows[lightest]);
    mp_limb_t* row = m_->rows[top] + j;
    _nmod_vec_scalar_mul_nmod(row, row, columns - j, nmod_inv(*row, m_->mod), m_->mod);
    for (std::size_t i = top + 1; i < rows; ++i) subtract(top, i, j);
    pivots.push_back(j);
  }
  for (std::size_t k = pivots.size(); k-- > 0;) {
    if (is_over(ended)) return false;
    for (std::size_t i = 0; i < k; ++i) subtract(k, i, pivots[k]);
  }
  return true;
}

}  // namespace corank::solve
