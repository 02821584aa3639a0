// The joints of the parts language: what their ends, ranges and references mean.
#include "corank/kinematics/language/part_builder.h"
#include "corank/kinematics/robot/vectors.h"
#include "corank/symbolic/model/expression_words.h"

namespace corank::kinematics {

using symbolic::in_quotes;
using symbolic::ModelError;

namespace {

JointKind kind_of(const std::string& word) {
  for (const JointTraits& known : joint_traits())
    if (word == known.name) return known.kind;
  return word == "crevolute" ? JointKind::revolute : JointKind::fixed;
}

bool is_kind(const std::string& word) {
  return word == "fix" || word == "gear" || word == "c_spring" || word == "c_cable" || word == "c_leg" ||
         kind_of(word) != JointKind::fixed;
}

}  // namespace

std::string JointDraft::described() const {
  const std::string what = "the " + kind + (kind == "gear" || kind == "parallelogram" ? "" : " joint");
  return name.empty() ? what : what + " " + in_quotes(name);
}

void PartBuilder::begin_joint(std::string_view word, const SourceLocation& where) {
  draft = {};
  draft.kind = small_letters(word);
  draft.where = where;
  points.clear();
  values.clear();
  shape_colour.clear();
  hidden = false;
}

void PartBuilder::joint_link(std::string_view name_read, const SourceLocation& where) {
  const std::string link = resolve(name_read);
  if (robot.find_link(link) < 0 && draft.links.size() == 1 && is_kind(small_letters(name_read)))
    throw ModelError(where, draft.described() + " has one end only", "two links, each with its points");
  const std::size_t index = require_link({link, where}, "the name of a link that [LINKS] declares before");
  if (draft.links.size() == 1 && draft.links[0] == index)
    throw ModelError(where, draft.described() + " connects the link " + in_quotes(name_read) + " with itself",
                     "two different links");
  draft.links.push_back(index);
  link_ = index;
}

void PartBuilder::push_bracket(const SourceLocation& where) {
  JointDraft::Bracket bracket;
  bracket.where = where;
  if (bracket_has_two) bracket.second = pop_value();
  bracket.first = pop_value();
  draft.brackets.push_back(std::move(bracket));
}

void PartBuilder::push_named_reference(const std::string& point, const SourceLocation& where) {
  const std::size_t end = draft.references.size();
  if (end > 1) throw ModelError(where, draft.described() + " has a third reference point", "one for each end");
  draft.references.push_back({require_point(draft.links[end], {point, where}), false, where});
}

void PartBuilder::require_brackets(std::size_t least, std::size_t most, const std::string& expectation) const {
  const std::size_t n = draft.brackets.size();
  if (n >= least && n <= most) return;
  const std::string count = n == 0 ? "no range" : n == 1 ? "one range" : std::to_string(n) + " ranges";
  throw ModelError(n == 0 ? draft.where : draft.brackets.back().where, draft.described() + " has " + count, expectation);
}

void PartBuilder::set_axes(Joint& joint) {
  const std::size_t of_first = (points.size() + 1) / 2;  // as many as the other end has, or one more
  for (std::size_t i = 0; i < 2; ++i) {
    const std::size_t begin = i == 0 ? 0 : of_first, end = i == 0 ? of_first : points.size();
    const ReadPoint& first = points[begin];
    joint.ends[i].link = draft.links[i];
    joint.ends[i].point = first.at;
    joint.ends[i].label = first.name;
    if (end - begin < 2) continue;
    const ReadPoint& second = points[begin + 1];
    joint.ends[i].axis = second.way ? *second.way : second.at - first.at;
  }
  if (!keeps_orientation(joint.kind)) return;
  Vector& axis = joint.ends[1].axis;
  const std::string what = "the axis of " + draft.described();
  const auto is_zero = [&](const Expression& e) {
    const std::optional<int> sign = scope.sign(e, what, draft.where);
    return !sign || *sign == 0;
  };
  const Vector across = cross(joint.ends[0].axis, axis);
  const bool parallel = is_zero(across[0]) && is_zero(across[1]) && is_zero(across[2]) &&
                        scope.sign(dot(joint.ends[0].axis, axis), what, draft.where) != -1;
  if (parallel) return;
  if (!is_world_)
    throw ModelError(draft.where, draft.described() + " has axes of different directions in its two links",
                     "one direction: a " + draft.kind + " joint keeps the links' frames parallel");
  axis = joint.ends[0].axis;
  pass_over("second axes of prismatic joints, which differ from the first: the links' frames stay parallel");
}

void PartBuilder::set_ranges(Joint& joint) {
  const bool is_size = joint.kind == JointKind::spherical;
  const JointTraits& of_kind = traits(joint.kind);
  switch (joint.kind) {
    case JointKind::cylindrical: require_brackets(0, 2, "range [of the angle] [of the way]"); break;
    case JointKind::universal:
      if (!draft.brackets.empty()) require_brackets(2, 2, "range [lower, upper] R [lower, upper] R, one for each angle");
      break;
    case JointKind::spherical: require_brackets(0, 1, "range [half angle] R R"); break;
    default:
      require_brackets(0, of_kind.ranges,
                       of_kind.ranges > 0 ? "at most one, range [lower, upper]" : "none for this kind of joint");
  }
  for (const JointDraft::Bracket& bracket : draft.brackets) {
    if (!bracket.second && !is_size)
      throw ModelError(bracket.where, "the range of " + draft.described() + " has one number", "[lower, upper]");
    const Range range{is_size && !bracket.second ? Expression(0) : bracket.first,
                      bracket.second ? *bracket.second : bracket.first};
    if (scope.sign(folded_difference(range.upper, range.lower), "the range of " + draft.described(), bracket.where) == -1)
      throw ModelError(bracket.where,
                       is_size && !bracket.second
                           ? "the half angle of " + draft.described() + " is negative"
                           : "the range of " + draft.described() + " is empty: " + in_quotes(range.lower.text()) +
                                 " is above " + in_quotes(range.upper.text()),
                       is_size && !bracket.second ? "[half angle] from 0 to pi" : "[lower, upper]");
    joint.ranges.emplace_back(range);
  }
  const bool turns = of_kind.has_angle || is_size;
  // The frames of a parallelogram's links stay parallel: one direction is that of both.
  if (joint.kind == JointKind::parallelogram && draft.zeros.size() == 1) draft.zeros.push_back(draft.zeros[0]);
  const std::size_t n = draft.references.size() + draft.zeros.size();
  if (n > 0 && !turns)
    throw ModelError(draft.zeros.empty() ? draft.references[0].where : draft.zero_where,
                     draft.described() + " has reference directions", "none: the joint has no angle of its own");
  if (n > 0 && n != 2)
    throw ModelError(draft.zeros.empty() ? draft.references.back().where : draft.zero_where,
                     draft.described() + " has " + symbolic::counted(n, "reference"), "one for each end");
  if (is_size && !draft.brackets.empty() && n == 0)
    throw ModelError(draft.brackets[0].where, "the half angle of " + draft.described() + " has no directions after it",
                     "range [half angle] R R: a direction in each link, the angle between which is limited");
  for (std::size_t i = 0; i < n; ++i) {
    JointEnd& end = joint.ends[i];
    const auto direction = [&]() -> Vector {
      if (!draft.zeros.empty()) return draft.zeros[i];
      const JointDraft::Reference& reference = draft.references[i];
      return reference.is_direction ? reference.value : reference.value - end.point;
    };
    if (is_size) {
      end.axis = direction();
    } else {
      end.zero = direction();
    }
  }
}

Joint PartBuilder::named_joint() {
  Joint joint;
  joint.kind = kind_of(draft.kind);
  joint.where = draft.where;
  joint.is_named = !draft.name.empty();
  joint.name = resolve(joint.is_named ? draft.name : "J" + std::to_string(robot.joints.size() + 1));
  while (!joint.is_named && robot.find_joint(joint.name) >= 0) joint.name += "_";
  if (const int same = robot.find_joint(joint.name); same >= 0) {
    Joint& known = robot.joints[same];
    if (known.is_named)
      throw ModelError(
          draft.name_where,
          "the joint " + in_quotes(draft.name) + " is already there, in line " + std::to_string(known.where.line),
          "another name for the joint");
    std::string other = known.name;
    while (robot.find_joint(other) >= 0) other += "_";
    known.name = other;
  }
  joint.actuated = draft.actuated;
  return joint;
}

void PartBuilder::finish_joint() {
  Joint joint = named_joint();
  if (joint.kind == JointKind::fixed) {
    for (std::size_t i = 0; i < 2; ++i) joint.ends[i].link = draft.links[i];
    joint.pose = draft.pose;
  } else {
    set_axes(joint);
  }
  set_ranges(joint);
  if (joint.kind == JointKind::distance || joint.kind == JointKind::parallelogram) {
    if (!draft.length) throw ModelError(draft.where, draft.described() + " has no length", "length l");
    joint.length = *draft.length;
  } else if (draft.length) {
    throw ModelError(draft.where, draft.described() + " has a length",
                     "none: only sph_sph and parallelogram have one, sph_prs_sph and uni_prs_uni a range of lengths");
  }
  if (draft.kind == "crevolute") couple(joint);
  if (!draft.driver.text.empty()) {
    draft.follower.text = joint.name;
    couplings_.push_back(draft);
  }
  robot.joints.push_back(std::move(joint));
  last_joint = draft.described();
  points.clear();
  values.clear();
}

// A crevolute joint turns by the angle of the revolute joint before it.
void PartBuilder::couple(const Joint& joint) {
  if (robot.joints.empty() || robot.joints.back().kind != JointKind::revolute)
    throw ModelError(draft.where, draft.described() + " follows no revolute joint",
                     "the joint with which it is coupled before it");
  robot.missing.push_back(joint.where.text() + ": the coupling of " + draft.described() +
                          " with the joint before it: coupled joints (crevolute) are not supported");
}

void PartBuilder::finish_gear() {
  couplings_.push_back(draft);
  last_joint = draft.described();
}

void PartBuilder::resolve_couplings() {
  for (const JointDraft& read : couplings_) {
    const std::size_t driver = require_joint(read.driver, "the name of the joint that leads");
    const std::size_t follower = require_joint(read.follower, "the name of the joint that follows");
    robot.couplings.push_back({driver, follower, read.ratio, read.offset, read.where});
  }
}

// The suite draws a connector and gives it a force; it holds nothing.
void PartBuilder::finish_connector() {
  if (draft.kind == "c_spring") {
    pass_over("springs (c_spring)");
  } else {
    robot.missing.push_back(draft.where.text() + ": " + (draft.kind == "c_cable" ? "a cable (c_cable)" : "a strut (c_leg)") +
                            ": what holds by its force only is not supported");
  }
  points.clear();
  values.clear();
}

// Angles that somebody may ask for count between the links' x-axes where both axes are written (0, 0, c).
void PartBuilder::set_zero_directions() {
  for (Joint& joint : robot.joints) {
    if (!traits(joint.kind).has_angle) continue;
    const bool has_range = joint.range().has_value();
    if (joint.ends[0].zero || !(has_range || joint.actuated || joint.is_named)) continue;
    const auto along_z = [](const JointEnd& end) { return is_literal_zero(end.axis[0]) && is_literal_zero(end.axis[1]); };
    if (joint.kind != JointKind::universal && along_z(joint.ends[0]) && along_z(joint.ends[1])) {
      for (JointEnd& end : joint.ends) end.zero = Vector{1, 0, 0};
      continue;
    }
    if (!has_range) continue;
    throw ModelError(
        joint.where,
        std::string("the range of the ") + to_string(joint.kind) + " joint has no directions from which its angle counts",
        "two points after the range, or zero (u) (v), a direction across the axis in each link");
  }
}

}  // namespace corank::kinematics
