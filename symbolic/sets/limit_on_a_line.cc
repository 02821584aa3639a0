#include "corank/symbolic/sets/limit_on_a_line.h"

#include <string>

#include "corank/core/exact_number.h"
#include "corank/symbolic/velocity/kernel_vector.h"

namespace corank::symbolic {

void add_limit_on_a_line(TrigonometricSystem& system, const Mechanism& mechanism, const VelocityCondition& condition,
                         const std::vector<Expression>& rates) {
  const SourceLocation where = model_place(mechanism);
  const std::vector<std::string> names = kernel_names(mechanism, condition.groups.size(), 1, "rho");
  std::vector<Expression> sum;
  for (std::size_t g = 0; g < condition.groups.size(); ++g) {
    system.further_unknowns.push_back({names[g], 0, 1});
    std::vector<Expression> of_group;
    std::string largest = "1";
    for (const int j : condition.groups[g].columns) {
      of_group.push_back(rates[j]);
      const std::string scale = system.kernel_scales.empty() ? "1" : system.kernel_scales[j];
      if (of_group.size() == 1 || (ExactNumber::rational(scale) - ExactNumber::rational(largest)).sign() == 1)
        largest = scale;
    }
    const Expression root = scaled({names[g]}, {largest})[0];
    system.equations.push_back({pow(root, 2) == square_of(of_group), "size of load " + std::to_string(g + 1), where, true});
    sum.push_back(times(condition.groups[g].weight, root));
  }
  system.equations.push_back({sum_of(sum) == times(condition.bound, rates.back()), "limit", where, true});
  system.equations.push_back({square_of(symbols(system.kernel_unknowns)) == Expression(1), "norm of xi", where, true});
}

}  // namespace corank::symbolic
