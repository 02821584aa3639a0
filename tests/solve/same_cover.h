// Two covers that are to be the same, to the last bit; and systems whose searches have all kinds of passes.
#pragma once

#include <gtest/gtest.h>

#include "corank/solve/search/solve.h"
#include "corank/tests/solve/cover_questions.h"

namespace corank::solve {

inline void expect_same(const Cover& one, const Cover& other) {
  ASSERT_EQ(one.boxes.size(), other.boxes.size());
  for (std::size_t i = 0; i < one.boxes.size(); ++i) {
    ASSERT_EQ(one.boxes[i].box, other.boxes[i].box) << i;
    ASSERT_EQ(one.boxes[i].verdict, other.boxes[i].verdict) << i;
    ASSERT_EQ(one.boxes[i].free, other.boxes[i].free) << i;
    ASSERT_EQ(one.boxes[i].region, other.boxes[i].region) << i;
    ASSERT_EQ(one.boxes[i].reason, other.boxes[i].reason) << i;
  }
  EXPECT_EQ(one.regions, other.regions);
  EXPECT_EQ(one.sigma, other.sigma);
  EXPECT_EQ(one.points.size(), other.points.size());
  EXPECT_EQ(one.self_motions.size(), other.self_motions.size());
  EXPECT_EQ(one.statistics.processed, other.statistics.processed);
  EXPECT_EQ(one.statistics.newton_steps, other.statistics.newton_steps);
  ASSERT_EQ(one.proof != nullptr, other.proof != nullptr);
  EXPECT_TRUE(!one.proof || *one.proof == *other.proof);
}

inline Prepared prepared_with(const System& system, Options options) {
  Control control;
  return prepare(system, options, control);
}

inline System lemniscate() {
  SystemBuilder b;
  const int x = b.variable("x", "-2", "2"), y = b.variable("y", "-2", "2");
  b.equation({{"1", {{x, 4}}}, {"-1", {{x, 2}}}, {"1", {{y, 2}}}});
  return b.system();
}

inline System plane_and_line() {
  SystemBuilder b;  // x (x − y) = 0, z (x − y) = 0: a plane, and the line x = z = 0
  const int x = b.variable("x", "-1", "1"), y = b.variable("y", "-1", "1"), z = b.variable("z", "-1", "1");
  b.equation({{"1", {{x, 2}}}, {"-1", {{x, 1}, {y, 1}}}});
  b.equation({{"1", {{z, 1}, {x, 1}}}, {"-1", {{z, 1}, {y, 1}}}});
  return b.system();
}

}  // namespace corank::solve
