#include "corank/solve/reduction/product_elimination.h"

#include <gtest/gtest.h>

#include <cmath>

#include "corank/core/rounding.h"
#include "corank/solve/reduction/reducer.h"
#include "corank/tests/system_builder.h"

namespace corank::solve {
namespace {

using namespace certify;
using test::SystemBuilder;

// How many terms of the equations are no residues, by degree 2 and 1.
std::pair<int, int> terms(const Reduction& r) {
  std::vector<double> sizes;
  for (const Variable& v : r.system.variables) sizes.push_back(v.domain.mag());
  int products = 0, linear = 0;
  for (const Polynomial& f : r.system.equations)
    for (const Monomial& m : without_residues(f, sizes).monomials) {
      products += m.degree() > 1;
      linear += m.degree() == 1;
    }
  return {products, linear};
}

TEST(ProductElimination, LeavesSharedProductsInAsManyEquationsAsTheirCombinationsAreMany) {
  // Three equations in xy and yz: of rank 2 in them, so one is linear.
  SystemBuilder b;
  const int x = b.variable("x", "-1", "1"), y = b.variable("y", "-1", "1"), z = b.variable("z", "-1", "1");
  b.equation({{"1", {{x, 1}, {y, 1}}}, {"2", {{y, 1}, {z, 1}}}, {"1", {{x, 1}}}});
  b.equation({{"3", {{x, 1}, {y, 1}}}, {"1", {{y, 1}, {z, 1}}}, {"1", {{y, 1}}}});
  b.equation({{"4", {{x, 1}, {y, 1}}}, {"-7", {{y, 1}, {z, 1}}}, {"1", {{z, 1}}}, {"1/5", {}}});
  const UpwardRounding rounding;
  EXPECT_EQ(terms(reduce(b.system())).first, 2);
}

// Two spheres with irrational centres: their difference is a plane.
System spheres(const std::string& a, const std::string& c) {
  SystemBuilder b;
  const int x = b.variable("x", "-3", "3"), y = b.variable("y", "-3", "3"), z = b.variable("z", "-3", "3");
  b.equation({{"1", {{x, 2}}}, {"1", {{y, 2}}}, {"1", {{z, 2}}}, {a, {{x, 1}}}, {"-1", {}}});
  b.equation({{c, {{x, 2}}}, {c, {{y, 2}}}, {c, {{z, 2}}}, {"1", {{y, 1}}}, {"1", {{z, 1}}}, {"-2", {}}});
  return b.system();
}

TEST(ProductElimination, TakesTheDifferenceOfTwoSpheres) {
  const UpwardRounding rounding;
  EXPECT_EQ(terms(reduce(spheres("1/2", "3"))), (std::pair{3, 4}));
}

TEST(ProductElimination, LeavesNoResidueWhereQuotientsAreRational) {
  const UpwardRounding rounding;
  std::size_t all = 0;
  const Reduction r = reduce(spheres("1/2", "3"));
  for (const Polynomial& f : r.system.equations) all += f.monomials.size();
  const auto [products, linear] = terms(r);
  EXPECT_EQ(all, static_cast<std::size_t>(products + linear) + 2) << "and two constants";
}

TEST(ProductElimination, TakesIrrationalAndRoundedCoefficientsForWhatTheyAre) {
  const UpwardRounding rounding;
  // The same rows, times √2 in exact numbers or rounded to 12 digits each.
  const auto scaled = [](const std::vector<ExactNumber>& c) {
    System s = spheres("1/2", "3");
    std::size_t k = 0;
    for (Monomial& m : s.equations[1].monomials) m = Monomial(m.coefficient * c[k++ % c.size()], m.factors);
    return s;
  };
  const ExactNumber root = ExactNumber::apply(ConstantFunction::sqrt, 2);
  EXPECT_EQ(terms(reduce(scaled({root}))), (std::pair{3, 4}));
  EXPECT_EQ(terms(reduce(scaled({ExactNumber::rational("1.414213562373"), ExactNumber::rational("1.414213562374"),
                                 ExactNumber::rational("1.414213562372")}))),
            (std::pair{3, 4}));
}

TEST(ProductElimination, LeavesEquationsAloneWhereItGainsNothing) {
  SystemBuilder b;
  const int x = b.variable("x", "-1", "1"), y = b.variable("y", "-1", "1");
  b.equation({{"1", {{x, 2}}}, {"1", {{y, 2}}}, {"-1", {}}});
  b.equation({{"1", {{x, 2}}}, {"3", {{x, 1}, {y, 1}}}, {"1", {{y, 1}}}});
  EXPECT_TRUE(eliminate_products(b.system().equations, {1, 1}, [] {}).empty());
}

TEST(ProductElimination, TakesNoResidueForAPivot) {
  // xy with 1e-12 is what rounding has left: eliminating it would multiply the other equation by 1e12.
  SystemBuilder b;
  const int x = b.variable("x", "-1", "1"), y = b.variable("y", "-1", "1");
  b.equation({{"1e-12", {{x, 1}, {y, 1}}}, {"1", {{x, 1}}}, {"1", {{y, 1}}}});
  b.equation({{"1", {{x, 1}, {y, 1}}}, {"1", {{x, 1}}}, {"-1", {{y, 1}}}});
  for (const RowSum& sum : eliminate_products(b.system().equations, {1, 1}, [] {}))
    EXPECT_LT(sum.factor.enclose().mag(), 1e6);
  const UpwardRounding rounding;
  for (const ReductionStep& step : reduce(b.system()).steps)
    if (const auto* sum = std::get_if<SumOfEquations>(&step)) {
      EXPECT_LT(sum->factor.enclose().mag(), 1e6);
    }
}

TEST(ProductElimination, ComparesTermsByWhatTheyContribute) {
  // In millimetres x² has a small coefficient, and is no residue.
  SystemBuilder b;
  const int x = b.variable("x", "-1e6", "1e6"), y = b.variable("y", "-1", "1");
  b.equation({{"1e-12", {{x, 2}}}, {"1", {{y, 1}}}});
  EXPECT_EQ(without_residues(b.system().equations[0], {1e6, 1}).monomials.size(), 2u);
  EXPECT_EQ(without_residues(b.system().equations[0], {1, 1}).monomials.size(), 1u);
}

}  // namespace
}  // namespace corank::solve
