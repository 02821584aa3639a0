// Zeros in many digits, also where they are multiple.
#include "corank/solve/step/approximate_zero.h"

#include <gtest/gtest.h>

#include <future>
#include <thread>
#include <utility>

#include "corank/tests/system_builder.h"

namespace corank::solve {
namespace {

// x² + y² = 1, x = y.
System diagonal() {
  test::SystemBuilder b;
  const int x = b.variable("x", "-2", "2"), y = b.variable("y", "-2", "2");
  b.equation({{"1", {{x, 2}}}, {"1", {{y, 2}}}, {"-1", {}}}).equation({{"1", {{x, 1}}}, {"-1", {{y, 1}}}});
  return b.system();
}

TEST(ApproximateZero, ConvergesAtADoubleRoot) {
  // (x − 1/3)² = 0, y = x: each step halves the error.
  test::SystemBuilder b;
  const int x = b.variable("x", "-1", "1"), y = b.variable("y", "-1", "1");
  b.equation({{"9", {{x, 2}}}, {"-6", {{x, 1}}}, {"1", {}}}).equation({{"1", {{x, 1}}}, {"-1", {{y, 1}}}});
  const auto zero = approximate_zero(b.system(), {ExactNumber::dyadic(0.333), ExactNumber::dyadic(0.334)}, 512);
  ASSERT_TRUE(zero);
  const ExactNumber error = (*zero)[1] - ExactNumber::rational("1/3"), bound = pow(ExactNumber(2), -200);
  EXPECT_EQ((error - bound).sign(), -1);
  EXPECT_EQ((error + bound).sign(), 1);
}

TEST(ApproximateZero, ConvergesAtATripleRootAtZero) {
  // x³ = 0: each step takes a third off, and no term is ever larger than what is left.
  test::SystemBuilder b;
  const int x = b.variable("x", "-1", "1");
  b.equation({{"1", {{x, 3}}}});
  const auto zero = approximate_zero(b.system(), {ExactNumber::dyadic(0.25)}, 256);
  ASSERT_TRUE(zero);
  EXPECT_EQ(((*zero)[0] - pow(ExactNumber(2), -60)).sign(), -1);
}

TEST(ApproximateZero, IsNotWhereEquationsContradictOneAnother) {
  test::SystemBuilder b;
  const int x = b.variable("x", "-1", "1");
  b.equation({{"1", {{x, 2}}}, {"1/100", {}}});
  EXPECT_FALSE(approximate_zero(b.system(), {ExactNumber::dyadic(0.25)}, 256));
  b.equation({{"1", {{x, 1}}}, {"-1/2", {}}});
  EXPECT_FALSE(approximate_zero(b.system(), {ExactNumber::dyadic(0.25)}, 256));
}

TEST(ApproximateZero, HasItsBitsWhateverAnotherThreadDoesMeanwhile) {
  const System system = diagonal();
  const std::vector<ExactNumber> start(2, ExactNumber::dyadic(0.707));
  const auto alone = approximate_zero(system, start, 512);
  ASSERT_TRUE(alone);
  // The other thread is amid its own Newton steps, of fewer bits, as long as this one goes on.
  std::promise<void> amid, over;
  std::thread other;
  const auto beside = approximate_zero(system, start, 512, [&] {
    if (other.joinable()) return false;
    other = std::thread([&, first = true]() mutable {
      EXPECT_TRUE(approximate_zero(system, start, 64, [&] {
        if (std::exchange(first, false)) amid.set_value(), over.get_future().wait();
        return false;
      }));
    });
    amid.get_future().wait();
    return false;
  });
  over.set_value();
  other.join();
  ASSERT_TRUE(beside);
  for (std::size_t j = 0; j < start.size(); ++j) EXPECT_EQ(((*beside)[j] - (*alone)[j]).sign(), 0) << j;
}

}  // namespace
}  // namespace corank::solve
