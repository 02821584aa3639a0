// Rows of Denavit and Hartenberg in the parts language: each is a link, and the joint that carries it.
#include <algorithm>
#include <string>

#include "corank/kinematics/language/part_builder.h"
#include "corank/kinematics/robot/vectors.h"
#include "corank/symbolic/model/expression_words.h"

namespace corank::kinematics {

using symbolic::in_quotes;
using symbolic::ModelError;
using symbolic::suggestion;

namespace {

Pose about_x(const DhRow& row) { return translation({row.a, 0, 0}) * rotation(0, row.alpha); }
Pose about_z(const DhRow& row) { return translation({0, 0, row.d}) * rotation(2, row.theta); }

/// A joint about the z axis of a frame, its angle counted from x.
JointEnd end_at(const Pose& frame, int sense) {
  const auto column = [&](std::size_t i) {
    return Vector{frame.rotation[0][i], frame.rotation[1][i], frame.rotation[2][i]};
  };
  JointEnd end;
  end.point = frame.translation;
  end.axis = sense > 0 ? column(2) : Vector{0, 0, 0} - column(2);
  end.zero = column(0);
  return end;
}

}  // namespace

Pose dh_pose(DhConvention convention, const DhRow& row) {
  return convention == DhConvention::standard ? about_z(row) * about_x(row) : about_x(row) * about_z(row);
}

std::array<JointEnd, 2> dh_ends(DhConvention convention, const DhRow& row, int sense) {
  if (convention == DhConvention::standard) return {end_at(about_z(row), sense), end_at(inverse(about_x(row)), sense)};
  return {end_at(about_x(row) * about_z(row), sense), end_at(Pose{}, sense)};
}

void PartBuilder::begin_dh(std::string_view convention, const SourceLocation& where) {
  dh = {};
  dh.where = where;
  dh.convention = small_letters(convention) == "standard" ? DhConvention::standard : DhConvention::modified;
  if (robot.links.empty()) begin_link("base", where);
}

void PartBuilder::add_dh_column(std::string_view word, const SourceLocation& where) {
  const std::string column = small_letters(word);
  if (std::ranges::find(dh.columns, column) != dh.columns.end())
    throw ModelError(where, "the column " + in_quotes(column) + " occurs twice here", "each of a, alpha, d and theta once");
  dh.columns.push_back(column);
}

void PartBuilder::begin_dh_row(const SourceLocation& where) {
  draft = {};
  dh.cells.clear();
  dh.variables.clear();
  dh.link.clear();
  dh.row_where = where;
  dh.reads_cells = true;
}

const Expression& PartBuilder::dh_cell(const std::string& column) const {
  return dh.cells[std::ranges::find(dh.columns, column) - dh.columns.begin()];
}

/// What the row's joint is called, as soon as its cells are known.
void PartBuilder::finish_dh_cells() {
  dh.reads_cells = false;
  draft.kind = "fix";
  draft.where = dh.row_where;
  if (dh.variables.empty()) return;
  const DhDraft::Variable& variable = dh.variables.front();
  for (const DhDraft::Variable& other : dh.variables) {
    const std::string& column = dh.columns[other.column];
    if (column != "theta" && column != "d")
      throw ModelError(
          other.where,
          "the constant " + in_quotes(other.name) + " in the column " + in_quotes(column) + " is not defined before",
          "a constant of [CONSTANTS]" + suggestion(resolve(other.name), scope.names()) + "; joints vary theta or d");
    if (other.name != variable.name || other.column != variable.column)
      throw ModelError(
          other.where,
          "two names in this row, " + in_quotes(variable.name) + " and " + in_quotes(other.name) + ", are not constants",
          "one joint's name, in theta or d; all others are constants of [CONSTANTS]");
  }
  draft.kind = dh.columns[variable.column] == "theta" ? "revolute" : "prismatic";
  draft.name = variable.name;
  draft.name_where = draft.where = variable.where;
}

/// Takes the joint's name out of the cell in which it stands: q, q + c, c - q.
void PartBuilder::read_dh_variable(DhRow& row, bool& slides, int& sense) const {
  using Kind = Expression::Kind;
  slides = draft.kind == "prismatic";
  sense = 1;
  if (dh.variables.empty()) return;
  Expression& cell = slides ? row.d : row.theta;
  const std::string symbol = resolve(draft.name);
  Expression rest = 0;
  int found = 0;
  for (const Expression& term : cell.kind() == Kind::sum ? cell.operands() : std::vector<Expression>{cell}) {
    const bool is_negated = term.kind() == Kind::negation;
    const Expression& bare = is_negated ? term.operands()[0] : term;
    if (bare.kind() == Kind::symbol && bare.name() == symbol) {
      ++found;
      sense = is_negated ? -1 : 1;
    } else {
      rest = is_negated ? folded_difference(rest, bare) : folded_sum(rest, bare);
    }
  }
  if (found != 1 || rest.mentions(symbol))
    throw ModelError(dh.variables[0].where,
                     "the column " + in_quotes(slides ? "d" : "theta") + " is " + in_quotes(cell.text()) +
                         ": the joint's coordinate is not simply added there",
                     "the joint's name, plus or minus a constant: " + draft.name + ", " + draft.name + " - 90deg");
  cell = rest;
}

/// A number of several turns, in radians, was hardly meant.
void PartBuilder::note_dh_degrees(const std::string& column, const Expression& angle) {
  constexpr double kMostRadians = 7;
  Expression number = angle.kind() == Expression::Kind::negation ? angle.operands()[0] : angle;
  for (const symbolic::Constant& constant : robot.constants)
    if (number.kind() == Expression::Kind::symbol && number.name() == constant.name) number = constant.value;
  if (number.kind() == Expression::Kind::negation) number = number.operands()[0];
  if (number.kind() != Expression::Kind::number || !(std::stod(number.name()) > kMostRadians)) return;
  robot.notices.push_back("line " + std::to_string(dh.row_where.line) + ": " + column + " = " + angle.text() +
                          " is in radians; write degrees as " + number.name() + "deg");
}

void PartBuilder::finish_dh_row() {
  DhRow row{dh_cell("a"), dh_cell("alpha"), dh_cell("d"), dh_cell("theta")};
  bool slides = false;
  int sense = 1;
  read_dh_variable(row, slides, sense);
  note_dh_degrees("alpha", row.alpha);
  note_dh_degrees("theta", row.theta);
  if (draft.kind == "fix" && draft.actuated)
    throw ModelError(draft.where, "the row is actuated, but there is no joint's name in theta or d",
                     "theta = q1, for instance");
  Joint joint = named_joint();
  std::size_t far = 0;
  dh.last_has_name = !dh.link.empty();
  if (dh.last_has_name && robot.find_link(resolve(dh.link)) >= 0) {
    far = robot.find_link(resolve(dh.link));
    if (far == dh.base)
      throw ModelError(dh.link_where, "the row ends at the link " + in_quotes(dh.link) + " from which it begins",
                       "another link");
  } else {
    std::string called = dh.link;
    for (int k = 1; called.empty() || (!dh.last_has_name && robot.find_link(resolve(called)) >= 0); ++k)
      called = "link" + std::to_string(k);
    const JointDraft kept = draft;
    begin_link(called, dh.last_has_name ? dh.link_where : dh.row_where);
    draft = kept;
    far = robot.links.size() - 1;
  }
  if (joint.kind == JointKind::fixed) {
    joint.pose = dh_pose(dh.convention, row);
  } else {
    joint.ends = dh_ends(dh.convention, row, sense);
    dh_joints_.push_back(joint.name);
  }
  joint.ends[0].link = dh.base;
  joint.ends[1].link = far;
  set_ranges(joint);
  robot.joints.push_back(std::move(joint));
  dh.base = far;
  dh.has_rows = true;
}

/// The last link is the tool, where nobody calls it otherwise.
void PartBuilder::finish_dh() {
  if (!dh.has_rows)
    throw ModelError(dh.where, "there is no row below the names of the columns", "a row for each joint: 0 -90deg 0 q1");
  Link& last = robot.links[dh.base];
  if (!dh.last_has_name && robot.find_link(resolve("tool")) < 0) last.name = resolve("tool");
  dh_tools_.push_back(last.name);
  last_joint.clear();
}

/// Rows alone are an arm: every joint is driven, and its last frame is what it is for.
void PartBuilder::ask_for_what_dh_leaves_open() {
  if (dh_joints_.empty()) return;
  if (std::ranges::none_of(robot.joints, [](const Joint& j) { return j.actuated; }))
    for (const std::string& driven : dh_joints_) robot.joints[robot.find_joint(driven)].actuated = true;
  if (!robot.outputs.empty() || dh_tools_.size() != 1) return;
  Output tool;
  tool.name = "tool";
  tool.where = dh.where;
  tool.link = robot.find_link(dh_tools_[0]);
  tool.kind = dh_joints_.size() >= 6 ? Output::Kind::pose : Output::Kind::position;
  robot.outputs.push_back(std::move(tool));
}

}  // namespace corank::kinematics
