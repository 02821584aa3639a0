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
}

}  // namespace
}  // namespace corank::study
