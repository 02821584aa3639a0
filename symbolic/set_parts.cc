#include "corank/symbolic/set_parts.h"

#include "corank/symbolic/algebrizer.h"

namespace corank::symbolic {

std::string text(const SetPart& part) {
  const auto* component = std::get_if<Component>(&part);
  return component ? component->name : std::get<BoundaryPart>(part).text();
}

std::vector<SetPart> set_parts(const Mechanism& mechanism, SingularitySet set, const Ended& ended) {
  std::vector<SetPart> parts;
  if (definition(set).of_parts) {
    for (BoundaryPart& part : boundary_parts(mechanism)) parts.emplace_back(std::move(part));
  } else {
    for (Component& part : decompose(mechanism, kernel_question(mechanism, derive(mechanism).velocity, set), ended))
      parts.emplace_back(std::move(part));
  }
  return parts;
}

std::vector<std::string> part_scales(const Mechanism& mechanism, SingularitySet set, const SetPart& part) {
  const auto* component = std::get_if<Component>(&part);
  return component ? component_scales(mechanism, set, *component) : boundary_scales(mechanism, std::get<BoundaryPart>(part));
}

TrigonometricSystem part_system(const Mechanism& mechanism, SingularitySet set, const SetPart& part,
                                const std::vector<std::string>& scales) {
  const auto* component = std::get_if<Component>(&part);
  return component ? component_system(mechanism, set, *component, scales)
                   : boundary_system(mechanism, std::get<BoundaryPart>(part), scales);
}

System compiled_part(const Mechanism& mechanism, SingularitySet set, const SetPart& part,
                     const std::vector<std::string>& scales) {
  const TrigonometricSystem equations = part_system(mechanism, set, part, scales);
  System system = algebrize(equations);
  if (const auto* limits = std::get_if<BoundaryPart>(&part)) system.passage = passage_form(mechanism, *limits, equations);
  return system;
}

}  // namespace corank::symbolic
