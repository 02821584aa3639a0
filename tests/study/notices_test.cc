// What is said of a model that is right by its letter and looks wrong.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "corank/study/model.h"

namespace corank::study {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<std::string> notices_of_arm(const std::string& limits) {
  return parse_model({"[DH]\nstandard\na alpha d theta\n325 0 200 q1 limits " + limits + "\n275 0 0 q2\n", "arm.cuik"})
      .notices;
}

TEST(Notices, SayThatARangeLooksLikeDegrees) {
  EXPECT_THAT(notices_of_arm("[-132, 132]"), ElementsAre(HasSubstr("the range of q1 is more than six turns")));
  EXPECT_THAT(notices_of_arm("[-132deg, 132deg]"), IsEmpty());
  EXPECT_THAT(notices_of_arm("[-2*pi, 2*pi]"), IsEmpty()) << "on many data sheets";
  const auto of_equations = [](const std::string& range) {
    return parse_model({"[SYSTEM VARS]\nx : [-180, 180]\nphi ~ " + range + "\n[SYSTEM EQS]\nx = cos(phi);\n", "x.cuik"})
        .notices;
  };
  EXPECT_THAT(of_equations("[-180, 180]"), ElementsAre(HasSubstr("the range of phi is more than six turns")));
  EXPECT_THAT(of_equations("[-180deg, 180deg]"), IsEmpty());
}

}  // namespace
}  // namespace corank::study
