#include "corank/study/question.h"

#include "corank/solve/solve.h"
#include "corank/symbolic/algebrizer.h"
#include "corank/symbolic/kernel_scale.h"

namespace corank::study {

symbolic::TrigonometricSystem equations(const Question& q) {
  if (!q.set) return symbolic::plain_system(q.model);
  // Without scales first: it checks what is asked for.
  symbolic::TrigonometricSystem equations = symbolic::singularity_system(q.model, *q.set, q.kernel, {}, q.corank);
  const std::vector<std::string> scales = symbolic::kernel_scales(q.model, *q.set, q.kernel);
  return scales.empty() ? equations : symbolic::singularity_system(q.model, *q.set, q.kernel, scales, q.corank);
}

System system(const Question& question) { return system(question, equations(question)); }

System system(const Question& question, const symbolic::TrigonometricSystem& equations) {
  System system = symbolic::algebrize(equations);
  system.coefficient_tolerance = question.tolerance.value_or(question.set ? 0 : solve::printed_tolerance(system));
  return system;
}

}  // namespace corank::study
