#include "corank/analyze/postures/posture_map.h"

#include "corank/symbolic/writing/printer.h"

namespace corank::analyze {

using symbolic::Expression;

MapQuestion posture_map(const study::Question& robot, std::vector<symbolic::Parameter> over,
                        const std::vector<symbolic::FixedCoordinate>& fixed, const Rotation& orientation,
                        const std::string& orientation_of) {
  PostureQuestion question{.question = robot, .given = {}, .orientation = true, .orientation_of = orientation_of};
  std::optional<kinematics::Assembly>& assembly = question.question.assembly;
  if (!robot.model.requirement_texts().empty())
    throw question_error(robot, "postures at an orientation are counted without requirements", "a model without them");
  std::vector<Expression> values;
  kinematics::Robot named;  // with the parameters among its constants
  if (assembly) named = *assembly->robot;
  for (const symbolic::Parameter& p : over) {
    question.given.push_back(p.name);
    values.push_back(Expression::symbol(p.name));
    named.constants.push_back({p.name, (p.lower + p.upper) / 2, {}});
  }
  for (const symbolic::FixedCoordinate& f : fixed) {
    question.given.push_back(f.name);
    values.push_back(f.value);
  }
  if (assembly) assembly->robot = std::make_shared<const kinematics::Robot>(std::move(named));
  symbolic::Mechanism model = PostureFinder(std::move(question)).equations(values, orientation);
  model.set_source_text("% The postures of " + model.name() + " at one orientation.\n" + symbolic::to_model(model));
  return {.question = {.model = std::move(model)}, .over = std::move(over), .solutions = "postures"};
}

}  // namespace corank::analyze
