// The three-slider mechanism, built in C++ and read from the installed model: 8 forward and 4 inverse singularities; and a
// five-bar robot from its links and joints.
#include <iostream>

#include "corank/kinematics/equations/assembly.h"
#include "corank/result/files/result_file.h"
#include "corank/study/answer.h"
#include "corank/symbolic/model/model_file.h"

using namespace corank;

void print_singularities(const study::Question& question) {
  result::write_result("result.h5", study::answer(question));
  const Cover cover = result::read_result("result.h5").cover;
  int isolated = 0;
  for (const CoverBox& point : cover.points) isolated += point.verdict == Verdict::isolated;
  std::cout << isolated << " isolated, " << (cover.complete() ? "complete" : "incomplete") << "\n";
}

// The proportions of Dextar: its C-space is a smooth surface, its forward singularities are curves.
kinematics::Robot five_bar() {
  kinematics::Robot robot;
  const kinematics::Vector origin{0, 0, 0}, end{"0.9", 0, 0}, right{"1.18", 0, 0}, z{0, 0, 1};
  robot.name = "five_bar";
  robot.revolute("left", "base", origin, z, "left_arm", origin, z).actuated = true;
  robot.revolute("right", "base", right, z, "right_arm", origin, z).actuated = true;
  robot.revolute("left_elbow", "left_arm", end, z, "left_forearm", origin, z);
  robot.revolute("right_elbow", "right_arm", end, z, "right_forearm", origin, z);
  robot.revolute("tip", "left_forearm", end, z, "right_forearm", end, z);
  kinematics::Output tip;
  tip.name = "P";
  tip.link = robot.link("left_forearm");
  tip.point = end;
  robot.outputs.push_back(tip);
  return robot;
}

void print_dimension(const kinematics::Assembly& robot, symbolic::SingularitySet set) {
  const result::Result result = study::answer({.model = robot.mechanism, .set = set, .assembly = robot});
  std::cout << result.set << ": "
            << (result.cover.boxes.empty() ? "none" : "dimension " + std::to_string(result.cover.dimension)) << ", "
            << (result.cover.complete() ? "complete" : "incomplete") << "\n";
}

int main() {
  symbolic::Mechanism m("three_slider");
  const auto l1 = m.constant("L1", 1), l2 = m.constant("L2", "4/5");
  const auto y_a = m.length("y_A", -l1, l1), y_b = m.length("y_B", -l2, l2), x_c = m.length("x_C", -l1, l1);
  m.constrain(pow(y_a, 2) + pow(x_c, 2) == pow(l1, 2));
  m.constrain(pow(y_b, 2) + pow(x_c, 2) == pow(l2, 2));
  m.inputs({y_a});
  m.outputs({y_b});
  print_singularities({m, symbolic::SingularitySet::forward});
  print_singularities({symbolic::read_model(MODELS "/three_slider.cuik"), symbolic::SingularitySet::inverse});

  const kinematics::Assembly robot = kinematics::assemble(five_bar());
  std::cout << to_string(robot.space) << ", mobility " << robot.mobility << "\n";
  print_dimension(robot, symbolic::SingularitySet::forward);
  print_dimension(robot, symbolic::SingularitySet::cspace_singular);
}
