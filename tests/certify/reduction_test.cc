// A step of a reduction is applied only where it is legal.
#include "corank/certify/reduction.h"

#include <gtest/gtest.h>

#include "corank/core/check.h"
#include "corank/tests/applied_steps.h"
#include "corank/tests/system_builder.h"

namespace corank::certify {
namespace {

// x − 2y = 0, √2 z + x² = 0, cos t = x, w in [1, 1].
System system() {
  test::SystemBuilder b;
  const int x = b.variable("x", "-1", "1"), y = b.variable("y", "-1", "1"), z = b.variable("z", "-2", "2"),
            t = b.variable("t", "-4", "4");
  b.variable("w", "1", "1");
  b.equation({{"1", {{x, 1}}}, {"-2", {{y, 1}}}}).equation({{"1", {{z, 1}}}, {"1", {{x, 2}}}});
  b.equation({{"1", {{t, 1, Function::cosine}}}, {"-1", {{x, 1}}}});
  System result = b.system();
  result.equations[1].monomials[0] = Monomial(ExactNumber::apply(ConstantFunction::sqrt, 2), {{z, 1}});
  return result;
}

TEST(Reduction, AppliesLegalSteps) {
  const Reduction r =
      certify::apply(system(), {Elimination{4, {}}, SumOfEquations{1, 0, ExactNumber(3)}, Elimination{1, 0}});
  EXPECT_EQ(r.kept, (std::vector<int>{0, 2, 3}));
  EXPECT_EQ(r.system.equations.size(), 2u);
  EXPECT_EQ(r.steps.size(), 3u);
}

TEST(Reduction, RefusesAStepThatIsNotLegal) {
  const auto refuses = [](const std::vector<ReductionStep>& steps, System of = system()) {
    EXPECT_THROW(certify::apply(of, steps), InvariantError);
  };
  refuses({Elimination{2, 1}});                       // its coefficient is not rational
  refuses({Elimination{0, 1}});                       // a square
  refuses({Elimination{3, 2}});                       // inside a cosine
  refuses({Elimination{0, {}}});                      // its domain is more than one number
  refuses({Elimination{1, 0}, Elimination{0, 0}});    // its equation is gone
  refuses({Elimination{4, {}}, Elimination{4, {}}});  // it is gone
  refuses({SumOfEquations{1, 1, ExactNumber(-1)}});   // of an equation and itself
  refuses({SumOfEquations{0, 1, ExactNumber::apply(ConstantFunction::sqrt, 2)}});
  refuses({ImpliedEquation{}});
  System tolerant = system();
  tolerant.coefficient_tolerance = 1e-3;
  refuses({SumOfEquations{0, 1, ExactNumber(1)}}, tolerant);  // a tolerance is about the equations as given
  tolerant.equations[0].monomials[1] = Monomial(ExactNumber::rational("-5/2"), {{1, 1}});
  refuses({Elimination{0, 0}}, tolerant);  // its definition would carry the tolerance
}

}  // namespace
}  // namespace corank::certify
