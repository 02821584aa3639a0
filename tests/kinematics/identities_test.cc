// Equations that follow from others by exact identities, alone and in a robot that is over-constrained by its count.
#include "corank/kinematics/loops/identities.h"

#include <gtest/gtest.h>

#include <utility>

#include "corank/symbolic/algebra/ginac_lock.h"
#include "corank/tests/kinematics/assembled.h"

namespace corank::kinematics {
namespace {

class IdentitiesTest : public testing::Test {
 protected:
  const symbolic::GinacLock lock_;
  const Robot robot_;
  Algebra algebra_{robot_};
  const ex x_ = algebra_.coordinate("x"), y_ = algebra_.coordinate("y"), z_ = algebra_.coordinate("z");
  Identities known_{algebra_};
};

TEST_F(IdentitiesTest, ImplyCombinationsWithPolynomialMultipliers) {
  const ex f = x_ * x_ * x_ + y_ - 1, g = y_ * y_ * z_ - 2 * x_;  // a Gröbner basis: the first terms are coprime
  known_.add(f, 0);
  known_.add(g, 1);
  EXPECT_TRUE(known_.imply((y_ * z_ + 3) * f - (x_ * x_ - z_) * g));
}

TEST_F(IdentitiesTest, DoNotImplyWhatIsNoCombination) {
  known_.add(x_ * x_ + y_ * y_ - 1, 0);
  EXPECT_FALSE(known_.imply(x_ * x_ + y_ * y_ - 2));
  EXPECT_FALSE(known_.imply(x_ + y_ - 1));
  EXPECT_FALSE(known_.imply(z_ * (x_ * x_ - y_ * y_ - 1)));
}

TEST_F(IdentitiesTest, KnowTheCirclesOfAnglesButNoOtherFunctions) {
  const ex s = GiNaC::sin(x_), c = GiNaC::cos(x_);
  EXPECT_TRUE(known_.imply(z_ * s * s + z_ * c * c - z_));
  EXPECT_FALSE(known_.imply(s * s + GiNaC::pow(GiNaC::cos(y_), 2) - 1));
  EXPECT_FALSE(known_.imply(GiNaC::pow(GiNaC::exp(x_), 2) + s * s - 1));
}

// Whichever base comes first, a division must not meet again a monomial that it has set aside.
TEST_F(IdentitiesTest, DoNotImplyWhatADivisionOutOfOrderWouldLeave) {
  for (const auto& [a, b] : {std::pair{x_, y_}, std::pair{y_, x_}}) {
    Identities known(algebra_);
    known.add(a - b, 0);
    known.add(a * a - b * b - z_, 1);  // so z = 0
    EXPECT_TRUE(known.imply(z_));
    EXPECT_FALSE(known.imply(a * a - z_));
    EXPECT_FALSE(known.imply(b * b - z_));
    EXPECT_FALSE(known.imply(a * b - z_));
  }
}

TEST_F(IdentitiesTest, NameTheEquationsThatTheyAreMadeOf) {
  known_.add(x_ - y_, 7);
  known_.add(x_ - z_, 4);  // kept as y - z, which both make
  known_.add(GiNaC::exp(z_) - 2, 5);
  EXPECT_EQ(known_.sources(GiNaC::pow(x_, 2) - GiNaC::pow(y_, 2)), std::optional(Identities::Numbers{7}));
  EXPECT_EQ(known_.sources(y_ - z_), std::optional(Identities::Numbers{4, 7}));
  EXPECT_EQ(known_.sources(GiNaC::pow(GiNaC::sin(x_), 2) + GiNaC::pow(GiNaC::cos(x_), 2) - 1),
            std::optional(Identities::Numbers{}));
  EXPECT_EQ(known_.sources(y_), std::nullopt);
}

TEST_F(IdentitiesTest, ImplyNothingOnceTheirOperationsAreUsedUp) {
  Identities few(algebra_, 12);
  few.add(x_ - y_, 0);
  EXPECT_TRUE(few.imply(x_ - y_));
  EXPECT_FALSE(few.imply(GiNaC::pow(x_, 20) - GiNaC::pow(y_, 20)));
  EXPECT_FALSE(few.imply(x_ - y_));
}

// Two legs UPR that turn about one axis, and a leg SPR.
TEST(Assembly, LeavesOutWhatFollowsInAnExechonLikeRobot) {
  const Assembly a = assembled(R"([CONSTANTS]
a := 250
b := 430
p := 150
r := 250
[LINKS]
base : point A1 (0,a,0) point A2 (0,-a,0) point A3 (b,0,0)
l1 : point A (0,0,0)
l2 : point A (0,0,0)
l3 : point A (0,0,0)
r1 : point B (0,0,0)
r2 : point B (0,0,0)
r3 : point B (0,0,0)
plat : point C (0,0,0) point B1 (0,p,0) point B2 (0,-p,0) point B3 (r,0,0)
[JOINTS]
universal : base A1 + (0,1,0)  l1 A + (1,0,0)
universal : base A2 + (0,1,0)  l2 A + (1,0,0)
spherical : base A3 l3 A
prismatic d1 : l1 A + (0,0,1) r1 B + (0,0,1) range [500,1500] actuated
prismatic d2 : l2 A + (0,0,1) r2 B + (0,0,1) range [500,1500] actuated
prismatic d3 : l3 A + (0,0,1) r3 B + (0,0,1) range [500,1500] actuated
revolute : r1 B + (1,0,0) plat B1 + (1,0,0)
revolute : r2 B + (1,0,0) plat B2 + (1,0,0)
revolute : r3 B + (0,1,0) plat B3 + (0,1,0)
[OUTPUTS]
P : position of plat.C range z [900,900]
)");
  EXPECT_EQ(a.mobility, 3);
  EXPECT_EQ(a.mobility_by_rank, 3);  // so there is no note of redundancy
  EXPECT_EQ(a.mechanism.rates().size() - a.mechanism.velocity_equations().size(), 3U);
  // Each is left out for what stays.
  const std::size_t equations = symbolic::derive(a.mechanism).phi.size(), rows = a.mechanism.velocity_equations().size();
  EXPECT_FALSE(a.left_out.empty());
  for (const symbolic::LeftOut& e : a.left_out) {
    EXPECT_FALSE(e.equations.empty() && e.rows.empty()) << e.relation();
    for (const std::size_t number : e.equations) EXPECT_TRUE(1 <= number && number <= equations) << e.reason();
    for (const std::size_t number : e.rows) EXPECT_TRUE(1 <= number && number <= rows) << e.reason();
  }
}

// A Tripteron: three legs PRRR, each with parallel axes. The platform only translates: mobility 3, where the joints count 0.
// Two loops say of leg 1 alone that it does not turn about its axis, which is one row of L.
TEST(Assembly, LeavesOutVelocitiesThatRepeatOthersInATripteron) {
  const Assembly a = assembled(R"([LINKS]
base : point O (0,0,0)
s1
s2
s3
k1 : point B (0,1,0)
k2 : point B (0,0,1)
k3 : point B (1,0,0)
m1 : point C (0,1,0)
m2 : point C (0,0,1)
m3 : point C (1,0,0)
plat : point P (0,0,0)
[JOINTS]
prismatic d1 : base (0,-1/2,0) + (1,0,0) s1 (0,0,0) + (1,0,0) range [-1,1] actuated
prismatic d2 : base (0,0,-1/2) + (0,1,0) s2 (0,0,0) + (0,1,0) range [-1,1] actuated
prismatic d3 : base (-1/2,0,0) + (0,0,1) s3 (0,0,0) + (0,0,1) range [-1,1] actuated
revolute : s1 (0,0,0) + (1,0,0) k1 (0,0,0) + (1,0,0)
revolute : k1 B + (1,0,0) m1 (0,0,0) + (1,0,0)
revolute : m1 C + (1,0,0) plat P + (1,0,0)
revolute : s2 (0,0,0) + (0,1,0) k2 (0,0,0) + (0,1,0)
revolute : k2 B + (0,1,0) m2 (0,0,0) + (0,1,0)
revolute : m2 C + (0,1,0) plat P + (0,1,0)
revolute : s3 (0,0,0) + (0,0,1) k3 (0,0,0) + (0,0,1)
revolute : k3 B + (0,0,1) m3 (0,0,0) + (0,0,1)
revolute : m3 C + (0,0,1) plat P + (0,0,1)
[OUTPUTS]
u : position of plat.P
)");
  EXPECT_EQ(a.mobility, 3);
  EXPECT_EQ(a.mobility_by_rank, 3);
  EXPECT_EQ(a.mechanism.rates().size() - a.mechanism.velocity_equations().size(), 3U);
  EXPECT_EQ(a.left_out.size(), 1U);
  EXPECT_NO_THROW(symbolic::derive(a.mechanism));
  for (const symbolic::Constraint& c : a.mechanism.constraints())
    EXPECT_EQ(c.relation.kind, symbolic::Relation::Kind::equal) << c.relation.text() << " says nothing";
}

// Legs 2-RPU and UPR: 22 conditions of which the identities find too few.
TEST(Assembly, SaysOfWhichOverConstrainedRobotItFindsTooFewIdentities) {
  EXPECT_EQ(
      fault_of(R"([LINKS]
base : point A1 (0,1,0) point A2 (0,-1,0) point A3 (1,0,0)
r1 : point O (0,0,0)
r2 : point O (0,0,0)
e1 : point O (0,0,0)
e2 : point O (0,0,0)
f3 : point O (0,0,0)
e3 : point O (0,0,0)
plat : point B1 (0,0.5,0) point B2 (0,-0.5,0) point B3 (0.5,0,0)
[JOINTS]
revolute : base A1 + (1,0,0) r1 O + (1,0,0)
revolute : base A2 + (1,0,0) r2 O + (1,0,0)
prismatic d1 : r1 O + (0,0,1) e1 O + (0,0,1) range [0.5,2] actuated
prismatic d2 : r2 O + (0,0,1) e2 O + (0,0,1) range [0.5,2] actuated
universal : e1 O + (1,0,0) plat B1 + (0,1,0)
universal : e2 O + (1,0,0) plat B2 + (0,1,0)
universal : base A3 + (1,0,0) f3 O + (0,1,0)
prismatic d3 : f3 O + (0,0,1) e3 O + (0,0,1) range [0.5,2] actuated
revolute : e3 O + (0,1,0) plat B3 + (0,1,0)
[OUTPUTS]
u : position of plat (0,0,0) only z
n : direction of plat (0,0,1)
)"),
      "r.cuik: the robot is over-constrained, and corank does not find which of its conditions follow from the others: "
      "its positions seem to have mobility 2, its velocities 1; expected joints that say nothing twice, such as a "
      "spherical one in place of a universal one, or the robot's equations");
}

}  // namespace
}  // namespace corank::kinematics
