// The block triangular form of a square matrix by its pattern.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace corank::symbolic {

struct SquareBlock {
  std::vector<std::size_t> rows, columns;  ///< as many of both, ascending
  friend bool operator==(const SquareBlock&, const SquareBlock&) = default;
};

/// The most entries, no two of a row or a column, that are filled: no matrix of that pattern has a higher rank. `filled[i]`:
/// the columns in which row i is not identically zero.
std::size_t term_rank(const std::vector<std::vector<std::size_t>>& filled, std::size_t columns);

/// The block triangular form of a square matrix by its pattern alone (Dulmage, Mendelsohn 1958; key Dulmage1958): rows and
/// columns are put in an order in which everything left of and below the square blocks on the diagonal is zero. So det M =
/// ± Π det B_i, and M is singular exactly where a block is. `filled[i]`: the columns in which row i of an n×n matrix is not
/// identically zero. The irreducible blocks in the order of their first rows. Nothing where no n entries stand in n rows
/// and n columns: every determinant of that pattern vanishes.
std::optional<std::vector<SquareBlock>> block_triangular_form(const std::vector<std::vector<std::size_t>>& filled);

}  // namespace corank::symbolic
