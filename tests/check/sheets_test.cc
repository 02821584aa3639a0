// Boxes about a sheet, each just on the wrong side of one of the claims that check/sheets.h lists.
#include "corank/check/sheets.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "corank/tests/check/covers.h"

namespace corank::check {
namespace {

using testing::HasSubstr;

struct Claim {
  Verdict verdict = Verdict::regular;
  std::vector<int> free;
  Box box, region;
};

std::string fault(const System& system, const Claim& claim, const std::vector<ReductionStep>& reduction = {}) {
  const Problem problem(system, reduction);
  const CoverBox box{claim.box, claim.verdict, claim.free, 0};
  return check_sheet(problem, problem.equations(), box, claim.region);
}

std::string fault_of_part(const System& system, const Claim& claim, const std::vector<ReductionStep>& reduction = {}) {
  const Problem problem(system, reduction);
  return check_sheet_or_part(problem, {claim.box, claim.verdict, claim.free, 0}, claim.region);
}

System lines(const std::string& domain = "[-9, 9]") {
  return plain("[SYSTEM VARS]\nx : " + domain + "\ny : [-9, 9]\nw : [-9, 9]\n[SYSTEM EQS]\nx = y;\nw = y;\n");
}

TEST(Sheet, HasASolutionForEveryValueOfTheFreeVariables) {
  const Interval all(-0.5, 1.5), part(0.5, 1.5), y(0, 1);
  EXPECT_EQ(fault(lines(), {Verdict::regular, {1}, {all, y, all}, {all, y, all}}), "");
  EXPECT_NE(fault(lines(), {Verdict::regular, {1}, {part, y, all}, {part, y, all}}), "") << "x = y < 1/2 is not in it";
  EXPECT_NE(fault(lines(), {Verdict::regular, {1}, {all, y, part}, {all, y, part}}), "");
  EXPECT_NE(fault(lines(), {Verdict::regular, {1}, {part, y, all}, {all, y, all}}), "");
}

TEST(Sheet, HasOneSolutionInItsRegionNotOnlyInItsBox) {
  const System system = plain("[SYSTEM VARS]\nx : [-9, 9]\ny : [-9, 9]\n[SYSTEM EQS]\nx^2 = y;\n");
  const Interval side(0.9, 1.1);
  EXPECT_EQ(fault(system, {Verdict::regular, {1}, {side, side}, {{0.5, 2}, side}}), "");
  for (const double beyond : {-2.0, -1.0, -0.97})
    EXPECT_NE(fault(system, {Verdict::regular, {1}, {side, side}, {{beyond, 2}, side}}), "") << beyond;
}

TEST(Sheet, HasTheFreeVariablesThatItsVerdictSays) {
  const System system = plain("[SYSTEM VARS]\nx : [-9, 9]\ny : [-9, 9]\n[SYSTEM EQS]\nx^2 = y;\n");
  const Interval side(0.9, 1.1);
  EXPECT_THAT(fault(system, {Verdict::isolated, {1}, {side, side}, {side, side}}), HasSubstr("contradict its verdict"));
  EXPECT_THAT(fault(system, {Verdict::regular, {1, 1}, {side, side}, {side, side}}), HasSubstr("distinct"));
  EXPECT_THAT(fault(system, {Verdict::regular, {}, {side, side}, {side, side}}), HasSubstr("not as many"));
  const System point = plain("[SYSTEM VARS]\nx : [-9, 9]\n[SYSTEM EQS]\nx^2 = 1;\n");
  EXPECT_THAT(fault(point, {Verdict::regular, {}, {side}, {side}}), HasSubstr("contradict its verdict"));
  EXPECT_EQ(fault(point, {Verdict::isolated, {}, {side}, {side}}), "");
}

TEST(Sheet, IsNoPointWhereItsRegionHoldsTwoOrNone) {
  const System system = plain("[SYSTEM VARS]\nx : [-9, 9]\n[SYSTEM EQS]\nx^2 = 1;\n");
  const Interval near(0.9, 1.1);
  EXPECT_EQ(fault(system, {Verdict::isolated, {}, {near}, {{0.5, 2}}}), "");
  for (const Interval& region : {Interval(-2, 2), Interval(-1, 1.5)})
    EXPECT_NE(fault(system, {Verdict::isolated, {}, {near}, {region}}), "") << region.lo();
  EXPECT_NE(fault(system, {Verdict::isolated, {}, {{1.1, 1.2}}, {{1.05, 2}}}), "");
  const System doubled = plain("[SYSTEM VARS]\nx : [-9, 9]\n[SYSTEM EQS]\n(x - 1)^2 = 0;\n");
  EXPECT_NE(fault(doubled, {Verdict::isolated, {}, {near}, {{0.5, 2}}}), "");
}

TEST(Sheet, LiesInsideItsRegion) {
  const System system = plain("[SYSTEM VARS]\nx : [-9, 9]\n[SYSTEM EQS]\nx^2 = 1;\n");
  EXPECT_THAT(fault(system, {Verdict::isolated, {}, {{0.5, 2}}, {{0.9, 1.1}}}), HasSubstr("not inside the region"));
}

TEST(Sheet, HoldsTheValuesOfEliminatedVariables) {
  const System system = plain("[SYSTEM VARS]\nx : [-9, 9]\ny : [-9, 9]\nz : [-9, 9]\n[SYSTEM EQS]\nx^2 = y;\nz = x + y;\n");
  const auto with = [&](const Interval& z) {
    const Interval side(0.9, 1.1);
    return fault(system, {Verdict::regular, {1}, {side, side, z}, {{0.5, 2}, side, {-9, 9}}}, {Elimination{2, 1}});
  };
  EXPECT_EQ(with({1.8, 2.2}), "");
  EXPECT_THAT(with({2.2, 2.3}), HasSubstr("outside it (z)"));
  EXPECT_THAT(with({2, 2.2}), HasSubstr("outside it (z)"));
}

TEST(Sheet, LiesInTheDomainUnlessItIsBoundary) {
  const Interval side(-0.5, 2.5), y(0, 2), w(-1, 3);
  const Claim claim{Verdict::regular, {1}, {side, y, w}, {{-1, 3}, y, {-2, 4}}};
  EXPECT_EQ(fault(lines(), claim), "");
  for (const char* domain : {"[-9, 1]", "[1, 9]", "[-9, 1999/1000]", "[1/1000, 9]"}) {
    EXPECT_THAT(fault(lines(domain), claim), HasSubstr("violate")) << domain;
    Claim boundary = claim;
    boundary.verdict = Verdict::boundary;
    EXPECT_EQ(fault(lines(domain), boundary), "") << domain;
  }
}

TEST(Sheet, ReachesWithAFreeSideNoFartherThanTheDoubleNextToItsRange) {
  const System system = plain("[SYSTEM VARS]\nx : [-9, 9]\ny : [0, 2/5]\n[SYSTEM EQS]\nx^2 = y;\n");
  const auto to = [&](double end) {
    const Interval x(0.5, 0.7), y(0.3, end);
    return fault(system, {Verdict::regular, {1}, {x, y}, {{0.4, 0.8}, y}});
  };
  EXPECT_EQ(to(0.4), "");
  EXPECT_THAT(to(std::nextafter(0.4, 1.0)), HasSubstr("violate the domain of y"));
}

// x = 2/5 + 10⁻¹⁷, which is less than the double next to 2/5, and more than 2/5.
TEST(Sheet, HasItsPointInTheDomainAsItIsWritten) {
  const std::string equations = "\n[SYSTEM EQS]\n(x - 40000000000000001/100000000000000000)*(x + 5) = 0;\n";
  const Claim claim{Verdict::isolated, {}, {{0.39, 0.4}}, {{0.3, 0.5}}};
  EXPECT_EQ(fault(plain("[SYSTEM VARS]\nx : [0, 1]" + equations), claim), "");
  EXPECT_THAT(fault(plain("[SYSTEM VARS]\nx : [0, 2/5]" + equations), claim), HasSubstr("violates the domain of x"));
}

// What is left of a piece that meets its part of the search in a corner: dependent sides are known to a few doubles there.
TEST(Sheet, MayHaveFreeSidesThatAreAPoint) {
  const System system =
      plain("[SYSTEM VARS]\nx : [-9, 9]\ny : [-9, 9]\nz : [-9, 9]\n[SYSTEM EQS]\nx^2 + z = y;\nz^2 + x = y;\n");
  const double solution = (std::sqrt(13) - 1) / 2, unit = 0x1p-52;  // of x and z, where y = 3
  const auto with = [&](double to, double lower, double upper) {
    const Interval y(3, to), side(solution + lower, solution + upper), region(1, 1.7);
    return fault(system, {Verdict::regular, {1}, {side, y, side}, {region, y, region}});
  };
  for (const double to : {3.0, std::nextafter(3.0, 4.0)}) {
    EXPECT_EQ(with(to, -2 * unit, 3 * unit), "") << to;
    EXPECT_NE(with(to, 2 * unit, 3 * unit), "") << to;
    EXPECT_NE(with(to, 1e-3, 2e-3), "") << to;
    EXPECT_NE(with(to, -2e-3, -1e-3), "") << to;
  }
}

// Two legs of a 3-RRR platform. No step about a middle shows that there is a solution near the corner, and the Y of the
// corner not that there is only one.
TEST(Sheet, MayBeInACornerOfItsRegion) {
  const System system = plain(
      "[SYSTEM VARS]\nc1 : [-1, 1]\ns1 : [-1, 1]\ne1 : [-1, 1]\nf1 : [-1, 1]\nc2 : [-1, 1]\ns2 : [-1, 1]\ne2 : [-1, 1]\n"
      "f2 : [-1, 1]\nx : [-400, 400]\ny : [-400, 400]\n[SYSTEM EQS]\n41 + 200*c1 + 180*e1 = x;\n207.2 + 200*s1 + 180*f1 = "
      "y;\n"
      "c1^2 + s1^2 = 1;\ne1^2 + f1^2 = 1;\n200*c2 + 180*e2 - 200 = x;\n200*s2 + 180*f2 - 68.1 = y;\nc2^2 + s2^2 = 1;\n"
      "e2^2 + f2^2 = 1;\n");
  const Claim claim{Verdict::regular,
                    {1, 3},
                    {{0.999, 1},
                     {-0.029, -0.015},
                     {-0.654, -0.633},
                     {-0.773, -0.757},
                     {0.999, 1.001},
                     {0.009, 0.029},
                     {0.684, 0.707},
                     {0.707, 0.73},
                     {123.2, 127.1},
                     {61.9, 68.2}},
                    {{0.994, 1.006},
                     {-0.093, 0.088},
                     {-0.903, -0.557},
                     {-0.799, -0.564},
                     {0.926, 1.052},
                     {-0.255, 0.37},
                     {0.374, 0.869},
                     {0.477, 1.085},
                     {77.6, 141.8},
                     {37.2, 130.8}}};
  EXPECT_EQ(fault(system, claim), "");
  for (const Interval& side : {Interval(-0.6524, -0.633), Interval(-0.654, -0.6355)}) {  // e1 = −√(1 − f1²), within 10⁻³
    Claim cut = claim;
    cut.box[2] = side;
    EXPECT_THAT(fault(system, cut), HasSubstr("(e1)")) << side.lo();
  }
  Claim two = claim;  // with the other elbow of the second leg
  two.region[4] = {0.7, 1.06}, two.region[5] = {-0.26, 0.75}, two.region[6] = {0.37, 1.05}, two.region[7] = {-0.1, 1.09};
  EXPECT_NE(fault(system, two), "");
}

// z = (x − y)² is nearly −10⁻⁸ along a line, so that no end of parts tells it; far from where it begins x + y > 1.99.
TEST(Sheet, IsNotShownByALimitOfItsParts) {
  const System system = plain(
      "[SYSTEM VARS]\nx : [-1, 1]\ny : [-1, 1]\nz : [-9, 9]\n[SYSTEM EQS]\nz - x^2 + 2*x*y - y^2 = 0;\nx + y <= 1.99;\n");
  const Interval side(-1, 1);
  EXPECT_NE(fault(system, {Verdict::regular, {0, 1}, {side, side, {-1e-8, 5}}, {side, side, {-2, 6}}}), "");
}

// The circle leaves the box at (3/5, 4/5); its region is a part of it.
TEST(PartOfASheet, HasOneSolutionInItsRegionAndAtMostOneElsewhere) {
  const auto with = [](const Box& box, const Box& region, Verdict verdict = Verdict::regular) {
    const System circle = plain("[SYSTEM VARS]\nx : [-9, 9]\ny : [-9, 9]\n[SYSTEM EQS]\nx^2 + y^2 = 1;\n");
    return fault_of_part(circle, {verdict, {0}, box, region});
  };
  const Box box{{0.3, 0.9}, {0.4, 0.8}}, region{{0.69, 0.71}, {0.7, 0.73}};
  EXPECT_EQ(with(box, region), "");
  EXPECT_EQ(with(box, region, Verdict::boundary), "");
  const System circle = plain("[SYSTEM VARS]\nx : [-9, 9]\ny : [-9, 9]\n[SYSTEM EQS]\nx^2 + y^2 = 1;\n");
  EXPECT_NE(fault(circle, {Verdict::regular, {0}, box, region}), "") << "it is no sheet";
  EXPECT_NE(with(box, {{0.3, 0.9}, {0.7, 0.73}}), "") << "the whole sheet is not in it";
  EXPECT_THAT(with({{0.3, 0.9}, {-0.8, 0.8}}, region), HasSubstr("uniqueness")) << "two points for x = 0.7";
  EXPECT_NE(with({{0.3, 1}, {0, 0.8}}, region), "") << "a vertical tangent";
  EXPECT_NE(with(box, {{0.69, 0.71}, {0.73, 0.76}}), "") << "no point in its region";
  EXPECT_NE(with(box, {{0.69, 0.71}, {-0.73, -0.7}}), "") << "its region is outside";
  EXPECT_NE(with(box, {{0.69, 0.95}, {0.3, 0.75}}), "") << "its region is across";
  EXPECT_NE(with({{0.1, 0.3}, {0.4, 0.8}}, {{0.19, 0.21}, {0.6, 0.62}}), "") << "no point at all";
}

TEST(PartOfASheet, LiesInTheDomainUnlessItIsBoundary) {
  const auto with = [](const char* z, Verdict verdict) {
    const System system = plain(std::string("[SYSTEM VARS]\nx : [-9, 9]\ny : [-9, 9]\nz : [") + z +
                                "]\n[SYSTEM EQS]\nx^2 + y^2 = 1;\nz = x + y;\n");
    const Claim claim{verdict, {0}, {{0.3, 0.9}, {0.4, 0.8}, {0.7, 1.7}}, {{0.69, 0.71}, {0.7, 0.73}, {1.39, 1.44}}};
    return fault_of_part(system, claim, {Elimination{2, 1}});
  };
  EXPECT_EQ(with("-9, 9", Verdict::regular), "");
  EXPECT_NE(with("7/5, 9", Verdict::regular), "");
  EXPECT_EQ(with("7/5, 9", Verdict::boundary), "");
}

}  // namespace
}  // namespace corank::check
