#include <algorithm>
#include <cmath>
#include <numbers>

#include "corank/kinematics/robot/vectors.h"
#include "corank/kinematics/urdf/urdf_reading.h"
#include "corank/symbolic/model/expression_words.h"

namespace corank::kinematics {
namespace {

using symbolic::in_quotes;
using symbolic::ModelError;
using symbolic::suggestion;

constexpr std::size_t kMaxLinks = 10'000;
constexpr int kWholeTurn = 720;  ///< in half degrees
constexpr const char* kCloseLoops = "URDF is a tree: close loops in a .loops file";

// A <joint> and its place in the tree. Links are counted as in the file.
struct Edge {
  pugi::xml_node element;
  std::size_t parent, child;
  int joint = -1;  ///< in the robot; −1 where it is none there
};

class TreeReader {
 public:
  TreeReader(std::string_view text, const std::string& file, bool closed) : reading_(text, file), closed_(closed) {
    robot_.file = file;
    robot_.unit = "m";
  }

  Robot read() {
    read_robot();
    read_names();
    const std::size_t root = find_root();
    check_cycles();
    read_links(root);
    for (std::size_t i = 0; i < edges_.size(); ++i) read_joint(i);
    read_mimics();
    read_actuators();
    robot_.notices = reading_.notices();
    return std::move(robot_);
  }

 private:
  static constexpr std::size_t kNone = -1;

  void read_robot() {
    const std::string name(reading_.required(top_, "name", "the robot"));
    robot_.name = name;
    if (const pugi::xml_attribute version = top_.attribute("version")) {
      const std::string_view text = version.value();
      if (text != "1" && !text.starts_with("1."))
        throw ModelError(reading_.where(version), "the version of URDF is " + in_quotes(text), "1.0");
    }
    refuse_other_loops();
    reading_.allow_children(top_, {"link", "joint", "material", "transmission", "ros2_control", "gazebo"});
    for (const pugi::xml_node& gazebo : top_.children("gazebo")) {
      reading_.notice("<gazebo> passed over");
      if (gazebo.child("joint"))
        reading_.notice("a <gazebo> holds a joint; if it closes a loop, declare it in a .loops file");
    }
  }

  // Other readers' ways to close a loop (<loop_joint>, <drake:ball_constraint>): without it the mechanism is another one.
  void refuse_other_loops() const {
    if (closed_) return;
    for (const pugi::xml_node& child : top_.children()) {
      const std::string_view name = child.name();
      if (name.find("loop") == std::string_view::npos && name.find("constraint") == std::string_view::npos) continue;
      throw ModelError(reading_.where(child), "<" + symbolic::shortened(name) + "> is not URDF's and may close a loop",
                       "the loop in a .loops file; if you give one, this element is passed over");
    }
  }

  void read_names() {
    std::vector<pugi::xml_node> joints;
    for (const pugi::xml_node& link : top_.children("link")) {
      if (links_.size() == kMaxLinks)
        throw ModelError(reading_.where(link), "there are too many links", "at most " + std::to_string(kMaxLinks));
      links_.add(link);
      link_elements_.push_back(link);
    }
    if (links_.size() == 0) throw ModelError(reading_.where(top_), "the robot has no links", "<link> elements");
    for (const pugi::xml_node& joint : top_.children("joint")) {
      joints_.add(joint);
      joints.push_back(joint);
    }
    parent_edge_.assign(links_.size(), kNone);
    for (const pugi::xml_node& joint : joints) add_edge(joint);
    link_names_ = links_.identifiers();
    joint_names_ = joints_.identifiers();
  }

  std::string joint_text(std::size_t i) const { return "joint " + in_quotes(joints_[i]); }

  std::size_t linked(const pugi::xml_node& joint, const char* side) const {
    const pugi::xml_node element = reading_.only_child(joint, side);
    const std::string owner = "joint " + in_quotes(joint.attribute("name").value());
    if (!element)
      throw ModelError(reading_.where(joint), owner + " has no " + side, "<" + std::string(side) + " link=\"…\">");
    reading_.allow_attributes(element, {"link"});
    return links_.find(element, "link", "the " + std::string(side) + " of " + owner);
  }

  void add_edge(const pugi::xml_node& joint) {
    const Edge edge{joint, linked(joint, "parent"), linked(joint, "child")};
    const SourceLocation where = reading_.where(joint.child("child").attribute("link"));
    const std::string child = in_quotes(links_[edge.child]);
    if (edge.parent == edge.child)
      throw ModelError(where, joint_text(edges_.size()) + " joins the link " + child + " with itself", "two links");
    std::size_t& parent = parent_edge_[edge.child];
    if (parent != kNone)
      throw ModelError(where,
                       "the link " + child + " is the child of two joints, " + in_quotes(joints_[parent]) + " and " +
                           in_quotes(joints_[edges_.size()]),
                       kCloseLoops);
    parent = edges_.size();
    edges_.push_back(edge);
  }

  std::size_t find_root() const {
    std::size_t root = kNone;
    for (std::size_t i = 0; i < links_.size(); ++i) {
      if (parent_edge_[i] != kNone) continue;
      if (root != kNone)
        throw ModelError(
            reading_.where(link_elements_[i]),
            "two links are not the child of a joint, " + in_quotes(links_[root]) + " and " + in_quotes(links_[i]),
            "one root, which is the ground");
      root = i;
    }
    if (root == kNone)
      throw ModelError(reading_.where(link_elements_[0]), "every link is the child of a joint, so there is no ground",
                       kCloseLoops);
    return root;
  }

  // Every link has at most one parent: whoever does not come to the root goes round.
  void check_cycles() const {
    std::vector<std::size_t> seen(links_.size(), kNone);
    for (std::size_t start = 0; start < links_.size(); ++start) {
      std::size_t link = start;
      while (seen[link] == kNone) {
        seen[link] = start;
        const std::size_t edge = parent_edge_[link];
        if (edge == kNone) break;
        link = edges_[edge].parent;
        if (seen[link] == start)
          throw ModelError(reading_.where(edges_[edge].element), joint_text(edge) + " closes a cycle of links", kCloseLoops);
      }
    }
  }

  void read_links(std::size_t root) {
    const UrdfColours colours = read_urdf_colours(reading_);
    position_.assign(links_.size(), 0);
    for (std::size_t i = 0; i < links_.size(); ++i) position_[i] = i == root ? 0 : i < root ? i + 1 : i;
    robot_.links.resize(links_.size());
    for (std::size_t i = 0; i < links_.size(); ++i) {
      const pugi::xml_node& element = link_elements_[i];
      Link& link = robot_.links[position_[i]];
      link.name = link_names_[i];
      link.where = reading_.where(element);
      reading_.allow_children(element, {"visual", "collision", "inertial"});
      for (const pugi::xml_node& visual : element.children("visual")) read_urdf_visual(reading_, visual, colours, link);
      pass_over(element, "inertial", "dynamics (mass, inertia) passed over");
      pass_over(element, "collision", "collision geometry passed over");
    }
  }

  void pass_over(const pugi::xml_node& element, const char* child, const std::string& sentence) {
    for ([[maybe_unused]] const pugi::xml_node& found : element.children(child)) reading_.notice(sentence);
  }

  void read_joint(std::size_t index) {
    Edge& edge = edges_[index];
    const std::string_view type = reading_.required(edge.element, "type", joint_text(index));
    const SourceLocation type_where = reading_.where(edge.element.attribute("type"));
    reading_.allow_children(edge.element, {"origin", "parent", "child", "axis", "limit", "mimic", "dynamics", "calibration",
                                           "safety_controller"});
    pass_over(edge.element, "dynamics", "dynamics (damping, friction) of joints passed over");
    pass_over(edge.element, "calibration", "calibration of joints passed over");
    pass_over(edge.element, "safety_controller", "safety controllers of joints passed over");
    if (type == "floating") {
      pass_floating(index, type_where);
      return;
    }
    Joint joint;
    joint.name = joint_names_[index];
    joint.is_named = true;
    joint.where = reading_.where(edge.element);
    joint.ends[0].link = position_[edge.parent];
    joint.ends[1].link = position_[edge.child];
    joint.kind = kind_of(type, type_where);
    const Pose pose = reading_.origin(edge.element, joint_text(index));
    if (joint.kind == JointKind::fixed) {
      joint.pose = pose;
    } else {
      place_axis(index, pose, joint);
    }
    if (type == "revolute" || type == "prismatic") {
      joint.ranges = {read_range(index, type == "revolute")};
    } else if (edge.element.child("limit")) {
      reading_.notice("limits of joints that are " + std::string(type) + " passed over");
    }
    edge.joint = static_cast<int>(robot_.joints.size());
    robot_.joints.push_back(std::move(joint));
  }

  static JointKind kind_of(std::string_view type, const SourceLocation& where) {
    if (type == "revolute" || type == "continuous") return JointKind::revolute;
    if (type == "prismatic") return JointKind::prismatic;
    if (type == "fixed") return JointKind::fixed;
    if (type == "planar") return JointKind::planar;
    const std::vector<std::string> types{"revolute", "continuous", "prismatic", "fixed", "planar", "floating"};
    throw ModelError(where, "a joint's type is " + in_quotes(type),
                     "revolute, continuous, prismatic, fixed, planar or floating" + suggestion(std::string(type), types));
  }

  // Once all joints are there: one may follow another that stands behind it.
  void read_mimics() {
    for (std::size_t index = 0; index < edges_.size(); ++index) {
      const pugi::xml_node mimic = reading_.only_child(edges_[index].element, "mimic");
      if (!mimic) continue;
      reading_.allow_attributes(mimic, {"joint", "multiplier", "offset"});
      const std::size_t leader = joints_.find(mimic, "joint", "the <mimic> of " + joint_text(index));
      if (edges_[index].joint < 0 || edges_[leader].joint < 0)
        throw ModelError(reading_.where(mimic),
                         joint_text(index) + " mimics " + in_quotes(joints_[leader]) + ", one of which is floating",
                         "two joints that turn, or two that slide");
      Coupling coupling;
      coupling.where = reading_.where(mimic);
      coupling.driver = edges_[leader].joint;
      coupling.follower = edges_[index].joint;
      const bool turns = robot_.joints[coupling.follower].kind == JointKind::revolute;
      if (const auto multiplier = reading_.number(mimic, "multiplier", "the multiplier of " + joint_text(index)))
        coupling.ratio = turns ? fraction(*multiplier) : multiplier->value;
      const std::string of_offset = "the offset of " + joint_text(index);
      if (const auto offset =
              turns ? reading_.angle(mimic, "offset", of_offset) : reading_.number(mimic, "offset", of_offset))
        coupling.offset = offset->value;
      robot_.couplings.push_back(coupling);
    }
  }

  // A decimal of a third, say, to six digits or more is a third.
  Expression fraction(const UrdfNumber& multiplier) {
    constexpr int kLargest = 24;
    constexpr double kRounded = 1e-6;
    for (int q = 1; q <= kLargest; ++q) {
      const double p = std::round(multiplier.approximate * q), off = std::fabs(multiplier.approximate - p / q);
      if (p == 0 || off > kRounded) continue;
      const Expression whole(static_cast<int>(std::fabs(p))), positive = q == 1 ? whole : whole / Expression(q);
      const Expression exact = p < 0 ? -positive : positive;
      if (off > 1e-15) reading_.notice("multiplier " + multiplier.value.text() + " read as " + exact.text());
      return exact;
    }
    return multiplier.value;
  }

  void pass_floating(std::size_t index, const SourceLocation& where) {
    const std::string child = in_quotes(links_[edges_[index].child]);
    if (!closed_)
      throw ModelError(where, joint_text(index) + " is floating: nothing holds the link " + child,
                       "a fixed joint, or a .loops file whose joints hold it");
    reading_.notice(joint_text(index) + " is floating, so it is left out: loops have to hold the link " + child);
  }

  void place_axis(std::size_t index, const Pose& pose, Joint& joint) {
    std::array<UrdfNumber, 3> axis = urdf_numbers("1 0 0", {}, "axis", urdf_number);
    if (const pugi::xml_node element = reading_.only_child(edges_[index].element, "axis")) {
      reading_.allow_attributes(element, {"xyz"});
      reading_.required(element, "xyz", "the axis of " + joint_text(index));
      const pugi::xml_attribute xyz = element.attribute("xyz");
      axis = urdf_numbers(xyz.value(), reading_.where(xyz), "the axis of " + joint_text(index), urdf_number);
      if (std::ranges::all_of(axis, [](const UrdfNumber& x) { return x.is_zero; }))
        throw ModelError(reading_.where(xyz), "the axis of " + joint_text(index) + " is 0", "a direction");
    } else {
      reading_.notice("a joint has no <axis>: x is taken, the default of URDF");
    }
    const Vector direction{axis[0].value, axis[1].value, axis[2].value};
    const Vector zero = perpendicular(axis);
    joint.ends[0].point = pose.translation;
    joint.ends[0].axis = turned(pose, direction);
    joint.ends[0].zero = turned(pose, zero);
    joint.ends[1].axis = direction;
    joint.ends[1].zero = zero;
  }

  // With a_k the largest component and n the next one cyclically: a_k e_n − a_n e_k. Of x it is y, of y z, of z x.
  static Vector perpendicular(const std::array<UrdfNumber, 3>& a) {
    std::size_t k = 0;
    for (std::size_t i = 1; i < 3; ++i)
      if (std::fabs(a[i].approximate) > std::fabs(a[k].approximate)) k = i;
    const std::size_t n = (k + 1) % 3;
    Vector result{0, 0, 0};
    result[n] = a[k].value;
    result[k] = folded_difference(0, a[n].value);
    return result;
  }

  std::optional<Range> read_range(std::size_t index, bool is_angle) {
    const pugi::xml_node limit = reading_.only_child(edges_[index].element, "limit");
    const char* otherwise =
        is_angle ? "<limit lower=\"…\" upper=\"…\">, or the type continuous" : "<limit lower=\"…\" upper=\"…\">";
    if (!limit) throw ModelError(reading_.where(edges_[index].element), joint_text(index) + " has no limits", otherwise);
    reading_.allow_attributes(limit, {"lower", "upper", "effort", "velocity", "acceleration", "deceleration", "jerk"});
    for (const char* passed : {"effort", "velocity", "acceleration", "deceleration", "jerk"}) {
      if (!limit.attribute(passed)) continue;
      reading_.notice("limits of effort and velocity passed over");
      break;
    }
    const auto read = [&](const char* attribute) {
      const std::string what = std::string(attribute) + " of " + joint_text(index);
      return is_angle ? reading_.angle(limit, attribute, what) : reading_.number(limit, attribute, what);
    };
    const std::optional<UrdfNumber> written_lower = read("lower"), written_upper = read("upper");
    if (!written_lower && !written_upper)
      throw ModelError(reading_.where(limit),
                       joint_text(index) + " has neither a lower nor an upper limit: URDF takes 0 for both", otherwise);
    const UrdfNumber zero = urdf_angle("0", {}, "0");
    const UrdfNumber lower = written_lower.value_or(zero), upper = written_upper.value_or(zero);
    if (lower.approximate > upper.approximate)
      throw ModelError(reading_.where(limit),
                       "the lower limit of " + joint_text(index) + " is above the upper one, " + lower.value.text() + " > " +
                           upper.value.text(),
                       "lower <= upper");
    if (is_angle && covers_circle(lower, upper)) {
      reading_.notice("limits of a whole turn or more do not limit a joint");
      return {};
    }
    return Range{lower.value, upper.value};
  }

  // A configuration knows no turns: what is allowed at some number of them is allowed.
  static bool covers_circle(const UrdfNumber& lower, const UrdfNumber& upper) {
    if (lower.half_degrees && upper.half_degrees) return *upper.half_degrees - *lower.half_degrees >= kWholeTurn;
    return upper.approximate - lower.approximate >= 2 * std::numbers::pi;
  }

  void read_actuators() {
    const auto mark = [&](const pugi::xml_node& element, const std::string& owner) {
      const std::size_t index = joints_.find(element, "name", "the joint of a " + owner);
      const int joint = edges_[index].joint;
      if (joint < 0 || robot_.joints[joint].kind == JointKind::fixed)
        throw ModelError(
            reading_.where(element),
            "a " + owner + " drives " + joint_text(index) + ", which is " + edges_[index].element.attribute("type").value(),
            "a joint that moves");
      robot_.joints[joint].actuated = true;
    };
    for (const pugi::xml_node& transmission : top_.children("transmission"))
      for (const pugi::xml_node& joint : transmission.children("joint")) mark(joint, "<transmission>");
    for (const pugi::xml_node& control : top_.children("ros2_control"))
      for (const pugi::xml_node& joint : control.children("joint"))
        if (joint.child("command_interface")) mark(joint, "<ros2_control>");
  }

  UrdfReading reading_;
  const pugi::xml_node top_ = reading_.robot();
  bool closed_;
  Robot robot_;
  UrdfNames links_{reading_, "link"}, joints_{reading_, "joint"};
  std::vector<pugi::xml_node> link_elements_;
  std::vector<Edge> edges_;  ///< one for each <joint>, in their order
  std::vector<std::size_t> parent_edge_;
  std::vector<std::string> link_names_, joint_names_;
  std::vector<std::size_t> position_;  ///< of the file's links in the robot
};

}  // namespace

Robot read_urdf_tree(std::string_view text, const std::string& file, bool closed) {
  return TreeReader(text, file, closed).read();
}

}  // namespace corank::kinematics
