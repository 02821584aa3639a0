#include "corank/kinematics/language/part_faults.h"

#include "corank/symbolic/model/expression_words.h"

namespace corank::kinematics {
namespace {

using symbolic::describe_start;
using symbolic::in_quotes;
using symbolic::nearest_name;
using symbolic::suggestion;

const std::vector<std::string> kColourWords{"red",    "green", "blue",  "purple", "cyan",
                                            "yellow", "white", "black", "grey",   "color"};
const std::string kColours = symbolic::listed(kColourWords, " or ") + " (r, g, b)";
const std::vector<std::string> kKinds = [] {
  std::vector<std::string> names = kind_names();
  names.emplace_back("gear");
  return names;
}();
const std::string kKindList = symbolic::listed(kKinds, " or ");
const std::vector<std::string> kOptions{"range",  "limits",   "reference", "zero",        "length", "radius",
                                        "avoid",  "actuated", "velocity",  "torque",      "force",  "effort",
                                        "hidden", "damping",  "friction",  "granularity", "mimic"};
const std::vector<std::string> kLinkWords{"body",     "box",        "prism",  "sphere", "cylinder", "line",
                                          "segments", "decoration", "hidden", "point",  "mass",     "inertia"};
const std::vector<std::string> kOutputs{"position", "orientation", "pose", "direction", "joint"};
const std::vector<std::string> kSections{"CONSTANTS", "LINKS",     "JOINTS",    "DH",         "INPUTS",      "OUTPUTS",
                                         "INCLUDE",   "EQUATIONS", "OBSTACLES", "COLLISIONS", "REQUIREMENTS"};

std::vector<std::string> joined(std::vector<std::string> a, const std::vector<std::string>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

}  // namespace

void PartFault::no_joint() const {
  const std::string name = symbolic::name_at(rest);
  if (name.empty()) found_instead_of(std::string("a joint, kind : link points link points, or a section"));
  const std::string kind = nearest_name(name, kKinds);
  if (!parts.last_joint.empty() && parts.robot.find_link(parts.resolve(name)) >= 0 && kind.empty())
    say("found a third end of " + parts.last_joint + ", on the link " + in_quotes(name), "two ends");
  if (parts.last_joint.empty()) say(in_quotes(name) + " is not a kind of joint", kKindList + suggestion(name, kKinds));
  say(in_quotes(name) + " is neither a kind of joint nor an option of " + parts.last_joint,
      std::string("an option such as range, zero or actuated, or the next joint: ") + kKindList +
          suggestion(name, joined(kKinds, kOptions)));
}

void PartFault::no_joint_link() const {
  if (parts.draft.links.size() == 1) say(parts.draft.described() + " has one end only", "two links, each with its points");
  found_instead_of("the name of a link");
}

void PartFault::no_joint_colon() const {
  found_instead_of(parts.draft.name.empty() ? "':' or a name after the kind of the joint" : "':' after the joint's name");
}

void PartFault::no_point() const {
  if (parts.draft.links.empty()) found_instead_of("a point (x, y, z)");
  const std::string link = parts.robot.links[parts.draft.links.back()].name;
  say("found " + describe_start(rest) + " where a point of the link " + in_quotes(link) + " should be",
      "(x, y, z), a point named in the link, or the number of a vertex");
}

void PartFault::no_second_point() const {
  if (parts.draft.links.empty()) found_instead_of("a second point (x, y, z), or + (direction)");
  const std::string link = parts.robot.links[parts.draft.links.back()].name;
  say("the axis of " + parts.draft.described() + " on the link " + in_quotes(link) + " has one point",
      "a second point (x, y, z), or + (direction)");
}

void PartFault::no_colour() const {
  const std::string name = symbolic::name_at(rest);
  if (name.empty()) found_instead_of(kColours);
  say(in_quotes(name) + " is not a colour", kColours + suggestion(name, kColourWords));
}

void PartFault::no_output_kind() const {
  const std::string name = symbolic::name_at(rest);
  const std::string expectation =
      "position of link.point, orientation of link, pose of link, direction of link (x, y, z) or "
      "joint name";
  if (name.empty()) found_instead_of(expectation);
  say(in_quotes(name) + " cannot be an output", expectation + suggestion(name, kOutputs));
}

void PartFault::no_dh_cell() const {
  const std::vector<std::string>& columns = parts.dh.columns;
  const std::size_t read = parts.dh.cells.size();
  say("found " + describe_start(rest) + " where the column " + in_quotes(columns[read]) + " of the row should be",
      "four expressions without blanks, or commas between them: 0, -90deg, 0, q1 - 90deg");
}

void PartFault::unknown_part_section() const {
  const std::string title(symbolic::trimmed(parts.section_title));
  throw symbolic::ModelError(
      parts.section_where, "section [" + symbolic::shortened(title) + "] is unknown beside [LINKS]",
      "[CONSTANTS], [LINKS], [JOINTS], [DH], [INPUTS], [OUTPUTS], [REQUIREMENTS], [INCLUDE], [EQUATIONS], "
      "[OBSTACLES] or [COLLISIONS]" +
          suggestion(title, kSections));
}

void refuse_word_behind_link(const std::string& word, const std::string& link, const SourceLocation& where) {
  throw symbolic::ModelError(where, "found " + in_quotes(word) + " in the line of the link " + in_quotes(link),
                             "a shape, a colour, point, mass, or the next link in a line of its own" +
                                 suggestion(word, joined(kColourWords, kLinkWords)));
}

}  // namespace corank::kinematics
