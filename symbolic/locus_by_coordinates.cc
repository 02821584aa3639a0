#include "corank/symbolic/locus_by_coordinates.h"

#include "corank/symbolic/kernel_vector.h"

namespace corank::symbolic {

LocusByCoordinates locus_by_coordinates(const Mechanism& mechanism, SingularitySet set,
                                        const std::vector<std::string>& scales) {
  Mechanism plain = mechanism.without_rates();
  const VelocityEquation velocity = derive(plain).velocity;
  KernelQuestion kernel = kernel_question(plain, set, KernelSide::right);
  const std::size_t columns = kernel.matrix.columns.size(), equations = velocity.matrix.rows.size(),
                    rows = equations - velocity.ties(kernel.set.locked).size();
  if (rows != columns) {
    throw ModelError(model_place(mechanism),
                     kernel.name + " has " + std::to_string(rows) + " rows and " + std::to_string(columns) +
                         " columns, so the locus has no " + (kernel.set.part == LocusPart::cusps ? "cusps" : "nodes"),
                     "a square matrix");
  }
  if (const std::size_t mobility = velocity.matrix.columns.size() - equations; mobility < 2) {
    throw ModelError(model_place(mechanism),
                     std::string(kernel.set.name) + " of a mechanism of mobility " + std::to_string(mobility),
                     "a mobility of 2 or more");
  }
  if (!scales.empty() && scales.size() != columns + 1) {
    throw ModelError(model_place(mechanism), std::to_string(scales.size()) + " scales", std::to_string(columns + 1));
  }
  LocusByCoordinates result{std::move(plain), std::move(kernel), scales};
  result.scales.resize(columns + 1, "1");
  result.size_per_scale = result.scales.back();
  result.scales.pop_back();
  return result;
}

}  // namespace corank::symbolic
