#include "corank/symbolic/model/mechanism.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace corank::symbolic {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// y_A² + x_C² = L1², y_B² + x_C² = L2², input y_A, output y_B.
Mechanism three_slider() {
  Mechanism m("three-slider");
  const Expression l1 = m.constant("L1", 1), l2 = m.constant("L2", "4/5");
  const Expression y_a = m.length("y_A", -l1, l1), y_b = m.length("y_B", -l2, l2), x_c = m.length("x_C", -l1, l1);
  m.constrain(pow(y_a, 2) + pow(x_c, 2) == pow(l1, 2));
  m.constrain(pow(y_b, 2) + pow(x_c, 2) == pow(l2, 2));
  m.inputs({y_a});
  m.outputs({y_b});
  return m;
}

template <typename Action>
std::string message_of(Action action) {
  try {
    action();
  } catch (const ModelError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Mechanism, IsBuiltWithoutAFile) {
  const Mechanism m = three_slider();
  m.validate();
  EXPECT_EQ(m.name(), "three-slider");
  EXPECT_EQ(m.constants().size(), 2u);
  EXPECT_EQ(m.coordinates().size(), 3u);
  EXPECT_THAT(m.inputs(), ElementsAre("y_A"));
  EXPECT_THAT(m.outputs(), ElementsAre("y_B"));
  EXPECT_EQ(m.constraints()[0].relation.text(), "y_A^2 + x_C^2 = L1^2");
  EXPECT_EQ(m.coordinates()[1].lower.text(), "-L2");
  EXPECT_FALSE(m.is_plain_system());
  EXPECT_EQ(m.find_coordinate("x_C"), 2);
  EXPECT_EQ(m.find_coordinate("L1"), -1);
  EXPECT_TRUE(m.has_constant("L1"));
  EXPECT_FALSE(m.has_constant("x_C"));
  EXPECT_TRUE(m.source_text().empty());
}

TEST(Mechanism, GivesAnglesTheWholeCircleByDefault) {
  Mechanism m;
  m.angle("theta");
  EXPECT_EQ(m.coordinates()[0].kind, CoordinateKind::angle);
  EXPECT_EQ(m.coordinates()[0].lower.text(), "-pi");
  EXPECT_EQ(m.coordinates()[0].upper.text(), "pi");
}

TEST(Mechanism, OverridesAConstant) {
  Mechanism m = three_slider();
  m.set_constant("L2", "L1/2");
  EXPECT_EQ(m.constants()[1].value.text(), "L1/2");
  m.validate();
  EXPECT_EQ(message_of([&] { m.set_constant("L3", 1); }), "three-slider: there is no constant 'L3'; expected one of L1, L2");
  m.set_constant("L1", "L2");  // declared after L1
  EXPECT_THAT(message_of([&] { m.validate(); }),
              HasSubstr("the constant 'L2' in the constant 'L1' is used before its declaration"));
}

TEST(Mechanism, RefusesNamesThatAreTakenReservedOrNone) {
  Mechanism m = three_slider();
  EXPECT_THAT(message_of([&] { m.constant("y_A", 1); }), HasSubstr("'y_A' is already declared"));
  EXPECT_THAT(message_of([&] { m.length("L1", 0, 1); }), HasSubstr("'L1' is already declared"));
  EXPECT_THAT(message_of([&] { m.angle("pi"); }), HasSubstr("'pi' is reserved"));
  EXPECT_THAT(message_of([&] { m.constant("cos", 1); }), HasSubstr("'cos' is reserved"));
  EXPECT_THAT(message_of([&] { m.constant("2l", 1); }), HasSubstr("'2l' is not a name"));
  EXPECT_THAT(message_of([&] { m.constant("", 1); }), HasSubstr("'' is not a name"));
  EXPECT_THAT(message_of([&] { m.constant("θ", 1); }), HasSubstr("'θ' is not a name"));
  EXPECT_EQ(m.constants().size(), 2u);
}

TEST(Mechanism, RefusesInputsThatAreNoCoordinatesOrChosenTwice) {
  Mechanism m = three_slider();
  EXPECT_THAT(message_of([&] { m.inputs({"L1"}); }), HasSubstr("the input 'L1' is a constant"));
  EXPECT_THAT(message_of([&] { m.inputs({"z"}); }), HasSubstr("the input 'z' is not declared"));
  EXPECT_THAT(message_of([&] { m.inputs({"x_C + 1"}); }), HasSubstr("the input 'x_C + 1' is not a name"));
  EXPECT_THAT(message_of([&] { m.inputs({"y_A"}); }), HasSubstr("the input 'y_A' is named twice"));
  EXPECT_THAT(message_of([&] { m.inputs({"y_B"}); }), HasSubstr("the input 'y_B' is already an output"));
  EXPECT_THAT(message_of([&] { m.outputs({"x_C", "x_C"}); }), HasSubstr("the output 'x_C' is named twice"));
  EXPECT_THAT(m.outputs(), ElementsAre("y_B")) << "a refused call must leave nothing behind";
  m.inputs({"x_C"});
  EXPECT_THAT(m.inputs(), ElementsAre("y_A", "x_C"));
}

TEST(Mechanism, ValidateNamesTheUnknownNameAndItsOwner) {
  Mechanism m = three_slider();
  m.constrain(Expression("y_A + q") <= 1, {"m.cuik", 7, 3});
  EXPECT_EQ(message_of([&] { m.validate(); }),
            "m.cuik:7:3: the name 'q' in an equation is not declared; expected a declared constant or variable");
}

TEST(Mechanism, ValidateRefusesAnEmptyMechanism) {
  Mechanism m("nothing");
  EXPECT_EQ(message_of([&] { m.validate(); }),
            "nothing: the model has no variables; expected at least one, in [SYSTEM VARS]");
  m.length("x", 0, 1);
  EXPECT_EQ(message_of([&] { m.validate(); }),
            "nothing: the model has no equations; expected at least one, in [SYSTEM EQS]");
}

TEST(Mechanism, ValidateRefusesPowersThatExactArithmeticCouldNotEnd) {
  const auto message = [](std::vector<const char*> constants, const char* equation) {
    Mechanism m;
    const Expression x = m.length("x", 0, 1);
    for (std::size_t i = 0; i < constants.size(); ++i) m.constant("c" + std::to_string(i + 1), constants[i]);
    m.constrain(Expression(equation) == 0);
    return message_of([&] { m.validate(); });
  };
  EXPECT_EQ(message({"9"}, "x^c1"), "no error");
  EXPECT_EQ(message({}, "x^1000 - 2^-1000"), "no error");
  EXPECT_THAT(message({}, "x^1001"), HasSubstr("the exponent '1001' in an equation is too large"));
  EXPECT_THAT(message({"9^9^9"}, "x"), HasSubstr("the exponent '9^9' in the constant 'c1' is too large"));
  EXPECT_THAT(message({"9^9"}, "x^-c1"), HasSubstr("the exponent '-c1' in an equation is too large"));
  EXPECT_THAT(message({"1e400*1e400"}, "x^c1"), HasSubstr("too large"));
  EXPECT_THAT(message({}, "((x^1000)^1000)^1000"), HasSubstr("the powers in an equation are too large"));
  EXPECT_THAT(message({"1.1", "c1^1000", "c2^1000"}, "x"), HasSubstr("the powers in the constant 'c3' are too large"));
  Mechanism m;  // constants that square the one before: 2^40 factors in the last
  Expression c = m.constant("a0", "3/2");
  for (int i = 1; i < 40; ++i) c = m.constant("a" + std::to_string(i), c * c);
  EXPECT_THAT(message_of([&] { m.validate(); }), HasSubstr("the powers in the constant 'a16' are too large"));
}

}  // namespace
}  // namespace corank::symbolic
