// The three-slider mechanism, built in C++ and read from the installed model: 8 forward and 4 inverse singularities.
#include <iostream>

#include "corank/result/result_file.h"
#include "corank/study/answer.h"
#include "corank/symbolic/model_file.h"

using namespace corank;

void print_singularities(const study::Question& question) {
  result::write_result("result.h5", study::answer(question));
  const Cover cover = result::read_result("result.h5").cover;
  int isolated = 0;
  for (const CoverBox& point : cover.points) isolated += point.verdict == Verdict::isolated;
  std::cout << isolated << " isolated, " << (cover.complete() ? "complete" : "incomplete") << "\n";
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
}
