// Solutions over a cell of parameters where the equations fall apart into groups that share nothing but these, such as the
// legs of a platform: each group is searched alone, and all combinations are the solutions (certify/independent_groups.h).
// Six legs of two solutions each have 12 sheets in place of 64.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "corank/certify/independent_groups.h"
#include "corank/certify/reduction.h"
#include "corank/solve/step/cell_search.h"

namespace corank::solve {

/// Constant during a search.
struct ProductProblem {
  /// `parameters`: of the reduced system. `kernel_vectors`: System::kernel_vectors of the system that was reduced.
  ProductProblem(const certify::Reduction& reduction, const std::vector<int>& parameters, int kernel_vectors);

  std::vector<certify::EquationGroup> groups;
  std::vector<std::vector<int>> parameters;  // of each group, among its variables
  std::vector<std::unique_ptr<const Problem>> problems;
};

struct ProductCell {
  Box sides;                         ///< of the parameters
  std::vector<ParameterCell> parts;  ///< of each group
};

/// One per thread. Each call requires UpwardRounding::active(). Calls mean what those of CellSearch do.
class ProductSearch {
 public:
  /// `whole`: of the reduced system.
  ProductSearch(const ProductProblem& product, const Problem& whole);

  ProductCell whole(const Box& sides, const Box& domain) const;
  ProductCell part(const ProductCell& cell, const Box& sides);
  /// `most`: boxes of each group.
  bool refine(ProductCell& cell, double share, std::uint64_t most, Control& control);
  std::optional<std::vector<certify::Sheet>> solutions(ProductCell& cell);
  /// Boxes of the reduced system in which all solutions are that no combination of known sheets gives.
  std::vector<Box> open(const ProductCell& cell) const;

  std::uint64_t processed() const;

 private:
  const ProductProblem& product_;
  const Problem& whole_;
  std::vector<CellSearch> searches_;
  certify::NewtonWorkspace workspace_;
};

}  // namespace corank::solve
