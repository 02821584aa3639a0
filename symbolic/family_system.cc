#include "corank/symbolic/family_system.h"

#include <string>

#include "corank/symbolic/algebrizer.h"
#include "corank/symbolic/kernel_scale.h"

namespace corank::symbolic {
namespace {

TrigonometricSystem equations_of(const Mechanism& mechanism, const FamilyQuestion& q) {
  if (!q.set) return plain_system(mechanism);
  const SetDefinition& set = definition(q.set);
  if (set.of_parts || set.type)
    throw ModelError({mechanism.name(), 0, 0}, std::string("the set ") + set.name + " cannot be counted",
                     "a set of one system, such as cspace, forward or forward-cusps");
  // Passive rates stay: by how much their scales bound them depends on the constants.
  return singularity_system(mechanism, *q.set, q.kernel, kernel_scales(mechanism, *q.set, q.kernel), q.corank);
}

}  // namespace

FamilySystem family_system(const Mechanism& mechanism, const FamilyQuestion& question) {
  const ParametricSystem parametric =
      with_parameters(mechanism, equations_of(mechanism, question), question.over, question.fixed);
  FamilySystem family{algebrize(parametric.system), {}, parametric.copies};
  family.parameters = mark_parameters(parametric, family.system);
  return family;
}

}  // namespace corank::symbolic
