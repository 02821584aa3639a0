#include "corank/study/search_steps.h"

#include <cmath>
#include <map>

#include "corank/symbolic/evaluate.h"

namespace corank::study {

void describe_states(const kinematics::Assembly& assembly, result::Result& result) {
  result.states.clear();
  std::map<std::string, double> constants;
  for (const symbolic::Constant& c : assembly.mechanism.constants())
    constants[c.name] = symbolic::evaluate(c.value, constants);
  for (const CoverBox& point : result.cover.points) {
    std::map<std::string, double> values = constants;
    for (std::size_t v = 0; v < point.box.size(); ++v) values[result.variables[v].name] = point.box[v].mid();
    for (const Angle& angle : result.angles)
      values[angle.name] = std::atan2(point.box[static_cast<std::size_t>(angle.sine)].mid(),
                                      point.box[static_cast<std::size_t>(angle.cosine)].mid());
    result::RobotState& state = result.states.emplace_back();
    for (const auto& joint : assembly.joint_values) {
      const double value = symbolic::evaluate(joint.value, values);
      state.joints.push_back({joint.joint, joint.sine ? std::atan2(symbolic::evaluate(*joint.sine, values), value) : value});
    }
    for (const auto& pose : assembly.poses) {
      result::RobotState::LinkPose& link = state.links.emplace_back();
      link.link = pose.link;
      for (std::size_t i = 0; i < 3; ++i) {
        link.position[i] = symbolic::evaluate(pose.origin[i], values);
        for (std::size_t j = 0; j < 3; ++j) link.rotation[i][j] = symbolic::evaluate(pose.rotation[i][j], values);
      }
    }
  }
}

}  // namespace corank::study
