// What the table of sets says is consistent, and who asks by name finds it.
#include "corank/symbolic/model/set_definition.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace corank::symbolic {
namespace {

TEST(SetDefinitions, AreFoundByTheirNamesAndByTheirSets) {
  for (const SetDefinition& d : set_definitions()) {
    ASSERT_TRUE(d.set);
    EXPECT_EQ(&definition(d.set), &d);
    EXPECT_EQ(&definition(std::string(d.name)), &d);
    EXPECT_EQ(singularity_set_from_string(to_string(*d.set)), d.set);
  }
  const std::string kernels = "forward, inverse, cspace-singular, forward-inverse, ro, rpm, ii, ri, io, iim or requirements";
  EXPECT_EQ(names_of_sets(),
            "cspace, forward, inverse, cspace-singular, boundary, forward-inverse, ro, rpm, ii, ri, io, iim, requirements, "
            "forward-cusps, inverse-cusps, forward-nodes or inverse-nodes");
  EXPECT_EQ(names_of_sets(true), kernels);
}

TEST(SetDefinitions, OfTypesAndOfTwoKernelsAreShownOnDemandOnly) {
  int usual = 0;
  for (const SetDefinition& d : set_definitions()) {
    usual += d.is_usual();
    EXPECT_EQ(d.is_usual(),
              !d.type && d.also_locked.empty() && d.part == LocusPart::all && !d.of_parts && !d.of_requirements)
        << d.name;
  }
  EXPECT_EQ(usual, 4);
}

TEST(SetDefinitions, KnowAPlainSystemUnderAnyOtherName) {
  for (const std::string name : {"system", "", "Forward", "outverse"}) {
    EXPECT_EQ(&definition(name), &definition(std::nullopt));
    EXPECT_FALSE(singularity_set_from_string(name));
  }
  EXPECT_FALSE(definition(std::nullopt).has_kernel());
  EXPECT_FALSE(definition(std::nullopt).is_cspace());
}

}  // namespace
}  // namespace corank::symbolic
