#include <gtest/gtest.h>

#include <set>

#include "corank/report/pictures/set_look.h"

namespace corank::report {
namespace {

TEST(SetLook, IsOneForEachSet) {
  for (const symbolic::SetDefinition& set : symbolic::set_definitions()) EXPECT_EQ(look(set).set, set.set) << set.name;
  EXPECT_FALSE(look(symbolic::definition(std::nullopt)).set);
}

TEST(SetLook, DrawsEachSetInALayerOfItsOwn) {
  std::set<int> layers;
  for (const symbolic::SetDefinition& set : symbolic::set_definitions())
    EXPECT_TRUE(layers.insert(look(set).drawn.layer).second) << set.name;
}

}  // namespace
}  // namespace corank::report
