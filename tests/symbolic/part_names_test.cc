#include "corank/symbolic/sets/part_names.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace corank::symbolic {
namespace {

TEST(PartNames, HaveRoundedValuesInPlaceOfCoranksOwnConstantsAndOfLongNumbers) {
  Mechanism mechanism("m");
  for (const auto& [name, value] : {std::pair("l", "2"), {"k1", "1/3"}, {"k2", "sqrt(2)"}, {"k3", "-k2"}, {"kx", "sqrt(3)"}})
    mechanism.constant(name, value);
  const auto name_of = [&](const std::string& condition) {
    std::vector<Component> parts{{.name = condition + " = 0", .conditions = {Expression(condition)}}};
    name_by_values(mechanism, parts);
    EXPECT_EQ(parts[0].former_name, parts[0].name == condition + " = 0" ? "" : condition + " = 0");
    return parts[0].name;
  };
  EXPECT_EQ(name_of("l*x - k1*y + kx*sin(z)"), "l*x - k1*y + kx*sin(z) = 0");
  EXPECT_EQ(name_of("k2*x - y"), "1.41421*x - y = 0");
  EXPECT_EQ(name_of("3*k2*l*x - k3*y"), "4.24264*l*x + 1.41421*y = 0");
  EXPECT_EQ(name_of("k3*x + y"), "1.41421*x - y = 0");
  EXPECT_EQ(name_of("x + k2"), "x + 1.41421 = 0");
  EXPECT_EQ(name_of("1/2*k2^2*x - y"), "x - y = 0");
  EXPECT_EQ(name_of("x*sin(y + k3)"), "x*sin(y - 1.41421) = 0");
  EXPECT_EQ(name_of("500000000*cos(x) - 3987654321*sin(x)"), "0.5*cos(x) - 3.98765*sin(x) = 0");
  EXPECT_EQ(name_of("1.2345678*x - l*y"), "1.23457*x - l*y = 0");
  EXPECT_EQ(name_of("123456*x - l*y"), "123456*x - l*y = 0");
}

TEST(PartNames, AreNotTheSameWhereValuesRoundToTheSame) {
  Mechanism mechanism("m");
  mechanism.constant("k1", "sqrt(2)");
  mechanism.constant("k2", "sqrt(2.00000001)");
  std::vector<Component> parts{{.name = "k1*x - y = 0", .conditions = {Expression("k1*x - y")}},
                               {.name = "k2*x - y = 0", .conditions = {Expression("k2*x - y")}},
                               {.name = "k1*x + y = 0, elsewhere", .conditions = {Expression("k1*x + y")}, .is_rest = true},
                               {.name = "condition on x, y", .conditions = {Expression("k1*x^2 + y")}}};
  name_by_values(mechanism, parts);
  EXPECT_EQ(parts[0].name, "1.41421*x - y = 0");
  EXPECT_EQ(parts[1].name, "k2*x - y = 0");
  EXPECT_EQ(parts[2].name, "1.41421*x + y = 0, elsewhere");
  EXPECT_EQ(parts[2].former_name, "k1*x + y = 0, elsewhere");
  EXPECT_EQ(parts[3].name, "condition on x, y");
}

}  // namespace
}  // namespace corank::symbolic
