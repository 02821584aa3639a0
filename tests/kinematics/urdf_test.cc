// URDF files as robots: what is read, exactly, and where a file is wrong. The samples in tests/data/urdf are read by urdfdom
// as well.
#include "corank/kinematics/urdf/urdf.h"

#include <console_bridge/console.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <urdf_parser/urdf_parser.h>

#include <fstream>
#include <random>
#include <sstream>

#include "corank/tests/kinematics/read_robot.h"
#include "corank/tests/kinematics/transform.h"
#include "corank/tests/seeds.h"

extern "C" int fuzz_urdf(const std::uint8_t* data, std::size_t size);

namespace corank::kinematics {
namespace {

using symbolic::ModelError;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const std::filesystem::path kData = std::filesystem::path(CORANK_SOURCE_DIR) / "tests/data/urdf";

std::string text_of(const std::string& name) {
  std::ostringstream text;
  text << std::ifstream(kData / name, std::ios::binary).rdbuf();
  return text.str();
}

Robot sample(const std::string& name) { return parse_urdf(text_of(name), name); }

const Joint& joint(const Robot& robot, const std::string& name) { return robot.joints.at(robot.find_joint(name)); }

std::vector<std::string> texts(const Vector& v) { return {v[0].text(), v[1].text(), v[2].text()}; }

// A joint between two links; `inside` stands in line 5 and after.
std::string urdf_with_joint(const std::string& type, const std::string& inside) {
  return "<robot name='r'>\n<link name='a'/>\n<link name='b'/>\n<joint name='j' type='" + type +
         "'><parent link='a'/><child link='b'/>\n" + inside + "\n</joint>\n</robot>\n";
}

Joint read_joint(const std::string& type, const std::string& inside) {
  return parse_urdf(urdf_with_joint(type, inside), "r.urdf").joints.at(0);
}

std::string fault(const std::string& text) {
  try {
    parse_urdf(text, "r.urdf");
  } catch (const ModelError& error) {
    return error.what();
  }
  return "no fault";
}

TEST(Urdf, ReadsLinksAndJointsWithTheRootAsTheGround) {
  const Robot robot = sample("arm_3r.urdf");
  EXPECT_EQ(robot.name, "arm_3r");
  EXPECT_EQ(robot.unit, "m");
  ASSERT_EQ(robot.links.size(), 4u);
  EXPECT_EQ(robot.links[0].name, "base");
  EXPECT_EQ(robot.links[1].name, "upper");
  ASSERT_EQ(robot.joints.size(), 3u);
  const Joint& elbow = joint(robot, "elbow");
  EXPECT_EQ(elbow.kind, JointKind::revolute);
  EXPECT_EQ(robot.links[elbow.ends[0].link].name, "upper");
  EXPECT_EQ(robot.links[elbow.ends[1].link].name, "fore");
  EXPECT_THAT(texts(elbow.ends[0].point), ElementsAre("0.4", "0", "0"));
  EXPECT_THAT(texts(elbow.ends[1].point), ElementsAre("0", "0", "0"));
  EXPECT_THAT(texts(elbow.ends[0].axis), ElementsAre("0", "0", "1"));
  EXPECT_THAT(texts(*elbow.ends[0].zero), ElementsAre("1", "0", "0"));
  EXPECT_EQ(elbow.where.text(), "arm_3r.urdf:32:4");
}

TEST(Urdf, KeepsDecimalsAsTheyAreWritten) {
  const Joint j = read_joint("continuous", "<origin xyz='0.30 -1e-3 .1'/><axis xyz='0.1 0.2000 1.0'/>");
  EXPECT_THAT(texts(j.ends[0].point), ElementsAre("0.30", "-1e-3", "0.1"));
  EXPECT_THAT(texts(j.ends[1].axis), ElementsAre("0.1", "0.2000", "1"));
}

TEST(Urdf, LimitsAreRanges) {
  const Robot robot = sample("arm_3r.urdf");
  const auto range = [&](const char* name) { return joint(robot, name).ranges.at(0).value(); };
  EXPECT_EQ(range("shoulder").lower.text(), "-2*pi/3");
  EXPECT_EQ(range("shoulder").upper.text(), "2*pi/3");
  EXPECT_EQ(range("elbow").lower.text(), "-2.5");
  EXPECT_EQ(range("elbow").upper.text(), "0");
  EXPECT_THAT(joint(robot, "wrist").ranges, IsEmpty());
  EXPECT_EQ(read_joint("prismatic", "<limit upper='0.5'/>").ranges[0]->lower.text(), "0");
}

TEST(Urdf, LimitsOfAWholeTurnAreNone) {
  EXPECT_FALSE(read_joint("revolute", "<limit lower='-3.14159' upper='3.14159'/>").ranges[0]);
  EXPECT_FALSE(read_joint("revolute", "<limit lower='-3.2' upper='3.2'/>").ranges[0]);
  EXPECT_TRUE(read_joint("revolute", "<limit lower='-3.1' upper='3.1'/>").ranges[0]);
  EXPECT_TRUE(read_joint("prismatic", "<limit lower='-7' upper='7'/>").ranges[0]);
}

TEST(Urdf, DecimalsOfMultiplesOfPiAreThoseMultiples) {
  const auto reading = [](const std::string& decimal) {
    const auto range = read_joint("revolute", "<limit lower='" + decimal + "' upper='" + decimal + "'/>").ranges[0];
    return range->lower.text();
  };
  for (const char* half :
       {"1.57", "1.571", "1.5708", "1.5707", "1.570796", "1.5707963", "1.57079632679", "1.570796326794", "1.57079632680",
        "1.570800", "1.5707963267948966", "1.57079632679489661923132169163975144", "157.08e-2", "+1.5708"})
    EXPECT_EQ(reading(half), "pi/2") << half;
  EXPECT_EQ(reading("-1.5708"), "-pi/2");
  EXPECT_EQ(reading("3.14159"), "pi");
  EXPECT_EQ(reading("3.1415926"), "pi");
  EXPECT_EQ(reading("6.28318530718"), "2*pi");
  EXPECT_EQ(reading("0.785"), "pi/4");
  EXPECT_EQ(reading("0.7854"), "pi/4");
  EXPECT_EQ(reading("0.5236"), "pi/6");
  EXPECT_EQ(reading("0.3927"), "pi/8");
  EXPECT_EQ(reading("2.0943951023931953"), "2*pi/3");  // Python's 2*math.pi/3, 2e-16 off
  EXPECT_EQ(reading("0.0174533"), "pi/180");
  EXPECT_EQ(reading("0.872665"), "5*pi/18");
  EXPECT_EQ(reading("0.0"), "0");
  // Too few digits for what they might mean, or next to it.
  for (const char* itself : {"1.6", "3", "3.1", "3.13", "1.5709", "1.57080001", "1.570796326796", "1.5706", "0.524", "1.05",
                             "0.0175", "0.01745", "2.967", "15.708"}) {
    EXPECT_EQ(reading(itself), itself) << itself;
  }
}

TEST(Urdf, SaysWhichDecimalsWereReadAsPi) {
  const Robot robot = sample("ur5_like.urdf");
  EXPECT_THAT(robot.notices, Contains("rpy 1.5708 read as pi/2"));
  EXPECT_THAT(robot.notices, Contains("rpy -1.5708 read as -pi/2"));
  EXPECT_THAT(robot.notices, Contains("upper 6.28318530718 read as 2*pi, 5 times"));
}

TEST(Urdf, QuarterTurnsAreMatricesOfZerosAndOnes) {
  const Joint j = read_joint("fixed", "<origin rpy='1.5708 0 -1.5708'/>");
  // Rz(-90°) Rx(90°): x to -y, y to z, z to -x.
  EXPECT_THAT(texts(j.pose.rotation[0]), ElementsAre("0", "0", "-1"));
  EXPECT_THAT(texts(j.pose.rotation[1]), ElementsAre("-1", "0", "0"));
  EXPECT_THAT(texts(j.pose.rotation[2]), ElementsAre("0", "1", "0"));
  const Joint turned = read_joint("fixed", "<origin rpy='0 0 0.3'/>");
  EXPECT_THAT(texts(turned.pose.rotation[0]), ElementsAre("cos(0.3)", "-sin(0.3)", "0"));
}

TEST(Urdf, AJointWithoutAxisHasX) {
  EXPECT_THAT(texts(read_joint("continuous", "").ends[1].axis), ElementsAre("1", "0", "0"));
}

TEST(Urdf, TransmissionsSayWhatIsActuated) {
  const auto actuated = [](const Robot& robot) {
    std::vector<std::string> names;
    for (const Joint& j : robot.joints)
      if (j.actuated) names.push_back(j.name);
    return names;
  };
  EXPECT_EQ(actuated(sample("ur5_like.urdf")).size(), 6u);
  EXPECT_THAT(actuated(sample("every_joint.urdf")), ElementsAre("rail", "turn"));  // by ros2_control
  const Robot arm = sample("arm_3r.urdf");
  EXPECT_THAT(actuated(arm), IsEmpty());
  EXPECT_THAT(arm.notices, Contains(HasSubstr("[INPUTS]")));
}

TEST(Urdf, VisualsAreShapes) {
  const Robot robot = sample("arm_3r.urdf");
  const std::vector<Shape>& upper = robot.links[1].shapes;
  ASSERT_EQ(upper.size(), 1u);
  EXPECT_EQ(upper[0].kind, Shape::Kind::cylinder);
  EXPECT_EQ(upper[0].colour, "#808099");
  EXPECT_EQ(upper[0].radius.text(), "0.02");
  const Numbers begin = values(upper[0].points.at(0)), end = values(upper[0].points.at(1));
  EXPECT_NEAR(begin[0], 0, 1e-15);  // z turned to x
  EXPECT_NEAR(end[0], 0.4, 1e-15);
  EXPECT_EQ(robot.links[2].shapes.at(0).kind, Shape::Kind::sphere);
  const std::vector<Shape>& box = robot.links[3].shapes;
  ASSERT_EQ(box.size(), 6u);
  for (const Shape& face : box) {
    ASSERT_EQ(face.points.size(), 4u);
    EXPECT_EQ(face.colour, "#ffcc00");
    // A rectangle: opposite sides are equal, sides that meet are perpendicular.
    const Numbers a = values(face.points[0]), b = values(face.points[1]), c = values(face.points[2]),
                  d = values(face.points[3]);
    double skew = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(b[i] - a[i], c[i] - d[i], 1e-15);
      skew += (b[i] - a[i]) * (d[i] - a[i]);
    }
    EXPECT_NEAR(skew, 0, 1e-15);
  }
}

TEST(Urdf, SaysWhatItPassesOver) {
  EXPECT_THAT(sample("arm_3r.urdf").notices,
              testing::IsSupersetOf({"dynamics (mass, inertia) passed over", "collision geometry passed over",
                                     "limits of effort and velocity passed over, 2 times"}));
  EXPECT_THAT(sample("ur5_like.urdf").notices,
              testing::IsSupersetOf({"meshes are not drawn, 6 times",
                                     "dynamics (damping, friction) of joints passed over, 6 "
                                     "times",
                                     "limits of a whole turn or more do not limit a joint, 6 times"}));
  EXPECT_THAT(parse_urdf("<robot name='r'><link name='a'/><gazebo><joint name='x'/></gazebo></robot>", "r").notices,
              Contains(HasSubstr("a <gazebo> holds a joint")));
}

TEST(Urdf, NamesBecomeIdentifiersEachOnce) {
  const Robot robot = sample("every_joint.urdf");
  std::vector<std::string> links;
  for (const Link& link : robot.links) links.push_back(link.name);
  EXPECT_THAT(links, ElementsAre("world", "cart_1_2", "cart_1", "plate", "link_2nd_arm", "slide", "tip"));
  EXPECT_GE(robot.find_joint("joint_pi"), 0);
  EXPECT_THAT(robot.notices, Contains("the link 'cart-1' is called cart_1_2"));
}

TEST(Urdf, AFloatingJointIsNoneWhereLoopsHoldItsLink) {
  EXPECT_THAT(fault(urdf_with_joint("floating", "")),
              HasSubstr("r.urdf:4:23: joint 'j' is floating: nothing holds the link 'b'"));
}

TEST(Urdf, ACompanionClosesLoopsAndNamesInputsAndOutputs) {
  const Robot robot = read_urdf(kData / "five_bar.urdf", kData / "five_bar.loops");
  ASSERT_EQ(robot.joints.size(), 5u);
  const Joint& tip = joint(robot, "tip");
  EXPECT_EQ(tip.kind, JointKind::revolute);
  EXPECT_EQ(robot.links[tip.ends[0].link].name, "left_forearm");
  EXPECT_THAT(texts(tip.ends[1].point), ElementsAre("0.090", "0", "0"));
  EXPECT_TRUE(joint(robot, "left_shoulder").actuated);
  EXPECT_FALSE(joint(robot, "left_elbow").actuated);
  ASSERT_EQ(robot.outputs.size(), 1u);
  EXPECT_EQ(robot.outputs[0].name, "P");
  EXPECT_EQ(robot.name, "five_bar");
  EXPECT_THAT(robot.notices, Not(Contains(HasSubstr("[INPUTS]"))));
}

TEST(Urdf, InputsOfACompanionStandForTheTransmissions) {
  const std::string text = text_of("ur5_like.urdf");
  const auto actuated = [&](const std::string& loops) {
    const Robot robot = parse_urdf(text, "ur5.urdf", UrdfLoops{loops, "ur5.loops"});
    return std::count_if(robot.joints.begin(), robot.joints.end(), [](const Joint& j) { return j.actuated; });
  };
  EXPECT_EQ(actuated("[INPUTS] elbow"), 1);
  EXPECT_EQ(actuated("[OUTPUTS] P : pose of tool0"), 6);
}

TEST(Urdf, TheRootIsTheGroundInACompanion) {
  const Robot robot = parse_urdf(text_of("arm_3r.urdf"), "r.urdf",
                                 UrdfLoops{"[LOOPS]\nfix: hand ground Txyz(0.3, 0, 0.5)*Rz(pi/2)\n"
                                           "[OUTPUTS] P : pose of fore in ground",
                                           "r.loops"});
  EXPECT_EQ(robot.joints.back().kind, JointKind::fixed);
  EXPECT_EQ(robot.joints.back().ends[1].link, 0u);
  EXPECT_EQ(robot.outputs.at(0).relative_to, 0u);
}

TEST(Urdf, AFaultOfACompanionHasItsOwnPlace) {
  try {
    parse_urdf(text_of("five_bar.urdf"), "r.urdf", UrdfLoops{"[INPUTS]\n left_sholder", "r.loops"});
    ADD_FAILURE();
  } catch (const ModelError& error) {
    EXPECT_THAT(error.what(), HasSubstr("r.loops:2:2: there is no joint 'left_sholder'"));
    EXPECT_THAT(error.what(), HasSubstr("did you mean 'left_shoulder'?"));
  }
}

TEST(Urdf, ALinkOfAFloatingJointIsHeldByLoops) {
  const std::string text = urdf_with_joint("floating", "");
  const Robot held = parse_urdf(text, "r.urdf", UrdfLoops{"[LOOPS]\nspherical: a (0, 0, 0) b (1, 0, 0)", "r.loops"});
  ASSERT_EQ(held.joints.size(), 1u);
  EXPECT_EQ(held.joints[0].kind, JointKind::spherical);
  EXPECT_THAT(held.notices, Contains("joint 'j' is floating, so it is left out: loops have to hold the link 'b'"));
  EXPECT_THROW(parse_urdf(text, "r.urdf", UrdfLoops{"", "r.loops"}), ModelError);
}

// --- Numbers -----------------------------------------------------------------------------------------------------------

Transform transform(const urdf::Pose& pose) {
  const urdf::Rotation& q = pose.rotation;
  const urdf::Vector3 columns[3] = {q * urdf::Vector3(1, 0, 0), q * urdf::Vector3(0, 1, 0), q * urdf::Vector3(0, 0, 1)};
  Transform result{{}, {pose.position.x, pose.position.y, pose.position.z}};
  for (std::size_t j = 0; j < 3; ++j) {
    result.r[0][j] = columns[j].x;
    result.r[1][j] = columns[j].y;
    result.r[2][j] = columns[j].z;
  }
  return result;
}

Numbers numbers(const urdf::Vector3& v) { return {v.x, v.y, v.z}; }

void expect_near(const Transform& a, const Transform& b, double tolerance, const std::string& what) {
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(a.p[i], b.p[i], tolerance) << what;
    for (std::size_t j = 0; j < 3; ++j) EXPECT_NEAR(a.r[i][j], b.r[i][j], tolerance) << what;
  }
}

// The pose of every link by urdfdom's numbers and by the robot's ends, for random joint values.
void compare_poses(const std::string& name, double tolerance) {
  console_bridge::noOutputHandler();
  const urdf::ModelInterfaceSharedPtr model = urdf::parseURDF(text_of(name));
  ASSERT_TRUE(model) << name;
  const Robot robot = sample(name);
  ASSERT_EQ(robot.links.size(), model->links_.size());
  ASSERT_EQ(robot.joints.size(), model->joints_.size());
  // urdfdom's joints by their parent and child, in the robot's order.
  std::map<std::string, std::string> urdf_name;
  for (const auto& [link, unused] : model->links_) {
    std::string fit = link == "cart-1" ? "cart_1_2" : link == "2nd arm" ? "link_2nd_arm" : link;
    urdf_name[fit] = link;
  }
  EXPECT_EQ(urdf_name.at(robot.links[0].name), model->getRoot()->name);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-2, 2);
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<Transform> by_ends(robot.links.size()), by_urdf(robot.links.size());
    std::size_t placed = 1;
    std::vector<bool> known(robot.links.size());
    known[0] = true;
    while (placed < robot.links.size()) {
      const std::size_t before = placed;
      for (const Joint& j : robot.joints) {
        const std::size_t parent = j.ends[0].link, child = j.ends[1].link;
        if (!known[parent] || known[child]) continue;
        const urdf::JointConstSharedPtr source = model->getLink(urdf_name.at(robot.links[child].name))->parent_joint;
        ASSERT_EQ(source->parent_link_name, urdf_name.at(robot.links[parent].name));
        const double q = any(random), x = any(random), y = any(random);
        Transform own = transform(source->parent_to_joint_origin_transform);
        const Numbers axis = numbers(source->axis);
        switch (j.kind) {
          case JointKind::revolute:
            own = own * turn(axis, q);
            by_ends[child] = by_ends[parent] * joint_motion(j, q, 0);
            break;
          case JointKind::prismatic:
            own = own * slide(axis, q);
            by_ends[child] = by_ends[parent] * joint_motion(j, 0, q);
            break;
          case JointKind::planar: {  // ways along what the robot calls zero, and across it
            const Numbers first = unit(values(*j.ends[1].zero));
            own = own * slide(first, x) * slide(cross(unit(axis), first), y) * turn(axis, q);
            by_ends[child] = by_ends[parent] * joint_motion(j, q, 0, x, y);
            break;
          }
          default: by_ends[child] = by_ends[parent] * joint_motion(j, 0, 0);
        }
        by_urdf[child] = by_urdf[parent] * own;
        expect_near(by_ends[child], by_urdf[child], tolerance, name + ": " + robot.links[child].name);
        known[child] = true;
        ++placed;
      }
      ASSERT_GT(placed, before);
    }
  }
}

TEST(Urdf, PlacesEveryLinkWhereUrdfdomDoes) {
  compare_poses("arm_3r.urdf", 1e-12);
  compare_poses("five_bar.urdf", 1e-12);
  compare_poses("every_joint.urdf", 1e-12);
  compare_poses("ur5_like.urdf", 1e-4);  // urdfdom takes 1.5708 for 1.5708
}

// Tz(d) after Rz(angle), then Tx(a) Rx(alpha).
Transform denavit_hartenberg(double angle, double a, double d, double alpha) {
  Transform along_z = turn({0, 0, 1}, angle), along_x = turn({1, 0, 0}, alpha);
  along_z.p = {0, 0, d};
  along_x.p = {a, 0, 0};
  return along_z * along_x;
}

TEST(Urdf, ARobotWith1Point5708IsTheOneOfItsMakersTable) {
  // Universal Robots, User Manual UR5/CB3, appendix "Robot DH Parameter", table B.4.
  constexpr double kTable[6][3] = {{0, 0.089159, M_PI_2}, {-0.42500, 0, 0},      {-0.39225, 0, 0},
                                   {0, 0.10915, M_PI_2},  {0, 0.09465, -M_PI_2}, {0, 0.08230, 0}};
  const Robot robot = sample("ur5_like.urdf");
  ASSERT_EQ(robot.joints.size(), 7u);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-3, 3);
  for (int trial = 0; trial < 20; ++trial) {
    Transform by_table, by_ends;
    for (std::size_t i = 0; i < 6; ++i) {
      const double angle = any(random);
      by_table = by_table * denavit_hartenberg(angle, kTable[i][0], kTable[i][1], kTable[i][2]);
      by_ends = by_ends * joint_motion(robot.joints[i], angle, 0);
    }
    expect_near(by_ends * joint_motion(robot.joints[6], 0, 0), by_table, 1e-12, "tool0");
  }
}

// --- Faults ------------------------------------------------------------------------------------------------------------

struct Fault {
  std::string text, message;
};

std::string robot(const std::string& inside) { return "<robot name='r'>\n" + inside + "\n</robot>"; }

TEST(Urdf, SaysWhatIsWrongAndWhere) {
  const std::string two_links = "<link name='a'/>\n<link name='b'/>\n";
  const auto joint_text = [](const std::string& name, const std::string& parent, const std::string& child) {
    return "<joint name='" + name + "' type='fixed'><parent link='" + parent + "'/><child link='" + child + "'/></joint>\n";
  };
  std::string deep;
  for (int i = 0; i < 100; ++i) deep += "<gazebo>";
  for (int i = 0; i < 100; ++i) deep += "</gazebo>";
  std::string many;
  for (int i = 0; i < 10'001; ++i) many += "<link name='l" + std::to_string(i) + "'/>\n";
  const std::vector<Fault> faults{
      {"", "there is no <robot> element"},
      {"<sdf/>", "r.urdf:1:2: the file's element is <sdf>; expected <robot>"},
      {"<robot name='r'><link name='a'/></robot>\n<robot/>", "r.urdf:2:2: a second element beside <robot>"},
      {"<robot><link name='a'/></robot>", "r.urdf:1:2: the robot has no name"},
      {"<robot name='r'>\n<link name='a'>\n</robot>", "r.urdf:3:"},
      {"<robot name='r' version='2.0'/>", "the version of URDF is '2.0'"},
      {"<robot name='r'/>", "the robot has no links"},
      {robot("<link/>"), "r.urdf:2:2: a link has no name"},
      {robot(two_links + "<link name='a'/>"),
       "r.urdf:4:13: a second link called 'a'; expected each name once; the first "
       "is in line 2"},
      {robot(two_links + joint_text("j", "a", "b") + "<link name='c'/>" + joint_text("j", "b", "c")),
       "a second joint called 'j'"},
      {robot(two_links),
       "r.urdf:3:2: two links are not the child of a joint, 'a' and 'b'; expected one root, which is the ground"},
      {robot(two_links + joint_text("j", "a", "c")),
       "r.urdf:4:61: there is no link 'c'; expected the name of a <link> of this file"},
      {robot("<link name='base'/>\n<link name='forearm'/>\n" + joint_text("j", "base", "fore_arm")),
       "there is no link 'fore_arm'; expected the name of a <link> of this file; did you mean 'forearm'?"},
      {robot(two_links + joint_text("j", "bace", "b")), "there is no link 'bace'"},
      {robot(two_links + "<joint name='j' type='fixed'><child link='b'/></joint>"), "r.urdf:4:2: joint 'j' has no parent"},
      {robot(two_links + "<joint name='j' type='fixed'><parent/><child link='b'/></joint>"),
       "the parent of joint 'j' has no link"},
      {robot(two_links + joint_text("j", "a", "a")), "joint 'j' joins the link 'a' with itself"},
      {robot(two_links + "<link name='c'/>" + joint_text("j", "a", "c") + joint_text("k", "b", "c")),
       "r.urdf:5:61: the link 'c' is the child of two joints, 'j' and 'k'; expected URDF is a tree: close loops in a "
       ".loops"},
      {robot(two_links + joint_text("j", "a", "b") + joint_text("k", "b", "a")), "every link is the child of a joint"},
      {robot(two_links + "<link name='c'/>" + joint_text("j", "a", "b") + joint_text("k", "b", "a")),
       "closes a cycle of links"},
      {urdf_with_joint("", ""), "r.urdf:4:2: joint 'j' has no type"},
      {urdf_with_joint("revolut", "<limit upper='1'/>"),
       "a joint's type is 'revolut'; expected revolute, continuous, prismatic, fixed, planar or floating; did you mean "
       "'revolute'?"},
      {urdf_with_joint("ball", ""), "a joint's type is 'ball'; expected revolute, continuous"},
      {urdf_with_joint("continuous", "<axis xyz='0 0.0 -0'/>"),
       "r.urdf:5:12: the axis of joint 'j' is 0; expected a direction"},
      {urdf_with_joint("continuous", "<axis xyz='0 1'/>"), "the axis of joint 'j' is '0 1', 2 numbers; expected three"},
      {urdf_with_joint("continuous", "<axis/>"), "the axis of joint 'j' has no xyz"},
      {urdf_with_joint("fixed", "<origin xyz='0 0 O.5'/>"), "r.urdf:5:14: xyz of joint 'j' is 'O.5', not a number"},
      {urdf_with_joint("fixed", "<origin xyz='0 0 nan'/>"), "not a number"},
      {urdf_with_joint("fixed", "<origin xyz='0 0 1e9999'/>"), "out of range"},
      {urdf_with_joint("fixed", "<origin xyz='1 2 3 4'/>"), "more than 3 numbers"},
      {urdf_with_joint("fixed", "<origin\n rpy='0 0 90deg'/>"), "r.urdf:6:7: rpy of joint 'j' is '90deg', not a number"},
      {urdf_with_joint("fixed", "<origin xyx='1 2 3'/>"), "<origin> has an unknown attribute 'xyx'; expected xyz, rpy"},
      {urdf_with_joint("fixed", "<orgin xyz='1 2 3'/>"), "r.urdf:5:2: an unknown element <orgin>; expected <origin>"},
      {urdf_with_joint("fixed", "<origin/>\n<origin/>"), "r.urdf:6:2: a second <origin> in one <joint>"},
      {urdf_with_joint("fixed", "<origin xyz='0 0 1' xyz='0 0 2'/>"), "the attribute 'xyz' is written twice"},
      {urdf_with_joint("revolute", ""),
       "joint 'j' has no limits; expected <limit lower=\"…\" upper=\"…\">, or the type continuous"},
      {urdf_with_joint("revolute", "<limit effort='1' velocity='1'/>"), "neither a lower nor an upper limit"},
      {urdf_with_joint("revolute", "<limit lower='1.58' upper='1.5708'/>"),
       "r.urdf:5:2: the lower limit of joint 'j' is above the upper one, 1.58 > pi/2"},
      {urdf_with_joint("prismatic", "<limit lower='1' upper='a'/>"), "upper of joint 'j' is 'a', not a number"},
      {urdf_with_joint("continuous", "<mimic joint='k'/>"), "r.urdf:5:15: there is no joint 'k'"},
      {urdf_with_joint("fixed", "<mimic joint='j'/>"),
       "the fix joint 'j' follows the fix joint 'j'; expected two joints that turn"},
      {robot(two_links + joint_text("j", "a", "b") + "<transmission><joint name='jj'/></transmission>"),
       "r.urdf:5:28: there is no joint 'jj'; expected the name of a <joint> of this file"},
      {robot(two_links + joint_text("j", "a", "b") + "<transmission><joint name='j'/></transmission>"),
       "drives joint 'j', which is fixed"},
      {robot("<link name='a'><visual/></link>"), "a <visual> has no <geometry>"},
      {robot("<link name='a'><visual><geometry><sphere/></geometry></visual></link>"), "a sphere has no radius"},
      {robot("<link name='a'><visual><geometry><box size='1 -2 3'/></geometry></visual></link>"),
       "size of a box is negative"},
      {robot("<material name='m'><color rgba='1 2 3'/></material><link name='a'/>"), "rgba of a colour holds '2'"},
      {robot(two_links + joint_text("j", "a", "b") + "<loop_joint name='k'/>"),
       "r.urdf:5:2: <loop_joint> is not URDF's and may close a loop; expected the loop in a .loops file"},
      {robot("<xacro:property name='l' value='1'/>\n<link name='a'/>"),
       "r.urdf:2:2: <xacro:property> is xacro; expected "
       "plain URDF: run xacro first"},
      {urdf_with_joint("fixed", "<origin xyz='${l} 0 0'/>"), "r.urdf:5:14: '${l} 0 0' is xacro"},
      {"<!DOCTYPE robot [<!ENTITY l '0.5'>]>\n" + robot("<link name='a'/>"), "r.urdf:1:"},
      {robot("<link name='a&l;'/>"), "r.urdf:2:14: the entity 'l' is unknown"},
      {robot("<link name='a&#10;b'/>"), "r.urdf:2:13: a control character"},
      {std::string("<robot name='r'>\n\0</robot>", 27), "r.urdf:2:1: a NUL byte"},
      {"\xFF\xFE<", "the text is in UTF-16"},
      {robot(deep), "elements are nested too deeply; expected at most 64"},
      {robot(many), "there are too many links; expected at most 10000"},
      {std::string((std::size_t{8} << 20) + 1, ' '), "the file is too large; expected at most 8 MB"},
  };
  for (const Fault& f : faults) {
    const std::string said = fault(f.text);
    EXPECT_THAT(said, HasSubstr(f.message)) << f.text.substr(0, 400);
    EXPECT_THAT(said, testing::StartsWith("r.urdf")) << f.text.substr(0, 400);
  }
}

TEST(Urdf, ReadsFilesAndSaysWhichCannotBeRead) {
  EXPECT_EQ(read_urdf(kData / "arm_3r.urdf").joints.size(), 3u);
  EXPECT_THROW(read_urdf(kData / "none.urdf"), ModelError);
  EXPECT_THROW(read_urdf(kData), ModelError);
}

TEST(Urdf, ReadsEntitiesOfXmlAndCommentsWithAmpersands) {
  const Robot r = parse_urdf(robot("<!-- nuts & bolts -->\n<link name='a&amp;b&#45;'/>"), "r.urdf");
  EXPECT_EQ(r.links.at(0).name, "a_b_");
}

// What thousands of names that become the same, or thousands of elements, cost is bounded.
TEST(Urdf, ReadsLargeFilesAtOnce) {
  std::string text = "<robot name='r'>\n<link name='root'/>\n";
  for (int i = 0; i < 9'000; ++i) {
    text += "<link name=\"" + std::to_string(i) + (i % 2 == 0 ? "-" : "+") + "\"/>\n";
    text += "<joint name='j" + std::to_string(i) + "' type='continuous'><parent link='" +
            (i == 0 ? "root" : std::to_string(i - 1) + (i % 2 == 1 ? "-" : "+")) + "'/><child link='" + std::to_string(i) +
            (i % 2 == 0 ? "-" : "+") + "'/></joint>\n";
  }
  const Robot r = parse_urdf(text + "</robot>", "r.urdf");
  EXPECT_EQ(r.links.size(), 9'001u);
  EXPECT_LT(r.notices.size(), 110u);
}

TEST(Urdf, EveryInputOfTheFuzzersCorpusIsReadOrRefusedWithAPlace) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(CORANK_SOURCE_DIR "/tests/fuzz/corpus/urdf")) {
    std::ifstream in(entry.path(), std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    EXPECT_NO_THROW(fuzz_urdf(reinterpret_cast<const std::uint8_t*>(text.data()), text.size())) << entry.path();
    ++count;
  }
  EXPECT_GE(count, 10);
}

TEST(Urdf, NeverCrashesWhateverTheBytes) {
  std::mt19937 random(1);
  const auto below = [&](std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random); };
  const std::string likely = "<>/='\"&;-.0123456789eE \n!?$*#\xFF";
  int read = 0, refused = 0;
  for (const auto& [name, trials] : {std::pair("arm_3r.urdf", 3'000), std::pair("five_bar.urdf", 3'000),
                                     std::pair("ur5_like.urdf", 3'000), std::pair("every_joint.urdf", 1'000)}) {
    const std::string original = text_of(name);
    for (int trial = 0; trial < trials / (test::long_run() ? 1 : 3); ++trial) {
      std::string text = original;
      for (std::size_t changes = 1 + below(4); changes > 0; --changes) {
        const std::size_t at = below(text.size());
        switch (below(4)) {
          case 0: text[at] = static_cast<char>(below(256)); break;
          case 1: text[at] = likely[below(likely.size())]; break;
          case 2: text.erase(at, 1 + below(20)); break;
          default: text.insert(at, text.substr(below(text.size()), below(40)));
        }
      }
      try {
        parse_urdf(text, "r.urdf");
        ++read;
      } catch (const ModelError& error) {
        EXPECT_THAT(error.what(), testing::StartsWith("r.urdf"));
        EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
        ++refused;
      }
    }
  }
  EXPECT_GT(read, (read + refused) / 20);
  EXPECT_GT(refused, (read + refused) / 5);
}

}  // namespace
}  // namespace corank::kinematics
